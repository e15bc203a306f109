"""Steps message -> its fits, each with its basis: the relation, its wave numbers, and the share of
its curvature that comes from long boxes. `chosen` makes those of a form with fewer terms."""

import copy
from math import isclose, isnan, nan

from hdlyap.data.reader import RecordingError
from hdlyap.numbers import with_error

from . import dispersion, steps

SAME = 1e-9  # relative difference below which wave numbers are the same
# relations by their number of terms. The node alone fits three, with c2 and c3 of long boxes
RELATIONS = {1: 'c k', 2: 'c k + c2 k^2', 3: 'c k + c2 k^2 + c3 k^3'}
ASSUMED, ALL = 'curvature assumed', 0.995  # if steps say less than half a per cent of it
KINDS = {'t': steps.T, 'l': steps.LP}


class Fit:
    """A fit to one kind of step: c, c2 and c3, or v of the LP phases. count: number of wave numbers
    or, for v, of phases; 0 if there is no fit."""

    def __init__(self, message, letter, kind):
        self.kind = kind
        self.symbol = letter if letter == 'v' else f'c_{letter.upper()}'
        self.count = getattr(message, 'v_phases' if letter == 'v' else f'{letter}_points')
        self.misfit = getattr(message, f'{letter}_misfit')
        self.k_min = getattr(message, f'{letter}_k_min')
        self.k_max = getattr(message, f'{letter}_k_max')
        self.prior_share = nan if letter == 'v' else getattr(message, f'{letter}_prior_share')
        # the waves of v are in LpPhases
        self.waves = [] if letter == 'v' else _waves(message, kind, (self.k_min, self.k_max))
        names = _coefficients(message, letter, self.count)
        self.terms = len(names)
        # (name, value, error) of each coefficient, and by how much another run of the same box may
        # differ; NaN if the form of the fit decides
        self.values = [
            (name[0] + name[1:].upper(), getattr(message, name), getattr(message, name + '_error'))
            for name in names
        ]
        self.sampling_errors = [error for _, _, error in self.values]
        if letter == 'v' and self.count:
            self.sampling_errors = [message.v_sampling_error]
        elif not isnan(self.prior_share):
            sampling = getattr(message, f'c_{letter}_sampling_error')
            self.sampling_errors = [sampling, nan, nan][: self.terms]
        # LP steps in a circle follow no relation
        self.is_unrelated = letter != 'v' and isnan(getattr(message, f'{letter}_long_c2'))

    @property
    def is_assumed(self):
        """Whether the whole curvature is that of long boxes, so that only c is measured."""
        return self.terms > 1 and self.prior_share >= ALL

    @property
    def measured_values(self):
        """`values` without those that are assumed."""
        return self.values[:1] if self.is_assumed else self.values

    @property
    def form(self):
        """The relation as text; v has only one."""
        if self.symbol == 'v':
            return ''
        return RELATIONS.get(self.terms, '?')

    @property
    def basis(self):
        """The basis of the fit: form, wave numbers, lever arm, share of long boxes."""
        if self.symbol == 'v':
            return f'|omega| / k of the LP phases at {self._range()}'
        waves = 'wave number' + ('s' if self.count > 1 else '')
        basis = f'{self.form} over {self.count} {waves} {self._range()}'
        if self.count > 1:
            basis += f' (lever arm {self.k_max / self.k_min:.3g})'
        if self.is_assumed:
            return f'{basis}, {ASSUMED}: that of long boxes'
        share = 100 * self.prior_share
        return basis if isnan(share) else f'{basis}, {share:.0f} % of the curvature from long boxes'

    @property
    def measured(self):
        """The first coefficient and the misfit."""
        return with_error(*self.values[0][1:]) + self.beside

    @property
    def beside(self):
        """The misfit as ', misfit 6.5'; '' if it is not known."""
        return f', misfit {self.misfit:.1f}' if self.misfit >= 0 else ''

    def _range(self):
        ends = dict.fromkeys(f'{k:.4g}' for k in (self.k_min, self.k_max))
        return ' .. '.join(ends)

    def is_like(self, other):
        """Whether both fits have the same kind, form and wave numbers."""
        mine, others = ([fit.k_min, fit.k_max, *fit.waves] for fit in (self, other))
        return (
            (self.symbol, self.terms) == (other.symbol, other.terms)
            and len(mine) == len(others)
            and all(isclose(one, two, rel_tol=SAME) for one, two in zip(mine, others))
        )


