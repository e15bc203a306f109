"""Part 6: between reflecting walls an LP mode turns between L and P."""

from math import isfinite

import numpy as np

from hdlyap.plots.figures import modes
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, plt, scene
from hdlyap.numbers import with_error
from hdlyap.data.reader import FIELD
from hdlyap.data.steps import LP, name as step_name

from .. import blocks, rotation, slopes
from ..files import cells
from ..row import Row

RUN = 'reflecting'
PERIODIC = 'periodic'
QUARTER = 3.20  # of a period, as its two snapshots are apart [time units]
WAVES = {(1, 0): 'the text\'s wave', (1, 1): 'the caption\'s wave'}
SNAPSHOTS = 2  # of a wave in the figure
SHOWN = 13.0  # of the course of (a, b): about a period [time units]
SAME = 0.01  # part of the time between fields that two times called the same differ by at most
UNIT = 'time units'


def _quarters(bags):
    """{wave: Quarters}"""
    turning = rotation.read(bags[RUN])
    return {wave: Quarters(turning.get(wave), bags[RUN].info) for wave in WAVES}


def quarter(bags):
    for wave, one in _quarters(bags).items():
        remark = f'{WAVES[wave]}; {one.remark}' if one.mean else ''
        yield Row(f'quarter period of {_name(wave)}', QUARTER, one.mean, one.error, UNIT, remark)


def single(bags):
    yield _of_the_whole_side(bags)
    for wave, one in _quarters(bags).items():
        remark = f'3.20 is {one.off:.1f} of them from the mean' if one.spread else ''
        quantity = f'standard deviation of {_name(wave)}'
        yield Row(quantity, None, one.spread, one.spread_error, UNIT, remark)
        for name, mean, error in _uneven(one):
            yield Row(f'{_name(wave)} from {name}', None, mean, error, UNIT)


def _of_the_whole_side(bags):
    """What 3.20 would be of the periodic v, and the whole side for half of a wave length."""
    row = Row('L_x / 2 v, v of the periodic run', unit=UNIT)
    recording = bags[PERIODIC].recording
    v, error, count = slopes.velocity(recording, 1, 0)
    if count and isfinite(error):
        row.measured = float(recording.info.box_x / (2 * v))
        row.error = float(row.measured * error / v)
        row.remark = 'the paper\'s 3.20 may come from here'
    return row


def strength(bags):
    turning = rotation.read(bags[RUN])
    for wave, remark in WAVES.items():
        size = turning[wave].strength() if wave in turning else (None, 0.0)
        yield Row(f'a^2 + b^2 of {_name(wave)}, mean', 1.0, *size, remark=remark)


def signs(bags):
    """An L mode turns to P if omega > 0."""
    for name in (RUN, PERIODIC):
        for one in rotation.read(bags[name]).values():
            omega, error = one.omega()
            yield Row(f'omega of {one.name}, {name}', None, omega, error, 'rad/time unit')


def _name(wave):
    return 'LP({},{})'.format(*wave)


class Quarters:
    """Quarter period of a step: pi / 2 over its mean rate, and how single quarters of single
    vectors scatter."""

    def __init__(self, turning, info):
        self.mean = self.spread = None
        self.of_vector = []  # (from L, time) of each
        self.error = self.spread_error = 0.0
        self.remark = ''
        omega, error = turning.omega() if turning else (None, 0.0)
        if omega is None:
            return
        self.mean = rotation.QUARTER / abs(omega)
        self.error = self.mean * error / abs(omega)
        self._measure_spread(turning)
        k = turning.wave_number
        self.remark = (
            f'k = {k:.5f}, omega / k = {with_error(abs(omega) / k, error / k)}; '
            f'3.20 is {100 * (QUARTER / self.mean - 1):+.1f} % off; '
            f'{self._in_whole_box(turning, info):.3f} if centres reached the walls'
        )

    def _in_whole_box(self, turning, info):
        """The quarter period of this v at wave numbers pi n / L: what a box would have whose edges
        are counted between the centres."""
        whole = np.pi * np.hypot(turning.nx / info.box_x, turning.ny / info.box_y)
        return self.mean * turning.wave_number / whole

    def _measure_spread(self, turning):
        self.of_vector = [_quarters_of(turning, column) for column in range(turning.phase.shape[1])]
        single = np.concatenate([times for _, times in self.of_vector])
        if len(single) < blocks.BLOCKS:
            return
        variance, error = blocks.mean((single - single.mean()) ** 2)
        # one vector is the other turned: they scatter together, as one
        error *= np.sqrt(sum(len(times) > 0 for _, times in self.of_vector))
        self.spread = float(np.sqrt(variance))
        self.spread_error = 0.5 * error / self.spread if self.spread else 0.0

    @property
    def off(self):
        """How far 3.20 is from the mean, in standard deviations of single quarters; None if those
        are not known."""
        return abs(QUARTER - self.mean) / self.spread if self.spread else None


