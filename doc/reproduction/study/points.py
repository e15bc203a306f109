"""Recording -> steps of its branches as points: wave number, exponent, slope lambda / k, with
errors. And curves through such steps of several runs."""

from collections import namedtuple

import numpy as np

from hdlyap.data import dispersion, phases, steps
from hdlyap.numbers import known

from .stairs import stairs

SAME = 1e-9  # relative: wave numbers of a square box
SYMBOLS = {'T': 'c_T', 'LP': 'c_L'}
KINDS = {'T': steps.T, 'LP': steps.LP}
COUNTS = {'T': 2, 'LP': 4}  # exponents of the smallest steps of a periodic box that is not square


class Point(namedtuple('Point', 'name k exponent error indices note shares skipped')):
    """A step of one run. indices: of its vectors. shares: steps of another kind or wave number that
    have them too, so that its exponent is a mixture. skipped: steps of its kind with a smaller wave
    number that were not resolved, where the smallest was asked for."""

    @property
    def slope(self):
        """(lambda / k, its error); -1 while not yet known."""
        return self.exponent / self.k, self.error / self.k if self.error > 0 else -1.0

    @property
    def remark(self):
        """What is to be known of how it was found."""
        shares = self.shares and f'shares its vectors with {" ".join(self.shares)}'
        skipped = self.skipped and f'{" ".join(self.skipped)} not resolved'
        return '; '.join(filter(None, (self.note, shares, skipped)))


def resolved(recording, kind):
    found = steps.resolved(recording.steps).values()
    return [step for step in found if step.kind == KINDS[kind]]


def find(recording, kind, nx, ny):
    """The step of this kind and these nodes; None if it is not resolved."""
    found = resolved(recording, kind)
    return _point(recording, [step for step in found if (step.nx, step.ny) == (nx, ny)])


def smallest(recording, kind):
    """The resolved step of this kind with the smallest wave number; in a square box x and y
    together."""
    found = resolved(recording, kind)
    most = min((step.wave_number for step in found), default=0.0) * (1 + SAME)
    skipped = [
        steps.name(step)
        for step in (steps.unresolved(recording.steps) if found else ())
        if step.kind == KINDS[kind] and step.expected and step.wave_number <= most
    ]
    return _point(recording, [step for step in found if step.wave_number <= most], skipped)


def every(recording, kind):
    """All steps of this kind that have vectors of their own."""
    found = resolved(recording, kind)
    return own([find(recording, kind, one.nx, one.ny) for one in found])


def _point(recording, found, skipped=()):
    """Of steps with the same wave number; they fluctuate together, so the largest error is that of
    their mean."""
    if not found:
        return None
    weights = [step.multiplicity for step in found]
    others = {
        steps.name(step)
        for step in recording.steps.steps
        for one in found
        if step.resolved and step.set == one.set and not _is_alike(step, one)
    }
    return Point(
        '+'.join(steps.name(one) for one in found),
        found[0].wave_number,
        float(np.average([step.exponent for step in found], weights=weights)),
        max(one.std_error for one in found),
        sorted({i for one in found for i in range(one.first_index, one.last_index + 1)}),
        *('', sorted(others), skipped),
    )


def _is_alike(step, other):
    """Of one branch and wave number, as x and y of a square box."""
    same = abs(step.wave_number / other.wave_number - 1) <= SAME
    return step.kind == other.kind and same


def first(recording, kind):
    """The step of (1,0), found or by its degeneracy."""
    return find(recording, kind, 1, 0) or _by_index(recording, kind)


def _by_index(recording, kind):
    """The step of (1,0) that was not resolved, by its degeneracy alone: the first stair, from the
    smallest exponent on, of as many exponents as it has that no other step is found in; None if a
    stair before it has a number that belongs to neither branch, or exponents of another step among
    others: those could be any."""
    every = recording.steps.steps if recording.steps else ()
    waves = (one for one in every if (one.kind, one.nx, one.ny) == (KINDS[kind], 1, 0))
    wave, named = next(waves, None), steps_indices(recording)
    for stair in stairs(recording) if wave and recording.spectrum else ():
        inside = set(range(stair.first, stair.last + 1))
        if inside <= named:
            continue
        if not inside & named and stair.count == COUNTS[kind]:
            return _of_stair(recording.spectrum, wave, stair)
        if inside & named or stair.count not in COUNTS.values():
            return None
    return None


def steps_indices(recording):
    blocks = steps.blocks(recording.steps)
    return {index for block in blocks for index in range(block.first, block.last + 1)}


def _of_stair(spectrum, wave, stair):
    inside = slice(stair.first - spectrum.first_index, stair.last + 1 - spectrum.first_index)
    errors = known(spectrum.std_errors[inside])
    error = float(errors.max()) if np.isfinite(errors).all() else -1.0
    note = f'not resolved; by its {stair.count} equal exponents {stair.first}-{stair.last}'
    exponent = float(np.mean(spectrum.exponents[inside]))
    indices = range(stair.first, stair.last + 1)
    return Point(steps.name(wave), wave.wave_number, exponent, error, indices, note, (), ())


# ---- several of them -----------------------------------------------------------------------------


def own(points):
    """Those of this branch alone, with known errors."""
    return [point for point in points if point is not None and point.error > 0 and not point.shares]


def noted(points):
    """How many of the points share vectors, or are not the smallest step of their run; empty if
    none does."""
    points = [point for point in points if point is not None]
    shared = sum(bool(point.shares) for point in points), 'share vectors'
    skipped = sum(bool(one.skipped) for one in points), 'beyond a smaller step that is not resolved'
    return '; '.join(f'{count} of them {text}' for count, text in (shared, skipped) if count)


def curve(points):
    """The dispersion relation of what is no mixture; None if there are not two wave numbers with
    known errors."""
    points = own(points)
    k, exponents, errors = ([getattr(one, name) for one in points] for name in Point._fields[1:4])
    return dispersion.Curve(k, exponents, errors) if dispersion.number_of(k) > 1 else None


def span(points):
    """Smallest and largest wave number of a curve; None without points."""
    k = [point.k for point in own(points)]
    return (min(k), max(k)) if k else None


def common(spans):
    """The range that two ranges have in common; its end before its beginning if there is none."""
    if None in spans:
        return 1.0, 0.0
    return max(low for low, _ in spans), min(high for _, high in spans)


def above(curves, spans):
    """(percent by which the second curve is above the first one, its error, ends of the wave
    numbers that both have); None if they have none."""
    (low, high), curves = common(spans), list(curves)
    if None in curves or low >= high:
        return None
    difference, error = dispersion.mean_difference(*curves, low, high)
    return 100 * difference, 100 * error, low, high


def velocity(recording, nx, ny):
    """(v, its error, number of phases): |omega| / k of the LP step of these nodes, as its phases
    were last; NaN if nothing is tracked."""
    last, message = recording.phases.last, recording.steps
    every = message.steps if message else ()
    waves = (one for one in every if one.kind == steps.LP and not one.conjugate)
    wave = next((one for one in waves if (one.nx, one.ny) == (nx, ny)), None)
    if last is None or wave is None:
        return np.nan, np.nan, 0
    known = [phase for phase in last.phases if (phase.nx, phase.ny) == (nx, ny)]
    omega, error, count = phases.turning(wave, known)
    return omega / wave.wave_number, error / wave.wave_number, count
