"""The box with its disks or spheres, and a vector at each of them."""

from matplotlib.collections import EllipseCollection
from matplotlib.patches import Polygon

from hdlyap.data.containers import is_curved

from .view import View

WALL = dict(fill=False, edgecolor='black', linewidth=0.8)


def disks(axes, info, *q, size=1.0, **style):
    """One outline, repeated: much less of a file than one for each disk. q: x, y and of spheres
    z."""
    view = View(info)
    view.fit(axes)
    enclose(axes, info)
    # matplotlib 3.6 has given it another name
    new = hasattr(EllipseCollection, 'set_offset_transform')
    place = {
        'offset_transform' if new else 'transOffset': axes.transData,
        'offsets': view.places(q).T,
    }
    found = EllipseCollection([size], [size], [0.0], units='xy', **place, **style)
    axes.add_collection(found)
    return found


def enclose(axes, info):
    """A curved wall takes the place of the frame."""
    if not is_curved(info):
        return
    corners = list(zip(info.outline_x, info.outline_y))
    axes.add_patch(Polygon(corners, clip_on=False, **WALL))
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.tick_params(top=False, right=False)


def arrows(axes, x, y, dq, **style):
    """As long as they are in the box; width: in sigma."""
    form = dict(angles='xy', scale_units='xy', scale=1, units='xy', minlength=0, zorder=3)
    heads = dict(headwidth=3.5, headlength=4, headaxislength=3.5)
    return axes.quiver(x, y, *dq, **form, **heads, **style)
