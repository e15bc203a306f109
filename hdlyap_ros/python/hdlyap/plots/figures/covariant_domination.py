"""Which finite-time exponents keep their order: those of neighbours, and all before an index
against all after it."""

import numpy as np

from .. import covariant
from . import page
from .over_index import Panels
from .style import BLUE, GREEN, INK


@page.figure
def draw(page, run, **look):
    message = run.covariant
    if message is None or len(message.exponents) < 2:
        return
    places = covariant.between(message)
    is_splitting = covariant.is_splitting(run, covariant.indices(message)[:-1])
    violated = np.where(is_splitting, message.domination_violations, np.nan)
    panels = Panels(page, run, 2, 4.8, look)
    panels.plot(0, places, message.violations, color=BLUE, label='next vector grew more')
    panels.plot(1, places, violated, color=INK, label='of all times')
    isolated = violated == 0
    style = {'fmt': 'v', 'color': GREEN, 'markersize': 4.5}
    label = f'never ({isolated.sum()} dominated splittings)'
    panels.plot(1, places[isolated], violated[isolated], label=label, **style)
    for axes, highest in zip(panels.grid, (1.04, 1.3)):
        for panel in axes:
            panel.set_ylim(-0.04, highest)
            panel.set_yticks(np.linspace(0, 1, 6))
    panels.grid[1, 0].legend(
        loc='upper left', ncol=2, handletextpad=0.2, columnspacing=1, fontsize=7
    )
    panels.finish(
        'the next vector grew more\n[fraction of times]',
        'later vector grew more\nthan earlier one  [fraction]',
    )
