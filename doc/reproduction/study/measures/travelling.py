"""In a periodic box the L part of an LP mode travels."""

import numpy as np

from hdlyap.data.waves import SIN_X
from hdlyap.plots.figures.style import BLUE, INK, VERMILION, scene

from .. import blocks, draw, rotation
from ..averages import UNKNOWN
from ..row import Row
from .turning import over_slope

SHOWN = 25.0  # of the space-time diagram [time units]
FEWEST = 4  # blocks of time for an error
PLACES = 200  # along x
UNIT = 'sigma/time unit'


class Front:
    """One vector over a stretch of time. Its L part is a_cos d/dx cos(k x) + a_sin d/dx sin(k x),
    in proportion to -r sin(k x - theta), theta = angle(a_cos, a_sin): the front, where it goes
    through zero, is at theta / k. With z = a + i b turning at omega, r^2 dtheta/dt = omega Im(z_cos
    conj z_sin). Its size over that of a circle is the handedness: 1 for a wave that runs evenly
    towards +x, -1 towards -x, 0 for one that stands. A vector that runs towards -x is looked at in
    a mirror: it is `sign` times theta that is followed."""

    def __init__(self, turning, columns, piece):
        cos, sin = turning.z[piece][:, columns].T
        self.wave_number, self.time = turning.wave_number, turning.time[piece]
        self.length = self.time[-1] - self.time[0]
        self.l_part = np.array([cos.real, sin.real])
        self.turns = turning.turns()[piece.start : piece.stop - 1]
        self.way = 1.0 if np.nansum(self.turns) >= 0 else -1.0
        self.handedness = float(self.way * np.mean(circular(cos, sin)))
        self.sign = 1 if self.handedness >= 0 else -1
        self.theta = np.unwrap(np.arctan2(self.l_part[1], self.l_part[0]))
        self.place = self.sign * self.theta / self.wave_number  # as it goes on [sigma]
        # of a turn or more each: shorter ones would see the steps, which recur
        turns = np.nansum(self.way * self.turns) / (2 * np.pi)
        self.blocks = int(np.clip(turns, FEWEST, blocks.BLOCKS))
        self.shown = slice(0, int(np.searchsorted(self.time, self.time[0] + SHOWN, side='right')))

    def velocity(self):
        """Mean slope of the front, and its standard error from blocks of time."""
        return blocks.quotient(np.diff(self.place), np.diff(self.time), self.blocks)

    def against_turns(self):
        """Its mean slope over |omega| / k at the same times, and the standard error of that."""
        return blocks.quotient(self.sign * np.diff(self.theta), self.way * self.turns, self.blocks)

    def unevenness(self):
        """Rms about a straight line, while shown [sigma]."""
        time, place = self.time[self.shown], self.place[self.shown]
        return float(np.std(place - np.polyval(np.polyfit(time, place, 1), time)))


def circular(cos, sin):
    """Handedness at every time if omega > 0."""
    return 2 * np.imag(cos * np.conj(sin)) / (np.abs(cos) ** 2 + np.abs(sin) ** 2)


def vectors(turning):
    """Columns of each vector: the pair with the cosine, the pair with the sine."""
    for begin in range(0, turning.z.shape[1], turning.pairs):
        columns = range(begin, begin + turning.pairs)
        yield sorted(columns, key=lambda column: turning.modulation[column] & SIN_X)


def fronts(turning):
    """Every stretch over which a vector has both of its pairs tracked and runs one way: vectors are
    superpositions of waves of both directions, in parts that change slowly."""
    for columns in vectors(turning):
        way = circular(*turning.z[:, columns].T)
        for on in (way > 0, way < 0):
            for piece in rotation.stretches(on[:, np.newaxis], shortest=blocks.BLOCKS + 1):
                yield Front(turning, columns, piece)


