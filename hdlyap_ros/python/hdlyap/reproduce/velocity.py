"""The velocity of LP modes beside the slope of their branch."""

from hdlyap.plots import paper, steps

from .row import SIGMAS, Row

ABOVE, NEAR, BELOW = 'above c_L', 'near c_L', 'below c_L'
CROSSING = 0.6  # the paper: v is close to c_L below this density, above it beyond


def against_slope(quantity, v, error, recording):
    """Row: whether v lies above the paper's c_L by more than that is known to."""
    info = recording.info
    slope = paper.slope_l(info.density)
    published = ABOVE if info.density > CROSSING else NEAR
    if v is None:
        return Row(f'{quantity} against c_L', published)
    remark = (
        f'v / c_L = {v / slope:.3f} with the paper\'s c_L = {slope:.3f} '
        f'+-{100 * paper.FIT_ACCURACY:g} %'
    )
    own = [step for _, step in steps.resolved_lp(recording.steps)] if recording.steps else []
    if own:
        remark += f', {v * own[0].wave_number / own[0].exponent:.3f} with our {steps.name(own[0])}'
    return Row(
        f'{quantity} against c_L',
        published,
        _word(v - slope, paper.FIT_ACCURACY * slope, SIGMAS * error),
        remark=remark,
    )


def _word(off, scatter, uncertain):
    """None where v is known less well than the slope, and so not told from it."""
    if abs(off) > scatter + uncertain:
        return ABOVE if off > 0 else BELOW
    return NEAR if uncertain <= scatter else None
