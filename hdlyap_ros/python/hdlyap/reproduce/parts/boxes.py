"""Part 18: the velocity of LP modes against size, aspect ratio, boundary and density, beside that
of the pressure, P / (sqrt(2) rho); and T modes between walls."""

from collections import namedtuple

import numpy as np

from hdlyap.plots import dispersion, paper, steps
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, plt

from .. import averages, blocks, pressure, rotation, slopes, velocity
from ..row import Claim, Row, Scatter
from . import aspect, densities, smallest

TITLE = 'Velocity of LP modes in all boxes, beside the pressure; T modes between walls'
PERIODIC, WALLS = 'periodic', 'between walls'
# at density 0.8 the other runs are the beginning of the same trajectory
DENSE = {PERIODIC: 'periodic', WALLS: 'reflecting'}
DILUTE = 'walls_02'
OTHERS = ('mixed', 'square', 'narrow_periodic', 'narrow_reflecting')
GROUPS = ((0.4, PERIODIC), (0.4, WALLS), (0.8, PERIODIC), (0.8, WALLS))
TELLING = 100 * paper.FIT_ACCURACY  # %: one box may be off by so much without being seen
HENDERSON = 0.01  # of the equation of state, and of what walls do to it
FALLS = 0.02  # by which v was seen to fall with k (doc/findings.md)
SAME = 1e-9  # relative: wave numbers of a square box
# an error from so few blocks is known to a fifth; by this the mean of its chi^2 becomes 1
WIDER = ((blocks.BLOCKS - 1) / (blocks.BLOCKS - 3)) ** 0.5
Box = namedtuple('Box', 'run k ratio bare wide')
COLOURS = {PERIODIC: BLUE, WALLS: VERMILION}


def runs(plan):
    """Of those that a plan need not have, the ones that it has."""
    wanted = [*densities.RUNS, *smallest.runs(plan), *aspect.runs(plan), *DENSE.values()]
    return [*dict.fromkeys(wanted)] + [name for name in (*OTHERS, DILUTE) if name in (plan or ())]


class Wave:
    """An LP step that was tracked: v, and over that of the pressure."""

    def __init__(self, run, info, one):
        self.run, self.info, self.k, self.name = run, info, one.wave_number, one.name
        self.v, self.v_error = one.velocity()
        self.expected = pressure.velocity(info, one.nx, one.ny)

    @property
    def is_known(self):
        return self.v is not None and self.v_error > 0

    @property
    def ratio(self):
        return self.v / self.expected

    @property
    def bare(self):
        """The same over that of the pressure without walls."""
        return self.v / velocity.of_fields(self.info.density)

    @property
    def error(self):
        return self.v_error / self.expected

    @property
    def wide(self):
        """The error for chi^2."""
        return WIDER * self.error


def waves(bags, names):
    """That are known with an error."""
    found = [
        Wave(name, bags[name].info, one)
        for name in names
        if name in bags
        for one in rotation.read(bags[name]).values()
    ]
    return [one for one in found if one.is_known]


def groups(bags):
    """{(density, boundary): waves}: each run of them has its own trajectory."""
    many = [
        name for name in dict.fromkeys([*smallest.runs(None), *aspect.runs(None)]) if name in bags
    ]
    of = {
        boundary: [name for name in many if _boundary(bags[name].info) == boundary]
        for boundary in DENSE
    }
    return {
        (density, boundary): waves(bags, of[boundary] if density == 0.4 else [DENSE[boundary]])
        for density, boundary in GROUPS
    }


def _boundary(info):
    return WALLS if 'reflecting' in (info.boundary_x, info.boundary_y) else PERIODIC


def of_boxes(found):
    """Each box as one point on the line: weighted means of k and of both ratios."""
    points = []
    for run in dict.fromkeys(one.run for one in found):
        ones = [one for one in found if one.run == run]
        weights = np.array([one.wide**-2 for one in ones])
        k, ratio, bare = np.average(
            [(one.k, one.ratio, one.bare) for one in ones], axis=0, weights=weights
        )
        points.append(Box(run, k, ratio, bare, float(weights.sum() ** -0.5)))
    return points


def curve(found, which='ratio'):
    """Of v over that of the pressure, c + c2 k, as omega = c k + c2 k^2; None of too few waves."""
    if dispersion.number_of([one.k for one in found]) < 2:
        return None
    k, ratios, errors = np.array([(one.k, getattr(one, which), one.wide) for one in found]).T
    return dispersion.Curve(k, k * ratios, k * errors)


