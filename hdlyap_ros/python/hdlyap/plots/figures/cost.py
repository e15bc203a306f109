"""Wall time by stage: its course, and its shares of the whole run."""

import numpy as np

from ..stages import LABELS, STAGES
from .style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION, plt, thinned

STAGE_COLOURS = {
    'events': BLUE,
    'replay': SKY,
    'ortho': ORANGE,
    'spectrum': GREEN,
    'modes': VERMILION,
    'covariant': INK,
    'publish': PURPLE,
    'other': '#BFBFBF',
}
PHASES = ('equilibration', 'warm-up', 'averaging')


def draw(recording):
    cost = recording.cost()
    if cost is None:
        return None
    figure, (course, share) = plt.subplots(
        1, 2, figsize=(7.2, 3.2), constrained_layout=True, gridspec_kw={'width_ratios': [1.5, 1]}
    )
    cost['other'] = np.maximum(0, cost['wall'] - sum(cost[stage] for stage in STAGES))
    _course(course, cost)
    _shares(share, cost)
    return figure


def _course(axes, cost):
    kept = thinned(len(cost['time']))
    axes.stackplot(
        cost['time'][kept],
        *(cost[stage][kept] for stage in LABELS),
        colors=list(STAGE_COLOURS.values()),
        linewidth=0,
    )
    for phase, name in enumerate(PHASES):
        during = cost['time'][cost['phase'] == phase]
        if during.size:
            axes.axvline(during[0], color=INK, linewidth=0.6, linestyle=':')
            axes.annotate(
                name,
                (during[0], 1),
                xycoords=('data', 'axes fraction'),
                xytext=(6, -3),
                textcoords='offset points',
                rotation=90,
                fontsize=7,
                va='top',
            )
    axes.margins(0)
    axes.set_xlim(left=0)
    axes.set_xlabel('simulated time  [time units]')
    axes.set_ylabel('wall time since the start  [s]')
    axes.set_title('(a)', loc='left')


def _shares(axes, cost):
    seconds = np.array([cost[stage][-1] for stage in LABELS])
    rows = np.arange(len(seconds))
    axes.barh(rows, seconds, color=list(STAGE_COLOURS.values()))
    for row, value in zip(rows, seconds):
        axes.annotate(
            f'{value:.3g} s ({100 * value / cost["wall"][-1]:.1f} %)',
            (value, row),
            xytext=(3, 0),
            textcoords='offset points',
            va='center',
            fontsize=8,
        )
    axes.set_yticks(rows)
    axes.set_yticklabels(LABELS.values())
    axes.tick_params(axis='y', length=0)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.9 * max(seconds))
    axes.set_xlabel('wall time  [s]')
    axes.set_title('(b) whole run', loc='left')
