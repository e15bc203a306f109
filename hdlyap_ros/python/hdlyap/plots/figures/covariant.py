"""The figures of covariant vectors: one table of panels. Most are over the Lyapunov index, of all
vectors and, if there are many, magnified near the zero modes, with steps."""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
from matplotlib import ticker

from hdlyap.data import steps

from .. import covariant
from . import page
from .page import LETTERS
from .style import BLUE, GREEN, GREY, INK, LIGHT, SKY, UPRIGHT, VERMILION, ZERO
from .style import below, beside, index_axis, instead, kind_colour

ORDER = 10

LEAST, MOST = 16, 40  # vectors of the positive half in the magnified panels
MAGNIFIED = 2 / 3  # most part of the indices, or angles, that a magnified panel has
WEIGHTS = 4  # most panels of weights
UNDER = 0.37  # width of their legend over that of a panel
ROUNDING = 1e-16  # least value that is drawn; smaller ones are rounding
ROOM = 1.4  # height of the axes over that of curves, to leave room for text
NEARLY, PEAKED = 0.9, 0.3  # parts of all angles in one bin
ABOVE = 0.3  # height of what is above panels, in panels
SEEN = 0.1  # largest weight of all vectors, from which on weights are drawn
NO_WEIGHTS = (
    'weights',
    f'no vector has {100 * SEEN:.0f} % in the fields of a wave; smaller exponents have more',
)
NO_ERRORS = 'backward - forward in errors', 'errors are not known yet; average longer'
POINTS = {'fmt': '.', 'markersize': 3, 'elinewidth': 0.7}
HOLLOW = {'fmt': 'o', 'color': INK, 'markerfacecolor': 'none'}
SIDE_BY_SIDE = {'loc': 'upper left', 'ncol': 2, 'handletextpad': 0.2, 'fontsize': 7}


class Panel(NamedTuple):
    """What a panel over the index shows: curves are (label, places, values, style) and, if they
    have bars, errors; levels (height, label)."""

    label: str
    curves: list
    axes: dict = {}  # of Axes.set
    legend: dict = None
    levels: tuple = ()
    name: str = ''
    missing: tuple = ()  # what is left out if there are no curves, and why

    def draw(self, axes, ends, look):
        first, last = ends
        for label, places, values, style, *error in self.curves:
            inside = (places >= first - 0.5) & (places <= last + 0.5) & np.isfinite(values)
            bars = next((one[inside] for one in error if np.isfinite(one[inside]).any()), None)
            style = {**POINTS, **style, **look, 'label': label}
            axes.errorbar(places[inside], values[inside], bars, **style)
        if not self.curves:
            instead(axes, 'errors not yet known')
        for height, label in self.levels if self.curves else ():
            style = ':' if label else '-'
            axes.axhline(height, color=GREY, linewidth=0.6, linestyle=style, label=label, zorder=0)
        index_axis(axes)
        axes.set(ylabel=self.label, xlim=(first - 0.8, last + 0.8), **self.axes)


def curve(label, places, values, *errors, **style):
    return label, places, np.asarray(values, dtype=float), style, *errors


def _exponents(run, indices, _):
    """Of the backward and the forward pass, and their difference in units of its error."""
    compared = covariant.Compared(run)
    forward, backward = compared.forward, compared.backward
    hollow = {**HOLLOW, 'markersize': 4, 'markeredgewidth': 0.6}
    curves = [
        curve('backward, between two samples', indices, run.covariant.local_exponents, color=LIGHT),
        curve('forward (Gram-Schmidt)', indices, forward, compared.forward_error, **hollow),
        curve('backward (covariant)', indices, backward, compared.backward_error, color=VERMILION),
    ]
    legend = {'loc': 'upper right', 'handletextpad': 0.4, 'fontsize': 6.5}  # exponents descend
    yield Panel(r'$\lambda_\ell$  [1/time unit]', curves, legend=legend)
    zero, off = compared.is_zero, compared.deviation
    curves = [
        curve('difference', indices[~zero], off[~zero], color=INK),
        curve('zero modes', indices[zero], off[zero], color=ZERO),
    ]
    levels = (0, None), (-2, '_two'), (2, '_two')
    known = curves if np.isfinite(off).any() else []
    yield Panel('backward - forward\n[combined errors]', known, levels=levels, missing=NO_ERRORS)