def mean(found):
    """(weighted mean of v over that of the pressure, its error)"""
    if not found:
        return None, 0.0
    return averages.weighted(*zip(*[(one.ratio, one.error) for one in found]))[:2]


# ---- rows ----------------------------------------------------------------------------------------


def claims(bags):
    found = groups(bags)
    yield Claim(
        'v is P / (sqrt(2) rho) at all densities',
        [_mean_row(f'density {_tenths(name)}', waves(bags, [name])) for name in densities.RUNS],
        f'within {100 * (FALLS + HENDERSON):g} %: what v falls with k, and Henderson\'s equation',
    )
    for boundary in DENSE:
        yield Claim(
            f'v of all boxes is one curve in k, {boundary}',
            [_scatter_row(0.4, boundary, found[0.4, boundary])],
            'chi^2 from our errors, and from how well these are known',
        )
        yield Claim(
            f'it goes to P / (sqrt(2) rho) at k to 0, {boundary}',
            [_limit_row(density, boundary, found[density, boundary]) for density in (0.4, 0.8)],
            f'within {100 * HENDERSON:g} %: Henderson\'s equation',
        )
    yield Claim(
        'v is alike for both boundaries, over that of the pressure',
        [_alike_row(density, found) for density in (0.4, 0.8)],
        f'within {100 * HENDERSON:g} %: what walls do to the pressure',
    )
    yield Claim(
        'LP modes turn alike in mixed, square and narrow boxes',
        [_mean_row(name.replace('_', ' '), _longest(waves(bags, [name]))) for name in OTHERS],
        'as at all densities, of the longest waves',
    )
    yield Claim(
        'LP modes turn alike between walls at lower and higher density',
        [
            _mean_row('walls at 0.2', waves(bags, [DILUTE])),
            _mean_row('walls at 0.4', found[0.4, WALLS]),
            _mean_row('walls at 0.8', found[0.8, WALLS]),
        ],
        'as at all densities',
    )
    yield Claim(
        'T between walls is higher, as it is denser inside',
        [_denser_row(bags, density) for density in (0.4, 0.8)],
        'the slope at that density, +-half of what it is higher',
    )


def _longest(found):
    least = min((one.k for one in found), default=0.0)
    return [one for one in found if one.k <= least * (1 + SAME)]


def _tenths(name):
    return f'{int(name[-2:]) / 10:.1f}'


def _mean_row(name, found):
    value, error = mean(found)
    remark = f'waves: {len(found)}, boxes: {len({one.run for one in found})}' if found else ''
    return Row(f'v over P / (sqrt 2 rho), {name}', 1.0, value, error, FALLS + HENDERSON, '', remark)


def _scatter_row(density, boundary, found):
    quantity = f'v of boxes at density {density:g}, {boundary}, about their line'
    boxes = of_boxes(found)
    fitted = curve(boxes)
    if fitted is None or not fitted.freedom:
        return Scatter(quantity, None, 0, [], TELLING)
    errors = [100 * box.wide / box.ratio for box in boxes]
    off = [(box.ratio - fitted.at(box.k)[0] / box.k) / box.wide for box in boxes]
    far = int(np.argmax(np.abs(off)))
    remark = (
        f'{len(found)} waves of {len(boxes)} boxes; farthest {boxes[far].run}, {off[far]:+.1f} '
        f'errors; of v alone {curve(boxes, "bare").chi2:.1f}'
    )
    return Scatter(quantity, fitted.chi2, fitted.freedom, errors, TELLING, remark)


def _limit_row(density, boundary, found):
    quantity = f'v over P / (sqrt 2 rho) at k = 0, {boundary}, density {density:g}'
    fitted = curve(found)
    if fitted is None:
        return Row(quantity, 1.0)
    low, high = min(one.k for one in found), max(one.k for one in found)
    remark = (
        f'a line from k = {low:.3f} to {high:.3f}; {fitted.at(low)[0] / low:.4f} and '
        f'{fitted.at(high)[0] / high:.4f} at its ends'
    )
    return Row(quantity, 1.0, fitted.c, fitted.c_error, HENDERSON, remark=remark)


