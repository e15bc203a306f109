"""A run -> one xarray.Dataset: running means over `time`, samples over `sample` (their ends), other
topics over times of their own; `index` is the Lyapunov index, `vector` that of a field, `particle`
counts from 1. A variable has the name of its topic before that of its field, and from the .msg file
its unit and what it is. What is not known or not measured is NaN."""

import json

import numpy as np

from hdlyap import msg

from . import factors, fields, parts, space, tables
from .export import plain_info

MISSING = 'to_xarray needs xarray: python3-xarray of Debian and Ubuntu, xarray of PyPI'
OVER_TIME = 'spectrum', 'steps', 'gas'  # topics that have the same times
LARGEST = 2**31 - 1  # integer of netCDF by scipy; larger ones are floats, exact up to 2^53
# topics with times of their own: the name of their number
NUMBERED = {'lp_phases': 'lp_phase', 't_phases': 't_phase', 'hydro': 'response'}
# topics of which the last message is taken
LAST = 'spectrum', 'modes', 'covariant', 'localization', 'fluctuations'
COURSES = 'cost', 'status'
PLACES = {'state': msg.State, 'fields': msg.ModeField}


def of(run):
    """The Dataset of a run. Raises ImportError without xarray."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError(f'{MISSING} ({error})') from error
    parts = [_spectrum(run)] if run.has('spectrum') else []
    parts += [_structure(run.structure)] if run.has_structure else []
    parts += [_part(*one) for one in _frames(run)]
    parts += [_places(name, rows, first) for name, rows, first in _of_particles(run)]
    made = xarray.merge([part for part in parts if part is not None], join='outer')
    for name, one in list(made.data_vars.items()):
        unit = space.unit(one.attrs.get('units', ''), run.info)
        attrs = {**one.attrs, **_said(unit, '')}
        made[name] = one.dims, _plain(one.values), attrs
    made.attrs = {'title': repr(run), 'run_info': json.dumps(plain_info(run.info))}
    return made


def _spectrum(run):
    import xarray

    index = run.spectrum.index.to_numpy()
    means, samples = ('time', 'index'), ('sample', 'index')
    arrays = {
        'exponents': (means, run.exponents),
        'std_errors': (means, run.std_errors),
        'local_exponents': (samples, run.local.exponents),
    }
    made = xarray.Dataset(arrays, {'time': run.times, 'index': index, 'sample': run.local.times})
    made['sample_length'] = 'sample', run.local.lengths
    described = fields.of(msg.Spectrum)
    for name, slot in (*((name, name) for name in arrays), ('sample_length', 'local_time')):
        made[name].attrs = _said(described[slot].unit, described[slot].what)
    for name in ('time', 'sample'):
        made[name].attrs = _said(described['sim_time'].unit, 'simulated time')
    made['index'].attrs = {'long_name': 'Lyapunov index'}
    return made


def _structure(means):
    import xarray

    made = xarray.Dataset(coords={'index': means.along.index})
    for name, values in means.waves.items():
        made[f'structure_{name}'] = 'structure_wave', values
    for name in factors.DIRECTIONS:
        made[f'structure_{name}'] = ('index', 'structure_wave'), getattr(means, name)
    for name, field in fields.of(msg.Structure).items():
        if f'structure_{name}' in made:
            made[f'structure_{name}'].attrs = _said(field.unit, field.what)
    return made


def _frames(run):
    """Yields (topic, frame, {name of the frame's index: name of the dimension})."""
    for name in filter(run.has, OVER_TIME):
        counting = (one for one in run.messages(name) if _counts(run, one))
        messages = list({one.sim_time: one for one in counting}.values())
        yield name, tables.scalars(messages), {'sim_time': 'time'}
        if name == 'steps' and messages:
            frame = tables.over_time(messages, tables.of_steps, run.info)
            yield name, frame, {'sim_time': 'time'}
    for name in filter(run.has, NUMBERED):
        yield name, run.course(name), {'sim_time': f'{name}_time', 'number': NUMBERED[name]}
    for name in filter(run.has, LAST):
        yield name, getattr(run, name), {}
    for name in filter(run.has, COURSES):
        yield name, getattr(run, name), {'sim_time': f'{name}_time'}
    for name, frame in parts.of(run, parts.TABLES).items():
        yield name, frame, {}


def _counts(run, message):
    """Whether a message came after the averaging began, or was last reset."""
    return not run.has('spectrum') or message.sim_time >= run.times[0]


def _part(topic, frame, dimensions):
    """The columns of a frame as variables over the dimensions of its index."""
    if not len(frame.columns):
        return None
    made = frame.to_xarray()
    for name in frame.index.names if frame.index.nlevels > 1 else ():
        values = frame.index.get_level_values(name).unique()  # unstacking has lost their order
        made = made.reindex({name: values})
        made = made.assign_coords({name: values.to_numpy().astype(_kind(values))})
    for name in frame.columns:
        said = (frame.attrs[what].get(name, '') for what in ('units', 'long_names'))
        made[name].attrs = _said(*said)
    return made.rename({**dimensions, **{name: f'{topic}_{name}' for name in frame.columns}})


def _kind(values):
    return str if values.dtype == object else values.dtype


def _plain(values):
    """An array that netCDF can hold: of words, '' for a missing one; of numbers otherwise."""
    if values.dtype != object:
        is_large = values.dtype.kind in 'iu' and values.size and abs(values).max() > LARGEST
        return values.astype(float) if is_large else values
    if any(isinstance(value, str) for value in values.flat):
        flat = [value if isinstance(value, str) else '' for value in values.flat]
        return np.array(flat, dtype=str).reshape(values.shape)
    return values.astype(float)


def _of_particles(run):
    """Yields (topic, {value of the first dimension: message}, name of that dimension)."""
    if run.has('state'):
        yield 'state', {one.sim_time: one for one in run.messages('state')}, 'state_time'
    if run.fields:
        yield 'fields', run.fields, 'vector'


def _places(topic, messages, first):
    """The numbers of each particle and, in `fields`, of each vector."""
    import xarray

    one, described = next(iter(messages.values())), fields.of(PLACES[topic])
    made = xarray.Dataset(coords={first: list(messages), 'particle': np.arange(1, len(one.x) + 1)})
    for slot, kind in zip(one.__slots__, one._slot_types):
        values = [getattr(each, slot) for each in messages.values()]
        if kind == 'float64' or kind == 'float64[]' and {len(one.x)} == set(map(len, values)):
            dims = (first, 'particle')[: 1 + kind.endswith('[]')]
            attrs = _said(described[slot].unit, described[slot].what)
            made[f'{topic}_{slot}'] = dims, np.array(values), attrs
    return made


def _said(unit, what):
    return {name: text for name, text in (('units', unit), ('long_name', what)) if text}
