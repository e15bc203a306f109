"""Exponents of the way back beside those of the way forward, and their difference in units of its
error."""

import numpy as np

from ..covariant import Compared
from .over_index import Panels, level
from .style import INK, LIGHT, VERMILION, ZERO


def draw(run):
    message = run.covariant
    if message is None:
        return None
    compared = Compared(run)
    panels = Panels(run, 2, 5.0)
    panels.plot(
        0,
        compared.indices,
        message.local_exponents,
        color=LIGHT,
        label='backward, between two samples',
    )
    panels.plot(
        0,
        compared.indices,
        compared.forward,
        compared.forward_error,
        fmt='o',
        color=INK,
        markersize=4,
        markerfacecolor='none',
        markeredgewidth=0.6,
        label='forward (Gram-Schmidt)',
    )
    panels.plot(
        0,
        compared.indices,
        compared.backward,
        compared.backward_error,
        color=VERMILION,
        label='backward (covariant)',
    )
    _deviations(panels, compared)
    panels.grid[0, 0].legend(loc='lower left', handletextpad=0.4)
    return panels.finish(r'$\lambda_\ell$  [1/time unit]', 'backward - forward\n[combined errors]')


def _deviations(panels, compared):
    if not np.isfinite(compared.deviation).any():
        for axes in panels.grid[1]:
            axes.annotate('errors not yet known', (0.5, 0.5), xycoords='axes fraction', ha='center')
        return
    for chosen, colour, label in (
        (~compared.is_zero, INK, 'difference'),
        (compared.is_zero, ZERO, 'zero modes'),
    ):
        panels.plot(
            1, compared.indices[chosen], compared.deviation[chosen], color=colour, label=label
        )
    for axes in panels.grid[1]:
        level(axes, 0)
        for two in (-2, 2):
            level(axes, two, '_two')
