"""Part 8: slopes of the branches and velocity of the LP dynamics against the density."""

from math import hypot, isfinite

import numpy as np

from hdlyap.data import steps
from hdlyap.plots import paper
from hdlyap.plots.figures.style import GREEN, GREY, KIND_COLOURS, plt
from hdlyap.numbers import with_error

from .. import averages, crossing, draw, relations, scales, slopes, velocity
from ..files import cells
from ..row import ABOVE, BELOW, Row

RUNS = tuple(f'density_{tenths:02d}' for tenths in range(1, 9))
CLOSE_BELOW = 0.6  # density: v is close to c_L well below it
UNIT = 'sigma/time unit'
FITS = {'T': paper.slope_t, 'LP': paper.slope_l}
SYMBOLS = {'T': 'c_T', 'LP': 'c_L'}
MARKERS = {'T': 'o', 'LP': 's'}
BESIDE = 0.005  # density: so that error bars can be seen beside each other
FEWEST = 4  # densities for a mean
EDGE = 1e-6  # relative: densities that are one


class Measured:
    """One density: the steps T(1,0) and LP(1,0), None if not found, and the phases."""

    def __init__(self, recording):
        self.density = recording.info.density
        self.branch = {'T': _step(recording, steps.T), 'LP': _step(recording, steps.LP)}
        self.v, self.v_error, self.phases = slopes.velocity(recording, 1, 0)
        message = recording.steps
        unknown = np.nan, np.nan, 0
        self.v_all = (message.v, message.v_error, message.v_phases) if message else unknown

    @property
    def has_both(self):
        """c_L and v, each with its error."""
        lp = self.branch['LP']
        return lp is not None and lp.error >= 0 and isfinite(self.v_error)

    @property
    def ratio(self):
        """(v / c_L, its error)"""
        lp = self.branch['LP']
        return averages.quotient((self.v, self.v_error), (lp.slope, lp.slope_error))

    @property
    def apart(self):
        """(c_L - c_T, its error); None if one of them is not known."""
        t, lp = self.branch['T'], self.branch['LP']
        if not all(point and point.error > 0 for point in (t, lp)):
            return None
        return lp.slope - t.slope, hypot(lp.slope_error, t.slope_error)


def _step(recording, kind):
    return slopes.find(recording, kind, 1, 0) or slopes.by_index(recording, kind, 1, 0)


def _all(bags):
    return [Measured(bags[name].recording) for name in RUNS]


# ---- rows ----------------------------------------------------------------------------------------


def slopes_of(bags, kind):
    found = _all(bags)
    return [*(_slope_row(kind, one) for one in found), _mean_row(kind, found)]


def _slope_row(kind, one):
    point, fitted = one.branch[kind], FITS[kind](one.density)
    row = Row(f'{SYMBOLS[kind]} at density {one.density:.1f}', fitted, unit=UNIT)
    if point is not None:
        row.measured, row.error = point.slope, point.slope_error
        off = f'{100 * (point.slope / fitted - 1):+.1f} % of the fit'
        row.remark = '; '.join(filter(None, (off, point.remark)))
    return row


def _mean_row(kind, found):
    """Of all densities together; the error is from their scatter, the fit's own among it."""
    off = [
        100 * (one.branch[kind].slope / FITS[kind](one.density) - 1)
        for one in found
        if one.branch[kind]
    ]
    exactly = {'left_open': 0.0, 'telling': 100 * paper.FIT_ACCURACY, 'count': 0}
    row = Row(f'{SYMBOLS[kind]} over its fit, less 1, mean', 0.0, unit='%', **exactly)
    if len(off) >= FEWEST:
        row.measured, row.error = map(float, averages.of_snapshots(off))
    return row


def close(bags):
    """v - c_L below CLOSE_BELOW."""
    for one in _all(bags):
        if one.density < CLOSE_BELOW * (1 - EDGE):
            row = Row(f'v - c_L at density {one.density:.1f}', 0.0, unit=UNIT)
            if one.has_both:
                lp = one.branch['LP']
                row.measured, row.error = one.v - lp.slope, hypot(one.v_error, lp.slope_error)
                row.remark = f'v / c_L {with_error(*one.ratio)}'
            yield row


