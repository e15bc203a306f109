"""Part 15: wave number and rotation of vectors from structure factors; no field is fitted."""

from collections import namedtuple
from math import isfinite

import numpy as np

from hdlyap.plots import steps, structure
from hdlyap.plots.figures import structure as figure_of_structure
from hdlyap.plots.figures.structure import OF_KIND

from .. import averages
from ..row import TELLING, Claim, Row

TITLE = 'Structure factors of the vectors: wave numbers, and lines in S(k, omega)'
RUNS = ('structure_periodic', 'structure_reflecting')
ACCURACY = 0.02  # of a line's place
OF_LP = 'omega / v k of {}, {}'
OF_T = 'omega over v k of LP modes there, {}, {}'
# where its vectors have their peaks, S there and the largest elsewhere, and its line, or None
Seen = namedtuple('Seen', 'name kind wave_number boundary own peaks factor elsewhere line v')


def runs(plan):
    return list(RUNS)


def claims(bags):
    found = _all(bags)
    yield Claim(
        'vectors of a step have the largest structure factor at its wave vector: T across k, LP '
        'along k',
        [_peak(one) for one in found] or [Row('peak of T and LP steps', 'the same')],
        'the same, for each vector',
    )
    yield Claim(
        'the line of LP modes in S(k, omega) is at v k, with v of the phases',
        [_line_of_lp(one) for one in found if one.kind == steps.LP]
        or [Row('omega / v k of LP steps', 1.0)],
        f'{100 * ACCURACY:g} %',
    )
    yield Claim(
        'the line of T modes in S(k, omega) is at 0',
        [_line_of_t(one) for one in found if one.kind == steps.T]
        or [Row('omega / v k of T steps', 0.0)],
        'half of the width of a line; it must be less than a tenth of v k',
    )


def _peak(one):
    return Row(
        f'peak of {one.name}, {one.boundary}',
        one.own,
        ', '.join(sorted(set(one.peaks))),
        remark=f'{len(one.peaks)} vectors; S {one.factor:.1f}, elsewhere at most '
        f'{one.elsewhere:.1f}',
    )


def _line_of_lp(one):
    quantity = OF_LP.format(one.name, one.boundary)
    if one.line is None or not isfinite(one.v[0]):
        return Row(quantity, 1.0, left_open=ACCURACY)
    expected, error = (part * one.wave_number for part in one.v)
    return Row(
        quantity,
        1.0,
        *averages.quotient((one.line.omega, one.line.error), (expected, error)),
        left_open=ACCURACY,
        remark=f'omega {one.line.omega:.4f}, v k {expected:.4f} rad/time unit',
    )


def _line_of_t(one):
    """What is not told from 0 is 0, within what would be told."""
    quantity = OF_T.format(one.name, one.boundary)
    if one.line is None or not isfinite(one.v[0]):
        return Row(quantity, 0.0, telling=TELLING)
    expected = one.v[0] * one.wave_number
    is_zero = one.line.omega == 0
    return Row(
        quantity,
        0.0,
        float(one.line.omega / expected),
        0.0 if is_zero else float(one.line.error / expected),
        left_open=float(one.line.error / expected) if is_zero else 0.0,
        telling=TELLING,
    )


# ---- messages -> what is seen of each step -------------------------------------------------------


def _all(bags):
    return [one for name in RUNS for one in _seen(name.split('_')[1], bags[name].recording)]


def _seen(boundary, run):
    """Seen of each step that has its vectors for itself."""
    means, last = run.structure.means, run.steps
    if means is None:
        return
    for block in steps.blocks(last):
        if len(block.steps) == 1 and run.structure.has((block.first, block.last)):
            peaks, factor, elsewhere = _peaks(means, block)
            one = block.steps[0]
            yield Seen(
                block.name,
                block.kind,
                one.wave_number,
                boundary,
                f'({one.nx},{one.ny}) {OF_KIND[block.kind]}',
                peaks,
                factor,
                elsewhere,
                _line(run.structure, block),
                (last.v, last.v_error),
            )


def _peaks(means, block):
    """(of each vector its wave and direction, mean S there, largest mean S at another wave)"""
    both = np.stack([getattr(means, direction) for direction in structure.DIRECTIONS])
    factors = both[:, :, block.first - 1 : block.last]
    vectors = range(factors.shape[2])
    places = [np.unravel_index(np.argmax(factors[..., one]), factors.shape[:2]) for one in vectors]
    peaks = [
        f'({means.nx[wave]},{means.ny[wave]}) {structure.DIRECTIONS[direction]}'
        for direction, wave in places
    ]
    mean = factors.mean(axis=2)
    at = np.unravel_index(np.argmax(mean), mean.shape)
    others = np.delete(mean, at[1], axis=1)
    return peaks, float(mean[at]), float(others.max())


def _line(course, block):
    indices = range(block.first, block.last + 1)
    return structure.line(*course.of(indices, OF_KIND[block.kind]))


# ---- figures and table ---------------------------------------------------------------------------


def figures(bags):
    for name in RUNS:
        figure = figure_of_structure.draw(bags[name].recording)
        if figure is not None:
            yield name, figure


def tables(bags):
    lines = [
        (
            one.boundary,
            one.name,
            f'{one.wave_number:.6g}',
            f'{one.factor:.4g}',
            f'{one.elsewhere:.4g}',
            *(('', '') if one.line is None else (f'{one.line.omega:.5g}', f'{one.line.error:.2g}')),
            f'{one.v[0] * one.wave_number:.5g}',
        )
        for one in _all(bags)
    ]
    header = ('boundaries', 'step', 'wave_number', 'peak', 'elsewhere', 'omega', 'omega_error')
    yield 'structure', (*header, 'v_k'), lines
