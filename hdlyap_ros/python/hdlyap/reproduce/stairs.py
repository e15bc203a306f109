"""Exponents -> stairs: how many neighbours go on without a jump, whatever was found by
projection."""

import numpy as np

from hdlyap.plots.numbers import known

LEAST = 0.01  # of the exponent: smaller differences of neighbours are none
SIGMAS = 3.0  # combined standard errors of a difference that is none


class Stair:
    """Neighbouring exponents without a jump; Lyapunov indices of its first and last one."""

    def __init__(self, first, last):
        self.first, self.last = first, last

    @property
    def count(self):
        return self.last - self.first + 1


def stairs(recording):
    """Of the positive exponents carried, smallest first; the largest ones are one stair with
    many."""
    last = min(recording.positive_end, recording.last_index)
    offset = recording.spectrum.first_index
    exponents = np.array(recording.spectrum.exponents[: last + 1 - offset])
    errors = np.nan_to_num(known(recording.spectrum.std_errors[: last + 1 - offset]))
    fall = exponents[:-1] - exponents[1:]
    allowed = np.maximum(LEAST * np.abs(exponents[1:]), SIGMAS * np.hypot(errors[:-1], errors[1:]))
    edges = offset + 1 + np.flatnonzero(fall > allowed)  # indices behind a jump
    firsts = [offset, *edges]
    return [Stair(int(first), int(end) - 1) for first, end in zip(firsts, [*edges, last + 1])][::-1]
