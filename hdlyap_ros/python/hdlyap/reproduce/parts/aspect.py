"""Part 10: slopes against the aspect ratio at density 0.4 and one wave number, periodic and between
walls."""

import itertools

from hdlyap.plots import paper, steps
from hdlyap.plots.figures.style import KIND_COLOURS, plt

from .. import averages, slopes
from ..row import Claim, Scatter

TITLE = 'Slopes c_T, c_L against the aspect ratio, density 0.4, k = 0.2'
ASPECTS = ('025', '050', '075', '100')
WAVE_NUMBER = 0.2
TELLING = 100 * paper.FIT_ACCURACY  # %: one box may be off by so much without being seen
BESIDE = 0.012  # aspect ratio: so that error bars can be seen beside each other
SYMBOLS = {'T': 'c_T', 'LP': 'c_L'}
KINDS = {'T': steps.T, 'LP': steps.LP}
# runs, kind, nodes: the T modes of walls need nodes along both directions
SERIES = (
    ('periodic', 'LP', (1, 0)),
    ('periodic', 'T', (1, 0)),
    ('walls_lp', 'LP', (1, 0)),
    ('walls_t', 'LP', (1, 1)),
    ('walls_t', 'T', (1, 1)),
)
MARKS = {
    ('periodic', (1, 0)): ('o', True),
    ('walls_lp', (1, 0)): ('s', False),
    ('walls_t', (1, 1)): ('D', False),
}


def runs(plan):
    return [
        f'aspect_{aspect}_{which}'
        for aspect in ASPECTS
        for which in ('periodic', 'walls_lp', 'walls_t')
    ]


class Series:
    """One step in boxes of several aspect ratios."""

    def __init__(self, bags, which, kind, nodes):
        self.which, self.kind, self.nodes = which, kind, nodes
        recordings = [bags[f'aspect_{aspect}_{which}'].recording for aspect in ASPECTS]
        self.aspects = [recording.info.aspect for recording in recordings]
        self.disks = [recording.info.disks for recording in recordings]
        self.points = [slopes.find(recording, KINDS[kind], *nodes) for recording in recordings]

    @property
    def boundary(self):
        return 'periodic' if self.which == 'periodic' else 'reflecting'

    @property
    def name(self):
        return (
            f'{SYMBOLS[self.kind]}, {self.boundary}, {self.kind}({self.nodes[0]},{self.nodes[1]})'
        )

    @property
    def known(self):
        """(aspect, point) where the step was found by itself, with an error."""
        found = zip(self.aspects, self.points)
        return [(aspect, point) for aspect, point in found if slopes.own([point])]

    @property
    def mixtures(self):
        """What is left out of them, as text."""
        found = zip(self.aspects, self.points)
        return [
            f'at A = {aspect:.2f} it {point.remark}'
            for aspect, point in found
            if point and point.shares
        ]

    def mean(self):
        """(weighted mean slope, chi^2 of the slopes round it)"""
        found = [(point.slope, point.slope_error) for _, point in self.known]
        mean, _, chi2 = averages.weighted(*zip(*found))
        return mean, chi2


def fitted(kind, k):
    """The paper's slope lambda / k at a wave number."""
    return paper.CURVES[kind].c + paper.CURVES[kind].c2 * k


def _series(bags):
    return [Series(bags, *which) for which in SERIES]


# ---- rows ----------------------------------------------------------------------------------------


def claims(bags):
    for boundary, series in itertools.groupby(_series(bags), lambda one: one.boundary):
        yield Claim(
            f'slopes do not depend on the aspect ratio, {boundary}',
            [_scatter_row(one) for one in series],
            'chi^2 from our errors',
        )


def _scatter_row(series):
    """The slopes themselves are in the table: outside of the range of the paper's curves."""
    quantity = f'{series.name} about their mean'
    if len(series.known) < 2:
        return Scatter(quantity, None, 0, [], TELLING)
    mean, chi2 = series.mean()
    errors = [100 * point.slope_error / mean for _, point in series.known]
    aspect, point = max(series.known, key=lambda one: abs(one[1].slope - mean))
    farthest = (
        f'mean {mean:.4f}; farthest at A = {aspect:.2f}, {100 * (point.slope / mean - 1):+.2f} %'
    )
    remark = '; '.join([farthest, *series.mixtures])
    return Scatter(quantity, chi2, len(errors) - 1, errors, TELLING, remark)


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    series = [one for one in _series(bags) if any(one.points)]
    if series:
        yield 'aspect', _figure(series)


def _figure(series):
    figure, axes = plt.subplots(figsize=(5.6, 4.2), constrained_layout=True)
    for kind in KINDS:
        published = fitted(kind, WAVE_NUMBER)
        axes.axhspan(
            (1 - paper.FIT_ACCURACY) * published,
            (1 + paper.FIT_ACCURACY) * published,
            color=KIND_COLOURS[kind],
            alpha=0.15,
            linewidth=0,
            label=f'${SYMBOLS[kind]}$, fit of Eckmann et al. at $k={WAVE_NUMBER}$, $\\pm3$ %',
        )
    for place, one in enumerate(series):
        _points(axes, one, BESIDE * (place - (len(series) - 1) / 2))
    axes.set_xlim(0.15, 1.1)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.7 * (high - low))  # room for the names
    axes.set_xlabel(r'aspect ratio $L_y/L_x$')
    axes.set_ylabel(r'$\lambda/k$  [$\sigma$/time unit]')
    axes.legend(loc='upper center', ncol=1)
    axes.set_title(f'$\\rho={paper.CURVES_DENSITY}$, $k={WAVE_NUMBER}$', fontsize=9)
    return figure


def _points(axes, series, beside):
    marker, filled = MARKS[series.which, series.nodes]
    colour = KIND_COLOURS[series.kind]
    found = [
        (aspect + beside, point.slope, max(0.0, point.slope_error))
        for aspect, point in zip(series.aspects, series.points)
        if point
    ]
    if found:
        aspects, values, errors = zip(*found)
        axes.errorbar(
            aspects,
            values,
            errors,
            fmt=marker,
            color=colour,
            markerfacecolor=colour if filled else 'white',
            markersize=4.5,
            elinewidth=0.9,
            capsize=2,
            label=series.name.replace('c_T', '$c_T$').replace('c_L', '$c_L$'),
            zorder=3,
        )


def tables(bags):
    header = (
        'boundaries',
        'step',
        'aspect',
        'disks',
        'wave_number',
        'exponent',
        'std_error',
        'slope',
        'slope_error',
    )
    yield 'aspect', header, [
        (
            one.boundary,
            f'{one.kind}({one.nodes[0]},{one.nodes[1]})',
            f'{aspect:g}',
            disks,
            *_numbers(point),
        )
        for one in _series(bags)
        for aspect, disks, point in zip(one.aspects, one.disks, one.points)
    ]


def _numbers(point):
    if point is None:
        return ('not resolved', '', '', '', '')
    return (
        f'{point.wave_number:.6g}',
        f'{point.exponent:.6g}',
        f'{point.error:.2g}',
        f'{point.slope:.6g}',
        f'{point.slope_error:.2g}',
    )
