"""How far Gram-Schmidt vectors spread over the disks, against their index."""

from math import e, exp

import numpy as np

from hdlyap.data import steps

from .. import averages
from ..averages import UNKNOWN
from ..row import ABOVE, BELOW, Row

LARGEST = (1, 3, 10, 30)  # indices whose widths are compared
HALF = 0.5  # of a random vector's width
UNIT = 'exp(S) / N'


def random_width(disks):
    """exp(<S>) / N of vectors that know nothing of the disks: 4 N normal numbers, normalised."""
    return exp(sum(1 / n for n in range(3, 2 * disks + 1))) / disks


def _indices(run, name):
    """Of a step that has its vectors for itself; none otherwise."""
    found = {block.name: block for block in steps.blocks(run.steps)}
    return range(found[name].first, found[name].last + 1) if name in found else ()


def _width(message, indices):
    """(mean width of these vectors, its error): as they fluctuate together, theirs."""
    if message is None or not len(indices) or max(indices) > len(message.widths):
        return UNKNOWN
    which = np.array(indices) - message.first_index
    widths, errors = np.array(message.widths)[which], np.array(message.std_errors)[which]
    return float(widths.mean()), float(errors[errors > 0].mean()) if (errors > 0).any() else -1.0


def _row(name, message, indices, published=None, **sense):
    value, remark = _width(message, indices), ''
    if value[0] is not None:
        many = f'{len(indices)} vectors, ' if len(indices) > 1 else ''
        remark = f'{many}{message.samples} times'
    return Row(f'width of {name}', published, *value, UNIT, remark, **sense)


def localised(bag):
    """Beside half of a random vector's width."""
    run, half = bag.recording, HALF * random_width(bag.info.number)
    found = [('vector 1', [1], BELOW)]
    found += [(name, _indices(run, name), ABOVE) for name in ('T(1,0)', 'LP(1,0)')]
    for name, indices, sense in found:
        yield _row(name, run.localization, indices, half, sense=sense)


def ordered(bag):
    message = bag.recording.localization
    for pair in zip(LARGEST, LARGEST[1:]):
        both = [_width(message, [index]) for index in pair]
        ratio = UNKNOWN if UNKNOWN in both else averages.quotient(*both)
        quantity = 'width of vector {} over that of vector {}'.format(*pair)
        yield Row(quantity, 1.0, *ratio, sense=BELOW)


def wave(bag):
    """2 / e: of what goes with the square of a cosine."""
    run = bag.recording
    yield _row('T(1,0), as a wave', run.localization, _indices(run, 'T(1,0)'), 2 / e)


def beside(bag):
    """Of vectors here and there, and what a random one has."""
    message = bag.recording.localization
    if message is not None:
        last = message.first_index + len(message.widths) - 1
        for index in sorted({min(index, last) for index in (3, 10, 30, 100, last // 2)}):
            yield _row(f'vector {index}', message, [index])
    yield Row('width of a random vector', None, random_width(bag.info.number), unit=UNIT)
