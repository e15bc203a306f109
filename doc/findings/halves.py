"""Halves of LP modes: dp ahead of dq, and what that does to the rotation."""

import math

import matplotlib.pyplot as plt
import numpy as np

from study import BAR, COLOURS, GREY, INK, RATE, fit, told

EXPECTED, OVER = 'sqrt(1 - (h^2 + g^2) / x^2)', 'v over that of pressure and C'
PLACE = 'turn while a disk flies  $\\omega\\tau$  [rad]'


def lines(rows):
    """Lines in omega tau of v over that of the pressure, and of pressure and C: for each density,
    and with one limit for all of them."""
    densities = sorted({row['density'] for row in rows})
    for some in [*([d] for d in densities), densities]:
        few = [row for row in rows if row['density'] in some]
        if len(few) < len(some) + 3:
            continue
        slopes = [[turned(row) * (row['density'] == d) for row in few] for d in some]
        name = ', '.join(f'{d:g}' for d in some)
        for title, column, error, unit in (
            ('P', 'v', 'v error', [row[RATE] for row in few]),
            ('P and C', OVER, 'over error', np.ones(len(few))),
        ):
            values, errors = ([row[key] for row in few] / np.array(unit) for key in (column, error))
            line = fit(values, errors, np.ones(len(few)), *slopes)
            yield told(f'density {name}: v over that of {title} = a + b omega tau', *line)


def turned(row):
    """Rotation in the time between two collisions of a disk."""
    return row['v'] * row['k'] * row['time between collisions']


def sources(row):
    """D = C^2 + C X - X C over the square of mean C: of L and P themselves, and between them."""
    g, h = row['difference / mean'], row['symmetric / mean']
    x = row[RATE] * row['k'] / row['mean C']
    mean, half = 1 + g * g + h * h, 2 * (g + x * h)
    return mean + half, mean - half, 2 * (h - x * g)


def draw(rows):
    figure, ((angles, means), (rates, rest)) = plt.subplots(2, 2, figsize=(7.6, 5.8))
    _points(angles, rows, lambda row: row['angle'], 'angle', 'o')
    _points(angles, rows, lambda row: row['symmetric / mean'], 'symmetric', 's')
    _points(angles, rows, lambda row: row['difference / mean'], 'difference', '^')
    angles.axhline(0, color=GREY, linewidth=0.6)
    angles.set(
        ylabel='angle of dp [rad], and C beside a number',
        title='(a) mean angle, and the rest of C',
        ylim=(-0.16, 0.06),
    )
    for y, text in (
        (0.04, r'mean of the angle by which dp is ahead  [rad]'),
        (-0.02, r'$(c_{LL} - c_{PP})\,/\,2c$'),
        (-0.15, r'$(c_{LP} + c_{PL})\,/\,2c$: angle at L less the mean  [rad]'),
    ):
        angles.annotate(text, (0.004, y), fontsize=8)
    _points(means, rows, lambda row: row['mean C'] / row['lambda'], None, 'o')
    means.set(ylabel=r'mean C / $\lambda$', title='(b) length of dp', ylim=(0.5, 1.02))
    _points(rates, rows, lambda row: row['v'] / row[RATE], 'v', 'o')
    _points(rates, rows, lambda row: row[EXPECTED], None, '_')
    rates.axhline(1, color=GREY, linewidth=0.6)
    rates.plot([], [], 'o', color=INK, label='measured')
    rates.plot([], [], '_', color=INK, label=r'$(1 - (h^2 + g^2)/x^2)^{1/2}$')
    rates.legend(loc='lower left')
    rates.set(
        ylabel=r'$v \cdot \sqrt{2}\,\rho\, /\, P_{xx}$', title='(c) rotation', ylim=(0.93, 1.02)
    )
    for part, marker, text in ((0, 'v', '$D_{LL}$'), (1, '^', '$D_{PP}$'), (2, 's', '$D_{LP}$')):
        _points(rest, rows, lambda row, part=part: sources(row)[part], None, marker)
        rest.plot([], [], color=INK, marker=marker, linestyle='none', label=text)
    rest.axhline(0, color=GREY, linewidth=0.6)
    rest.set(ylabel=r'$D / c^2$', title='(d) source of dp from dq', ylim=(-0.3, 2))
    rest.legend(ncol=3, loc='upper right', columnspacing=0.8, handletextpad=0.1)
    for axes in (angles, means, rates, rest):
        axes.set(xlabel=PLACE, xlim=(0, 0.13))
        axes.set_title(axes.get_title(), loc='left')
        axes.set_title('')
    for density, colour in COLOURS.items():
        means.plot([], [], 'o', color=colour, label=rf'$\rho = {density:g}$')
    means.plot([], [], 'o', color=INK, markerfacecolor='white', label='walls')
    means.legend(ncol=2, loc='upper right')
    return figure


def _points(axes, rows, value, error, marker):
    """Open: waves between walls. error: what its column is called, if it is shown."""
    for row in rows:
        if not math.isfinite(value(row)):
            continue
        bar = BAR * row[f'{error} error'] if error else None
        if error == 'v':
            bar /= row[RATE]
        colour = COLOURS[row['density']]
        open_or_not = 'white' if row['ends of x'] == 'reflecting' else colour
        axes.errorbar(
            turned(row),
            value(row),
            yerr=bar,
            color=colour,
            marker=marker,
            markerfacecolor=open_or_not,
            elinewidth=0.7,
            linestyle='none',
        )
