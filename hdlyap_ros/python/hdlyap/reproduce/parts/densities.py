"""Part 8: slopes of the branches and velocity of the LP dynamics against the density."""

from math import hypot, isfinite

import numpy as np

from hdlyap.plots import paper, steps
from hdlyap.plots.figures.style import GREEN, GREY, KIND_COLOURS, plt
from hdlyap.plots.numbers import with_error

from .. import averages, crossing, relations, scales, slopes, velocity
from ..row import ABOVE, EQUAL, INFERRED, Claim, Row

TITLE = 'Slopes c_T, c_L and velocity v against the density, 780 disks, periodic'
RUNS = tuple(f'density_{tenths:02d}' for tenths in range(1, 9))
CLOSE_BELOW = 0.6  # density: v is close to c_L well below it
WITHIN = f'within {100 * paper.FIT_ACCURACY:g} %'
UNIT = 'sigma/time unit'
FITS = {'T': paper.slope_t, 'LP': paper.slope_l}
SYMBOLS = {'T': 'c_T', 'LP': 'c_L'}
BESIDE = 0.005  # density: so that error bars can be seen beside each other
FEWEST = 4  # densities for a mean
EDGE = 1e-6  # relative: densities that are one


def runs(plan):
    return RUNS


class Measured:
    """One density: the steps T(1,0) and LP(1,0), None if not found, and the phases."""

    def __init__(self, recording):
        self.density = recording.info.density
        self.branch = {'T': _step(recording, steps.T), 'LP': _step(recording, steps.LP)}
        self.v, self.v_error, self.phases = slopes.velocity(recording, 1, 0)
        message = recording.steps
        self.v_all = (
            (message.v, message.v_error, message.v_phases) if message else (np.nan, np.nan, 0)
        )

    @property
    def ratio(self):
        """(v / c_L, its error); NaN if one of them is unknown."""
        lp = self.branch['LP']
        if lp is None or lp.error < 0 or not isfinite(self.v_error):
            return np.nan, np.nan
        return averages.quotient((self.v, self.v_error), (lp.slope, lp.slope_error))


def _step(recording, kind):
    return slopes.find(recording, kind, 1, 0) or slopes.by_index(recording, kind, 1, 0)


def _all(bags):
    return [Measured(bags[name].recording) for name in RUNS]


# ---- rows ----------------------------------------------------------------------------------------


def claims(bags):
    found = _all(bags)
    for kind, symbol in SYMBOLS.items():
        yield Claim(
            f'{symbol} follows the paper\'s fit',
            [*(_slope_row(kind, one) for one in found), _mean_row(kind, found)],
            f'{WITHIN}; on average as well as the scatter of the densities tells',
            values=sum(one.branch[kind] is not None for one in found),
        )
    yield Claim(
        'v is close to c_L well below density 0.6',
        [_ratio_row(one, EQUAL) for one in found if one.density < CLOSE_BELOW * (1 - EDGE)],
        WITHIN,
    )
    yield Claim(
        'v is above c_L beyond density 0.6',
        [_ratio_row(one, ABOVE) for one in found if one.density > CLOSE_BELOW * (1 + EDGE)],
        'above 1 by 3 standard errors',
        INFERRED,
    )
    yield Claim(
        'c_T = c_L at the density at which the fits cross',
        [_crossing_row(found)],
        f'where fits that are off by {100 * paper.FIT_ACCURACY:g} % cross',
    )
    yield from relations.claims(_triples(found), paper.FIT_ACCURACY)
    yield Claim('velocity', list(_beside(found)))


def _triples(found):
    """{what: (c_L, its error, what, its error) of the densities at which both are known}"""
    return {
        'c_T': [
            (lp.slope, lp.slope_error, t.slope, t.slope_error)
            for lp, t in ((one.branch['LP'], one.branch['T']) for one in found)
            if slopes.own([lp]) and slopes.own([t])
        ],
        'v': [
            (one.branch['LP'].slope, one.branch['LP'].slope_error, one.v, one.v_error)
            for one in found
            if slopes.own([one.branch['LP']]) and one.phases and isfinite(one.v_error)
        ],
    }


def _beside(found):
    for one in found:
        yield _velocity_row(one)
    for one in found:
        if abs(one.density / CLOSE_BELOW - 1) <= EDGE:
            yield _ratio_row(one, None)


