"""Polynomials through points with errors, and where what they go through crosses zero."""

import numpy as np

from .averages import UNKNOWN

ROUNDS = 10  # errors of both, of what is fitted, depend on its slope
REAL = 1e-9  # imaginary part of a zero that is real


class Polynomial:
    """y = a + b u + .. of a degree, u = x - mean of x, weighted with the errors of both; its errors
    grow where the points scatter more. points: (x, error, y, error)."""

    def __init__(self, points, degree):
        self.x, x_errors, self.y, y_errors = np.array(points, dtype=float).T
        self.middle, self.degree = self.x.mean(), degree
        u, slope = self.x - self.middle, np.zeros(len(self.x))
        for _ in range(ROUNDS):
            self.errors = np.hypot(y_errors, slope * x_errors)
            self.coefficients, covariance = np.polyfit(
                u, self.y, degree, w=1 / self.errors, cov='unscaled'
            )
            slope = np.polyval(np.polyder(self.coefficients), u)
        self.freedom = len(self.x) - degree - 1
        off = (self.y - self.at(self.x)) / self.errors
        self.chi2 = float(off @ off)
        scatter = max(1.0, self.chi2 / self.freedom) if self.freedom else 1.0
        self.covariance = scatter * covariance

    def at(self, x):
        return np.polyval(self.coefficients, np.asarray(x) - self.middle)

    @property
    def leading(self):
        """(coefficient of the highest power, its error)"""
        return float(self.coefficients[0]), float(self.covariance[0, 0] ** 0.5)

    def farthest(self):
        """(x, percent of what is fitted, its error) of the point that is farthest off."""
        off = 100 * (self.y / self.at(self.x) - 1)
        one = int(np.argmax(np.abs(off)))
        return float(self.x[one]), float(off[one]), float(100 * self.errors[one] / self.y[one])


def crossing(x, apart, errors):
    """(where a smooth difference goes through zero from below, its standard error): a polynomial
    through the four points round it. Errors are taken through its slope there, since a crossing
    that moves far may leave the points that were measured; how far that of three of them moves it
    is part of the error."""
    x, apart, errors = (np.asarray(values, dtype=float) for values in (x, apart, errors))
    behind = np.flatnonzero((apart[:-1] < 0) & (apart[1:] >= 0))
    if not len(behind):
        return UNKNOWN
    middle = x[behind[0] : behind[0] + 2].mean()
    near = np.argsort(np.abs(x - middle), kind='stable')[:4]  # the two neighbours first
    curve, place = _through(x[near], apart[near], middle)
    _, of_fewer = _through(*(one[near[: max(2, len(near) - 1)]] for one in (x, apart)), middle)
    moved = errors[near] * _weights(x[near], place) / np.polyval(np.polyder(curve), place)
    return place, float(np.linalg.norm([*moved, place - of_fewer]))


def _through(x, values, beside):
    """(coefficients of the polynomial, its real zero nearest to a place); there is one where it
    changes its sign."""
    curve = np.polyfit(x, values, len(x) - 1)
    roots = np.roots(curve)
    real = roots.real[np.abs(roots.imag) < REAL]
    return curve, float(real[np.argmin(np.abs(real - beside))])


def _weights(x, place):
    """How much a polynomial moves there with each of the values that it goes through: Lagrange's
    polynomials."""
    return [np.prod([(place - two) / (one - two) for two in x if two != one]) for one in x]
