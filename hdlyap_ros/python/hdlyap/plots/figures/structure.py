"""Structure factors over index and k, where each vector has a ridge; and the lines of the lowest
steps in S(k, omega)."""

import numpy as np
from matplotlib.colors import LogNorm

from hdlyap.data import steps
from hdlyap.data.factors import DIRECTIONS, REPORTS, frequencies, largest_frequency, line, power
from hdlyap.numbers import with_error

from . import page
from .style import INK, index_axis, kind_colour, plain_log

ORDER = 9

NO_LINE = (
    f'none is known; it takes a step with a set of its own, and {REPORTS} reports of its vectors '
    'at one wave'
)
FOLDED = (
    'it turns by {:.3g} rad/time unit, and reports are too rare; report_interval: {:.2g} would do'
)
NOISE = 0.5  # the structure factor of a random vector
TITLES = {'along': 'along $k$', 'across': 'across $k$'}
OF_KIND = {steps.LP: 'along', steps.T: 'across'}


@page.figure
def draw(page, recording, **look):
    means = recording.structure.means
    if means is None:
        return
    blocks = steps.blocks(recording.steps, recording.info)
    found = [block for block in blocks if len(block.steps) == 1]
    lines_of = list(_found_lines(page, recording, found))
    has_lines = bool(lines_of) or not page.leave_out('spectral lines', NO_LINE)
    sheet, axes = _panels(page, has_lines)
    ridges, lines = axes[:2], axes[2:]
    for axes, direction in zip(ridges, DIRECTIONS):
        image = _ridge(axes, means, direction, look)
        _classified(axes, found, direction)
        axes.set_title(TITLES[direction], loc='left')
        index_axis(axes)
        axes.set_ylabel(r'wave number $k$  [$1/\sigma$]')
        if not page.is_own:
            _bar(image, axes)
    if page.is_own:
        _bar(image, ridges)
    page.outer(np.array([ridges]))
    for axes in lines:
        if page.is_own:
            sheet.delaxes(axes)
            sheet.add_axes(axes)  # moves it to the end, because panels are counted in this order
        _lines(axes, recording, lines_of)
    page.title(recording.info, *ridges, *lines)


def _bar(image, axes):
    bar = image.axes.figure.colorbar(image, ax=axes, label=r'$S(k)$')
    plain_log(bar.ax.yaxis)


def _panels(page, has_lines):
    """The sheet and its axes: two maps side by side, or in a narrow column below each other, and
    below them lines."""
    rows = 1 + has_lines
    if page.is_narrow:
        sheet = page.sheet(3.4, 2.1 * (1 + rows))
        grid = sheet.add_gridspec(1 + rows, 1)
        places = [grid[row] for row in range(1 + rows)]
    else:
        sheet = page.sheet(7, 3.1 * rows)
        grid = sheet.add_gridspec(rows, 2)
        places = [grid[0, 0], grid[0, 1], *(grid[row, :] for row in range(1, rows))]
    return sheet, page.taken([sheet.add_subplot(place) for place in places])


def shells(means, direction):
    """k, and S[k, vectors]: the largest value of all waves with the same k."""
    factors = getattr(means, direction)
    k = np.unique(np.round(means.wave_number, 9))
    of = np.searchsorted(k, np.round(means.wave_number, 9))
    largest = np.zeros((len(k), factors.shape[1]))
    np.maximum.at(largest, of, factors)
    return k, largest


def _ridge(axes, means, direction, look):
    k, largest = shells(means, direction)
    around = np.concatenate(([0], k, [2 * k[-1] - (k[-2] if len(k) > 1 else 0)]))
    edges = 0.5 * (around[1:] + around[:-1])
    # between walls some k have no transverse waves
    values = np.where(largest.any(axis=1, keepdims=True), np.maximum(largest, 1e-3), np.nan)
    places = np.arange(largest.shape[1] + 1) + 0.5
    norm = LogNorm(NOISE / 2, max(largest.max(), 2 * NOISE))
    style = {'norm': norm, 'cmap': 'magma_r', 'rasterized': True, **look}
    image = axes.pcolormesh(places, edges, values, **style)
    axes.set_ylim(0, edges[-1])
    return image


def _classified(axes, found, direction):
    """Draws rings where a step of this direction says that its vectors are."""
    for block in found:
        if OF_KIND.get(block.kind) == direction:
            place = 0.5 * (block.first + block.last), block.steps[0].wave_number
            colour = kind_colour(block.kind)
            rim = {'markerfacecolor': 'none', 'markeredgecolor': colour, 'clip_on': False}
            axes.plot(*place, 'o', markersize=6, **rim)


def _omega(recording, block):
    """v k of the phases of an LP step; 0 for others, and if it is not known."""
    known = block.kind == steps.LP and recording.steps.v_phases > 0
    return recording.steps.v * block.steps[0].wave_number if known else 0.0


def _found_lines(page, recording, found):
    """Yields (block, times, series, line) of the lowest T and the lowest LP step with a line. That
    of an LP step which turns by more than half a turn between reports would be at another
    frequency."""
    kinds = set()
    for block in found:
        kind, indices = block.kind, range(block.first, block.last + 1)
        if kind in kinds or not recording.structure.has(indices):
            continue
        times, series = recording.structure.of(indices, OF_KIND[kind])
        found_line, omega = line(times, series), _omega(recording, block)
        if found_line is None:
            continue
        kinds.add(kind)
        if omega > largest_frequency(times):
            page.leave_out(f'the line of {block.name}', FOLDED.format(omega, np.pi / (2 * omega)))
        else:
            yield block, times, series, found_line


def _lines(axes, recording, lines):
    """Draws the power of the vectors' amplitudes over the frequency."""
    for block, times, series, found_line in lines:
        omega = frequencies(times)
        values = power(times, series, omega)
        label = rf'{block.name}: $\omega = {with_error(*found_line, decimals=4)}$'
        axes.semilogy(omega, values, color=kind_colour(block.kind), label=label)
        v_k = _omega(recording, block)
        if v_k > 0:
            label = f'$v k$ of the phases, {block.name}'
            axes.axvline(v_k, color=INK, linestyle=':', label=label)
    axes.set_title('spectral lines of the lowest steps', loc='left')
    axes.set_xlabel(r'$\omega$  [rad/time unit]')
    axes.set_ylabel(r'$S(k, \omega)$')
    if lines:
        axes.legend()
    else:
        axes.text(0.5, 0.5, 'no line is known', ha='center', va='center', transform=axes.transAxes)
        axes.set(xticks=[], yticks=[])
