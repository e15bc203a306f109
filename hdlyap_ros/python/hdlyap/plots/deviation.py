"""Two measurements of a quantity -> how far apart they are, and how likely that is by chance."""

import numpy as np
from scipy.special import stdtr

from hdlyap.numbers import known

FREEDOM = 7  # degrees of freedom of an error, from 8 blocks; the node has 16, maybe correlated


class Deviation:
    """A quantity of the runs a and b. z is the difference in standard errors; NaN if one of the
    errors is not known. A quantity that is not judged is only shown, but one that is not finite
    never agrees. `origins`: where the two values come from. freedom: the degrees of freedom of the
    two errors."""

    def __init__(self, name, values, errors, judged=True, origins=(), freedom=(FREEDOM, FREEDOM)):
        self.name, self.values = name, values
        self.is_number = bool(np.isfinite(values).all())
        self.judged, self.origins = judged or not self.is_number, origins
        self.errors = known(errors)
        self.difference = values[1] - values[0]
        self.error, self._joint = float(np.hypot(*self.errors)), None
        self._freedom = np.array(freedom, dtype=float)
        self.z = self._in_errors()

    def know_better(self, error, freedom):
        """Takes this error of the difference, with its degrees of freedom, in place of that which
        follows from the two errors."""
        self.error, self._joint = error, freedom
        self.z = self._in_errors()

    @property
    def is_joint(self):
        """Whether the two errors do not add up to that of the difference."""
        return self._joint is not None

    @property
    def is_known(self):
        return bool(np.isfinite(self.error)) or not self.is_number

    @property
    def chance(self):
        """The probability of a difference as large, between means over few blocks (Welch)."""
        if self.z == 0 or np.isinf(self.z):
            return float(self.z == 0)
        freedom = self._joint
        if freedom is None:
            shares = (self.errors / self.error) ** 2  # squares of errors might overflow
            freedom = 1 / float(np.sum(shares**2 / self._freedom))
        return 2 * float(stdtr(freedom, -abs(self.z)))  # both tails of Student's t

    def _in_errors(self):
        if not self.is_number:
            return np.inf
        if not self.is_known:
            return np.nan
        if self.difference == 0:
            return 0.0
        return self.difference / self.error if self.error > 0 else np.inf


def unlikeliest(deviations, count=1):
    """The judged deviations that are least likely by chance, the least likely one first."""
    judged = [one for one in deviations if one.judged and one.is_known]
    return sorted(judged, key=lambda one: (one.chance, -abs(one.z)))[:count]
