"""Two measurements of the same -> how far apart they are, and how likely that is by chance."""

import numpy as np
from scipy.special import stdtr

from hdlyap.numbers import known

FREEDOM = 7  # of an error, as of 8 blocks: the node asks 16, which may remember each other


class Deviation:
    """A quantity of the runs a and b. Its z is the difference in standard errors; NaN while one of
    the errors is not known. What is not judged is only shown, unless it is no number: that never
    agrees, whatever its error. What the two values come from is in `origins`. joint: (error of
    the difference, its degrees of freedom) where it is better known than by both errors."""

    def __init__(self, name, values, errors, judged=True, origins=(), joint=None):
        self.name, self.values = name, values
        self.is_number = bool(np.isfinite(values).all())
        self.judged, self.origins = judged or not self.is_number, origins
        self.errors = known(errors)
        self.difference = values[1] - values[0]
        self.error, self._freedom = joint or (float(np.hypot(*self.errors)), None)
        self.z = self._in_errors()

    @property
    def is_known(self):
        return bool(np.isfinite(self.error)) or not self.is_number

    @property
    def chance(self):
        """Probability of a difference as large between means over few blocks (Welch)."""
        if self.z == 0 or np.isinf(self.z):
            return float(self.z == 0)
        freedom = self._freedom
        if not freedom:
            shares = (self.errors / self.error) ** 2  # their squares may be too large for a number
            freedom = FREEDOM / float(np.sum(shares**2))
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
    """Those that are judged and least likely by chance, the least first."""
    judged = [one for one in deviations if one.judged and one.is_known]
    return sorted(judged, key=lambda one: (one.chance, -abs(one.z)))[:count]
