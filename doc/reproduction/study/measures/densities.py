"""Slopes of the branches and velocity of the LP dynamics against the density: of the step of (1,0)
of each run."""

from math import isfinite, sqrt

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import brentq

from hdlyap.numbers import with_error
from hdlyap.plots import equation, paper
from hdlyap.plots.figures.style import GREEN, GREY, KIND_COLOURS

from .. import averages, draw, points
from ..averages import UNKNOWN
from ..bags import once
from ..points import SYMBOLS
from ..polynomials import Polynomial, crossing
from ..row import ABOVE, BELOW, Row

CLOSE_BELOW = 0.6  # density: v is close to c_L well below it
UNIT = 'sigma/time unit'
FITS = {'T': paper.slope_t, 'LP': paper.slope_l}
MARKERS = {'T': 'o', 'LP': 's'}
BESIDE = 0.005  # density: so that error bars can be seen beside each other
FEWEST = 4  # densities for a mean
EDGE = 1e-6  # relative: densities that are one


class Density:
    """Of one run. branch: its steps, None if not found; v: of LP(1,0), with its error; v_all: of
    all phases, with their number."""

    def __init__(self, bag):
        recording = bag.recording
        self.density, message = recording.info.density, recording.steps
        self.branch = {kind: points.first(recording, kind) for kind in FITS}
        *self.v, self.phases = points.velocity(recording, 1, 0)
        self.moves = self.phases and isfinite(self.v[1])
        self.v_all = (message.v, message.v_error, message.v_phases) if message else (*UNKNOWN, 0)

    def slope(self, kind):
        return self.branch[kind].slope if self.branch[kind] else UNKNOWN

    def beside_c_l(self, of):
        """v beside c_L, where both errors are known."""
        lp = self.branch['LP']
        return of(self.v, lp.slope) if lp and lp.error >= 0 and isfinite(self.v[1]) else UNKNOWN

    @property
    def ratio(self):
        """(v / c_L, its error)"""
        return self.beside_c_l(averages.quotient)

    @property
    def apart(self):
        """(c_L - c_T, its error); None if one of them is not known."""
        if not all(point and point.error > 0 for point in self.branch.values()):
            return None
        return averages.difference(self.slope('LP'), self.slope('T'))


@once
def of(bag):
    return Density(bag)


# ---- rows ----------------------------------------------------------------------------------------


def slopes(bags, kind):
    """Beside the fit; then the mean of all densities: its error is from their scatter, the fit's
    own among it."""
    off = []
    for one in map(of, bags):
        fitted, remarks = FITS[kind](one.density), []
        measured, error = one.slope(kind)
        if measured:
            off.append(100 * (measured / fitted - 1))
            remarks = [f'{off[-1]:+.1f} % of the fit', one.branch[kind].remark]
        remark, quantity = '; '.join(filter(None, remarks)), f'at density {one.density:.1f}'
        yield Row(f'{SYMBOLS[kind]} {quantity}', fitted, measured, error, UNIT, remark)
    mean = averages.of_snapshots(off) if len(off) >= FEWEST else UNKNOWN
    exactly = {'left_open': 0.0, 'telling': 100 * paper.FIT_ACCURACY, 'count': 0}
    yield Row(f'{SYMBOLS[kind]} over its fit, less 1, mean', 0.0, *mean, '%', **exactly)


def close(bags):
    """v - c_L below CLOSE_BELOW."""
    for one in map(of, bags):
        if one.density < CLOSE_BELOW * (1 - EDGE):
            value = one.beside_c_l(averages.difference)
            remark = f'v / c_L {with_error(*one.ratio)}' if value[0] is not None else ''
            yield Row(f'v - c_L at density {one.density:.1f}', 0.0, *value, UNIT, remark)


def above(bags):
    return [_ratio(one) for one in map(of, bags) if one.density > CLOSE_BELOW * (1 + EDGE)]


