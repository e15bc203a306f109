"""What the time step of soft disks costs: errors against the step, and seconds."""

import math
from itertools import groupby

import matplotlib.pyplot as plt
import numpy as np

from study import COLOURS, GREY, fit

KICKS = {'verlet': 1, 'pefrl': 4}  # in a step
POTENTIALS = {'power': COLOURS[0.2], 'wca': COLOURS[0.8], 'lennard_jones': COLOURS[0.4]}
MARKS = {'verlet': 'o', 'pefrl': 's'}
JUMP = 2 / 3  # power of the step by which a jump of the second derivative parts a pair of zeros
SURE = 3  # standard errors


def limit(rows, potential):
    """lambda_1 where the energy is kept best: the mean of the finest step of each integrator; NaN
    if all of them lose it."""
    some = [finest(rows, potential, by) for by in KICKS]
    some = [row for row in some if row]
    if not some:
        return math.nan, math.nan
    weight = [1 / row['lambda_1 error'] ** 2 for row in some]
    return np.average([row['lambda_1'] for row in some], weights=weight), sum(weight) ** -0.5


def finest(rows, potential, integrator):
    some = [r for r in kept(rows) if (r['potential'], r['integrator']) == (potential, integrator)]
    return min(some, key=lambda row: row['step']) if some else None


def kept(rows):
    """Those whose energy was not lost."""
    return [row for row in rows if row['lambda_1'] == row['lambda_1']]


def slope(rows):
    """Power of the step in the third zero where it is known, with its error."""
    sure = [row for row in kept(rows) if row['third zero'] > SURE * row['third zero error']]
    if len(sure) < 3:
        return None
    x = np.log([row['step'] for row in sure])
    errors = [row['third zero error'] / row['third zero'] for row in sure]
    return fit(np.log([row['third zero'] for row in sure]), errors, np.ones_like(x), x)


def lines(rows):
    for (potential, integrator), some in groupby(rows, series):
        some = list(some)
        value, error = limit(rows, potential)
        for row in some:
            off = row['lambda_1'] - value, math.hypot(row['lambda_1 error'], error)
            yield f'{potential}, {integrator}, step {row["step"]:g}: ' + (
                'the energy is lost'
                if row['lambda_1'] != row['lambda_1']
                else f'energy {row["energy error"]:.1e}, '
                f'lambda_1 off {off[0]:+.4f} +- {off[1]:.4f}, '
                f'third zero {row["third zero"]:.4f} +- {row["third zero error"]:.4f}, '
                f'{1e3 * row["seconds"]:.2f} ms per time unit'
            )
        found = slope(some)
        if found:
            yield f'  third zero as the step to the power {found[0][1]:.2f} +- {found[1][1]:.2f}'


def series(row):
    return row['potential'], row['integrator']


def draw(rows):
    figure, axes = plt.subplots(1, 3, figsize=(7.2, 2.9))
    for (potential, integrator), some in groupby(rows, series):
        some = kept(some)
        step = np.array([row['step'] for row in some])
        style = dict(color=POTENTIALS[potential], marker=MARKS[integrator], linewidth=0.8)
        axes[0].plot(step / KICKS[integrator], [row['energy error'] for row in some], **style)
        value, error = limit(rows, potential)
        bars = [math.hypot(row['lambda_1 error'], error) for row in some]
        off = [row['lambda_1'] - value for row in some]
        axes[1].errorbar(step, off, yerr=bars, elinewidth=0.6, **style)
        zero = [max(row['third zero'], 1e-9) for row in some]
        bars = [row['third zero error'] for row in some]
        axes[2].errorbar(step, zero, yerr=bars, elinewidth=0.6, **style)
    reach = np.array([1e-3, 0.016])
    axes[2].plot(reach, 0.1 * (reach / reach[1]) ** JUMP, color=GREY, zorder=0)
    for potential, colour in POTENTIALS.items():
        axes[0].plot([], [], color=colour, label=potential)
    for integrator, mark in MARKS.items():
        axes[1].plot([], [], mark, color=GREY, label=integrator)
    axes[0].set(xlabel='step over its kicks', xscale='log', yscale='log')
    axes[0].set_title('(a) error of the energy', loc='left')
    axes[1].set(xlabel='step', xscale='log', ylim=(-0.06, 0.06))
    axes[1].set_title(r'(b) $\lambda_1$ off the limit', loc='left')
    axes[2].set(xlabel='step', xscale='log', yscale='log', ylim=(1e-3, 0.2))
    axes[2].set_title('(c) third zero; grey: $h^{2/3}$', loc='left')
    axes[0].legend(loc='lower right')
    axes[1].legend(loc='lower left')
    return figure
