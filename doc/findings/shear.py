"""Shearing walls: dimension, flow and viscosity against b; spectra in mirrored halves; waves."""

import math

import matplotlib.pyplot as plt
import numpy as np

from study import BLUE, GREEN, GREY, INK, ORANGE, VERMILION

REFLECTING = math.inf
SHOWN = {1: VERMILION, 3: ORANGE, 10: GREEN, REFLECTING: INK}
WAVES = {'LP(1 0)': ('D', 4), 'T(0 1)': ('o', 1), 'LP(0 1)': ('^', 2)}  # marks, multiplicities


def of(rows, shape, disks, quantity):
    """(b, value, error) of what has no index."""
    return [
        (row['b'], row['value'], row['error'])
        for row in rows
        if (row['shape'], row['disks'], row['quantity']) == (shape, disks, quantity)
    ]


def series(rows, shape, disks, b, quantity):
    """Values by index, from 1 on."""
    some = [
        row
        for row in rows
        if (row['shape'], row['disks'], row['b'], row['quantity']) == (shape, disks, b, quantity)
    ]
    return np.array([row['value'] for row in sorted(some, key=lambda row: row['index'])])


def boxes(rows):
    return sorted({(row['shape'], int(row['disks'])) for row in rows})


def height(rows, shape, disks):
    """Of the box, whose aspect the program has."""
    density = next(row['density'] for row in rows if (row['shape'], row['disks']) == (shape, disks))
    return math.sqrt(disks / density * {'square': 1, 'long': 0.25, 'high': 4}[shape])


def viscosity(rows, shape, disks):
    """Of each b, (b, shear rate, kT, stress over the rate and the root of kT, its error): the
    layers near walls, each of 1 sigma, have their middles Ly - 2 apart. Kinetic energy that is not
    that of a linear profile is kT."""
    of_b = {
        name: {b: (value, error) for b, value, error in of(rows, shape, disks, name)}
        for name in ('velocity low', 'velocity high', 'shear stress')
    }
    apart = height(rows, shape, disks) - 2
    for b, (stress, stress_error) in sorted(of_b['shear stress'].items()):
        low, high = of_b['velocity low'][b], of_b['velocity high'][b]
        rate = (high[0] - low[0]) / apart
        rate_error = math.hypot(high[1], low[1]) / apart
        kT = 1 - (rate * (apart + 2)) ** 2 / 24
        value = stress / rate / math.sqrt(kT)
        yield b, rate, kT, value, value * math.hypot(stress_error / stress, rate_error / rate)


def enskog(density):
    """Viscosity at kT = 1 (Gass, J. Chem. Phys. 54, 1898 (1971))."""
    eta = math.pi / 4 * density
    contact = (1 - 7 / 16 * eta) / (1 - eta) ** 2
    return 0.5110 / math.sqrt(math.pi) * (1 / contact + 2 * eta + 0.8729 * contact * (2 * eta) ** 2)


def production(rows, shape, disks):
    """Of each b, stress times shear rate times area over kT: the entropy that hydrodynamics has."""
    density = next(row['density'] for row in rows if (row['shape'], row['disks']) == (shape, disks))
    stress = {b: value for b, value, _ in of(rows, shape, disks, 'shear stress')}
    for b, rate, kT, _, _ in viscosity(rows, shape, disks):
        yield b, stress[b] * rate * disks / density / kT


