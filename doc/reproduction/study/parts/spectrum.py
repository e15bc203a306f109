"""Part 1: the spectrum of 780 disks, and the indices of its smallest steps."""

import numpy as np

from hdlyap.data import steps
from hdlyap.plots import paper
from hdlyap.plots.figures import spectrum as figure_of_spectrum

from .. import averages
from ..files import cells
from ..row import Row, Scatter

RUN = 'periodic'
SHOWN_LP = 1535  # the vector of LP(1,1) that the paper shows


def _blocks(bags):
    return {block.name: block for block in steps.blocks(bags[RUN].recording.steps)}


def indices(bags):
    found = _blocks(bags)
    shown = next((one.name for one in found.values() if one.first <= SHOWN_LP <= one.last), None)
    named = Row(f'step of vector {SHOWN_LP}', 'LP(1,1)', shown if found else None)
    return [*(_indices(step, found) for step in paper.INDICES[:5]), named]


def inferred(bags):
    return [_indices(step, _blocks(bags)) for step in paper.INDICES[5:]]


def _indices(step, found):
    kind, nx, ny, first, last = step
    name = f'{kind}({nx},{ny})'
    measured = found[name].indices if name in found else None
    return Row(f'indices of {name}', f'{first}-{last}', measured)


def exponents(bags):
    found = _blocks(bags)
    for step in paper.steps(bags[RUN].recording.info):
        one = found[step.name].steps[0] if step.name in found else None
        measured = (one.exponent, one.std_error) if one else ()
        yield Row(f'exponent of {step.name}', step.fitted, *measured, unit='1/time unit')


def equal(bags):
    """Exponents of each step about their mean."""
    spectrum = bags[RUN].recording.spectrum
    found = _blocks(bags).values() if spectrum is not None else []
    found = [block for block in found if len(block.steps) == 1]
    for block in found:
        inside = slice(block.first - spectrum.first_index, block.last + 1 - spectrum.first_index)
        values = np.array(spectrum.exponents[inside])
        errors = np.array(spectrum.std_errors[inside])
        quantity = f'exponents of {block.name}'
        if len(values) < 2 or not (errors > 0).all():
            yield Scatter(quantity)
            continue
        mean, _, chi2 = averages.weighted(values, errors)
        remark = f'first over last, less 1: {100 * (values[0] / values[-1] - 1):+.2f} %'
        yield Scatter(quantity, chi2, len(values) - 1, 100 * errors / mean, remark)
    if not found:
        yield Scatter('exponents of steps')


def figures(bags):
    yield 'spectrum', figure_of_spectrum.draw(bags[RUN].recording)


def tables(bags):
    spectrum = bags[RUN].recording.spectrum
    if spectrum is None:
        return
    numbered = enumerate(zip(spectrum.exponents, spectrum.std_errors), spectrum.first_index)
    yield 'exponents', ('index', 'exponent', 'std_error'), [
        cells('s .7g .2g', index, *one) for index, one in numbered
    ]
