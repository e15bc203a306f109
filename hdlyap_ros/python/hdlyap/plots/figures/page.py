"""Where a figure is drawn: on a new sheet, which pyplot does not know, or in axes of the user's."""

import functools

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cbook import normalize_kwargs
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .style import scene


def figure(draw):
    """Makes draw(run, ax=None, **look), for users with a Run or Summary, from draw(page, said,
    **look). ax: one or several axes of the user's, into which the first panels are drawn. look:
    keyword arguments of the artists that show measured values. It returns the Page, or None if the
    bag has no data for the figure."""

    @functools.wraps(draw)
    def drawn(run, ax=None, **look):
        page = Page(ax)
        draw(page, run.summary, **normalize_kwargs(look, Line2D))
        return page.drawn()

    del drawn.__wrapped__  # help() would show the arguments of that function
    return drawn


class Page:
    """Where to draw: `figure`, `axes`, and `artists` that were drawn into them."""

    def __init__(self, ax=None):
        self._given = [] if ax is None else list(np.array(ax, dtype=object).flat)
        self.figure, self.artists = self._given[0].figure if self._given else None, []
        self._panels, self._before = [], ()

    @property
    def is_own(self):
        return not self._given

    def shows(self, number):
        """Whether a panel, counted from 0, is drawn."""
        return self.is_own or number < len(self._given)

    @property
    def axes(self):
        return self.figure.axes if self.is_own else self._given

    def sheet(self, width, height, constrained_layout=True):
        """A new Figure. If the user has given axes, it only takes the panels for which there are
        none, and nobody sees it."""
        made = Figure(figsize=(width, height), constrained_layout=constrained_layout)
        FigureCanvasAgg(made)
        self.figure = made if self.is_own else self.figure
        return made

    def panels(self, rows, columns, width, height, constrained_layout=True, squeeze=True, **how):
        """A grid of axes, as pyplot.subplots returns it."""
        sheet = self.sheet(width, height, constrained_layout)
        grid = sheet.subplots(rows, columns, squeeze=False, **how)
        grid.flat = self.taken(list(grid.flat))
        return grid.squeeze()[()] if squeeze else grid

    def taken(self, panels):
        """The panels, the first of which are replaced by the user's axes."""
        if len(self._given) > len(panels):
            raise ValueError(f'ax: {len(self._given)} axes, for {len(panels)} panels')
        self._panels = self._given + panels[len(self._given) :]
        self._before = set(self._children())
        return self._panels

    def outer(self, grid):
        """Removes the labels of axes inside a grid, which share those at its edges; not from the
        user's axes."""
        for axes in grid[:-1].flat if self.is_own else ():
            axes.set_xlabel('')
        for axes in grid[:, 1:].flat if self.is_own else ():
            axes.set_ylabel('')

    def title(self, info, *panels, more=''):
        """Writes the scene above the figure, and letters before the titles of its panels; not into
        the user's figure."""
        if not self.is_own:
            return
        for axes, letter in zip(panels, 'abc'):
            axes.set_title(f'({letter}) {axes.get_title(loc="left")}'.rstrip(), loc='left')
        self.figure.suptitle(scene(info) + more, fontsize=9)

    def drawn(self):
        """This page; None if nothing was drawn."""
        self.artists = [child for child in self._children() if child not in self._before]
        return self if self._panels else None

    def _children(self):
        panels = self._given or self._panels
        return [child for axes in panels for child in axes.get_children()]
