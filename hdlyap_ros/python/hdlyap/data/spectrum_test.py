"""Samples of two runs of one system -> how sums of their exponents fluctuate, and from that whether
their spectra agree."""

import numpy as np
from scipy.special import betainc

MOST = 100  # most blocks of a run
FEWEST = 8  # fewest blocks of both runs together; with fewer nothing is known
FREEDOM_OF_GROUP = 6  # degrees of freedom for each group of exponents
GROUPS = 16  # most groups


class SpectrumTest:
    """Fluctuations of the exponents of two sides, each a list of data.run.Run. Samples are gathered
    into blocks of about equal length. Their deviations from the mean of their run, times the root
    of the length, have the same distribution on both sides. `stated` is std_error^2 times averaged
    time of each exponent: where it is larger than that of blocks, these are correlated, and
    deviations are scaled up to it. `scattered`: the part of `stated` that is known from the
    differences between the runs of a side alone; `freedom` are the degrees of freedom with it."""

    def __init__(self, sides, stated, scattered=0.0):
        rows = [block for runs in sides for run in runs for block in _deviations(run)]
        self.freedom = len(rows) - sum(len(runs) for runs in sides)
        self.is_known = len(rows) >= FEWEST and self.freedom > 0
        if self.is_known:
            between = max(1, sum(len(runs) - 1 for runs in sides))
            shares = (1 - scattered) ** 2 / self.freedom, scattered**2 / between
            self.freedom = 1 / sum(shares)
            self._rows = np.array(rows)
            squares = (self._rows**2).sum(axis=0) / self.freedom
            self._rows *= _memory(squares, stated)
            self.is_known = bool((squares > 0).all())

    def error(self, weights, times):
        """The error of the difference of sum(weights * exponents) between sides with these averaged
        times."""
        square = ((self._rows @ weights) ** 2).sum() / self.freedom
        return float(np.sqrt(square * np.sum(1 / np.asarray(times))))

    def spectra(self, difference, taken, times):
        """(Hotelling's T^2, groups, chance) of the difference between two spectra. The exponents
        that are `taken` are averaged over groups of neighbours, as many as there are enough blocks
        for. For Gaussian blocks T^2 (f - g + 1) / (f g) has the F distribution with g and f - g + 1
        degrees of freedom (Hotelling 1931)."""
        f = self.freedom
        g = min(len(taken), GROUPS, max(1, int(f / FREEDOM_OF_GROUP)))
        groups = np.zeros((len(difference), g))
        for group, members in zip(groups.T, np.array_split(taken, g)):
            group[members] = 1 / len(members)
        # Q R of the deviations keeps digits even if their covariance is nearly singular
        r = np.linalg.qr(self._rows @ groups / np.sqrt(self.freedom), mode='r')
        by_error = np.linalg.lstsq(r.T, groups.T @ difference, rcond=None)[0]
        t2 = float(by_error @ by_error / np.sum(1 / np.asarray(times)))
        x = t2 / (t2 + f)  # the F distribution is an incomplete beta function of this
        return t2, g, float(betainc((f - g + 1) / 2, g / 2, 1 - x))


def _deviations(run):
    lengths, exponents = run.local.lengths, run.local.exponents
    there = np.isfinite(exponents).all(axis=1) if len(exponents) else []
    lengths, exponents = lengths[there], exponents[there]
    if len(lengths) < 2:
        return []
    ends = np.cumsum(lengths)
    places = np.minimum(ends * (MOST / ends[-1]) - 1e-9, MOST - 1).astype(int)
    begins = np.flatnonzero(np.diff(places, prepend=-1))
    of_block = np.add.reduceat(lengths, begins)
    means = np.add.reduceat(exponents * lengths[:, None], begins) / of_block[:, None]
    mean = of_block @ means / ends[-1]
    return list((means - mean) * np.sqrt(of_block)[:, None])


def _memory(squares, stated):
    """By which factor each exponent fluctuates more than blocks say; the median over neighbours."""
    with np.errstate(divide='ignore', invalid='ignore'):
        ratios = np.sqrt(stated / squares)
    ratios = np.where(np.isfinite(ratios), ratios, 1.0)
    near = max(1, len(ratios) // GROUPS)
    groups = np.array_split(np.arange(len(ratios)), max(1, len(ratios) // near))
    return np.concatenate([np.full(len(g), max(1.0, np.median(ratios[g]))) for g in groups])
