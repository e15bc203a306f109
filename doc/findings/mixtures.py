"""Mixtures beside disks of one kind: exponents against packing, where the first vector lives, and
the density by which the branches of T and LP scale."""

import matplotlib.pyplot as plt
import numpy as np

from study import BAR, BLUE, GREEN, GREY, INK, ORANGE, VERMILION, fit

NAMES = {'glass': '65 : 35, 1 : 1.4', 'pure': 'one kind'}
KINDS = 'T', 'LP'


def runs(rows, part):
    return [row for row in rows if row['part'] == part and row['kind'] == 'none']


def series(rows, part, kind, nx=1):
    """A row for each run with this step, of waves along x."""
    found = (row for row in rows if row['part'] == part and row['kind'] == kind)
    return [row for row in found if (row['nx'], row['ny']) == (nx, 0)]


def columns(rows, *names):
    return np.array([[row[name] for name in names] for row in rows]).T


def mean_mass(row):
    second = round(row['fraction'] * row['disks']) / row['disks']
    return 1 - second + second * row['mass']


def sizes(row):
    """Means of the diameter and of its square."""
    second = round(row['fraction'] * row['disks']) / row['disks']
    return [1 - second + second * row['diameter'] ** n for n in (1, 2)]


def is_pure(row):
    return row['fraction'] == 0


def slopes(rows, kind):
    """(row, c, error) of each box of branches, from lambda / k = c (1 + b k^2) of its waves along
    x."""
    for run in runs(rows, 'modes'):
        same = ('fraction', 'diameter', 'mass', 'packing')
        of_run = [
            row
            for row in rows
            if row['part'] == 'modes'
            and row['kind'] == kind
            and row['ny'] == 0
            and row['lambda / k error'] > 0
            and all(row[name] == run[name] for name in same)
        ]
        if len(of_run) < 2:
            continue
        k, value, error = columns(of_run, 'k', 'lambda / k', 'lambda / k error')
        found, errors, _, _ = fit(value, error, np.ones_like(k), k**2)
        yield run, found[0] * np.sqrt(mean_mass(run)), errors[0] * np.sqrt(mean_mass(run))


def densities(row):
    """By which a mixture could be as one kind: packing fraction, that of the mean diameter, Z."""
    first, square = sizes(row)
    quarter = np.pi / 4 * row['density']
    return {'packing': quarter * square, 'mean diameter': quarter * first**2, 'Z': row['Z']}


def compared(rows, kind):
    """(row, {density: c over that of one kind at the same density}, relative error)."""
    found = list(slopes(rows, kind))
    pure = [one for one in found if is_pure(one[0])]
    if len(pure) < 4:
        return
    for row, c, error in found:
        if is_pure(row):
            continue
        ratios = {}
        for name, value in densities(row).items():
            at = [densities(one)[name] for one, _, _ in pure]
            curve = np.polyfit(at, [one for _, one, _ in pure], 3)
            ratios[name] = c / np.polyval(curve, value)
        yield row, ratios, error / c


def what(row):
    return (
        f'{100 * row["fraction"]:.0f} % of diameter {row["diameter"]:g}, mass {row["mass"]:g}, '
        f'packing {row["packing"]:g}'
    )


def lines(rows):
    for part, name in NAMES.items():
        for row in runs(rows, part):
            numbers = (f'{row[x]:.4f} +- {row[x + " error"]:.4f}' for x in ('lambda_1', 'Z'))
            entropy = f'{row["h_KS / N"]:.4f} +- {row["h_KS error"]:.4f}'
            where = f'{name}, packing {row["packing"]:g}'
            yield f'{where}: lambda_1, Z {", ".join(numbers)}, h {entropy}'
        for kind in KINDS:
            for row in series(rows, part, kind):
                value = f'{row["lambda / k"]:.4f} +- {row["lambda / k error"]:.4f}'
                found = f'found {row["found"]:.2f} of {row["expected"]:g}'
                yield f'{name}, packing {row["packing"]:g}: {kind}(1,0) lambda / k {value}, {found}'
    for row in runs(rows, 'mass'):
        share, error = row['second kind of vector 1'], row['second kind error']
        yield (
            f'mass {row["mass"]:g}: lambda_1 {row["lambda_1"]:.4f} +- {row["lambda_1 error"]:.4f}, '
            f'on the second kind {share:.4f} +- {error:.4f}'
        )
    for kind in KINDS:
        for row, c, error in slopes(rows, kind):
            yield f'{what(row)}: c_{kind} m^(1/2) {c:.4f} +- {error:.4f}'
        for row, ratios, error in compared(rows, kind):
            said = ', '.join(f'{name} {ratio:.3f}' for name, ratio in ratios.items())
            yield f'{what(row)}: {kind} over one kind at the same {said} (+- {error:.3f})'


def draw(rows):
    figure, (packed, shares, scaled) = plt.subplots(1, 3, figsize=(9.6, 3.3))
    for (part, name), colour in zip(NAMES.items(), (VERMILION, GREY)):
        some = runs(rows, part)
        x, largest, error, entropy = columns(
            some, 'packing', 'lambda_1', 'lambda_1 error', 'h_KS / N'
        )
        packed.errorbar(x, largest, yerr=BAR * error, marker='o', color=colour, label=name)
        packed.plot(x, entropy, 'o--', color=colour, markerfacecolor='white')
    packed.plot([], [], 'o--', color=INK, markerfacecolor='white', label='$h_{KS}/N$')
    ticks = 3, 5, 10, 15
    packed.set(xlabel='packing fraction', yscale='log', yticks=ticks, yticklabels=ticks)
    packed.minorticks_off()
    packed.set_title(r'(a) $\lambda_1$, $h_{KS}/N$  [1/time unit]', loc='left')
    some = [row for row in runs(rows, 'mass') if row['mass'] > 1]
    mass, share, error = columns(some, 'mass', 'second kind of vector 1', 'second kind error')
    shares.errorbar(mass, share, yerr=BAR * error, marker='o', color=INK, label='vector 1')
    fine = np.geomspace(1, 100, 50)
    shares.plot(fine, 1 / (1 + fine), '--', color=GREY, linewidth=0.8, label='$1 / (1 + m)$')
    shares.set(xlabel='mass $m$ of the heavy half', xscale='log', yscale='log')
    shares.set_title('(b) share on the heavy half', loc='left')
    names, colours = ['packing', 'mean diameter', 'Z'], (GREEN, BLUE, ORANGE)
    for kind, mark in (('T', 's'), ('LP', 'D')):
        for number, (row, ratios, error) in enumerate(compared(rows, kind)):
            for name, colour in zip(names, colours):
                place = number + 0.12 * (kind == 'LP')
                filled = colour if kind == 'T' else 'white'
                scaled.errorbar(
                    place,
                    ratios[name],
                    yerr=BAR * error,
                    marker=mark,
                    color=colour,
                    markerfacecolor=filled,
                )
    for name, colour in zip(names, colours):
        scaled.plot([], [], 'o', color=colour, label='same ' + name)
    scaled.axhline(1, color=GREY, linewidth=0.6)
    scaled.set(xlabel='mixture', xticks=np.arange(7), xticklabels=range(1, 8))
    scaled.set_title('(c) $c$ over that of one kind: T filled, LP open', loc='left')
    for axes in (packed, shares, scaled):
        axes.legend(loc='best')
    return figure
