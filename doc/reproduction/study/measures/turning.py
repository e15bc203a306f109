"""How LP modes turn between L and P, and how T modes stay: one run between walls, one periodic."""

from math import isfinite

import matplotlib.pyplot as plt
import numpy as np

from hdlyap.data import steps, waves
from hdlyap.data.phases import regression
from hdlyap.data.reader import FIELD
from hdlyap.numbers import with_error
from hdlyap.plots import paper
from hdlyap.plots.figures import modes
from hdlyap.plots.figures import phases as figure_of_phases
from hdlyap.plots.figures.page import Page
from hdlyap.plots.figures.style import BLUE, GREY, INK, MEMBER_COLOURS, VERMILION, scene

from .. import averages, blocks, points, rotation, standing
from ..averages import UNKNOWN
from ..row import TELLING, Row, Scatter

QUARTER = 3.20  # of a period, as its two snapshots are apart [time units]
WAVES = {(1, 0): 'the text\'s wave', (1, 1): 'the caption\'s wave'}
SHOWN = 13.0  # of the course of (a, b): about a period [time units]
SAME = 0.01  # part of the time between fields that two times called the same differ by at most
WINDOW = 50.0  # over which a phase that diffuses is compared with even turning [time units]
SHORTEST = 10  # reports in it
SHOWN_TURNS = 2  # of an LP mode beside the T modes
TIME, SPEED = 'time units', 'sigma/time unit'


# ---- quarter turns between walls -----------------------------------------------------------------


class Quarters:
    """Quarter period of a step: pi / 2 over its mean rate, and how single quarters of single
    vectors scatter."""

    def __init__(self, turning, info):
        self.mean = self.spread = UNKNOWN
        self.of_vector, self.remark = [], ''  # (from L, time) of each
        omega, error = turning.omega() if turning else UNKNOWN
        if omega is None:
            return
        mean, size, k = rotation.QUARTER / abs(omega), abs(omega), turning.wave_number
        self.mean = mean, mean * error / size
        self.of_vector = [_quarters_of(turning, column) for column in range(turning.phase.shape[1])]
        self.spread = self._spread()
        # what a box would have whose edges are counted between the centres
        whole = np.pi * np.hypot(turning.nx / info.box_x, turning.ny / info.box_y)
        self.remark = (
            f'k = {k:.5f}, omega / k = {with_error(size / k, error / k)}; '
            f'3.20 is {100 * (QUARTER / mean - 1):+.1f} % off; '
            f'{mean * k / whole:.3f} if centres reached the walls'
        )

    def _spread(self):
        single = np.concatenate([times for _, times in self.of_vector])
        if len(single) < blocks.BLOCKS:
            return UNKNOWN
        variance, error = blocks.mean((single - single.mean()) ** 2)
        # one vector is the other turned: they scatter together, as one
        error *= np.sqrt(sum(len(times) > 0 for _, times in self.of_vector))
        spread = float(np.sqrt(variance))
        return spread, 0.5 * error / spread if spread else 0.0

    def uneven(self):
        """(which quarters of which vector, mean, standard error): a vector does not turn evenly
        within a period."""
        for number, (from_l, times) in enumerate(self.of_vector, start=1):
            for name, which in (('L to P', from_l > 0), ('P to -L', from_l == 0)):
                mean, error = blocks.mean(times[which])
                if mean is not None:
                    yield f'{name}, vector {number}', mean, error


def _quarters_of(turning, column):
    pieces = rotation.stretches(np.isfinite(turning.phase[:, [column]]))
    found = [rotation.quarters(turning.time[one], turning.phase[one, column]) for one in pieces]
    return [np.concatenate([[], *(one[part] for one in found)]) for part in (0, 1)]


def _quarters(bag):
    """(name, what the paper calls it, Quarters) of both waves"""
    turning = rotation.read(bag)
    for wave, called in WAVES.items():
        yield 'LP({},{})'.format(*wave), called, Quarters(turning.get(wave), bag.info)


