"""Draws the box with its particles, and a vector at each of them."""

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.patches import Polygon

from hdlyap.data import space
from hdlyap.data.containers import is_curved

from .style import GREY, INK
from .view import View

WALL = dict(fill=False, edgecolor='black', linewidth=0.8)
RIM = 1.2  # width of the line around dumbbells, half of which is visible [points]


class Particles:
    """Disks, spheres or dumbbells; the latter with both disks, one rim around them, and the bond.
    `disks`: {diameter: a collection, which repeats one outline and makes files much smaller}."""

    def __init__(self, axes, info, q, angle=(), which=slice(None), size=1.0, **style):
        """q: rows along x, y and, in space, z; angle: angles of particles that rotate; which: the
        numbers of these particles; size: of one of diameter 1."""
        self._info, self._view = info, View(info)
        self._view.fit(axes)
        enclose(axes, info)
        self._ends = len(space.disks(info, q, angle))
        self._diameters, self._bonds = space.diameters(info), None
        self._rims, sizes = {}, np.unique(self._diameters)
        if self._ends > 1:
            style.update(edgecolors='none')
            rim = {'edgecolors': GREY, 'facecolors': 'none', 'linewidths': RIM}
            self._rims = {one: _outlines(axes, size * one, **rim) for one in sizes}
            self._bonds = LineCollection([], colors=INK, linewidths=0.7)
            axes.add_collection(self._bonds)
        self.disks = {one: _outlines(axes, size * one, **style) for one in sizes}
        self.move(q, angle, which)

    def move(self, q, angle=(), which=slice(None)):
        ends = [self._view.places(end).T for end in space.disks(self._info, q, angle)]
        self._moved = self._diameters[which]
        for size, circles in [*self._rims.items(), *self.disks.items()]:
            circles.set_offsets(np.concatenate([end[self._moved == size] for end in ends]))
        if self._bonds is not None:
            self._bonds.set_segments(np.stack(ends, axis=1))

    def paint(self, colours):
        """Sets colours, a row for each particle that was moved last."""
        for size, circles in self.disks.items():
            circles.set_facecolors(np.tile(colours[self._moved == size], (self._ends, 1)))


def _outlines(axes, size, **style):
    # matplotlib 3.6 has renamed the argument
    new = hasattr(EllipseCollection, 'set_offset_transform')
    place = {
        'offset_transform' if new else 'transOffset': axes.transData,
        'offsets': np.zeros((1, 2)),
    }
    found = EllipseCollection([size], [size], [0.0], units='xy', **place, **style)
    axes.add_collection(found)
    return found


def enclose(axes, info):
    """Draws a curved wall in place of the frame."""
    if not is_curved(info):
        return
    corners = list(zip(info.outline_x, info.outline_y))
    axes.add_patch(Polygon(corners, clip_on=False, **WALL))
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.tick_params(top=False, right=False)


def arrows(axes, x, y, dq, **style):
    """Draws arrows with their lengths in the box; width: in sigma."""
    form = dict(angles='xy', scale_units='xy', scale=1, units='xy', minlength=0, zorder=3)
    heads = dict(headwidth=3.5, headlength=4, headaxislength=3.5)
    return axes.quiver(x, y, *dq, **form, **heads, **style)
