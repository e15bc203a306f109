"""Exponents of dilute gases over the rate of collisions."""

import math

import matplotlib.pyplot as plt
import numpy as np

from study import COLOURS, GREY, fit, told

OTHERS = {0.03: '#0072B2', 0.01: '#009E73', 0.003: '#E69F00', 0.001: '#D55E00'}
DILUTE = 0.01  # densities up to which B is a constant


def constant(rows):
    """B = a + b / N where the gas is dilute; nothing of one size of box."""
    some = [row for row in rows if row['density'] <= DILUTE]
    if len({row['disks'] for row in some}) < 2:
        return None
    values, errors = [b_of(row) for row in some], [2 * row['h_KS error'] for row in some]
    return fit(np.array(values), errors, np.ones(len(some)), [1 / row['disks'] for row in some])


def lines(rows):
    line = constant(rows)
    return [told('B = a + b / N', *line)] if line else []


def b_of(row):
    """2 h_KS / N nu + ln rho."""
    return 2 * row['h_KS / N over it'] + math.log(row['density'])


def draw(rows):
    """Bars: one standard error. Densities are a little apart along 1 / N, to be seen."""
    figure, (bs, largest) = plt.subplots(1, 2, figsize=(7.6, 3.1))
    for place, density in enumerate(sorted({row['density'] for row in rows}, reverse=True)):
        some = [row for row in rows if row['density'] == density]
        bs.errorbar(
            [1 / row['disks'] + 0.0005 * (place - 2) for row in some],
            [b_of(row) for row in some],
            yerr=[2 * row['h_KS error'] for row in some],
            color={**COLOURS, **OTHERS}[density],
            marker='o',
            linestyle='none',
            elinewidth=0.7,
            label=rf'$\rho = {density:g}$',
        )
    line = constant(rows)
    if line:
        bs.axline((0, line[0][0]), slope=line[0][1], color=GREY, linewidth=0.6)
    bs.set(xlabel='$1 / N$', ylabel=r'$2 h_{KS} / N \nu + \ln \rho$', xlim=(0, 0.066), title='(a)')
    bs.legend(ncol=2)
    for disks in sorted({row['disks'] for row in rows}):
        some = [row for row in rows if row['disks'] == disks]
        largest.errorbar(
            [-math.log(row['density']) for row in some],
            [row['lambda_1 over it'] for row in some],
            yerr=[row['lambda_1 error'] for row in some],
            marker='o',
            elinewidth=0.7,
            label=f'N = {disks:g}',
        )
    largest.set(xlabel=r'$-\ln \rho$', ylabel=r'$\lambda_1 / \nu$', title='(b)')
    largest.legend()
    return figure
