"""Part 6: between reflecting walls an LP mode turns between L and P."""

import numpy as np

from hdlyap.plots.figures import modes
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, plt, scene
from hdlyap.plots.numbers import with_error
from hdlyap.plots.recording import FIELD
from hdlyap.plots.steps import LP

from .. import blocks, rotation
from ..row import Row

TITLE = 'LP dynamics between reflecting walls: the modes turn from L to P'
RUN = 'reflecting'
QUARTER, LAST_DIGIT = 3.20, 0.005  # of a period, as its two snapshots are apart [time units]
NEAR_ONE = 0.1  # what "a^2 + b^2 is near 1" leaves open here
WAVES = {(1, 0): 'the text\'s wave', (1, 1): 'the caption\'s wave'}
STRENGTHS = {
    (1, 0): (1.0, 'the paper: near 1, taken as within 0.1'),
    (1, 1): (None, 'ours alone: the paper says it of the mode that it shows'),
}
SHOWN = 13.0  # of the course of (a, b): about a period [time units]
SAME = 0.01  # part of the time between fields that two times called the same differ by at most


def runs(plan):
    return [RUN]


def rows(bags):
    turning = rotation.read(bags[RUN])
    info = bags[RUN].info
    found = {wave: Quarters(turning.get(wave), info) for wave in WAVES}
    for wave, one in found.items():
        yield Row(
            f'quarter period of {_name(wave)}',
            QUARTER,
            one.mean,
            one.error,
            LAST_DIGIT,
            'time units',
            f'{WAVES[wave]}; {one.remark}' if one.mean else '',
        )
    yield Row(
        '3.20 is a quarter period of',
        _name((1, 0)),
        _owner(found),
        remark='nearest in standard deviations of single quarters; text: LP(1,0), caption: LP(1,1)',
    )
    for wave, one in found.items():
        yield Row(
            f'single quarters of {_name(wave)}, standard deviation',
            None,
            one.spread,
            one.spread_error,
            unit='time units',
        )
    for name, mean, error in _uneven(found[1, 0]):
        yield Row(
            f'quarters of LP(1,0) from {name}',
            None,
            mean,
            error,
            unit='time units',
            remark='from either sign to the next',
        )
    for wave in WAVES:
        strength, error = turning[wave].strength() if wave in turning else (None, 0.0)
        published, remark = STRENGTHS[wave]
        yield Row(
            f'a^2 + b^2 of {_name(wave)}, mean',
            published,
            strength,
            error,
            NEAR_ONE if published else 0.0,
            remark=remark,
        )


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
        scatter = (
            f', or {self.off:.1f} standard deviations of single quarters' if self.spread else ''
        )
        self.remark = (
            f'k = {k:.5f}, omega / k = {with_error(abs(omega) / k, error / k)}; '
            f'3.20 is {100 * (QUARTER / self.mean - 1):+.1f} % off{scatter}; '
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


def _owner(found):
    """The step among whose single quarters 3.20 is nearest to the mean; 'neither' beyond three
    deviations. None unless all are measured: alone, one would be the nearest whatever it is."""
    if not all(one.spread for one in found.values()):
        return None
    nearest = min(found, key=lambda wave: found[wave].off)
    return _name(nearest) if found[nearest].off <= 3 else 'neither'


def figures(bags):
    bag = bags[RUN]
    turning = rotation.read(bag)
    if any(wave in turning for wave in WAVES):
        yield 'circle', _circles(bag.info, turning)
    snapshots = _chosen(bag, turning)
    if snapshots:
        yield 'quarters', _snapshots(bag.info, snapshots)


def tables(bags):
    turning = rotation.read(bags[RUN])
    yield 'phases', ('wave', 'time', 'vector', 'a', 'b', 'phase'), [
        (
            _name(wave),
            f'{turning[wave].time[at]:.6g}',
            column,
            f'{turning[wave].z[at, column].real:.4f}',
            f'{turning[wave].z[at, column].imag:.4f}',
            f'{turning[wave].phase[at, column]:.4f}',
        )
        for wave in WAVES
        if wave in turning
        for piece, column in [_course(turning[wave])]
        for at in range(piece.start, piece.stop)
    ]


# ---- (a, b) on the unit circle -------------------------------------------------------------


def _circles(info, turning):
    waves = [wave for wave in WAVES if wave in turning]
    figure, row = plt.subplots(
        1, len(waves), figsize=(3.6 * len(waves), 4.0), squeeze=False, constrained_layout=True
    )
    for axes, wave in zip(row.flat, waves):
        one = turning[wave]
        circle = np.exp(1j * np.linspace(0, 2 * np.pi, 200))
        axes.plot(circle.real, circle.imag, color=GREY, linewidth=0.8)
        axes.plot(
            one.z.real.ravel(),
            one.z.imag.ravel(),
            '.',
            color=BLUE,
            markersize=1,
            alpha=0.35,
            label='both vectors, all times',
            rasterized=True,
        )
        piece, column = _course(one)
        z = one.z[piece, column]
        axes.plot(
            z.real,
            z.imag,
            '.-',
            color=VERMILION,
            markersize=3,
            linewidth=0.7,
            label=f'{one.time[piece][-1] - one.time[piece][0]:.1f} time units of one',
        )
        axes.set(
            aspect='equal',
            xlim=(-1.25, 1.25),
            ylim=(-1.25, 1.25),
            xlabel='$a$  (on the L field)',
            ylabel='$b$  (on the P field)',
            title=one.name,
        )
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
    piece, column = max(
        known,
        default=(slice(0, 0), 0),
        key=lambda found: min(SHOWN, one.time[found[0]][-1] - one.time[found[0]][0]),
    )
    end = (
        np.searchsorted(one.time, one.time[piece.start] + SHOWN, side='right') if piece.stop else 0
    )
    return slice(piece.start, min(piece.stop, end)), column


# ---- fields a quarter period apart ---------------------------------------------------------


class Snapshot(modes.Panel):
    """A field with its place on the circle."""

    def __init__(self, field, z):
        super().__init__(field)
        self.z = z

    @property
    def title(self):
        return f'$t={self.field.sim_time:.1f}$: $a={self.z.real:.2f}$, $b={self.z.imag:.2f}$'

    @property
    def colour(self):
        return VERMILION


def _chosen(bag, turning):
    """Four fields of one vector of LP(1,0), each QUARTER after the other, that are nearest to L, P,
    -L, -P."""
    if (1, 0) not in turning:
        return []
    series = _fields(bag, turning[1, 0])
    times = sorted(series)
    best, chosen = -np.inf, []
    for time in times:
        four = [_at(times, time + number * QUARTER) for number in range(4)]
        if None in four or len({series[one].field.index for one in four}) > 1:
            continue
        score = sum(
            (series[one].z * np.exp(-1j * number * rotation.QUARTER)).real
            for number, one in enumerate(four)
        )
        if score > best:
            best, chosen = score, four
    return [series[time] for time in chosen]


def _at(times, wanted):
    near = min(times, key=lambda time: abs(time - wanted))
    return near if abs(near - wanted) <= SAME * QUARTER else None


def _fields(bag, one):
    """{time: Snapshot} of LP(1,0) where its coefficients are known."""
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


def _snapshots(info, snapshots):
    figure = modes.draw_panels(snapshots, info)
    figure.suptitle(f'{scene(info)}, LP(1,0): a vector near L, P, $-$L and $-$P', fontsize=9)
    return figure