def _domination(run, indices, places):
    """Which finite-time exponents keep their order: those of neighbours, and all before an index
    against all after it."""
    message, ticks = run.covariant, np.linspace(0, 1, 6)
    changed = curve('next vector grew more', places, message.violations, color=BLUE)
    label = 'the next vector grew more\n[fraction of times]'
    yield Panel(label, [changed], {'ylim': (-0.04, 1.04), 'yticks': ticks})
    is_splitting = covariant.is_splitting(run, indices[:-1])
    violated = np.where(is_splitting, message.domination_violations, np.nan)
    never = violated == 0
    label, green = f'never ({never.sum()} dominated splittings)', {'fmt': 'v', 'color': GREEN}
    curves = [
        curve('of all times', places, violated, color=INK),
        curve(label, places[never], violated[never], **green, markersize=4.5),
    ]
    label = 'later vector grew more\nthan earlier one  [fraction]'
    legend = {**SIDE_BY_SIDE, 'columnspacing': 1}
    yield Panel(label, curves, {'ylim': (-0.04, 1.3), 'yticks': ticks}, legend)


def _vectors(run, indices, places):
    """Every covariant vector: its localisation, the angle between its halves, the angle to the
    next one, and how well it is known."""
    message, whole = run.covariant, {'ylim': (0, 1.04)}
    widths = curve('width', indices, message.widths, color=INK)
    yield Panel('localisation width\n$e^S/N$', [widths], {'ylim': (0, 1.08 * max(message.widths))})
    cosines = curve('cosine', indices, message.cos_theta, color=BLUE)
    yield Panel(r'$|\cos\Theta|$ of $\delta q$, $\delta p$', [cosines], whole)
    angles = [
        curve('mean', places, message.neighbour_angles, color=VERMILION),
        curve('smallest so far', places, message.least_neighbour_angles, color=SKY),
    ]
    room = {'ylim': (0, 1.4 * covariant.RIGHT_ANGLE)}
    yield Panel('angle to the next\n[rad]', angles, room, SIDE_BY_SIDE)
    apart = np.array(message.start_mismatch, dtype=float)
    apart = np.where(apart > 0, np.maximum(apart, ROUNDING), np.nan)
    scale = {'yscale': 'log'} if (apart > 0).any() else {}
    label = 'angle between two\nstarts  [sine]'
    yield Panel(label, [curve('apart', indices, apart, color=INK)], scale)


def _weights(run, indices):
    """Of the lowest waves' fields in vectors near the zero modes, for Gram-Schmidt and covariant
    vectors."""
    cross = {'fmt': 'x', 'color': GREY, 'markersize': 3.5, 'markeredgewidth': 0.8}
    hollow = {**HOLLOW, 'markersize': 5, 'markeredgewidth': 0.7}
    for weight in run.covariant.weights[:WEIGHTS]:
        colour = kind_colour(weight.kind)
        curves = [
            curve(r'covariant, $\delta q$', indices, weight.dq, fmt='o', color=colour),
            curve(r'covariant, $\delta p$', indices, weight.dp, **cross),
            curve(r'Gram-Schmidt, $\delta q$', indices, weight.gram_schmidt, **hollow),
        ]
        by_chance = [(covariant.chance(run, weight), 'by chance')]
        name = steps.name(weight, run.info)
        yield Panel('weight', curves, {'ylim': (-0.03, 1.03)}, None, by_chance, name)


def _most(run):
    """The largest weight of a vector in the fields of the lowest waves."""
    shown = run.covariant.weights[:WEIGHTS]
    return max(max(*weight.dq, *weight.gram_schmidt) for weight in shown)