def _mean_row(kind, found):
    """Of all densities together; the error is from their scatter, the fit's own among it."""
    off = [
        100 * (one.branch[kind].slope / FITS[kind](one.density) - 1)
        for one in found
        if one.branch[kind]
    ]
    quantity, telling = f'{SYMBOLS[kind]} over its fit, less 1, mean', 100 * paper.FIT_ACCURACY
    if len(off) < FEWEST:
        return Row(quantity, 0.0, unit='%', telling=telling)
    mean, error = averages.of_snapshots(off)
    return Row(quantity, 0.0, float(mean), float(error), unit='%', telling=telling)


def _slope_row(kind, one):
    point, fitted = one.branch[kind], FITS[kind](one.density)
    quantity = f'{SYMBOLS[kind]} at density {one.density:.1f}'
    if point is None:
        return Row(quantity, fitted, None, 0.0, paper.FIT_ACCURACY * fitted, UNIT)
    return Row(
        quantity,
        fitted,
        point.slope,
        point.slope_error,
        paper.FIT_ACCURACY * fitted,
        UNIT,
        '; '.join(
            filter(None, (f'{100 * (point.slope / fitted - 1):+.1f} % of the fit', point.remark))
        ),
    )


def _velocity_row(one):
    v, error, count = one.v_all
    remark = [f'{one.phases} phases of LP(1,0)']
    if count:
        over = v / velocity.of_fields(one.density)
        remark.append(f'all {count} phases: {with_error(v, error)}, {over:.3f} Z / sqrt(2)')
    return Row(
        f'v at density {one.density:.1f}',
        None,
        one.v if one.phases else None,
        one.v_error,
        unit=UNIT,
        remark='; '.join(remark) if one.phases else '',
    )


def _ratio_row(one, sense):
    """Beside 1, or as its limit; without a sense only shown."""
    ratio, error = one.ratio
    return Row(
        f'v / c_L at density {one.density:.1f}',
        None if sense is None else 1.0,
        ratio if isfinite(ratio) else None,
        error,
        paper.FIT_ACCURACY if sense == EQUAL else 0.0,
        sense=sense or EQUAL,
    )


def _crossing_row(found):
    place, (low, high) = crossing.of_fits(), crossing.of_fits_between()
    both = [one for one in found if all(point and point.error > 0 for point in one.branch.values())]
    measured, error = (
        crossing.measured(*zip(*[_apart(one) for one in both])) if len(both) > 1 else (None, 0.0)
    )
    remark = (
        f'the paper\'s fits +-{100 * paper.FIT_ACCURACY:g} % cross anywhere '
        f'from {low:.2f} to {high:.2f}'
    )
    shared = slopes.noted([point for one in both for point in one.branch.values()])
    return Row(
        'c_T = c_L at density',
        place,
        measured,
        error,
        max(place - low, high - place),
        '1/sigma^2',
        '; '.join(filter(None, (remark, shared and f'{2 * len(both)} slopes, {shared}'))),
    )


def _apart(one):
    """(density, c_L - c_T, its error)"""
    t, lp = one.branch['T'], one.branch['LP']
    return one.density, lp.slope - t.slope, hypot(lp.slope_error, t.slope_error)


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    found = _all(bags)
    if any(one.branch['T'] or one.branch['LP'] for one in found):
        yield 'densities', _figure(found)


def _figure(found):
    figure = plt.figure(figsize=(7.6, 4.4), constrained_layout=True)
    grid = figure.add_gridspec(2, 2, height_ratios=[3, 1.1], width_ratios=[1.1, 1])
    slope = figure.add_subplot(grid[0, 0])
    deviation = figure.add_subplot(grid[1, 0], sharex=slope)
    _against_density(slope, found)
    _deviations(deviation, found)
    _against_c_l(figure.add_subplot(grid[:, 1]), found)
    figure.suptitle(f'$N={paper.DISKS}$, $L_y/L_x={paper.ASPECT}$, periodic', fontsize=9)
    return figure


