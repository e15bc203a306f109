"""Responses of L and P -> C of dp = C dq on the two fields, and what it says of the halves' angle.

A vector's dq half is a L + b P, normalised fields; its dp half, in units of |dq|, is C (a, b). With
q = |dq| the sums over the disks give [T15]

    density  L: q                  P: 0
    along    L: q c_LL             P: q (c_LP - k / sqrt 2)
    energy   L: q (2 k + 8^(1/2) c_PL)    P: q 8^(1/2) c_PP

where the terms in k are those of dq, with momenta of the variance 1. C is a number if c_LL = c_PP
and c_LP = c_PL = 0. While (a, b) goes round, the phase of dp less that of dq is

    (c_PL - c_LP) / 2 c + (c_PL + c_LP) / 2 c cos 2 phi + ..,    c = (c_LL + c_PP) / 2.

The mean is an angle by which dp is ahead; the second part is none: it is a C that is symmetric, but
no number.
"""

from collections import namedtuple

import numpy as np

from hdlyap.numbers import with_error

from . import averages
from .row import Row

Matrix = namedtuple('Matrix', 'values errors q')  # ((LL, LP), (PL, PP))


def matrix(found, k):
    """C from {(mode, kind): Response} at one wave number."""
    q = found['L', 'density'].value
    parts = (('L', 'along'), ('P', 'along')), (('L', 'energy'), ('P', 'energy'))
    of_dq = np.array([[0.0, -k / np.sqrt(2)], [2 * k, 0.0]])
    scale = np.array([[1.0, 1.0], [np.sqrt(8), np.sqrt(8)]])
    values = np.array([[found[part].value / q for part in row] for row in parts])
    errors = np.array([[found[part].error / abs(q) for part in row] for row in parts])
    return Matrix((values - of_dq) / scale, errors / scale, q)


def ratio(matrices):
    return _row('C on L over C on P, of dp = C dq', 1.0, '', matrices, _ratio)


def ahead(matrices):
    return _row('angle of dp ahead of dq, mean of a turn', 0.0, 'rad', matrices, _ahead)


def swing(matrices, numbers):
    """numbers: {wave: k}"""
    row = _row('the same at L less that mean', 0.0, 'rad', matrices, _swing)
    against = (_against(*one, numbers) for one in matrices.items())
    row.remark = '; '.join(filter(None, [row.remark, *against]))
    return row


def _ratio(c, e):
    value = c[0, 0] / c[1, 1]
    return value, abs(value) * np.hypot(e[0, 0] / c[0, 0], e[1, 1] / c[1, 1])


def _ahead(c, e):
    return (c[1, 0] - c[0, 1]) / np.trace(c), np.hypot(e[1, 0], e[0, 1]) / np.trace(c)


def _swing(c, e):
    return (c[1, 0] + c[0, 1]) / np.trace(c), np.hypot(e[1, 0], e[0, 1]) / np.trace(c)


def _row(quantity, published, unit, matrices, of):
    """Mean over the waves by their errors."""
    row = Row(quantity, published, unit=unit)
    ones = {wave: of(one.values, one.errors) for wave, one in matrices.items()}
    if ones:
        values, errors = zip(*ones.values())
        if min(errors) > 0:
            row.measured, row.error, _ = averages.weighted(values, errors)
        else:
            row.measured, row.error = float(np.mean(values)), -1.0
        said = [f'{with_error(*one)} at ({wave[0]},{wave[1]})' for wave, one in ones.items()]
        row.remark = ', '.join(said)
    return row


def _against(wave, one, numbers):
    """The two responses that C decides, beside those of a number C."""
    k, c = numbers[wave], one.values
    along, energy = -k / np.sqrt(2), 2 * k
    return (
        f'({wave[0]},{wave[1]}): momentum of P {one.q * (along + c[0, 1]):.4f}, '
        f'{one.q * along:.4f} if C were a number, energy of L '
        f'{one.q * (energy + np.sqrt(8) * c[1, 0]):.4f}, {one.q * energy:.4f}'
    )
