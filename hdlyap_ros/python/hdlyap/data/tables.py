"""Messages -> pandas frames. Columns have the names of fields (arrays in the singular),
attrs['units'] their units. Only spheres have columns along z, only particles that rotate have
`rotation`. A number that is not known or not measured is NaN, also if the message has 0 or -1."""

import numpy as np
import pandas

from hdlyap.msg import LpPhase, Mode, Step
from hdlyap.numbers import known

from . import fields, space, stages, steps, waves
from .fields import words

OF_SPHERES, OF_TURNING = ('nz', 'null_z'), ('rotation',)  # columns
NUMBERED = 'exponents', 'widths', 'diffusions'  # arrays with an element for each Lyapunov index
NUMBERS = {'bool': bool, 'float64': float}  # others are integers
# columns whose numbers are replaced by names
NAMES = {
    'kind': words(Mode, 'kind'),
    'sharing': words(Step, 'sharing'),
    'state': words(LpPhase, 'state'),
    'stage': stages.STAGES,
    'interval_limit': stages.LIMITS,
}


def frame(columns, units, index=None, long_names=()):
    """A DataFrame with units in attrs, and descriptions of columns if there are any."""
    made, long_names = pandas.DataFrame(columns, index=index), dict(long_names)
    attrs = {'units': {name: units.get(name, '') for name in columns}}
    attrs['long_names'] = {name: long_names[name] for name in columns if name in long_names}
    object.__setattr__(made, 'attrs', attrs)  # pandas before 1.0 has no such attribute
    return made


def elements(parts, index=None, without=()):
    """A frame of the numbers in messages of one type, with a row for each of them."""
    if not parts:
        return frame({}, {}, index)
    described = fields.of(parts[0])
    columns = {
        slot: _column([getattr(part, slot) for part in parts], kind, described.get(slot))
        for slot, kind in zip(parts[0].__slots__, parts[0]._slot_types)
        if not kind.endswith('[]') and kind != 'std_msgs/Header' and kind != 'string'
    }
    _blank(columns)
    for name in NAMES.keys() & columns.keys():
        columns[name] = [NAMES[name].get(value, str(value)) for value in columns[name]]
    for name in without:
        columns.pop(name, None)
    units = {name: field.unit for name, field in described.items()}
    return frame(columns, units, index, {name: field.what for name, field in described.items()})


def _column(values, kind, field):
    column = np.array(values, dtype=NUMBERS.get(kind, int))
    return known(column) if kind == 'float64' and field and field.unknown else column


def _blank(columns):
    """Sets numbers that were not measured to NaN."""
    if 'resolved' in columns:  # a Step: all columns after this one
        below = list(columns)[list(columns).index('resolved') + 1 :]
        blank = dict.fromkeys(below, ~columns['resolved'])
        if 'gap' in columns:
            blank['gap'] = columns['gap'] == 0
    elif 'tracked_time' in columns:  # an LpPhase or a TPhase
        blank = dict.fromkeys(('a', 'b'), columns['state'] == LpPhase.UNRESOLVED)
        tracked = {'phase', 'omega', 'omega_error', 'velocity'} & columns.keys()
        blank.update(dict.fromkeys(tracked, columns['state'] != LpPhase.TRACKED))
    elif 'weight_now' in columns:  # a Mode
        blank = dict.fromkeys(('wave_number', 'weight'), columns['kind'] == Mode.NONE)
        blank.update(dict.fromkeys(('weight_l', 'weight_p'), columns['kind'] != Mode.LP))
    else:
        return
    for name, where in blank.items():
        if columns[name].dtype == float:
            columns[name] = np.where(where, np.nan, columns[name])


def arrays(message, without=()):
    """A frame of a message whose arrays have an element for each Lyapunov index from first_index
    on. Arrays about an index and the next one lack the last element."""
    described = fields.of(message)
    size = max(len(getattr(message, slot)) for slot in NUMBERED if hasattr(message, slot))
    columns, units, long_names = {}, {}, {}
    for slot, kind in zip(message.__slots__, message._slot_types):
        if kind == 'float64[]' and slot not in without:
            name = slot[:-1] if slot.endswith('s') else slot
            values = np.full(size, np.nan)
            values[: len(getattr(message, slot))] = getattr(message, slot)
            unknown = slot in described and described[slot].unknown
            columns[name] = known(values) if unknown else values
            if slot in described:
                units[name], long_names[name] = described[slot].unit, described[slot].what
    index = pandas.RangeIndex(message.first_index, message.first_index + size, name='index')
    return frame(columns, units, index, long_names)


def of_arrays(message, info=None):
    return arrays(message)


def of_fluctuations(message, info=None):
    """D of each vector alone; see fluctuations.Growth for the rest."""
    return arrays(message, ('covariances', 'covariance_errors', 'variances', 'reversals'))


def of_steps(message, info=None):
    """A frame of steps by their names; steps of the negative half have a * behind them."""
    names = [steps.name(step, info) + ('*' if step.conjugate else '') for step in message.steps]
    return elements(message.steps, pandas.Index(names, name='step'), _left_out(info))


def _left_out(info):
    of_others = () if space.is_solid(info) else OF_SPHERES
    return of_others if space.turns(info) else of_others + OF_TURNING


def of_modes(message, info=None):
    index = pandas.Index([mode.index for mode in message.modes], name='index', dtype=int)
    return elements(message.modes, index, without=('index', 'step', *_left_out(info)))


def of_gas(message, info=None):
    """A frame by quantity, of the quantities that these particles have."""
    described = fields.of(message)
    pressures = ['pressure', *('pressure_' + axis for axis in space.axes(info))]
    names = ['collision_rate', *pressures, 'compressibility', 'temperature', 'potential_energy']
    names = [name for name in names if not np.isnan(getattr(message, name))]
    columns = {
        'value': [getattr(message, name) for name in names],
        'std_error': known([getattr(message, name + '_error') for name in names]),
        'unit': [space.unit(described[name].unit, info) for name in names],
    }
    return frame(columns, {}, pandas.Index(names, name='quantity'))


def of_phases(message, info=None, kind='LP'):
    """A frame of phases by their number; their modulation is a formula."""
    return _of_waves(message.phases, [kind] * len(message.phases), info)


def of_hydro(message, info=None):
    """A frame of responses by their number; their modulation is a formula."""
    kinds = [NAMES['kind'].get(one.kind, str(one.kind)) for one in message.responses]
    return _of_waves(message.responses, kinds, info)


def _of_waves(parts, kinds, info):
    made = elements(parts, pandas.RangeIndex(len(parts), name='number'), _left_out(info))
    if parts:
        made['step'] = [steps.wave_name(*of, info) for of in zip(kinds, parts)]
        made['modulation'] = [
            waves.plain_formula(one.nx, one.ny, one.modulation, one.nz) for one in parts
        ]
    return made


def of_t_phases(message, info=None):
    """A frame of the phases of T steps; see of_phases."""
    return of_phases(message, info, 'T')


def over_time(messages, of, info=None):
    """The frames of many messages, by simulated time; of phases, by that of their sample. Two
    reports can have the same sample, which is there once."""
    states = {getattr(one, 'sample_time', one.sim_time): one for one in messages}
    frames, times = zip(*((of(message, info), time) for time, message in states.items()))
    joined = pandas.concat(frames, keys=times, names=['sim_time'])
    object.__setattr__(joined, 'attrs', frames[-1].attrs)
    return joined


def scalars(messages):
    """A frame of the numbers in messages, by simulated time."""
    times = pandas.Index([message.sim_time for message in messages], name='sim_time')
    return elements(messages, times, without=('sim_time',))
