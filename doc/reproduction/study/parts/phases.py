"""Part 7: in the periodic system every phase of an LP pair turns evenly, at a rate in proportion to
its wave number; T modes stay where they are."""

import numpy as np

from hdlyap.data import steps, waves
from hdlyap.data.phases import regression
from hdlyap.plots.figures import phases as figure_of_phases
from hdlyap.plots.figures.style import GREY, INK, MEMBER_COLOURS, plt, scene
from hdlyap.numbers import with_error

from .. import averages, rotation, standing
from ..files import cells
from ..row import TELLING, Row, Scatter
from ..velocity import over_slope

RUN = 'periodic'
WINDOW = 50.0  # over which a phase that diffuses is compared with even turning [time units]
KEPT = 200  # of a curve in the table
SHORTEST = 10  # reports in it
SHOWN_TURNS = 2  # of an LP mode beside the T modes
UNIT = 'sigma/time unit'
MODULATIONS = ('cos cos', 'sin cos', 'cos sin', 'sin sin')


def _turning(bags):
    return rotation.read(bags[RUN]).values()


def line(bags):
    yield Scatter('omega / k of the LP steps about their mean', *Line(_turning(bags)).scatter)


def velocities(bags):
    found, line = _turning(bags), Line(_turning(bags))
    for one in found:
        v, error = one.velocity()
        remark = f'k = {one.wave_number:.5f}{line.remark(v, error)}'
        yield Row(f'omega / k of {one.name}', None, v, error, UNIT, remark)
    yield Row('v, common', None, *line.v, UNIT)
    yield over_slope('v', *line.v, bags[RUN].recording)


def still(bags):
    """telling: a tenth of v of the LP modes."""
    found, beside = standing.read(bags[RUN]).values(), _slowest(_turning(bags))
    telling = None if beside is None else TELLING * beside.velocity()[0]
    for one in found:
        diffusion = one.diffusion()
        about = f'D of its phase {with_error(*diffusion)} rad^2/time unit' if diffusion[0] else ''
        quantity = f'omega / k of {one.name}'
        yield Row(quantity, 0.0, *one.velocity(), UNIT, about, telling=telling)
    if not found:
        yield Row('omega / k of the T steps', 0.0, unit=UNIT)


def _slowest(turning):
    """The Rotation of the smallest k whose velocity is known; None without one."""
    known = [one for one in turning if one.velocity()[0]]
    return min(known, key=lambda one: one.wave_number, default=None)


class Line:
    """omega = v k through the origin, weighted with the errors of the steps. v: (value, error);
    scatter: (chi^2, freedom, errors in percent)."""

    def __init__(self, turning):
        found = [one.velocity() for one in turning]
        known = np.array([pair for pair in found if pair[0] and pair[1] > 0]).reshape(-1, 2)
        self.v, self.scatter = (None, 0.0), (None, 0, [])
        if len(known) < 2:
            return
        *self.v, chi2 = averages.weighted(*known.T)
        self.scatter = chi2, len(known) - 1, list(100 * known[:, 1] / known[:, 0])

    def remark(self, v, error):
        if not (self.v[0] and error):
            return ''
        return f', {(v - self.v[0]) / error:+.1f} standard errors from the common v'


def fluctuations(bags):
    """Rms deviation from even turning in percent of a turn, of each step and pair."""
    recording = bags[RUN].recording
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
            quantity = f'LP({nx},{ny}), {waves.plain_formula(nx, ny, bits)}'
            yield Row(quantity, None, rms, error, '% of 2 pi', whole)


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
    speeds = {one.name: one.velocity() for one in _turning(bags)}
    known = {name: v for name, v in speeds.items() if v[0]}
    yield 'phases', figure_of_phases.draw(bags[RUN].recording, known)
    found = standing.read(bags[RUN])
    if found:
        yield 'standing', _figure_of_standing(bags[RUN], found)


def _figure_of_standing(bag, found):
    """Phases of T modes, and how fast those of the slowest LP step turn."""
    figure, axes = plt.subplots(figsize=(5.6, 3.2), constrained_layout=True)
    axes.axhline(0, color=GREY, linewidth=0.5)
    times = []
    for (wave, one), colour in zip(found.items(), MEMBER_COLOURS):
        for time, phase in standing.course(bag, wave):
            axes.plot(time, phase / (2 * np.pi), color=colour)
            times += list(time[:1])
        axes.plot([], [], color=colour, label=one.name)
    beside = _slowest(rotation.read(bag).values())
    if beside is not None and times:
        rate = beside.velocity()[0] * beside.wave_number / (2 * np.pi)
        ends = min(times) + np.array([0, SHOWN_TURNS / rate])
        axes.plot(ends, [0, SHOWN_TURNS], '--', color=INK, label=f'{beside.name} turns')
    axes.set_xlabel('simulated time  [time units]')
    axes.set_ylabel(r'phase $/\,2\pi$')
    axes.legend(loc='upper right')
    figure.suptitle(scene(bag.recording.info), fontsize=9)
    return figure


def tables(bags):
    """The phases that the figure shows, thinned."""
    recording = bags[RUN].recording
    last = recording.phases.last and recording.phases.last.phases
    yield 'phases', ('step', 'index', 'modulation', 'time', 'phase'), [
        cells(
            's s s .6g .4f',
            *(steps.name(recording.steps.steps[step]), last[number].index),
            *(MODULATIONS[last[number].modulation], time, phase),
        )
        for step, numbers in figure_of_phases.chosen(recording)
        for number in numbers
        for times, course in recording.phases.curves(number)
        for time, phase in _thinned(times, course)
    ]
