"""Where a figure is drawn: on a new sheet, which pyplot does not know, or in axes of the user's."""

import contextlib
import functools
import string

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cbook import normalize_kwargs
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .style import ours, scene


PAPER = {'one-column': 3.375, 'two-column': 7.0}  # widths of a journal's columns [inch]
TALLEST = 9.0  # of a journal [inch]
PANEL, LEAST = 2.1, 1.5  # most height of a panel below others in one column, and least [inch]
LINE = 0.17  # height of a line of the title [inch]
LETTERS = string.ascii_lowercase


def figure(draw):
    """Makes draw(run, ax=None, title=True, legend=True, paper=None, left_out=None, **look), for
    users with a Run or Summary, from draw(page, said, **look). ax: one or several axes of the
    user's, into which the first panels are drawn. title: whether the scene stands above the figure.
    paper: for a journal, as a key of PAPER. left_out: a list to which Page.left_out is added, of a
    whole figure, too. look: keyword arguments of the artists that show measured values. It returns
    the Page, or None if the bag has no data for the figure."""

    @functools.wraps(draw)
    def drawn(run, ax=None, title=True, legend=True, paper=None, left_out=None, **look):
        page = Page(ax, title, legend, paper)
        page.left_out = page.left_out if left_out is None else left_out
        with ours(paper) if paper and page.is_own else contextlib.nullcontext():
            draw(page, run.summary, **normalize_kwargs(look, Line2D))
            return page.drawn()

    del drawn.__wrapped__  # help() would show the arguments of that function
    return drawn


def fit(text):
    """Breaks lines of a text that end outside of its figure, at commas."""
    figure, lines = text.figure, []
    renderer = figure.canvas.get_renderer()
    for line in text.get_text().split('\n'):
        first, *others = line.split(', ')
        lines.append(first)
        for part in others:
            text.set_text(f'{lines[-1]}, {part}')
            place = text.get_window_extent(renderer)
            if place.x0 >= 0 and place.x1 <= figure.bbox.width:
                lines[-1] += f', {part}'
            else:
                lines[-1] += ','
                lines.append(part)
    text.set_text('\n'.join(lines))


