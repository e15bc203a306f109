#!/usr/bin/python3
"""Tables of the studies -> the pictures of doc/findings.md, and the fits that it quotes.

Usage: findings.py TABLE.csv.. of halves, sound, dilute, circle, spheres: prints the fits, draws
TABLE.png beside it.
"""

import csv
import math
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

GREY, INK = '#8C8C8C', '#1A1A1A'
# by density: Okabe and Ito's palette, safe for colour-blind readers
COLOURS = {0.1: '#56B4E9', 0.2: '#0072B2', 0.4: '#009E73', 0.6: '#E69F00', 0.8: '#D55E00'}
OTHERS = {0.03: '#0072B2', 0.01: '#009E73', 0.003: '#E69F00', 0.001: '#D55E00'}
STYLE = {
    'font.size': 9,
    'axes.titlesize': 9,
    'legend.fontsize': 8,
    'xtick.labelsize': 8,
    'ytick.labelsize': 8,
    'xtick.direction': 'in',
    'ytick.direction': 'in',
    'xtick.top': True,
    'ytick.right': True,
    'axes.linewidth': 0.7,
    'lines.linewidth': 1.2,
    'lines.markersize': 4,
    'legend.frameon': False,
    'figure.constrained_layout.use': True,
}
RATE = 'P_xx / (sqrt(2) rho)'  # of the rotation over k, as the pressure has it
EXPECTED, OVER = 'sqrt(1 - (h^2 + g^2) / x^2)', 'v over that of pressure and C'
PLACE = 'turn while a disk flies  $\\omega\\tau$  [rad]'
BAR = 3  # standard errors
WORDS = 'ends of x', 'boundaries', 'kind'  # columns of them
DILUTE = 0.01  # densities up to which B is a constant


def rows_of(path):
    """Columns by their names, without the units."""
    with open(path, encoding='utf-8') as file:
        rows = csv.reader(line for line in file if not line.startswith('#'))
        names = [name.partition(' [')[0] for name in next(rows)]
        return [
            {name: text if name in WORDS else float(text) for name, text in zip(names, row)}
            for row in rows
        ]


# ---- fits ---------------------------------------------------------------------------------------


def fit(values, errors, *columns):
    """Weighted least squares: coefficients, their errors, chi^2, degrees of freedom."""
    weight = 1 / np.array(errors)
    matrix = np.transpose(columns) * weight[:, None]
    inverse = np.linalg.inv(matrix.T @ matrix)
    found = inverse @ matrix.T @ (values * weight)
    chi2 = np.sum((values * weight - matrix @ found) ** 2)
    return found, np.sqrt(np.diag(inverse)), chi2, len(values) - len(found)


def told(title, found, errors, chi2, freedom):
    """One line of a fit."""
    numbers = '  '.join(f'{one:.4f} +- {error:.4f}' for one, error in zip(found, errors))
    return f'{title}: {numbers}  chi^2 {chi2:.1f} for {freedom}'


def limits(rows):
    """Lines in omega tau of v over that of the pressure, and of pressure and C: for each density,
    and with one limit for all of them."""
    densities = sorted({row['density'] for row in rows})
    for some in [*([d] for d in densities), densities]:
        few = [row for row in rows if row['density'] in some]
        if len(few) < len(some) + 3:
            continue
        slopes = [[turned(row) * (row['density'] == d) for row in few] for d in some]
        name = ', '.join(f'{d:g}' for d in some)
        for title, column, error, unit in (
            ('P', 'v', 'v error', [row[RATE] for row in few]),
            ('P and C', OVER, 'over error', np.ones(len(few))),
        ):
            values, errors = ([row[key] for row in few] / np.array(unit) for key in (column, error))
            line = fit(values, errors, np.ones(len(few)), *slopes)
            yield told(f'density {name}: v over that of {title} = a + b omega tau', *line)


def constant(rows):
    """B = a + b / N where the gas is dilute; nothing of one size of box."""
    some = [row for row in rows if row['density'] <= DILUTE]
    if len({row['disks'] for row in some}) < 2:
        return None
    values, errors = [b_of(row) for row in some], [2 * row['h_KS error'] for row in some]
    return fit(np.array(values), errors, np.ones(len(some)), [1 / row['disks'] for row in some])


