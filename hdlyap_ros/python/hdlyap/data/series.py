"""Successive samples, such as run.local -> how long they are correlated, and the error of their
mean. Samples are along the first axis; every column of other axes is a separate series."""

from collections import namedtuple

import numpy as np

SLOWER = 1.5  # correlations may decay slower than their sum says by this factor
AT_LEAST = 1.0001  # least sum, because a smaller one has no decay
FEWEST = 8  # fewest blocks, or independent samples, that give an error

# for each length of blocks, in samples or as the sum of these: the error of the mean, and its error
Blocks = namedtuple('Blocks', 'lengths errors uncertainties')


def autocorrelation(values):
    """rho(0) = 1, rho(1) ..: the correlation of samples at this distance. NaN if they are
    constant."""
    off, _ = _deviations(values)
    n = len(off)
    power = np.abs(np.fft.rfft(off, 2 * n, axis=0)) ** 2
    covariance = np.fft.irfft(power, 2 * n, axis=0)[:n]
    with np.errstate(invalid='ignore'):
        return covariance / np.where(np.ptp(off, axis=0) > 0, covariance[0], 0)


def autocorrelation_time(values):
    """1 + 2 (rho(1) + rho(2) ..), in samples. The mean of N samples fluctuates as that of N / this
    independent samples. NaN if there are too few samples to know it, or if they are constant."""
    return _time(autocorrelation(values))


def effective_samples(values):
    """How many independent samples would give the same error of the mean."""
    return len(values) / autocorrelation_time(values)


def standard_error(values, lengths=None):
    """The standard error of the mean of samples, weighted with their lengths."""
    off, weights = _deviations(values, lengths)
    n, off = len(off), off * weights
    squares = (off**2).sum(axis=0) * n / (n - 1)
    return np.sqrt(squares * autocorrelation_time(off)) / weights.sum()


def block_errors(values, lengths=None):
    """Errors from blocks of 1, 2, 4 .. samples, as if blocks were independent: errors grow with the
    length until blocks are so (Flyvbjerg and Petersen 1989)."""
    off, weights = _deviations(values, lengths)
    found, size = [], 1
    while len(off) // size >= FEWEST:
        count = len(off) // size
        w = weights[: count * size].reshape(count, size, *weights.shape[1:])
        sums = (w * off[: count * size].reshape(count, size, *off.shape[1:])).sum(axis=1)
        of_block = w.sum(axis=1)
        sums -= of_block * sums.sum(axis=0) / of_block.sum()  # the last samples may be in no block
        error = np.sqrt((sums**2).sum(axis=0) * count / (count - 1)) / of_block.sum()
        found.append((of_block.mean(), error, error / np.sqrt(2 * (count - 1))))
        size *= 2
    return Blocks(*map(np.array, zip(*found))) if found else Blocks(*np.empty((3, 0)))


def _deviations(values, lengths=None):
    """The deviations from the mean, and weights of a shape to multiply them with. Raises ValueError
    if these are no samples."""
    values = np.asarray(values, dtype=float)
    if values.ndim < 1 or len(values) < 2:
        raise ValueError(f'values of shape {values.shape}: there must be 2 samples or more')
    weights = np.ones(len(values)) if lengths is None else np.asarray(lengths, dtype=float)
    if weights.shape != values.shape[:1] or not (weights > 0).all():
        raise ValueError(f'lengths: must be {len(values)} numbers above 0, one of each sample')
    if not np.isfinite(values).all():
        where = np.argwhere(~np.isfinite(values))[0]
        raise ValueError(f'values: {values[tuple(where)]} at {where.tolist()}: must be finite')
    mean = np.average(values, axis=0, weights=weights)
    return values - mean, weights.reshape(-1, *[1] * (values.ndim - 1))


def _time(rho):
    """The autocorrelation time. The sum ends at the lag where the part that is left out is as large
    as the noise that more lags would add (Wolff, Comput. Phys. Commun. 156, 143 (2004))."""
    n = len(rho)
    lags = np.arange(n).reshape(-1, *[1] * (rho.ndim - 1))
    sums = 2 * np.cumsum(rho, axis=0) - 1
    by_sum = np.log((np.maximum(sums, AT_LEAST) + 1) / (np.maximum(sums, AT_LEAST) - 1))
    alternating = -np.log(np.clip(-rho[1], 1e-9, 1 - 1e-9))  # the sum does not show this decay
    decay = SLOWER / np.minimum(by_sum, alternating)
    left_out = np.exp(-lags / decay) - decay / np.sqrt(np.maximum(lags, 1) * n)
    is_enough = (left_out < 0) & (lags > 0)
    last = np.argmax(is_enough, axis=0)
    found = np.take_along_axis(sums, last[np.newaxis], axis=0)[0]
    found = found / np.maximum(1 - (2 * last + 1) / n, 0.5)  # because the mean was subtracted
    known = is_enough.any(axis=0) & (found > 0) & (found * FEWEST <= n)
    return np.where(known, found, np.nan)[()]
