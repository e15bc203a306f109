"""What messages of hdlyap_node can say: numbers in their ranges, arrays whose lengths fit. check()
refuses all else, so that whoever reads a message may rely on it. Comments of the .msg say which
numbers may be NaN, and which are 'one of FIRST .. LAST'; the tables here have the rest."""

import math
import re
from collections import namedtuple
from functools import lru_cache

import numpy as np

from hdlyap import msg

from . import fields, space

LARGEST = 1e150  # largest number, so that its square is one, too
LEAST = 1 / LARGEST  # least number above 0
COUNT = 2**62  # largest integer
PARTICLES, COORDINATES = 10**6, 1000  # most of a run, as of the parameter number
MOST_OWN = 16  # most parameters that only some particles have
VECTORS = 2**16  # most zero exponents, and most vectors of a set
WAVES = 10**6  # largest mode number
EXPONENTS = 'exponents'  # stands for the number of exponents of the run
# least and largest number of a field, of one message or of all
RANGES = {
    'RunInfo.number': (1, PARTICLES),
    'RunInfo.dimension': (0, 3),
    'RunInfo.coordinates': (1, COORDINATES),
    'RunInfo.inertia': (0, LARGEST),
    **dict.fromkeys((f'RunInfo.box_{axis}' for axis in 'xyz'), (0, 1e9)),
    'RunInfo.vectors': (0, EXPONENTS),
    'RunInfo.zero_exponents': (0, VECTORS),
    **dict.fromkeys((f'Steps.{letter}_k_min' for letter in 'tlv'), (LEAST, LARGEST)),
    'Step.expected': (1, VECTORS),
    'Step.multiplicity': (0, VECTORS),
    'Step.first_index': (0, EXPONENTS),
    'CovariantWeight.dimension': (1, VECTORS),
    'ModeField.pairs': (0, 8),
    'index': (0, EXPONENTS),
    'indices': (1, EXPONENTS),
    'modulation': (0, msg.LpPhase.SIN_M),
    'first_index': (1, EXPONENTS),
    'last_index': (0, EXPONENTS),
    **dict.fromkeys(('nx', 'ny', 'nz', 'wave_nx', 'wave_ny', 'wave_nz'), (0, WAVES)),
    **dict.fromkeys(('wave_number', 'threshold', 'averaged_time', 'sim_time'), (0, LARGEST)),
}
ANY = ('condition',)  # numbers that may be infinite
# arrays of the same length
ALIKE = {
    'RunInfo': (('outline_x', 'outline_y'),),
    'Spectrum': (('exponents', 'std_errors', 'local_exponents', 'cos_theta', 'dp_dq_ratio'),),
    'State': (('x', 'y', 'px', 'py'),),
    'Structure': (('nx', 'ny', 'wave_number'),),
    'ModeField': (
        ('x', 'y', 'px', 'py', 'dqx', 'dqy', 'dpx', 'dpy'),
        ('modulation', 'residual_l', 'residual_p'),
        ('p_x', 'p_y', 'p_over_px', 'p_over_py'),
    ),
    'Covariant': (
        ('exponents', 'std_errors', 'local_exponents', 'start_mismatch', 'widths', 'cos_theta'),
        ('neighbour_angles', 'least_neighbour_angles', 'violations', 'domination_violations'),
    ),
    'CovariantAngle': (('smallest_counts', 'all_counts'),),
    'CovariantWeight': (('dq', 'dp', 'gram_schmidt'),),
    'GrowthOrder': (('violations', 'domination_violations'),),
    'Localization': (('widths', 'std_errors', 'widths_now'),),
    'Fluctuations': (('diffusions', 'std_errors'),),
}
# arrays of the length of the first ones in space, or if particles rotate; otherwise they are empty
OF_SPHERES = {'State': ('z', 'pz'), 'ModeField': ('z', 'pz', 'dqz', 'dpz'), 'Structure': ('nz',)}
OF_TURNING = {'State': ('angle', 'spin'), 'ModeField': ('angle', 'spin', 'dq_angle', 'dp_angle')}
NOT_EMPTY = {'Spectrum': 'exponents', 'Localization': 'widths', 'Fluctuations': 'diffusions'}
AMPLITUDES = 'amplitude_along', 'amplitude_across'
OF_RESOLVED = 'multiplicity', 'exponent', 'set_time', 'own_part'  # NaN unless resolved
PAIRED = 'covariances', 'covariance_errors', 'variances', 'reversals'
SHOWN = 80  # most characters of a value that are shown
WORD = re.compile(r'[\w.+-]+', re.ASCII)
WALLS = 'periodic', 'reflecting', 'curved'

