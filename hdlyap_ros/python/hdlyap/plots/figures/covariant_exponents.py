"""Exponents of the backward and the forward pass, and their difference in units of its error."""

import numpy as np

from ..covariant import Compared
from . import page
from .over_index import Panels, level
from .style import INK, LIGHT, VERMILION, ZERO, instead

HOLLOW = {'fmt': 'o', 'markersize': 4, 'markerfacecolor': 'none', 'markeredgewidth': 0.6}


@page.figure
def draw(page, run, **look):
    message = run.covariant
    if message is None:
        return
    compared = Compared(run)
    panels = Panels(page, run, 2, 5.0, look)
    for label, style, *values in (
        ('backward, between two samples', {'color': LIGHT}, message.local_exponents),
        (
            'forward (Gram-Schmidt)',
            {'color': INK, **HOLLOW},
            *(compared.forward, compared.forward_error),
        ),
        (
            'backward (covariant)',
            {'color': VERMILION},
            *(compared.backward, compared.backward_error),
        ),
    ):
        panels.plot(0, compared.indices, *values, label=label, **style)
    _deviations(panels, compared)
    panels.grid[0, 0].legend(loc='lower left', handletextpad=0.4)
    panels.finish(r'$\lambda_\ell$  [1/time unit]', 'backward - forward\n[combined errors]')


def _deviations(panels, compared):
    if not np.isfinite(compared.deviation).any():
        for axes in panels.grid[1]:
            instead(axes, 'errors not yet known')
        return
    for of_zero, colour, label in ((False, INK, 'difference'), (True, ZERO, 'zero modes')):
        chosen = compared.is_zero == of_zero
        places, values = compared.indices[chosen], compared.deviation[chosen]
        panels.plot(1, places, values, color=colour, label=label)
    for axes in panels.grid[1]:
        level(axes, 0)
        for two in (-2, 2):
            level(axes, two, '_two')
