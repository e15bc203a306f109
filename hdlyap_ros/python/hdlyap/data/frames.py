"""Messages -> arrays and pandas frames by the shapes in the .msg files: fields of one shape are
one frame. Columns have the names of fields (arrays in the singular), attrs['units'] their units. A
number that is not known or not measured is NaN, also if the message has 0 or -1. Only spheres have
columns along z, only particles that rotate have `rotation`, only mixtures `second_kind`."""

from collections import namedtuple

import numpy as np
import pandas

from hdlyap.msg import CovariantAngle, LpPhase, Mode, Step
from hdlyap.numbers import known

from . import fields, space, stages, steps, waves
from .fields import words

# columns that only some runs have
OF_SPHERES, OF_TURNING, OF_MIXTURES = ('nz', 'null_z'), ('rotation',), ('second_kind',)
NUMBERS = {'bool': bool, 'float64': float}  # others are integers
# columns whose numbers are replaced by names
NAMES = {
    'kind': words(Mode, 'kind'),
    'sharing': words(Step, 'sharing'),
    'state': words(LpPhase, 'state'),
    'stage': stages.STAGES,
    'interval_limit': stages.LIMITS,
    'spaces': words(CovariantAngle, 'spaces'),
}
# dimension: name of its labels, if it is another; the first label, if it is not 0
INDEX = {'vector': 'index', 'resolved': 'step', 'subspace': 'step', 'angle': 'spaces'}
INDEX.update(order='growth_time', bin='from')
INDEX.update(dict.fromkeys(('phase', 't_phase', 'response'), 'number'))
FIRST = {'particle': 1, 'wave': 1}
# elements of a list: what labels them, and their fields that the labels say
LABELS = {
    'Step': (lambda one, info: steps.name(one, info) + '*' * one.conjugate, ()),
    'FluctuationStep': (steps.name, ()),
    'CovariantWeight': (steps.name, ()),
    'GrowthOrder': (lambda one, info: one.time, ('time',)),
    'Average': (lambda one, info: one.name, ('name',)),
    'CovariantAngle': (lambda one, info: NAMES['spaces'][one.spaces], ('spaces',)),
    'Mode': (lambda one, info: one.index, ('index', 'step')),
}
KINDS = {'LpPhase': 'LP', 'TPhase': 'T'}  # of waves; others say it

# values by dimensions; field: a fields.Field; part: slot of the list that it is in, '' outside of
# lists; only: what it or that list is there for
Column = namedtuple('Column', 'values field part only')


def frame(columns, units, index=None, long_names=()):
    """A DataFrame with units in attrs, and descriptions of columns if there are any."""
    made, long_names = pandas.DataFrame(columns, index=index), dict(long_names)
    attrs = {'units': {name: units.get(name, '') for name in columns}}
    attrs['long_names'] = {name: long_names[name] for name in columns if name in long_names}
    object.__setattr__(made, 'attrs', attrs)  # pandas before 1.0 has no such attribute
    return made


class Shaped:
    """`columns`: {dimensions: {name: Column}} of all numbers in a message and in its lists;
    `labels`: {dimension: pandas.Index}."""

    def __init__(self, message, info=None):
        self.columns, self.labels, self._info = {}, {}, info
        self._first = getattr(message, 'first_index', 1)
        self._add((), '', frozenset(), [message])

    def frame(self, dimensions):
        """A frame with a row for each combination of their labels."""
        columns = self.columns.get(dimensions, {})
        return _frame(columns, self._index([self.labels[one] for one in dimensions]), self._info)

    @staticmethod
    def _index(labels):
        if len(labels) == 1:
            return labels[0]
        names = []
        for one in labels:
            names.append('other_' * (one.name in names) + one.name)
        return pandas.MultiIndex.from_product(labels, names=names)

    def _add(self, around, part, only, messages):
        """Adds messages of one type: the only one, or the elements of a list."""
        self.columns[around] = _numbers(messages, part, only, self._info)
        for slot, kind, field in _arrays(messages[0]) if messages else ():
            values = [getattr(one, slot) for one in messages]
            if '/' in kind:
                self._label(field.shape[0], values[0])
                self._add(field.shape, slot, field.only, values[0])
            elif any(map(len, values)) or not field.only:
                dimensions = around + tuple(one.partition('-')[0] for one in field.shape)
                values = [list(one) if isinstance(one, bytes) else one for one in values]  # uint8
                shaped = self._shaped(np.array(values), around, field.shape)
                column = Column(_known(shaped, kind, field), field, part, only | field.only)
                self.columns.setdefault(dimensions, {})[singular(slot)] = column

    def _label(self, dimension, elements):
        kind = type(elements[0]).__name__ if elements else ''
        labels = range(FIRST.get(dimension, 0), FIRST.get(dimension, 0) + len(elements))
        if kind in LABELS:
            labels = [LABELS[kind][0](one, self._info) for one in elements]
        self.labels[dimension] = pandas.Index(labels, name=INDEX.get(dimension, dimension))

    def _shaped(self, values, around, shape):
        """An array by dimensions. One without labels gets them; of neighbours the last lacks one,
        and is NaN."""
        names, _, less = zip(*(one.partition('-') for one in shape))
        less = [int(one or 0) for one in less]
        unknown = -1 if values.size else 0
        labels = [self.labels.get(one) for one in names]
        sizes = [unknown if one is None else len(one) - k for one, k in zip(labels, less)]
        values = values.reshape([len(values)] * len(around) + sizes)
        for name, size, k in zip(names, values.shape[len(around) :], less):
            self.labels.setdefault(name, self._numbered(name, size + k))
        if not any(less):
            return values
        missing = [(0, 0)] * len(around) + [(0, k) for k in less]
        return np.pad(values.astype(float), missing, mode='constant', constant_values=np.nan)

    def _numbered(self, dimension, size):
        name = INDEX.get(dimension, dimension)
        if dimension == 'bin':  # its least angle
            return pandas.Index([0.5 * np.pi * k / size for k in range(size)], name=name)
        first = self._first if dimension == 'vector' else FIRST.get(dimension, 0)
        return pandas.RangeIndex(first, first + size, name=name)


