"""Mean of what was seen at many times, with its standard error."""

import numpy as np

UNKNOWN = None, 0.0  # value and error of what is not in the bags
BLOCKS = 10  # longer than what fluctuates, and still enough of them for an error
LEAST = 4


def of_snapshots(values):
    """(mean, standard error) of values so far apart in time that they do not know of each other;
    -1: not known."""
    values = np.asarray(values, dtype=float)
    if len(values) < 2:
        return values.mean(axis=0), np.full_like(values[0], -1.0)
    return values.mean(axis=0), values.std(axis=0, ddof=1) / np.sqrt(len(values))


def weighted(values, errors):
    """(mean, its standard error, chi^2 about it) of independent values with these errors; the error
    is larger where the values scatter more than theirs."""
    values, errors = np.asarray(values, dtype=float), np.asarray(errors, dtype=float)
    weights = errors**-2
    mean = np.average(values, weights=weights)
    chi2 = np.sum(weights * (values - mean) ** 2)
    wider = max(1.0, chi2 / max(1, len(values) - 1))
    return float(mean), float(np.sqrt(wider / weights.sum())), float(chi2)


def difference(one, other):
    """(value, its standard error) of two (value, error) that do not know of each other."""
    return float(one[0] - other[0]), float(np.hypot(one[1], other[1]))


def quotient(above, below):
    """(value, its standard error) of two (value, error) that do not know of each other; -1 if one
    of these is not known."""
    ratio = above[0] / below[0]
    relative = [error / abs(value) for value, error in (above, below)]
    known = all(np.isfinite(error) and error >= 0 for error in relative)
    return float(ratio), float(abs(ratio) * np.hypot(*relative)) if known else -1.0


def of_series(values):
    """The same of a series in which neighbours resemble each other: from the means of blocks."""
    values = np.asarray(values, dtype=float)
    count = min(BLOCKS, len(values) // 2)
    if count < LEAST:
        return values.mean(axis=0), np.full_like(values[0], -1.0)
    length = len(values) // count
    blocks = (
        values[len(values) - count * length :]
        .reshape(count, length, *values.shape[1:])
        .mean(axis=1)
    )
    return values.mean(axis=0), of_snapshots(blocks)[1]
