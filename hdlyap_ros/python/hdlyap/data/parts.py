"""A run -> frames of what messages have besides a number for each vector: of pairs of steps, times,
waves, spaces. A row of TABLES is a frame; it raises Missing if the run has no such message."""

import numpy as np
import pandas

from hdlyap import msg

from . import fields, steps, tables
from .reader import Missing

SPACES = fields.words(msg.CovariantAngle, 'spaces')
WEIGHTS = 'dq', 'dp', 'gram_schmidt'


def _frame(columns, index, *kinds):
    """A frame; units and descriptions are those of fields of the same names in these messages."""
    described = {name: one for kind in kinds for name, one in fields.of(kind).items()}
    known = {name: described[name] for name in columns if name in described}
    units = {name: field.unit for name, field in known.items()}
    return tables.frame(columns, units, index, {name: field.what for name, field in known.items()})


def _stacked(frames, names):
    """{name: the elements of a frame, row after row}, and their index, which has these names.
    Frames may lack the last columns of the widest one."""
    widest = max(frames.values(), key=lambda frame: frame.shape[1])
    columns = {}
    for name, frame in frames.items():
        values = np.full(widest.shape, np.nan)
        values[:, : frame.shape[1]] = frame
        columns[name] = values.ravel()
    pairs = ((*_levels(row), *_levels(column)) for row in widest.index for column in widest.columns)
    return columns, _index(list(pairs), names)


def _levels(key):
    return key if isinstance(key, tuple) else (key,)


def _index(rows, names):
    columns = zip(*rows) if rows else [[]] * len(names)
    return pandas.MultiIndex.from_arrays(list(columns), names=names)


def _orders(orders, more=None):
    frames = {name: getattr(orders, name) for name in ('violations', 'domination_violations')}
    frames.update(more or {})
    columns, index = _stacked(frames, ['growth_time', 'index'])
    counts = dict(zip(orders.times['time'], orders.times['count']))
    columns['count'] = [counts[time] for time in index.get_level_values(0)]
    return _frame(columns, index, msg.Fluctuations, msg.GrowthOrder)


def _growth(run):
    return _orders(run.growth, {'variances': run.growth.variances})


def _pairs(run):
    growth = run.growth
    found = {'covariances': growth.covariances, 'covariance_errors': growth.std_errors}
    found['correlations'] = growth.correlations
    return _frame(*_stacked(found, ['step', 'other_step']), msg.Fluctuations)


def _reversals(run):
    growth = run.growth
    every = pandas.concat(growth.reversals, keys=growth.times['time'])
    columns, index = _stacked({'reversals': every}, ['growth_time', 'step', 'other_step'])
    return _frame(columns, index, msg.Fluctuations)


def _weights(run):
    message = run.last('covariant')
    found = [steps.name(one, run.info) for one in message.weights]
    indices = np.arange(len(message.exponents)) + message.first_index
    index = pandas.MultiIndex.from_product([found, indices], names=['step', 'index'])
    columns = {
        name: np.array([getattr(one, name) for one in message.weights]).ravel() for name in WEIGHTS
    }
    return _frame(columns, index, msg.CovariantWeight)


def _angles(run):
    angles = run.last('covariant').angles
    names = pandas.Index([SPACES[one.spaces] for one in angles], name='spaces', dtype=object)
    return tables.elements(angles, names, without=('spaces',))


def _counts(run):
    """Histograms of angles; `from` is the least angle of a bin."""
    angles = run.last('covariant').angles
    bins = [len(one.all_counts) for one in angles]
    rows = [(SPACES[one.spaces], k) for one, n in zip(angles, bins) for k in range(1, n + 1)]
    columns = {
        name: np.array([count for one in angles for count in getattr(one, name)], dtype=int)
        for name in ('smallest_counts', 'all_counts')
    }
    columns['from'] = np.array([0.5 * np.pi * k / n for n in bins for k in range(n)])
    return _frame(columns, _index(rows, ['spaces', 'bin']), msg.CovariantAngle)


def _structure(run):
    found = {name: getattr(run.structure, name).T for name in ('along', 'across')}
    return _frame(*_stacked(found, [*found['along'].index.names, 'index']), msg.Structure)


# name: frame of a run; of OTHERS a Dataset has forms of its own
TABLES = {
    'orders': _growth,
    'covariances': _pairs,
    'reversals': _reversals,
    'covariant_orders': lambda run: _orders(run.covariant_orders),
    'covariant_weights': _weights,
    'covariant_angles': _angles,
    'covariant_angle_counts': _counts,
}
OTHERS = {
    'hydro': lambda run: tables.of_hydro(run.last('hydro'), run.info),
    'structure': _structure,
}


def of(run, names):
    """{name: frame} of those of these tables that have rows."""
    found = {}
    for name, table in names.items():
        try:
            frame = table(run)
        except Missing:
            continue
        if len(frame):
            found[name] = frame
    return found
