"""What several figures have in common, and the numbers that one shows."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.container import ErrorbarContainer


SIGMA_UNIT = r'[$\sigma$/time unit]'
SHOWN = 'panel', 'curve', 'x', 'y', 'error'


def bars(axes, points, marker='o', colour=None, label='_', **style):
    """points: (x, y, error of y), no bar where that is not known; nothing without points."""
    if not len(points):
        return
    x, y, errors = np.array(points, dtype=float).T
    style = {'markersize': 4, 'elinewidth': 0.9, 'capsize': 2, 'zorder': 3, **style}
    errors = np.maximum(0, np.nan_to_num(errors))
    axes.errorbar(x, y, errors, fmt=marker, color=colour, label=label, **style)


def panels(rows, columns, size, **how):
    """(figure, its axes) with letters."""
    figure, axes = plt.subplots(rows, columns, figsize=size, constrained_layout=True, **how)
    letters(np.atleast_1d(axes).flat)
    return figure, axes


def letters(axes, titles=()):
    for number, one in enumerate(axes):
        more = f' {titles[number]}' if number < len(titles) else ''
        one.set_title(f'({"abcdefgh"[number]}){more}', loc='left')


def band(axes, x, y, share, colour, **style):
    """y within a share of it."""
    style = {'alpha': 0.15, 'linewidth': 0, 'color': colour, **style}
    axes.fill_between(x, (1 - share) * y, (1 + share) * y, **style)


def legend(axes, **how):
    if axes.get_legend_handles_labels()[0]:
        axes.legend(**how)


def numbers(figure):
    """As in SHOWN: the points of all its curves and bars, with their errors."""
    for panel, axes in enumerate(figure.axes, start=1):
        for number, (name, *points) in enumerate(_curves(axes), start=1):
            name = f'curve {number}' if not name or name.startswith('_') else name
            for one in zip(*points):
                yield panel, name, *('' if value is None else f'{value:.7g}' for value in one)


def _curves(axes):
    """(name, x, y, errors, None of what is not known) of each"""
    caps, bars = set(), {}
    for one in axes.containers:
        if isinstance(one, ErrorbarContainer):
            caps |= set(one.lines[1])
            bars[one.lines[0]] = one
        else:
            middles = [bar.get_x() + bar.get_width() / 2 for bar in one]
            heights = [bar.get_height() for bar in one]
            yield one.get_label(), middles, heights, _lengths(one.errorbar, len(middles))
    for line in axes.lines:
        if line not in caps:
            x, y = line.get_data()
            yield bars.get(line, line).get_label(), x, y, _lengths(bars.get(line), len(x))


def _lengths(container, count):
    """Half of each bar; None of what is not known."""
    if container is None or not container.lines[2]:
        return count * [None]
    ends = (np.reshape(one, (-1, 2)) for one in container.lines[2][0].get_segments())
    found = [np.ptp(one[:, 1]) / 2 if len(one) else 0 for one in ends]
    return [value if value > 0 else None for value in found]
