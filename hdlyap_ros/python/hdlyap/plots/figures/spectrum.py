"""All exponents, and a magnified panel of the smallest ones with the measured steps; below, for
particles that rotate, the share of rotation in each vector; of mixtures, that of the second
kind."""

from matplotlib import patches
from matplotlib.lines import Line2D
import numpy as np

from hdlyap.data import space, steps

from .. import paper
from . import page
from .style import GREY, INK, KIND_COLOURS, LIGHT, MANY, MIXED, SMALL, UPRIGHT, VERMILION, ZERO
from .style import bars, below, beside, index_axis, kind_colour

ORDER = 1
IS_OF_MEANS = True  # drawn of several seeds, too

# Least and largest number of exponents in the magnified panel; the steps decide, but with still
# more exponents their names would not fit
MAGNIFIED, MAGNIFIED_MOST = 40, 64
NEAR = 0.032  # names at this distance, over the width of the panel, would touch
LETTER = 4.2  # length of a name for each of its letters [points]
FAR = 0.5  # part of the largest exponent above which all are too far from 0 to show it
# of names: above the line of zero, which they hide, and below points
CLEAR = {'bbox': {'facecolor': 'white', 'edgecolor': 'none', 'pad': 0}, 'zorder': 1.5}
MOST = 0.45  # most room above the exponents for names, over the height


@page.figure
def draw(page, recording, **look):
    if recording.spectrum is None:
        return
    carried = recording.spectrum.first_index, recording.last_index
    ranges = [carried, _magnified_range(recording)]
    ranges = ranges[ranges[0] == ranges[1] :]
    share = _share_of(recording.info) if recording.modes is not None else None
    ratios = {'width_ratios': [1, 1.7][-len(ranges) :], 'height_ratios': [3, 1][: 1 + bool(share)]}
    size = 4.6 if len(ranges) == 1 else 7.6, 4.0 + 1.4 * bool(share)
    how = {'sharex': 'col', 'squeeze': False, 'gridspec_kw': ratios}
    rows = page.panels(1 + bool(share), len(ranges), *size, **how)
    if len(ranges) > 1:
        _whole(rows[0, 0], recording, look)
        if page.shows(1):
            _frame_magnified(rows[0, 0], recording)
        rows[0, 1].set_title('smallest exponents', loc='left')
    # in a narrow column there is room below the names in the other panel alone
    _small(rows[0, -1], rows[0, 0] if page.is_narrow else rows[0, -1], recording, dict(look))
    for axes, within in zip(rows[-1], ranges if share else ()):
        _share(axes, recording, *share, *within)
    averaged = f', averaged over {recording.spectrum.averaged_time:g} time units'
    for column in rows.T:
        page.outer(column[:, np.newaxis])
    page.title(recording.info, *(rows.flat if rows.size > 1 else ()), more=averaged)


def _whole(axes, recording, look):
    spectrum = recording.spectrum
    indices = np.arange(spectrum.first_index, recording.last_index + 1)
    style = {'fmt': '.', 'color': INK, 'markersize': 2, **MANY, **look}
    axes.errorbar(indices, spectrum.exponents, bars(spectrum.std_errors), **style)
    if recording.is_unpaired:
        _mirrored(axes, indices, spectrum.exponents)
    _exponent_axes(axes, spectrum.exponents)
    axes.set_title('all exponents carried', loc='left')


def _mirrored(axes, indices, exponents):
    """Draws all exponents with the other sign in reverse order. In pairs they would be the same."""
    look = {'linewidth': 0.8, 'color': GREY, 'zorder': 1, 'label': r'$-\lambda_{n+1-\ell}$'}
    axes.plot(indices, -np.array(exponents)[::-1], **look)
    axes.legend(loc='upper right')


def _share_of(info):
    """(field of Mode, what a vector without any preference has, name) of the share of dq that is
    drawn: in the angles, or on the second kind; None if there are neither."""
    if space.turns(info):
        return 'rotation', 1 / info.coordinates, 'share of rotation'
    if space.is_mixture(info):
        return 'second_kind', info.kind_numbers[1] / info.number, 'share of 2nd kind'
    return None


def _share(axes, recording, field, chance, label, first, last):
    colours = _colours(recording, first, last)
    found = [mode for mode in recording.modes.modes if first <= mode.index <= last]
    shares, small = [getattr(mode, field) for mode in found], last - first < MAGNIFIED_MOST
    axes.plot([mode.index for mode in found], shares, color=LIGHT, linewidth=0.8, zorder=1)
    for mode, share in zip(found, shares):
        look = {'color': colours.get(mode.index, INK), 'markersize': 2.2 if small else 1}
        axes.plot(mode.index, share, 'o', **look)
    axes.axhline(chance, color=GREY, linewidth=0.6, linestyle='--')
    axes.set_ylim(0, 1.1 * max([chance, *shares]))
    axes.set_ylabel(label)
    index_axis(axes, 8)


def _exponent_axes(axes, exponents):
    if min(exponents) < FAR * max(exponents):
        axes.axhline(0, color=GREY, linewidth=0.6, zorder=1)
    index_axis(axes, 8)
    axes.set_ylabel(r'$\lambda_\ell$  [1/time unit]')


def _frame_magnified(axes, recording):
    """Draws a light frame around the part that panel (b) shows."""
    first, last = _magnified_range(recording)
    offset = recording.spectrum.first_index
    inside = recording.spectrum.exponents[first - offset : last + 1 - offset]
    low, high = min(0, *inside), max(inside)
    corners = np.array([(0, 0), (0, 1), (1, 1), (1, 0), (0, 0)])
    frame = (first, low) + corners * (last - first, high - low)
    axes.plot(*frame.T, color=VERMILION, linewidth=0.8, zorder=4)


