"""Exponents of steps -> the dispersion relation lambda = c k + c2 k^2 + c3 k^3, or its first
terms."""

from collections import namedtuple

import numpy as np

TERMS = 3


class Curve:
    """A fit to arrays, weighted with their errors. terms: 1 or 2 (None: 2, but 1 if there is only
    one wave number). Errors are multiplied by sqrt(chi^2 / freedom) if that is above 1."""

    prior_share = np.nan

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


class LongBoxes(namedtuple('LongBoxes', 'c2 c2_error c3 c3_error box_error')):
    """What a Steps message says of long boxes: c2 / c and c3 / c with errors; and the relative
    error of c in this box."""

    @classmethod
    def of(cls, message, letter):
        names = [f'{letter}_long_{name}' for name in cls._fields[:4]] + [f'{letter}_box_error']
        return cls(*(getattr(message, name) for name in names))


class WithLongBoxes:
    """The fit of the node [T12], for independent steps: least squares over the steps, each with its
    error and its scatter, and over two more observations, c2 / c and c3 / c of long boxes. All
    these errors are multiplied by the misfit if that is above 1."""

    terms = TERMS

    def __init__(self, k, exponents, errors, scatter, long):
        k, exponents, errors, scatter = (
            np.array(list(one), dtype=float) for one in (k, exponents, errors, scatter)
        )
        is_known = bool((errors > 0).all())
        errors = errors if is_known else np.zeros(len(k))
        weights = 1 / (errors**2 + (scatter * exponents) ** 2)
        relation = _powers(k) @ (1.0, long.c2, long.c3)
        size = (weights * relation * exponents).sum() / (weights * relation**2).sum()
        rows = np.array([[-long.c2, 1.0, 0.0], [-long.c3, 0.0, 1.0]])
        rows /= size * np.array([[long.c2_error], [long.c3_error]])
        inverse = np.linalg.inv(_powers(k).T @ (weights[:, None] * _powers(k)) + rows.T @ rows)
        shares = inverse @ _powers(k).T * weights
        self.coefficients = shares @ exponents
        self.c_sampling_error = np.sqrt(shares[0] ** 2 @ errors**2) if is_known else -1.0
        left = np.diag(rows @ inverse @ rows.T)  # what is left of the variances in long boxes
        self.prior_share = float(left.mean())
        off = np.append(exponents - _powers(k) @ self.coefficients, rows @ self.coefficients)
        chi2 = float(np.append(weights, (1.0, 1.0)) @ off**2)
        self.misfit = np.sqrt(chi2 / (len(k) - 1)) if len(k) > 1 and is_known else -1.0
        own = max(1.0, self.misfit) ** 2 * np.diag(inverse)
        of_box = (long.box_error * self.coefficients) ** 2
        self.errors = np.sqrt(own + of_box) if is_known else np.full(TERMS, -1.0)


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
