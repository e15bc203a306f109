"""What messages of hdlyap_node can say: numbers in their ranges, arrays whose lengths fit. check()
refuses all else, so that whoever reads a message may rely on it. Comments of the .msg say which
numbers may be NaN, and which are 'one of FIRST .. LAST'; the tables here have the rest."""

import math
import re
from collections import namedtuple
from functools import lru_cache

import numpy as np

from hdlyap import msg, parameters

from . import fields, space

LARGEST = 1e150  # largest number, so that its square is one, too
LEAST = 1 / LARGEST  # least number above 0
COUNT = 2**62  # largest integer
PARTICLES, COORDINATES = 10**6, 1000  # most of a run, as of the parameter number
# parameters that every run has, those of a box in a box, and the type of their values
TEXTS = 'scene particles container seed field_indices boundary_x boundary_y boundary_z'
NEEDED = dict.fromkeys(TEXTS.split(), str)
NEEDED.update(number=int, observables=list, density=float, aspect=float, aspect_z=float)
KINDS = {str: 'a text', int: 'an integer', float: 'a number', list: 'a list'}
SITES, KINDS_MOST = 8, 8  # most disks of a particle, most kinds of particles
VECTORS = 2**16  # most zero exponents, and most vectors of a set
WAVES = 10**6  # largest mode number
EXPONENTS = 'exponents'  # stands for the number of exponents of the run
# least and largest number of a field, of one message or of all
RANGES = {
    'RunInfo.dimension': (0, 3),
    'RunInfo.coordinates': (1, COORDINATES),
    'RunInfo.inertia': (0, LARGEST),
    'RunInfo.kind_numbers': (0, PARTICLES),
    **dict.fromkeys(('RunInfo.kind_diameters', 'RunInfo.kind_masses'), (1e-9, 1e9)),
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
# elements of dimensions that no array of the message has alone, in the plane and in space
FIXED = {'modulation': (4, 8), 'transverse': (4, 16)}
NOT_EMPTY = {'Spectrum': 'exponents', 'Localization': 'widths', 'Fluctuations': 'diffusions'}
OF_RESOLVED = 'multiplicity', 'exponent', 'set_time', 'own_part'  # NaN unless resolved
SHOWN = 80  # most characters of a value that are shown
WORD = re.compile(r'[\w.+-]+', re.ASCII)
WALLS = 'periodic', 'reflecting', 'shearing', 'curved'

Rule = namedtuple('Rule', 'name least most may_be_nan parts')


class Damaged(Exception):
    """A message says something that no node can have sent."""


def check(message, info=None):
    """Raises Damaged if no node can have sent this message in the run with this run_info; None if
    that is not known."""
    about = message if isinstance(message, msg.RunInfo) else info
    if isinstance(message, msg.RunInfo):
        _check_parameters(message)
    most = 2 * COORDINATES * PARTICLES if about is None else space.phase_space(about)
    _check_parts([message], max(most, 1))
    _check_lengths(message, {})
    if _name(message) in CHECKS:
        CHECKS[_name(message)](message)
    if about is not None and isinstance(message, (msg.State, msg.ModeField)):
        _check_particles(message, about)


def _name(message):
    return message._type.partition('/')[2]


def _check_particles(message, info):
    in_box = info.dimension > 0
    there = {'x': in_box, 'z': space.is_solid(info), 'angle': space.turns(info)}
    for name, is_there in there.items():
        found, wanted = len(getattr(message, name)), info.number * is_there
        _refuse_unless(found == wanted, message, name, found, wanted)
    if isinstance(message, msg.State):
        wanted = space.has_others(info) * info.coordinates * info.number
        _refuse_unless(len(message.q) == wanted, message, 'q', len(message.q), wanted)


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
    if field.choice:
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


def _check_lengths(message, around):
    """Arrays are as long as the shapes in the .msg say. around: {dimension: elements} of the
    message that this one is in."""
    shaped = {name: one for name, one in fields.of(message).items() if one.shape}
    lengths = {name: len(getattr(message, name)) for name in shaped}
    for only in sorted(set().union(*(one.only for one in shaped.values()))):
        some = {name: lengths[name] for name in shaped if only in shaped[name].only}
        if not any(some.values()):
            shaped = {name: one for name, one in shaped.items() if name not in some}
    sizes = _sizes(shaped, lengths, around)
    for name, one in shaped.items():
        wanted = math.prod(_size(dimension, sizes) for dimension in one.shape)
        _refuse_unless(lengths[name] == wanted, message, name, lengths[name], wanted)
    if _name(message) in NOT_EMPTY and not lengths[NOT_EMPTY[_name(message)]]:
        raise Damaged(f'hdlyap/{_name(message)}: no {NOT_EMPTY[_name(message)]}')
    for rule in _rules(type(message)):
        parts = getattr(message, rule.name) if rule.parts else ()
        for one in parts if parts and _has_arrays(type(parts[0])) else ():
            _check_lengths(one, sizes)


@lru_cache(maxsize=None)
def _has_arrays(kind):
    return any(field.shape for field in fields.of(kind).values())


def _sizes(shaped, lengths, around):
    """{dimension: elements}: as around the message, or as the first array of one dimension has."""
    in_space = any(lengths[name] for name, one in shaped.items() if '@space' in one.only)
    sizes = {**{name: found[in_space] for name, found in FIXED.items()}, **around}
    for name, one in shaped.items():
        dimension, _, less = one.shape[0].partition('-')
        if len(one.shape) == 1 and dimension not in sizes:
            sizes[dimension] = lengths[name] + (1 if less and lengths[name] else 0)
    return sizes


def _size(dimension, sizes):
    """Elements of `vector`, of `vector-1`."""
    name, _, less = dimension.partition('-')
    return max(sizes[name] - int(less or 0), 0)


# ---- what only some messages have ---------------------------------------------------------------


def _of_run_info(info):
    """Parameters, sizes and words."""
    sizes = [info.density, info.aspect, info.box_x, info.box_y] if info.dimension else []
    if space.is_solid(info):
        sizes += [info.aspect_z, info.box_z]
    if not all(size > 0 for size in sizes):
        raise Damaged(f'hdlyap/RunInfo: density, aspect and box {tuple(sizes)}: must be above 0')
    for name in ('particles', 'container', 'boundary_x', 'boundary_y', 'boundary_z'):
        value = getattr(info, name, '')
        _refuse_other(WORD.fullmatch(value or '-'), name, value, 'a word')
    for axis in space.axes(info) if info.dimension else '':
        wall = getattr(info, 'boundary_' + axis)
        _refuse_other(wall in WALLS, 'boundary_' + axis, wall, f'one of {", ".join(WALLS)}')
    _refuse_other(
        len(info.sites) <= SITES, 'sites', f'{len(info.sites)} elements', f'at most {SITES}'
    )
    kinds = info.kind_numbers
    is_right = len(kinds) <= KINDS_MOST and sum(kinds) == info.number
    _refuse_other(is_right, 'kind_numbers', kinds, f'at most {KINDS_MOST}, with a sum of number')


def _check_parameters(info):
    """All that every run has, in a box those of a box; words, and numbers in what has a kind of
    number."""
    found = {one.name: parameters.value(one) for one in info.parameters}
    for name, kind in NEEDED.items():
        if name in space.OF_A_BOX and not info.dimension:
            continue
        if name not in found:
            raise Damaged(f'hdlyap/RunInfo: no {name} among its parameters')
        is_right = isinstance(found[name], kind) and (
            kind is not float or abs(found[name]) <= LARGEST
        )
        _refuse_other(is_right, name, found[name], KINDS[kind])
    for one in info.parameters:
        _refuse_other(WORD.fullmatch(one.name), 'parameters', one.name, 'a name')
        is_number = isinstance(found[one.name], (int, float)) and abs(found[one.name]) <= LARGEST
        is_word = isinstance(found[one.name], str) and WORD.fullmatch(one.effect)
        if one.kind in (one.NUMBER, one.INTEGER) or one.own:
            _refuse_other(is_number or is_word, one.name, one.effect, 'a number or a word')
    is_right = 1 <= found['number'] <= PARTICLES
    _refuse_other(is_right, 'number', found['number'], f'from 1 to {PARTICLES}')


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
    found = len(field.modulation)
    _refuse_unless(found == field.pairs, field, 'modulation', found, field.pairs)


def _of_structure(message):
    waves, strongest = len(message.nx), max(message.peak, default=0)
    _refuse_unless(strongest <= waves, message, f'wave {strongest} of peak: nx', waves, 'more')


def _of_fluctuations(message):
    indices = {index for step in message.steps for index in step.indices}
    first, vectors = message.first_index, len(message.diffusions)
    if indices - set(range(first, first + vectors)):
        raise Damaged(f'hdlyap/Fluctuations: {vectors} vectors from {first}, indices {indices}')


def _of_averages(message):
    names = [one.name for one in message.averages]
    for name in names:
        if not WORD.fullmatch(name) or names.count(name) > 1:
            raise Damaged(f'hdlyap/Averages: name = {name[:SHOWN]}: must be a word, there once')


CHECKS = {
    'Averages': _of_averages,
    'RunInfo': _of_run_info,
    'Steps': _of_steps,
    'ModeField': _of_field,
    'Structure': _of_structure,
    'Fluctuations': _of_fluctuations,
}
