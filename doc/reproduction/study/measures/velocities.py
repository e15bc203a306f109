"""The velocity of LP modes against size, aspect ratio, boundary and density, beside that of the
pressure, P / (sqrt(2) rho); and T modes between walls.

Bags: the densities of part 8, the boxes of part 9, periodic and between walls, those of part 10, at
density 0.8 one periodic and one between walls (the other runs are the beginning of the same
trajectory), boxes of other shapes there, and walls at a lower density."""

from collections import namedtuple

import numpy as np

from hdlyap.data import dispersion
from hdlyap.plots import equation, paper
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION

from .. import averages, blocks, draw, points, pressure, rotation
from ..averages import UNKNOWN
from ..row import Row, Scatter
from . import gas

PERIODIC, WALLS = 'periodic', 'between walls'
COLOURS = {PERIODIC: BLUE, WALLS: VERMILION}
# v at k = 0 over that of the pressure, of the C of doc/findings.md: (x^2 - h^2 - g^2)^(1/2) / x
AT_ZERO = {0.4: 0.988, 0.8: 0.991}
SAME = 1e-9  # relative: wave numbers of a square box
# an error from so few blocks is known to a fifth; by this the mean of its chi^2 becomes 1
WIDER = ((blocks.BLOCKS - 1) / (blocks.BLOCKS - 3)) ** 0.5
Box = namedtuple('Box', 'run k ratio bare wide')


class Wave:
    """An LP step that was tracked: v, and over that of the pressure (bare: without walls). wide:
    the error for chi^2. common: relative error of that pressure, which other waves share."""

    def __init__(self, bag, one, state):
        info, (v, error) = bag.info, one.velocity()
        self.run, self.k = bag.name, one.wave_number
        self.is_known = v is not None and error > 0
        if self.is_known:
            expected = pressure.velocity(info, one.nx, one.ny, state)
            self.common, self.bare = pressure.error(info, state), v / pressure.of_fields(
                info.density
            )
            self.ratio, self.error = v / expected, error / expected
            self.wide = WIDER * self.error


class Boxes:
    """All runs, with the pressures of part 17."""

    def __init__(self, bags):
        self.densities, *smallest, aspect, dense, self.others, (self.dilute,) = bags
        known = [(one.density, one.z) for one in map(gas.State, self.densities) if one.gas]
        henderson = equation.compressibility
        self.state = pressure.Equation(
            [
                (at, z / float(henderson(at)), error / float(henderson(at)))
                for at, (z, error) in known
                if error >= 0
            ]
        )
        every = sum([*smallest, *aspect], [])
        self.smallest = _by_boundary(sum(smallest, []))
        self.boxes = {0.4: _by_boundary(every), 0.8: _by_boundary(dense)}

    def waves(self, bags):
        """That are known with an error."""
        found = [Wave(bag, one, self.state) for bag in bags for one in rotation.read(bag).values()]
        return [one for one in found if one.is_known]

    def group(self, density, boundary):
        """Waves: each run of them has its own trajectory."""
        return self.waves(self.boxes[density][boundary])

    def t_runs(self, density, boundary):
        """At 0.4 those of part 9, which have T steps at many k in each box."""
        return self.smallest[boundary] if density == 0.4 else self.boxes[density][boundary]


def _by_boundary(bags):
    walls = [bag for bag in bags if 'reflecting' in (bag.info.boundary_x, bag.info.boundary_y)]
    return {PERIODIC: [bag for bag in bags if bag not in walls], WALLS: walls}


def of_boxes(found):
    """Each box as one point on the line: weighted means of k and of both ratios."""
    for run in dict.fromkeys(one.run for one in found):
        ones = [one for one in found if one.run == run]
        weights = np.array([one.wide**-2 for one in ones])
        values = [(one.k, one.ratio, one.bare) for one in ones]
        mean = np.average(values, axis=0, weights=weights)
        yield Box(run, *mean, float(weights.sum() ** -0.5))


def curve(found, which='ratio'):
    """Of v over that of the pressure, c + c2 k, as omega = c k + c2 k^2; None of too few waves."""
    if dispersion.number_of([one.k for one in found]) < 2:
        return None
    k, ratios, errors = np.array([(one.k, getattr(one, which), one.wide) for one in found]).T
    return dispersion.Curve(k, k * ratios, k * errors)


# ---- rows ----------------------------------------------------------------------------------------


def _mean(name, found):
    """Row of the weighted mean of v over that of the pressure."""
    quantity, value, remark = f'v over P / (sqrt 2 rho), {name}', UNKNOWN, ''
    if found:
        value, error, _ = averages.weighted(*zip(*[(one.ratio, one.error) for one in found]))
        value = value, float(np.hypot(error, value * max(one.common for one in found)))
        remark = f'waves: {len(found)}, boxes: {len({one.run for one in found})}'
    return Row(quantity, 1.0, *value, remark=remark)


