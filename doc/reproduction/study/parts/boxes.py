"""Part 18: the velocity of LP modes against size, aspect ratio, boundary and density, beside that
of the pressure, P / (sqrt(2) rho); and T modes between walls."""

from collections import namedtuple

import numpy as np

from hdlyap.data import dispersion, steps
from hdlyap.plots import equation, paper
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION

from .. import averages, blocks, draw, pressure, rotation, slopes, velocity
from ..files import cells
from ..row import Row, Scatter
from . import aspect, densities, gas, smallest

PERIODIC, WALLS = 'periodic', 'between walls'
# at density 0.8 the other runs are the beginning of the same trajectory
DENSE = {PERIODIC: 'periodic', WALLS: 'reflecting'}
DILUTE = 'walls_02'
OTHERS = ('mixed', 'square', 'narrow_periodic', 'narrow_reflecting')
GROUPS = ((0.4, PERIODIC), (0.4, WALLS), (0.8, PERIODIC), (0.8, WALLS))
# v at k = 0 over that of the pressure, of the C of doc/findings.md: (x^2 - h^2 - g^2)^(1/2) / x
AT_ZERO = {0.4: 0.988, 0.8: 0.991}
SAME = 1e-9  # relative: wave numbers of a square box
# an error from so few blocks is known to a fifth; by this the mean of its chi^2 becomes 1
WIDER = ((blocks.BLOCKS - 1) / (blocks.BLOCKS - 3)) ** 0.5
Box = namedtuple('Box', 'run k ratio bare wide')
COLOURS = {PERIODIC: BLUE, WALLS: VERMILION}


def state(bags):
    """The pressures of part 17."""
    found = [(one.density, *one.z) for one in gas.read(bags)]
    return pressure.Equation(
        (density, z / henderson, error / henderson)
        for density, z, error in found
        for henderson in [float(equation.compressibility(density))]
        if error >= 0
    )


class Wave:
    """An LP step that was tracked: v, and over that of the pressure. common: relative error of that
    pressure, which other waves share."""

    def __init__(self, run, info, one, state):
        self.run, self.info, self.k, self.name = run, info, one.wave_number, one.name
        self.v, self.v_error = one.velocity()
        self.expected = pressure.velocity(info, one.nx, one.ny, state)
        self.common = pressure.error(info, state)

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
    measured = state(bags)
    found = [
        Wave(name, bags[name].info, one, measured)
        for name in names
        for one in rotation.read(bags[name]).values()
    ]
    return [one for one in found if one.is_known]


def group(bags, density, boundary):
    """Waves: each run of them has its own trajectory."""
    if density == 0.8:
        return waves(bags, [DENSE[boundary]])
    many = dict.fromkeys([*smallest.runs(), *aspect.runs()])
    return waves(bags, [name for name in many if _boundary(bags[name].info) == boundary])


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
    value, error, _ = averages.weighted(*zip(*[(one.ratio, one.error) for one in found]))
    return value, float(np.hypot(error, value * max(one.common for one in found)))


# ---- rows ----------------------------------------------------------------------------------------


def all_densities(bags):
    for name in densities.RUNS:
        yield _mean_row(f'density {int(name[-2:]) / 10:.1f}', waves(bags, [name]))


def one_curve(bags, boundary):
    quantity = f'v of boxes at density 0.4, {boundary}, about their line'
    found = group(bags, 0.4, boundary)
    boxes = of_boxes(found)
    fitted = curve(boxes)
    if fitted is None or not fitted.freedom:
        yield Scatter(quantity)
        return
    errors = [100 * box.wide / box.ratio for box in boxes]
    off = [(box.ratio - fitted.at(box.k)[0] / box.k) / box.wide for box in boxes]
    far = int(np.argmax(np.abs(off)))
    remark = (
        f'{len(found)} waves of {len(boxes)} boxes; farthest {boxes[far].run}, {off[far]:+.1f} '
        f'errors; of v alone {curve(boxes, "bare").chi2:.1f}'
    )
    yield Scatter(quantity, fitted.chi2, fitted.freedom, errors, remark)


def limit(bags, boundary):
    for density, published in AT_ZERO.items():
        found = group(bags, density, boundary)
        quantity = f'v over P / (sqrt 2 rho) at k = 0, {boundary}, density {density:g}'
        row, fitted = Row(quantity, published), curve(found)
        if fitted is not None:
            common = max(one.common for one in found)
            row.measured, row.error = fitted.c, float(np.hypot(fitted.c_error, fitted.c * common))
            low, high = min(one.k for one in found), max(one.k for one in found)
            there = ' and '.join(f'{fitted.at(k)[0] / k:.4f}' for k in (low, high))
            row.remark = f'a line from k = {low:.3f} to {high:.3f}; {there} at its ends'
        yield row


