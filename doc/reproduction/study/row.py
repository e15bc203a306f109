"""Numbers beside ours -> verdicts: a statement of claims.yaml, and the measured values behind it,
each with its error and the smallest wrong value that would have been caught."""

from math import inf, isfinite, sqrt
from numbers import Integral, Real

from hdlyap.numbers import with_error

from .averages import weighted

SIGMAS = 3.0  # standard errors of ours that numbers may be apart, beyond what is left open
SEEN = 2.0  # more of them: a truth that far off turns a row red in 97.7 % of all repetitions
# of the published number: agreeing says little if only a larger deviation would have been seen
TELLING = 0.1
SMALL = 1e-3  # without an error: below, the usual decimals would show little of a number
AGREES, DIFFERS, MISSING, SHOWN = 'agrees', 'differs', 'not measured', ''
UNDECIDED = 'not decided'  # not apart, but a wrong value would not have been, either
EQUAL, ABOVE, BELOW = '', 'above ', 'below '
HEADER = (
    'part kind where words claim criterion criterion_of claim_verdict '
    'quantity published left_open measured error unit verdict caught remark'
).split()


class Row:
    """One number (or word) beside ours with its standard error: 0 if exact, below 0 or no number if
    not known. measured None: not in the bags. published None: ours is only shown. sense: ABOVE or
    BELOW if published is a limit. left_open: what the criterion allows to either side; telling: the
    largest power with which agreeing says something. None of these: as the claim says it; telling
    is then TELLING of the published number, or, of zero, twice what is left open. caught: the power
    of words, as text. count: of measured values behind it."""

    def __init__(
        self, quantity, published=None, measured=None, error=0.0, unit='', remark='', **more
    ):
        self.quantity, self.unit, self.remark = quantity, unit, remark
        self.published, self.measured, self.error = published, measured, error
        self.left_open, self.sense = more.pop('left_open', None), more.pop('sense', EQUAL)
        self.count, self._telling = more.pop('count', 1), more.pop('telling', None)
        self._caught = more.pop('caught', 'any other')
        assert not more, more

    def judge(self, entry):
        """By what the claim leaves open, a number or `3 %` of what is published, or its limit."""
        for sense in (ABOVE, BELOW):
            if sense.strip() in entry:
                self.sense, self.published = sense, entry[sense.strip()]
        if self.left_open is None:
            self.left_open = share(entry.get('open', 0.0), self.published)
        if self._telling is None and 'telling' in entry:
            self._telling = share(entry['telling'], self.published)
        return self

    @property
    def is_measured(self):
        is_word = isinstance(self.measured, str)
        return self.measured is not None and (is_word or isfinite(self.measured))

    @property
    def _is_word(self):
        return isinstance(self.published, str) or isinstance(self.measured, str)

    @property
    def power(self):
        """The smallest deviation of the truth from what is published that would have made the row
        differ, but for one repetition in 44; infinite while the error is not known."""
        is_known = isfinite(self.error) and self.error >= 0
        return (self.left_open or 0.0) + (SIGMAS + SEEN) * self.error if is_known else inf

    @property
    def telling(self):
        if self._telling is not None:
            return self._telling
        return TELLING * abs(self.published) if self.published else 2 * (self.left_open or 0.0)

    @property
    def verdict(self):
        if not self.is_measured:
            return MISSING
        if self.published is None:
            return SHOWN
        if self._is_word:
            return AGREES if self.published == self.measured else DIFFERS
        # not known yet: none to forgive
        sure = SIGMAS * self.error if isfinite(self.error) and self.error > 0 else 0.0
        return self._beside_a_limit(sure) if self.sense else self._beside_a_number(sure)

    def _beside_a_limit(self, sure):
        off = (self.measured - self.published) * (1 if self.sense == ABOVE else -1)
        if off < -sure:
            return DIFFERS
        return AGREES if off > sure and isfinite(self.power) else UNDECIDED

    def _beside_a_number(self, sure):
        if abs(self.measured - self.published) > (self.left_open or 0.0) + sure:
            return DIFFERS
        return AGREES if self.power <= self.telling else UNDECIDED

    @property
    def caught(self):
        """The power as text: of the published number, if that is none of zero."""
        if self.published is None or not self.is_measured:
            return ''
        if self._is_word or self.power == 0:
            return self._caught
        if not isfinite(self.power):
            return 'not known'
        if self.published and not self.sense:
            return f'{100 * self.power / abs(self.published):.2g} %'
        return f'{self.power:.2g} {self.unit}'.rstrip()

    def cells(self):
        """As text, for the page."""
        published = self.sense + _bounded(self.published, self.left_open)
        numbers = self.quantity, published, _number(self.measured, self.error)
        return (*numbers, self.unit, self.verdict, self.caught, self.remark)

    def values(self):
        """As in HEADER from `quantity` on, for the CSV file."""
        published, left_open = _plain(self.published, self.left_open or 0.0)
        measured = _plain(self.measured, self.error)
        number = self.quantity, f'{self.sense}{published}', left_open, *measured
        return (*number, self.unit, self.verdict, self.caught, self.remark)


