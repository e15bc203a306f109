"""Part 16: how far Gram-Schmidt vectors spread over the disks, against their index."""

from math import e, exp

import numpy as np

from hdlyap.plots import steps
from hdlyap.plots.figures import localization as figure_of_localization

from .. import averages
from ..row import ABOVE, BELOW, Claim, Row

TITLE = 'Localisation of the vectors of the largest exponents'
RUN = 'hydro'
LARGEST = (1, 3, 10, 30)  # indices whose widths are compared
HALF = 0.5  # of a random vector's width
COSINE = 2 / e  # width of what goes with the square of a cosine
OPEN = 0.05  # of that: a mode is not its field alone
UNIT = 'exp(S) / N'


def runs(plan):
    return [RUN]


def random_width(disks):
    """exp(<S>) / N of vectors that know nothing of the disks: 4 N normal numbers, normalised."""
    return exp(sum(1 / n for n in range(3, 2 * disks + 1))) / disks


def claims(bags):
    run = bags[RUN].recording
    message, limit = run.localization, HALF * random_width(run.info.disks)
    yield Claim(
        'the vector of the largest exponent is localised, those of the modes are not',
        [
            _row('vector 1', message, [1], limit, BELOW),
            *(
                _row(name, message, _indices(run, name), limit, ABOVE)
                for name in ('T(1,0)', 'LP(1,0)')
            ),
        ],
        f'less, and more, than {HALF:g} of the width of a random vector',
    )
    yield Claim(
        'the larger the exponent, the more localised the vector, among the largest',
        [_ratio(message, first, second) for first, second in zip(LARGEST, LARGEST[1:])],
        'one is narrower than the other',
    )
    yield Claim(
        'a T mode is spread as its wave is',
        [_wave(message, _indices(run, 'T(1,0)'))],
        f'2 / e, of the square of a cosine, within {100 * OPEN:g} %',
    )
    yield Claim('widths', list(_beside(run)))


def _indices(run, name):
    """Of a step that has its vectors for itself; none otherwise."""
    found = {block.name: block for block in steps.blocks(run.steps)}
    return range(found[name].first, found[name].last + 1) if name in found else ()


def _row(name, message, indices, published=None, sense='', left_open=0.0):
    """Mean width of these vectors; as they fluctuate together, its error is theirs."""
    quantity, told = f'width of {name}', {'unit': UNIT, 'sense': sense, 'left_open': left_open}
    if message is None or not len(indices):
        return Row(quantity, published, **told)
    which = np.array(indices) - message.first_index
    widths, errors = np.array(message.widths)[which], np.array(message.std_errors)[which]
    error = float(errors[errors > 0].mean()) if (errors > 0).any() else -1.0
    remark = f'{len(which)} vectors, ' if len(which) > 1 else ''
    remark += f'{message.samples} times'
    return Row(quantity, published, float(widths.mean()), error, remark=remark, **told)


def _wave(message, indices):
    return _row('T(1,0), as a wave', message, indices, COSINE, left_open=OPEN * COSINE)


def _ratio(message, first, second):
    quantity = f'width of vector {first} over that of vector {second}'
    if message is None or len(message.widths) < second:
        return Row(quantity, 1.0, sense=BELOW)
    rows = [_row('', message, [index]) for index in (first, second)]
    ratio = averages.quotient(*((row.measured, row.error) for row in rows))
    return Row(quantity, 1.0, *ratio, sense=BELOW)


def _beside(run):
    """Of vectors here and there, and what a random one has."""
    message = run.localization
    if message is not None:
        last = message.first_index + len(message.widths) - 1
        for index in sorted({min(index, last) for index in (3, 10, 30, 100, last // 2)}):
            yield _row(f'vector {index}', message, [index])
    yield Row('width of a random vector', None, random_width(run.info.disks), unit=UNIT)


def figures(bags):
    figure = figure_of_localization.draw(bags[RUN].recording)
    if figure is not None:
        yield 'widths', figure


def tables(bags):
    message = bags[RUN].recording.localization
    lines = [] if message is None else zip(message.widths, message.std_errors)
    yield 'widths', ('index', 'width', 'std_error'), [
        (index, f'{width:.5g}', f'{error:.2g}') for index, (width, error) in enumerate(lines, 1)
    ]