def _read(bag):
    """(the Rotation of LP(1,0), the front that runs the farthest for the least part of the other
    direction); None without."""
    turning = rotation.read(bag).get((1, 0))
    found = [(one.length * abs(one.handedness), one) for one in fronts(turning)] if turning else []
    return turning, max(found, default=(0, None), key=lambda pair: pair[0])[1]


def one_way(turning):
    """Mean size of the handedness over vectors and times: 1 if all run one way, 1/2 of random
    superpositions."""
    ways = np.array([np.abs(circular(*turning.z[:, columns].T)) for columns in vectors(turning)])
    known = np.isfinite(ways).any(axis=0)
    return blocks.mean(np.nanmean(ways[:, known], axis=0))


def handed(bag):
    turning, _ = _read(bag)
    value = one_way(turning) if turning else UNKNOWN
    remark = '1: every vector runs one way; 1/2: random parts of both directions; 0: all stand'
    yield Row('handedness of LP(1,0), mean size', None, *value, remark=remark)


def front_and_velocity(bag):
    turning, front = _read(bag)
    v = turning.velocity() if turning else UNKNOWN
    slope, ratio, uneven, remarks = UNKNOWN, UNKNOWN, None, ('', '')
    if front:
        slope, ratio, uneven = front.velocity(), front.against_turns(), front.unevenness()
        way = 'towards +x' if front.sign > 0 else 'towards -x, mirrored'
        long = f'{front.length:.1f} time units, {way}, handedness {front.handedness:+.2f}'
        remarks = long, 'about the straight line, while shown'
    yield Row('front velocity, mean slope', None, *slope, UNIT, remarks[0])
    locked = 'no test: locked within a quarter turn by the choice of the stretch'
    yield Row('front velocity / (omega / k), same times', None, *ratio, remark=locked)
    yield Row('omega / k of LP(1,0), same run', None, *v, UNIT)
    yield over_slope('v', v, bag.recording)
    yield Row('unevenness of the front, rms', None, uneven, 0.0, 'sigma', remarks[1])


def wave(bag):
    """Picture of the L part in space and time."""
    turning, front = _read(bag)
    if not front:
        return None
    figure, (top, bottom) = draw.panels(2, 1, (6.4, 6.4), sharex=True)
    time, k, length = front.time[front.shown], front.wave_number, bag.info.box_x
    x = np.linspace(0, length, PLACES + 1)
    cos, sin = front.l_part[:, front.shown]
    field = -np.outer(np.sin(k * x), cos) + np.outer(np.cos(k * x), sin)
    largest = np.abs(field).max()
    how = {'cmap': 'RdBu_r', 'vmin': -largest, 'vmax': largest, 'rasterized': True}
    picture = top.pcolormesh(time, x, field, shading='auto', **how)
    figure.colorbar(picture, ax=top, label='L part along $x$  [arb. units]')
    place = np.mod(front.theta[front.shown] / k, length)
    jumps = np.abs(np.diff(place, append=place[-1])) > length / 2
    top.plot(time, np.where(jumps, np.nan, place), color=INK, linewidth=1.2)
    top.set_ylabel(r'$x$  [$\sigma$]')
    way = '' if front.sign > 0 else 'with $x$ reversed: the wave runs towards $-x$'
    draw.letters((top, bottom), (f'{turning.name}, L part of one vector; line: its front', way))
    bottom.plot(time, front.place[front.shown], color=BLUE, label=r'front $\theta/k$')
    v, _ = turning.velocity()
    if v:
        even = np.mean(front.place[front.shown] - v * time) + v * time
        label = rf'slope $|\omega|/k = {v:.3f}$'
        bottom.plot(time, even, color=VERMILION, linewidth=0.9, label=label)
    bottom.set_ylabel(r'place of the front  [$\sigma$]')
    bottom.legend(loc='upper left')
    bottom.set_xlabel('simulated time  [time units]')
    figure.suptitle(scene(bag.info), fontsize=9)
    return figure
