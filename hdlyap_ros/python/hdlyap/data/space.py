"""Kind of particles -> the directions of space, x, y and z, in a run_info or a message; names of
particles, and where the disks of dumbbells are."""

import numpy as np

from hdlyap.parameters import own

# parameters of runs whose particles are in a box
OF_A_BOX = (
    'container density aspect aspect_z boundary_x boundary_y boundary_z shear_b '
    'max_wave_number max_mode_number'
).split()


def is_solid(info):
    """Whether particles are spheres; info = None stands for disks."""
    return info is not None and info.dimension == 3


def turns(info):
    """Whether particles have an angle besides their position; info = None stands for disks."""
    return info is not None and info.inertia > 0


PAIRS = '11', '12', '22'  # of two kinds of particles


def is_mixture(info):
    """Whether particles are of two kinds; info = None stands for disks."""
    return info is not None and len(info.kind_numbers) > 1


def are_units(info):
    """Whether all particles have the diameter and the mass that are the units."""
    return {*info.kind_diameters, *info.kind_masses} <= {1.0}


def shows(messages, names):
    """Whether one of these messages, or of their elements, has something in fields of these
    names."""
    for message in messages:
        for name in message.__slots__:
            value = getattr(message, name)
            if name in names and np.any(np.nan_to_num(value)):
                return True
            is_list = isinstance(value, list) and value and hasattr(value[0], '__slots__')
            if is_list and shows(value, names):
                return True
    return False


def without_box(info):
    """A text about particles that have no positions in a box; '' for others."""
    if info.dimension or not info.particles:
        return ''
    own_ones = [f'{one.name}={one.effect}' for one in info.parameters if one.own]
    return ', '.join([f'{info.particles}, N = {info.number}', *own_ones])


def axes(info):
    return 'xyz' if is_solid(info) else 'xy'


def unit(text, info):
    """The unit of a field in which d stands for the number of directions."""
    return text.replace('^d', f'^{len(axes(info))}')


def along(info, name):
    """The values of box_ or boundary_ for each direction."""
    return [getattr(info, name + axis) for axis in axes(info)]


def nodes(wave, info):
    """The nodes along each direction, of a Step or of anything else with nx and ny."""
    return tuple(getattr(wave, 'n' + axis) for axis in axes(info))


def has_others(info):
    """Whether particles have other coordinates than positions in a box and an angle."""
    return not info.dimension or info.coordinates > info.dimension + turns(info)


def vectors(message, name=''):
    """Rows along x, y and, in space, z: of positions, or of fields with a name before the axis,
    such as dq and p_."""
    rows = (getattr(message, name + axis) for axis in 'xyz')
    return np.array([row for row in rows if len(row)])


def diameters(info):
    """The diameter of each particle."""
    return np.repeat(info.kind_diameters, info.kind_numbers)


def roots(info):
    """The root of the mass of each particle, by which coordinates of vectors are weighted."""
    return np.sqrt(np.repeat(info.kind_masses, info.kind_numbers))


def displacements(field, info):
    """Rows of the displacements of particles by a vector."""
    return vectors(field, 'dq') / roots(info)


def particle(info):
    """What a particle is called."""
    name = _words(info.particles)
    return name[:-1] if name.endswith('s') else 'particle'


def named(info):
    """The text after the number of particles if they are not disks of one kind: their name and
    their parameters."""
    own_ones = [f'{_words(name)} {_short(value)}' for name, value in own(info).items()]
    if info.particles == 'disks' and not own_ones:
        return ''
    return ', '.join([f' {_words(info.particles)}', *own_ones])


def shear(info, said='shear b {:g}'):
    """The text behind the boundaries if walls shear; '' for others."""
    return ', ' + said.format(info.shear_b) if 'shearing' in along(info, 'boundary_') else ''


def _words(name):
    return name.replace('_', ' ')


def _short(value):
    return f'{value:.4g}' if isinstance(value, float) else _words(f'{value}')


def disks(info, q, angle=()):
    """Rows of positions as vectors() gives them, for each disk of a particle."""
    if len(info.sites) <= 1:
        return [q]
    arm = np.array([np.cos(angle), np.sin(angle)])
    return [q + site * arm for site in info.sites]


def size(info):
    """The area or volume of the box."""
    return float(np.prod(along(info, 'box_')))


def distance(info):
    """The mean distance of neighbours."""
    return (size(info) / info.number) ** (1 / len(axes(info)))


def phase_space(info):
    """The number of Lyapunov exponents: 4 N for disks, 6 N for spheres."""
    return 2 * info.coordinates * info.number
