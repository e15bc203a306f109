"""run_info -> properties of its container that it does not contain. A curved container is drawn by
its outline. It has a line here if its scenes have no aspect, or if it has special modes."""

import numpy as np

from hdlyap.msg import LpPhase

from . import space
from .reader import is_known

POINTS = 256  # points of a period, enough for k r up to 100


def is_curved(info):
    """Whether the container has a curved wall."""
    return is_known(info) and info.boundary_x == 'curved'


def radius(info):
    """The radius of a circle; None of another container."""
    return info.box_x / 2 if info.container == 'circle' else None


def not_asked(info):
    """Parameters that run_info has, but that a scene with this container must not give."""
    if space.without_box(info):
        return tuple(space.OF_A_BOX)
    if not is_curved(info):
        return ()
    without = ('aspect',) if info.container in WITHOUT_ASPECT else ()
    return 'boundary_x', 'boundary_y', *without


def modulation(info, wave_number, order, bits, x, y):
    """The modulation A of L and P fields in a curved container, at the given positions. order: n of
    the wave along x."""
    return MODULATIONS[info.container](info, wave_number, order, bits, x, y)


def _bessel(order, x):
    """J_m(x), by its integral over a period; the sum is exact to the last digits."""
    turn = 2 * np.pi * np.arange(POINTS) / POINTS
    x = np.asarray(x)[..., np.newaxis]
    return np.cos(order * turn - x * np.sin(turn)).mean(axis=-1)


def _in_a_circle(info, wave_number, order, bits, x, y):
    from_centre = np.asarray(x) - info.box_x / 2 + 1j * (np.asarray(y) - info.box_y / 2)
    turned = order * np.angle(from_centre)
    angular = np.sin(turned) if bits == LpPhase.SIN_M else np.cos(turned)
    return _bessel(order, wave_number * np.abs(from_centre)) * angular


WITHOUT_ASPECT = {'circle'}
MODULATIONS = {'circle': _in_a_circle}
