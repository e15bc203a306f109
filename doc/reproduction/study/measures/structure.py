"""Wave number and rotation of vectors from structure factors; no field is fitted."""

from collections import namedtuple
from math import isfinite

import numpy as np

from hdlyap.data import factors, steps
from hdlyap.plots.figures import structure as figure_of_structure
from hdlyap.plots.figures.structure import OF_KIND

from .. import averages
from ..bags import once
from ..row import TELLING, Row

# vectors, where they have their peaks, S there and the largest elsewhere; line: (omega, its error)
# or None; v_k: (v k, its error)
Seen = namedtuple('Seen', 'name kind own peaks factor elsewhere line v_k')


@once
def _read(bag):
    """Seen, of each step that has its vectors for itself."""
    run, last, found = bag.recording, bag.recording.steps, []
    for block in steps.blocks(last) if run.structure.means is not None else ():
        if len(block.steps) == 1 and run.structure.has((block.first, block.last)):
            one, direction = block.steps[0], OF_KIND[block.kind]
            indices = range(block.first, block.last + 1)
            line = factors.line(*run.structure.of(indices, direction))
            v_k = last.v * one.wave_number, last.v_error * one.wave_number
            name, own = f'{block.name}, {bag.info.boundary_x}', f'({one.nx},{one.ny}) {direction}'
            found.append(
                Seen(name, block.kind, own, *_peaks(run.structure.means, block), line, v_k)
            )
    return found


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
    return peaks, float(mean[at]), float(np.delete(mean, at[1], axis=1).max())


def _all(bags, kind=None):
    return [one for bag in bags for one in _read(bag) if kind in (None, one.kind)]


def peaks(bags):
    return [_peak(one) for one in _all(bags)] or [Row('peak of T and LP steps', 'the same')]


def _peak(one):
    measured = ', '.join(sorted(set(one.peaks)))
    remark = f'{len(one.peaks)} vectors; S {one.factor:.1f}, elsewhere at most {one.elsewhere:.1f}'
    return Row(f'peak of {one.name}', one.own, measured, remark=remark)


def lines_of_lp(bags):
    found = [_line_of_lp(one) for one in _all(bags, steps.LP)]
    return found or [Row('omega / v k of LP steps', 1.0)]


def _line_of_lp(one):
    row = Row(f'omega / v k of {one.name}', 1.0)
    if one.line is not None and isfinite(one.v_k[0]):
        row.measured, row.error = averages.quotient((one.line.omega, one.line.error), one.v_k)
        row.remark = f'omega {one.line.omega:.4f}, v k {one.v_k[0]:.4f} rad/time unit'
    return row


def lines_of_t(bags):
    found = [_line_of_t(one) for one in _all(bags, steps.T)]
    return found or [Row('omega / v k of T steps', 0.0)]


def _line_of_t(one):
    """What is not told from 0 is 0, within what would be told."""
    row = Row(f'omega over v k of LP modes there, {one.name}', 0.0, telling=TELLING)
    if one.line is not None and isfinite(one.v_k[0]):
        row.measured, error = (
            float(part / one.v_k[0]) for part in (one.line.omega, one.line.error)
        )
        row.left_open, row.error = (error, 0.0) if one.line.omega == 0 else (0.0, error)
    return row


def picture(bags, number):
    page = figure_of_structure.draw(bags[number].recording)
    return page and page.figure