class Page:
    """Where to draw: `figure`, `axes`, and `artists` that were drawn into them. `caption`: what the
    title says. `left_out`: a line for each panel without data: why, and what would fill it."""

    def __init__(self, ax=None, title=True, legend=True, paper=None):
        if paper not in (None, *PAPER):
            raise ValueError(f'paper: {paper!r}: must be one of {", ".join(PAPER)}')
        self._given = [] if ax is None else list(np.array(ax, dtype=object).flat)
        if ax is not None and not self._are_axes():
            raise ValueError(f'ax: {ax!r}: must be Axes of matplotlib, one or several')
        self.figure, self.artists = self._given[0].figure if self._given else None, []
        self._panels, self._before = [], ()
        self.has_title, self.has_legend, self.paper = title and not paper, legend, paper
        self.caption, self.left_out = '', []

    def _are_axes(self):
        return len(self._given) > 0 and all(isinstance(one, Axes) for one in self._given)

    @property
    def is_own(self):
        return not self._given

    @property
    def is_narrow(self):
        """Whether panels have to stand below each other."""
        return self.is_own and self.paper == 'one-column'

    @property
    def widest(self):
        """The width of a journal's column [inch]; infinite for none."""
        return PAPER.get(self.paper, np.inf)

    def shows(self, number):
        """Whether a panel, counted from 0, is drawn."""
        return self.is_own or number < len(self._given)

    def leave_out(self, what, why):
        """Whether a panel that has no data is left out, which is said: not of the user's axes."""
        if self.is_own:
            self.left_out.append(f'{what}: {why}')
        return self.is_own

    @property
    def axes(self):
        return self.figure.axes if self.is_own else self._given

    def sheet(self, width, height, constrained_layout=True, least=0.0):
        """A new Figure, of this size or, for a journal, as wide as its column, and at least so
        high. If the user has given axes, it only takes the panels for which there are none, and
        nobody sees it."""
        if self.paper:
            wide = self.widest
            width, height = wide, min(max(height * min(1, wide / width), least), TALLEST)
        made = Figure(figsize=(width, height), constrained_layout=constrained_layout)
        FigureCanvasAgg(made)
        self.figure = made if self.is_own else self.figure
        return made

    def panels(self, rows, columns, width, height, constrained_layout=True, squeeze=True, **how):
        """A grid of axes, as pyplot.subplots returns it; in a narrow column one below the other,
        unless they are pictures of the box, which have its form (is_box)."""
        is_box = how.pop('is_box', False)
        if self.is_narrow and columns > 1 and not is_box:
            grid = self._stacked(rows, columns, height / rows, **how)
        else:
            least = 0.0 if is_box else LEAST * rows
            sheet = self.sheet(width, height, constrained_layout, least)
            grid = sheet.subplots(rows, columns, squeeze=False, **how)
        grid.flat = self.taken(list(grid.flat))
        return grid.squeeze()[()] if squeeze else grid

    def _stacked(self, rows, columns, height, sharex=False, sharey=False, gridspec_kw=None):
        """The grid with all axes in one column, which keep what they share."""
        sheet = self.sheet(self.widest, rows * columns * min(height, PANEL))
        ratios = np.repeat((gridspec_kw or {}).get('height_ratios', [1] * rows), columns)
        places = sheet.add_gridspec(rows * columns, 1, height_ratios=ratios)
        grid = np.empty((rows, columns), dtype=object)
        for row, column in np.ndindex(rows, columns):
            first = {'all': grid[0, 0], True: grid[0, 0], 'col': grid[0, column]}
            of_row = {**first, 'row': grid[row, 0]}
            shared = {'sharex': first.get(sharex), 'sharey': of_row.get(sharey)}
            grid[row, column] = sheet.add_subplot(places[row * columns + column], **shared)
        return grid

    def taken(self, panels):
        """The panels, the first of which are replaced by the user's axes."""
        if len(self._given) > len(panels):
            raise ValueError(f'ax: {len(self._given)} axes, for {len(panels)} panels')
        self._panels = self._given + panels[len(self._given) :]
        self._before = set(self._children())
        return self._panels

    def outer(self, grid):
        """Removes the labels of axes inside a grid, which share those at its edges; not from the
        user's axes, nor from those in a narrow column."""
        if not self.is_own or self.is_narrow and grid.shape[1] > 1:
            return
        for axes in grid[:-1].flat:
            axes.set_xlabel('')
        for axes in grid[:, 1:].flat:
            axes.set_ylabel('')

    def title(self, info, *panels, more=''):
        """Writes the scene above the figure, and letters before the titles of its panels; not into
        the user's figure."""
        self.caption = (scene(info) + more).replace(',\n', ', ').replace('\n', ', ')
        if not self.is_own:
            return
        for axes, letter in zip(panels, LETTERS):
            text = axes._left_title  # set_title would take the usual size
            text.set_text(f'({letter}) {text.get_text()}'.rstrip())
            fit(text)
        if self.has_title:
            text = self.figure.suptitle(scene(info) + more, fontsize=9)
            lines = text.get_text().count('\n')
            fit(text)
            room = LINE * (text.get_text().count('\n') - lines)  # panels keep their heights
            self.figure.set_figheight(self.figure.get_figheight() + room)

    def drawn(self):
        """This page; None if nothing was drawn."""
        if not self.has_legend:
            self._drop_legends()
        if self.paper and self.is_own and self.figure:
            for line in self.figure.findobj(lambda one: isinstance(one, (Line2D, LineCollection))):
                line.set_rasterized(False)
        self.artists = [child for child in self._children() if child not in self._before]
        return self if self._panels else None

    def _drop_legends(self):
        for legend in (axes.get_legend() for axes in self._panels):
            if legend is not None and legend not in self._before:
                legend.remove()

    def save(self, path):
        """Writes the figure, in its look, to a file; its kind is that of the name's ending."""
        with ours(self.paper):
            self.figure.savefig(path, dpi=600 if self.paper else 250)

    def _children(self):
        panels = self._given or self._panels
        return [child for axes in panels for child in axes.get_children()]
