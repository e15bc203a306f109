"""Steps of several boxes, periodic and between walls: one curve through the smallest of each, and
slopes at one wave number."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import ticker

from hdlyap.plots import paper
from hdlyap.plots.figures.style import KIND_COLOURS

from .. import averages, draw, points, row
from ..averages import UNKNOWN
from ..points import SYMBOLS
from ..row import Row, Scatter

PERIODIC, WALLS = BOUNDARIES = 'periodic', 'reflecting'
LAMBDAS = {'T': 'lambda_T', 'LP': 'lambda_L'}
MARKERS = {'T': 'o', 'LP': 's'}
UNIT, UNIT_C, UNIT_C2 = '1/time unit', 'sigma/time unit', 'sigma^2/time unit'
WAVE_NUMBER = 0.2
BESIDE = 0.012  # aspect ratio: so that error bars can be seen beside each other


class Branch:
    """The smallest steps of one kind, None where a box has none, and the fits through those of each
    boundary and of both."""

    def __init__(self, bags, kind):
        self.kind, self.symbol = kind, LAMBDAS[kind]
        both = [[points.smallest(bag.recording, kind) for bag in some] for some in bags]
        self.points = dict(zip(BOUNDARIES, both), both=sum(both, []))
        self.curves = {which: points.curve(found) for which, found in self.points.items()}
        self.walls = self.points[WALLS]
        if kind == 'LP':  # LP(1,0) hardly has wave numbers in common with periodic boxes
            self.walls = self.walls + [points.find(bag.recording, kind, 1, 1) for bag in bags[1]]

    def found(self, which):
        return [point for point in self.points[which] if point is not None]

    def noted(self, which):
        """What a fit goes through."""
        used, found = len(points.own(self.points[which])), self.found(which)
        left = f'{len(found) - used} left out' if len(found) > used else ''
        return ', '.join(filter(None, (f'{used} boxes', left, points.noted(found))))


def ends(bags, kind):
    """Where the fit is held by points."""
    branch, published = Branch(bags, kind), paper.CURVES[kind]
    curve, span = branch.curves['both'], points.span(branch.points['both'])
    for number, end in enumerate(('smallest', 'largest')):
        row = Row(f'{branch.symbol} at {end} k', published.c, unit=UNIT)
        if curve is not None:
            k = span[number]
            row.published = published.c * k + published.c2 * k * k
            row.measured, row.error = curve.at(k)
            row.remark = f'k = {k:.4f}, {branch.noted("both")}'
            row.count = (1 - number) * len(points.own(branch.points['both']))
        yield row


def curvature(bags):
    """c2 of L less that of T."""
    curves = [Branch(bags, kind).curves['both'] for kind in ('LP', 'T')]
    known = [(one.c2, one.c2_error) for one in curves if one is not None]
    value = averages.difference(*known) if len(known) == 2 else UNKNOWN
    yield Row('c2 of lambda_L less c2 of lambda_T', None, *value, UNIT_C2)


def coefficients(bags):
    """With lambda at both ends they say one thing."""
    for kind, published in paper.CURVES.items():
        branch = Branch(bags, kind)
        curve = branch.curves['both']
        correlated = f'; correlated with c2: {curve.correlation:.2f}' if curve else ''
        for name, unit, more in (('c', UNIT_C, correlated), ('c2', UNIT_C2, '')):
            value = [getattr(curve, one) for one in (name, name + '_error')] if curve else UNKNOWN
            remark = f'the paper: {getattr(published, name)}{more}'
            yield Row(f'{name} of {branch.symbol}', None, *value, unit, remark)


def one_curve(bags):
    for kind in LAMBDAS:
        branch = Branch(bags, kind)
        for boundary in BOUNDARIES:
            quantity = f'{branch.symbol}, {boundary}, about its curve'
            curve, found = branch.curves[boundary], points.own(branch.points[boundary])
            if curve is None or not curve.freedom:
                yield Scatter(quantity)
                continue
            errors = [100 * point.error / point.exponent for point in found]
            yield Scatter(quantity, curve.chi2, curve.freedom, errors, branch.noted(boundary))


def alike(bags, kind):
    branch = Branch(bags, kind)
    row = _alike(branch.symbol, branch.points[PERIODIC], branch.walls)
    row.remark += '; between walls with LP(1,1)' if row.remark and kind == 'LP' else ''
    yield row


def alike_of_all(bags, density):
    """Of all steps that have vectors of their own."""
    for kind, symbol in LAMBDAS.items():
        both = [points.every(bag.recording, kind) for bag in bags]
        yield _alike(symbol, *both, f', density {density}')


def _alike(symbol, periodic, walls, where=''):
    row = Row(f'{symbol}: reflecting over periodic at equal k, less 1{where}', 0.0, unit='%')
    curves = [points.curve(found) for found in (periodic, walls)]
    spans = [points.span(found) for found in (periodic, walls)]
    (low, high), found = points.common(spans), points.above(curves, spans)
    if found:
        row.measured, row.error, *ends = found
        row.remark = 'mean of the fits from k = {:.4f} to {:.4f}'.format(*ends)
    elif curves[0] is not None and curves[1] is None and low == high:
        row.measured, row.error = _beside(curves[0], points.own(walls))
        row.remark = f'of the fit at k = {low:.4f}'
    return row


def _beside(curve, found):
    """(percent by which steps of one wave number are above a curve, its error)"""
    exponent, error, _ = averages.weighted(*zip(*[(one.exponent, one.error) for one in found]))
    quotient = averages.quotient((exponent, error), curve.at(found[0].k))
    return 100 * (quotient[0] - 1), 100 * quotient[1]


def curves(bags):
    """Picture of the smallest steps."""
    branches = [Branch(bags, kind) for kind in LAMBDAS]
    found = [point for branch in branches for point in branch.found('both')]
    if not found:
        return None
    figure, (left, right) = draw.panels(1, 2, (7.6, 3.8))
    end = 1.06 * max(point.k for point in found)
    for branch in branches:
        _lines(left, branch, np.linspace(0, end, 100), power=0)
        _lines(right, branch, np.linspace(0, end, 100)[1:], power=1)
    for axes in (left, right):
        axes.xaxis.set_major_locator(ticker.MaxNLocator(5))
        axes.set(xlim=(0, end), xlabel=r'wave number $k$  [1/$\sigma$]')
    left.set_ylim(bottom=0)
    left.set_ylabel(r'$\lambda$  [1/time unit]')
    right.set_ylabel(r'$\lambda/k$  ' + draw.SIGMA_UNIT)
    left.legend(loc='upper left')
    scene = f'$\\rho={paper.CURVES_DENSITY}$, $N=400$ to $780$, $L_y/L_x=0.5$ to $1$'
    figure.suptitle(f'smallest steps, {scene}', fontsize=9)
    return figure


def _lines(axes, branch, k, power):
    """Points, our fit through all, and the paper's with what it leaves open; over k^power."""
    kind, colour, published = branch.kind, KIND_COLOURS[branch.kind], paper.CURVES[branch.kind]
    there = (published.c * k + published.c2 * k**2) / k**power
    label = f'{kind}, fit of Eckmann et al.'
    axes.plot(k, there, color=colour, linewidth=0.8, dashes=(2, 2), label=label)
    if power:
        draw.band(axes, k, there, paper.FIT_ACCURACY, colour, alpha=0.12)
    curve = branch.curves['both']
    if curve is not None:
        ours = (curve.c * k + curve.c2 * k**2) / k**power
        axes.plot(k, ours, color=colour, label=f'{kind}, our fit')
    for boundary, face in zip(BOUNDARIES, (colour, 'white')):
        found = [
            (one.k, one.exponent / one.k**power, one.error / one.k**power)
            for one in branch.found(boundary)
        ]
        label = f'{kind}, {boundary}'
        draw.bars(axes, found, MARKERS[kind], colour, label, markerfacecolor=face)


