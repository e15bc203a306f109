"""Part 13: in a periodic box the L part of an LP mode travels."""

import numpy as np

from hdlyap.plots.figures.style import BLUE, INK, VERMILION, scene
from hdlyap.data.waves import SIN_X

from .. import blocks, draw, rotation
from ..files import cells
from ..row import Row
from ..velocity import over_slope

RUN = 'travelling'
WAVE = (1, 0)
SHOWN = 25.0  # of the space-time diagram [time units]
FEWEST = 4  # blocks of time for an error
LISTED = 20  # stretches in the table, the longest first
LOCKED = 'no test: locked within a quarter turn by the choice of the stretch'
PLACES = 200  # of it, along x


class Front:
    """One vector over a stretch of time. Its L part is a_cos d/dx cos(k x) + a_sin d/dx sin(k x),
    in proportion to -r sin(k x - theta), theta = angle(a_cos, a_sin): the front, where it goes
    through zero, is at theta / k. With z = a + i b turning at omega, r^2 dtheta/dt = omega Im(z_cos
    conj z_sin). Its size over that of a circle is the handedness: 1 for a wave that runs evenly
    towards +x, -1 towards -x, 0 for one that stands. A vector that runs towards -x is looked at in
    a mirror: it is `sign` times theta that is followed."""

    def __init__(self, turning, columns, piece):
        cos, sin = turning.z[piece][:, columns].T
        self.columns, self.wave_number = columns, turning.wave_number
        self.time = turning.time[piece]
        self.l_part = np.array([cos.real, sin.real])
        self.turns = turning.turns()[piece.start : piece.stop - 1]
        self.way = 1.0 if np.nansum(self.turns) >= 0 else -1.0
        self.handedness = float(self.way * np.mean(circular(cos, sin)))
        self.sign = 1 if self.handedness >= 0 else -1
        self.theta = np.unwrap(np.arctan2(self.l_part[1], self.l_part[0]))
        self.index = turning.index[piece, columns[0]].astype(int)

    @property
    def length(self):
        return self.time[-1] - self.time[0]

    @property
    def place(self):
        """Of the front, as it goes on [sigma]."""
        return self.sign * self.theta / self.wave_number

    @property
    def blocks(self):
        """Of a turn or more each: shorter ones would see the steps, which recur."""
        turns = np.nansum(self.way * self.turns) / (2 * np.pi)
        return int(np.clip(turns, FEWEST, blocks.BLOCKS))

    def velocity(self):
        """Mean slope of the front, and its standard error from blocks of time."""
        return blocks.quotient(np.diff(self.place), np.diff(self.time), self.blocks)

    def against_turns(self):
        """Its mean slope over |omega| / k at the same times, and the standard error of that."""
        return blocks.quotient(self.sign * np.diff(self.theta), self.way * self.turns, self.blocks)


def circular(cos, sin):
    """Handedness at every time if omega > 0."""
    return 2 * np.imag(cos * np.conj(sin)) / (np.abs(cos) ** 2 + np.abs(sin) ** 2)


def vectors(turning):
    """Columns of each vector: the pair with the cosine, the pair with the sine."""
    for begin in range(0, turning.z.shape[1], turning.pairs):
        yield sorted(
            range(begin, begin + turning.pairs),
            key=lambda column: turning.modulation[column] & SIN_X,
        )


def fronts(turning):
    """Every stretch over which a vector has both of its pairs tracked and runs one way: vectors are
    superpositions of waves of both directions, in parts that change slowly."""
    found = []
    for columns in vectors(turning):
        way = circular(*turning.z[:, columns].T)
        for on in (way > 0, way < 0):
            pieces = rotation.stretches(on[:, np.newaxis], shortest=blocks.BLOCKS + 1)
            found += [Front(turning, columns, piece) for piece in pieces]
    return found


def chosen(turning):
    """The front that runs the farthest for the least part of the other direction; None without
    one."""
    return max(
        fronts(turning) if turning else (),
        default=None,
        key=lambda one: one.length * abs(one.handedness),
    )


def one_way(turning):
    """Mean size of the handedness over vectors and times: 1 if all run one way, 1/2 of random
    superpositions."""
    ways = np.array([np.abs(circular(*turning.z[:, columns].T)) for columns in vectors(turning)])
    known = np.isfinite(ways).any(axis=0)
    return blocks.mean(np.nanmean(ways[:, known], axis=0))


def handed(bags):
    turning = rotation.read(bags[RUN]).get(WAVE)
    size, error = one_way(turning) if turning else (None, 0.0)
    remark = '1: every vector runs one way; 1/2: random parts of both directions; 0: all stand'
    yield Row('handedness of LP(1,0), mean size', None, size, error, remark=remark)


