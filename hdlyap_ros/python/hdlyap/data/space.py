"""Disks, spheres, dumbbells or others -> the directions that what a run_info or a message says has,
x, y and of spheres z; what they are called, and where the disks of dumbbells are."""

import numpy as np
import yaml


def is_solid(info):
    """Whether it is of spheres; None is of disks."""
    return info is not None and info.dimension == 3


def turns(info):
    """Whether each has an angle beside its place; None is of disks."""
    return info is not None and info.inertia > 0


def own(info):
    """{name: value} of the parameters of such particles alone."""
    return {
        name: yaml.safe_load(value) for name, _, value in (one.partition('=') for one in info.own)
    }


def without_box(info):
    """What is known of particles that have no positions in a box; '' of others."""
    if info.dimension or not info.particles:
        return ''
    return ', '.join([f'{info.particles}, N = {info.number}', *info.own])


def axes(info):
    return 'xyz' if is_solid(info) else 'xy'


def along(info, name):
    """Of box_ or boundary_, in each direction."""
    return [getattr(info, name + axis) for axis in axes(info)]


def nodes(wave, info):
    """Of a Step, or of anything else with nx and ny, along each direction."""
    return tuple(getattr(wave, 'n' + axis) for axis in axes(info))


def vectors(message, name=''):
    """Rows along x, y and of spheres z, of positions, or of what has a name before the axis, as dq
    and p_."""
    rows = (getattr(message, name + axis) for axis in 'xyz')
    return np.array([row for row in rows if len(row)])


def particle(info):
    """What it is called."""
    name = _words(info.particles)
    return name[:-1] if name.endswith('s') else 'particle'


def named(info):
    """Behind their number, if it is not of disks: what they are, and what is their own."""
    if info.particles == 'disks':
        return ''
    own_ones = [f'{_words(name)} {_short(value)}' for name, value in own(info).items()]
    return ', '.join([f' {_words(info.particles)}', *own_ones])


def _words(name):
    return name.replace('_', ' ')


def _short(value):
    return f'{value:.4g}' if isinstance(value, float) else _words(f'{value}')


def disks(info, q, angle=()):
    """Rows of places as vectors() gives them, once; of dumbbells twice, for each of both disks."""
    bond = own(info).get('bond', 0.0) if info.particles == 'dumbbells' else 0.0
    if not bond:
        return [q]
    arm = 0.5 * bond * np.array([np.cos(angle), np.sin(angle)])
    return [q - arm, q + arm]


def size(info):
    """Area or volume of the box."""
    return float(np.prod(along(info, 'box_')))


def distance(info):
    """Mean one of neighbours."""
    return (size(info) / info.number) ** (1 / len(axes(info)))


def phase_space(info):
    """Lyapunov exponents in all: 4N, of spheres 6N."""
    return 2 * info.coordinates * info.number
