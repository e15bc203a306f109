"""The disks as a gas, at several densities: pressure, collisions, sound."""

from math import sqrt

import numpy as np

from hdlyap.plots import equation
from hdlyap.plots.figures.style import BLUE, GREY, INK, VERMILION

from .. import averages, draw
from ..averages import UNKNOWN
from ..row import Row
from . import densities

FEWEST = 3  # densities, for a velocity of sound
EDGE = 1e-6  # relative: densities that are one


class State:
    """One density; gas: its message, None without. z, rate, free_path: (value, its standard error),
    -1 while that is not known."""

    def __init__(self, bag):
        self.modes, self.gas = densities.of(bag), bag.recording.gas
        self.density = bag.info.density
        if self.gas is not None:
            self.rate = self.gas.collision_rate, self.gas.collision_rate_error
            self.z = self._as_known_as('pressure', self.gas.compressibility)
            path = float(equation.mean_free_path(self.gas.collision_rate))
            self.free_path = self._as_known_as('collision_rate', path)

    def _as_known_as(self, name, value):
        error = getattr(self.gas, name + '_error')
        return value, float(value * error / getattr(self.gas, name)) if error >= 0 else -1.0

    @property
    def rate_over_z(self):
        """The collision rate over the one that belongs to Z; both errors as if they knew nothing of
        each other."""
        (z, z_error), of_z = self.z, equation.collision_rate(self.z[0])
        return averages.quotient(self.rate, (of_z, of_z / (z - 1) * z_error))


def _known(bags):
    return [one for one in map(State, bags) if one.gas is not None]


def equation_of_state(bags):
    for one in map(State, bags):
        if one.density < equation.MOST * (1 + EDGE):
            published = float(equation.compressibility(one.density))
            measured = UNKNOWN if one.gas is None else one.z
            yield Row(f'Z at density {one.density:.1f}', published, *measured)


def collisions(bags):
    for one in map(State, bags):
        value, remark = UNKNOWN, ''
        if one.gas is not None:
            value, remark = (
                one.rate_over_z,
                f'{one.rate[0]:.3f} collisions of a disk in a time unit',
            )
        quantity = f'collision rate over that of Z, density {one.density:.1f}'
        yield Row(quantity, 1.0, *value, remark=remark)


def beside(bags):
    known = _known(bags)
    for one, sound in zip(known, _sounds(known)):
        v = one.modes.v[0]
        v = f'v {v:.3f}, {v / sound[0]:.3f} of it; ' if one.modes.moves else ''
        remark = f'{v}by Henderson {equation.sound_velocity(one.density):.3f}'
        quantity = f'velocity of sound at density {one.density:.1f}'
        yield Row(quantity, None, *sound, densities.UNIT, remark)
    for one in known:
        if one.modes.moves:  # [T13]: 1 if v is what the equation of motion of the fields gives
            ratio = averages.quotient(one.modes.v, [part / sqrt(2) for part in one.z])
            yield Row(f'v over Z / sqrt(2) at density {one.density:.1f}', None, *ratio)
    for one in known:
        path, lp = one.free_path, one.modes.branch['LP']
        remark = f'times k of LP(1,0), {lp.k:.4f}: {lp.k * path[0]:.3f}' if lp else ''
        yield Row(f'mean free path at density {one.density:.1f}', None, *path, 'sigma', remark)
    if not known:
        yield Row('velocity of sound')


def _sounds(known):
    """(velocity, its error) at each of these densities; none of fewer than a slope needs."""
    if len(known) < FEWEST:
        return []
    z, errors = zip(*[one.z for one in known])
    errors = [error if error >= 0 else np.nan for error in errors]
    velocities, errors = equation.sound_velocities([one.density for one in known], z, errors)
    return list(zip(map(float, velocities), np.where(np.isfinite(errors), errors, -1.0)))


def picture(bags):
    known = _known(bags)
    if not known:
        return None
    figure, (left, right) = draw.panels(1, 2, (7.6, 3.2))
    density = np.linspace(0.02, 0.85, 200)
    solid = density <= equation.MOST
    for axes, curve in ((left, equation.compressibility), (right, equation.sound_velocity)):
        axes.plot(density[solid], curve(density[solid]), color=GREY, label='Henderson')
        axes.plot(density[~solid], curve(density[~solid]), ':', color=GREY)
    draw.bars(left, [(one.density, *one.z) for one in known], 'o', BLUE, 'measured')
    left.set_ylabel('$Z = P / \\rho kT$')
    sounds = [(one.density, *sound) for one, sound in zip(known, _sounds(known))]
    draw.bars(right, sounds, 'o', BLUE, 'sound')
    moving = [(one.density, *one.modes.v) for one in known if one.modes.phases]
    draw.bars(right, moving, 's', VERMILION, '$v$ of LP modes')
    z = equation.compressibility(density)
    right.plot(density, z / sqrt(2), '--', color=INK, label=r'Henderson, $Z/\sqrt{2}$')
    right.set_ylabel('velocity  ' + draw.SIGMA_UNIT)
    for axes in (left, right):
        axes.set_xlabel(r'density  [$1/\sigma^2$]')
        axes.legend()
    return figure
