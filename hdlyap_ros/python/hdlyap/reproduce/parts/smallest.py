"""Part 9: the smallest steps at density 0.4 against the wave number, periodic and between walls."""

from matplotlib import ticker
import numpy as np

from hdlyap.plots import dispersion, paper, steps
from hdlyap.plots.figures.style import KIND_COLOURS, plt

from .. import slopes
from ..row import Row

TITLE = 'Smallest steps at density 0.4 against the wave number, N = 400 to 780, A = 0.5 to 1'
BOXES = ('400_05', '400_1', '600_075', '780_05', '780_0867', '780_1')
BOUNDARIES = ('periodic', 'reflecting')
KINDS = {'T': steps.T, 'LP': steps.LP}
SYMBOLS = {'T': 'lambda_T', 'LP': 'lambda_L'}
UNIT = '1/time unit'
ENOUGH = 1.0  # %: a third of the scatter of the fits; with a larger error, 'alike' says little
# the paper gives no error of these
OPENS = f'{100 * paper.FIT_ACCURACY:g} %: that of the density fits'


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


class Branch:
    """The smallest steps of one kind, and the fits through those of each boundary and of both."""

    def __init__(self, bags, kind):
        self.kind = kind
        self.points = {boundary: points(bags, kind, boundary) for boundary in BOUNDARIES}
        self.points['both'] = [point for boundary in BOUNDARIES for point in self.points[boundary]]
        self.curves = {which: slopes.curve(found) for which, found in self.points.items()}

    def found(self, which):
        return [point for point in self.points[which] if point is not None]

    def noted(self, which):
        """What a fit goes through."""
        return ', '.join(
            filter(None, (f'{len(self.found(which))} boxes', slopes.noted(self.points[which])))
        )


# ---- rows ----------------------------------------------------------------------------------------


def rows(bags):
    for kind in KINDS:
        branch = Branch(bags, kind)
        for which in branch.points:
            yield from _curve_rows(branch, which)
        yield from _coefficient_rows(branch)
        yield _alike_row(branch)


def _curve_rows(branch, which):
    """Where the fit is held by points: at the ends of their range."""
    curve, published = branch.curves[which], paper.CURVES[branch.kind]
    quantity = f'{SYMBOLS[branch.kind]}, {which}'
    if curve is None:
        yield Row(quantity + ', smallest and largest k')
        return
    fitted = f'{branch.noted(which)}, chi^2 {curve.chi2:.1f} for {curve.freedom}; {OPENS}'
    for end, k in zip(('smallest', 'largest'), slopes.span(branch.points[which])):
        there = published.c * k + published.c2 * k * k
        value, error = curve.at(k)
        yield Row(
            f'{quantity} at {end} k = {k:.4f}',
            there,
            value,
            error,
            paper.FIT_ACCURACY * there,
            UNIT,
            fitted,
        )


def _coefficient_rows(branch):
    """What +-3 % of lambda at both ends of the range, in opposite directions, leave open to c and
    c2."""
    curve, published = branch.curves['both'], paper.CURVES[branch.kind]
    low, high = slopes.span(branch.points['both']) or (0.0, 0.0)
    names = f'c of {SYMBOLS[branch.kind]}, both', f'c2 of {SYMBOLS[branch.kind]}, both'
    if curve is None:
        yield from (Row(name, value, None) for name, value in zip(names, published))
        return
    remark = (
        f'{branch.noted("both")}; c and c2 are correlated: {curve.correlation:.2f}; '
        f'+-: of lambda at both ends {OPENS}'
    )
    opens = paper.FIT_ACCURACY * published.c / (high - low)
    yield Row(
        names[0],
        published.c,
        curve.c,
        curve.c_error,
        opens * (low + high),
        'sigma/time unit',
        remark,
    )
    yield Row(
        names[1], published.c2, curve.c2, curve.c2_error, 2 * opens, 'sigma^2/time unit', remark
    )


def _alike_row(branch):
    """Strictly: the paper says alike, and our errors are smaller than its scatter."""
    quantity = f'{SYMBOLS[branch.kind]}: reflecting over periodic at equal k, less 1'
    curves = [branch.curves[boundary] for boundary in BOUNDARIES]
    spans = [slopes.span(branch.points[boundary]) for boundary in BOUNDARIES]
    low, high = common(spans)
    if None in curves or not low < high:
        return Row(quantity, 0, None, unit='%', enough=ENOUGH)
    difference, error = dispersion.mean_difference(*curves, low, high)
    return Row(
        quantity,
        0,
        100 * difference,
        100 * error,
        0.0,
        '%',
        f'mean of the fits from k = {low:.4f} to {high:.4f}; {branch.noted("both")}',
        ENOUGH,
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
    yield 'smallest', header, [
        line
        for kind in KINDS
        for boundary in BOUNDARIES
        for box, point in zip(BOXES, points(bags, kind, boundary))
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
