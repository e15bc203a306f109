"""What several figures have in common."""

import numpy as np

from hdlyap.plots.figures.style import plt

SIGMA_UNIT = r'[$\sigma$/time unit]'


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