def of(message):
    """The fits of T and LP steps and of v; [] without a message."""
    if message is None:
        return []
    return [Fit(message, 't', steps.T), Fit(message, 'l', steps.LP), Fit(message, 'v', steps.LP)]


def curve(message, fit, terms):
    """A dispersion.Curve, c k or c k + c2 k^2, over the steps of a fit; None if their errors are
    not known."""
    found = _fitted(message, fit.kind, (fit.k_min, fit.k_max))
    if not found or min(step.std_error for step in found) <= 0:
        return None
    return dispersion.Curve(*_columns(found), terms)


def chosen(message, form=None, k=None):
    """A copy of a Steps message whose fits are of `form` (a value of RELATIONS; None: the node's)
    over the steps with wave numbers from k[0] to k[1] (None: all, as in the node's). Errors are
    those of independent steps. Raises RecordingError for any other choice."""
    terms = _terms(form, k)
    if message is None or terms == 3:
        return message
    message = copy.copy(message)
    for letter, kind in KINDS.items():
        found = _fitted(message, kind, k)
        for name, value in _fit(letter, found, terms).items():
            setattr(message, name, value)
    return message


def add_arguments(parser):
    """Adds --form and --k to a command; choice(args) then gives what chosen() takes."""
    text = 'relation fitted to the steps (default: the last one, the fit of the node)'
    parser.add_argument('--form', choices=list(RELATIONS.values()), help=text)
    text = 'with the first two: over wave numbers in this range alone [1/sigma]'
    parser.add_argument('--k', nargs=2, type=float, metavar=('FROM', 'TO'), help=text)


def choice(args):
    """Raises RecordingError if chosen() would."""
    _terms(args.form, args.k)
    return args.form, args.k


def _terms(form, k):
    """The number of terms of a form; 3, those of the node, if there is none."""
    found = {None: 3, **{words: number for number, words in RELATIONS.items()}}
    if form not in found:
        wanted = ', '.join(map(repr, RELATIONS.values()))
        raise RecordingError(f'form {form!r}: must be one of {wanted}')
    if k is not None and not 0 <= k[0] <= k[1]:
        raise RecordingError(f'k from {k[0]:g} to {k[1]:g}: must go up, from 0 or above')
    if k is not None and found[form] == 3:
        others = f'{RELATIONS[1]!r} or {RELATIONS[2]!r}, as the node fits all steps'
        raise RecordingError(f'k from {k[0]:g} to {k[1]:g}: must be with the form {others}')
    return found[form]


def _fit(letter, found, terms):
    """{field of Steps: value} of a fit to these steps."""
    waves = [step.wave_number for step in found]
    made = {
        f'{letter}_points': dispersion.number_of(waves),
        f'{letter}_k_min': min(waves, default=nan),
        f'{letter}_k_max': max(waves, default=nan),
        f'{letter}_prior_share': nan,
        f'{letter}_misfit': -1.0,
        f'c_{letter}_sampling_error': -1.0,
    }
    for name in _names(letter):
        made.update({name: nan, f'{name}_error': -1.0})
    if not found:
        return made
    curve = dispersion.Curve(*_columns(found), min(terms, made[f'{letter}_points']))
    made[f'{letter}_misfit'] = curve.misfit
    made[f'c_{letter}_sampling_error'] = curve.c_sampling_error
    fitted = zip(_names(letter), curve.coefficients, curve.errors)
    for name, value, error in list(fitted)[: curve.terms]:
        made.update({name: value, f'{name}_error': error})
    return made


def _names(letter):
    return [f'c_{letter}', f'c_{letter}2', f'c_{letter}3']


def _coefficients(message, letter, count):
    """The names of the coefficients that are fitted."""
    if letter == 'v' or not count:
        return ['v'][:count]
    c, *others = _names(letter)
    return [c, *(name for name in others if not isnan(getattr(message, name)))]


def _fitted(message, kind, k=None):
    """The steps of a fit: resolved steps of the positive half."""
    low, high = k or (0.0, float('inf'))
    return [
        step
        for step in steps.resolved(message).values()
        if step.kind == kind
        and step.exponent > 0
        and low * (1 - SAME) <= step.wave_number <= high * (1 + SAME)
    ]


def _columns(found):
    return zip(*((step.wave_number, step.exponent, step.std_error) for step in found))


def _waves(message, kind, k):
    """The different wave numbers of the steps of a fit, smallest first."""
    found = sorted(step.wave_number for step in _fitted(message, kind, k))
    return [
        k
        for place, k in enumerate(found)
        if not place or not isclose(k, found[place - 1], rel_tol=SAME)
    ]
