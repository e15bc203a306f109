"""Wall time by part: its course, and its shares of the whole run."""

import numpy as np

from hdlyap.data.stages import LABELS, PARTS, STAGES
from hdlyap.msg import RunStatus

from .style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION, plt, thinned, titled

PART_COLOURS = {
    'events': BLUE,
    'replay': SKY,
    'ortho': ORANGE,
    'spectrum': GREEN,
    'modes': VERMILION,
    'covariant': INK,
    'publish': PURPLE,
    'other': '#8C8C8C',
    'start': '#D9D9D9',
}
NAMES = {**LABELS, 'start': 'start, wait for recorder'}

NAMED = 0.04  # part of the run from which a stage has room for its name


def draw(recording):
    cost = recording.cost()
    if cost is None:
        return None
    figure, (course, share) = plt.subplots(
        1, 2, figsize=(7.2, 3.2), constrained_layout=True, gridspec_kw={'width_ratios': [1.5, 1]}
    )
    other = np.maximum(0, cost['wall'] - sum(cost[part] for part in PARTS))
    cost['start'] = np.minimum(other, other[0])  # all that came before the first report
    cost['other'] = other - cost['start']
    _course(course, cost, recording.began)
    _shares(share, cost)
    return titled(figure, recording.info)


def _course(axes, cost, began):
    kept = thinned(len(cost['time']))
    axes.stackplot(
        cost['time'][kept],
        *(cost[part][kept] for part in NAMES),
        colors=list(PART_COLOURS.values()),
        linewidth=0,
    )
    stages = sorted((time, stage) for stage, time in began.items() if stage != RunStatus.FINISHED)
    ends = [time for time, _ in stages[1:]] + [cost['time'][-1]]
    for (time, stage), end in zip(stages, ends):
        axes.axvline(time, color=INK, linewidth=0.6, linestyle=':')
        if end - time > NAMED * cost['time'][-1]:
            axes.annotate(
                STAGES[stage],
                (time, 1),
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
    seconds = np.array([cost[part][-1] for part in NAMES])
    rows = np.arange(len(seconds))
    axes.barh(rows, seconds, color=list(PART_COLOURS.values()))
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
    axes.set_yticklabels(NAMES.values())
    axes.tick_params(axis='y', length=0)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.9 * max(seconds))
    axes.set_xlabel('wall time  [s]')
    axes.set_title('(b) whole run', loc='left')
