"""How particles turn -> their colours, as in rviz: green to the left, purple to the right."""

import numpy as np
from matplotlib.colors import to_rgb

from hdlyap.data import space

LEFT, RIGHT = '#7FBF7B', '#AF8DC3'
KT = 2 / 3  # of what turns in the plane


def strength(field):
    """Root mean square of dq at a particle, with what turns it."""
    squares = np.sum(space.vectors(field, 'dq') ** 2, axis=0)
    if len(field.dq_angle):
        squares += np.square(field.dq_angle)
    return np.sqrt(np.mean(squares))


def of_vector(field, still):
    """Full where it turns one as strongly as all of it is; still: the colour of what does not
    turn."""
    return _colours(np.array(field.dq_angle) / strength(field), still)


def of_spins(info, spins, still):
    """Full from twice the thermal spin on."""
    return _colours(np.array(spins) / (2 * np.sqrt(KT / info.inertia)), still)


def _colours(parts, still):
    parts = np.clip(parts, -1, 1)[:, np.newaxis]
    full = np.where(parts > 0, to_rgb(LEFT), to_rgb(RIGHT))
    return (1 - abs(parts)) * to_rgb(still) + abs(parts) * full