# ---- slopes against the aspect ratio -------------------------------------------------------------


class Series:
    """One step in boxes of several aspect ratios."""

    def __init__(self, bags, boundary, kind, nodes, marker):
        self.boundary, self.kind, self.marker = boundary, kind, marker
        found = [(bag.info.aspect, points.find(bag.recording, kind, *nodes)) for bag in bags]
        self.points = [one for one in found if one[1]]  # aspect ratio, point
        self.name = f'{SYMBOLS[kind]}, {boundary}, {kind}({nodes[0]},{nodes[1]})'

    def scatter(self):
        """The slopes themselves are outside of the range of the paper's curves."""
        known = [one for one in self.points if points.own([one[1]])]
        slopes = [point.slope for _, point in known]
        mixtures = [f'at A = {at:.2f} it {one.remark}' for at, one in self.points if one.shares]

        def remark(mean):
            aspect, point = max(known, key=lambda one: abs(one[1].slope[0] - mean))
            off = f'{100 * (point.slope[0] / mean - 1):+.2f} %'
            return '; '.join([f'mean {mean:.4f}; farthest at A = {aspect:.2f}, {off}', *mixtures])

        return row.about_mean(f'{self.name} about their mean', slopes, remark)


def _series(bags):
    """Periodic boxes, and between walls those for L and those for T: there T needs nodes along both
    directions."""
    periodic, of_l, of_t = bags
    return [
        Series(periodic, PERIODIC, 'LP', (1, 0), 'o'),
        Series(periodic, PERIODIC, 'T', (1, 0), 'o'),
        Series(of_l, WALLS, 'LP', (1, 0), 's'),
        Series(of_t, WALLS, 'LP', (1, 1), 'D'),
        Series(of_t, WALLS, 'T', (1, 1), 'D'),
    ]


