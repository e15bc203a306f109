"""Nodes of a wave -> its modulation A(x, y), as the node defines it."""

import numpy as np

SIN_X, SIN_Y = 1, 2  # bits of LpPhase's constants for a modulation
COS_M, SIN_M = 4, 5  # those of a circle
FUNCTIONS = (np.cos, np.sin)
POINTS = 256  # of a period: enough for k r up to 100
SLOPES = (lambda phase: -np.sin(phase), np.cos)  # their derivatives


def is_round(info):
    """Whether the container is a circle: its radius is half of box_x, its centre (R, R)."""
    return info.boundary_x == 'curved'


def bessel(order, x):
    """J_m(x), by its integral over a period, which the sum has to the last digits."""
    turn = 2 * np.pi * np.arange(POINTS) / POINTS
    x = np.asarray(x)[..., np.newaxis]
    return np.cos(order * turn - x * np.sin(turn)).mean(axis=-1)


def round_modulation(info, wave_number, order, bits, x, y):
    """A of L and P fields in a circle."""
    from_centre = np.asarray(x) - info.box_x / 2 + 1j * (np.asarray(y) - info.box_y / 2)
    turned = order * np.angle(from_centre)
    angular = np.sin(turned) if bits == SIN_M else np.cos(turned)
    return bessel(order, wave_number * np.abs(from_centre)) * angular


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
    if bits >= COS_M:
        turned = '' if nx == 0 else rf'\,\{FUNCTIONS[bits - COS_M].__name__} {_times(nx)}\theta'
        return f'$J_{{{nx}}}(k r){turned}$'
    return (
        '$'
        + r'\,'.join(f'\\{function} k_{axis} {axis}' for function, axis in _factors(nx, ny, bits))
        + '$'
    )


def plain_formula(nx, ny, bits):
    """A as text for a terminal."""
    if bits >= COS_M:
        turned = f' {FUNCTIONS[bits - COS_M].__name__} {_times(nx)}theta' if nx else ''
        return f'J{nx}(kr){turned}'
    return ' '.join(f'{function} k{axis} {axis}' for function, axis in _factors(nx, ny, bits))


def _times(count):
    return '' if count == 1 else count


def _factors(nx, ny, bits):
    return [
        ('sin' if sine else 'cos', axis)
        for axis, n, sine in (('x', nx, bits & SIN_X), ('y', ny, bits & SIN_Y))
        if n
    ]
