"""Nodes of a wave -> its modulation A(x, y), as the node defines it."""

import numpy as np

SIN_X, SIN_Y = 1, 2  # bits of LpPhase's constants for a modulation
FUNCTIONS = (np.cos, np.sin)
SLOPES = (lambda phase: -np.sin(phase), np.cos)  # their derivatives


def wave_vector(info, nx, ny):
    """Along a reflecting direction the wave fits into what a disk's centre can reach."""
    return [
        2 * np.pi * n / box if boundary == 'periodic' else np.pi * n / (box - 1)
        for n, box, boundary in (
            (nx, info.box_x, info.boundary_x),
            (ny, info.box_y, info.boundary_y),
        )
    ]


def modulation(info, nx, ny, bits, x, y):
    """A at the given positions."""
    along_x, along_y = (
        FUNCTIONS[sine](phase) for _, phase, sine in _phases(info, nx, ny, bits, x, y)
    )
    return along_x * along_y


def gradient(info, nx, ny, bits, x, y):
    """dA/dx and dA/dy at the given positions."""
    value, slope = zip(
        *(
            (FUNCTIONS[sine](phase), k * SLOPES[sine](phase))
            for k, phase, sine in _phases(info, nx, ny, bits, x, y)
        )
    )
    return slope[0] * value[1], value[0] * slope[1]


def _phases(info, nx, ny, bits, x, y):
    """(k, k q, whether A has a sine of it) along x and along y."""
    starts = (
        0.0 if boundary == 'periodic' else 0.5 for boundary in (info.boundary_x, info.boundary_y)
    )
    for k, q, start, sine in zip(
        wave_vector(info, nx, ny), (x, y), starts, (bits & SIN_X, bits & SIN_Y)
    ):
        yield k, k * (np.asarray(q) - start), bool(sine)


def modulations(info, nx, ny, transverse=False):
    """The modulations that the boundaries allow for the L and P fields of a wave vector, or for its
    T fields."""
    along = []
    for n, boundary in ((nx, info.boundary_x), (ny, info.boundary_y)):
        if boundary == 'periodic':
            along.append((False, True) if n else (False,))
        else:
            along.append(((True,) if n else ()) if transverse else (False,))
    return [SIN_X * sine_x + SIN_Y * sine_y for sine_y in along[1] for sine_x in along[0]]


def formula(nx, ny, bits):
    """A as text for a figure."""
    return (
        '$'
        + r'\,'.join(f'\\{function} k_{axis} {axis}' for function, axis in _factors(nx, ny, bits))
        + '$'
    )


def plain_formula(nx, ny, bits):
    """A as text for a terminal."""
    return ' '.join(f'{function} k{axis} {axis}' for function, axis in _factors(nx, ny, bits))


def _factors(nx, ny, bits):
    return [
        ('sin' if sine else 'cos', axis)
        for axis, n, sine in (('x', nx, bits & SIN_X), ('y', ny, bits & SIN_Y))
        if n
    ]
