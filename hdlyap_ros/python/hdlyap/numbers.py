"""Numbers as a physicist prints them."""

import argparse
from math import floor, isfinite, log10

import numpy as np

LARGE = 1e15  # larger values have no digits behind the point
PLACES = 9  # most decimals; with a smaller error only the size of a value is printed


def with_error(value, error, decimals=5):
    """A value with its error in units of the last two digits, as 0.61252(67); the value alone, with
    this many decimals, if its error is not known; - if there is no value."""
    if not isfinite(value):
        return '-'
    if not (isfinite(error) and error > 0):
        return fixed(value, decimals)
    # places of the rounded error: 0.00996 becomes 0.010
    places = 1 - floor(log10(float(f'{error:.1e}')))
    if places > PLACES or max(abs(value), error) > LARGE:
        return f'{value:.1e}'
    if places <= 0:
        return f'{round(value, places):.0f}({round(error, places):.0f})'
    digits = f'{error:.{places}f}'
    # an error of one unit or more keeps its point: 12.3(1.5)
    return f'{fixed(value, places)}({digits if error >= 1 else digits.lstrip("0.")})'


def fixed(value, decimals):
    """A value with this many decimals; a large one as 1e+308. What is rounded to 0 has no sign."""
    return (
        f'{round(value, decimals) + 0.0:.{decimals}f}'
        if abs(value) < LARGE
        else f'{value:.{decimals}g}'
    )


def known(errors):
    """Standard errors, with NaN instead of -1, by which messages say that one is not known yet."""
    errors = np.asarray(errors, dtype=float)
    return np.where(errors < 0, np.nan, errors)


def clock(seconds):
    """A time as 1:05 or 2:00:10; ? if it is none."""
    if not isfinite(seconds):
        return '?'
    minutes, seconds = divmod(int(seconds + 0.5), 60)
    hours, minutes = divmod(minutes, 60)
    return f'{hours}:{minutes:02d}:{seconds:02d}' if hours else f'{minutes}:{seconds:02d}'


def positive(text):
    """The type of an argument on the command line that has to be a positive number."""
    number = float(text)
    if not (number > 0 and isfinite(number)):
        raise argparse.ArgumentTypeError(f'{text}: must be above 0')
    return number
