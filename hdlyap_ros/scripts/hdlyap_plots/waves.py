"""Nodes of a wave -> its modulation A(x, y), as the node defines it."""

import numpy as np

SIN_X, SIN_Y = 1, 2     # bits of LpPhase's constants for a modulation
FUNCTIONS = (np.cos, np.sin)


def wave_vector(info, nx, ny):
    """Along a reflecting direction the wave fits into what a disk's centre can reach."""
    return [2 * np.pi * n / box if boundary == 'periodic' else np.pi * n / (box - 1)
            for n, box, boundary in ((nx, info.box_x, info.boundary_x),
                                     (ny, info.box_y, info.boundary_y))]


def modulation(info, nx, ny, bits, x, y):
    """A at the given positions."""
    a = 1.0
    for k, q, boundary, sine in zip(wave_vector(info, nx, ny), (x, y),
                                    (info.boundary_x, info.boundary_y),
                                    (bits & SIN_X, bits & SIN_Y)):
        start = 0.0 if boundary == 'periodic' else 0.5
        a = a * FUNCTIONS[bool(sine)](k * (np.asarray(q) - start))
    return a


def formula(nx, ny, bits):
    """A as text for a figure."""
    return '$' + r'\,'.join(f'\\{function} k_{axis} {axis}'
                              for function, axis in _factors(nx, ny, bits)) + '$'


def plain_formula(nx, ny, bits):
    """A as text for a terminal."""
    return ' '.join(f'{function} k{axis} {axis}' for function, axis in _factors(nx, ny, bits))


def _factors(nx, ny, bits):
    return [('sin' if sine else 'cos', axis)
            for axis, n, sine in (('x', nx, bits & SIN_X), ('y', ny, bits & SIN_Y)) if n]
