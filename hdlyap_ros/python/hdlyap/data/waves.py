"""Nodes of a wave -> its modulation A(x, y), of spheres A(x, y, z), and its fields, as the node
defines them."""

import numpy as np

from hdlyap.msg import LpPhase

from . import space

# bits of a modulation, and those of a circle
SIN_X, SIN_Y, SIN_Z, SECOND = LpPhase.SIN_COS, LpPhase.COS_SIN, LpPhase.SIN_Z, LpPhase.SECOND
COS_M, SIN_M = LpPhase.COS_M, LpPhase.SIN_M
SINES = {'x': SIN_X, 'y': SIN_Y, 'z': SIN_Z}
FUNCTIONS = (np.cos, np.sin)
SLOPES = (lambda phase: -np.sin(phase), np.cos)  # their derivatives


def wave_vector(info, nx, ny, nz=0):
    """Along a reflecting direction the wave fits into what a disk's centre can reach."""
    walls = zip((nx, ny, nz), space.along(info, 'box_'), space.along(info, 'boundary_'))
    return [
        2 * np.pi * n / box if boundary == 'periodic' else np.pi * n / (box - 1)
        for n, box, boundary in walls
    ]


def modulation(info, nx, ny, bits, x, y, nz=0, z=0.0):
    """A at the given positions."""
    factors = _factors_at(info, (nx, ny, nz), bits, (x, y, z))
    return np.prod([value for value, _ in factors], axis=0)


def gradient(info, nx, ny, bits, x, y, nz=0, z=0.0):
    """dA/dx, dA/dy and of spheres dA/dz at the given positions."""
    value, slope = zip(*_factors_at(info, (nx, ny, nz), bits, (x, y, z)))
    return tuple(
        np.prod([*value[:d], slope[d], *value[d + 1 :]], axis=0) for d in range(len(value))
    )


def _factors_at(info, nodes, bits, q):
    """Of each direction the cosine or sine of k q, and its derivative; arrays of one size."""
    directions = zip(
        wave_vector(info, *nodes), np.broadcast_arrays(*q), space.along(info, 'boundary_'), SINES
    )
    for k, one, boundary, axis in directions:
        phase, sine = k * (one - (0.0 if boundary == 'periodic' else 0.5)), bool(bits & SINES[axis])
        yield FUNCTIONS[sine](phase), k * SLOPES[sine](phase)


def longitudinal(info, nodes, bits, q):
    """L at positions q, rows of each direction."""
    return np.array(gradient(info, *nodes[:2], bits, *q[:2], *nodes[2:], *q[2:]))


def transverse(info, nodes, bits, q):
    """T at positions q: curl A; of spheres e along each direction times A derived along it, e
    across k, of which SECOND is the other one."""
    if not space.is_solid(info):
        along_x, along_y = longitudinal(info, nodes, bits, q)
        return np.array([along_y, -along_x])
    a = modulation(info, *nodes[:2], bits, *q[:2], *nodes[2:], *q[2:])
    k, e = wave_vector(info, *nodes), _across(info, nodes)[bool(bits & SECOND)]
    slopes = longitudinal(info, nodes, bits, q)
    return np.array([e[d] * (slopes[d] / k[d] if nodes[d] else a) for d in range(3)])


def _across(info, nodes):
    """Two unit vectors across k: of the first the part along z vanishes, or along the last
    direction that has walls and no nodes, as nothing goes through a wall."""
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
    """Of T: those of L, for each e across k; a wall without nodes along it forbids one."""
    of_l = modulations(info, *nodes[:2], nz=nodes[2])
    free = sum(
        n > 0 or wall == 'periodic' for n, wall in zip(nodes, space.along(info, 'boundary_'))
    )
    return [bits + second for second in (0, SECOND)[: free - 1] for bits in of_l]


def formula(nx, ny, bits, nz=0):
    """A as text for a figure."""
    if bits >= COS_M:
        turned = '' if nx == 0 else rf'\,\{FUNCTIONS[bits - COS_M].__name__} {_times(nx)}\theta'
        return f'$J_{{{nx}}}(k r){turned}$'
    factors = _factors((nx, ny, nz), bits)
    named = r'\,'.join(f'\\{function} k_{axis} {axis}' for function, axis in factors)
    return f'${named}$' + _which(bits)


def plain_formula(nx, ny, bits, nz=0):
    """A as text for a terminal."""
    if bits >= COS_M:
        turned = f' {FUNCTIONS[bits - COS_M].__name__} {_times(nx)}theta' if nx else ''
        return f'J{nx}(kr){turned}'
    factors = _factors((nx, ny, nz), bits)
    return ' '.join(f'{function} k{axis} {axis}' for function, axis in factors) + _which(bits)


def _which(bits):
    """Of both T fields of one A."""
    return ', second' if bits & SECOND else ''


def _times(count):
    return '' if count == 1 else count


def _factors(nodes, bits):
    axes = [sine for sine, n in zip(SINES.items(), nodes) if n]
    return [('sin' if bits & sine else 'cos', axis) for axis, sine in axes]
