"""Hard dumbbells: the branch of rotation, how far apart the exponents of a step are, velocities."""

import math
from itertools import groupby

import matplotlib.pyplot as plt
import numpy as np

from study import BAR, COLOURS, GREY, INK, fit

BOX = 'bond', 'inertia', 'density', 'height', 'number', 'boundaries'
LONG = dict(density=0.6, height=2.5, number=36, inertia='disks', boundaries='pp')
SQUARE = dict(density=0.5, number=32)  # those against the bond
GASES = dict(height=5, number=100)  # those of different densities
SPECTRA = {0.01: COLOURS[0.1], 0.05: COLOURS[0.4], 0.25: COLOURS[0.6]}
TURNS = {'none': 2, 'disks': 3, 'points': 3}  # coordinates of one
MARKS = {'none': 'o', 'disks': 's', 'points': '^'}


def boxes(rows, **wanted):
    """Of each box: its exponents, its steps."""
    some = [row for row in rows if all(row[name] == value for name, value in wanted.items())]
    for _, box in groupby(some, lambda row: [row[name] for name in BOX]):
        box = list(box)
        yield [r for r in box if r['kind'] == 'exponent'], [
            r for r in box if r['kind'] != 'exponent'
        ]


def wave(step):
    return f'{step["kind"]}({step["nx"]:g},{step["ny"]:g})'


def is_apart(step):
    """All vectors of the step are there, and no others."""
    return step['apart'] == step['apart'] and step['members'] == 1


def ratios(rows, kind, disks):
    """Distance of neighbouring exponents over the trembling of ln R, of all such steps, with
    errors."""
    steps = [step for _, steps in boxes(rows) for step in steps if is_apart(step)]
    steps = [one for one in steps if one['kind'] == kind and (one['bond'] == 0) == disks]
    return [
        np.array([one[name] / one['trembling'] for one in steps])
        for name in ('apart', 'apart error', 'trembling error')
    ]


def free_rotors(row):
    """Exponent of rotors that collisions only turn: the root of the rate of their mean kick, less
    what its fluctuation takes."""
    inertia = row['bond'] ** 2 / 4 + (0.125 if row['inertia'] == 'disks' else 0)
    root = math.sqrt(row['rate'] * row['bond'] * math.sqrt(row['kT'] / math.pi) / inertia)
    return (
        root * (1 - math.pi * root / (16 * row['rate'])),
        root * row['rate error'] / row['rate'] / 2,
    )


def rotation(exponents):
    """Their mean, by shares of rotation, and its error if they fluctuate together."""
    shares = [row['rotation'] for row in exponents]
    return tuple(
        np.average([row[name] for row in exponents], weights=shares)
        for name in ('lambda', 'lambda error')
    )


def by_pressure(row):
    """P_xx / (rho kT)"""
    return row['P_xx'] / (row['density'] * row['kT'])


def lines(rows):
    for exponents, steps in boxes(rows):
        yield from _of_box(exponents, steps)
    for kind in ('LP', 'T'):
        for disks in (False, True):
            ratio, *errors = ratios(rows, kind, disks)
            if len(ratio):
                found, error, chi2, freedom = fit(ratio, np.hypot(*errors), np.ones_like(ratio))
                yield f'{kind} of {"disks" if disks else "dumbbells"}: distance over trembling ' + (
                    f'{found[0]:.3f} +- {error[0]:.3f}  chi^2 {chi2:.1f} for {freedom}'
                )


def _of_box(exponents, steps):
    row = exponents[0]
    what = f'bond {row["bond"]:g}, {row["inertia"]}' if row['bond'] else 'disks'
    size = f'{row["number"]:g} in a box {row["height"]:g} high, density {row["density"]:g}'
    numbers = ', '.join(
        f'{name} {row[key]:.4f} +- {row[key + " error"]:.4f}'
        for name, key in (('lambda_1', 'lambda'), ('rate', 'rate'))
    )
    yield f'{what}, {size}, {row["boundaries"]}: {numbers}, P / (rho kT) {by_pressure(row):.4f}'
    if row['bond']:
        numbers = *rotation(exponents), *free_rotors(row)
        yield '  rotation {:.4f} +- {:.4f}, of free rotors {:.4f} +- {:.4f}'.format(*numbers)
    for step in steps:
        first, unit = int(step['index']) - 1, step['k'] * math.sqrt(step['kT'])
        shared = f' (of {step["members"]:g})' if step['members'] > 1 else ''
        yield f'  {wave(step)}: found {step["found"]:.2f} of {step["expected"]:g}{shared}' + (
            f', lambda {step["lambda"]:.4f} +- {step["lambda error"]:.4f}, over k sqrt(kT)'
            f' {step["lambda"] / unit:.4f} +- {step["lambda error"] / unit:.4f}'
            f', rotation {step["rotation"]:.3f}'
        )
        if is_apart(step):
            each = exponents[first : first + int(step['expected'])]
            each = ' '.join(f'{r["lambda"]:.4f}({r["lambda error"]:.4f})' for r in each)
            yield f'    {each}, apart {step["apart"]:.5f} +- {step["apart error"]:.5f}' + (
                f', trembling {step["trembling"]:.5f} +- {step["trembling error"]:.5f}'
            )
        if step['omega'] == step['omega']:
            v, error = step['omega'] / unit, step['omega error'] / unit
            of_pressure = by_pressure(step) / math.sqrt(TURNS[step['inertia']])
            yield f'    v over sqrt(kT) {v:.4f} +- {error:.4f}, over that of the pressure' + (
                f' {v / of_pressure:.4f} +- {error / of_pressure:.4f}'
            )