def _over_index(panels, of_all, height, least=1):
    """The figure of a row for each panel, if the run has that many vectors. height: of all."""

    @page.figure
    def draw(page, run, **look):
        message = run.covariant
        if message is None or len(message.exponents) < least:
            return
        indices = covariant.indices(message)
        rows = [
            panel
            for panel in panels(run, indices, covariant.between(message))
            if panel.curves or not page.leave_out(*panel.missing)
        ]
        tall = height * (len(rows) + ABOVE) / (of_all + ABOVE)
        whole, near = (indices[0], indices[-1]), near_zero(run, indices)
        ranges = [whole] if whole == near else [whole, near]
        size = 4.6 if len(ranges) == 1 else 7.6, tall
        grid = page.panels(len(rows), len(ranges), *size, sharex='col', squeeze=False)
        for row, panel in zip(grid, rows):
            for axes, ends in zip(row, ranges):
                panel.draw(axes, ends, look)
            if panel.legend:
                below(row[0], row[0].legend(**panel.legend))
        page.outer(grid)
        shade(grid[:, -1], run, *ranges[-1])
        windows = f'{message.windows} window' + ('s' if message.windows != 1 else '')
        page.title(run.info, *grid.flat, more=f', covariant vectors of {windows}')

    return draw


@page.figure
def _draw_weights(page, run, **look):
    message = run.covariant
    if message is None or not message.weights:
        return
    indices = covariant.indices(message)
    shown, ends = list(_weights(run, indices)), near_zero(run, indices)
    if _most(run) < SEEN and page.leave_out(*NO_WEIGHTS):
        return
    columns = min(2, len(shown))
    rows = -(-len(shown) // columns)
    alike = {'sharex': True, 'sharey': True, 'squeeze': False}
    grid = page.panels(rows, columns, 3.8 * columns, 2.6 * rows + 0.6, **alike)
    bold = {'xycoords': 'axes fraction', 'va': 'top', 'weight': 'bold', 'fontsize': 8}
    for axes, panel, letter in zip(grid.flat, shown, LETTERS):
        panel.draw(axes, ends, look)
        axes.annotate(f'({letter}) {panel.name}', (0.03, 0.95), **bold)
        shade([axes], run, *ends)
    for axes in list(grid.flat)[len(shown) :]:
        axes.set_axis_off()
    page.outer(grid)
    look = {'loc': 'upper left', 'fontsize': 6.5, 'handletextpad': 0.2}
    _freest(grid.flat[: len(shown)], ends).legend(bbox_to_anchor=(0, 0.9), **look)
    page.title(run.info, more=f', covariant vectors of {message.samples} samples')


def _freest(panels, ends):
    """The panel in which the first vectors, below a legend, have the smallest weights."""
    beside = ends[0] + UNDER * (ends[1] - ends[0])

    def highest(axes):
        points = np.concatenate([line.get_xydata() for line in axes.get_lines()])
        return np.max(points[points[:, 0] < beside, 1])

    return min(panels, key=highest)


@page.figure
def _draw_angles(page, run, **look):
    """Distributions of the angles between unstable, centre and stable space."""
    message = run.covariant
    if message is None or not message.angles:
        return
    left, right = page.panels(1, 2, 7.2, 3.4)
    for axes, counts, title in (
        (left, 'smallest_counts', 'smallest angle'),
        (right, 'all_counts', 'all principal angles'),
    ):
        _histograms(axes, message.angles, counts, look)
        axes.set_title(title, loc='left')
        _angle_axis(axes, [getattr(angle, counts) for angle in message.angles])
        axes.set(ylabel='probability density  [1/rad]')
    page.outer(np.array([[left, right]]))
    page.title(run.info, left, right, more=f', {message.samples} samples')


def _angle_axis(axes, histograms):
    """All angles from 0 to pi/2; those alone that were found, if they are a small part."""
    axes.set_xlabel('angle  [rad]')
    drawn = [counts for counts in histograms if sum(counts) and not _is_peak(counts)]
    filled = np.flatnonzero(np.sum(drawn, axis=0)) if drawn else []
    edges = covariant.edges(histograms[0])
    if len(filled) and filled[-1] - filled[0] < MAGNIFIED * len(histograms[0]):
        axes.set_xlim(edges[max(filled[0] - 1, 0)], edges[min(filled[-1] + 2, len(edges) - 1)])
        axes.xaxis.set_major_locator(ticker.MaxNLocator(5))
        return
    axes.set(xlim=edges[[0, -1]], xticks=covariant.RIGHT_ANGLE * np.linspace(0, 1, 5))
    axes.set_xticklabels(['0', r'$\pi/8$', r'$\pi/4$', r'$3\pi/8$', r'$\pi/2$'])


def _histograms(axes, angles, name, look):
    """Draws histograms. One whose angles are nearly all in one bin is written, as its peak would
    hide others; lower peaks have a logarithmic scale."""
    heights = []
    for angle in angles:
        counts, colour = getattr(angle, name), (VERMILION, BLUE, GREEN)[angle.spaces]
        label = covariant.SPACES[angle.spaces]
        if _is_peak(counts):
            axes.plot([], [], linestyle='', label=f'{label}: {_peak(counts)}')
        elif sum(counts):
            heights.append(covariant.density(counts))
            dashes = '--' if colour == GREEN else '-'  # in pairs it is that of the one before
            style = {'color': colour, 'linewidth': 1, 'linestyle': dashes, **look, 'label': label}
            axes.step(covariant.edges(counts), [*heights[-1], 0], where='post', **style)
    if heights:
        _density_axis(axes, np.array(heights))
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc='upper left', handlelength=1, borderaxespad=0.2, fontsize=7)