def quarter(bags):
    for name, called, one in _quarters(bags[0]):
        remark = f'{called}; {one.remark}' if one.remark else ''
        yield Row(f'quarter period of {name}', QUARTER, *one.mean, TIME, remark)


def single(bags):
    yield _of_the_whole_side(bags[1].recording)
    for name, _, one in _quarters(bags[0]):
        spread = one.spread[0]
        off = spread and f'3.20 is {abs(QUARTER - one.mean[0]) / spread:.1f} of them from the mean'
        yield Row(f'standard deviation of {name}', None, *one.spread, TIME, off or '')
        for which, *mean in one.uneven():
            yield Row(f'{name} from {which}', None, *mean, TIME)


def _of_the_whole_side(recording):
    """What 3.20 would be of the periodic v, and the whole side for half of a wave length."""
    row = Row('L_x / 2 v, v of the periodic run', unit=TIME)
    v, error, count = points.velocity(recording, 1, 0)
    if count and isfinite(error):
        row.measured = float(recording.info.box_x / (2 * v))
        row.error = float(row.measured * error / v)
        row.remark = 'the paper\'s 3.20 may come from here'
    return row


def strength(bags):
    turning = rotation.read(bags[0])
    for wave, called in WAVES.items():
        size = turning[wave].strength() if wave in turning else UNKNOWN
        yield Row('a^2 + b^2 of LP({},{}), mean'.format(*wave), 1.0, *size, remark=called)


def signs(bags):
    """An L mode turns to P if omega > 0."""
    for bag in bags:
        for one in rotation.read(bag).values():
            quantity = f'omega of {one.name}, {bag.info.boundary_x}'
            yield Row(quantity, None, *one.omega(), 'rad/time unit')


def circle(bags):
    """Picture of (a, b)."""
    turning = rotation.read(bags[0])
    found = [turning[wave] for wave in WAVES if wave in turning]
    if not found:
        return None
    size = 3.6 * len(found), 4.0
    figure, row = plt.subplots(1, len(found), figsize=size, squeeze=False, constrained_layout=True)
    unit = np.exp(1j * np.linspace(0, 2 * np.pi, 200))
    for axes, one in zip(row.flat, found):
        axes.plot(unit.real, unit.imag, color=GREY, linewidth=0.8)
        every = {'color': BLUE, 'markersize': 1, 'alpha': 0.35, 'rasterized': True}
        a, b = one.z.real.ravel(), one.z.imag.ravel()
        axes.plot(a, b, '.', label='both vectors, all times', **every)
        piece, column = _course(one)
        z, time = one.z[piece, column], one.time[piece]
        label = f'{time[-1] - time[0]:.1f} time units of one'
        axes.plot(z.real, z.imag, '.-', color=VERMILION, markersize=3, linewidth=0.7, label=label)
        axes.set(aspect='equal', xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), title=one.name)
        axes.set(xlabel='$a$  (on the L field)', ylabel='$b$  (on the P field)')
    row.flat[0].legend(loc='center', fontsize=7, markerscale=1.5)
    figure.suptitle(scene(bags[0].info), fontsize=9)
    return figure


def _course(one):
    """(rows, column) of the first stretch of one vector that is as long as what is shown, or as can
    be."""

    def length(found):
        return min(SHOWN, one.time[found[0]][-1] - one.time[found[0]][0])

    columns = range(one.z.shape[1])
    known = [(column, rotation.stretches(np.isfinite(one.z[:, [column]]))) for column in columns]
    known = [(piece, column) for column, pieces in known for piece in pieces]
    piece, column = max(known, default=(slice(0, 0), 0), key=length)
    if not piece.stop:
        return piece, column
    end = np.searchsorted(one.time, one.time[piece.start] + SHOWN, side='right')
    return slice(piece.start, min(piece.stop, end)), column


class Snapshot(modes.Panel):
    """A field with its place on the circle."""

    colour = VERMILION

    def __init__(self, field, info, z):
        super().__init__(field, info)
        self.z = z

    @property
    def title(self):
        place = f'$a={self.z.real:.2f}$, $b={self.z.imag:.2f}$'
        return f'{steps.name(self.field)}, $t={self.field.sim_time:.1f}$: {place}'


