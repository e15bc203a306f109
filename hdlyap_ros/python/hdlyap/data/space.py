"""Disks or spheres -> the directions that what a run_info or a message says has: x, y and of
spheres z."""

import numpy as np
import yaml


def is_solid(info):
    """Whether it is of spheres; None is of disks."""
    return info is not None and info.dimension == 3


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
    return 'sphere' if is_solid(info) else 'disk'


def size(info):
    """Area or volume of the box."""
    return float(np.prod(along(info, 'box_')))


def distance(info):
    """Mean one of neighbours."""
    return (size(info) / info.number) ** (1 / len(axes(info)))


def phase_space(info):
    """Lyapunov exponents in all: 4N, of spheres 6N."""
    return 2 * info.coordinates * info.number