def _arrays(message):
    """(slot, type, Field) of each array with a shape, those of one dimension first."""
    described = fields.of(message)
    slots = zip(message.__slots__, message._slot_types)
    found = [(slot, kind, described.get(slot)) for slot, kind in slots if kind.endswith('[]')]
    return sorted((one for one in found if one[2].shape), key=lambda one: len(one[2].shape))


def singular(slot):
    return slot[:-1] if slot.endswith('s') and not slot.endswith('ss') else slot


def _known(values, kind, field):
    """Numbers that are not known are NaN; integers have a sign, for files that know no others."""
    values = values.astype(int) if values.dtype.kind == 'u' else values
    return known(values) if kind.startswith('float64') and field.unknown else values


def _numbers(parts, part, only, info):
    """{name: Column} of the numbers in messages of one type, with an element for each of them."""
    if not parts:
        return {}
    kind, described, columns = type(parts[0]).__name__, fields.of(parts[0]), {}
    for slot, is_a in zip(parts[0].__slots__, parts[0]._slot_types):
        if not is_a.endswith('[]') and is_a not in ('std_msgs/Header', 'string'):
            values = np.array([getattr(one, slot) for one in parts], NUMBERS.get(is_a, int))
            columns[slot] = _known(values, is_a, described[slot])
        elif is_a == 'string' and part:
            columns[slot] = [getattr(one, slot) for one in parts]
    if 'tracked_time' in columns:  # a phase that is not tracked now has the last known numbers
        lost = columns['state'] != LpPhase.TRACKED
        for name in {'phase', 'omega', 'omega_error', 'velocity'} & columns.keys():
            columns[name][lost] = np.nan
    for name in NAMES.keys() & columns.keys():
        columns[name] = [NAMES[name].get(value, str(value)) for value in columns[name]]
    if 'modulation' in columns:
        kinds = [KINDS.get(kind) or steps.kind_name(one.kind) for one in parts]
        columns['step'] = [steps.wave_name(*of, info) for of in zip(kinds, parts)]
        columns['modulation'] = [
            waves.plain_formula(one.nx, one.ny, one.modulation, one.nz) for one in parts
        ]
    of_others = () if space.is_solid(info) else OF_SPHERES
    of_others += () if space.turns(info) else OF_TURNING
    of_others += () if space.is_mixture(info) else OF_MIXTURES
    for name in (*of_others, *LABELS.get(kind, ((), ()))[1]):
        columns.pop(name, None)
    return {
        name: Column(
            np.array(values, getattr(values, 'dtype', object)), described[name], part, only
        )
        for name, values in columns.items()
    }


# ---- frames ------------------------------------------------------------------------------------


def main(message):
    """The dimensions of the frame that has the name of its topic: those of the first array, () if a
    message has none."""
    return next((field.shape for _, _, field in _arrays(message)), ())


def of(message, info=None):
    """The frame that has the name of the topic."""
    made_by = OTHERS.get(type(message).__name__)
    return made_by(message, info) if made_by else Shaped(message, info).frame(main(message))