class Scatter(Row):
    """Values of one number, or round one curve: chi^2 decides, one-sided at SIGMAS. errors: theirs,
    in percent; telling: percent by which a single value may be off without being seen."""

    def __init__(self, quantity, chi2=None, freedom=0, errors=(), remark='', **more):
        super().__init__(quantity, freedom, chi2, 0.0, 'chi^2', remark, count=len(errors), **more)
        self.left_open = critical(freedom) - freedom if freedom else 0.0
        self.errors = errors

    def _beside_a_number(self, sure):
        """Less than expected is no difference: values may fluctuate together."""
        if self.measured > self.published + self.left_open:
            return DIFFERS
        return AGREES if self.power <= self.telling else UNDECIDED

    @property
    def power(self):
        """Percent by which the least known value alone must be off. It adds x to the mean of
        chi^2, whose root then scatters by 1."""
        if not len(self.errors) or not self.published:
            return inf
        x = (sqrt(critical(self.published)) + SEEN) ** 2 - (self.published - 1)
        return max(self.errors) * sqrt(x * len(self.errors) / self.published)

    @property
    def caught(self):
        return f'{self.power:.2g} % of one' if self.is_measured else ''

    def cells(self):
        name, _, measured, *others = super().cells()
        if self.is_measured:
            measured = f'{self.measured:.1f} for {self.published}'
        return (name, f'below {self.published + self.left_open:.1f}', measured, *others)


def about_mean(quantity, pairs, remark):
    """Scatter of (value, error) about their weighted mean; remark(mean)."""
    if len(pairs) < 2:
        return Scatter(quantity)
    mean, _, chi2 = weighted(*zip(*pairs))
    errors = [100 * error / mean for _, error in pairs]
    return Scatter(quantity, chi2, len(pairs) - 1, errors, remark(mean))


def critical(freedom):
    """chi^2 that is exceeded by chance as rarely as SIGMAS standard deviations (Wilson and
    Hilferty)."""
    spread = 2 / (9 * freedom)
    return freedom * (1 - spread + SIGMAS * sqrt(spread)) ** 3


class Claim:
    """A statement of the table, and the rows that it is judged by: it agrees if all that were
    measured do, or one of them if `any`. Rows without a published number are only shown, and so is
    an entry that has no others."""

    def __init__(self, part, entry, rows):
        self.part, self.entry = part, entry
        self.rows = [row.judge(entry) for row in rows]

    name = property(lambda self: self.entry['claim'])
    kind = property(lambda self: self.entry['kind'])

    @property
    def judged(self):
        return [row for row in self.rows if row.published is not None]

    @property
    def values(self):
        return sum(row.count for row in self.judged if row.is_measured)

    @property
    def verdict(self):
        given = [row.verdict for row in self.judged]
        if not given:
            return SHOWN
        any_of = self.entry.get('any')
        order = (DIFFERS, UNDECIDED, AGREES) if not any_of else (AGREES, UNDECIDED, DIFFERS)
        return next((one for one in order if one in given), MISSING)

    @property
    def heading(self):
        """A line of the page."""
        if not self.judged:
            return f'beside: {self.name}'
        many = f'{self.values} value' + ('s' if self.values != 1 else '')
        criterion = f'criterion, {self.entry["of"]}: {self.entry["criterion"]}'
        return f'{self.verdict}: {self.name} ({many}; {criterion})'

    def lines(self):
        """As in HEADER."""
        names = 'kind', 'where', 'words', 'claim', 'criterion', 'of'
        about = self.part, *(self.entry.get(name, '') for name in names), self.verdict
        return [(*about, *row.values()) for row in self.rows]


def share(number, of):
    """A number, or a text like `3 %`: of a number."""
    if not isinstance(number, str):
        return number
    return float(number.rstrip(' %')) / 100 * abs(of) if isinstance(of, Real) else 0.0


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
    is_number = isinstance(value, Real) and not isinstance(value, Integral)
    return f'{value:.6g}' if is_number else _number(value, 0.0)


def _plain(value, error):
    if not isinstance(value, Real) or not isfinite(value):
        return value if isinstance(value, str) else '', ''
    if isinstance(value, Integral) and not error:
        return value, ''
    return f'{value:.7g}', f'{error:.3g}' if error >= 0 else ''
