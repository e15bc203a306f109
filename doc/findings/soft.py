"""Soft disks and spheres: which vectors hold T and LP, and what of the flow the unstable ones."""

import math

import matplotlib.pyplot as plt
import numpy as np

from study import COLOURS, GREY, INK

BOX = 'particles', 'dimension', 'energy', 'density', 'height', 'number'
KINDS = {'hard': INK, 'power': COLOURS[0.2], 'wca': COLOURS[0.8], 'lennard_jones': COLOURS[0.4]}
MARKS = {0.1: 'v', 0.2: 'o', 0.4: 'D', 0.7: 's', 0.9: '^'}  # by density
SQUARE = dict(dimension=2, height=5.2, number=64)  # those of different densities
SMALL = 24  # exponents in the picture
TIME = 400  # averaged, over the root of the energy
COLD = 0.0001  # energy at which power is nearly hard
SOFTEST = 0.5  # potential part of the energy
AT_ZERO = 0.008  # where hard disks are drawn


def boxes(rows, **wanted):
    """Of each box a list of its seeds, which are lists of rows, in the order of the table."""
    found = {}
    for row in rows:
        if all(row[name] == value for name, value in wanted.items()):
            seeds = found.setdefault(tuple(row[name] for name in BOX), {})
            seeds.setdefault(row['seed'], []).append(row)
    return [list(seeds.values()) for seeds in found.values()]


def over(seeds, what):
    """Mean of it over the seeds, and its error, unknown of a single one."""
    value = [what(box) for box in seeds]
    error = np.std(value, ddof=1) / len(value) ** 0.5 if len(value) > 1 else math.nan
    return np.mean(value), error


def told(name, seeds, what, digits=2):
    return '{} {:.{digits}f} +- {:.{digits}f}'.format(name, *over(seeds, what), digits=digits)


def column(box, name):
    return np.array([row[name] for row in box])


def weights(box, kind, covariant=False):
    """[vector]: of T(1,0), of both halves of LP(1,0), or of both kinds."""
    names = {'T': 'T', 'LP': 'LP', 'both': 'TLP'}[kind]
    return sum(column(box, 'covariant ' * covariant + name) for name in names)


def fields(box, kind):
    t, lp = (2, 4) if box[0]['dimension'] == 2 else (4, 4)
    return {'T': t, 'LP': lp, 'both': t + lp}[kind]


def held(box, kind, covariant=False):
    """Part of the fields that is in the vectors which have most of it, as many as fields."""
    count = fields(box, kind)
    return np.sort(weights(box, kind, covariant))[-count:].sum() / count


def spread(box, kind, covariant=False):
    """Over so many vectors."""
    weight = weights(box, kind, covariant)
    return weight.sum() ** 2 / (weight**2).sum()


def unit(box):
    """k times a speed"""
    return box[0]['k'] * box[0]['kinetic'] ** 0.5


def place(box, kind, covariant=False):
    """Exponent with the weight, over k and a speed."""
    weight = weights(box, kind, covariant)
    return np.average(column(box, 'lambda'), weights=weight) / unit(box)


def potential(box):
    """Part of the energy that is potential."""
    return 1 - box[0]['kinetic'] / box[0]['energy']


def velocity(box):
    return box[0]['omega'] / unit(box)


def of_pressure(box):
    """P / (rho sqrt(2)) over the square of the same speed"""
    return box[0]['P_xx'] / (box[0]['density'] * box[0]['kinetic'] * 2**0.5)


def trembling(box):
    """What the variance of ln R of the last six grows by, over k and a speed."""
    error = column(box, 'lambda error')[-6:]
    time = TIME / box[0]['energy'] ** 0.5
    return np.mean(error**2) * time / unit(box) if min(error) > 0 else math.nan


def flow(box):
    return column(box, 'flow').sum()