def all_densities(bags):
    boxes = Boxes(bags)
    for bag in boxes.densities:
        yield _mean(f'density {bag.info.density:.1f}', boxes.waves([bag]))


def one_curve(bags, boundary):
    quantity = f'v of boxes at density 0.4, {boundary}, about their line'
    found = Boxes(bags).group(0.4, boundary)
    boxes = list(of_boxes(found))
    fitted = curve(boxes)
    if fitted is None or not fitted.freedom:
        return [Scatter(quantity)]
    errors = [100 * box.wide / box.ratio for box in boxes]
    off = [(box.ratio - fitted.at(box.k)[0] / box.k) / box.wide for box in boxes]
    far = int(np.argmax(np.abs(off)))
    remark = (
        f'{len(found)} waves of {len(boxes)} boxes; farthest {boxes[far].run}, {off[far]:+.1f} '
        f'errors; of v alone {curve(boxes, "bare").chi2:.1f}'
    )
    return [Scatter(quantity, fitted.chi2, fitted.freedom, errors, remark)]


def limit(bags, boundary):
    for density, published in AT_ZERO.items():
        found = Boxes(bags).group(density, boundary)
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
        both = [Boxes(bags).group(density, boundary) for boundary in COLOURS]
        ks = [[one.k for one in ones] for ones in both]
        spans = [(min(k), max(k)) if k else None for k in ks]
        found = points.above([curve(ones) for ones in both], spans)
        if found:
            row.measured, row.error, *ends = found
            row.remark = 'mean of the lines from k = {:.3f} to {:.3f}'.format(*ends)
        yield row


def other_shapes(bags):
    """Of the longest waves."""
    boxes = Boxes(bags)
    for bag in boxes.others:
        found = boxes.waves([bag])
        least = min((one.k for one in found), default=0.0) * (1 + SAME)
        yield _mean(bag.name.replace('_', ' '), [one for one in found if one.k <= least])


def walls(bags):
    boxes = Boxes(bags)
    yield _mean('walls at 0.2', boxes.waves([boxes.dilute]))
    for density in AT_ZERO:
        yield _mean(f'walls at {density:g}', boxes.group(density, WALLS))


def denser(bags):
    """Of T steps, beside what the density inside would make of them."""
    for density in AT_ZERO:
        runs = [Boxes(bags).t_runs(density, boundary) for boundary in COLOURS]
        of_runs = [[(bag.info, points.every(bag.recording, 'T')) for bag in some] for some in runs]
        both = [[point for _, some in ones for point in some] for ones in of_runs]
        found = points.above(*[[of(one) for one in both] for of in (points.curve, points.span)])
        quantity = f'lambda_T: walls over periodic at equal k, less 1, density {density:g}'
        row = Row(quantity, 0.0, unit='%')
        if found:
            infos = [info for info, known in of_runs[1] if known]
            row.published = float(np.mean([higher(info) for info in infos]))
            row.left_open = 0.5 * row.published
            row.measured, row.error, *ends = found
            inside = ', '.join(sorted({f'{pressure.inside(info):.3f}' for info in infos}))
            fits = 'mean of the fits from k = {:.3f} to {:.3f}'.format(*ends)
            row.remark = f'{fits}; density inside {inside}'
        yield row


def higher(info):
    """Percent by which the paper's c_T is, at the density inside."""
    return 100 * (paper.slope_t(pressure.inside(info)) / paper.slope_t(info.density) - 1)


def picture(bags):
    boxes = Boxes(bags)
    found = {(at, one): boxes.group(at, one) for at in AT_ZERO for one in COLOURS}
    if not any(found.values()):
        return None
    figure, panels = draw.panels(1, 2, (7.6, 3.6), sharey=True)
    draw.letters(panels, [f' density {density:g}' for density in AT_ZERO])
    for axes, density in zip(panels, AT_ZERO):
        axes.axhline(1, color=GREY, linewidth=0.6)
        for boundary, colour in COLOURS.items():
            _line(axes, found[density, boundary], colour, boundary)
        axes.set_xlim(left=0)
        axes.set_xlabel(r'wave number $k$  [1/$\sigma$]')
    panels[0].set_ylabel(r'$v\,/\,(P/\sqrt{2}\rho)$')
    draw.legend(panels[0], loc='lower right')
    return figure


def _line(axes, found, colour, label):
    known = [(one.k, one.ratio, one.error) for one in found]
    draw.bars(axes, known, 'o', colour, label, markersize=3, elinewidth=0.8, capsize=0)
    fitted = curve(found)
    if fitted is not None:
        along = np.array([0.0, max(one.k for one in found)])
        axes.plot(along, fitted.c + fitted.c2 * along, color=colour, linewidth=0.8)