def _ratio(one):
    return Row(f'v / c_L at density {one.density:.1f}', None, *one.ratio)


def cross(bags):
    """c_T less c_L: above zero where the fits' is, below where that is."""
    for one in map(of, bags):
        sense = ABOVE if FITS['T'](one.density) > FITS['LP'](one.density) else BELOW
        row = Row(f'c_T - c_L at density {one.density:.1f}', 0.0, unit=UNIT, sense=sense)
        if one.apart:
            row.measured, row.error = -one.apart[0], one.apart[1]
            row.remark = f'{row.measured / row.error:+.0f} standard errors'
        yield row


def straight(bags):
    """How far c_T and v over c_L are from a straight line."""
    for symbol, known in _over_c_l(bags).items():
        row = Row(f'{symbol} over c_L, farthest from its straight line', 0.0, unit='%')
        if len(known) >= 3:
            line, row.count = Polynomial(known, 1), len(known)
            place, row.measured, row.error = line.farthest()
            law = f'{symbol} = {float(line.at(0)):.3f} + {line.leading[0]:.3f} c_L'
            row.remark = f'at c_L = {place:.3f}; {law}'
        yield row


def _over_c_l(bags):
    """{what: (c_L, its error, what, its error) of the densities at which both are known}"""
    known = [one for one in map(of, bags) if points.own([one.branch['LP']])]
    t = [one for one in known if points.own([one.branch['T']])]
    return {
        'c_T': [(*one.slope('LP'), *one.slope('T')) for one in t],
        'v': [(*one.slope('LP'), *one.v) for one in known if one.moves],
    }


def beside(bags):
    found, over = list(map(of, bags)), _over_c_l(bags).items()
    yield _crossing(found)
    yield from (_curvature(*one) for one in over)
    yield from (_equal(*one) for one in over)
    yield from map(_velocity, found)
    yield from (_ratio(one) for one in found if abs(one.density / CLOSE_BELOW - 1) <= EDGE)


def _curvature(symbol, known):
    row = Row(f'curvature of {symbol} over c_L, coefficient of c_L^2', unit='time unit/sigma')
    if len(known) >= 4:
        parabola, off = Polynomial(known, 2), Polynomial(known, 1).chi2
        row.measured, row.error = parabola.leading
        chi2 = f'chi^2 {parabola.chi2:.0f} for {parabola.freedom}, {off:.0f} without it'
        row.remark = f'{chi2}; farthest {parabola.farthest()[1]:+.1f} %'
    return row


def _equal(symbol, known):
    """Where the difference c_L - c_T, or v - c_L, goes through zero from below."""
    value = UNKNOWN
    if len(known) >= 2:
        x, x_errors, y, y_errors = np.array(sorted(known)).T
        value = crossing(x, x - y if symbol == 'c_T' else y - x, np.hypot(x_errors, y_errors))
    return Row(f'c_L at which {symbol} = c_L', None, *value, UNIT)


def _velocity(one):
    (v, error, count), quantity = one.v_all, f'v at density {one.density:.1f}'
    if not one.phases:
        return Row(quantity, unit=UNIT)
    remark = [f'{one.phases} phases of LP(1,0)']
    if count:
        over = v * sqrt(2) / float(equation.compressibility(one.density))  # [T13]
        remark.append(f'all {count} phases: {with_error(v, error)}, {over:.3f} Z / sqrt(2)')
    return Row(quantity, None, *one.v, UNIT, '; '.join(remark))


def _crossing(found):
    both = [one for one in found if one.apart]
    apart = zip(*[(one.density, *one.apart) for one in both])
    value = crossing(*apart) if len(both) > 1 else UNKNOWN
    accuracy, remark = 100 * paper.FIT_ACCURACY, f'the fits cross at {_of_fits(0):.3f}'
    low, high = _of_fits(paper.FIT_ACCURACY), _of_fits(-paper.FIT_ACCURACY)
    remark += f', +-{accuracy:g} % anywhere from {low:.2f} to {high:.2f}'
    shared = points.noted([point for one in both for point in one.branch.values()])
    remark += f'; {2 * len(both)} slopes, {shared}' if shared else ''
    return Row('density at which c_T = c_L', None, *value, '1/sigma^2', remark)