def front_and_velocity(bags):
    turning = rotation.read(bags[RUN]).get(WAVE)
    front = chosen(turning)
    v = turning.velocity() if turning else (None, 0.0)
    slope = front.velocity() if front else (None, 0.0)
    remark = f'{front.length:.1f} time units, {_direction(front)}' if front else ''
    unit = 'sigma/time unit'
    yield Row('front velocity, mean slope', None, *slope, unit, remark)
    ratio = front.against_turns() if front else (None, 0.0)
    yield Row('front velocity / (omega / k), same times', None, *ratio, remark=LOCKED)
    yield Row('omega / k of LP(1,0), same run', None, *v, unit)
    yield over_slope('v', *v, bags[RUN].recording)
    uneven, remark = _unevenness(front) if front else None, 'about the straight line, while shown'
    yield Row('unevenness of the front, rms', None, uneven, 0.0, 'sigma', remark)


def _direction(front):
    way = 'towards +x' if front.sign > 0 else 'towards -x, mirrored'
    return f'{way}, handedness {front.handedness:+.2f}'


def _unevenness(front):
    first = _shown(front)
    time, place = front.time[first], front.place[first]
    return float(np.std(place - np.polyval(np.polyfit(time, place, 1), time)))


def _shown(front):
    """The first SHOWN of it."""
    return slice(0, int(np.searchsorted(front.time, front.time[0] + SHOWN, side='right')))


def figures(bags):
    bag = bags[RUN]
    turning = rotation.read(bag).get(WAVE)
    front = chosen(turning)
    if front:
        yield 'wave', _draw(bag.info, turning, front)


def tables(bags):
    turning = rotation.read(bags[RUN]).get(WAVE)
    found = sorted(fronts(turning) if turning else [], key=lambda one: -one.length)[:LISTED]
    about = 'index', 'from', 'for', 'handedness'
    yield 'stretches', (*about, 'velocity', 'error', 'over_omega_by_k', 'error'), [
        cells(
            's .6g .4g .3f .5g .2g .5g .2g',
            *(one.index[-1], one.time[0], one.length, one.handedness, *one.velocity()),
            *(ratio if ratio[0] else (None, None)),
        )
        for one in found
        for ratio in [one.against_turns()]
    ]
    front = chosen(turning)
    yield 'front', ('time', 'a_cos', 'a_sin', 'place'), [
        cells('.6g .4f .4f .4f', *one)
        for one in (zip(front.time, *front.l_part, front.place) if front else ())
    ]


def _draw(info, turning, front):
    figure, (top, bottom) = draw.panels(2, 1, (6.4, 6.4), sharex=True)
    part = _shown(front)
    time, k = front.time[part], front.wave_number
    x = np.linspace(0, info.box_x, PLACES + 1)
    cos, sin = front.l_part[:, part]
    field = -np.outer(np.sin(k * x), cos) + np.outer(np.cos(k * x), sin)
    largest = np.abs(field).max()
    how = {'cmap': 'RdBu_r', 'vmin': -largest, 'vmax': largest, 'rasterized': True}
    picture = top.pcolormesh(time, x, field, shading='auto', **how)
    figure.colorbar(picture, ax=top, label='L part along $x$  [arb. units]')
    place = np.mod(front.theta[part] / k, info.box_x)
    jumps = np.abs(np.diff(place, append=place[-1])) > info.box_x / 2
    top.plot(time, np.where(jumps, np.nan, place), color=INK, linewidth=1.2)
    top.set_ylabel(r'$x$  [$\sigma$]')
    way = '' if front.sign > 0 else 'with $x$ reversed: the wave runs towards $-x$'
    draw.letters((top, bottom), (f'{turning.name}, L part of one vector; line: its front', way))
    _line(bottom, turning, front, part)
    bottom.set_xlabel('simulated time  [time units]')
    figure.suptitle(scene(info), fontsize=9)
    return figure


def _line(axes, turning, front, part):
    time, place = front.time[part], front.place[part]
    v, _ = turning.velocity()
    axes.plot(time, place, color=BLUE, label=r'front $\theta/k$')
    if v:
        even = np.mean(place - v * time) + v * time
        label = rf'slope $|\omega|/k = {v:.3f}$'
        axes.plot(time, even, color=VERMILION, linewidth=0.9, label=label)
    axes.set_ylabel(r'place of the front  [$\sigma$]')
    axes.legend(loc='upper left')