def example(rows, shape, disks, b, wave):
    """Of so many neighbouring vectors in front of the zero modes as a step has: the most that they
    have of a wave, their mean exponent, the first index."""
    weights, exponents = series(rows, shape, disks, b, wave), series(
        rows, shape, disks, b, 'exponent'
    )
    width = WAVES[wave][1]
    sums = [weights[k : k + width].sum() for k in range(len(exponents) // 2 - 1 - width)]
    best = int(np.argmax(sums))
    return sums[best] / width, exponents[best : best + width].mean(), best + 1


def lines(rows):
    for shape, disks in boxes(rows):
        name = f'{disks} disks, {shape}'
        for quantity in ('h_KS', 'sum', 'contraction', 'dimension', 'shear stress'):
            for b, value, error in of(rows, shape, disks, quantity):
                yield f'{name}, b {b:g}: {quantity} {value:.5g} +- {error:.2g}'
        for b, rate, kT, value, error in viscosity(rows, shape, disks):
            yield (
                f'{name}, b {b:g}: shear rate {rate:.4f}, kT {kT:.3f}, '
                f'viscosity over its root {value:.4f} +- {error:.4f}'
            )
        for b, value in production(rows, shape, disks):
            yield f'{name}, b {b:g}: stress times rate times area over kT {value:.5g}'
        for wave in WAVES:
            for b in sorted({row['b'] for row in rows}):
                if len(series(rows, shape, disks, b, wave)):
                    share, exponent, index = example(rows, shape, disks, b, wave)
                    yield (
                        f'{name}, b {b:g}: {wave} has {share:.3f} of vectors {index}.., '
                        f'exponent {exponent:.4f}'
                    )


def mirrored(axes, rows):
    """Spectra of one box, the second half turned over: alike in pairs of opposite sign."""
    shape, disks = 'square', 36
    for b, colour in SHOWN.items():
        all_of = series(rows, shape, disks, b, 'exponent')
        half = len(all_of) // 2
        index = np.arange(1, half + 1)
        axes.plot(index, all_of[:half], '-', color=colour, linewidth=0.9, label=label_of(b))
        axes.plot(index, -all_of[: half - 1 : -1], ':', color=colour, linewidth=0.9)
    axes.set(xlabel='$l$', ylim=(0, None), xlim=(0, half))
    axes.set_title(r'(a) $\lambda_l$; dotted $-\lambda_{4N+1-l}$', loc='left')
    axes.legend()


def label_of(b):
    return 'reflecting' if b == REFLECTING else f'$b = {b:g}$'


def lost(axes, rows):
    """Dimensions lost, for each disk."""
    for disks, colour in ((36, BLUE), (144, VERMILION)):
        points = [p for p in of(rows, 'square', disks, 'dimension') if p[0] < REFLECTING]
        axes.errorbar(
            [b for b, _, _ in points],
            [(4 * disks - value) / disks for _, value, _ in points],
            yerr=[error / disks for _, _, error in points],
            marker='o',
            color=colour,
            label=f'{disks} disks',
        )
    axes.set(xscale='log', yscale='log', xlabel='$b$')
    axes.set_title('(b) $(4N - D_{KY}) / N$', loc='left')
    axes.legend()


def thick(axes, rows):
    for disks, colour in ((36, BLUE), (144, VERMILION)):
        points = list(viscosity(rows, 'square', disks))
        axes.errorbar(
            [point[1] for point in points],
            [point[3] for point in points],
            yerr=[point[4] for point in points],
            marker='o',
            linestyle='none',
            color=colour,
            label=f'{disks} disks',
        )
    axes.axhline(enskog(0.4), color=GREY, linewidth=0.8, label='Enskog')
    axes.set(xscale='log', xlabel='shear rate [1/time unit]', ylim=(0, None))
    axes.set_title(r'(c) viscosity over $\sqrt{kT}$', loc='left')
    axes.legend(loc='lower left')


def waves(axes, rows):
    """The largest share of each wave, in the box that is long in its direction."""
    for (wave, (mark, _)), colour in zip(WAVES.items(), (BLUE, VERMILION, GREEN)):
        shape = 'long' if wave.endswith('(1 0)') else 'high'
        bs = sorted({row['b'] for row in rows if row['shape'] == shape})
        shares = [example(rows, shape, 64, b, wave)[0] for b in bs]
        axes.plot(
            [b if b < REFLECTING else 500 for b in bs],
            shares,
            mark + '-',
            color=colour,
            label=wave.replace(' ', ','),
        )
    axes.axvline(220, color=GREY, linewidth=0.6)
    axes.set(xscale='log', xlabel='$b$ (right of the line: reflecting)', ylim=(0, 1))
    axes.set_title('(d) weight in the vectors that have most', loc='left')
    axes.legend()


def draw(rows):
    figure, axes = plt.subplots(2, 2, figsize=(7.6, 6.0))
    for panel, one in zip((mirrored, lost, thick, waves), axes.flat):
        panel(one, rows)
    figure.tight_layout()
    return figure
