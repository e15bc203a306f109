"""Panels over the Lyapunov index: of all vectors, and magnified near the zero modes, with steps."""

import numpy as np

from hdlyap.data import steps

from .. import covariant
from .style import GREY, UPRIGHT, beside, index_axis, kind_colour

LEAST, MOST = 16, 40  # vectors of the positive half in the magnified panels


class Panels:
    """`rows` rows of panels; there is a second, magnified column if there are many vectors."""

    def __init__(self, page, run, rows, height, look):
        message = run.covariant
        self._page, self._look = page, look
        self._run, self._indices = run, covariant.indices(message)
        whole, near = (self._indices[0], self._indices[-1]), near_zero(run, self._indices)
        self.ranges = [whole] if whole == near else [whole, near]
        size = 4.6 if len(self.ranges) == 1 else 7.6, height
        shared = {'sharex': 'col', 'squeeze': False}
        self.grid = page.panels(rows, len(self.ranges), *size, **shared)
        windows = f'{message.windows} window' + ('s' if message.windows != 1 else '')
        page.title(run.info, more=f', covariant vectors of {windows}')

    def plot(self, row, places, values, error=None, **style):
        """Draws values in every column, as far as they are in its range."""
        named = {'label': style['label']}
        style = {'fmt': '.', 'markersize': 3, 'elinewidth': 0.7, **style, **self._look, **named}
        places, values = np.asarray(places), np.asarray(values, dtype=float)
        for axes, (first, last) in zip(self.grid[row], self.ranges):
            inside = (places >= first - 0.5) & (places <= last + 0.5) & np.isfinite(values)
            bars = None if error is None or not np.isfinite(error[inside]).any() else error[inside]
            axes.errorbar(places[inside], values[inside], bars, **style)

    def finish(self, *labels):
        """Labels the rows, and shows the steps in the last column."""
        for row, label in zip(self.grid, labels):
            for axes, (first, last) in zip(row, self.ranges):
                axes.set_ylabel(label)
                index_axis(axes)
                axes.set_xlim(first - 0.8, last + 0.8)
        self._page.outer(self.grid)
        shade(self.grid[:, -1], self._run, *self.ranges[-1])


def near_zero(run, indices):
    """First and last index of the magnified column: the lowest steps of both halves, as far as the
    run has them."""
    end = min(run.positive_end, indices[-1])
    lowest = min((block.first for block in steps.blocks(run.steps)), default=end)
    first = max(indices[0], end + 1 - min(max(LEAST, end + 4 - lowest), MOST))
    return first, min(indices[-1], run.phase_space + 1 - first)


def shade(column, run, first, last):
    """Draws bands behind the vectors of each step, with names above the uppermost panel."""
    for name, block in covariant.blocks(run):
        if block.first < first or block.last > last:
            continue
        colour = kind_colour(block.kind)
        for axes in column:
            look = {'color': colour, 'alpha': 0.13, 'linewidth': 0, 'zorder': 0}
            axes.axvspan(block.first - 0.5, block.last + 0.5, **look)
        # conjugate steps have no names, because they have the colours of the others in reverse
        if not name.startswith('conj.'):
            text, place = name.replace('+', '\n+'), (0.5 * (block.first + block.last), 1)
            look = {'xycoords': ('data', 'axes fraction'), 'fontsize': 6, 'color': colour}
            beside(column[0], text, place, (0, 3), **look, **UPRIGHT)


def level(axes, value, label=None):
    style = ':' if label else '-'
    axes.axhline(value, color=GREY, linewidth=0.6, linestyle=style, label=label, zorder=0)
