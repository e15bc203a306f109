"""Every covariant vector: its localisation, the angle between its halves, the angle to the next
one, and how well it is known."""

import numpy as np

from .. import covariant
from . import page
from .over_index import Panels
from .style import BLUE, INK, SKY, VERMILION

ROUNDING = 1e-16  # least value that is drawn; smaller ones are rounding


@page.figure
def draw(page, run, **look):
    message = run.covariant
    if message is None:
        return
    indices, places = covariant.indices(message), covariant.between(message)
    panels = Panels(page, run, 4, 7.4, look)
    panels.plot(0, indices, message.widths, color=INK, label='width')
    panels.plot(1, indices, message.cos_theta, color=BLUE, label='cosine')
    panels.plot(2, places, message.neighbour_angles, color=VERMILION, label='mean')
    panels.plot(2, places, message.least_neighbour_angles, color=SKY, label='smallest so far')
    apart = np.array(message.start_mismatch, dtype=float)
    apart = np.where(apart > 0, np.maximum(apart, ROUNDING), np.nan)
    panels.plot(3, indices, apart, color=INK, label='apart')
    for row, high in zip(panels.grid, (1.04, 1.04, 1.3 * covariant.RIGHT_ANGLE)):
        for axes in row:  # the last row has room for the legend
            axes.set_ylim(0, high)
    if (apart > 0).any():
        for axes in panels.grid[3]:
            axes.set_yscale('log')
    panels.grid[2, 0].legend(loc='upper left', ncol=2, handletextpad=0.2, fontsize=7)
    panels.finish(
        'localisation width\n$e^S/N$',
        r'$|\cos\Theta|$ of $\delta q$, $\delta p$',
        'angle to the next\n[rad]',
        'angle between two\nstarts  [sine]',
    )
