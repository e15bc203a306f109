"""Steps of spheres: velocities against density, rotation, how branches bend."""

import matplotlib.pyplot as plt
import numpy as np

from study import BAR, GREY, INK, fit

PRESSURE = 'P_xx / (sqrt(3 kT) rho)'
SPHERES = {0.1: '#56B4E9', 0.3: '#0072B2', 0.5: '#009E73', 0.7: '#E69F00', 0.9: '#D55E00'}


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


def lines(rows):
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


def draw(rows):
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