def above(bags):
    found = [one for one in _all(bags) if one.density > CLOSE_BELOW * (1 + EDGE)]
    return [_ratio_row(one) for one in found]


def _ratio_row(one):
    ratio = one.ratio if one.has_both else (None, 0.0)
    return Row(f'v / c_L at density {one.density:.1f}', None, *ratio)


def cross(bags):
    """c_T less c_L: above zero where the fits' is, below where that is."""
    for one in _all(bags):
        published = ABOVE if FITS['T'](one.density) > FITS['LP'](one.density) else BELOW
        row = Row(f'c_T - c_L at density {one.density:.1f}', 0.0, unit=UNIT, sense=published)
        if one.apart:
            row.measured, row.error = -one.apart[0], one.apart[1]
            row.remark = f'{row.measured / row.error:+.0f} standard errors'
        yield row


def straight(bags):
    return relations.straight(_triples(_all(bags)))


def beside(bags):
    found = _all(bags)
    yield _crossing_row(found)
    yield from relations.beside(_triples(found))
    for one in found:
        yield _velocity_row(one)
    for one in found:
        if abs(one.density / CLOSE_BELOW - 1) <= EDGE:
            yield _ratio_row(one)


def _triples(found):
    """{what: (c_L, its error, what, its error) of the densities at which both are known}"""
    known = [one for one in found if slopes.own([one.branch['LP']])]
    return {
        'c_T': [
            (*_of(one.branch['LP']), *_of(one.branch['T']))
            for one in known
            if slopes.own([one.branch['T']])
        ],
        'v': [
            (*_of(one.branch['LP']), one.v, one.v_error)
            for one in known
            if one.phases and isfinite(one.v_error)
        ],
    }


def _of(point):
    return point.slope, point.slope_error


def _velocity_row(one):
    row = Row(f'v at density {one.density:.1f}', None, one.v if one.phases else None, one.v_error)
    row.unit, (v, error, count) = UNIT, one.v_all
    remark = [f'{one.phases} phases of LP(1,0)']
    if count:
        over = v / velocity.of_fields(one.density)
        remark.append(f'all {count} phases: {with_error(v, error)}, {over:.3f} Z / sqrt(2)')
    row.remark = '; '.join(remark) if one.phases else ''
    return row


def _crossing_row(found):
    both = [one for one in found if one.apart]
    row = Row('density at which c_T = c_L', unit='1/sigma^2')
    if len(both) > 1:
        points = [(one.density, *one.apart) for one in both]
        row.measured, row.error = crossing.measured(*zip(*points))
    low, high = crossing.of_fits_between()
    accuracy = f'{100 * paper.FIT_ACCURACY:g} %'
    row.remark = (
        f'the fits cross at {crossing.of_fits():.3f}, +-{accuracy} anywhere '
        f'from {low:.2f} to {high:.2f}'
    )
    shared = slopes.noted([point for one in both for point in one.branch.values()])
    if shared:
        row.remark += f'; {2 * len(both)} slopes, {shared}'
    return row


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    found = _all(bags)
    if any(one.branch['T'] or one.branch['LP'] for one in found):
        yield 'densities', _figure(found)


def _figure(found):
    figure = plt.figure(figsize=(7.6, 4.4), constrained_layout=True)
    grid = figure.add_gridspec(2, 2, height_ratios=[3, 1.1], width_ratios=[1.1, 1])
    slope = figure.add_subplot(grid[0, 0])
    off, right = figure.add_subplot(grid[1, 0], sharex=slope), figure.add_subplot(grid[:, 1])
    _against_density(slope, found)
    _deviations(off, found)
    _against_c_l(right, found)
    draw.letters((slope, right))
    figure.suptitle(f'$N={paper.DISKS}$, $L_y/L_x={paper.ASPECT}$, periodic', fontsize=9)
    return figure


def _points(found, of):
    return [(one.density, *of(one)) for one in found if of(one)]