def _density_axis(axes, heights):
    high, of_one_bin = heights.max(), heights.shape[1] / covariant.RIGHT_ANGLE
    if high > PEAKED * of_one_bin:
        low = 0.5 * heights[heights > 0].min()
        axes.set_yscale('log')
        axes.set_ylim(low, low * (high / low) ** ROOM)
    else:
        axes.set_ylim(0, ROOM * high)


def _is_peak(counts):
    return max(counts) > NEARLY * sum(counts)


def _peak(counts):
    """Where the angles of a histogram are, nearly all of which are in one bin."""
    low, high = np.degrees(covariant.edges(counts)[np.argmax(counts) :][:2])
    share = max(counts) / sum(counts)
    part = f'{100 * share:.0f} % ' if share < 1 else ''
    if np.isclose(high, 90):
        return f'{part}at right angles, within {high - low:.0f}°'
    return f'{part}{"in " if part else ""}{low:.0f} .. {high:.0f}°'


def near_zero(run, indices):
    """First and last index of the magnified column: the lowest steps of both halves, as far as the
    run has them; all if these are most, or far from zero."""
    whole, end = (indices[0], indices[-1]), min(run.positive_end, indices[-1])
    lowest = min((block.first for block in steps.blocks(run.steps)), default=end)
    first = max(whole[0], end + 1 - min(max(LEAST, end + 4 - lowest), MOST))
    last = min(whole[1], run.phase_space + 1 - first)
    is_most = last - first > MAGNIFIED * (whole[1] - whole[0])
    return whole if is_most or end < run.positive_end - MOST else (first, last)


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


FIGURES = {
    'covariant_exponents': SimpleNamespace(draw=_over_index(_exponents, 2, 5.0)),
    'covariant_weights': SimpleNamespace(draw=_draw_weights),
    'covariant_angles': SimpleNamespace(draw=_draw_angles),
    'covariant_domination': SimpleNamespace(draw=_over_index(_domination, 2, 4.8, least=2)),
    'covariant_vectors': SimpleNamespace(draw=_over_index(_vectors, 4, 7.4)),
}
