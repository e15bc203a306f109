"""Part 17: the disks as a gas, at the densities of part 8: pressure, collisions, sound."""

from math import isfinite, sqrt

import numpy as np

from hdlyap.plots import equation
from hdlyap.plots.figures.style import BLUE, GREY, INK, VERMILION

from .. import averages, draw
from ..files import cells
from ..row import Row
from . import densities

RUNS = densities.RUNS
FEWEST = 3  # densities, for a velocity of sound
EDGE = 1e-6  # relative: densities that are one


class State:
    """One density; gas: its message, None without."""

    def __init__(self, bag):
        self.gas = bag.recording.gas
        self.modes = densities.Measured(bag.recording)
        self.density = self.modes.density
        self.wave_number = self.modes.branch['LP'] and self.modes.branch['LP'].wave_number

    @property
    def moves(self):
        """Whether v is known."""
        return self.modes.phases and isfinite(self.modes.v_error)

    @property
    def z(self):
        """(Z, its standard error); -1 while that is not known."""
        return self.gas.compressibility, _relative(self.gas, 'pressure', self.gas.compressibility)

    @property
    def free_path(self):
        path = equation.mean_free_path(self.gas.collision_rate)
        return float(path), _relative(self.gas, 'collision_rate', path)

    @property
    def rate_over_z(self):
        """The collision rate over the one that belongs to Z; both errors as if they knew nothing of
        each other."""
        (z, z_error), gas = self.z, self.gas
        of_z = equation.collision_rate(z)
        return averages.quotient(
            (gas.collision_rate, gas.collision_rate_error), (of_z, of_z / (z - 1) * z_error)
        )


def _relative(gas, name, value):
    error = getattr(gas, name + '_error')
    return float(value * error / getattr(gas, name)) if error >= 0 else -1.0


def _all(bags):
    return [State(bags[name]) for name in RUNS]


def read(bags):
    return [one for one in _all(bags) if one.gas is not None]


def equation_of_state(bags):
    for one in _all(bags):
        if one.density < equation.MOST * (1 + EDGE):
            published = float(equation.compressibility(one.density))
            measured = (None, 0.0) if one.gas is None else one.z
            yield Row(f'Z at density {one.density:.1f}', published, *measured)


def collisions(bags):
    for one in _all(bags):
        row = Row(f'collision rate over that of Z, density {one.density:.1f}', 1.0)
        if one.gas is not None:
            row.measured, row.error = one.rate_over_z
            row.remark = f'{one.gas.collision_rate:.3f} collisions of a disk in a time unit'
        yield row


def beside(bags):
    known = read(bags)
    for one, sound in zip(known, _sounds(known)):
        v = f'v {one.modes.v:.3f}, {one.modes.v / sound[0]:.3f} of it; ' if one.moves else ''
        remark = f'{v}by Henderson {equation.sound_velocity(one.density):.3f}'
        quantity = f'velocity of sound at density {one.density:.1f}'
        yield Row(quantity, None, *sound, densities.UNIT, remark)
    yield from (_v_row(one) for one in known if one.moves)
    for one in known:
        path, k = one.free_path, one.wave_number
        remark = f'times k of LP(1,0), {k:.4f}: {k * path[0]:.3f}' if k else ''
        yield Row(f'mean free path at density {one.density:.1f}', None, *path, 'sigma', remark)
    if not known:
        yield Row('velocity of sound')


def _v_row(one):
    """[T13]: 1 if v is what the equation of motion of the fields gives."""
    ratio = averages.quotient((one.modes.v, one.modes.v_error), [part / sqrt(2) for part in one.z])
    return Row(f'v over Z / sqrt(2) at density {one.density:.1f}', None, *ratio)


def _sounds(known):
    """(velocity, its error) at each of these densities; none of fewer than a slope needs."""
    if len(known) < FEWEST:
        return []
    z, errors = zip(*[one.z for one in known])
    errors = [error if error >= 0 else np.nan for error in errors]
    velocities, errors = equation.sound_velocities([one.density for one in known], z, errors)
    errors = np.where(np.isfinite(errors), errors, -1.0)
    return list(zip(map(float, velocities), map(float, errors)))


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    known = read(bags)
    if known:
        yield 'gas', _figure(known)


def _figure(known):
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
    moving = [(one.density, one.modes.v, one.modes.v_error) for one in known if one.modes.phases]
    draw.bars(right, moving, 's', VERMILION, '$v$ of LP modes')
    z = equation.compressibility(density)
    right.plot(density, z / sqrt(2), '--', color=INK, label=r'Henderson, $Z/\sqrt{2}$')
    right.set_ylabel('velocity  ' + draw.SIGMA_UNIT)
    for axes in (left, right):
        axes.set_xlabel(r'density  [$1/\sigma^2$]')
        axes.legend()
    return figure


def tables(bags):
    known = read(bags)
    sounds = _sounds(known) or [(None, None)] * len(known)
    names = 'density', 'z', 'z_error', 'collision_rate', 'collision_rate_error'
    yield 'gas', (*names, 'mean_free_path', 'sound', 'sound_error'), [
        cells(
            'g .6g .2g .6g .2g .5g .5g .5g',
            *(one.density, *one.z, one.gas.collision_rate, one.gas.collision_rate_error),
            *(one.free_path[0], *sound),
        )
        for one, sound in zip(known, sounds)
    ]
