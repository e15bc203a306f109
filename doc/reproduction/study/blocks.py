"""Numbers from sums over time, with errors from blocks of time."""

import numpy as np

BLOCKS = (
    16  # as many as an error needs to be known to a fifth; longer ones forget each other sooner
)


def of_sums(estimate, statistics, blocks=BLOCKS):
    """(estimate(sum of statistics), its standard error): the jackknife, leaving out one block of
    time after the other. statistics: one row for each time, in order. (None, 0) of fewer rows than
    blocks."""
    statistics = np.asarray(statistics, dtype=float)
    if len(statistics) < blocks:
        return None, 0.0
    pieces = np.array([piece.sum(axis=0) for piece in np.array_split(statistics, blocks)])
    total = pieces.sum(axis=0)
    without = np.array([estimate(total - piece) for piece in pieces])
    return estimate(total), np.sqrt((blocks - 1) * without.var(axis=0))


def quotient(above, below, blocks=BLOCKS):
    """(sum of above / sum of below, its standard error)."""
    value, error = of_sums(lambda sums: sums[0] / sums[1], np.column_stack([above, below]), blocks)
    return value if value is None else float(value), float(error)


def mean(values):
    return quotient(values, np.ones(len(values)))
