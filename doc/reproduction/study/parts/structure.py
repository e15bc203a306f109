"""Part 15: wave number and rotation of vectors from structure factors; no field is fitted."""

from collections import namedtuple
from math import isfinite

import numpy as np

from hdlyap.data import factors, steps
from hdlyap.plots.figures import structure as figure_of_structure
from hdlyap.plots.figures.structure import OF_KIND

from .. import averages
from ..bags import once
from ..files import cells
from ..row import TELLING, Row

RUNS = ('structure_periodic', 'structure_reflecting')
OF_LP = 'omega / v k of {}, {}'
OF_T = 'omega over v k of LP modes there, {}, {}'
# where its vectors have their peaks, S there and the largest elsewhere, and its line, or None
Seen = namedtuple('Seen', 'name kind wave_number boundary own peaks factor elsewhere line v')


def peaks(bags):
    return [_peak(one) for one in _all(bags)] or [Row('peak of T and LP steps', 'the same')]


def lines_of_lp(bags):
    found = [_line_of_lp(one) for one in _all(bags) if one.kind == steps.LP]
    return found or [Row('omega / v k of LP steps', 1.0)]


def lines_of_t(bags):
    found = [_line_of_t(one) for one in _all(bags) if one.kind == steps.T]
    return found or [Row('omega / v k of T steps', 0.0)]


def _peak(one):
    measured = ', '.join(sorted(set(one.peaks)))
    remark = f'{len(one.peaks)} vectors; S {one.factor:.1f}, elsewhere at most {one.elsewhere:.1f}'
    return Row(f'peak of {one.name}, {one.boundary}', one.own, measured, remark=remark)


def _line_of_lp(one):
    row = Row(OF_LP.format(one.name, one.boundary), 1.0)
    if one.line is not None and isfinite(one.v[0]):
        expected, error = (part * one.wave_number for part in one.v)
        line = one.line.omega, one.line.error
        row.measured, row.error = averages.quotient(line, (expected, error))
        row.remark = f'omega {one.line.omega:.4f}, v k {expected:.4f} rad/time unit'
    return row


def _line_of_t(one):
    """What is not told from 0 is 0, within what would be told."""
    row = Row(OF_T.format(one.name, one.boundary), 0.0, telling=TELLING)
    if one.line is not None and isfinite(one.v[0]):
        expected = one.v[0] * one.wave_number
        row.measured, error = float(one.line.omega / expected), float(one.line.error / expected)
        row.left_open, row.error = (error, 0.0) if one.line.omega == 0 else (0.0, error)
    return row


# ---- messages -> what is seen of each step -------------------------------------------------------


def _all(bags):
    found = [(name.split('_')[1], one) for name in RUNS for one in _read(bags[name])]
    return [one._replace(boundary=boundary) for boundary, one in found]


@once
def _read(bag):
    return list(_seen(bag.recording))


def _seen(run):
    """Of each step that has its vectors for itself."""
    means, last = run.structure.means, run.steps
    if means is None:
        return
    for block in steps.blocks(last):
        if len(block.steps) == 1 and run.structure.has((block.first, block.last)):
            peaks, factor, elsewhere = _peaks(means, block)
            one = block.steps[0]
            own = f'({one.nx},{one.ny}) {OF_KIND[block.kind]}'
            about = block.name, block.kind, one.wave_number, '', own
            seen = peaks, factor, elsewhere, _line(run.structure, block), (last.v, last.v_error)
            yield Seen(*about, *seen)


def _peaks(means, block):
    """(of each vector its wave and direction, mean S there, largest mean S at another wave)"""
    both = np.stack([getattr(means, direction) for direction in factors.DIRECTIONS])
    both = both[:, :, block.first - 1 : block.last]
    vectors = range(both.shape[2])
    places = [np.unravel_index(np.argmax(both[..., one]), both.shape[:2]) for one in vectors]
    peaks = [
        f'({means.nx[wave]},{means.ny[wave]}) {factors.DIRECTIONS[direction]}'
        for direction, wave in places
    ]
    mean = both.mean(axis=2)
    at = np.unravel_index(np.argmax(mean), mean.shape)
    others = np.delete(mean, at[1], axis=1)
    return peaks, float(mean[at]), float(others.max())


def _line(course, block):
    indices = range(block.first, block.last + 1)
    return factors.line(*course.of(indices, OF_KIND[block.kind]))


# ---- figures and table ---------------------------------------------------------------------------


def figures(bags):
    for name in RUNS:
        yield name, figure_of_structure.draw(bags[name].recording)


def tables(bags):
    header = 'boundaries', 'step', 'wave_number', 'peak', 'elsewhere', 'omega', 'omega_error'
    yield 'structure', (*header, 'v_k'), [
        cells(
            's s .6g .4g .4g .5g .2g .5g',
            *(one.boundary, one.name, one.wave_number, one.factor, one.elsewhere),
            *(one.line or (None, None)),
            one.v[0] * one.wave_number,
        )
        for one in _all(bags)
    ]
