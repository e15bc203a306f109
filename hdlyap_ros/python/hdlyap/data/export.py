"""A run, or Seeds -> files for other programs: a CSV file for each table, or one npz file."""

import json
import os

import numpy as np

from hdlyap import parameters, whole
from hdlyap.msg import RunInfo

from . import space
from .reader import Missing, is_known

OF_MEANS = 'results', 'spectrum', 'steps', 'gas', 'averages'  # frames of Seeds
OVER_TIME = '1/time unit'  # unit of columns that have Lyapunov indices as names


def tables(run):
    """{name: frame} of all that was recorded; of Seeds those OF_MEANS."""
    found = {}
    for name in OF_MEANS if run.is_mean else ('results',):
        try:
            found[name] = getattr(run, name)
        except Missing:
            pass
    if run.is_mean:
        return found
    return {**found, **run.tables(), **(run.over_time() if run.has('spectrum') else {})}


def csv(run, folder):
    """Writes a CSV file for each table. Returns their names. Two lines with # come first: the run,
    and the units."""
    os.makedirs(folder, exist_ok=True)
    paths = []
    for name, frame in tables(run).items():
        paths.append(os.path.join(folder, name + '.csv'))
        head = f'# {_origin(run)}\n# units: {_units(frame)}\n'
        whole.write(paths[-1], head + frame.to_csv())
    return paths


def npz(run, path):
    """Writes all as an npz file: a column of a frame as 'steps.exponent', run_info and units as
    JSON. Returns its name."""
    arrays = {'info': json.dumps(plain_info(run.info)), 'units': {}}
    for name, frame in tables(run).items():
        plain = frame.reset_index()
        if name in ('exponents', 'std_errors', 'local_exponents'):
            arrays[name] = frame.to_numpy()
            arrays['units'][name] = OVER_TIME
            plain = frame.index.to_frame()
        for column, values in plain.items():
            values = values.to_numpy()
            key = f'{name}.{column}'
            arrays[key] = values.astype(str) if values.dtype == object else values
            unit = getattr(frame, 'attrs', {}).get('units', {}).get(column)
            if unit:
                arrays['units'][key] = unit
    arrays['units'] = json.dumps(arrays['units'])
    with whole.written(path) as unfinished, open(unfinished, 'wb') as file:
        np.savez_compressed(file, **arrays)  # given a name it would add .npz
    return path


def _origin(run):
    info = run.info
    if not is_known(info):
        return f'hdlyap, run {info.run_id}, without run_info: its parameters are not known'
    seeds = ' '.join(run.seeds)
    box = ' x '.join(f'{edge:.6g}' for edge in space.along(info, 'box_'))
    system = space.without_box(info) or (
        f'N = {info.number}{space.named(info)}, density {info.density:g}, box {box}'
    )
    return f'hdlyap {info.version}, scene {info.scene}, {system}, seed {seeds}'


def _units(frame):
    units = getattr(frame, 'attrs', {}).get('units')
    if units is None or 'unit' in frame:
        return 'in the column unit' if 'unit' in frame else OVER_TIME
    return '; '.join(f'{name} [{unit}]' for name, unit in units.items() if unit)


def plain_info(info):
    """run_info for JSON."""
    if not is_known(info):
        return {'run_id': info.run_id}
    if isinstance(info, RunInfo):
        return {**parameters.all_of(info), **_fields(info, ('header', 'parameters'))}
    return _fields(info, ('header',))


def _fields(message, without):
    names = (name for name in message.__slots__ if name not in without)
    return {name: _plain(getattr(message, name)) for name in names}


def _plain(value):
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return plain_info(value) if hasattr(value, '__slots__') else value
