"""Exponents of steps -> the dispersion relation lambda = c k + c2 k^2."""

import numpy as np


class Curve:
    """Of arrays, weighted with the errors; one wave number alone knows no curvature: c2 is 0.
    Errors are multiplied by sqrt(chi^2 / freedom) where that exceeds 1, as those of the node."""

    def __init__(self, k, exponents, errors):
        k, exponents, errors = map(np.asarray, (k, exponents, errors))
        size = 2 if number_of(k) > 1 else 1
        weights = errors**-2.0
        powers = _powers(k)[:, :size]
        inverse = np.linalg.inv(powers.T @ (weights[:, None] * powers))
        coefficients = inverse @ powers.T @ (weights * exponents)
        self.freedom = len(k) - size
        self.chi2 = float(weights @ (exponents - powers @ coefficients) ** 2)
        scatter = max(1.0, self.chi2 / self.freedom if self.freedom else 1.0)
        self.coefficients, self.covariance = np.zeros(2), np.zeros((2, 2))
        self.coefficients[:size], self.covariance[:size, :size] = coefficients, scatter * inverse
        self.c, self.c2 = self.coefficients
        self.c_error, self.c2_error = np.sqrt(np.diag(self.covariance))

    @property
    def correlation(self):
        """Of c and c2."""
        return float(self.covariance[0, 1] / (self.c_error * self.c2_error))

    def at(self, k):
        """(lambda, its error) at a wave number."""
        powers = _powers(k)
        return float(powers @ self.coefficients), float(np.sqrt(powers @ self.covariance @ powers))


def number_of(k):
    """How many wave numbers these are; a square box has each twice."""
    return len({round(float(one), 9) for one in k})


def mean_difference(one, other, low, high, samples=101):
    """(mean relative difference of two curves, other over one less 1, from low to high, its
    error)."""
    powers = _powers(np.linspace(low, high, samples))
    first, second = powers @ one.coefficients, powers @ other.coefficients
    by_other = (powers / first[:, None]).mean(axis=0)
    by_one = (powers * (second / first**2)[:, None]).mean(axis=0)
    variance = by_other @ other.covariance @ by_other + by_one @ one.covariance @ by_one
    return float(np.mean(second / first) - 1), float(np.sqrt(variance))


def _powers(k):
    return np.stack([k, k * k], axis=-1)
