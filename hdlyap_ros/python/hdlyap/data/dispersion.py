"""Exponents of steps -> the dispersion relation lambda = c k + c2 k^2 + c3 k^3, or its first
terms."""

import numpy as np

TERMS = 3


class Curve:
    """A fit to arrays, weighted with their errors. terms: 1 or 2 (None: 2, but 1 if there is only
    one wave number). Errors are multiplied by sqrt(chi^2 / freedom) if that is above 1."""

    def __init__(self, k, exponents, errors, terms=None):
        k, exponents, errors = (np.array(list(one), dtype=float) for one in (k, exponents, errors))
        self.terms = terms or min(2, number_of(k))
        is_known = bool((errors > 0).all())
        weights = errors**-2.0 if is_known else np.ones(len(k))
        powers = _powers(k)[:, : self.terms]
        inverse = np.linalg.inv(powers.T @ (weights[:, None] * powers))
        coefficients = inverse @ powers.T @ (weights * exponents)
        self.freedom = len(k) - self.terms
        self.chi2 = float(weights @ (exponents - powers @ coefficients) ** 2)
        known = self.freedom > 0 and is_known
        self.misfit = float(np.sqrt(self.chi2 / self.freedom)) if known else -1.0
        self.coefficients, self.covariance = np.zeros(TERMS), np.zeros((TERMS, TERMS))
        self.coefficients[: self.terms] = coefficients
        self.covariance[: self.terms, : self.terms] = max(1.0, self.misfit) ** 2 * inverse
        self.c, self.c2, _ = self.coefficients
        self.errors = np.sqrt(np.diag(self.covariance)) if is_known else np.full(TERMS, -1.0)
        self.c_error, self.c2_error, _ = self.errors
        self.c_sampling_error = self.c_error

    @property
    def correlation(self):
        """The correlation of c and c2."""
        return float(self.covariance[0, 1] / (self.c_error * self.c2_error))

    def at(self, k):
        """lambda and its error at a wave number."""
        powers = _powers(k)
        return float(powers @ self.coefficients), float(np.sqrt(powers @ self.covariance @ powers))


def number_of(k):
    """The number of different wave numbers; a square box has each of them twice."""
    return len({round(float(one), 9) for one in k})


def mean_difference(one, other, low, high, samples=101):
    """The mean relative difference of two curves, other / one - 1, from low to high, and its
    error."""
    powers = _powers(np.linspace(low, high, samples))
    first, second = powers @ one.coefficients, powers @ other.coefficients
    by_other = (powers / first[:, None]).mean(axis=0)
    by_one = (powers * (second / first**2)[:, None]).mean(axis=0)
    variance = by_other @ other.covariance @ by_other + by_one @ one.covariance @ by_one
    return float(np.mean(second / first) - 1), float(np.sqrt(variance))


def _powers(k):
    return np.stack([k, k * k, k**3], axis=-1)
