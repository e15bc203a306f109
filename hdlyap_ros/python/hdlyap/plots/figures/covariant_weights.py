"""Weights of the lowest waves' fields in vectors near the zero modes, for Gram-Schmidt and
covariant vectors."""

from hdlyap.data import steps

from .. import covariant
from . import page
from .over_index import level, near_zero, shade
from .style import GREY, INK, kind_colour

PANELS = 4


@page.figure
def draw(page, run, **look):
    message = run.covariant
    if message is None or not message.weights:
        return
    shown = message.weights[:PANELS]
    indices = covariant.indices(message)
    first, last = near_zero(run, indices)
    columns = min(2, len(shown))
    rows = -(-len(shown) // columns)
    alike = {'sharex': True, 'sharey': True, 'squeeze': False}
    grid = page.panels(rows, columns, 3.8 * columns, 2.6 * rows + 0.6, **alike)
    for axes, weight in zip(grid.flat, shown):
        _panel(axes, run, weight, indices, look)
        shade([axes], run, first, last)
        axes.set_xlim(first - 0.8, last + 0.8)
        axes.set_xlabel(r'index $\ell$')
        axes.set_ylabel('weight')
    for axes in list(grid.flat)[len(shown) :]:
        axes.set_axis_off()
    page.outer(grid)
    # weights are small far from the step, so there is room
    grid[0, 0].legend(loc='upper left', bbox_to_anchor=(0, 0.92), fontsize=6.5, handletextpad=0.2)
    page.title(run.info, more=f', covariant vectors of {message.samples} samples')


def _panel(axes, run, weight, indices, look):
    solid, cross, hollow = ({'color': c} for c in (kind_colour(weight.kind), GREY, INK))
    solid.update(marker='o', markersize=3)
    cross.update(marker='x', markersize=3.5, markeredgewidth=0.8)
    hollow.update(marker='o', markersize=5, markeredgewidth=0.7, markerfacecolor='none')
    for values, style, label in (
        (weight.dq, solid, r'covariant, $\delta q$'),
        (weight.dp, cross, r'covariant, $\delta p$'),
        (weight.gram_schmidt, hollow, r'Gram-Schmidt, $\delta q$'),
    ):
        axes.plot(indices, values, **{'linestyle': '', **style, **look, 'label': label})
    level(axes, covariant.chance(run, weight), 'by chance')
    axes.set_ylim(-0.03, 1.03)
    name, look = steps.name(weight, run.info), {'weight': 'bold', 'fontsize': 8}
    axes.annotate(name, (0.03, 0.95), xycoords='axes fraction', va='top', **look)