def tables(topic, messages, info=None):
    """{name: frame} of all that messages of a topic have: the last of each shape, and numbers over
    time. The names of labels stand behind that of the topic, but of its main frame. One message
    after the other is read; only their numbers are kept."""
    due, last, kept = None, None, []
    for last in messages:
        rare = (slot for slot, _, field in _arrays(last) if '@fields' in field.only)
        due = last if any(len(getattr(last, slot)) for slot in rare) else due
        kept.append(_without_arrays(last))
    found = {}
    for one in [last] if due in (None, last) else [due, last]:
        shaped = Shaped(one, info)
        found.update((d, shaped.frame(d)) for d, columns in shaped.columns.items() if d and columns)
    if type(last).__name__ in OTHERS:
        found[main(last)] = of(last, info)
    named = {
        '_'.join([topic, *(frame.index.names if d != main(last) else ())]): frame
        for d, frame in found.items()
        if len(frame) or d == main(last)
    }
    return {**named, f'{topic}_over_time' if named else topic: numbers(kept, info)}


def _without_arrays(message):
    slots = zip(message.__slots__, message._slot_types)
    alone = {slot: getattr(message, slot) for slot, kind in slots if not kind.endswith('[]')}
    return type(message)(**alone)


# of a gas, if phase space contracts, as between walls that shear
OF_FLOW = 'shear_stress', 'velocity_low', 'velocity_high', 'divergence'


def of_gas(message, info=None):
    """A frame by quantity, of the quantities that these particles have."""
    described = fields.of(message)
    pressures = ['pressure', *('pressure_' + axis for axis in space.axes(info))]
    rates = ['collision_rate', *('collision_rate_' + pair for pair in space.PAIRS)]
    names = [*rates, *pressures, 'compressibility', 'temperature', 'potential_energy']
    names += OF_FLOW
    names = [name for name in names if not np.isnan(getattr(message, name))]
    columns = {
        'value': [getattr(message, name) for name in names],
        'std_error': known([getattr(message, name + '_error') for name in names]),
        'unit': [space.unit(described[name].unit, info) for name in names],
    }
    return frame(columns, {}, pandas.Index(names, name='quantity'))


def _course_of_gas(messages, info):
    return numbers(messages, info, lacking(messages[-1], info))


def _course_of_averages(messages, info):
    """With columns kinetic, kinetic_error of an average with the name kinetic."""
    made, units = numbers(messages, info), {}
    units.update(made.attrs['units'])
    for k, last in enumerate(messages[-1].averages):
        told = [one.averages[k] for one in messages]
        made[last.name] = [one.value for one in told]
        made[last.name + '_error'] = known([one.std_error for one in told])
        units.update(dict.fromkeys((last.name, last.name + '_error'), last.unit))
    return frame({name: made[name] for name in made}, units, made.index)


OTHERS = {'Gas': of_gas}  # messages of which frames are made otherwise
COURSES = {'Gas': _course_of_gas, 'Averages': _course_of_averages}  # and over time


def over_time(messages, info=None):
    """The frames of many messages, by simulated time, of a gas and of averages with a column for
    each quantity; of phases, by that of their sample. Two reports can have the same sample, which
    is there once."""
    if type(messages[0]).__name__ in COURSES:
        return COURSES[type(messages[0]).__name__](messages, info)
    if not main(messages[0]):
        return numbers(messages, info)
    states = {getattr(one, 'sample_time', one.sim_time): one for one in messages}
    return keyed({time: of(message, info) for time, message in states.items()}, 'sim_time')


def keyed(frames, name):
    """One frame of {key: frame}; keys are the first labels, which have this name."""
    joined = pandas.concat(list(frames.values()), keys=list(frames), names=[name])
    object.__setattr__(joined, 'attrs', next(reversed(list(frames.values()))).attrs)
    return joined


def lacking(gas, info):
    """The fields of a gas that these particles do not have."""
    found = of_gas(gas, info).index
    names = (name[: -len('_error')] for name in gas.__slots__ if name.endswith('_error'))
    measured = [one for name in names if name not in found for one in (name, name + '_error')]
    expected = [name for name in gas.__slots__ if name.startswith('expected_')]
    return measured + [name for name in expected if np.isnan(getattr(gas, name))]


def numbers(messages, info=None, without=()):
    """A frame of the numbers outside of arrays, by simulated time."""
    columns = _numbers(messages, '', frozenset(), info)
    times = pandas.Index([message.sim_time for message in messages], name='sim_time')
    for name in ('sim_time', *without):
        columns.pop(name, None)
    return _frame(columns, times, info)


def _frame(columns, index, info):
    values = {name: one.values.ravel() for name, one in columns.items()}
    units = {name: space.unit(one.field.unit, info) for name, one in columns.items()}
    return frame(values, units, index, {name: one.field.what for name, one in columns.items()})
