"""Wall time by part: over simulated time, and as shares of the whole run."""

import numpy as np

from hdlyap.data.stages import LABELS, PARTS, STAGES
from hdlyap.msg import RunStatus

from . import page
from .style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, VERMILION, beside, thinned

ORDER = 12

PART_COLOURS = {
    'events': BLUE,
    'replay': SKY,
    'ortho': ORANGE,
    'spectrum': GREEN,
    'modes': VERMILION,
    'covariant': INK,
    'publish': PURPLE,
    'waiting': '#F0E442',
    'other': '#8C8C8C',
    'start': '#D9D9D9',
}
NAMES = {**LABELS, 'start': 'start, wait for recorder'}

NAMED = 0.04  # a stage that takes at least this part of the run has room for its name


@page.figure
def draw(page, recording, **look):
    cost = recording.cost()
    if cost is None:
        return
    widths = {'width_ratios': [1.5, 1]}
    course, share = page.panels(1, 2, 7.2, 3.2, gridspec_kw=widths)
    other = np.maximum(0, cost['wall'] - sum(cost[part] for part in PARTS))
    cost['start'] = np.minimum(other, other[0])  # all that was before the first report
    cost['other'] = other - cost['start']
    _course(course, cost, recording.began, look)
    _shares(share, cost, look)
    page.title(recording.info, course, share)


def _course(axes, cost, began, look):
    kept = thinned(len(cost['time']))
    style = {'colors': list(PART_COLOURS.values()), 'linewidth': 0, **look}
    style['labels'] = [style.pop('label', None)]  # of the first part, as each artist is one
    if 'color' in style:
        style['colors'] = [style.pop('color')]
    axes.stackplot(cost['time'][kept], *(cost[part][kept] for part in NAMES), **style)
    stages = sorted((time, stage) for stage, time in began.items() if stage != RunStatus.FINISHED)
    ends = [time for time, _ in stages[1:]] + [cost['time'][-1]]
    for (time, stage), end in zip(stages, ends):
        axes.axvline(time, color=INK, linewidth=0.6, linestyle=':')
        if end - time > NAMED * cost['time'][-1]:
            place = {'xycoords': ('data', 'axes fraction'), 'rotation': 90, 'va': 'top'}
            beside(axes, STAGES[stage], (time, 1), (6, -3), fontsize=7, **place)
    axes.margins(0)
    axes.set_xlim(left=0)
    axes.set_xlabel('simulated time  [time units]')
    axes.set_ylabel('wall time since the start  [s]')


def _shares(axes, cost, look):
    shown = [part for part in NAMES if cost[part][-1] > 0]
    seconds = np.array([cost[part][-1] for part in shown])
    rows = np.arange(len(seconds))
    axes.barh(rows, seconds, **{'color': [PART_COLOURS[part] for part in shown], **look})
    for row, value in zip(rows, seconds):
        text = f'{value:.3g} s ({100 * value / cost["wall"][-1]:.1f} %)'
        beside(axes, text, (value, row), (3, 0), va='center', fontsize=8)
    axes.set_yticks(rows)
    axes.set_yticklabels([NAMES[part] for part in shown])
    axes.tick_params(axis='y', length=0)
    axes.invert_yaxis()
    axes.set_xlim(0, 1.9 * max(seconds))
    axes.set_xlabel('wall time  [s]')
    axes.set_title('whole run', loc='left')