def draw(rows):
    figure, axes = plt.subplots(2, 2, figsize=(7.2, 6.2))
    _shares(axes[0][0], rows)
    _bonds(axes[0][1], rows)
    _distances(axes[1][0], rows)
    _velocities(axes[1][1], rows)
    return figure


def _shares(axes, rows):
    for exponents, steps in boxes(rows, **LONG):
        colour = SPECTRA.get(exponents[0]['bond'])
        if colour is None:
            continue
        share = [row['rotation'] for row in exponents]
        axes.plot(range(1, len(share) + 1), share, color=colour)
        for step in steps:
            first = int(step['index'])
            index = range(first, first + int(step['expected']))
            mark = 's' if step['kind'] == 'T' else 'D'
            axes.plot(index, [share[i - 1] for i in index], mark, color=colour)
        axes.plot([], [], color=colour, label=f'$d = {exponents[0]["bond"]:g}$')
    axes.set(xlabel='index', ylim=(0, 1.02))
    axes.set_title('(a) share of rotation; squares T, diamonds LP', loc='left')
    axes.legend(loc='upper left')


def _bonds(axes, rows):
    for inertia, line in (('disks', '-'), ('points', '--')):
        some = [exponents for exponents, _ in boxes(rows, inertia=inertia, **SQUARE)]
        bonds = [exponents[0]['bond'] for exponents in some]
        largest = [exponents[0]['lambda'] for exponents in some]
        label = rf'$\lambda_1$, {inertia}'
        axes.plot(bonds, largest, MARKS[inertia] + line, color=INK, label=label)
        if inertia == 'disks':
            axes.plot(
                bonds, [rotation(x)[0] for x in some], 'o', color=COLOURS[0.8], label='rotation'
            )
            axes.plot(
                bonds, [free_rotors(x[0])[0] for x in some], color=COLOURS[0.8], linewidth=0.8
            )
    for exponents, _ in boxes(rows, inertia='none', **SQUARE):
        axes.axhline(exponents[0]['lambda'] * math.sqrt(2 / 3), color=GREY, linewidth=0.8)
    axes.set(xlabel=r'bond $d$  [$\sigma$]', xlim=(0.008, 1.25), ylim=(0.2, 30))
    axes.set(xscale='log', yscale='log')
    axes.set_title('(b) exponents of 32; grey: disks', loc='left')
    axes.legend(loc='lower right')


def _distances(axes, rows):
    reach = 1e-4, 0.05
    axes.plot(reach, reach, color=GREY, linewidth=0.8)
    for kind, mark in (('T', 's'), ('LP', 'D')):
        for _, steps in boxes(rows):
            for step in steps:
                if step['kind'] != kind or not is_apart(step):
                    continue
                colour = COLOURS[0.2] if step['bond'] else COLOURS[0.8]
                style = dict(marker=mark, color=colour, elinewidth=0.6, markersize=3.5)
                style['markerfacecolor'] = colour if kind == 'LP' else 'white'
                axes.errorbar(step['trembling'], step['apart'], yerr=step['apart error'], **style)
    axes.set(xscale='log', yscale='log', xlim=reach, ylim=reach)
    axes.set(xlabel=r'growth of the variance of $\ln R$', ylabel='distance of neighbours')
    axes.set_title('(c) LP filled, T open; red: disks', loc='left')


def _velocities(axes, rows):
    """Over P / (rho sqrt(kT)), so that neither mass nor temperature matters."""
    colours = {'T': COLOURS[0.4], 'LP': COLOURS[0.2]}
    for _, steps in boxes(rows, **GASES):
        for step in steps:
            if (step['nx'], step['ny']) != (1, 0):
                continue
            x = by_pressure(step)
            unit = step['k'] * x * math.sqrt(step['kT'])
            filled = None if step['bond'] else 'white'
            style = dict(marker=MARKS[step['inertia']], markerfacecolor=filled, linestyle='none')
            for name, colour in (('lambda', colours[step['kind']]), ('omega', COLOURS[0.8])):
                if step[name] == step[name]:
                    error = BAR * step[name + ' error'] / unit
                    axes.errorbar(x, step[name] / unit, yerr=error, color=colour, **style)
    for turns in (2, 3):
        axes.axhline(1 / math.sqrt(turns), color=GREY, linewidth=0.8, zorder=0)
    for colour, name in ((colours['T'], '$c_T$'), (colours['LP'], '$c_L$'), (COLOURS[0.8], '$v$')):
        axes.plot([], [], 's', color=colour, label=name)
    axes.set(xlabel=r'$P_{xx} / \rho kT$', xlim=(1, 16), xscale='log', ylim=(0.3, 0.9))
    axes.set_xticks([1, 2, 4, 8])
    axes.set_xticklabels('1248')
    axes.set_title(r'(d) over $P_{xx} / \rho\sqrt{kT}$; open: disks', loc='left')
    axes.legend(loc='upper right')
