"""A run -> one xarray.Dataset. A variable has the name of its topic before that of its field, its
dimensions, its unit and description from the .msg file; what is not known or not measured is NaN.
Averages are over `time`, topics about the whole run and windows over times of their own, `fields`
over the vectors; what comes when fields are due is of the last time."""

import json

import numpy as np
import pandas

from hdlyap import msg, topics

from . import fields, frames, space
from .export import plain_info

MISSING = 'to_xarray needs xarray: python3-xarray of Debian and Ubuntu, xarray of PyPI'
LARGEST = 2**31 - 1  # integer of netCDF by scipy; larger ones are floats, exact up to 2^53
VECTOR = {'long_name': 'Lyapunov index'}
# of the spectrum, without its name
SPECTRUM = {f'spectrum_{one}': one + 's' for one in ('exponent', 'std_error', 'local_exponent')}


def of(run):
    """The Dataset of a run. Raises ImportError without xarray."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError(f'{MISSING} ({error})') from error
    parts = (
        _stacked(name, *_messages(run, name), run.info) for name in filter(run.has, topics.RECORDED)
    )
    made = xarray.merge([xarray.Dataset(*part) for part in parts], join='outer')
    for name, one in list(made.data_vars.items()):
        made[name] = one.dims, _plain(one.values), one.attrs
    made.attrs = {'title': repr(run), 'run_info': json.dumps(plain_info(run.info))}
    return made


def _messages(run, topic):
    """The outer dimension of a topic, and its messages by their labels along it."""
    if topic == 'fields':
        return 'vector', run.fields
    outer = f'{topic}_time' if topic in topics.OF_OTHER_TIMES else 'time'
    return outer, {one.sim_time: one for one in run.messages(topic)}


def _stacked(topic, outer, messages, info):
    """({name: variable}, coordinates) of all fields of these messages."""
    shaped = {label: frames.Shaped(one, info) for label, one in messages.items()}
    main = frames.main(next(iter(messages.values())))
    labels, made = {outer: list(shaped), **_labels(shaped.values())}, {}
    places = {at: _places(one, labels) for at, one in shaped.items()}
    for (dimensions, name), columns in _columns(shaped).items():
        *_, (last, column) = columns.items()
        is_rare = '@fields' in column.only
        rows = {last: column} if is_rare else {at: columns.get(at) for at in shaped}
        values = _filled(rows, places, dimensions, [len(labels[one]) for one in dimensions])
        every = list(dimensions) if is_rare else [outer, *dimensions]
        dims = ['other_' * (one in every[:k]) + one for k, one in enumerate(every)]
        labels.update((of, labels[one]) for of, one in zip(dims, every))
        part = f'{column.part}_' if column.part and dimensions != main else ''
        said = _said(name, column.field, info)
        name = f'{topic}_{part}{name}'
        made[SPECTRUM.get(name, name)] = dims, values[0] if is_rare else values, said
    used = {one for dims, *_ in made.values() for one in dims}
    time = _said('simulated time', fields.of(msg.Spectrum)['sim_time'], info)
    about = {outer: time, 'vector': VECTOR}
    return made, {
        name: (name, some, about.get(name, {})) for name, some in labels.items() if name in used
    }


def _labels(shaped):
    """{dimension: labels of all messages}"""
    found = {}
    for one in shaped:
        for name, some in one.labels.items():
            found.setdefault(name, {}).update(dict.fromkeys(some))
    return {name: list(some) for name, some in found.items()}


def _columns(shaped):
    """{(dimensions, name): {label of a message: Column}}"""
    found = {}
    for at, one in shaped.items():
        for dimensions, columns in one.columns.items():
            for name, column in columns.items():
                found.setdefault((dimensions, name), {})[at] = column
    return found


def _places(shaped, labels):
    """{dimension: where the labels of a message are among all}"""
    return {
        name: pandas.Index(labels[name]).get_indexer(some) for name, some in shaped.labels.items()
    }


def _filled(rows, places, dimensions, sizes):
    """An array by row and labels. What a message lacks is NaN, of words ''."""
    values = next(one.values for one in rows.values() if one is not None)
    blank, kind = ('', object) if values.dtype == object else (np.nan, float)
    whole = np.full([len(rows), *sizes], blank, kind)
    for k, (at, column) in enumerate(rows.items()):
        if column is not None:
            where = np.ix_(*(places[at][one] for one in dimensions))
            whole[(k, *where)] = column.values if dimensions else column.values[0]
    is_whole = kind is float and not np.isnan(whole).any()
    return whole.astype(values.dtype) if is_whole else whole


def _said(name, field, info):
    """Attributes of a variable. xarray writes the long name beside an axis, so it is short."""
    said = ('units', space.unit(field.unit, info)), ('description', field.what)
    return {'long_name': name.replace('_', ' '), **{of: text for of, text in said if text}}


def _plain(values):
    """An array that netCDF can hold: of words, '' for a missing one; of numbers otherwise."""
    if values.dtype != object:
        is_large = values.dtype.kind in 'iu' and values.size and abs(values).max() > LARGEST
        return values.astype(float) if is_large else values
    if any(isinstance(value, str) for value in values.flat):
        flat = [value if isinstance(value, str) else '' for value in values.flat]
        return np.array(flat, dtype=str).reshape(values.shape)
    return values.astype(float)
