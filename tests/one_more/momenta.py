"""Fourth powers of momenta over the particles, and of the vectors."""

import numpy as np

from . import page
from .style import BLUE

ORDER = 99


@page.figure
def draw(page, recording, **look):
    message = recording.momenta
    if message is None:
        return
    grid = page.panels(1, 2, 7.6, 3.4, squeeze=False)
    for axes, values in zip(grid[0], (message.momenta, message.powers)):
        axes.plot(np.arange(1, len(values) + 1), values, **{'color': BLUE, **look})
    grid[0, 0].set(xlabel='particle', ylabel='mean of $|p|^4$')
    grid[0, 1].set(xlabel='Lyapunov index', ylabel='mean of $\\Sigma(\\delta q^2 + \\delta p^2)^2$')
    page.title(recording.info, *grid[0])
