"""A run, or Seeds -> its results as a paper prints them: 0.4299(28)."""

import numpy as np
import pandas

from hdlyap.numbers import with_error

from .frames import OF_FLOW, frame

GAS = ('collision_rate', 'pressure', 'compressibility', 'temperature', 'potential_energy', *OF_FLOW)


def of(run):
    """A frame by quantity, of texts: `value` with its error in units of its last digits, `unit`,
    and `k` [1/sigma] of steps. Assumed coefficients of fits are left out."""
    rows = [*_of_spectrum(run), *_of_gas(run), *_of_averages(run), *_of_steps(run)]
    index = pandas.Index([name for name, *_ in rows], name='quantity', dtype=object)
    columns = {name: [row[k] for row in rows] for k, name in enumerate(('value', 'unit', 'k'), 1)}
    return frame(columns, {'k': '1/sigma'}, index)


def _errors(run, frame):
    """The errors of a frame; of means the larger one of the two that is known."""
    return np.fmax(frame['std_error'], frame['scatter']) if run.is_mean else frame['std_error']


def assumed(run):
    """The names of the coefficients of fits that no step has measured."""
    of_fits = run.runs[0].fits
    every = {name for fit in of_fits for name, *_ in fit.values}
    return every - {name for fit in of_fits for name, *_ in fit.measured_values}


def _of_spectrum(run):
    if not run.has('spectrum'):
        return
    found, number, without = run.results, run.info.number, assumed(run)
    for (name, row), error in zip(found.iterrows(), _errors(run, found)):
        if name not in without:
            yield name, with_error(row['value'], error), row['unit'], ''
        if name == 'h_KS':
            yield 'h_KS/N', with_error(row['value'] / number, error / number), row['unit'], ''


def _of_gas(run):
    if not run.has('gas'):
        return
    for (name, row), error in zip(run.gas.iterrows(), _errors(run, run.gas)):
        if name in GAS:
            yield name, with_error(row['value'], error), row['unit'], ''


def _of_averages(run):
    if run.has('averages'):
        for (name, row), error in zip(run.averages.iterrows(), _errors(run, run.averages)):
            yield name, with_error(row['value'], error), row['unit'], ''


def _of_steps(run):
    if not run.has('steps'):
        return
    unit = run.steps.attrs['units']['exponent']
    found = run.steps[run.steps['resolved']]
    for (name, row), error in zip(found.iterrows(), _errors(run, found)):
        k = f'{row["wave_number"]:.5f}' if row['wave_number'] > 0 else ''
        if not name.endswith('*'):  # the others are the opposites of these
            yield name, with_error(row['exponent'], error), unit, k