def constants(rows):
    line = constant(rows)
    return [told('B = a + b / N', *line)] if line else []


def b_of(row):
    """2 h_KS / N nu + ln rho."""
    return 2 * row['h_KS / N over it'] + math.log(row['density'])


def ratios(rows):
    """Of the velocity of sound: over v, over that of the pressure, and as thermodynamics has it."""
    for row in rows:
        found = [row['sound'] / row[name] for name in ('v', RATE)]
        expected = row['sound of the pressure'] / row[RATE]
        relative = row['sound error'] / row['sound']
        errors = (
            found[0] * math.hypot(relative, row['v error'] / row['v']),
            found[1] * math.hypot(relative, row['P_xx error'] / row[RATE]),
            expected * row['of the pressure error'] / row['sound of the pressure'],
        )
        yield row, (*found, expected), errors


def sounds(rows):
    """A line for each box."""
    for row, found, errors in ratios(rows):
        numbers = '  '.join(f'{one:.4f} +- {error:.4f}' for one, error in zip(found, errors))
        box = "density {density:g}, height {height:g}, {disks:g} disks".format(**row)
        yield f"{box}: {numbers}"


# ---- halves of LP modes -------------------------------------------------------------------------


def turned(row):
    """Rotation in the time between two collisions of a disk."""
    return row['v'] * row['k'] * row['time between collisions']


def sources(row):
    """D = C^2 + C X - X C over the square of mean C: of L and P themselves, and between them."""
    g, h = row['difference / mean'], row['symmetric / mean']
    x = row[RATE] * row['k'] / row['mean C']
    mean, half = 1 + g * g + h * h, 2 * (g + x * h)
    return mean + half, mean - half, 2 * (h - x * g)


def draw_halves(rows):
    figure, ((angles, means), (rates, rest)) = plt.subplots(2, 2, figsize=(7.6, 5.8))
    _points(angles, rows, lambda row: row['angle'], 'angle', 'o')
    _points(angles, rows, lambda row: row['symmetric / mean'], 'symmetric', 's')
    _points(angles, rows, lambda row: row['difference / mean'], 'difference', '^')
    angles.axhline(0, color=GREY, linewidth=0.6)
    angles.set(
        ylabel='angle of dp [rad], and C beside a number',
        title='(a) mean angle, and the rest of C',
        ylim=(-0.16, 0.06),
    )
    for y, text in (
        (0.04, r'mean of the angle by which dp is ahead  [rad]'),
        (-0.02, r'$(c_{LL} - c_{PP})\,/\,2c$'),
        (-0.15, r'$(c_{LP} + c_{PL})\,/\,2c$: angle at L less the mean  [rad]'),
    ):
        angles.annotate(text, (0.004, y), fontsize=8)
    _points(means, rows, lambda row: row['mean C'] / row['lambda'], None, 'o')
    means.set(ylabel=r'mean C / $\lambda$', title='(b) length of dp', ylim=(0.5, 1.02))
    _points(rates, rows, lambda row: row['v'] / row[RATE], 'v', 'o')
    _points(rates, rows, lambda row: row[EXPECTED], None, '_')
    rates.axhline(1, color=GREY, linewidth=0.6)
    rates.plot([], [], 'o', color=INK, label='measured')
    rates.plot([], [], '_', color=INK, label=r'$(1 - (h^2 + g^2)/x^2)^{1/2}$')
    rates.legend(loc='lower left')
    rates.set(
        ylabel=r'$v \cdot \sqrt{2}\,\rho\, /\, P_{xx}$', title='(c) rotation', ylim=(0.93, 1.02)
    )
    for part, marker, text in ((0, 'v', '$D_{LL}$'), (1, '^', '$D_{PP}$'), (2, 's', '$D_{LP}$')):
        _points(rest, rows, lambda row, part=part: sources(row)[part], None, marker)
        rest.plot([], [], color=INK, marker=marker, linestyle='none', label=text)
    rest.axhline(0, color=GREY, linewidth=0.6)
    rest.set(ylabel=r'$D / c^2$', title='(d) source of dp from dq', ylim=(-0.3, 2))
    rest.legend(ncol=3, loc='upper right', columnspacing=0.8, handletextpad=0.1)
    for axes in (angles, means, rates, rest):
        axes.set(xlabel=PLACE, xlim=(0, 0.13))
        axes.set_title(axes.get_title(), loc='left')
        axes.set_title('')
    for density, colour in COLOURS.items():
        means.plot([], [], 'o', color=colour, label=rf'$\rho = {density:g}$')
    means.plot([], [], 'o', color=INK, markerfacecolor='white', label='walls')
    means.legend(ncol=2, loc='upper right')
    return figure


