"""Rotation of particles -> their colours, as in rviz: green to the left, purple to the right."""

import numpy as np
from matplotlib.colors import to_rgb

from hdlyap.data import space

LEFT, RIGHT = '#7FBF7B', '#AF8DC3'
KT = 2 / 3  # temperature of particles in the plane that rotate


def strength(field, info):
    """The root mean square, over particles, of displacements with their part in the angles."""
    squares = np.sum(space.displacements(field, info) ** 2, axis=0)
    if len(field.dq_angle):
        squares += np.square(field.dq_angle)
    return np.sqrt(np.mean(squares))


def of_vector(field, info, still):
    """Colours by a vector's part in the angles. The colour is full if that part is at least
    strength(); still: the colour of particles that do not rotate."""
    return _colours(np.array(field.dq_angle) / strength(field, info), still)


def of_spins(info, spins, still):
    """Colours by spins. The colour is full at twice the thermal spin or more."""
    return _colours(np.array(spins) / (2 * np.sqrt(KT / info.inertia)), still)


def _colours(parts, still):
    parts = np.clip(parts, -1, 1)[:, np.newaxis]
    full = np.where(parts > 0, to_rgb(LEFT), to_rgb(RIGHT))
    return (1 - abs(parts)) * to_rgb(still) + abs(parts) * full
