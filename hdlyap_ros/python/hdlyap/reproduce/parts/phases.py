"""Part 7: in the periodic system every phase turns evenly, at a rate in proportion to its wave
number."""

import numpy as np

from hdlyap.plots import steps, waves
from hdlyap.plots.figures import phases as figure_of_phases
from hdlyap.plots.phases import regression

from .. import rotation
from ..row import Claim, Row, Scatter
from ..velocity import over_slope

TITLE = 'Phases of LP pairs of the periodic system; their rate in proportion to k'
RUN = 'periodic'
WINDOW = 50.0  # over which a phase that diffuses is compared with even turning [time units]
KEPT = 200  # of a curve in the table
SHORTEST = 10  # reports in it
PRECISE = 2.0  # %: one of the steps may be off by so much without being seen
MODULATIONS = ('cos cos', 'sin cos', 'cos sin', 'sin sin')


def runs(plan):
    return [RUN]


def claims(bags):
    bag = bags[RUN]
    turning = rotation.read(bag).values()
    line = Line(turning)
    yield Claim(
        'omega is in proportion to k',
        [Scatter('omega / k of the LP steps about their mean', *line.scatter, PRECISE)],
        'chi^2 from our errors',
    )
    yield Claim(
        'velocity', [*_velocity_rows(turning, line), over_slope('v', *line.v, bag.recording)]
    )
    yield Claim(
        f'phases, rms about even turning over {WINDOW:g} time units',
        [
            Row(name, None, rms, error, unit='% of 2 pi', remark=whole)
            for name, rms, error, whole in _fluctuations(bag.recording)
        ],
    )


def _velocity_rows(turning, line):
    for one in turning:
        v, error = one.velocity()
        yield Row(
            f'omega / k of {one.name}',
            None,
            v,
            error,
            unit='sigma/time unit',
            remark=f'k = {one.wave_number:.5f}{line.remark(v, error)}',
        )
    yield Row('v, common', None, *line.v, unit='sigma/time unit')


class Line:
    """omega = v k through the origin, weighted with the errors of the steps. v: (value, error);
    scatter: (chi^2, freedom, errors in percent)."""

    def __init__(self, turning):
        found = [one.velocity() for one in turning]
        known = np.array([pair for pair in found if pair[0] and pair[1] > 0]).reshape(-1, 2)
        self.v, self.scatter = (None, 0.0), (None, 0, [])
        if len(known) < 2:
            return
        weights = known[:, 1] ** -2
        v = float(np.average(known[:, 0], weights=weights))
        chi2, freedom = float(np.sum(((known[:, 0] - v) / known[:, 1]) ** 2)), len(known) - 1
        # where the steps scatter more than their errors allow, the error grows
        self.v = v, float(np.sqrt(max(1.0, chi2 / freedom) / weights.sum()))
        self.scatter = chi2, freedom, list(100 * known[:, 1] / known[:, 0])

    def remark(self, v, error):
        if not (self.v[0] and error):
            return ''
        return f', {(v - self.v[0]) / error:+.1f} standard errors from the common v'


def _fluctuations(recording):
    """(step and pair, rms deviation from even turning in percent of a turn, its standard error,
    that of the longest curve as text)."""
    curves, last = {}, recording.phases.last
    for number, phase in enumerate(last.phases if last else ()):
        of_pair = curves.setdefault((phase.step, phase.nx, phase.ny, phase.modulation), [])
        of_pair += recording.phases.curves(number)
    for (_, nx, ny, bits), found in curves.items():
        squares = [square for curve in found for square in _windows(*curve)]
        if squares:
            time, phase = max(found, key=lambda curve: curve[0][-1] - curve[0][0])
            whole = (
                f'{_square(time, phase) ** 0.5:.1f} % over the {time[-1] - time[0]:.0f} '
                'of the longest curve'
            )
            rms, error = _root(squares, _length(recording) / WINDOW)
            yield f'LP({nx},{ny}), {waves.plain_formula(nx, ny, bits)}', rms, error, whole


def _thinned(times, course):
    every = -(-len(times) // KEPT)
    return zip(times[::every], course[::every])


def _windows(time, phase):
    """Mean squares of as many whole windows as there are."""
    count = int((time[-1] - time[0]) / WINDOW)
    edges = np.searchsorted(time, time[0] + WINDOW * np.arange(count + 1))
    return [_square(time[a:b], phase[a:b]) for a, b in zip(edges, edges[1:]) if b - a > SHORTEST]


def _square(time, phase):
    """Mean square of the deviation from even turning, in percent of a turn."""
    return np.mean((100 * (phase - regression(time, phase)) / (2 * np.pi)) ** 2)


def _length(recording):
    return recording.steps.averaged_time if recording.steps else WINDOW


def _root(squares, independent):
    """(root of the mean, its standard error): vectors fluctuate together, what is independent are
    times. 0: not known, of fewer than two of those."""
    mean = float(np.mean(squares))
    error = np.std(squares) / np.sqrt(independent - 1) if independent >= 2 else 0.0
    return mean**0.5, float(0.5 * error / mean**0.5) if mean else 0.0


def figures(bags):
    speeds = {one.name: one.velocity() for one in rotation.read(bags[RUN]).values()}
    figure = figure_of_phases.draw(
        bags[RUN].recording, {name: v for name, v in speeds.items() if v[0]}
    )
    if figure is not None:
        yield 'phases', figure


def tables(bags):
    """The phases that the figure shows, thinned."""
    recording = bags[RUN].recording
    lines = [
        (
            steps.name(recording.steps.steps[step]),
            last[number].index,
            MODULATIONS[last[number].modulation],
            f'{time:.6g}',
            f'{phase:.4f}',
        )
        for last in [recording.phases.last and recording.phases.last.phases]
        for step, numbers in figure_of_phases.chosen(recording)
        for number in numbers
        for times, course in recording.phases.curves(number)
        for time, phase in _thinned(times, course)
    ]
    yield 'phases', ('step', 'index', 'modulation', 'time', 'phase'), lines