def _against_density(axes, found):
    density = np.linspace(0, 0.85, 200)
    for kind, fit in FITS.items():
        colour = KIND_COLOURS[kind]
        published = fit(density)
        axes.fill_between(
            density,
            (1 - paper.FIT_ACCURACY) * published,
            (1 + paper.FIT_ACCURACY) * published,
            color=colour,
            alpha=0.2,
            linewidth=0,
            label=f'${SYMBOLS[kind]}$, fit of Eckmann et al. $\\pm3$ %',
        )
        values = [
            (one.density, one.branch[kind].slope, one.branch[kind].slope_error)
            for one in found
            if one.branch[kind]
        ]
        _points(axes, values, 'o' if kind == 'T' else 's', colour, f'${SYMBOLS[kind]}$')
    _points(
        axes,
        [(one.density, one.v, one.v_error) for one in found if one.phases],
        '^',
        GREEN,
        '$v$',
        face='none',
        markersize=6,
    )
    axes.set_xlim(0, 0.85)
    axes.set_ylim(bottom=0)
    axes.tick_params(labelbottom=False)
    axes.set_ylabel(r'$c_T$, $c_L$, $v$  [$\sigma$/time unit]')
    axes.legend(loc='upper left')
    axes.set_title('(a)', loc='left')


def _points(axes, values, marker, colour, label, face=None, markersize=4):
    if values:
        x, y, error = zip(*values)
        axes.errorbar(
            x,
            y,
            _shown(error),
            fmt=marker,
            color=colour,
            markerfacecolor=face or colour,
            elinewidth=0.9,
            markersize=markersize,
            capsize=2,
            label=label,
        )


def _shown(errors):
    """Lengths of bars: none where the error is not known."""
    return np.maximum(0, np.nan_to_num(errors))


def _deviations(axes, found):
    bound = 100 * paper.FIT_ACCURACY
    axes.axhspan(-bound, bound, color=GREY, alpha=0.2, linewidth=0)
    axes.axhline(0, color=GREY, linewidth=0.6)
    for (kind, fit), side in zip(FITS.items(), (-BESIDE, BESIDE)):
        values = [
            (
                one.density + side,
                100 * (one.branch[kind].slope / fit(one.density) - 1),
                100 * one.branch[kind].slope_error / fit(one.density),
            )
            for one in found
            if one.branch[kind]
        ]
        _points(axes, values, 'o' if kind == 'T' else 's', KIND_COLOURS[kind], '_')
    axes.set_xlabel(r'density $\rho$  [1/$\sigma^2$]')
    axes.set_ylabel('deviation from\nthe fit  [%]')


def _against_c_l(axes, found):
    found = [one for one in found if one.branch['LP']]
    largest = 1.08 * max(
        [one.branch['LP'].slope for one in found] + [one.v for one in found if one.phases],
        default=1.0,
    )
    axes.plot([0, largest], [0, largest], color=GREY, linewidth=0.8, label='diagonal')
    _points(
        axes,
        [
            (one.branch['LP'].slope, one.branch['T'].slope, one.branch['T'].slope_error)
            for one in found
            if one.branch['T']
        ],
        'o',
        KIND_COLOURS['T'],
        '$c_T$',
    )
    _points(
        axes,
        [(one.branch['LP'].slope, one.v, one.v_error) for one in found if one.phases],
        '^',
        GREEN,
        '$v$',
    )
    axes.set_xlim(0, largest)
    axes.set_ylim(0, largest)
    axes.set_xlabel(r'$c_L$  [$\sigma$/time unit]')
    axes.set_ylabel(r'$c_T$, $v$  [$\sigma$/time unit]')
    axes.legend(loc='upper left')
    axes.set_title('(b)', loc='left')


def tables(bags):
    header = (
        'density',
        'c_t',
        'c_t_error',
        'c_t_fit',
        'c_l',
        'c_l_error',
        'c_l_fit',
        'v',
        'v_error',
        'v_all',
        'v_all_error',
    )
    found = _all(bags)
    yield 'densities', header, [_line(one) for one in found]
    yield 'scales', scales.HEADER, [
        scales.line(one.density, one.v if one.phases else None, _wave_numbers(bags[name].recording))
        for name, one in zip(RUNS, found)
    ]


def _wave_numbers(recording):
    """Of the resolved T and LP steps."""
    found = steps.resolved(recording.steps).values()
    return [step.wave_number for step in found if step.kind in (steps.T, steps.LP)]


def _line(one):
    line = [f'{one.density:g}']
    for kind, fit in FITS.items():
        point = one.branch[kind]
        line += [f'{point.slope:.6g}', f'{point.slope_error:.2g}'] if point else ['', '']
        line.append(f'{fit(one.density):.6g}')
    line += [f'{one.v:.6g}', f'{one.v_error:.2g}'] if one.phases else ['', '']
    v, error, count = one.v_all
    return line + ([f'{v:.6g}', f'{error:.2g}'] if count else ['', ''])