def alike(bags):
    for density in AT_ZERO:
        row = Row(f'v: walls over periodic at equal k, less 1, density {density:g}', 0.0, unit='%')
        both = [group(bags, density, boundary) for boundary in DENSE]
        ks = [[one.k for one in ones] for ones in both]
        spans = [(min(k), max(k)) if k else None for k in ks]
        found = slopes.above([curve(ones) for ones in both], spans)
        if found:
            row.measured, row.error, *ends = found
            row.remark = 'mean of the lines from k = {:.3f} to {:.3f}'.format(*ends)
        yield row


def other_shapes(bags):
    """Of the longest waves."""
    for name in OTHERS:
        yield _mean_row(name.replace('_', ' '), _longest(waves(bags, [name])))


def walls(bags):
    yield _mean_row('walls at 0.2', waves(bags, [DILUTE]))
    for density in AT_ZERO:
        yield _mean_row(f'walls at {density:g}', group(bags, density, WALLS))


def denser(bags):
    """Of T steps, beside what the density inside would make of them."""
    for density in AT_ZERO:
        names = _t_runs(bags, density)
        both = [_t_points(bags, names[boundary]) for boundary in DENSE]
        found = slopes.above(map(slopes.curve, both), [slopes.span(points) for points in both])
        quantity = f'lambda_T: walls over periodic at equal k, less 1, density {density:g}'
        row = Row(quantity, 0.0, unit='%')
        if found:
            infos = [bags[name].info for name in names[WALLS] if _t_points(bags, [name])]
            row.published = float(np.mean([higher(info) for info in infos]))
            row.left_open, row.count = 0.5 * row.published, 1
            row.measured, row.error, *ends = found
            inside = ', '.join(sorted({f'{pressure.inside(info):.3f}' for info in infos}))
            fits = 'mean of the fits from k = {:.3f} to {:.3f}'.format(*ends)
            row.remark = f'{fits}; density inside {inside}'
        yield row


def _longest(found):
    least = min((one.k for one in found), default=0.0)
    return [one for one in found if one.k <= least * (1 + SAME)]


def _mean_row(name, found):
    remark = f'waves: {len(found)}, boxes: {len({one.run for one in found})}' if found else ''
    return Row(f'v over P / (sqrt 2 rho), {name}', 1.0, *mean(found), remark=remark)


def _t_points(bags, names):
    return [point for name in names for point in slopes.every(bags[name].recording, steps.T)]


def _t_runs(bags, density):
    """{boundary: runs}; at 0.4 those of part 9, which have T steps at many k in each box."""
    if density == 0.8:
        return {boundary: [name] for boundary, name in DENSE.items()}
    names = smallest.runs()
    return {
        boundary: [name for name in names if _boundary(bags[name].info) == boundary]
        for boundary in DENSE
    }


def higher(info):
    """Percent by which the paper's c_T is, at the density inside."""
    return 100 * (paper.slope_t(pressure.inside(info)) / paper.slope_t(info.density) - 1)


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    found = {of: group(bags, *of) for of in GROUPS}
    if any(found.values()):
        yield 'velocity', _figure(found)


def _figure(found):
    figure, panels = draw.panels(1, 2, (7.6, 3.6), sharey=True)
    draw.letters(panels, [f' density {density:g}' for density in AT_ZERO])
    for axes, density in zip(panels, AT_ZERO):
        axes.axhline(1, color=GREY, linewidth=0.6)
        for boundary, colour in COLOURS.items():
            _points(axes, found[density, boundary], colour, boundary)
        axes.set_xlim(left=0)
        axes.set_xlabel(r'wave number $k$  [1/$\sigma$]')
    panels[0].set_ylabel(r'$v\,/\,(P/\sqrt{2}\rho)$')
    draw.legend(panels[0], loc='lower right')
    return figure


def _points(axes, found, colour, label):
    points = [(one.k, one.ratio, one.error) for one in found]
    draw.bars(axes, points, 'o', colour, label, markersize=3, elinewidth=0.8, capsize=0)
    fitted = curve(found)
    if fitted is not None:
        along = np.array([0.0, max(one.k for one in found)])
        axes.plot(along, fitted.c + fitted.c2 * along, color=colour, linewidth=0.8)


def tables(bags):
    about = 'run', 'disks', 'density', 'aspect', 'boundary_x', 'boundary_y', 'step', 'wave_number'
    header = (*about, 'v', 'v_error', 'v_of_pressure', 'ratio', 'ratio_error')
    every = dict.fromkeys([*densities.RUNS, *smallest.runs(), *aspect.runs(), *DENSE.values()])
    yield 'velocity', header, [_line(one) for one in waves(bags, [*every, *OTHERS, DILUTE])]


def _line(one):
    info = one.info
    system = one.run, info.disks, info.density, info.aspect, info.boundary_x, info.boundary_y
    measured = one.name, one.k, one.v, one.v_error, one.expected, one.ratio, one.error
    return cells('s s g g s s s .6g .6g .2g .6g .6g .2g', *system, *measured)
