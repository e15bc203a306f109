#!/usr/bin/python3
"""Tables of the benchmark programs -> pictures.

Usage: draw.py FOLDER draws a PNG file there for every CSV file that it finds there.
"""

import csv
import math
import os
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

ROOT = os.path.join(os.path.dirname(__file__), '../..')
sys.path.append(os.path.join(ROOT, 'hdlyap_ros/python/hdlyap/plots/figures'))
from look import BLUE, GREEN, GREY, INK, ORANGE, PLAIN, PURPLE, SKY, VERMILION  # noqa: E402

METHODS = {  # name in the table: label, colour, marker
    'ours': ('hdlyap (hd_ortho_step)', VERMILION, 'o'),
    'ours_dq': ('hdlyap, norm of dq', INK, 'p'),
    'cholesky': ('Cholesky, one pass', SKY, 's'),
    'cholesky_twice': ('Cholesky, two passes', BLUE, 'D'),
    'mixed': ('Cholesky, triangle in single', GREEN, '^'),
    'single': ('Cholesky, all in single', ORANGE, 'v'),
    'householder': ('Householder', PURPLE, 'P'),
    'gram_schmidt': ('modified Gram-Schmidt', GREY, 'X'),
}
WRONG, FAILS = 1e-2, 1e1  # a larger deviation is useless; failures are drawn above this
PARTS = {'events': BLUE, 'replay': GREEN, 'factorisation': VERMILION, 'modes': PURPLE}


class Table:
    """The rows of a CSV file; columns have their names without units."""

    def __init__(self, path):
        with open(path, encoding='utf-8') as file:
            self.machine = file.readline().lstrip('# ').partition('; command')[0].strip()
            rows = csv.reader(file)
            names = [name.partition(' [')[0] for name in next(rows)]
            self.rows = [dict(zip(names, map(_value, row))) for row in rows]

    def __getitem__(self, name):
        return [row[name] for row in self.rows]

    def where(self, **wanted):
        return [row for row in self.rows if all(row[k] == v for k, v in wanted.items())]


def _value(text):
    try:
        return float(text)
    except ValueError:
        return text


# ---- what accuracy costs --------------------------------------------------------------------


def precision(tables):
    table = tables['precision']
    figure, (cliff, work) = plt.subplots(1, 2, figsize=(7.6, 4.6), sharey=True)
    for method in METHODS:
        rows = table.where(method=method)
        done = [row for row in rows if row['status'] == 'ok']
        _draw_method(cliff, method, [row['interval'] for row in done], done)
        _draw_method(work, method, [_seconds(row) for row in done], done)
        _mark_failure(cliff, method, rows)
    _draw_largest(cliff, table)
    _draw_chosen(cliff, work, table)
    _shade(cliff, left=True)
    _shade(work, left=False)
    _label_intervals(work, table)
    cliff.set(
        xscale='log',
        yscale='log',
        ylim=(1e-16, 1e7),
        xlabel='interval  [time units]',
        ylabel='largest deviation of an exponent  [1/time unit]',
    )
    cliff.margins(x=0.06)
    cliff.set_xticks([0.25, 0.5, 1, 2, 4, 8])
    cliff.set_xticklabels(['0.25', '0.5', '1', '2', '4', '8'])
    cliff.set_yticks([10.0**k for k in range(-15, 1, 3)])
    cliff.minorticks_off()
    work.set(xscale='log', xlabel='replay and factorisation  [s/time unit]')
    cliff.set_title('(a) too long an interval: the cliff', loc='left')
    work.set_title('(b) what accuracy costs', loc='left')
    _plain_ticks(work)
    handles, labels = cliff.get_legend_handles_labels()
    figure.legend(handles, labels, loc='lower center', ncol=3, bbox_to_anchor=(0.5, 1.0))
    return figure


def _seconds(row):
    return row['both at the median speed of dgemm']


def _draw_method(axes, method, x, rows):
    label, colour, marker = METHODS[method]
    wide = 2.0 if method == 'ours' else 1.1
    axes.plot(
        x,
        [row['deviation of any'] for row in rows],
        color=colour,
        marker=marker,
        linewidth=wide,
        label=label,
        zorder=3 if method == 'ours' else 2,
    )


def _mark_failure(axes, method, rows):
    """Draws a mark at the shortest interval at which the method notices that it fails."""
    failed = [row['interval'] for row in rows if row['status'] != 'ok']
    if failed:
        height = FAILS * 6.0 ** (1 + list(METHODS).index(method))
        axes.plot(
            min(failed),
            height,
            color=METHODS[method][1],
            marker='x',
            markersize=6,
            markeredgewidth=1.8,
            linestyle='none',
        )


def _draw_largest(axes, table):
    rows = [row for row in table.where(method='householder', status='ok')]
    axes.plot(
        [row['interval'] for row in rows],
        [max(row['deviation of the largest'], 2e-16) for row in rows],
        ':',
        color=INK,
        linewidth=1,
        label=r'$\lambda_1$ alone, Householder',
    )


def _draw_chosen(cliff, work, table):
    rows = table.where(method='auto')
    label = "hdlyap's own choice for accuracy $10^{-4}$ to $10^{-10}$"
    deviations = [row['deviation of any'] for row in rows]
    style = {
        'color': INK,
        'marker': '*',
        'markersize': 10,
        'linestyle': 'none',
        'zorder': 4,
        'markerfacecolor': 'white',
        'label': label,
    }
    cliff.plot([row['interval'] for row in rows], deviations, **style)
    work.plot([_seconds(row) for row in rows], deviations, **style)
    for k, interval in enumerate(sorted({row['interval'] for row in rows})):
        _name_chosen(cliff, [row for row in rows if row['interval'] == interval], k % 2 == 0)


