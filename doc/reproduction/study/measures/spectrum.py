"""Indices and exponents of the steps of one run, and fits through them."""

import importlib

import numpy as np

from hdlyap.data import fits, steps
from hdlyap.plots import paper

from .. import row
from ..averages import UNKNOWN
from ..row import Row, Scatter

SHOWN_LP = 1535  # the vector of LP(1,1) that the paper shows
UNITS = {False: 'sigma/time unit', True: 'sigma^2/time unit'}


def picture(bag, name):
    """A figure that hdlyap makes of any run."""
    page = importlib.import_module(f'hdlyap.plots.figures.{name}').draw(bag.recording)
    return page and page.figure


def _blocks(bag):
    return {block.name: block for block in steps.blocks(bag.recording.steps)}


def stated(bag):
    found = _blocks(bag)
    shown = next((one.name for one in found.values() if one.first <= SHOWN_LP <= one.last), None)
    named = Row(f'step of vector {SHOWN_LP}', 'LP(1,1)', shown if found else None)
    return [*(_indices(step, found) for step in paper.INDICES[:5]), named]


def inferred(bag):
    return [_indices(step, _blocks(bag)) for step in paper.INDICES[5:]]


def _indices(step, found):
    kind, nx, ny, first, last = step
    name = f'{kind}({nx},{ny})'
    measured = found[name].indices if name in found else None
    return Row(f'indices of {name}', f'{first}-{last}', measured)


def exponents(bag):
    found = _blocks(bag)
    for step in paper.steps(bag.info):
        one = found[step.name].steps[0] if step.name in found else None
        measured = (one.exponent, one.std_error) if one else UNKNOWN
        yield Row(f'exponent of {step.name}', step.fitted, *measured, '1/time unit')


def equal(bag):
    """Exponents of each step about their mean."""
    spectrum = bag.recording.spectrum
    found = _blocks(bag).values() if spectrum is not None else []
    found = [block for block in found if len(block.steps) == 1]
    for block in found:
        inside = slice(block.first - spectrum.first_index, block.last + 1 - spectrum.first_index)
        values, errors = (
            np.array(one[inside]) for one in (spectrum.exponents, spectrum.std_errors)
        )
        remark = f'first over last, less 1: {100 * (values[0] / values[-1] - 1):+.2f} %'
        values = zip(values, errors) if (errors > 0).all() else ()
        yield row.about_mean(f'exponents of {block.name}', list(values), lambda _: remark)
    if not found:
        yield Scatter('exponents of steps')


def coefficients(bag):
    message = fits.chosen(bag.recording.steps, fits.RELATIONS[2])
    for symbol, fit in zip(('c_T', 'c_L'), fits.of(message) or (None, None)):
        for name in (symbol, symbol + '2'):
            yield _fit(fit, name)


def _fit(fit, name):
    """A coefficient of ours."""
    values = {name: (value, error) for name, value, error in fit.values} if fit else {}
    measured, error = values.get(name, UNKNOWN)
    # asked for is the curve; c alone is what one wave number gives
    relation = fits.RELATIONS[fit.terms if fit and name in values else 2]
    count = fit.count if fit else 0
    remark, unit = f'over {count} wave number' + ('s' if count != 1 else ''), UNITS[name[-1] == '2']
    return Row(f'{name} of lambda = {relation}', None, measured, max(error, 0.0), unit, remark)