def _known(point):
    return point and _of(point)


def _velocity(one):
    return (one.v, one.v_error) if one.phases else None


def _against_density(axes, found):
    density = np.linspace(0, 0.85, 200)
    for kind, fit in FITS.items():
        colour, symbol = KIND_COLOURS[kind], f'${SYMBOLS[kind]}$'
        label = f'{symbol}, fit of Eckmann et al. $\\pm3$ %'
        draw.band(axes, density, fit(density), paper.FIT_ACCURACY, colour, alpha=0.2, label=label)
        points = _points(found, lambda one, k=kind: _known(one.branch[k]))
        draw.bars(axes, points, MARKERS[kind], colour, symbol)
    velocities = _points(found, _velocity)
    draw.bars(axes, velocities, '^', GREEN, '$v$', markerfacecolor='none', markersize=6)
    axes.set(xlim=(0, 0.85), ylabel=r'$c_T$, $c_L$, $v$  [$\sigma$/time unit]')
    axes.set_ylim(bottom=0)
    axes.tick_params(labelbottom=False)
    axes.legend(loc='upper left')


def _deviations(axes, found):
    bound = 100 * paper.FIT_ACCURACY
    axes.axhspan(-bound, bound, color=GREY, alpha=0.2, linewidth=0)
    axes.axhline(0, color=GREY, linewidth=0.6)
    for (kind, fit), side in zip(FITS.items(), (-BESIDE, BESIDE)):
        points = [
            (at + side, 100 * (slope / fit(at) - 1), 100 * error / fit(at))
            for at, slope, error in _points(found, lambda one, k=kind: _known(one.branch[k]))
        ]
        draw.bars(axes, points, MARKERS[kind], KIND_COLOURS[kind])
    axes.set(xlabel=r'density $\rho$  [1/$\sigma^2$]', ylabel='deviation from\nthe fit  [%]')


def _against_c_l(axes, found):
    found = [one for one in found if one.branch['LP']]
    values = [one.branch['LP'].slope for one in found] + [one.v for one in found if one.phases]
    largest = 1.08 * max(values, default=1.0)
    axes.plot([0, largest], [0, largest], color=GREY, linewidth=0.8, label='diagonal')
    t = [(one.branch['LP'].slope, *_of(one.branch['T'])) for one in found if one.branch['T']]
    draw.bars(axes, t, 'o', KIND_COLOURS['T'], '$c_T$')
    v = [(one.branch['LP'].slope, one.v, one.v_error) for one in found if one.phases]
    draw.bars(axes, v, '^', GREEN, '$v$', markerfacecolor='none')
    axes.set(xlim=(0, largest), ylim=(0, largest))
    axes.set(xlabel=r'$c_L$  [$\sigma$/time unit]', ylabel=r'$c_T$, $v$  [$\sigma$/time unit]')
    axes.legend(loc='upper left')


def tables(bags):
    found = _all(bags)
    names = 'c_t', 'c_t_error', 'c_t_fit', 'c_l', 'c_l_error', 'c_l_fit', 'v', 'v_error', 'v_all'
    yield 'densities', ('density', *names, 'v_all_error'), [_line(one) for one in found]
    yield 'scales', scales.HEADER, [
        scales.line(one.density, one.v if one.phases else None, _wave_numbers(bags[name].recording))
        for name, one in zip(RUNS, found)
    ]


def _wave_numbers(recording):
    """Of the resolved T and LP steps."""
    found = steps.resolved(recording.steps).values()
    return [step.wave_number for step in found if step.kind in (steps.T, steps.LP)]


def _line(one):
    numbers = []
    for kind, fit in FITS.items():
        numbers += [*(_of(one.branch[kind]) if one.branch[kind] else (None, None))]
        numbers.append(fit(one.density))
    v, error, count = one.v_all
    numbers += [*(_velocity(one) or (None, None)), *((v, error) if count else (None, None))]
    return cells('g' + 2 * ' .6g .2g .6g' + 2 * ' .6g .2g', one.density, *numbers)