def quarters(bags):
    """Picture of fields a quarter of a period apart."""
    bag, turning = bags[0], rotation.read(bags[0])
    shown = [one for wave in WAVES if wave in turning for one in _snapshots(bag, turning[wave])]
    if not shown:
        return None
    page = Page()
    modes.draw_panels(page, shown, bag.info)
    apart = f'fields {QUARTER:.2f} apart, the nearest to L and P that were recorded'
    page.figure.suptitle(f'{scene(bag.info)}, {apart}', fontsize=9)
    return page.figure


def _snapshots(bag, one):
    """Two fields of one vector, QUARTER apart, nearest to L and P: those of the paper."""
    found = _fields(bag, one)
    pairs = [(found[time], found.get(_at(found, time + QUARTER))) for time in sorted(found)]
    pairs = [(one, two) for one, two in pairs if two and one.field.index == two.field.index]
    turned = np.exp(-1j * rotation.QUARTER)
    return max(pairs, default=(), key=lambda pair: pair[0].z.real + (pair[1].z * turned).real)


def _at(times, wanted):
    near = min(times, key=lambda time: abs(time - wanted))
    return near if abs(near - wanted) <= SAME * QUARTER else None


def _fields(bag, one):
    """{time: Snapshot} of the step where its coefficients are known."""
    found = {}
    for field in bag.messages(FIELD):
        if (field.kind, field.nx, field.ny) != (steps.LP, one.nx, one.ny):
            continue
        at = int(np.argmin(np.abs(one.time - field.sim_time)))
        columns = np.flatnonzero((one.index[at] == field.index) & np.isfinite(one.phase[at]))
        if len(columns) and abs(one.time[at] - field.sim_time) <= SAME * QUARTER:
            # as the field has them, without the sign that makes a phase continuous
            z = complex(one.a[at, columns[0]], one.b[at, columns[0]])
            found[field.sim_time] = Snapshot(field, bag.info, z)
    return found


# ---- rates of a periodic run ---------------------------------------------------------------------


def over_slope(quantity, v, recording):
    """Row: v / c_L with our slope of the smallest LP step; with that of the paper's fit as a
    remark."""
    own = [step for _, step in steps.resolved_lp(recording.steps)] if recording.steps else []
    if v[0] is None or not own:
        return Row(f'{quantity} / c_L')
    step, fitted, k = own[0], paper.slope_l(recording.info.density), own[0].wave_number
    ratio = averages.quotient((v[0] * k, v[1] * k), (step.exponent, step.std_error))
    remark = f'c_L of {steps.name(step)}; {v[0] / fitted:.3f} with that of the paper\'s fit'
    return Row(f'{quantity} / c_L', None, *ratio, remark=remark)


def _velocities(bag):
    """[(name, k, (v, its error))] of the LP steps, omega = v k."""
    return [(one.name, one.wave_number, one.velocity()) for one in rotation.read(bag).values()]


def _known(bag):
    found = [v for _, _, v in _velocities(bag) if v[0] and v[1] > 0]
    return found if len(found) > 1 else []


def _common(bag):
    """(v, its error, chi^2) through the origin, weighted with the errors of the steps."""
    known = _known(bag)
    return averages.weighted(*zip(*known)) if known else (*UNKNOWN, None)


def line(bag):
    known, (_, _, chi2) = _known(bag), _common(bag)
    errors = [100 * error / v for v, error in known]
    quantity = 'omega / k of the LP steps about their mean'
    yield Scatter(quantity, chi2, max(0, len(known) - 1), errors)


def velocities(bag):
    *common, _ = _common(bag)
    for name, k, (v, error) in _velocities(bag):
        remark = f'k = {k:.5f}'
        if common[0] and error:
            remark += f', {(v - common[0]) / error:+.1f} standard errors from the common v'
        yield Row(f'omega / k of {name}', None, v, error, SPEED, remark)
    yield Row('v, common', None, *common, SPEED)
    yield over_slope('v', common, bag.recording)


