"""Part 9: the smallest steps at density 0.4 against the wave number, periodic and between walls."""

from matplotlib import ticker
import numpy as np

from hdlyap.plots import dispersion, paper, steps
from hdlyap.plots.figures.style import KIND_COLOURS, plt

from .. import slopes
from ..row import Claim, Row, Scatter

TITLE = 'Smallest steps at density 0.4 against the wave number, N = 400 to 780, A = 0.5 to 1'
BOXES = ('400_05', '400_1', '600_075', '780_05', '780_0867', '780_1')
BOUNDARIES = ('periodic', 'reflecting')
ENDS = ('smallest', 'largest')
KINDS = {'T': steps.T, 'LP': steps.LP}
SYMBOLS = {'T': 'lambda_T', 'LP': 'lambda_L'}
UNIT = '1/time unit'
TELLING = 100 * paper.FIT_ACCURACY  # %: a larger difference must have been seen
# the paper gives no error: a fit through many boxes is taken to be known twice as well as a slope
WITHIN = 0.5 * paper.FIT_ACCURACY
OPENS = f'{100 * WITHIN:g} %'


def run_of(boundary, box):
    """The first density run is one of them."""
    return (
        'density_04'
        if (boundary, box) == ('periodic', '780_0867')
        else f'smallest_{boundary}_{box}'
    )


def runs(plan):
    return [run_of(boundary, box) for boundary in BOUNDARIES for box in BOXES]


def points(bags, kind, boundary):
    """The smallest step of each box, None where there is none."""
    return [slopes.smallest(bags[run_of(boundary, box)].recording, KINDS[kind]) for box in BOXES]


def seconds(bags):
    """LP(1,1) between walls: LP(1,0) hardly has wave numbers in common with periodic boxes."""
    recordings = [bags[run_of('reflecting', box)].recording for box in BOXES]
    return [slopes.find(recording, steps.LP, 1, 1) for recording in recordings]


class Branch:
    """The smallest steps of one kind, and the fits through those of each boundary and of both."""

    def __init__(self, bags, kind):
        self.kind = kind
        self.points = {boundary: points(bags, kind, boundary) for boundary in BOUNDARIES}
        self.points['both'] = [point for boundary in BOUNDARIES for point in self.points[boundary]]
        self.curves = {which: slopes.curve(found) for which, found in self.points.items()}
        self.walls = self.points['reflecting'] + (seconds(bags) if kind == 'LP' else [])

    def found(self, which):
        return [point for point in self.points[which] if point is not None]

    def noted(self, which):
        """What a fit goes through."""
        used, found = len(slopes.own(self.points[which])), self.found(which)
        left = f'{len(found) - used} left out' if len(found) > used else ''
        return ', '.join(filter(None, (f'{used} boxes', left, slopes.noted(found))))


# ---- rows ----------------------------------------------------------------------------------------


def claims(bags):
    branches = [Branch(bags, kind) for kind in KINDS]
    for branch in branches:
        published = paper.CURVES[branch.kind]
        yield Claim(
            f'{SYMBOLS[branch.kind]} = {published.c} k + {published.c2} k^2',
            [_end_row(branch, end) for end in ENDS],
            f'within {OPENS} at both ends of the range',
            values=len(slopes.own(branch.points['both'])),
        )
    yield Claim(
        'c2 of lambda_T is 0.086, of lambda_L 0.55',
        [_curvature_row(branch) for branch in branches],
        f'what {OPENS} of lambda more at one end and less at the other leave open',
    )
    yield Claim(
        'one curve, whatever the size and aspect ratio of the box',
        [_scatter_row(branch, boundary) for branch in branches for boundary in BOUNDARIES],
        'chi^2 from our errors',
    )
    for branch in branches:
        yield Claim(
            f'{SYMBOLS[branch.kind]} is alike for both boundaries',
            [_alike_row(branch)],
            'the same within our errors',
        )
    yield Claim('slopes at k = 0', [_c_row(branch) for branch in branches])


def _end_row(branch, end):
    """Where the fit is held by points."""
    curve, published = branch.curves['both'], paper.CURVES[branch.kind]
    quantity = f'{SYMBOLS[branch.kind]} at {end} k'
    if curve is None:
        return Row(quantity, paper.CURVES[branch.kind].c, unit=UNIT)
    k = slopes.span(branch.points['both'])[ENDS.index(end)]
    there = published.c * k + published.c2 * k * k
    value, error = curve.at(k)
    remark = f'k = {k:.4f}, {branch.noted("both")}'
    return Row(quantity, there, value, error, WITHIN * there, UNIT, remark)


def _curvature_row(branch):
    curve, published = branch.curves['both'], paper.CURVES[branch.kind]
    quantity, unit = f'c2 of {SYMBOLS[branch.kind]}', 'sigma^2/time unit'
    if curve is None:
        return Row(quantity, published.c2, unit=unit)
    low, high = slopes.span(branch.points['both'])
    opens = 2 * WITHIN * published.c / (high - low)
    return Row(quantity, published.c2, curve.c2, curve.c2_error, opens, unit)


def _c_row(branch):
    """With c2 and lambda at both ends it says one thing."""
    curve, quantity = branch.curves['both'], f'c of {SYMBOLS[branch.kind]}'
    if curve is None:
        return Row(quantity)
    remark = (
        f'the paper: {paper.CURVES[branch.kind].c}; correlated with c2: {curve.correlation:.2f}'
    )
    return Row(quantity, None, curve.c, curve.c_error, unit='sigma/time unit', remark=remark)