Rule = namedtuple('Rule', 'name least most may_be_nan parts')


class Damaged(Exception):
    """A message says something that no node can have sent."""


def check(message, info=None):
    """Raises Damaged if no node can have sent this message in the run with this run_info; None if
    that is not known."""
    about = message if isinstance(message, msg.RunInfo) else info
    most = 2 * COORDINATES * PARTICLES if about is None else space.phase_space(about)
    _check_parts([message], max(most, 1))
    if _name(message) in CHECKS:
        CHECKS[_name(message)](message)
    if about is not None and isinstance(message, (msg.State, msg.ModeField)):
        _check_particles(message, about)


def _name(message):
    return message._type.partition('/')[2]


def _check_particles(message, info):
    there = {'x': True, 'z': space.is_solid(info), 'angle': space.turns(info)}
    for name, is_there in there.items():
        found, wanted = len(getattr(message, name)), info.number * is_there
        _refuse_unless(found == wanted, message, name, found, wanted)


def _refuse_unless(is_right, message, names, found, wanted):
    if not is_right:
        raise Damaged(f'hdlyap/{_name(message)}: {names} has {found} elements: must be {wanted}')


# ---- numbers ------------------------------------------------------------------------------------


@lru_cache(maxsize=None)
def _rules(kind):
    """The Rule of each field that holds numbers or other messages."""
    described, found = fields.of(kind), []
    for name, slot in zip(kind.__slots__, kind._slot_types):
        base = slot.partition('[')[0]
        if base.startswith('hdlyap/'):
            found.append(Rule(name, None, None, False, True))
        elif base not in ('string', 'std_msgs/Header'):
            found.append(_rule(kind, name, base == 'float64', described[name]))
    return found


def _rule(kind, name, is_real, field):
    ends = (-LARGEST, LARGEST) if is_real else (-COUNT, COUNT)
    if field.is_choice:
        values = fields.words(kind, name)
        ends = min(values), max(values)
    ends = RANGES.get(f'{_name(kind)}.{name}', RANGES.get(name, ends))
    if name in ANY:
        ends = -math.inf, math.inf
    return Rule(name, *ends, field.may_be_nan, False)


def _check_parts(parts, most):
    """Checks the numbers of messages of one type, field by field."""
    for rule in _rules(type(parts[0])):
        values = [getattr(part, rule.name) for part in parts]
        if rule.parts:
            inside = [one for value in values for one in value]
            if inside:
                _check_parts(inside, most)
            continue
        if values and hasattr(values[0], '__len__'):
            values = np.concatenate([_array(value) for value in values])
        _check_values(parts[0], rule, np.array(values, dtype=float), most)
    for part in parts:
        _check_lengths(part)


def _array(value):
    return np.frombuffer(value, np.uint8) if isinstance(value, bytes) else np.asarray(value)


def _check_values(message, rule, values, most):
    largest = most if rule.most == EXPONENTS else rule.most
    with np.errstate(invalid='ignore'):
        wrong = ~((values >= rule.least) & (values <= largest))
    if rule.may_be_nan:
        wrong &= ~np.isnan(values)
    if wrong.any():
        value = values[np.argmax(wrong)]
        ends = f'must be from {rule.least:.12g} to {largest:.12g}'
        raise Damaged(f'hdlyap/{_name(message)}: {rule.name} = {value:.12g}: {ends}')


# ---- lengths ------------------------------------------------------------------------------------


def _check_lengths(message):
    name = _name(message)
    for number, alike in enumerate(ALIKE.get(name, ())):
        lengths = {len(getattr(message, one)) for one in alike}
        for of_some in (OF_SPHERES, OF_TURNING) if number == 0 else ():
            found = {len(getattr(message, one)) for one in of_some.get(name, ())}
            lengths |= found if found != {0} else set()
        if len(lengths) > 1:
            what = f'{", ".join(alike)}: arrays that must be equally long'
            raise Damaged(f'hdlyap/{name}: {what} have {sorted(lengths)} elements')
    if name in NOT_EMPTY and not len(getattr(message, NOT_EMPTY[name])):
        raise Damaged(f'hdlyap/{name}: no {NOT_EMPTY[name]}')


# ---- what only some messages have ---------------------------------------------------------------


