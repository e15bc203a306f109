"""Exponents that vanish, by their size alone: whatever number the scene says."""

from math import log

import numpy as np

SMALL = 10.0  # times what linear growth gives: an exponent that may be zero


def linear_growth(info, time):
    """Mean exponent, over a time, of a vector that grows linearly, as the zero modes do: ln(t)/t;
    less in a frame that is as old as the warm-up w when averaging begins, ln((w + t)/w)/t."""
    return log((info.warmup + time) / (info.warmup or 1.0)) / time


def threshold(info, spectrum):
    return SMALL * linear_growth(info, spectrum.averaged_time)


def indices(info, spectrum):
    """Lyapunov indices of the exponents that are smaller."""
    return spectrum.first_index + np.flatnonzero(
        np.abs(spectrum.exponents) < threshold(info, spectrum)
    )


def span(found):
    """As text: 38-43; with what is missing between the first and the last."""
    if not len(found):
        return 'none'
    first, last = int(found[0]), int(found[-1])
    missing = last - first + 1 - len(found)
    return f'{first}-{last}' + (f' but {missing} between them' if missing else '')