def _of_fits(off):
    """Density from which on the paper's c_L is above its c_T, if they are off by this."""

    def apart(density):
        return (1 + off) * paper.slope_l(density) - (1 - off) * paper.slope_t(density)

    return brentq(apart, 0, paper.DENSITY)


# ---- picture -------------------------------------------------------------------------------------


def picture(bags):
    found = list(map(of, bags))
    if not any(point for one in found for point in one.branch.values()):
        return None
    figure = plt.figure(figsize=(7.6, 4.4), constrained_layout=True)
    grid = figure.add_gridspec(2, 2, height_ratios=[3, 1.1], width_ratios=[1.1, 1])
    slope = figure.add_subplot(grid[0, 0])
    off, right = figure.add_subplot(grid[1, 0], sharex=slope), figure.add_subplot(grid[:, 1])
    _against_density(slope, off, found)
    _against_c_l(right, found)
    draw.letters((slope, right))
    figure.suptitle(f'$N={paper.DISKS}$, $L_y/L_x={paper.ASPECT}$, periodic', fontsize=9)
    return figure


def _against_density(axes, below, found):
    density, bound = np.linspace(0, 0.85, 200), 100 * paper.FIT_ACCURACY
    below.axhspan(-bound, bound, color=GREY, alpha=0.2, linewidth=0)
    below.axhline(0, color=GREY, linewidth=0.6)
    for (kind, fit), side in zip(FITS.items(), (-BESIDE, BESIDE)):
        colour, symbol = KIND_COLOURS[kind], f'${SYMBOLS[kind]}$'
        label = f'{symbol}, fit of Eckmann et al. $\\pm3$ %'
        draw.band(axes, density, fit(density), paper.FIT_ACCURACY, colour, alpha=0.2, label=label)
        known = [(one.density, *one.slope(kind)) for one in found if one.branch[kind]]
        draw.bars(axes, known, MARKERS[kind], colour, symbol)
        off = [(x + side, 100 * (c / fit(x) - 1), 100 * error / fit(x)) for x, c, error in known]
        draw.bars(below, off, MARKERS[kind], colour)
    v = [(one.density, *one.v) for one in found if one.phases]
    draw.bars(axes, v, '^', GREEN, '$v$', markerfacecolor='none', markersize=6)
    axes.set(xlim=(0, 0.85), ylabel=r'$c_T$, $c_L$, $v$  [$\sigma$/time unit]')
    axes.set_ylim(bottom=0)
    axes.tick_params(labelbottom=False)
    axes.legend(loc='upper left')
    below.set(xlabel=r'density $\rho$  [1/$\sigma^2$]', ylabel='deviation from\nthe fit  [%]')


def _against_c_l(axes, found):
    found = [one for one in found if one.branch['LP']]
    c_l = [one.slope('LP')[0] for one in found]
    largest = 1.08 * max(c_l + [one.v[0] for one in found if one.phases], default=1.0)
    axes.plot([0, largest], [0, largest], color=GREY, linewidth=0.8, label='diagonal')
    t = [(x, *one.slope('T')) for x, one in zip(c_l, found) if one.branch['T']]
    draw.bars(axes, t, 'o', KIND_COLOURS['T'], '$c_T$')
    v = [(x, *one.v) for x, one in zip(c_l, found) if one.phases]
    draw.bars(axes, v, '^', GREEN, '$v$', markerfacecolor='none')
    axes.set(xlim=(0, largest), ylim=(0, largest))
    axes.set(xlabel=r'$c_L$  [$\sigma$/time unit]', ylabel=r'$c_T$, $v$  [$\sigma$/time unit]')
    axes.legend(loc='upper left')