def _magnified_range(recording):
    """First and last index of the magnified panel: exponents before the zeros and, if the run has
    them, as many after these."""
    spectrum = recording.spectrum
    end = min(recording.positive_end, recording.last_index)
    lowest = min(
        (block.first for block in steps.blocks(recording.steps, recording.info)), default=end
    )
    halves = 2 if recording.last_index > recording.positive_end else 1
    count = min(max(MAGNIFIED, end - lowest + 5), MAGNIFIED_MOST) // halves
    first = max(spectrum.first_index, end - count + 1)
    last = min(recording.last_index, recording.phase_space + 1 - first)
    return first, last


def _small(axes, beside, recording, look):
    """Draws the smallest exponents; beside: the axes that have the legend."""
    spectrum = recording.spectrum
    first, last = _magnified_range(recording)
    colours = _colours(recording, first, last)
    for index in range(first, last + 1):
        i = index - spectrum.first_index
        error, colour = bars(spectrum.std_errors[i]), colours.get(index, INK)
        style = {'color': colour, **SMALL, **look}
        axes.errorbar(index, spectrum.exponents[i], error, **style)
        look.pop('label', None)  # once
    shown = [
        block
        for block in steps.all_blocks(recording.steps, recording.info)
        if first <= block.first and block.last <= last
    ]
    named = _name_blocks(axes, spectrum, shown, NEAR * (last - first))
    bands = [
        step for step in paper.steps(recording.info) if first <= step.first and step.last <= last
    ]
    for step in bands:
        _draw_band(axes, step, named=not shown)
    _exponent_axes(axes, spectrum.exponents)
    if shown:
        low, high = axes.get_ylim()
        room = min(MOST, LETTER * (named + 1) * axes.figure.dpi / 72 / axes.bbox.height)
        axes.set_ylim(low, low + (high - low) / (1 - room))
    others = set(range(first, last + 1)) - set(colours)
    handles = _legend(shown, bands, 'of no step' if shown and others else '')
    if handles:  # below the curve, above the line of zero; else above the curve
        low = {'loc': 'lower left', 'bbox_to_anchor': (0, 0.05)}
        how = low if beside is axes else {'loc': 'upper right'}
        if beside is not axes:  # what they have already
            handles = [*beside.get_legend_handles_labels()[0], *handles]
        legend = beside.legend(handles=handles, handletextpad=0.4, **how)
        if beside is not axes:
            below(beside, legend)


def _colours(recording, first, last):
    """{index: colour} of the vectors of every step in that range; of the paper's steps if the run
    has none."""
    colours = {}
    for block in steps.all_blocks(recording.steps, recording.info):
        for index in range(max(first, block.first), min(last, block.last) + 1):
            colours[index] = kind_colour(block.kind)
    if recording.steps is None:
        for step in paper.steps(recording.info):
            for index in range(step.first, step.last + 1):
                colours[index] = KIND_COLOURS[step.kind]
    return colours


def _name_blocks(axes, spectrum, blocks, near):
    """Writes the names of blocks above their vectors, upright, because there is no room beside
    them; a name that is near the one before above that. Returns the most letters above a point."""
    before, letters, most = -np.inf, 0, 0
    for block in sorted(blocks, key=lambda block: block.first):
        inside = slice(block.first - spectrum.first_index, block.last + 1 - spectrum.first_index)
        highest = max(
            np.add(spectrum.exponents[inside], np.maximum(0, spectrum.std_errors[inside]))
        )
        name = 'zero modes' if block.kind == steps.ZERO else block.name
        middle = 0.5 * (block.first + block.last)
        under = letters + 1 if middle - before < near else 0
        look = {'color': kind_colour(block.kind), 'fontsize': 7, **CLEAR, **UPRIGHT}
        beside(axes, name, (middle, highest), (0, 6 + LETTER * under), **look)
        before, letters = middle, len(name) if not under else -1
        most = max(most, under + len(name))
    return most


def _draw_band(axes, step, named):
    """Draws the fitted value as a band as wide as the step, with its name before it unless the
    measured step has one."""
    colour = KIND_COLOURS[step.kind]
    low, high = (step.fitted * (1 + sign * paper.FIT_ACCURACY) for sign in (-1, 1))
    ends = step.first - 0.5, step.last + 0.5
    axes.fill_between(ends, low, high, color=colour, alpha=0.2, linewidth=0)
    if named:
        look = {'color': colour, 'fontsize': 7, 'ha': 'right', 'va': 'center'}
        beside(axes, step.name, (ends[0], step.fitted), (-3, 0), **look)


def _legend(blocks, bands, others):
    handles = [
        Line2D([], [], linestyle='', marker='o', markersize=4, color=colour, label=label)
        for colour, label in (
            (KIND_COLOURS['T'], 'T, transverse'),
            (KIND_COLOURS['LP'], 'LP, longitudinal and momentum'),
            (MIXED, 'T and LP share a set'),
            (ZERO, 'zero modes'),
        )
        if colour in {kind_colour(block.kind) for block in blocks}
    ]
    if others:
        handles.append(Line2D([], [], linestyle='', marker='o', markersize=4, color=INK))
        handles[-1].set_label(others)
    if bands:
        handles += [
            patches.Patch(color=KIND_COLOURS[kind], alpha=0.2, label=label)
            for kind, label in (
                ('T', r'$c_T k \pm 3$ %, Eckmann et al. 2005'),
                ('LP', r'$c_L k \pm 3$ %'),
            )
        ]
    return handles