def _alike_row(density, found):
    quantity = f'v: walls over periodic at equal k, less 1, density {density:g}'
    both = [found[density, boundary] for boundary in DENSE]
    curves = [curve(ones) for ones in both]
    if None in curves:
        return Row(quantity, 0.0, unit='%')
    low, high = smallest.common(
        [(min(one.k for one in ones), max(one.k for one in ones)) for ones in both]
    )
    if not low < high:
        return Row(quantity, 0.0, unit='%')
    difference, error = dispersion.mean_difference(*curves, low, high)
    remark = f'mean of the lines from k = {low:.3f} to {high:.3f}'
    return Row(quantity, 0.0, 100 * difference, 100 * error, 100 * HENDERSON, '%', remark, TELLING)


def _t_points(bags, names):
    """All T steps that have vectors of their own."""
    found = []
    for name in names:
        recording = bags[name].recording
        for step in steps.resolved(recording.steps).values():
            if step.kind == steps.T:
                found.append(slopes.find(recording, steps.T, step.nx, step.ny))
    return slopes.own(found)


def _denser_row(bags, density):
    quantity = f'lambda_T: walls over periodic at equal k, less 1, density {density:g}'
    names = _t_runs(bags, density)
    both = [_t_points(bags, names[boundary]) for boundary in DENSE]
    curves = [slopes.curve(points) for points in both]
    low, high = smallest.common([slopes.span(points) for points in both])
    walls = [bags[name].info for name in names[WALLS] if _t_points(bags, [name])]
    if None in curves or not low < high:
        return Row(quantity, 0.0, unit='%')
    expected = float(np.mean([_higher(info) for info in walls]))
    difference, error = dispersion.mean_difference(*curves, low, high)
    inside = ', '.join(sorted({f'{pressure.inside(info):.3f}' for info in walls}))
    return Row(
        quantity,
        expected,
        100 * difference,
        100 * error,
        0.5 * expected,
        '%',
        f'mean of the fits from k = {low:.3f} to {high:.3f}; density inside {inside}',
        telling=expected,
    )


def _t_runs(bags, density):
    """{boundary: runs}; at 0.4 those of part 9, which have T steps at many k in each box."""
    if density == 0.8:
        return {boundary: [name] for boundary, name in DENSE.items()}
    names = smallest.runs(None)
    return {
        boundary: [name for name in names if _boundary(bags[name].info) == boundary]
        for boundary in DENSE
    }


def _higher(info):
    """Percent by which the paper's c_T is, at the density inside."""
    return 100 * (paper.slope_t(pressure.inside(info)) / paper.slope_t(info.density) - 1)


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    found = groups(bags)
    if any(found.values()):
        yield 'velocity', _figure(found)


def _figure(found):
    figure, panels = plt.subplots(1, 2, figsize=(7.6, 3.6), sharey=True, constrained_layout=True)
    for axes, density, letter in zip(panels, (0.4, 0.8), 'ab'):
        axes.axhline(1, color=GREY, linewidth=0.6)
        for boundary, colour in COLOURS.items():
            _points(axes, found[density, boundary], colour, boundary)
        axes.set_xlim(left=0)
        axes.set_xlabel(r'wave number $k$  [1/$\sigma$]')
        axes.set_title(f'({letter})  density {density:g}', loc='left')
    panels[0].set_ylabel(r'$v\,/\,(P/\sqrt{2}\rho)$')
    if panels[0].get_legend_handles_labels()[0]:
        panels[0].legend(loc='lower right')
    return figure


def _points(axes, found, colour, label):
    if not found:
        return
    k, ratios, errors = np.array([(one.k, one.ratio, one.error) for one in found]).T
    axes.errorbar(
        k, ratios, errors, fmt='o', color=colour, markersize=3, elinewidth=0.8, label=label
    )
    fitted = curve(found)
    if fitted is not None:
        along = np.array([0.0, k.max()])
        axes.plot(along, fitted.c + fitted.c2 * along, color=colour, linewidth=0.8)


def tables(bags):
    header = (
        'run',
        'disks',
        'density',
        'aspect',
        'boundary_x',
        'boundary_y',
        'step',
        'wave_number',
        'v',
        'v_error',
        'v_of_pressure',
        'ratio',
        'ratio_error',
    )
    yield 'velocity', header, [_line(one) for one in waves(bags, runs(bags))]


def _line(one):
    info = one.info
    about = one.run, info.disks, f'{info.density:g}', f'{info.aspect:g}'
    return (
        *about,
        info.boundary_x,
        info.boundary_y,
        one.name,
        f'{one.k:.6g}',
        f'{one.v:.6g}',
        f'{one.v_error:.2g}',
        f'{one.expected:.6g}',
        f'{one.ratio:.6g}',
        f'{one.error:.2g}',
    )
