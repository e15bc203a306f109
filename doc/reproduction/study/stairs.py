"""Exponents -> stairs: how many neighbours go on without a jump, whatever was found by
projection."""

import numpy as np

from hdlyap.numbers import known

LEAST = 0.01  # of the exponent: smaller differences of neighbours are none
SIGMAS = 3.0  # combined standard errors of a difference that is none


class Stair:
    """Neighbouring exponents without a jump; Lyapunov indices of its first and last one. Where
    their errors are not known a small jump may be none."""

    def __init__(self, first, last, is_known=True):
        self.first, self.last, self.is_known = first, last, is_known

    @property
    def count(self):
        return self.last - self.first + 1


def stairs(recording):
    """Of the positive exponents carried, smallest first; the largest ones are one stair with
    many."""
    last = min(recording.positive_end, recording.last_index)
    offset = recording.spectrum.first_index
    exponents = np.array(recording.spectrum.exponents[: last + 1 - offset])
    stated = known(recording.spectrum.std_errors[: last + 1 - offset])
    errors = np.nan_to_num(stated)
    fall = exponents[:-1] - exponents[1:]
    allowed = np.maximum(LEAST * np.abs(exponents[1:]), SIGMAS * np.hypot(errors[:-1], errors[1:]))
    edges = offset + 1 + np.flatnonzero(fall > allowed)  # indices behind a jump
    firsts = [offset, *edges]
    return [
        Stair(
            int(first), int(end) - 1, bool(np.isfinite(stated[first - offset : end - offset]).all())
        )
        for first, end in zip(firsts, [*edges, last + 1])
    ][::-1]
