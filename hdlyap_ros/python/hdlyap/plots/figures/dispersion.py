"""Exponents of the steps against the wave number, with the fitted branches."""

import numpy as np
from matplotlib.lines import Line2D

from hdlyap.data import fits, space, steps
from hdlyap.data.containers import is_curved
from hdlyap.numbers import with_error

from .. import paper
from . import page
from .style import FEW, GREY, KIND_COLOURS, bars, kind_colour

ORDER = 4
IS_OF_MEANS = True  # drawn of several seeds, too

MARKERS = {steps.T: 'o', steps.LP: 's'}
CLOSE = 0.028  # names nearer than this part of the axes' width are put together
NAMES = 3  # most names that are put together
MARGIN = 1.08
PUBLISHED = {'linewidth': 0.8, 'dashes': (2, 2)}
PUBLISHED_UP_TO = 0.3  # largest wave number for which slopes without curvature are meant


@page.figure
def draw(page, recording, **look):
    found = steps.blocks(recording.steps, recording.info)
    points = [(block, step) for block in found for step in block.steps]
    if not points:
        return
    axes = page.panels(1, 1, 5.2, 4.4)
    end = MARGIN * max(step.wave_number for _, step in points)
    of_t, of_l, _ = fits.of(recording.steps)
    for fit in (of_l, of_t):
        _branch(axes, recording.info, fit, end, look, not page.paper)
    for block, step in points:
        _point(axes, step, len(block.steps) == 1, look)
        look.pop('label', None)  # once
    axes.set_xlim(0, end)
    axes.set_ylim(0, MARGIN * max(step.exponent for _, step in points))
    axes.set_xlabel(r'wave number $k$  [1/$\sigma$]')
    axes.set_ylabel(r'$\lambda$  [1/time unit]')
    _wave_axis(axes, recording.info, [step for _, step in points], end)
    _legend(axes, [block for block, _ in points], of_l.is_unrelated)
    page.title(recording.info)


def _point(axes, step, alone, look):
    """Draws a step. Its marker is open if it shares its vectors with another step."""
    colour = look.get('color', kind_colour(step.kind))
    face, marker = colour if alone else 'white', MARKERS.get(step.kind, 'D')
    style = {'fmt': marker, 'color': colour, 'markerfacecolor': face, 'zorder': 3, **FEW, **look}
    axes.errorbar(step.wave_number, step.exponent, bars(step.std_error), **style)


def _branch(axes, info, fit, end, look, with_misfit):
    """Draws the fit of the run, dashed if its curvature is assumed, and, with a thin line, that of
    the paper if it holds."""
    kind = steps.NAMES[fit.kind]
    colour = look.get('color', KIND_COLOURS[kind])
    if fit.count:
        k = np.linspace(0, end, 100)
        line = sum(value * k**power for power, (_, value, _) in enumerate(fit.values, start=1))
        style = {'color': colour, 'linestyle': '--' if fit.is_assumed else '-'}
        axes.plot(k, line, label=f'{kind}: {_fit_label(fit, with_misfit)}', **style)
    published = paper.branches(info).get(kind)
    if published is not None and not fit.is_unrelated:
        k = np.linspace(0, end if published.c2 else min(end, PUBLISHED_UP_TO), 100)
        line = published.c * k + (published.c2 or 0) * k**2
        axes.plot(k, line, color=colour, label='_published', **PUBLISHED)


def _fit_label(fit, with_misfit):
    """The label of a fit: slope and misfit, its form if that is not the usual one, and what is
    assumed."""
    name, value, error = fit.values[0]
    label = f'${name[0]}_{{{name[2:]}}}={with_error(value, error, decimals=3)}$'
    label += fit.beside if with_misfit else ''
    label += f' by {fit.form}' if fit.terms < 3 else ''
    return f'{label}, {fits.ASSUMED}' if fit.is_assumed else label


def _wave_axis(axes, info, points, end):
    """Writes the nodes of waves along the upper edge, above their wave numbers. Names that would
    overlap are put together."""
    groups = []
    for step in sorted(points, key=lambda step: step.wave_number):
        name = steps.nodes_name(step, info)
        if groups and step.wave_number - groups[-1][0] < CLOSE * end:
            groups[-1][1].setdefault(name)
        else:
            groups.append((step.wave_number, {name: None}))
        look = {'color': GREY, 'linewidth': 0.4, 'alpha': 0.4, 'zorder': 0}
        axes.vlines(step.wave_number, step.exponent, axes.get_ylim()[1], **look)
    axes.tick_params(top=False)
    upper = axes.twiny()
    upper.set_xlim(axes.get_xlim())
    upper.set_xticks([k for k, _ in groups])
    upper.set_xticklabels([_joined(list(names)) for _, names in groups], rotation=90, fontsize=7)
    names = ','.join(f'n_{axis}' for axis in space.axes(info))
    upper.set_xlabel('$(m,n)$' if is_curved(info) else f'nodes $({names})$', fontsize=8)


def _joined(names):
    return ' '.join(names[:NAMES]) + (' ..' if len(names) > NAMES else '')


def _legend(axes, blocks, is_unrelated):
    handles, labels = axes.get_legend_handles_labels()
    for kind in (steps.LP, steps.T):
        if any(step.kind == kind for block in blocks for step in block.steps):
            handles.append(_marker(kind, kind_colour(kind)))
            said = ', which follow no relation' if kind == steps.LP and is_unrelated else ''
            labels.append(f'{steps.kind_name(kind)} steps{said}')
    shared = [block.steps for block in blocks if len(block.steps) > 1]
    if shared:
        handles.append(_marker(shared[0][0].kind, 'white'))
        labels.append('steps that share a set')
    if any(line.get_label() == '_published' for line in axes.get_lines()):
        handles.append(Line2D([], [], color=GREY, **PUBLISHED))
        labels.append('Eckmann et al. 2005')
    axes.legend(handles, labels, loc='lower right')  # below the branches


def _marker(kind, face):
    look = {'marker': MARKERS.get(kind, 'D'), 'markersize': FEW['markersize']}
    colour = kind_colour(kind) if face != 'white' else GREY
    return Line2D([], [], linestyle='', color=colour, markerfacecolor=face, **look)
