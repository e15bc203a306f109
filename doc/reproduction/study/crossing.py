"""Where curves cross: those of the paper's fits, and measured ones between the densities that were
run."""

import numpy as np

from hdlyap.plots import paper

REAL = 1e-9  # imaginary part of a zero that is real
STEPS = 4000  # of the densities in which a sign change of the fits is looked for


def of_fits(factor_l=1.0, factor_t=1.0):
    """Density from which on the paper's c_L is above its c_T, each times a factor; None if
    nowhere."""
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
    """(where a smooth difference goes through zero from below, its standard error): a polynomial
    through the four densities round it. Errors are taken through its slope there, since a crossing
    that moves far may leave the densities that were run; how far that of three of them moves it is
    part of the error. (None, 0) if nowhere.
    """
    density, apart, errors = (
        np.asarray(values, dtype=float) for values in (density, apart, errors)
    )
    behind = np.flatnonzero((apart[:-1] < 0) & (apart[1:] >= 0))
    if not len(behind):
        return None, 0.0
    middle = density[behind[0] : behind[0] + 2].mean()
    near = np.argsort(np.abs(density - middle), kind='stable')[:4]  # the two neighbours first
    curve = _through(density[near], apart[near])
    fewer = near[: max(2, len(near) - 1)]
    place = _root(curve, middle)
    moved = errors[near] * _weights(density[near], place) / np.polyval(np.polyder(curve), place)
    return place, float(
        np.linalg.norm([*moved, place - _root(_through(density[fewer], apart[fewer]), place)])
    )


def _through(density, values):
    """Coefficients of the polynomial."""
    return np.polyfit(density, values, len(density) - 1)


def _root(curve, beside):
    """The real zero of a polynomial nearest to a density; there is one where it changes its
    sign."""
    roots = np.roots(curve)
    real = roots.real[np.abs(roots.imag) < REAL]
    return float(real[np.argmin(np.abs(real - beside))])


def _weights(density, place):
    """How much a polynomial moves there with each of the values that it goes through: Lagrange's
    polynomials."""
    return np.array(
        [
            np.prod([(place - other) / (one - other) for other in density if other != one])
            for one in density
        ]
    )
