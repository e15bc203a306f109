"""run_info -> what its container is, beyond what it says itself. A curved one is drawn by its
outline; it has a line here if no scene gives its aspect, or if it has modes of its own."""

import numpy as np

from hdlyap.msg import LpPhase

from . import space

POINTS = 256  # of a period: enough for k r up to 100


def is_curved(info):
    """Behind a wall that is no edge of the box."""
    return info.boundary_x == 'curved'


def not_asked(info):
    """Parameters that run_info has, but that none of its scenes may say."""
    if space.without_box(info):
        return OF_A_BOX
    if not is_curved(info):
        return ()
    without = ('aspect',) if info.container in WITHOUT_ASPECT else ()
    return 'boundary_x', 'boundary_y', *without


def modulation(info, wave_number, order, bits, x, y):
    """A of L and P fields in a curved container, at the given positions; order: n of the wave
    along x."""
    return MODULATIONS[info.container](info, wave_number, order, bits, x, y)


def _bessel(order, x):
    """J_m(x), by its integral over a period, which the sum has to the last digits."""
    turn = 2 * np.pi * np.arange(POINTS) / POINTS
    x = np.asarray(x)[..., np.newaxis]
    return np.cos(order * turn - x * np.sin(turn)).mean(axis=-1)


def _in_a_circle(info, wave_number, order, bits, x, y):
    from_centre = np.asarray(x) - info.box_x / 2 + 1j * (np.asarray(y) - info.box_y / 2)
    turned = order * np.angle(from_centre)
    angular = np.sin(turned) if bits == LpPhase.SIN_M else np.cos(turned)
    return _bessel(order, wave_number * np.abs(from_centre)) * angular


OF_A_BOX = ('container', 'density', 'aspect', 'boundary_x', 'boundary_y')
WITHOUT_ASPECT = {'circle'}
MODULATIONS = {'circle': _in_a_circle}
