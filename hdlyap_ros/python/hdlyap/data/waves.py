"""Nodes of a wave -> its modulation A(x, y), in space A(x, y, z), and its fields, as the node
defines them."""

import numpy as np

from hdlyap.msg import LpPhase

from . import space

# bits of a modulation in a box, and in a circle
SIN_X, SIN_Y, SIN_Z, SECOND = LpPhase.SIN_COS, LpPhase.COS_SIN, LpPhase.SIN_Z, LpPhase.SECOND
COS_M, SIN_M = LpPhase.COS_M, LpPhase.SIN_M
SINES = {'x': SIN_X, 'y': SIN_Y, 'z': SIN_Z}
FUNCTIONS = (np.cos, np.sin)
SLOPES = (lambda phase: -np.sin(phase), np.cos)  # derivatives of cosine and sine


def wave_vector(info, nx, ny, nz=0):
    """The wave vector. In a reflecting direction the wave fits into the room that centres can
    reach."""
    walls = zip((nx, ny, nz), space.along(info, 'box_'), space.along(info, 'boundary_'))
    return [
        2 * np.pi * n / box if boundary == 'periodic' else np.pi * n / (box - 1)
        for n, box, boundary in walls
    ]


def modulation(info, nx, ny, bits, x, y, nz=0, z=0.0):
    """The modulation A at the given positions."""
    factors = _factors_at(info, (nx, ny, nz), bits, (x, y, z))
    return np.prod([value for value, _ in factors], axis=0)


def gradient(info, nx, ny, bits, x, y, nz=0, z=0.0):
    """dA/dx, dA/dy and, in space, dA/dz at the given positions."""
    value, slope = zip(*_factors_at(info, (nx, ny, nz), bits, (x, y, z)))
    return tuple(
        np.prod([*value[:d], slope[d], *value[d + 1 :]], axis=0) for d in range(len(value))
    )


def _factors_at(info, nodes, bits, q):
    """For each direction the cosine or sine of k q, and its derivative; arrays of one size."""
    directions = zip(
        wave_vector(info, *nodes), np.broadcast_arrays(*q), space.along(info, 'boundary_'), SINES
    )
    for k, one, boundary, axis in directions:
        phase, sine = k * (one - (0.0 if boundary == 'periodic' else 0.5)), bool(bits & SINES[axis])
        yield FUNCTIONS[sine](phase), k * SLOPES[sine](phase)


def longitudinal(info, nodes, bits, q):
    """The field L at positions q, with a row for each direction."""
    return np.array(gradient(info, *nodes[:2], bits, *q[:2], *nodes[2:], *q[2:]))


def transverse(info, nodes, bits, q):
    """The field T at positions q: curl A. In space its component along d is e_d times dA/dq_d over
    k_d, or times A if there are no nodes along d; e is a unit vector across k, and SECOND takes the
    other one of two."""
    if not space.is_solid(info):
        along_x, along_y = longitudinal(info, nodes, bits, q)
        return np.array([along_y, -along_x])
    a = modulation(info, *nodes[:2], bits, *q[:2], *nodes[2:], *q[2:])
    k, e = wave_vector(info, *nodes), _across(info, nodes)[bool(bits & SECOND)]
    slopes = longitudinal(info, nodes, bits, q)
    return np.array([e[d] * (slopes[d] / k[d] if nodes[d] else a) for d in range(3)])


def _across(info, nodes):
    """Two unit vectors across k. The first one has no part along z or, if there is one, along the
    last direction with walls and no nodes, because nothing goes through a wall."""
    walls = [boundary != 'periodic' for boundary in space.along(info, 'boundary_')]
    still = [d for d in range(3) if walls[d] and not nodes[d]]
    k = np.array(wave_vector(info, *nodes))
    one = np.cross(np.eye(3)[still[-1] if still else 2], k)
    one = one if one.any() else np.eye(3)[0]
    other = np.cross(k, one)
    return one / np.linalg.norm(one), other / np.linalg.norm(other)


def modulations(info, nx, ny, transverse=False, nz=0):
    """The modulations that the boundaries allow for the L and P fields of a wave vector, or for its
    T fields."""
    if transverse and space.is_solid(info):
        return _of_spheres(info, (nx, ny, nz))
    found = [0]
    for (axis, sine), n in zip(SINES.items(), (nx, ny, nz)[: len(space.axes(info))]):
        if getattr(info, 'boundary_' + axis) == 'periodic':
            functions = (0, sine) if n else (0,)
        else:
            functions = ((sine,) if n else ()) if transverse else (0,)
        found = [bits + function for function in functions for bits in found]
    return found


def _of_spheres(info, nodes):
    """The modulations of T fields: those of L fields for each e across k; walls without nodes
    between them forbid one e."""
    of_l = modulations(info, *nodes[:2], nz=nodes[2])
    free = sum(
        n > 0 or wall == 'periodic' for n, wall in zip(nodes, space.along(info, 'boundary_'))
    )
    return [bits + second for second in (0, SECOND)[: free - 1] for bits in of_l]


def formula(nx, ny, bits, nz=0):
    """The modulation A as text for a figure."""
    if bits >= COS_M:
        turned = '' if nx == 0 else rf'\,\{FUNCTIONS[bits - COS_M].__name__} {_times(nx)}\theta'
        return f'$J_{{{nx}}}(k r){turned}$'
    factors = _factors((nx, ny, nz), bits)
    named = r'\,'.join(f'\\{function} k_{axis} {axis}' for function, axis in factors)
    return f'${named}$' + _which(bits)


def plain_formula(nx, ny, bits, nz=0):
    """The modulation A as text for a terminal."""
    if bits >= COS_M:
        turned = f' {FUNCTIONS[bits - COS_M].__name__} {_times(nx)}theta' if nx else ''
        return f'J{nx}(kr){turned}'
    factors = _factors((nx, ny, nz), bits)
    return ' '.join(f'{function} k{axis} {axis}' for function, axis in factors) + _which(bits)


def _which(bits):
    """Which of the two T fields of one A this is, as text."""
    return ', second' if bits & SECOND else ''


def _times(count):
    return '' if count == 1 else count


def _factors(nodes, bits):
    axes = [sine for sine, n in zip(SINES.items(), nodes) if n]
    return [('sin' if bits & sine else 'cos', axis) for axis, sine in axes]
