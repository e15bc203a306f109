"""Part 16: how far Gram-Schmidt vectors spread over the disks, against their index."""

from math import e, exp

import numpy as np

from hdlyap.data import steps
from hdlyap.plots.figures import localization as figure_of_localization

from .. import averages
from ..files import cells
from ..row import ABOVE, BELOW, Row

RUN = 'hydro'
LARGEST = (1, 3, 10, 30)  # indices whose widths are compared
HALF = 0.5  # of a random vector's width
COSINE = 2 / e  # width of what goes with the square of a cosine
UNIT = 'exp(S) / N'


def random_width(disks):
    """exp(<S>) / N of vectors that know nothing of the disks: 4 N normal numbers, normalised."""
    return exp(sum(1 / n for n in range(3, 2 * disks + 1))) / disks


def localised(bags):
    """Beside half of a random vector's width."""
    run = bags[RUN].recording
    found = [('vector 1', [1], BELOW)]
    found += [(name, _indices(run, name), ABOVE) for name in ('T(1,0)', 'LP(1,0)')]
    for name, indices, sense in found:
        row = _row(name, run.localization, indices)
        row.published, row.sense = HALF * random_width(run.info.disks), sense
        yield row


def ordered(bags):
    return [_ratio(bags[RUN].recording.localization, *pair) for pair in zip(LARGEST, LARGEST[1:])]


def wave(bags):
    run = bags[RUN].recording
    row = _row('T(1,0), as a wave', run.localization, _indices(run, 'T(1,0)'))
    row.published = COSINE
    yield row


def _indices(run, name):
    """Of a step that has its vectors for itself; none otherwise."""
    found = {block.name: block for block in steps.blocks(run.steps)}
    return range(found[name].first, found[name].last + 1) if name in found else ()


def _row(name, message, indices):
    """Mean width of these vectors; as they fluctuate together, its error is theirs."""
    row = Row(f'width of {name}', unit=UNIT)
    if message is not None and len(indices):
        which = np.array(indices) - message.first_index
        widths, errors = np.array(message.widths)[which], np.array(message.std_errors)[which]
        row.measured = float(widths.mean())
        row.error = float(errors[errors > 0].mean()) if (errors > 0).any() else -1.0
        many = f'{len(which)} vectors, ' if len(which) > 1 else ''
        row.remark = f'{many}{message.samples} times'
    return row


def _ratio(message, first, second):
    row = Row(f'width of vector {first} over that of vector {second}', 1.0, sense=BELOW)
    if message is not None and len(message.widths) >= second:
        both = [_row('', message, [index]) for index in (first, second)]
        row.measured, row.error = averages.quotient(*((one.measured, one.error) for one in both))
    return row


def beside(bags):
    run = bags[RUN].recording
    """Of vectors here and there, and what a random one has."""
    message = run.localization
    if message is not None:
        last = message.first_index + len(message.widths) - 1
        for index in sorted({min(index, last) for index in (3, 10, 30, 100, last // 2)}):
            yield _row(f'vector {index}', message, [index])
    yield Row('width of a random vector', None, random_width(run.info.disks), unit=UNIT)


def figures(bags):
    yield 'widths', figure_of_localization.draw(bags[RUN].recording)


def tables(bags):
    message = bags[RUN].recording.localization
    lines = [] if message is None else zip(message.widths, message.std_errors)
    yield 'widths', ('index', 'width', 'std_error'), [
        cells('s .5g .2g', index, *one) for index, one in enumerate(lines, 1)
    ]
