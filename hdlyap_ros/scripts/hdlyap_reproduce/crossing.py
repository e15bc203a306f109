"""Where curves cross: those of the paper's fits, and measured ones between the densities that were run."""

import numpy as np

from hdlyap_plots import paper

STEPS = 4000        # of the densities in which a sign change of the fits is looked for


def of_fits(factor_l=1.0, factor_t=1.0):
    """Density from which on the paper's c_L is above its c_T, each times a factor; None if nowhere."""
    density = np.linspace(0, paper.DENSITY, STEPS + 1)
    apart = factor_l * paper.slope_l(density) - factor_t * paper.slope_t(density)
    behind = np.flatnonzero((apart[:-1] < 0) & (apart[1:] >= 0))
    if not len(behind):
        return None
    i = behind[0]
    return float(density[i] + (density[i + 1] - density[i]) * apart[i] / (apart[i] - apart[i + 1]))


def of_fits_between():
    """(lowest, highest) that the scatter of the fits allows."""
    up, down = 1 + paper.FIT_ACCURACY, 1 - paper.FIT_ACCURACY
    return of_fits(up, down), of_fits(down, up)


def measured(density, apart, errors):
    """(where a difference goes through zero from below, its standard error), by a straight line between the two
    neighbours; the change by a parabola through a third is part of the error. (None, 0) if nowhere."""
    density, apart, errors = (np.asarray(values, dtype=float) for values in (density, apart, errors))
    behind = np.flatnonzero((apart[:-1] < 0) & (apart[1:] >= 0))
    if not len(behind):
        return None, 0.0
    i = behind[0]
    fall, width = apart[i] - apart[i + 1], density[i + 1] - density[i]
    place = density[i] + width * apart[i] / fall
    statistical = width * np.hypot(apart[i + 1] * errors[i], apart[i] * errors[i + 1]) / fall ** 2
    return float(place), float(np.hypot(statistical, _bend(density, apart, i, place)))


def _bend(density, apart, i, place):
    """How far a parabola through the nearest third density moves the crossing."""
    others = [k for k in range(len(density)) if k not in (i, i + 1)]
    if not others:
        return 0.0
    third = min(others, key=lambda k: abs(density[k] - place))
    chosen = [i, i + 1, third]
    roots = np.roots(np.polyfit(density[chosen], apart[chosen], 2))
    inside = [root.real for root in roots if density[i] <= root.real <= density[i + 1] and abs(root.imag) < 1e-12]
    return abs(inside[0] - place) if inside else 0.0
