"""Steps of circles beside those of boxes with the same pressure."""

import math

import matplotlib.pyplot as plt
import numpy as np

from study import COLOURS, GREY, INK

# T(m, n): the root of m J_m = J_(m+2), and that of J_m, which is no candidate where m is 0
ROOTS = {(1, 1): (3.05424, 3.83171), (2, 1): (4.61256, 5.13562), (0, 1): (5.13562, 5.13562)}
ROOTS[1, 2] = 6.70613, 7.01559
LP_ROOTS = {(1, 1): 1.84118, (2, 1): 3.05424, (0, 1): 3.83171}
CIRCLES = {0.4: COLOURS[0.4], 0.7: COLOURS[0.2], 0.8: COLOURS[0.8]}
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


def lines(rows):
    for one in against_boxes(rows):
        name = f'{"T" if one["t"] else "LP"}({one["mn"][0]:g},{one["mn"][1]:g})'
        more = f'by J_m = 0 {one["by_j"]:.3f}' if one['t'] else f'omega {one["turning"]:.3f}'
        circle = f'density {one["density"]:g}, {one["disks"]:g} disks, {name}'
        ratio = f'lambda over that of a box {one["ratio"]:.4f} +- {one["error"]:.4f}'
        expected = ' and '.join(f'{x:.3f}' for x in one['theory'] if x == x)
        yield f'{circle}: found {one["found"]:.2f}, {ratio}, {more}; as coupled waves {expected}'


def draw(rows):
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
