"""Part 7: in the periodic system every phase turns evenly, at a rate in proportion to its wave number."""

import numpy as np

from hdlyap_plots import steps, waves
from hdlyap_plots.figures import phases as figure_of_phases
from hdlyap_plots.phases import regression

from .. import rotation
from ..row import SIGMAS, Row
from ..velocity import against_slope

TITLE = 'Phases of LP pairs of the periodic system; their rate in proportion to k'
RUN = 'periodic'
HOLDS, FAILS = 'yes', 'no'
WINDOW = 50.0       # over which a phase that diffuses is compared with even turning [time units]
SHORTEST = 10       # reports in it
MODULATIONS = ('cos cos', 'sin cos', 'cos sin', 'sin sin')


def runs(plan):
    return [RUN]


def rows(bags):
    bag = bags[RUN]
    turning = rotation.read(bag)
    line = Line(turning.values())
    for one in turning.values():
        omega, error = one.omega()
        yield Row(f'omega of {one.name}', None, omega, error, unit='rad/time unit', remark=f'k = {one.wave_number:.5f}')
    for one in turning.values():
        v, error = one.velocity()
        yield Row(f'omega / k of {one.name}', None, v, error, unit='sigma/time unit', remark=line.remark(one))
    yield Row('omega in proportion to k', HOLDS, line.holds,
              remark=f'every omega / k within {SIGMAS:g} standard errors of the common v')
    yield Row('chi^2 / freedom of omega = v k', None, line.chi2, remark=f'{line.count - 1} degrees of freedom')
    yield Row('v, common', None, line.v, line.error, unit='sigma/time unit')
    yield against_slope('v', line.v, line.error, bag.recording)
    for name, rms, error in _fluctuations(bag.recording):
        yield Row(f'phase fluctuation of {name}', None, rms, error, unit='% of 2 pi',
                  remark=f'rms about even turning, over windows of {WINDOW:g} time units')


class Line:
    """omega = v k through the origin, weighted with the errors of the steps."""

    def __init__(self, turning):
        found = [one.velocity() for one in turning]
        known = np.array([pair for pair in found if pair[0] and pair[1] > 0]).reshape(-1, 2)
        self.count = len(known)
        self.v = self.chi2 = self.holds = None
        self.error = 0.0
        if self.count < 2:
            return
        weights = known[:, 1] ** -2
        self.v = float(np.average(known[:, 0], weights=weights))
        off = (known[:, 0] - self.v) / known[:, 1]
        self.chi2 = float(np.sum(off ** 2) / (self.count - 1))
        # where the steps scatter more than their errors allow, the error grows
        self.error = float(np.sqrt(max(1.0, self.chi2) / weights.sum()))
        self.holds = HOLDS if (np.abs(off) <= SIGMAS).all() else FAILS

    def remark(self, one):
        v, error = one.velocity()
        return f'{(v - self.v) / error:+.1f} standard errors from the common v' if self.v and error else ''


def _fluctuations(recording):
    """(step and pair, rms deviation from even turning in percent of a turn, its standard error)."""
    squares, last = {}, recording.phases.last
    for number, phase in enumerate(last.phases if last else ()):
        of_pair = squares.setdefault((phase.step, phase.nx, phase.ny, phase.modulation), [])
        for time, course in recording.phases.curves(number):
            of_pair += _windows(time, course)
    for (_, nx, ny, bits), found in squares.items():
        if found:
            yield f'LP({nx},{ny}), {waves.plain_formula(nx, ny, bits)}', *_root(found, _length(recording) / WINDOW)


def _windows(time, phase):
    """Mean squares of the deviation, in percent of a turn, of as many whole windows as there are."""
    count = int((time[-1] - time[0]) / WINDOW)
    edges = np.searchsorted(time, time[0] + WINDOW * np.arange(count + 1))
    return [np.mean((100 * (phase[a:b] - regression(time[a:b], phase[a:b])) / (2 * np.pi)) ** 2)
            for a, b in zip(edges, edges[1:]) if b - a > SHORTEST]


def _length(recording):
    return recording.steps.averaged_time if recording.steps else WINDOW


def _root(squares, independent):
    """(root of the mean, its standard error): vectors fluctuate together, what is independent are times."""
    mean = float(np.mean(squares))
    error = np.std(squares) / np.sqrt(max(1.0, independent - 1))
    return mean ** 0.5, float(0.5 * error / mean ** 0.5) if mean else 0.0


def figures(bags):
    figure = figure_of_phases.draw(bags[RUN].recording)
    if figure is not None:
        yield 'phases', figure


def tables(bags):
    """The phases that the figure shows."""
    recording = bags[RUN].recording
    lines = [(steps.name(recording.steps.steps[step]), last[number].index, MODULATIONS[last[number].modulation],
              f'{time:.6g}', f'{phase:.4f}')
             for last in [recording.phases.last and recording.phases.last.phases]
             for step, numbers in figure_of_phases.chosen(recording) for number in numbers
             for times, course in recording.phases.curves(number) for time, phase in zip(times, course)]
    yield 'phases', ('step', 'index', 'modulation', 'time', 'phase'), lines