def _points(axes, rows, value, error, marker):
    """Open: waves between walls. error: what its column is called, if it is shown."""
    for row in rows:
        if not math.isfinite(value(row)):
            continue
        bar = BAR * row[f'{error} error'] if error else None
        if error == 'v':
            bar /= row[RATE]
        colour = COLOURS[row['density']]
        open_or_not = 'white' if row['ends of x'] == 'reflecting' else colour
        axes.errorbar(
            turned(row),
            value(row),
            yerr=bar,
            color=colour,
            marker=marker,
            markerfacecolor=open_or_not,
            elinewidth=0.7,
            linestyle='none',
        )


# ---- sound, dilute gases ------------------------------------------------------------------------


def draw_sound(rows):
    """Of sound over LP modes, measured and as pressures have it. Bars: one standard error. Marks
    of a box are a little apart along k, to be seen."""
    figure, axes = plt.subplots(figsize=(4.8, 3.3))
    kinds = ('o', r'$c_s / v$'), ('s', r'$c_s \sqrt{2} \rho / P$'), ('x', 'of the pressures')
    for row, found, errors in ratios(rows):
        colour, narrow = COLOURS[row['density']], row['height'] < 2
        for place, (marker, _) in enumerate(kinds):
            axes.errorbar(
                row['k'] + 0.001 * (place - 1),
                found[place],
                yerr=errors[place],
                color=colour,
                marker=marker,
                markerfacecolor=colour if narrow else 'white',
                elinewidth=0.7,
                linestyle='none',
            )
    for marker, text in kinds:
        axes.plot([], [], marker, color=INK, label=text)
    axes.plot([], [], 'o', color=INK, markerfacecolor='white', label='not in a row')
    for density in sorted({row['density'] for row in rows}):
        axes.plot([], [], 's', color=COLOURS[density], label=rf'$\rho = {density:g}$')
    axes.axhline(2, color=GREY, linewidth=0.6)
    axes.set(xlabel=r'$k$  [$1/\sigma$]', ylabel='sound over LP modes', xlim=(0, None))
    axes.legend(ncol=2, loc='lower left')
    return figure


def draw_dilute(rows):
    """Bars: one standard error. Densities are a little apart along 1 / N, to be seen."""
    figure, (bs, largest) = plt.subplots(1, 2, figsize=(7.6, 3.1))
    for place, density in enumerate(sorted({row['density'] for row in rows}, reverse=True)):
        some = [row for row in rows if row['density'] == density]
        bs.errorbar(
            [1 / row['disks'] + 0.0005 * (place - 2) for row in some],
            [b_of(row) for row in some],
            yerr=[2 * row['h_KS error'] for row in some],
            color={**COLOURS, **OTHERS}[density],
            marker='o',
            linestyle='none',
            elinewidth=0.7,
            label=rf'$\rho = {density:g}$',
        )
    line = constant(rows)
    if line:
        bs.axline((0, line[0][0]), slope=line[0][1], color=GREY, linewidth=0.6)
    bs.set(xlabel='$1 / N$', ylabel=r'$2 h_{KS} / N \nu + \ln \rho$', xlim=(0, 0.066), title='(a)')
    bs.legend(ncol=2)
    for disks in sorted({row['disks'] for row in rows}):
        some = [row for row in rows if row['disks'] == disks]
        largest.errorbar(
            [-math.log(row['density']) for row in some],
            [row['lambda_1 over it'] for row in some],
            yerr=[row['lambda_1 error'] for row in some],
            marker='o',
            elinewidth=0.7,
            label=f'N = {disks:g}',
        )
    largest.set(xlabel=r'$-\ln \rho$', ylabel=r'$\lambda_1 / \nu$', title='(b)')
    largest.legend()
    return figure