def _of_run_info(info):
    """Sizes, words, and the particles' own parameters."""
    sizes = [info.density, info.aspect, info.box_x, info.box_y]
    if space.is_solid(info):
        sizes += [info.aspect_z, info.box_z]
    if not all(size > 0 for size in sizes):
        raise Damaged(f'hdlyap/RunInfo: density, aspect and box {tuple(sizes)}: must be above 0')
    for name in ('particles', 'container', 'boundary_x', 'boundary_y', 'boundary_z'):
        _refuse_other(
            WORD.fullmatch(getattr(info, name) or '-'), name, getattr(info, name), 'a word'
        )
    for axis in space.axes(info) if info.dimension else '':
        wall = getattr(info, 'boundary_' + axis)
        _refuse_other(wall in WALLS, 'boundary_' + axis, wall, f'one of {", ".join(WALLS)}')
    _refuse_other(
        len(info.own) <= MOST_OWN, 'own', f'{len(info.own)} elements', f'at most {MOST_OWN}'
    )
    for one in info.own:
        name, _, value = one.partition('=')
        is_right = WORD.fullmatch(name) and WORD.fullmatch(value)
        _refuse_other(is_right, 'own', one, 'name=value, with a number or a word')
    bond = space.own(info).get('bond', 1.0) if info.particles == 'dumbbells' else 1.0
    is_length = isinstance(bond, (int, float)) and 0 <= bond < LARGEST
    _refuse_other(is_length, 'own: bond', bond, 'a length')


def _refuse_other(is_right, name, value, allowed):
    if not is_right:
        raise Damaged(f'hdlyap/RunInfo: {name} = {f"{value}"[:SHOWN]}: must be {allowed}')


def _of_steps(message):
    for step in message.steps:
        names = f'hdlyap/Step: first_index, last_index = {step.first_index}, {step.last_index}'
        if step.resolved and not 1 <= step.first_index <= step.last_index:
            raise Damaged(f'{names}: must go up, from 1')
        for name in OF_RESOLVED:
            if step.resolved and math.isnan(getattr(step, name)):
                raise Damaged(f'hdlyap/Step: {name} = nan: must be a number, as it is resolved')
        if step.last_index - step.first_index >= VECTORS:
            raise Damaged(f'{names}: must be less than {VECTORS} apart')
        if step.kind != step.ZERO and not step.wave_number >= LEAST:
            raise Damaged(f'hdlyap/Step: wave_number = {step.wave_number:g}: must be above 0')


def _of_field(field):
    pairs, numbers, is_solid = field.pairs, field.pairs * len(field.x), len(field.z) > 0
    _refuse_unless(
        len(field.modulation) == pairs, field, 'modulation', len(field.modulation), pairs
    )
    for name, wanted in zip(('p_x', 'p_z', 'p_over_pz'), (numbers, *2 * [numbers * is_solid])):
        found = len(getattr(field, name))
        _refuse_unless(found == wanted, field, name, found, wanted)


def _of_structure(message):
    n, waves = len(message.peak), len(message.nx)
    means = {len(message.along), len(message.across)}
    now = [len(getattr(message, name)) for name in AMPLITUDES]
    solid = waves and len(message.nz)
    if means not in ({0}, {n * waves}) or now != ([8 * n, 16 * n] if solid else [4 * n, 4 * n]):
        found = f'{sorted(means | set(now))} elements of {n} vectors, {waves} waves'
        raise Damaged(f'hdlyap/Structure: {found}')
    strongest = max(message.peak, default=0)
    _refuse_unless(strongest <= waves, message, f'wave {strongest} of peak: nx', waves, 'more')


def _in_orders(message):
    """How many pairs of neighbours the orders of a message have."""
    return {len(one.violations) for one in message.orders}


def _of_covariant(message):
    n = len(message.exponents)
    found = _in_orders(message) | {len(message.violations)}
    if found - {max(n - 1, 0)}:
        raise Damaged(f'hdlyap/Covariant: {n} vectors, pairs {found}')
    for weight in message.weights:
        _refuse_unless(len(weight.dq) == n, weight, 'dq', len(weight.dq), n)


def _of_fluctuations(message):
    vectors, times = len(message.diffusions), len(message.orders)
    indices = [index for step in message.steps for index in step.indices]
    pairs = len(message.steps) ** 2
    found = {name: len(getattr(message, name)) for name in PAIRED}
    of_orders = _in_orders(message)
    name = 'hdlyap/Fluctuations'
    if list(found.values()) != [pairs, pairs, times * vectors, times * pairs]:
        raise Damaged(f'{name}: {vectors} vectors, {times} times, {pairs} pairs, {found}')
    first = message.first_index
    if of_orders - {vectors - 1} or set(indices) - set(range(first, first + vectors)):
        raise Damaged(f'{name}: {vectors} vectors, pairs {of_orders}, indices {indices}')


CHECKS = {
    'RunInfo': _of_run_info,
    'Steps': _of_steps,
    'ModeField': _of_field,
    'Structure': _of_structure,
    'Covariant': _of_covariant,
    'Fluctuations': _of_fluctuations,
}
