"""Part 10: slopes against the aspect ratio at density 0.4 and one wave number, periodic and between
walls."""

from hdlyap.data import steps
from hdlyap.plots import paper
from hdlyap.plots.figures.style import KIND_COLOURS, plt

from .. import averages, draw, slopes
from ..row import Scatter

ASPECTS = ('025', '050', '075', '100')
WAVE_NUMBER = 0.2
BESIDE = 0.012  # aspect ratio: so that error bars can be seen beside each other
SYMBOLS = {'T': 'c_T', 'LP': 'c_L'}
KINDS = {'T': steps.T, 'LP': steps.LP}
# runs, kind, nodes: the T modes of walls need nodes along both directions; marker, filled
SERIES = {
    ('periodic', 'LP', (1, 0)): ('o', True),
    ('periodic', 'T', (1, 0)): ('o', True),
    ('walls_lp', 'LP', (1, 0)): ('s', False),
    ('walls_t', 'LP', (1, 1)): ('D', False),
    ('walls_t', 'T', (1, 1)): ('D', False),
}


def runs():
    which = dict.fromkeys(which for which, _, _ in SERIES)
    return [f'aspect_{aspect}_{one}' for aspect in ASPECTS for one in which]


class Series:
    """One step in boxes of several aspect ratios."""

    def __init__(self, bags, which, kind, nodes):
        self.which, self.kind, self.nodes = which, kind, nodes
        recordings = [bags[f'aspect_{aspect}_{which}'].recording for aspect in ASPECTS]
        self.infos = [recording.info for recording in recordings]
        self.aspects = [info.aspect for info in self.infos]
        self.points = [slopes.find(recording, KINDS[kind], *nodes) for recording in recordings]
        self.boundary = 'periodic' if which == 'periodic' else 'reflecting'
        self.step = f'{kind}({nodes[0]},{nodes[1]})'
        self.name = f'{SYMBOLS[kind]}, {self.boundary}, {self.step}'

    @property
    def known(self):
        """(aspect, point) where the step was found by itself, with an error."""
        return [one for one in zip(self.aspects, self.points) if slopes.own([one[1]])]

    @property
    def mixtures(self):
        """What is left out of them, as text."""
        found = zip(self.aspects, self.points)
        return [f'at A = {at:.2f} it {one.remark}' for at, one in found if one and one.shares]

    def mean(self):
        """(weighted mean slope, chi^2 of the slopes round it)"""
        found = [(point.slope, point.slope_error) for _, point in self.known]
        mean, _, chi2 = averages.weighted(*zip(*found))
        return mean, chi2


def _series(bags, boundary=None):
    found = [Series(bags, *which) for which in SERIES]
    return [one for one in found if boundary in (None, one.boundary)]


def constant(bags, boundary):
    """The slopes themselves are in the table: outside of the range of the paper's curves."""
    for series in _series(bags, boundary):
        quantity = f'{series.name} about their mean'
        if len(series.known) < 2:
            yield Scatter(quantity)
            continue
        mean, chi2 = series.mean()
        errors = [100 * point.slope_error / mean for _, point in series.known]
        aspect, point = max(series.known, key=lambda one: abs(one[1].slope - mean))
        off = f'{100 * (point.slope / mean - 1):+.2f} %'
        farthest = f'mean {mean:.4f}; farthest at A = {aspect:.2f}, {off}'
        remark = '; '.join([farthest, *series.mixtures])
        yield Scatter(quantity, chi2, len(errors) - 1, errors, remark)


def figures(bags):
    series = [one for one in _series(bags) if any(one.points)]
    if series:
        yield 'aspect', _figure(series)


def _figure(series):
    figure, axes = plt.subplots(figsize=(5.6, 4.2), constrained_layout=True)
    for kind in KINDS:
        curve, off = paper.CURVES[kind], paper.FIT_ACCURACY
        fitted = curve.c + curve.c2 * WAVE_NUMBER
        label = f'${SYMBOLS[kind]}$, fit of Eckmann et al. at $k={WAVE_NUMBER}$, $\\pm3$ %'
        style = {'color': KIND_COLOURS[kind], 'alpha': 0.15, 'linewidth': 0, 'label': label}
        axes.axhspan((1 - off) * fitted, (1 + off) * fitted, **style)
    for place, one in enumerate(series):
        beside = BESIDE * (place - (len(series) - 1) / 2)
        marker, is_filled = SERIES[one.which, one.kind, one.nodes]
        colour, found = KIND_COLOURS[one.kind], zip(one.aspects, one.points)
        points = [(at + beside, point.slope, point.slope_error) for at, point in found if point]
        label = one.name.replace('c_T', '$c_T$').replace('c_L', '$c_L$')
        face = colour if is_filled else 'white'
        draw.bars(axes, points, marker, colour, label, markersize=4.5, markerfacecolor=face)
    low, high = axes.get_ylim()
    axes.set(xlim=(0.15, 1.1), ylim=(low, high + 0.7 * (high - low)))  # room for the names
    axes.set(xlabel=r'aspect ratio $L_y/L_x$', ylabel=r'$\lambda/k$  ' + draw.SIGMA_UNIT)
    axes.legend(loc='upper center', ncol=1)
    axes.set_title(f'$\\rho={paper.CURVES_DENSITY}$, $k={WAVE_NUMBER}$', fontsize=9)
    return figure


def tables(bags):
    missing = 'not resolved', *4 * ('',)
    yield 'aspect', ('boundaries', 'step', 'aspect', 'disks', *slopes.COLUMNS), [
        (
            one.boundary,
            one.step,
            f'{info.aspect:g}',
            info.disks,
            *(point.cells if point else missing),
        )
        for one in _series(bags)
        for info, point in zip(one.infos, one.points)
    ]
