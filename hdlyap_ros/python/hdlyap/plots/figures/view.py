"""run_info -> the direction from which a figure shows the box: a plane box from above; one in space
from the front, a little from the right and from above, without perspective. Distant things are
paler."""

import itertools

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb

from hdlyap.data import space

from .style import GREY, INK, beside

RIGHT, ABOVE = np.radians([20, 18])
ALONG = np.array([-np.sin(RIGHT), np.cos(RIGHT), 0])  # the line of sight, before it is lowered
# rows: directions to the right, up and away
TURNED = np.array(
    [
        [np.cos(RIGHT), np.sin(RIGHT), 0],
        np.sin(ABOVE) * ALONG + [0, 0, np.cos(ABOVE)],
        np.cos(ABOVE) * ALONG - [0, 0, np.sin(ABOVE)],
    ]
)
FAR = 0.65  # part of white in the colour of the most distant sphere
MARGIN = 1.2  # around spheres, for the names of the edges [sigma]
# names of edges: axis, place in parts of the box, distance from it [points], alignment
NAMES = (
    ('x', (0.5, 0, 0), (0, -2), 'center', 'top'),
    ('y', (1, 0.5, 0), (2, -1), 'left', 'top'),
    ('z', (0, 0, 0.5), (-3, 0), 'right', 'center'),
)


class View:
    """Projects positions onto the page. `size`: that of the box on the page."""

    def __init__(self, info):
        self.is_solid = space.is_solid(info)
        self._turned = TURNED if self.is_solid else np.eye(2)
        self._edges = np.array(space.along(info, 'box_'))
        self._corners = np.array(list(itertools.product((0, 1), repeat=len(self._edges)))).T
        corners = self._turned @ self._at(self._corners)
        self._low, self._ends = corners.min(axis=1), np.ptp(corners, axis=1)
        self.margin = MARGIN * self.is_solid
        self.size = self._ends[:2] + 2 * self.margin

    def _at(self, shares):
        return shares * self._edges[:, np.newaxis]

    def places(self, q):
        """Positions on the page. q: rows along each direction."""
        return (self._turned @ q - self._low[:, np.newaxis])[:2] + self.margin

    def vectors(self, dq):
        return (self._turned @ dq)[:2]

    def depth(self, q):
        """The depth of positions: 0 in front .. 1 behind; 0 in the plane."""
        return (self._turned @ q - self._low[:, np.newaxis])[2:].sum(axis=0) / self._ends[-1]

    def order(self, q):
        """The order in which particles are drawn: those in front come last."""
        return np.argsort(-self.depth(q), kind='stable')

    def pale(self, colour, q):
        """The paler colour of each particle; in the plane, the colour itself."""
        if not self.is_solid:
            return colour
        white = FAR * self.depth(q)[:, np.newaxis]
        return (1 - white) * to_rgb(colour) + white

    def fit(self, axes):
        """Fits axes to the box; in space, draws it, too."""
        axes.set_aspect('equal')
        axes.set_xlim(0, self.size[0])
        axes.set_ylim(0, self.size[1])
        if self.is_solid:
            axes.set_axis_off()
            self._draw_edges(axes)

    def _draw_edges(self, axes):
        """Draws the edges of the box, those behind dotted, and the names of three."""
        hidden = self._corners[:, np.argmax(self.depth(self._at(self._corners)))]
        for d, start in itertools.product(range(3), self._corners.T):
            if start[d]:
                continue
            ends = np.array([start, start + np.eye(3)[d]]).T
            behind = all(start[c] == hidden[c] for c in range(3) if c != d)
            look = (
                {'linestyles': ':', 'zorder': 0.5} if behind else {'linestyles': '-', 'zorder': 4}
            )
            line = [self.places(self._at(ends)).T]
            axes.add_collection(LineCollection(line, colors=GREY, linewidths=0.6, **look))
        for axis, place, aside, across, up in NAMES:
            (where,) = self.places(self._at(np.array([place]).T)).T
            look = {'ha': across, 'va': up, 'fontsize': 7, 'color': INK}
            beside(axes, f'${axis}$', where, aside, **look)