# ---- circles ------------------------------------------------------------------------------------

# T(m, n): the root of m J_m = J_(m+2), and that of J_m, which is no candidate where m is 0
ROOTS = {(1, 1): (3.05424, 3.83171), (2, 1): (4.61256, 5.13562), (0, 1): (5.13562, 5.13562)}
ROOTS[1, 2] = 6.70613, 7.01559
LP_ROOTS = {(1, 1): 1.84118, (2, 1): 3.05424, (0, 1): 3.83171}
MARKS = {(1, 1): 'o', (2, 1): 's', (0, 1): '^', (1, 2): 'D'}


def bessel(order, x):
    """By its integral over a period."""
    turn = 2 * np.pi * np.arange(128) / 128
    return np.cos(order * turn - np.asarray(x)[..., None] * np.sin(turn)).mean(axis=-1)


def slips(order, root, r, harmonic=True):
    """u_r and u_theta of the flow with the stream function J_m(x r) - J_m(x) r^m, at r / a."""
    x = root * r
    below, above = bessel(order - 1, x), bessel(order + 1, x)
    taken = order * bessel(order, root) * r ** (order - 1) if harmonic else 0.0
    return root * (below + above) / 2 - taken, taken - root * (below - above) / 2


def coupled(order, z, c_t, c_l, v):
    """Three waves of one growth rate z, in a circle of radius 1: L with P ahead, with P behind, and
    T. Vanishes if they can make u_r, the tangential stress and dA/dr vanish at the wall."""
    columns = []
    for ahead in (1j, -1j):
        k = z / (c_l + ahead * v)
        j, slope = bessel(order, k), k * (bessel(order - 1, k) - bessel(order + 1, k)) / 2
        columns.append([slope, order * (2 * j - slope), ahead * k * slope])
    k = z / c_t
    j, slope = bessel(order, k), k * (bessel(order - 1, k) - bessel(order + 1, k)) / 2
    columns.append([order * j, (k * k - order**2) * j + 2 * slope, 0])
    matrix = np.array(columns)
    return np.linalg.det(matrix / np.abs(matrix).max(axis=1, keepdims=True))


def growth(order, start, *speeds):
    """The root next to a growth rate, by secants."""
    before, now = start, 0.98 * start
    values = [coupled(order, z, *speeds) for z in (before, now)]
    for _ in range(60):
        step = (before - now) * values[1] / (values[1] - values[0])
        step *= min(1, 0.05 * abs(now) / abs(step))
        before, now = now, now + step
        values = values[1], coupled(order, now, *speeds)
        if abs(step) < 1e-10 * abs(now):
            break
    return now


def circles(rows):
    """Each circle's density and size, its steps, and those of the box with its pressure."""
    order = dict.fromkeys((row['density'], row['disks']) for row in rows if row['circle'])
    boxes = dict.fromkeys((row['density'], row['disks']) for row in rows if not row['circle'])
    for own, other in zip(order, boxes):
        some = [row for row in rows if row['r / a'] < 0]
        yield own, *(
            {
                (row['T'], row['m'], row['n']): row
                for row in some
                if (row['circle'], row['density'], row['disks']) == (circle, *of)
            }
            for circle, of in ((1, own), (0, other))
        )


def in_box(box, t):
    """lambda(k) of its steps of a kind: k times a line in k^2."""
    some = [row for row in box.values() if row['T'] == t]
    k, slope = (np.array(x) for x in zip(*((r['k'], r['exponent'] / r['k']) for r in some)))
    line = np.polyfit(k**2, slope, min(1, len(some) - 1))
    return lambda k: k * np.polyval(line, k**2)


