"""What the paper plots against c_L, c_T and v at several densities, and calls almost linear: how
straight it is, its curvature, and where it is c_L."""

import numpy as np

from . import crossing
from .row import Row

ROUNDS = 10  # errors of both, of what is fitted, depend on its slope
UNIT = 'sigma/time unit'


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
    def curvature(self):
        """(coefficient of the square, its error)"""
        place = self.degree - 2
        return float(self.coefficients[place]), float(self.covariance[place, place] ** 0.5)

    def farthest(self):
        """(c_L, percent of what is fitted, its error) of the point that is farthest off."""
        off = 100 * (self.y / self.at(self.x) - 1)
        one = int(np.argmax(np.abs(off)))
        return float(self.x[one]), float(off[one]), float(100 * self.errors[one] / self.y[one])


def straight(triples):
    """Rows of {symbol: points}: how far from a straight line."""
    return [_straight_row(*one) for one in triples.items()]


def beside(triples):
    return [of(*one) for of in (_curvature_row, _equal_row) for one in triples.items()]


def _straight_row(symbol, points):
    quantity = f'{symbol} over c_L, farthest from its straight line'
    if len(points) < 3:
        return Row(quantity, 0.0, unit='%')
    line = Polynomial(points, 1)
    place, off, error = line.farthest()
    slope, start = line.coefficients[0], float(line.at(0))
    remark = f'at c_L = {place:.3f}; {symbol} = {start:.3f} + {slope:.3f} c_L'
    return Row(quantity, 0.0, off, error, '%', remark, count=len(points))


def _curvature_row(symbol, points):
    row = Row(f'curvature of {symbol} over c_L, coefficient of c_L^2', unit='time unit/sigma')
    if len(points) >= 4:
        parabola, off = Polynomial(points, 2), Polynomial(points, 1).chi2
        row.measured, row.error = parabola.curvature
        row.remark = (
            f'chi^2 {parabola.chi2:.0f} for {parabola.freedom}, {off:.0f} without it; '
            f'farthest {parabola.farthest()[1]:+.1f} %'
        )
    return row


def _equal_row(symbol, points):
    """Where the difference c_L - c_T, or v - c_L, goes through zero from below."""
    row = Row(f'c_L at which {symbol} = c_L', unit=UNIT)
    if len(points) >= 2:
        x, x_errors, y, y_errors = np.array(sorted(points)).T
        apart = x - y if symbol == 'c_T' else y - x
        row.measured, row.error = crossing.measured(x, apart, np.hypot(x_errors, y_errors))
    return row