def _name_chosen(axes, rows, left):
    """Writes one label for all accuracies with the same interval; neighbours on different sides."""
    powers = [f'$10^{{{math.log10(row["accuracy asked"]):.0f}}}$' for row in rows]
    names = powers[0] if len(powers) == 1 else f'{powers[0]} to {powers[-1]}'
    place = (
        {'xytext': (-3, 6), 'ha': 'right', 'va': 'bottom'}
        if left
        else {'xytext': (7, -4), 'ha': 'left', 'va': 'top'}
    )
    axes.annotate(
        names,
        (rows[0]['interval'], rows[0]['deviation of any']),
        fontsize=8,
        textcoords='offset points',
        zorder=5,
        **place,
    )


def _shade(axes, left):
    axes.axhspan(WRONG, FAILS, color=VERMILION, alpha=0.12, linewidth=0)
    axes.axhline(FAILS, color=GREY, linewidth=0.6)
    axes.annotate(
        'wrong, without an error',
        (0.03 if left else 0.97, WRONG * 2),
        xycoords=('axes fraction', 'data'),
        fontsize=8,
        ha='left' if left else 'right',
    )
    axes.annotate(
        'refused, with an error',
        (0.97, FAILS * 6**6),
        xycoords=('axes fraction', 'data'),
        fontsize=8,
        ha='right',
    )


def _label_intervals(axes, table):
    for row in table.where(method='householder', status='ok'):
        axes.annotate(
            f'{row["interval"]:g}',
            (_seconds(row), row['deviation of any']),
            xytext=(4, 3),
            textcoords='offset points',
            fontsize=7,
            color=PURPLE,
        )


def _plain_ticks(axes):
    low, high = axes.get_xlim()
    steps = (1, 2, 5) if high < 200 * low else (1,)
    ticks = [a * 10.0**k for k in range(-6, 5) for a in steps if low <= a * 10.0**k <= high]
    axes.set_xticks(ticks)
    axes.set_xticklabels([f'{tick:g}' for tick in ticks])
    axes.minorticks_off()


# ---- how cost grows -------------------------------------------------------------------------


def scaling(tables):
    table, fits = tables['scaling'], tables.get('scaling_fits')
    figure, panels = plt.subplots(1, 2, figsize=(7.6, 3.6), sharey=True)
    for axes, sweep, name, title in zip(panels, ('disks', 'vectors'), ('N', 'n'), 'ab'):
        rows = table.where(sweep=sweep)
        for part, colour in PARTS.items():
            points = [(row[sweep], row[part]) for row in rows if row[part] > 0]
            if points:
                axes.plot(
                    *zip(*points), 'o-', color=colour, label=part + _powers(fits, sweep, part, name)
                )
        axes.set(xscale='log', yscale='log')
        axes.set_title(_title(rows, sweep, title), loc='left')
        axes.legend(loc='upper left', fontsize=7)
        _plain_ticks(axes)
    seconds = [row[part] for row in table.rows for part in PARTS if row[part] > 0]
    panels[0].set_ylim(0.5 * min(seconds), 30 * max(seconds))
    panels[0].set(xlabel='disks N', ylabel='wall time  [s/time unit]')
    panels[1].set(xlabel='vectors n')
    return figure


def _title(rows, sweep, letter):
    if sweep == 'disks':
        return f'({letter}) positive half, n = 2N - 3'
    return f'({letter}) N = {rows[0]["disks"]:g}, spectrum alone'


def _powers(fits, sweep, part, name):
    for row in fits.where(sweep=sweep, part=part) if fits else []:
        return f': ${name}^{{{row["fitted power"]:.2f}}}$, theory ${name}^{{{row["theory"]:g}}}$'
    return ''


# ---- what each effect costs -----------------------------------------------------------------


def effects(tables):
    table = tables['effects']
    rows = sorted(table.rows, key=lambda row: row['percent'])
    figure, axes = plt.subplots(figsize=(5.8, 0.8 + 0.25 * len(rows)))
    axes.barh(range(len(rows)), [row['percent'] for row in rows], color=BLUE)
    for k, row in enumerate(rows):
        axes.annotate(
            f'{row["percent"]:.3g} %',
            (max(0, row['percent']), k),
            xytext=(3, 0),
            textcoords='offset points',
            va='center',
            fontsize=8,
        )
    axes.set_yticks(range(len(rows)))
    axes.set_yticklabels([row['effect'] for row in rows])
    axes.set_xlim(right=1.2 * max(1e-3, max(table['percent'])))
    axes.set_xlabel('cost  [% of the run that has it]')
    return figure


FIGURES = (precision, scaling, effects)


def save(figure, machine, path):
    """Saves the picture in one step, so that the file is complete."""
    figure.text(0.5, -0.01, machine, ha='center', va='top', fontsize=6, color=GREY)
    unfinished = f'{path}.part.png'
    try:
        figure.savefig(unfinished, dpi=200, bbox_inches='tight')
        os.replace(unfinished, path)
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)
    plt.close(figure)


def main(arguments):
    if len(arguments) != 1 or not os.path.isdir(arguments[0]):
        print('draw.py: one folder with the CSV files is needed', file=sys.stderr)
        return 2
    folder = arguments[0]
    tables = {
        name[:-4]: Table(os.path.join(folder, name))
        for name in os.listdir(folder)
        if name.endswith('.csv')
    }
    with plt.rc_context(PLAIN):
        for draw in FIGURES:
            if draw.__name__ in tables:
                path = os.path.join(folder, f'{draw.__name__}.png')
                save(draw(tables), tables[draw.__name__].machine, path)
                print(path)
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
