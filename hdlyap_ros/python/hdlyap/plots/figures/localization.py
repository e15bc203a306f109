"""Width of every Gram-Schmidt vector against its index, with a magnified panel of the largest
exponents, which are localised; and of covariant vectors if there are any."""

import numpy as np

from hdlyap.data import space

from . import page
from .style import BLUE, GREY, INK, MANY, bars, index_axis

ORDER = 8

LARGEST = 48  # vectors in the magnified panel


@page.figure
def draw(page, recording, **look):
    message = recording.localization
    if message is None:
        return
    many = len(message.widths) > 1.5 * LARGEST
    grid = page.panels(1, 1 + many, 7.6 if many else 4.6, 3.4, squeeze=False)
    for axes, count in zip(grid[0], (None, LARGEST)):
        _panel(axes, recording, count, look)
        axes.set_ylabel('localisation width $e^S/N$')
    page.outer(grid)
    if many:
        grid[0, 0].set_title('all vectors carried', loc='left')
        grid[0, 1].set_title('largest exponents', loc='left')
    if recording.covariant is not None:
        above = {'loc': 'lower right', 'bbox_to_anchor': (1, 1), 'borderpad': 0}
        grid[0, -1].legend(ncol=2, handletextpad=0.2, **above)
    page.title(recording.info, *grid[0, : 2 * many], more=f', {message.samples} samples')


def _panel(axes, recording, count, look):
    message, covariant = recording.localization, recording.covariant
    style = {'fmt': 'o', 'color': BLUE, 'label': 'Gram-Schmidt', 'zorder': 3, **look}
    _dots(axes, message, count, style)
    if covariant is not None:
        style = {'fmt': 'x', 'color': INK, 'zorder': 2, **look, 'label': 'covariant'}
        _dots(axes, covariant, count, style)
    least = 1.0 / recording.info.number
    axes.axhline(least, color=GREY, linewidth=0.6, linestyle='--')
    name, across = f'one {space.particle(recording.info)}', axes.get_yaxis_transform()
    look = {'ha': 'center', 'va': 'bottom', 'color': GREY, 'fontsize': 7}
    axes.text(0.35, least, name, transform=across, **look)  # between small widths and the legend
    axes.set_ylim(bottom=0)
    index_axis(axes)


def _dots(axes, message, count, style):
    """Draws the first `count` vectors. Only widths of Gram-Schmidt vectors have errors."""
    widths = message.widths[:count]
    indices = np.arange(message.first_index, message.first_index + len(widths))
    errors = bars(message.std_errors[:count]) if hasattr(message, 'widths_now') else None
    axes.errorbar(indices, widths, errors, **{'markersize': 2.4, **MANY, **style})
