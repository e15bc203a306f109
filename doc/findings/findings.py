#!/usr/bin/python3
"""Table of the study halves -> the picture of doc/findings.md.

Usage: findings.py findings_trailing.csv draws findings_trailing.png beside it.
"""

import csv
import math
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

GREY, INK = '#8C8C8C', '#1A1A1A'
# by density: Okabe and Ito's palette, safe for colour-blind readers
COLOURS = {0.1: '#56B4E9', 0.2: '#0072B2', 0.4: '#009E73', 0.6: '#E69F00', 0.8: '#D55E00'}
STYLE = {
    'font.size': 9,
    'axes.titlesize': 9,
    'legend.fontsize': 8,
    'xtick.labelsize': 8,
    'ytick.labelsize': 8,
    'xtick.direction': 'in',
    'ytick.direction': 'in',
    'xtick.top': True,
    'ytick.right': True,
    'axes.linewidth': 0.7,
    'lines.linewidth': 1.2,
    'lines.markersize': 4,
    'legend.frameon': False,
    'figure.constrained_layout.use': True,
}
RATE = 'P_xx / (sqrt(2) rho)'  # of the rotation over k, as the pressure has it
PLACE = 'turn while a disk flies  $\\omega\\tau$  [rad]'


def rows_of(path):
    """Columns by their names, without the units."""
    with open(path, encoding='utf-8') as file:
        rows = csv.reader(line for line in file if not line.startswith('#'))
        names = [name.partition(' [')[0] for name in next(rows)]
        return [
            {name: text if name == 'ends of x' else float(text) for name, text in zip(names, row)}
            for row in rows
        ]


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
        ylabel='of dp, beside dq',
        title='(a) mean angle, and what C has beside a number',
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
    rates.axhline(1, color=GREY, linewidth=0.6)
    rates.set(
        ylabel=r'$v \cdot \sqrt{2}\,\rho\, /\, P_{xx}$', title='(c) rotation', ylim=(0.9, 1.05)
    )
    for part, marker, text in ((0, 'v', 'L to L'), (1, '^', 'P to P'), (2, 's', 'between L and P')):
        _points(rest, rows, lambda row, part=part: sources(row)[part], None, marker)
        rest.plot([], [], color=INK, marker=marker, linestyle='none', label=text)
    rest.axhline(0, color=GREY, linewidth=0.6)
    rest.set(ylabel=r'source of dp from dq / (mean C)$^2$', title='(d) source', ylim=(-0.3, 2))
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
        bar = 3 * row[f'{error} error'] if error else None
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


def main(arguments):
    if len(arguments) != 1 or not arguments[0].endswith('.csv'):
        print('findings.py: needs the table of halves, findings_trailing.csv', file=sys.stderr)
        return 2
    with plt.rc_context(STYLE):
        picture = arguments[0][:-4] + '.png'
        draw(rows_of(arguments[0])).savefig(picture, dpi=200, bbox_inches='tight')
        print(picture)
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
