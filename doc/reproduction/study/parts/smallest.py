"""Part 9: the smallest steps at density 0.4 against the wave number, periodic and between walls;
all steps at densities 0.2 and 0.8, periodic beside walls."""

from math import hypot

from matplotlib import ticker
import numpy as np

from hdlyap.data import steps
from hdlyap.plots import paper
from hdlyap.plots.figures.style import KIND_COLOURS

from .. import averages, draw, slopes
from ..row import Row, Scatter

BOXES = ('400_05', '400_1', '600_075', '780_05', '780_0867', '780_1')
PERIODIC, WALLS = BOUNDARIES = 'periodic', 'reflecting'
ENDS = ('smallest', 'largest')
KINDS = {'T': steps.T, 'LP': steps.LP}
SYMBOLS = {'T': 'lambda_T', 'LP': 'lambda_L'}
MARKERS = {'T': 'o', 'LP': 's'}
UNIT, UNIT_C2 = '1/time unit', 'sigma^2/time unit'
ELSEWHERE = {'0.2': ('density_02', 'walls_02'), '0.8': ('periodic', 'reflecting')}


def run_of(boundary, box):
    """The first density run is one of them."""
    first = (boundary, box) == (PERIODIC, '780_0867')
    return 'density_04' if first else f'smallest_{boundary}_{box}'


def runs():
    return [run_of(boundary, box) for boundary in BOUNDARIES for box in BOXES]


def points(bags, kind, boundary):
    """The smallest step of each box, None where there is none."""
    return [slopes.smallest(bags[run_of(boundary, box)].recording, KINDS[kind]) for box in BOXES]


def seconds(bags):
    """LP(1,1) between walls: LP(1,0) hardly has wave numbers in common with periodic boxes."""
    recordings = [bags[run_of(WALLS, box)].recording for box in BOXES]
    return [slopes.find(recording, steps.LP, 1, 1) for recording in recordings]


class Branch:
    """The smallest steps of one kind, and the fits through those of each boundary and of both."""

    def __init__(self, bags, kind):
        self.kind, self.symbol = kind, SYMBOLS[kind]
        self.points = {boundary: points(bags, kind, boundary) for boundary in BOUNDARIES}
        self.points['both'] = [point for boundary in BOUNDARIES for point in self.points[boundary]]
        self.curves = {which: slopes.curve(found) for which, found in self.points.items()}
        self.walls = self.points[WALLS] + (seconds(bags) if kind == 'LP' else [])

    def found(self, which):
        return [point for point in self.points[which] if point is not None]

    def noted(self, which):
        """What a fit goes through."""
        used, found = len(slopes.own(self.points[which])), self.found(which)
        left = f'{len(found) - used} left out' if len(found) > used else ''
        return ', '.join(filter(None, (f'{used} boxes', left, slopes.noted(found))))


# ---- rows ----------------------------------------------------------------------------------------


def ends(bags, kind):
    """Where the fit is held by points."""
    branch, published = Branch(bags, kind), paper.CURVES[kind]
    curve, span = branch.curves['both'], slopes.span(branch.points['both'])
    for number, end in enumerate(ENDS):
        row = Row(f'{branch.symbol} at {end} k', published.c, unit=UNIT)
        if curve is not None:
            k = span[number]
            row.published = published.c * k + published.c2 * k * k
            row.measured, row.error = curve.at(k)
            row.remark = f'k = {k:.4f}, {branch.noted("both")}'
            row.count = (1 - number) * len(slopes.own(branch.points['both']))
        yield row


def curvature(bags):
    """c2 of L less that of T."""
    curves = {kind: Branch(bags, kind).curves['both'] for kind in ('LP', 'T')}
    row = Row('c2 of lambda_L less c2 of lambda_T', unit=UNIT_C2)
    if None not in curves.values():
        of_l, of_t = curves.values()
        row.measured, row.error = of_l.c2 - of_t.c2, hypot(of_l.c2_error, of_t.c2_error)
    yield row


