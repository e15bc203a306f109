"""Modes of spheres, in a row for each: arrows in the box, and components compared with the fields
of the waves that the boundaries allow."""

import numpy as np

from hdlyap.data import space, steps

from ..expected import Expected
from .box import Particles, arrows
from .style import BLUE, GREEN, GREY, INK, VERMILION
from .view import View

WIDTH, TALLEST = 7.6, 10.0  # width and largest height of the figure [inch]
ROW = 1.75  # least height of a row [inch]
DOT = 0.3  # diameter of spheres in the picture, where larger ones would hide others [sigma]
MOST = 2.6  # most arrows per square sigma of the front; if there are more, only those in front
LIMIT = 2.8  # largest component that is shown, in root mean squares of the vector
NAMED = 1.0  # height of the legend above that
LONG = 38  # a longer title does not fit above a panel in the usual size
AXES, COLOURS = 'xyz', (VERMILION, BLUE, GREEN)


def draw_panels(page, panels, info, look):
    """Draws a row for each modes.Panel. Returns the axes that show something."""
    view = View(info)
    left = 0.6 * WIDTH
    high = max(ROW, left * view.size[1] / view.size[0] + 0.3)
    high = min(high, TALLEST / len(panels))
    how = {'squeeze': False, 'gridspec_kw': {'width_ratios': [3, 2]}}
    rows = page.panels(len(panels), 2, WIDTH, len(panels) * high + 0.6, **how)
    for (in_space, beside), panel in zip(rows, panels):
        _arrows(in_space, panel, info, view, look)
        _component(beside, panel, info)
    return [axes for axes in rows.flat if axes.axison or axes.collections]


def _arrows(axes, panel, info, view, look):
    q, dq = space.vectors(panel.field), panel.arrows
    share = min(1.0, MOST * info.box_x * info.box_z / info.number)
    order = [k for k in view.order(q) if share == 1 or q[1, k] < share * info.box_y]
    q, dq = q[:, order], dq[:, order]
    Particles(axes, info, q, which=order, size=DOT).paint(view.pale(GREY, q))
    start = view.places(q - 0.5 * dq)
    style = {'width': 0.13, 'color': view.pale(panel.colour, q), **look}
    arrows(axes, *start, view.vectors(dq), **style)
    slab = rf', $y<{share * info.box_y:.2g}\,\sigma$' if share < 1 else ''
    axes.set_title(panel.title + slab, fontsize=8, loc='left')


def _component(axes, panel, info):
    """Draws the components of a vector; nothing if it belongs to no step."""
    if panel.block is None:
        axes.set_axis_off()
        return
    mode = Expected(panel.field, panel.block.steps, info)
    is_line = len(mode.along) == 1
    names = (_curve if is_line else _projection)(axes, mode, panel.block.kind)
    title = f'{names}, {100 * mode.weight:.0f} % in {panel.name}'
    axes.set_title(title, fontsize=8 if len(title) < LONG else 6, loc='left')
    place = 'upper right' if is_line else 'upper left'
    axes.legend(fontsize=7, loc=place, ncol=3 if is_line else 1, handletextpad=0)
    axes.set_ylim(-LIMIT, LIMIT + NAMED * is_line)
    axes.tick_params(labelsize=6, length=2)


def _curve(axes, mode, kind):
    """Draws components over the coordinate along the wave: for LP the one along the wave, for T the
    two others."""
    (along,) = mode.along
    length = space.along(mode.info, 'box_')[along]
    line = np.zeros((3, 200))
    line[along] = np.linspace(0, length, 200)
    shown = [d for d in range(3) if kind is None or (d == along) == (kind == steps.LP)]
    for d in shown:
        _dots(axes, mode.q[along], mode.dq[d], d)
        axes.plot(line[along], mode.at(line)[d], color=INK, linewidth=0.8)
    axes.axhline(0, color=GREY, linewidth=0.5)
    axes.set_xlim(0, length)
    axes.set_xlabel(rf'${AXES[along]}$  [$\sigma$]', fontsize=7)
    axes.set_ylabel(r'$\delta q$ / rms', fontsize=7)
    return 'wave along $' + AXES[along] + '$'


def _projection(axes, mode, kind):
    """Draws components over those of the projection on the fields, for waves along several
    directions."""
    for d in range(3):
        _dots(axes, mode.projection[d], mode.dq[d], d)
    axes.plot([-LIMIT, LIMIT], [-LIMIT, LIMIT], color=GREY, linewidth=0.8, zorder=3)
    axes.set_xlim(-LIMIT, LIMIT)
    axes.set_aspect('equal')
    axes.set_xlabel('in the fields / rms', fontsize=7)
    axes.set_ylabel(r'$\delta q$ / rms', fontsize=7)
    return 'each sphere'


def _dots(axes, x, y, d):
    label = rf'$\delta q_{AXES[d]}$'
    axes.plot(x, y, 'os^'[d], color=COLOURS[d], markersize=1.8, label=label)
