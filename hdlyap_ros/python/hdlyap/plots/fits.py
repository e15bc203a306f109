"""Steps message -> its fits, each with what it stands on: the relation, and the wave numbers. c of
c k alone has the curvature in it, and both forms move with the wave numbers that they go through:
only fits on the same basis measure the same."""

from math import isclose

from . import steps
from .numbers import stated, with_error

SAME = 1e-9  # relative: wave numbers of one box
RELATIONS = {1: 'c k', 2: 'c k + c2 k^2'}  # by the number of terms


class Fit:
    """Of one kind of step: c and c2, or v of the LP phases. count: wave numbers, of v phases;
    0 without a fit."""

    def __init__(self, message, letter, kind):
        self.kind = kind
        self.symbol = letter if letter == 'v' else f'c_{letter.upper()}'
        self.count = getattr(message, 'v_phases' if letter == 'v' else f'{letter}_points')
        self.misfit = stated(message, f'{letter}_misfit')
        waves = _waves(message, kind)
        self.is_recorded = hasattr(message, f'{letter}_k_min')
        # older bags: of all steps that could be in it
        self.k_min = getattr(message, f'{letter}_k_min', min(waves, default=0.0))
        self.k_max = getattr(message, f'{letter}_k_max', max(waves, default=0.0))
        # those of v are in LpPhases
        self.waves = [] if letter == 'v' else waves
        self.terms = 1 if letter == 'v' else getattr(message, f'{letter}_terms', min(self.count, 2))
        names = [letter] if letter == 'v' else [f'c_{letter}', f'c_{letter}2'][: self.terms]
        # (name, value, error) of each coefficient
        self.values = [
            (name[0] + name[1:].upper(), getattr(message, name), getattr(message, name + '_error'))
            for name in names[: self.count]
        ]

    @property
    def form(self):
        """In words; v has only one."""
        if self.symbol == 'v':
            return ''
        return RELATIONS.get(self.terms, '?') if self.is_recorded else 'form not recorded'

    @property
    def basis(self):
        """What it stands on: form and wave numbers."""
        if self.symbol == 'v':
            return f'|omega| / k of the LP phases at {self._range()}'
        waves = 'wave number' + ('s' if self.count > 1 else '')
        comma = '' if self.is_recorded else ','
        return f'{self.form}{comma} over {self.count} {waves} {self._range()}'

    @property
    def measured(self):
        """Its first coefficient."""
        return with_error(*self.values[0][1:])

    def _range(self):
        ends = dict.fromkeys(f'{k:.4g}' for k in (self.k_min, self.k_max))
        return ' .. '.join(ends)

    def is_like(self, other):
        """Whether both are of one kind, form and set of wave numbers. The form that an older bag
        does not tell follows from the number of wave numbers."""
        mine, others = ([fit.k_min, fit.k_max, *fit.waves] for fit in (self, other))
        return (
            (self.symbol, self.terms) == (other.symbol, other.terms)
            and len(mine) == len(others)
            and all(isclose(one, two, rel_tol=SAME) for one, two in zip(mine, others))
        )


def of(message):
    """T, LP and v; none without a message."""
    if message is None:
        return []
    return [Fit(message, 't', steps.T), Fit(message, 'l', steps.LP), Fit(message, 'v', steps.LP)]


def _waves(message, kind):
    """Distinct wave numbers of the resolved steps of the positive half, smallest first."""
    found = sorted(
        step.wave_number for step in steps.resolved(message).values() if step.kind == kind
    )
    return [
        k
        for place, k in enumerate(found)
        if not place or not isclose(k, found[place - 1], rel_tol=SAME)
    ]