def constant(bags, boundary):
    return [one.scatter() for one in _series(bags) if one.boundary == boundary]


def aspects(bags):
    """Picture of the slopes."""
    series = [one for one in _series(bags) if one.points]
    if not series:
        return None
    figure, axes = plt.subplots(figsize=(5.6, 4.2), constrained_layout=True)
    for kind, curve in paper.CURVES.items():
        fitted, off = curve.c + curve.c2 * WAVE_NUMBER, paper.FIT_ACCURACY
        label = f'${SYMBOLS[kind]}$, fit of Eckmann et al. at $k={WAVE_NUMBER}$, $\\pm3$ %'
        style = {'color': KIND_COLOURS[kind], 'alpha': 0.15, 'linewidth': 0, 'label': label}
        axes.axhspan((1 - off) * fitted, (1 + off) * fitted, **style)
    for place, one in enumerate(series):
        beside, colour = BESIDE * (place - (len(series) - 1) / 2), KIND_COLOURS[one.kind]
        found = [(at + beside, *point.slope) for at, point in one.points]
        label = one.name.replace('c_T', '$c_T$').replace('c_L', '$c_L$')
        face = colour if one.boundary == PERIODIC else 'white'
        draw.bars(axes, found, one.marker, colour, label, markersize=4.5, markerfacecolor=face)
    low, high = axes.get_ylim()
    axes.set(xlim=(0.15, 1.1), ylim=(low, high + 0.7 * (high - low)))  # room for the names
    axes.set(xlabel=r'aspect ratio $L_y/L_x$', ylabel=r'$\lambda/k$  ' + draw.SIGMA_UNIT)
    axes.legend(loc='upper center', ncol=1)
    axes.set_title(f'$\\rho={paper.CURVES_DENSITY}$, $k={WAVE_NUMBER}$', fontsize=9)
    return figure