def lines(rows):
    for seeds in boxes(rows):
        row = seeds[0][0]
        most = max(box[0]['climb'] for box in seeds), max(box[0]['null angle'] for box in seeds)
        yield (
            f'{row["particles"]}, {row["dimension"]:g} dimensions, energy {row["energy"]:g}, '
            f'density {row["density"]:g}, {row["number"]:g} in a box {row["height"]:g} high, '
            f'k {row["k"]:.4f}'
        )
        yield '  ' + ', '.join(
            (
                told('potential', seeds, potential, 3),
                told('flow', seeds, flow, 3),
                told('cos', seeds, lambda box: column(box, 'cos Theta')[-6:].mean()),
                told('trembling', seeds, trembling, 3),
                told('v', seeds, velocity, 3),
                told('of the pressure', seeds, of_pressure, 3),
                f'gradient {most[0]:.1e}, null {most[1]:.1e}',
            )
        )
        for covariant in (False, True):
            if weights(seeds[0], 'T', covariant)[0] == weights(seeds[0], 'T', covariant)[0]:
                yield f'  {"covariant" if covariant else "Gram-Schmidt"}: ' + ', '.join(
                    told(f'{kind} {what.__name__}', seeds, lambda box: what(box, kind, covariant))
                    for kind in ('T', 'LP', 'both')
                    for what in (held, spread, place)
                )
        last = np.mean([column(box, 'lambda')[-8:] for box in seeds], axis=0) / unit(seeds[0])
        yield '  last exponents over k and speed ' + ' '.join(f'{one:.2f}' for one in last)


def draw(rows):
    figure, axes = plt.subplots(2, 2, figsize=(7.2, 6.0))
    _spectra(axes[0][0], rows, 0.2)
    _spectra(axes[0][1], rows, 0.7)
    _spectra(axes[0][1], rows, 0.7, COLD, '--')
    _weights(axes[1][0], rows)
    _softness(axes[1][1], rows)
    axes[0][0].set_title('(a) small exponents, density 0.2', loc='left')
    axes[0][1].set_title('(b) density 0.7; dashed: energy 1e-4', loc='left')
    axes[0][0].set(ylabel=r'$\lambda \,/\, k \sqrt{K/N}$')
    axes[0][0].legend(loc='upper left')
    return figure


def _spectra(axes, rows, density, energy=1, line='o-'):
    for seeds in boxes(rows, density=density, energy=energy, **SQUARE):
        value = np.mean([column(box, 'lambda')[::-1][:SMALL] / unit(box) for box in seeds], axis=0)
        kind = seeds[0][0]['particles']
        style = dict(color=KINDS[kind], markersize=3, linewidth=0.6, label=kind)
        axes.plot(range(1, len(value) + 1), value, line, **style)
    axes.set(xlabel='positive exponent, from the smallest', ylim=(0, None))


def _weights(axes, rows):
    for seeds in boxes(rows, density=0.7, energy=1, **SQUARE):
        kind = seeds[0][0]['particles']
        for covariant in (False, True):
            value = np.mean([weights(box, 'T', covariant)[::-1] for box in seeds], axis=0)
            if kind != 'lennard_jones' and value[0] == value[0]:
                style = dict(linestyle='--' if covariant else '-', color=KINDS[kind])
                axes.plot(range(1, len(value) + 1), value, **style)
    axes.plot([], [], color=GREY, label='Gram-Schmidt')
    axes.plot([], [], '--', color=GREY, label='covariant')
    axes.set(xlabel='vector, from the smallest exponent', xlim=(1, 64), ylim=(0, 1))
    axes.set_xscale('log')
    axes.set_title('(c) share of T(1,0), density 0.7', loc='left')
    axes.legend(loc='upper right')


def _softness(axes, rows):
    """T and LP that are in six vectors."""
    for seeds in boxes(rows, **SQUARE):
        row = seeds[0][0]
        if row['particles'] == 'lennard_jones':
            continue
        hard = row['particles'] == 'hard'
        value, error = over(seeds, lambda box: held(box, 'both'))
        x = AT_ZERO if hard else over(seeds, potential)[0]
        style = dict(color=KINDS[row['particles']], marker=MARKS[row['density']], elinewidth=0.6)
        axes.errorbar(x, value, yerr=None if math.isnan(error) else error, **style)
    for density, mark in MARKS.items():
        axes.plot([], [], mark, color=GREY, label=f'density {density:g}')
    axes.set(xlabel='part of the energy that is potential', xscale='log')
    axes.set(xlim=(0.9 * AT_ZERO, SOFTEST), ylim=(0, 1))
    axes.set_title('(d) T and LP held by six; black: hard', loc='left')
    axes.legend(loc='lower left')
