"""Recording -> the smallest steps of its branches: wave number, exponent, slope lambda / k, with
errors. And fits through such steps of several runs."""

import numpy as np

from hdlyap.data import dispersion, phases, steps
from hdlyap.numbers import known

from .files import cells
from .stairs import stairs

SAME = 1e-9  # relative: wave numbers of a square box
COLUMNS = 'wave_number', 'exponent', 'std_error', 'slope', 'slope_error'


class Point:
    """A step of one run. members: vectors of its set. shares: steps of another kind or wave number
    that have them too, so that its exponent is a mixture. skipped: steps of its kind with a smaller
    wave number that were not resolved, where the smallest was asked for."""

    def __init__(
        self, name, wave_number, exponent, error, members, remark='', shares=(), skipped=()
    ):
        self.name, self.wave_number = name, wave_number
        self.exponent, self.error = exponent, error
        self.members, self.shares, self.skipped = members, shares, skipped
        self._remark = remark

    @property
    def remark(self):
        """What is to be known of how it was found."""
        return '; '.join(
            filter(
                None,
                (
                    self._remark,
                    self.shares and f'shares its vectors with {" ".join(self.shares)}',
                    self.skipped and f'{" ".join(self.skipped)} not resolved',
                ),
            )
        )

    @property
    def slope(self):
        return self.exponent / self.wave_number

    @property
    def slope_error(self):
        """-1 while not yet known."""
        return self.error / self.wave_number if self.error > 0 else -1.0

    @property
    def cells(self):
        """As in COLUMNS."""
        slope = self.slope, self.slope_error
        return cells('.6g .6g .2g .6g .2g', self.wave_number, self.exponent, self.error, *slope)


def find(recording, kind, nx, ny):
    """The step of this kind and these nodes; None if it is not resolved."""
    return _point(
        recording, [step for step in _resolved(recording, kind) if (step.nx, step.ny) == (nx, ny)]
    )


def smallest(recording, kind):
    """The resolved step of this kind with the smallest wave number; in a square box x and y
    together."""
    found = _resolved(recording, kind)
    least = min((step.wave_number for step in found), default=0.0)
    skipped = [
        steps.name(step)
        for step in (steps.unresolved(recording.steps) if found else ())
        if step.kind == kind and step.expected and step.wave_number <= least * (1 + SAME)
    ]
    return _point(
        recording, [step for step in found if step.wave_number <= least * (1 + SAME)], skipped
    )


def every(recording, kind):
    """All steps of this kind that have vectors of their own."""
    return own([find(recording, kind, one.nx, one.ny) for one in _resolved(recording, kind)])


def noted(points):
    """How many of the points share vectors, or are not the smallest step of their run; empty if
    none does."""
    points = [point for point in points if point is not None]
    counts = (sum(bool(point.shares) for point in points), 'share vectors'), (
        sum(bool(point.skipped) for point in points),
        'beyond a smaller step that is not resolved',
    )
    return '; '.join(f'{count} of them {text}' for count, text in counts if count)


def _resolved(recording, kind):
    return [step for step in steps.resolved(recording.steps).values() if step.kind == kind]


def _point(recording, found, skipped=()):
    """Of steps with the same wave number; they fluctuate together, so the largest error is that of
    their mean."""
    if not found:
        return None
    exponent = np.average(
        [step.exponent for step in found], weights=[step.multiplicity for step in found]
    )
    others = {
        steps.name(step)
        for step in recording.steps.steps
        for one in found
        if step.resolved and step.set == one.set and not _is_alike(step, one)
    }
    vectors = {index for one in found for index in range(one.first_index, one.last_index + 1)}
    return Point(
        '+'.join(steps.name(one) for one in found),
        found[0].wave_number,
        float(exponent),
        max(one.std_error for one in found),
        len(vectors),
        shares=sorted(others),
        skipped=skipped,
    )


def _is_alike(step, other):
    """Of one branch and wave number, as x and y of a square box."""
    same = abs(step.wave_number / other.wave_number - 1) <= SAME
    return step.kind == other.kind and same


def by_index(recording, kind, nx, ny):
    """A step that was not resolved, by its degeneracy alone: the first stair, from the smallest
    exponent on, of as many exponents as it has that no other step is found in; None if a stair
    before it has a number that belongs to neither branch, or exponents of another step among
    others: those could be any. For the smallest steps of a periodic box that is not square: T two
    exponents, LP four."""
    counts = {steps.T: 2, steps.LP: 4}
    wave = next(
        (
            step
            for step in (recording.steps.steps if recording.steps else ())
            if (step.kind, step.nx, step.ny) == (kind, nx, ny)
        ),
        None,
    )
    named = {
        index
        for block in steps.blocks(recording.steps)
        for index in range(block.first, block.last + 1)
    }
    for stair in stairs(recording) if wave and recording.spectrum else ():
        inside = set(range(stair.first, stair.last + 1))
        if inside <= named:
            continue
        if inside & named:
            return None
        if stair.count == counts[kind]:
            return _stair_point(recording, wave, stair)
        if stair.count not in counts.values():
            return None
    return None


def _stair_point(recording, wave, stair):
    spectrum = recording.spectrum
    inside = slice(stair.first - spectrum.first_index, stair.last + 1 - spectrum.first_index)
    errors = known(spectrum.std_errors[inside])
    error = float(errors.max()) if np.isfinite(errors).all() else -1.0
    return Point(
        steps.name(wave),
        wave.wave_number,
        float(np.mean(spectrum.exponents[inside])),
        error,
        stair.count,
        f'not resolved; by its {stair.count} equal exponents {stair.first}-{stair.last}',
    )


def velocity(recording, nx, ny):
    """(v, its error, number of phases): |omega| / k of the LP step of these nodes; NaN if nothing
    is tracked."""
    last, message = recording.phases.last, recording.steps
    wave = next(
        (
            step
            for step in (message.steps if message else ())
            if step.kind == steps.LP and (step.nx, step.ny) == (nx, ny) and not step.conjugate
        ),
        None,
    )
    if last is None or wave is None:
        return np.nan, np.nan, 0
    omega, error, count = phases.turning(
        wave, [phase for phase in last.phases if (phase.nx, phase.ny) == (nx, ny)]
    )
    return omega / wave.wave_number, error / wave.wave_number, count


def curve(points):
    """The dispersion relation of what is no mixture; None if there are not two wave numbers with
    known errors."""
    points = own(points)
    k, exponents, errors = (
        [getattr(point, name) for point in points] for name in ('wave_number', 'exponent', 'error')
    )
    return dispersion.Curve(k, exponents, errors) if dispersion.number_of(k) > 1 else None


def own(points):
    """Those of this branch alone, with known errors."""
    return [point for point in points if point is not None and point.error > 0 and not point.shares]


def above(curves, spans):
    """(percent by which the second curve is above the first one, its error, ends of the wave
    numbers that both have); None if they have none."""
    (low, high), curves = common(spans), list(curves)
    if None in curves or low >= high:
        return None
    difference, error = dispersion.mean_difference(*curves, low, high)
    return 100 * difference, 100 * error, low, high


def common(spans):
    """The range that two ranges have in common; its end before its beginning if there is none."""
    if None in spans:
        return 1.0, 0.0
    return max(low for low, _ in spans), min(high for _, high in spans)


def span(points):
    """Smallest and largest wave number of a curve; None without points."""
    numbers = [point.wave_number for point in own(points)]
    return (min(numbers), max(numbers)) if numbers else None