def _quarters_of(turning, column):
    found = [
        rotation.quarters(turning.time[piece], turning.phase[piece, column])
        for piece in rotation.stretches(np.isfinite(turning.phase[:, [column]]))
    ]
    return (
        tuple(np.concatenate([[], *parts]) for parts in zip(*found))
        if found
        else (np.zeros(0), np.zeros(0))
    )


def _uneven(one):
    """(which quarters of which vector, mean, standard error): a vector does not turn evenly within
    a period."""
    for number, (from_l, times) in enumerate(one.of_vector, start=1):
        for name, which in (('L to P', from_l > 0), ('P to -L', from_l == 0)):
            mean, error = blocks.mean(times[which])
            if mean is not None:
                yield f'{name}, vector {number}', mean, error


def figures(bags):
    bag = bags[RUN]
    turning = rotation.read(bag)
    if any(wave in turning for wave in WAVES):
        yield 'circle', _circles(bag.info, turning)
    snapshots = [one for wave in WAVES for one in _chosen(bag, turning.get(wave))]
    if snapshots:
        figure = modes.draw_panels(snapshots, bag.info)
        apart = f'fields {QUARTER:.2f} apart, the nearest to L and P that were recorded'
        figure.suptitle(f'{scene(bag.info)}, {apart}', fontsize=9)
        yield 'quarters', figure


def tables(bags):
    turning = rotation.read(bags[RUN])
    yield 'phases', ('wave', 'time', 'vector', 'a', 'b', 'phase'), [
        cells('s .6g s .4f .4f .4f', _name(wave), one.time[at], column, z.real, z.imag, phase)
        for wave, one in [(wave, turning[wave]) for wave in WAVES if wave in turning]
        for piece, column in [_course(one)]
        for at in range(piece.start, piece.stop)
        for z, phase in [(one.z[at, column], one.phase[at, column])]
    ]


# ---- (a, b) on the unit circle -------------------------------------------------------------


def _circles(info, turning):
    waves = [wave for wave in WAVES if wave in turning]
    size = 3.6 * len(waves), 4.0
    figure, row = plt.subplots(1, len(waves), figsize=size, squeeze=False, constrained_layout=True)
    circle = np.exp(1j * np.linspace(0, 2 * np.pi, 200))
    for axes, wave in zip(row.flat, waves):
        one = turning[wave]
        axes.plot(circle.real, circle.imag, color=GREY, linewidth=0.8)
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
    figure.suptitle(scene(info), fontsize=9)
    return figure


def _course(one):
    """(rows, column) of the first stretch of one vector that is as long as what is shown, or as can
    be."""
    known = [
        (piece, column)
        for column in range(one.z.shape[1])
        for piece in rotation.stretches(np.isfinite(one.z[:, [column]]))
    ]

    def length(found):
        return min(SHOWN, one.time[found[0]][-1] - one.time[found[0]][0])

    piece, column = max(known, default=(slice(0, 0), 0), key=length)
    if not piece.stop:
        return piece, column
    end = np.searchsorted(one.time, one.time[piece.start] + SHOWN, side='right')
    return slice(piece.start, min(piece.stop, end)), column


# ---- fields a quarter period apart ---------------------------------------------------------


class Snapshot(modes.Panel):
    """A field with its place on the circle."""

    def __init__(self, field, z):
        super().__init__(field)
        self.z = z

    @property
    def title(self):
        place = f'$a={self.z.real:.2f}$, $b={self.z.imag:.2f}$'
        return f'{step_name(self.field)}, $t={self.field.sim_time:.1f}$: {place}'

    @property
    def colour(self):
        return VERMILION


def _chosen(bag, one):
    """Two fields of one vector, QUARTER apart, nearest to L and P: the snapshots of the paper."""
    series = _fields(bag, one) if one else {}
    times = sorted(series)
    best, chosen = -np.inf, []
    for time in times:
        some = [_at(times, time + number * QUARTER) for number in range(SNAPSHOTS)]
        if None in some or len({series[at].field.index for at in some}) > 1:
            continue
        score = sum(
            (series[at].z * np.exp(-1j * number * rotation.QUARTER)).real
            for number, at in enumerate(some)
        )
        if score > best:
            best, chosen = score, some
    return [series[time] for time in chosen]


def _at(times, wanted):
    near = min(times, key=lambda time: abs(time - wanted))
    return near if abs(near - wanted) <= SAME * QUARTER else None


def _fields(bag, one):
    """{time: Snapshot} of the step where its coefficients are known."""
    found = {}
    for field in bag.messages(FIELD):
        if (field.kind, field.nx, field.ny) != (LP, one.nx, one.ny):
            continue
        at = int(np.argmin(np.abs(one.time - field.sim_time)))
        columns = np.flatnonzero((one.index[at] == field.index) & np.isfinite(one.phase[at]))
        if len(columns) and abs(one.time[at] - field.sim_time) <= SAME * QUARTER:
            # as the field has them, without the sign that makes a phase continuous
            found[field.sim_time] = Snapshot(
                field, complex(one.a[at, columns[0]], one.b[at, columns[0]])
            )
    return found