def still(bag):
    """telling: a tenth of v of the LP modes."""
    found, slowest = standing.read(bag).values(), _slowest(bag)
    telling = slowest and TELLING * slowest[2][0]
    for one in found:
        known = one.diffusion[0] is not None
        about = f'D of its phase {with_error(*one.diffusion)} rad^2/time unit' if known else ''
        quantity = f'omega / k of {one.name}'
        yield Row(quantity, 0.0, *one.velocity, SPEED, about, telling=telling)
    if not found:
        yield Row('omega / k of the T steps', 0.0, unit=SPEED)


def _slowest(bag):
    """Of the smallest k whose velocity is known; None without one."""
    known = [one for one in _velocities(bag) if one[2][0]]
    return min(known, key=lambda one: one[1], default=None)


def fluctuations(bag):
    """Rms deviation from even turning in percent of a turn, of each step and pair."""
    recording, curves = bag.recording, {}
    last = recording.phases.last
    for number, phase in enumerate(last.phases if last else ()):
        of_pair = curves.setdefault((phase.step, phase.nx, phase.ny, phase.modulation), [])
        of_pair += recording.phases.curves(number)
    length = recording.steps.averaged_time if recording.steps else WINDOW
    for (_, nx, ny, bits), found in curves.items():
        squares = [square for curve in found for square in _windows(*curve)]
        if squares:
            time, phase = max(found, key=lambda curve: curve[0][-1] - curve[0][0])
            whole = f'{_square(time, phase) ** 0.5:.1f} % over the {time[-1] - time[0]:.0f}'
            quantity = f'LP({nx},{ny}), {waves.plain_formula(nx, ny, bits)}'
            root, remark = _root(squares, length / WINDOW), f'{whole} of the longest curve'
            yield Row(quantity, None, *root, '% of 2 pi', remark)


def _windows(time, phase):
    """Mean squares of as many whole windows as there are."""
    count = int((time[-1] - time[0]) / WINDOW)
    edges = np.searchsorted(time, time[0] + WINDOW * np.arange(count + 1))
    return [_square(time[a:b], phase[a:b]) for a, b in zip(edges, edges[1:]) if b - a > SHORTEST]


def _square(time, phase):
    """Mean square of the deviation from even turning, in percent of a turn."""
    return np.mean((100 * (phase - regression(time, phase)) / (2 * np.pi)) ** 2)


def _root(squares, independent):
    """(root of the mean, its standard error): vectors fluctuate together, what is independent are
    times. 0: not known, of fewer than two of those."""
    mean = float(np.mean(squares))
    error = np.std(squares) / np.sqrt(independent - 1) if independent >= 2 else 0.0
    return mean**0.5, float(0.5 * error / mean**0.5) if mean else 0.0


def phases(bag):
    """Picture of the phases of LP modes."""
    known = {name: v for name, _, v in _velocities(bag) if v[0]}
    page = figure_of_phases.draw(bag.recording, speeds=known)
    return page and page.figure


def phases_of_t(bag):
    """Picture of the phases of T modes, and how fast those of the slowest LP step turn."""
    found, times, slowest = standing.read(bag), [], _slowest(bag)
    if not found:
        return None
    figure, axes = plt.subplots(figsize=(5.6, 3.2), constrained_layout=True)
    axes.axhline(0, color=GREY, linewidth=0.5)
    for (wave, one), colour in zip(found.items(), MEMBER_COLOURS):
        for time, phase in standing.course(bag, wave):
            axes.plot(time, phase / (2 * np.pi), color=colour)
            times += list(time[:1])
        axes.plot([], [], color=colour, label=one.name)
    if slowest and times:
        name, k, (v, _) = slowest
        ends = min(times) + np.array([0, SHOWN_TURNS * 2 * np.pi / (v * k)])
        axes.plot(ends, [0, SHOWN_TURNS], '--', color=INK, label=f'{name} turns')
    axes.set_xlabel('simulated time  [time units]')
    axes.set_ylabel(r'phase $/\,2\pi$')
    axes.legend(loc='upper right')
    figure.suptitle(scene(bag.recording.info), fontsize=9)
    return figure
