"""Where a figure is drawn: on a sheet of its own, of which pyplot knows nothing, or in axes of the
user's."""

import functools

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cbook import normalize_kwargs
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .style import scene


def figure(draw):
    """Of draw(page, said, **look), draw(run, ax=None, **look) for whoever has a run, or what is
    said of it. ax: axes of the user's, one or several, for as many of the panels, the first ones.
    look: keyword arguments of the artists that show what was measured. It gives the Page, or None
    where the bag has nothing for it."""

    @functools.wraps(draw)
    def drawn(run, ax=None, **look):
        page = Page(ax)
        draw(page, run.said, **normalize_kwargs(look, Line2D))
        return page.drawn()

    del drawn.__wrapped__  # whose arguments are others
    return drawn


class Page:
    """`figure`, `axes`, and `artists` that were drawn into them."""

    def __init__(self, ax=None):
        self._given = [] if ax is None else list(np.array(ax, dtype=object).flat)
        self.figure, self.artists = self._given[0].figure if self._given else None, []
        self._panels, self._before = [], ()

    @property
    def is_own(self):
        return not self._given

    def shows(self, number):
        """A panel of that number, from 0."""
        return self.is_own or number < len(self._given)

    @property
    def axes(self):
        return self.figure.axes if self.is_own else self._given

    def sheet(self, width, height, constrained_layout=True):
        """A figure. Into the user's axes it is not drawn, but for panels without axes of theirs,
        which nobody sees."""
        made = Figure(figsize=(width, height), constrained_layout=constrained_layout)
        FigureCanvasAgg(made)
        self.figure = made if self.is_own else self.figure
        return made

    def panels(self, rows, columns, width, height, constrained_layout=True, squeeze=True, **how):
        """As pyplot.subplots gives them."""
        sheet = self.sheet(width, height, constrained_layout)
        grid = sheet.subplots(rows, columns, squeeze=False, **how)
        grid.flat = self.taken(list(grid.flat))
        return grid.squeeze()[()] if squeeze else grid

    def taken(self, panels):
        """The user's axes in the place of the first ones."""
        if len(self._given) > len(panels):
            raise ValueError(f'ax: {len(self._given)} axes, for {len(panels)} panels')
        self._panels = self._given + panels[len(self._given) :]
        self._before = set(self._children())
        return self._panels

    def outer(self, grid):
        """Axes inside of a grid that share theirs need no names; the user's do."""
        for axes in grid[:-1].flat if self.is_own else ():
            axes.set_xlabel('')
        for axes in grid[:, 1:].flat if self.is_own else ():
            axes.set_ylabel('')

    def title(self, info, *panels, more=''):
        """The scene above it, and a letter above each of its panels, before what stands there; the
        user's figure has a title of theirs."""
        if not self.is_own:
            return
        for axes, letter in zip(panels, 'abc'):
            axes.set_title(f'({letter}) {axes.get_title(loc="left")}'.rstrip(), loc='left')
        self.figure.suptitle(scene(info) + more, fontsize=9)

    def drawn(self):
        """Itself; None if nothing was."""
        self.artists = [child for child in self._children() if child not in self._before]
        return self if self._panels else None

    def _children(self):
        panels = self._given or self._panels
        return [child for axes in panels for child in axes.get_children()]