def _scatter_row(branch, boundary):
    curve = branch.curves[boundary]
    quantity = f'{SYMBOLS[branch.kind]}, {boundary}, about its curve'
    if curve is None or not curve.freedom:
        return Scatter(quantity, None, 0, [], TELLING)
    errors = [100 * point.error / point.exponent for point in slopes.own(branch.points[boundary])]
    return Scatter(quantity, curve.chi2, curve.freedom, errors, TELLING, branch.noted(boundary))


def _alike_row(branch):
    """Strictly, as our errors are smaller than the scatter of the paper."""
    quantity = f'{SYMBOLS[branch.kind]}: reflecting over periodic at equal k, less 1'
    both = branch.points['periodic'], branch.walls
    curves = [slopes.curve(found) for found in both]
    low, high = common([slopes.span(found) for found in both])
    if None in curves or not low < high:
        return Row(quantity, 0.0, None, unit='%', telling=TELLING)
    difference, error = dispersion.mean_difference(*curves, low, high)
    return Row(
        quantity,
        0.0,
        100 * difference,
        100 * error,
        unit='%',
        remark=f'mean of the fits from k = {low:.4f} to {high:.4f}'
        + ('; between walls with LP(1,1)' if branch.kind == 'LP' else ''),
        telling=TELLING,
    )


def common(spans):
    """The range that two ranges have in common; its end before its beginning if there is none."""
    if None in spans:
        return 1.0, 0.0
    return max(low for low, _ in spans), min(high for _, high in spans)


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    branches = [Branch(bags, kind) for kind in KINDS]
    if any(branch.found('both') for branch in branches):
        yield 'smallest', _figure(branches)


def _figure(branches):
    figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 3.8), constrained_layout=True)
    end = 1.06 * max(point.wave_number for branch in branches for point in branch.found('both'))
    for branch in branches:
        _lines(left, branch, np.linspace(0, end, 100), power=0)
        _lines(right, branch, np.linspace(0, end, 100)[1:], power=1)
    for axes, letter in ((left, 'a'), (right, 'b')):
        axes.set_xlim(0, end)
        axes.xaxis.set_major_locator(ticker.MaxNLocator(5))
        axes.set_xlabel(r'wave number $k$  [1/$\sigma$]')
        axes.set_title(f'({letter})', loc='left')
    left.set_ylim(bottom=0)
    left.set_ylabel(r'$\lambda$  [1/time unit]')
    right.set_ylabel(r'$\lambda/k$  [$\sigma$/time unit]')
    left.legend(loc='upper left')
    figure.suptitle(
        f'smallest steps, $\\rho={paper.CURVES_DENSITY}$, $N=400$ to $780$, $L_y/L_x=0.5$ to $1$',
        fontsize=9,
    )
    return figure


def _lines(axes, branch, k, power):
    """Points, our fit through all, and the paper's with what it leaves open; over k^power."""
    colour, published = KIND_COLOURS[branch.kind], paper.CURVES[branch.kind]
    there = (published.c * k + published.c2 * k**2) / k**power
    axes.plot(
        k,
        there,
        color=colour,
        linewidth=0.8,
        dashes=(2, 2),
        label=f'{branch.kind}, fit of Eckmann et al.',
    )
    if power:
        axes.fill_between(
            k,
            (1 - paper.FIT_ACCURACY) * there,
            (1 + paper.FIT_ACCURACY) * there,
            color=colour,
            alpha=0.12,
            linewidth=0,
        )
    curve = branch.curves['both']
    if curve is not None:
        axes.plot(
            k,
            (curve.c * k + curve.c2 * k**2) / k**power,
            color=colour,
            label=f'{branch.kind}, our fit',
        )
    for boundary, face in zip(BOUNDARIES, (colour, 'white')):
        found = branch.found(boundary)
        if found:
            _points(
                axes,
                found,
                power,
                'o' if branch.kind == 'T' else 's',
                colour,
                face,
                f'{branch.kind}, {boundary}',
            )


def _points(axes, found, power, marker, colour, face, label):
    k = np.array([point.wave_number for point in found])
    errors = np.maximum(0, [point.error for point in found])
    axes.errorbar(
        k,
        np.array([point.exponent for point in found]) / k**power,
        errors / k**power,
        fmt=marker,
        color=colour,
        markerfacecolor=face,
        markersize=4,
        elinewidth=0.9,
        capsize=2,
        label=label,
        zorder=3,
    )


def tables(bags):
    header = (
        'boundaries',
        'disks',
        'aspect',
        'kind',
        'step',
        'wave_number',
        'exponent',
        'std_error',
        'slope',
        'slope_error',
        'remark',
    )
    series = [
        (kind, boundary, points(bags, kind, boundary)) for kind in KINDS for boundary in BOUNDARIES
    ]
    yield 'smallest', header, [
        line
        for kind, boundary, found in [*series, ('LP', 'reflecting', seconds(bags))]
        for box, point in zip(BOXES, found)
        for line in _line(bags[run_of(boundary, box)].recording.info, boundary, kind, point)
    ]


def _line(info, boundary, kind, point):
    about = (boundary, info.disks, f'{info.aspect:g}', kind)
    if point is None:
        yield (*about, 'none resolved') + ('',) * 6
        return
    yield (
        *about,
        point.name,
        f'{point.wave_number:.6g}',
        f'{point.exponent:.6g}',
        f'{point.error:.2g}',
        f'{point.slope:.6g}',
        f'{point.slope_error:.2g}',
        point.remark,
    )