def against_boxes(rows):
    """1 / R, then for each step found what is measured over what a box has at its k."""
    for (density, disks), circle, box in circles(rows):
        radius = math.sqrt(disks / (math.pi * density))
        v = np.mean([row['omega'] / row['k'] for row in box.values() if row['omega'] > 0])
        for (t, m, n), row in circle.items():
            if (m, n) not in (ROOTS if t else LP_ROOTS):
                continue
            expected = in_box(box, t)
            ratio = row['exponent'] / expected(row['k'])
            by_j = row['k'] * ROOTS[m, n][1] / ROOTS[m, n][0] if t else math.nan
            speeds = [in_box(box, kind)(row['k']) / row['k'] for kind in (1, 0)]
            x = row['k'] * (radius - 0.5)
            free = x * (speeds[0] if t else speeds[1] + 1j * v)
            z = growth(int(m), 0.99 * free, *speeds, v) if m else free
            yield dict(
                theory=(z.real / free.real, math.nan if t else z.imag / free.imag),
                density=density,
                disks=disks,
                inverse=1 / radius,
                t=t,
                mn=(m, n),
                ratio=ratio,
                error=row['error'] / expected(row['k']),
                by_j=row['exponent'] / expected(by_j) if t else math.nan,
                turning=row['omega'] / (v * row['k']),
                found=row['multiplicity'],
            )


def tables_of_circles(rows):
    for one in against_boxes(rows):
        name = f'{"T" if one["t"] else "LP"}({one["mn"][0]:g},{one["mn"][1]:g})'
        more = f'by J_m = 0 {one["by_j"]:.3f}' if one['t'] else f'omega {one["turning"]:.3f}'
        circle = f'density {one["density"]:g}, {one["disks"]:g} disks, {name}'
        ratio = f'lambda over that of a box {one["ratio"]:.4f} +- {one["error"]:.4f}'
        expected = ' and '.join(f'{x:.3f}' for x in one['theory'] if x == x)
        yield f'{circle}: found {one["found"]:.2f}, {ratio}, {more}; as coupled waves {expected}'


def draw_circles(rows):
    figure, (flow, of_t, of_lp) = plt.subplots(1, 3, figsize=(9.6, 3.3))
    _flow(flow, rows)
    ratios = list(against_boxes(rows))
    # what a circle does to a wave that is not coupled
    alone = {one['inverse']: one['ratio'] for one in ratios if one['t'] and one['mn'] == (0, 1)}
    for one in ratios:
        axes, colour = of_t if one['t'] else of_lp, CIRCLES.get(one['density'], INK)
        style = dict(color=colour, marker=MARKS[one['mn']], linestyle='none')
        axes.errorbar(one['inverse'], one['ratio'], yerr=max(one['error'], 0), **style)
        if one['inverse'] in alone:
            expected = alone[one['inverse']] * one['theory'][0]
            axes.plot(one['inverse'], expected, '_', color=colour, markersize=14)
        other = one['by_j'] if one['t'] else one['turning']
        axes.plot(one['inverse'], other, markerfacecolor='white', **style)
    for axes, kind, names in ((of_t, 'T', ROOTS), (of_lp, 'LP', LP_ROOTS)):
        for m, n in names:
            axes.plot([], [], MARKS[m, n], color=INK, label=f'{kind}({m},{n})')
        axes.axhline(1, color=GREY, linewidth=0.6)
        axes.set(xlabel=r'$1 / R$  [$1/\sigma$]', xlim=(0, 0.102), ylim=(0.56, 1.03))
        axes.legend(loc='lower left', ncol=2, handletextpad=0.1, columnspacing=0.6)
    of_t.set_title(r'(b) T: $\lambda$ over that of a box; open: $J_m = 0$', loc='left')
    of_lp.set_title(r'(c) LP: the same; open: $\omega$; bars: theory of $\lambda$', loc='left')
    for density, colour in CIRCLES.items():
        flow.plot([], [], 's', color=colour, label=rf'$\rho = {density:g}$')
    flow.legend(loc='lower right', handletextpad=0.2)
    return figure


