"""Sound over LP modes."""

import math

import matplotlib.pyplot as plt

from study import COLOURS, GREY, INK, RATE


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


def lines(rows):
    """A line for each box."""
    for row, found, errors in ratios(rows):
        numbers = '  '.join(f'{one:.4f} +- {error:.4f}' for one, error in zip(found, errors))
        box = "density {density:g}, height {height:g}, {disks:g} disks".format(**row)
        yield f"{box}: {numbers}"


def draw(rows):
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
