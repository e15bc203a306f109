"""Rows of the comparison: published, measured, error, verdict."""

from math import isfinite
from numbers import Integral, Real

from hdlyap.plots.numbers import with_error

SIGMAS = 3.0  # standard errors of ours that numbers may be apart, beyond what the paper leaves open
# of the published number, or what the paper leaves open if that is more: agreeing says little if
# our uncertainty is larger
TELLING = 0.1
SMALL = 1e-3  # without an error: below, the usual decimals would show little of a number
AGREES, DIFFERS, MISSING, SHOWN = 'agrees', 'differs', 'not measured', ''
POOR = 'known too poorly'  # not apart, but hardly any number would have been
HEADER = (
    'part',
    'quantity',
    'published',
    'published_error',
    'measured',
    'error',
    'unit',
    'verdict',
    'remark',
)


class Row:
    """One number (or word) of the paper beside ours with its standard error. published_error: what
    the paper leaves open to either side: the scatter round its fits, half of the last digit, 0 for
    counts. measured None: not in the bags. published None: the paper has none, ours is only shown.
    enough: the largest standard error with which agreeing says something; None: by the published
    number."""

    def __init__(
        self,
        quantity,
        published=None,
        measured=None,
        error=0.0,
        published_error=0.0,
        unit='',
        remark='',
        enough=None,
    ):
        self.part = None  # set by who collects the rows
        self.quantity, self.unit, self.remark = quantity, unit, remark
        self.published, self.published_error = published, published_error
        self.measured, self.error, self.enough = measured, error, enough

    def _agrees(self):
        if isinstance(self.published, str) or isinstance(self.measured, str):
            return self.published == self.measured
        return (
            abs(self.measured - self.published) <= self.published_error + SIGMAS * self._known_error
        )

    @property
    def _known_error(self):
        """Not known yet: none to forgive."""
        return self.error if isfinite(self.error) and self.error > 0 else 0.0

    def _is_poor(self):
        if isinstance(self.published, str) or isinstance(self.measured, str):
            return False
        if self.enough is not None:
            return self._known_error > self.enough
        matters = max(self.published_error, TELLING * abs(self.published))
        return 0 < matters < SIGMAS * self._known_error

    @property
    def verdict(self):
        if self.measured is None or not (isinstance(self.measured, str) or isfinite(self.measured)):
            return MISSING
        if self.published is None:
            return SHOWN
        if not self._agrees():
            return DIFFERS
        return POOR if self._is_poor() else AGREES

    def cells(self):
        """As text, for the page."""
        return (
            self.quantity,
            _bounded(self.published, self.published_error),
            _number(self.measured, self.error),
            self.unit,
            self.verdict,
            self.remark,
        )

    def values(self):
        """As in HEADER, for the CSV file."""
        return (
            self.part,
            self.quantity,
            *_plain(self.published, self.published_error),
            *_plain(self.measured, self.error),
            self.unit,
            self.verdict,
            self.remark,
        )


def _number(value, error):
    if value is None:
        return '-'
    if isinstance(value, str):
        return value
    if isinstance(value, Integral) and not error:
        return str(value)
    if not error and 0 < abs(value) < SMALL:
        return f'{value:.1e}'
    return with_error(value, error) if isfinite(value) else '-'


def _bounded(value, bound):
    if bound and not isinstance(value, (str, type(None))):
        return f'{value:.4g} +-{bound:.2g}'
    return (
        f'{value:.6g}'
        if isinstance(value, Real) and not isinstance(value, Integral)
        else _number(value, 0.0)
    )


def _plain(value, error):
    if not isinstance(value, Real) or not isfinite(value):
        return value if isinstance(value, str) else '', ''
    if isinstance(value, Integral) and not error:
        return value, ''
    return f'{value:.7g}', f'{error:.3g}' if error >= 0 else ''