CIRCLES = {0.4: COLOURS[0.4], 0.7: COLOURS[0.2], 0.8: COLOURS[0.8]}


def _flow(axes, rows):
    """T(1,1) of the largest circle, without a formula; and the two that were candidates."""
    some = [row for row in rows if row['T'] and (row['m'], row['n']) == (1, 1) and row['r / a'] > 0]
    largest = max(((row['disks'], row['density']) for row in some), default=None)
    some = [row for row in some if (row['disks'], row['density']) == largest]
    r = np.array([row['r / a'] for row in some])
    measured = np.array([[row['u_r'], row['u_theta']] for row in some]).T
    fine = np.linspace(0.01, 1, 200)
    for root, harmonic, style in ((ROOTS[1, 1][0], True, '-'), (ROOTS[1, 1][1], False, ':')):
        at, curve = (slips(1, root, x, harmonic) for x in (r, fine))
        size = np.sum(measured * at) / np.sum(np.square(at))
        for component in curve:
            axes.plot(fine, size * component / np.abs(measured).max(), style, color=INK)
    for values, marker, name in zip(measured, 'os', ('r', r'\theta')):
        text = f'$u_{{{name}}}$ of T(1,1)'
        colour = CIRCLES.get(largest[1], INK)
        axes.plot(r, values / np.abs(measured).max(), marker, color=colour, label=text)
    axes.axhline(0, color=GREY, linewidth=0.6)
    axes.set(xlabel='$r / a$', xlim=(0, 1))
    axes.set_title('(a) flow; dotted: $J_1 = 0$', loc='left')


def long_boxes(rows):
    """Of spheres, for each density: rows of the boxes whose waves lie along x."""
    for density in sorted({row['density'] for row in rows if row['aspect'] == min_aspect(rows)}):
        yield density, [
            row
            for row in rows
            if row['density'] == density and row['aspect'] == min_aspect(rows) and row['nx'] > 0
        ]


def min_aspect(rows):
    return min(row['aspect'] for row in rows)


def slopes(some, kind):
    """c of long waves with its error, from lambda / k = c (1 + b k^2); of one wave that itself."""
    of_kind = [row for row in some if row['kind'] == kind]
    k, value, error = (
        np.array([row[name] for row in of_kind]) for name in ('k', 'lambda / k', 'lambda / k error')
    )
    if len(k) < 2:
        return value[0], error[0]
    found, errors, _, _ = fit(value, error, np.ones_like(k), k**2)
    return found[0], errors[0]


def tables_of_spheres(rows):
    for density, some in long_boxes(rows):
        for kind in ('T', 'LP'):
            value, error = slopes(some, kind)
            yield f'density {density:g}: c_{kind} {value:.4f} +- {error:.4f}'
        for row in some:
            if row['omega / k'] == row['omega / k']:
                ratio = row['omega / k'] / row[PRESSURE]
                error = row['omega / k error'] / row[PRESSURE]
                wave = f'density {density:g}, k {row["k"]:.4f}'
                yield f'{wave}: v over that of the pressure {ratio:.4f} +- {error:.4f}'
    for row in rows:
        if row['aspect'] > min_aspect(rows):
            name = f'{row["kind"]}({row["nx"]:g},{row["ny"]:g},{row["nz"]:g})'
            box = f'{row["disks"]:g} spheres, aspect {row["aspect"]:g}, {row["boundaries"]}'
            shared = f' (of {row["members"]:g})' if row['members'] > 1 else ''
            yield f'{box}: {name} found {row["found"]:.2f} of {row["expected"]:g}{shared}'


PRESSURE = 'P_xx / (sqrt(3 kT) rho)'
SPHERES = {0.1: '#56B4E9', 0.3: '#0072B2', 0.5: '#009E73', 0.7: '#E69F00', 0.9: '#D55E00'}


