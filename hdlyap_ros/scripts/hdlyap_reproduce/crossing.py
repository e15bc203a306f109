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
    """(where a smooth difference goes through zero from below, its standard error): a polynomial through the four
    densities round it; how far that of three of them moves the crossing is part of the error. (None, 0) if nowhere."""
    density, apart, errors = (np.asarray(values, dtype=float) for values in (density, apart, errors))
    behind = np.flatnonzero((apart[:-1] < 0) & (apart[1:] >= 0))
    if not len(behind):
        return None, 0.0
    between = density[behind[0]:behind[0] + 2]
    near = np.argsort(np.abs(density - between.mean()), kind='stable')     # the two neighbours first
    place = _root(density, apart, near[:4], between)
    if place is None:
        return None, 0.0
    fewer = _root(density, apart, near[:max(2, min(len(near), 4) - 1)], between)
    moved = [place - (_root(density, apart + errors * (np.arange(len(density)) == k), near[:4], between) or place)
             for k in near[:4]]
    return place, float(np.linalg.norm([*moved, place - (fewer or place)]))


def _root(density, values, chosen, between):
    """Zero, between two densities, of the polynomial through the chosen ones."""
    roots = np.roots(np.polyfit(density[chosen], values[chosen], len(chosen) - 1))
    inside = [float(root.real) for root in roots
              if abs(root.imag) < 1e-12 and between[0] <= root.real <= between[1]]
    return inside[0] if inside else None
