"""Part 17: the disks as a gas, at the densities of part 8: pressure, collisions, sound."""

from math import isfinite, sqrt

import numpy as np

from hdlyap.plots import equation
from hdlyap.plots.figures.style import BLUE, GREY, INK, VERMILION, plt

from .. import averages
from ..row import Claim, Row
from . import densities

TITLE = 'Pressure, collisions, sound and mean free path beside v, 780 disks, periodic'
RUNS = densities.RUNS
ACCURACY = 0.01  # of Henderson's equation, up to equation.MOST
FINITE = 0.01  # what few disks may differ by from many: some 1 / N
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


def runs(plan):
    return RUNS


def claims(bags):
    found = [State(bags[name]) for name in RUNS]
    yield Claim(
        "pressures are those of Henderson's equation of state",
        [_z_row(one) for one in found if one.density < equation.MOST * (1 + EDGE)],
        f'{100 * ACCURACY:g} %, its accuracy up to density {equation.MOST:g}',
    )
    yield Claim(
        'disks collide as often as the pressure says',
        [_rate_row(one) for one in found],
        f'{100 * FINITE:g} %',
    )
    yield Claim('sound, v and mean free path', list(_beside(found)))


def _z_row(one):
    published = float(equation.compressibility(one.density))
    measured = (None, 0.0) if one.gas is None else one.z
    return Row(
        f'Z at density {one.density:.1f}', published, *measured, left_open=ACCURACY * published
    )


def _rate_row(one):
    quantity = f'collision rate over that of Z, density {one.density:.1f}'
    if one.gas is None:
        return Row(quantity, 1.0, left_open=FINITE)
    remark = f'{one.gas.collision_rate:.3f} collisions of a disk in a time unit'
    return Row(quantity, 1.0, *one.rate_over_z, left_open=FINITE, remark=remark)


def _beside(found):
    known = [one for one in found if one.gas is not None]
    for one, (sound, error) in zip(known, _sounds(known)):
        v, v_error = one.modes.v, one.modes.v_error
        moves = one.modes.phases and isfinite(v_error)
        remark = f'v {v:.3f}, {v / sound:.3f} of it' if moves else ''
        yield Row(
            f'velocity of sound at density {one.density:.1f}',
            None,
            sound,
            error,
            unit=densities.UNIT,
            remark=f'{remark}; by Henderson {equation.sound_velocity(one.density):.3f}'.lstrip(
                '; '
            ),
        )
    for one in known:
        if one.modes.phases and isfinite(one.modes.v_error):
            yield _v_row(one)
    for one in known:
        path, error = one.free_path
        k = one.wave_number
        remark = f'times k of LP(1,0), {k:.4f}: {k * path:.3f}' if k else ''
        yield Row(
            f'mean free path at density {one.density:.1f}',
            None,
            path,
            error,
            unit='sigma',
            remark=remark,
        )
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
    known = [one for one in (State(bags[name]) for name in RUNS) if one.gas is not None]
    if known:
        yield 'gas', _figure(known)


def _figure(known):
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.2), constrained_layout=True)
    density = np.linspace(0.02, 0.85, 200)
    solid = density <= equation.MOST
    for axes, curve in ((left, equation.compressibility), (right, equation.sound_velocity)):
        axes.plot(density[solid], curve(density[solid]), color=GREY, label='Henderson')
        axes.plot(density[~solid], curve(density[~solid]), ':', color=GREY)
    places = [one.density for one in known]
    left.plot(places, [one.z[0] for one in known], 'o', color=BLUE, markersize=4, label='measured')
    left.set_ylabel('$Z = p / \\rho kT$')
    sounds = [sound for sound, _ in _sounds(known)]
    right.plot(places[: len(sounds)], sounds, 'o', color=BLUE, markersize=4, label='sound')
    moving = [one for one in known if one.modes.phases]
    right.plot(
        [one.density for one in moving],
        [one.modes.v for one in moving],
        's',
        color=VERMILION,
        markersize=4,
        label='$v$ of LP modes',
    )
    right.plot(
        density, equation.compressibility(density) / sqrt(2), '--', color=INK, label=r'$Z/\sqrt{2}$'
    )
    right.set_ylabel(r'velocity  [$\sigma$/time unit]')
    for axes in (left, right):
        axes.set_xlabel(r'density  [$1/\sigma^2$]')
        axes.legend()
    return figure


def tables(bags):
    known = [one for one in (State(bags[name]) for name in RUNS) if one.gas is not None]
    sounds = _sounds(known) or [('', '')] * len(known)
    yield 'gas', (
        'density',
        'z',
        'z_error',
        'collision_rate',
        'collision_rate_error',
        'mean_free_path',
        'sound',
        'sound_error',
    ), [
        (
            f'{one.density:g}',
            f'{one.z[0]:.6g}',
            f'{one.z[1]:.2g}',
            f'{one.gas.collision_rate:.6g}',
            f'{one.gas.collision_rate_error:.2g}',
            f'{one.free_path[0]:.5g}',
            *(f'{number:.5g}' if number != '' else '' for number in sound),
        )
        for one, sound in zip(known, sounds)
    ]