def draw_spheres(rows):
    figure, (speeds, turning, bending) = plt.subplots(1, 3, figsize=(9.6, 3.3))
    fine = np.linspace(0, 0.8, 50)
    of_disks = dict(color=GREY, linewidth=0.8)
    speeds.plot(fine, 0.790 + 0.970 * fine + 0.785 * fine**2 + 6.24 * fine**4, '--', **of_disks)
    speeds.plot(fine, 0.902 + 1.050 * fine - 0.053 * fine**2 + 3.85 * fine**4, ':', **of_disks)
    densities, points = [], []
    for density, some in long_boxes(rows):
        colour = SPHERES.get(density, INK)
        phases = [row for row in some if row['omega / k'] == row['omega / k']]
        densities.append(density)
        points.append([slopes(some, kind)[0] for kind in ('T', 'LP')] + [some[0][PRESSURE]])
        if phases:
            first = min(phases, key=lambda row: row['k'])
            speeds.plot(density, first['omega / k'], 'o', color=INK, markerfacecolor='white')
        for row in phases:
            ratio, error = (row[x] / row[PRESSURE] for x in ('omega / k', 'omega / k error'))
            turning.errorbar(row['k'], ratio, yerr=BAR * error, marker='o', color=colour)
        for kind, mark, filled in (('T', 's', colour), ('LP', 'D', 'white')):
            c = slopes(some, kind)[0]
            of_kind = [row for row in some if row['kind'] == kind]
            if len(of_kind) > 1:
                bending.plot(
                    [row['k'] for row in of_kind],
                    [row['lambda / k'] / c for row in of_kind],
                    mark + '-',
                    color=colour,
                    markerfacecolor=filled,
                    linewidth=0.7,
                )
        turning.plot([], [], 'o', color=colour, label=rf'$\rho = {density:g}$')
    of_t, of_lp, pressure = zip(*points)
    speeds.plot(densities, of_lp, 'D--', color=INK, label='$c_L$')
    speeds.plot(densities, of_t, 's:', color=INK, label='$c_T$')
    speeds.plot(
        densities, pressure, '-', color=INK, linewidth=0.8, label=r'$P_{xx} / \rho\sqrt{3 kT}$'
    )
    speeds.plot([], [], 'o', color=INK, markerfacecolor='white', label='$v$')
    speeds.plot([], [], '-', label='disks: $c_L$, $c_T$ of the paper', **of_disks)
    speeds.set(xlabel=r'$\rho$', xlim=(0, 1), ylim=(0, 5.5))
    speeds.set_title(r'(a) velocities of spheres [$\sigma$/time unit]', loc='left')
    turning.axhline(1, color=GREY, linewidth=0.6)
    turning.set(xlabel=r'$k$  [$1/\sigma$]', xlim=(0, None))
    turning.set_title('(b) $v$ over that of the pressure', loc='left')
    bending.axhline(1, color=GREY, linewidth=0.6)
    bending.set(xlabel=r'$k$  [$1/\sigma$]', xlim=(0, None))
    bending.set_title(r'(c) $\lambda / ck$: T filled, LP open', loc='left')
    speeds.legend(loc='upper left')
    turning.legend(loc='lower left')
    return figure


STUDIES = {  # a column that only this one has: fits, picture
    'angle': (limits, draw_halves),
    'sound': (sounds, draw_sound),
    'lambda_1 over it': (constants, draw_dilute),
    'u_theta': (tables_of_circles, draw_circles),
    'boundaries': (tables_of_spheres, draw_spheres),
}


def main(arguments):
    if not arguments or not all(path.endswith('.csv') for path in arguments):
        print(
            'findings.py: needs tables of halves, sound, dilute, circle, spheres, each a .csv',
            file=sys.stderr,
        )
        return 2
    for path in arguments:
        rows = rows_of(path)
        fits, draw = next(study for column, study in STUDIES.items() if column in rows[0])
        for line in fits(rows):
            print(line)
        with plt.rc_context(STYLE):
            picture = path[:-4] + '.png'
            draw(rows).savefig(picture, dpi=200, bbox_inches='tight')
            print(picture)
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
