"""Width of every Gram-Schmidt vector against its index, and magnified those of the largest
exponents, which are localised; beside covariant ones, where there are."""

import numpy as np

from hdlyap.data import space

from .style import BLUE, GREY, INK, MANY, bars, index_axis, panels, titled

LARGEST = 48  # vectors in the magnified panel


def draw(recording):
    message = recording.localization
    if message is None:
        return None
    many = len(message.widths) > 1.5 * LARGEST
    figure, grid = panels(1, 1 + many, 7.6 if many else 4.6, 3.4, squeeze=False)
    for axes, count in zip(grid[0], (None, LARGEST)):
        _panel(axes, recording, count)
    grid[0, 0].set_ylabel('localisation width $e^S/N$')
    if many:
        grid[0, 0].set_title('(a) all vectors carried', loc='left')
        grid[0, 1].set_title('(b) largest exponents', loc='left')
    if recording.covariant is not None:
        grid[0, -1].legend(loc='lower right', handletextpad=0.2)
    return titled(figure, recording.info, more=f', {message.samples} samples')


def _panel(axes, recording, count):
    message, covariant = recording.localization, recording.covariant
    _dots(axes, message, count, fmt='o', color=BLUE, label='Gram-Schmidt', zorder=3)
    if covariant is not None:
        _dots(axes, covariant, count, fmt='x', color=INK, label='covariant', zorder=2)
    least = 1.0 / recording.info.number
    axes.axhline(least, color=GREY, linewidth=0.6, linestyle='--')
    name, across = f'one {space.particle(recording.info)}', axes.get_yaxis_transform()
    look = {'ha': 'right', 'va': 'bottom', 'color': GREY, 'fontsize': 7}
    axes.text(0.99, least, name, transform=across, **look)
    axes.set_ylim(bottom=0)
    index_axis(axes)


def _dots(axes, message, count, **style):
    """Of the first `count` vectors; only widths of Gram-Schmidt vectors have errors."""
    widths = message.widths[:count]
    indices = np.arange(message.first_index, message.first_index + len(widths))
    errors = bars(message.std_errors[:count]) if hasattr(message, 'widths_now') else None
    axes.errorbar(indices, widths, errors, markersize=2.4, **MANY, **style)