def coefficients(bags):
    """With lambda at both ends they say one thing."""
    for kind in KINDS:
        branch, published = Branch(bags, kind), paper.CURVES[kind]
        curve = branch.curves['both']
        known = (curve.c, curve.c_error) if curve else (None, 0.0)
        remark = f'the paper: {published.c}'
        if curve:
            remark += f'; correlated with c2: {curve.correlation:.2f}'
        yield Row(f'c of {branch.symbol}', None, *known, 'sigma/time unit', remark)
        known = (curve.c2, curve.c2_error) if curve else (None, 0.0)
        yield Row(f'c2 of {branch.symbol}', None, *known, UNIT_C2, f'the paper: {published.c2}')


def one_curve(bags):
    for kind in KINDS:
        branch = Branch(bags, kind)
        for boundary in BOUNDARIES:
            quantity = f'{branch.symbol}, {boundary}, about its curve'
            curve, found = branch.curves[boundary], slopes.own(branch.points[boundary])
            if curve is None or not curve.freedom:
                yield Scatter(quantity)
                continue
            errors = [100 * point.error / point.exponent for point in found]
            yield Scatter(quantity, curve.chi2, curve.freedom, errors, branch.noted(boundary))


def alike(bags, kind):
    branch = Branch(bags, kind)
    row = _alike(branch.symbol, branch.points[PERIODIC], branch.walls)
    if row.remark and kind == 'LP':
        row.remark += '; between walls with LP(1,1)'
    yield row


def alike_elsewhere(bags, density):
    """Of all steps that have vectors of their own."""
    for kind, symbol in SYMBOLS.items():
        both = [slopes.every(bags[name].recording, KINDS[kind]) for name in ELSEWHERE[density]]
        yield _alike(symbol, *both, f', density {density}')


def _alike(symbol, periodic, walls, where=''):
    row = Row(f'{symbol}: reflecting over periodic at equal k, less 1{where}', 0.0, unit='%')
    curves = [slopes.curve(found) for found in (periodic, walls)]
    spans = [slopes.span(found) for found in (periodic, walls)]
    low, high = slopes.common(spans)
    found = slopes.above(curves, spans)
    if found:
        row.measured, row.error, *ends = found
        row.remark = 'mean of the fits from k = {:.4f} to {:.4f}'.format(*ends)
    elif curves[0] is not None and curves[1] is None and low == high:
        row.measured, row.error = _beside(curves[0], slopes.own(walls))
        row.remark = f'of the fit at k = {low:.4f}'
    return row


def _beside(curve, points):
    """(percent by which steps of one wave number are above a curve, its error)"""
    exponent, error, _ = averages.weighted(*zip(*[(one.exponent, one.error) for one in points]))
    quotient = averages.quotient((exponent, error), curve.at(points[0].wave_number))
    return 100 * (quotient[0] - 1), 100 * quotient[1]


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    branches = [Branch(bags, kind) for kind in KINDS]
    if any(branch.found('both') for branch in branches):
        yield 'smallest', _figure(branches)


def _figure(branches):
    figure, (left, right) = draw.panels(1, 2, (7.6, 3.8))
    end = 1.06 * max(point.wave_number for branch in branches for point in branch.found('both'))
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
            (k, one.exponent / k**power, one.error / k**power)
            for one in branch.found(boundary)
            for k in [one.wave_number]
        ]
        label = f'{kind}, {boundary}'
        draw.bars(axes, found, MARKERS[kind], colour, label, markerfacecolor=face)


def tables(bags):
    header = 'boundaries', 'disks', 'aspect', 'kind', 'step', *slopes.COLUMNS, 'remark'
    series = [
        (kind, boundary, points(bags, kind, boundary)) for kind in KINDS for boundary in BOUNDARIES
    ]
    yield 'smallest', header, [
        (boundary, info.disks, f'{info.aspect:g}', kind, *_cells(point))
        for kind, boundary, found in [*series, ('LP', WALLS, seconds(bags))]
        for box, point in zip(BOXES, found)
        for info in [bags[run_of(boundary, box)].recording.info]
    ]


def _cells(point):
    if point is None:
        return ('none resolved', *6 * ('',))
    return (point.name, *point.cells, point.remark)
