"""Steps message -> blocks: steps whose vectors mix stand together."""

import numpy as np

from hdlyap.data.fields import words
from hdlyap.msg import Step

NAMES = words(Step, 'kind')
ZERO, T, LP = NAMES


def name(step):
    """Of a Step, or of anything else with kind, nx and ny."""
    return NAMES[step.kind] if step.kind == ZERO else wave_name(kind_name(step.kind), step)


def kind_name(kind):
    """Also of one that another version may know."""
    return NAMES.get(kind, f'kind {kind}')


def wave_name(kind, wave):
    return f'{kind}({wave.nx},{wave.ny})'


class Block:
    """The resolved steps of one set of vectors; more than one where steps share it."""

    def __init__(self, steps):
        self.steps = sorted(steps, key=lambda step: (step.wave_number, step.kind))
        self.first, self.last = steps[0].first_index, steps[0].last_index
        self.conjugate = steps[0].conjugate
        self.multiplicity = sum(step.multiplicity for step in steps)
        self.expected = sum(step.expected for step in steps)

    @property
    def name(self):
        return '+'.join(name(step) for step in self.steps)

    @property
    def kind(self):
        """Its kind; None if it has both."""
        kinds = {step.kind for step in self.steps}
        return kinds.pop() if len(kinds) == 1 else None

    @property
    def indices(self):
        return f'{self.first}-{self.last}' if self.last > self.first else f'{self.first}'

    @property
    def height(self):
        """Mean exponent of its vectors."""
        shares = [step.multiplicity for step in self.steps]
        return np.average(
            [step.exponent for step in self.steps], weights=shares if sum(shares) > 0 else None
        )


def blocks(message, conjugate=False):
    """Resolved steps of one half of the spectrum without the zero modes, smallest |lambda| first;
    none without a message."""
    sets = {}
    for step in message.steps if message is not None else ():
        if step.resolved and step.kind != ZERO and step.conjugate == conjugate:
            sets.setdefault(step.set, []).append(step)
    return sorted((Block(steps) for steps in sets.values()), key=lambda block: abs(block.height))


def all_blocks(message):
    """Of the zero modes, if they are resolved, and of both halves; none without a message."""
    zero = zero_modes(message) if message is not None else None
    found = [Block([zero])] if zero is not None and zero.resolved else []
    return found + blocks(message) + blocks(message, conjugate=True)


def resolved(message, conjugate=False):
    """{name: step} of one half of the spectrum without the zero modes; empty without a message."""
    return {
        name(step): step
        for step in (message.steps if message is not None else ())
        if step.resolved and step.kind != ZERO and step.conjugate == conjugate
    }


def unresolved(message, conjugate=False):
    return [
        step
        for step in message.steps
        if not step.resolved and step.kind != ZERO and step.conjugate == conjugate
    ]


def zero_modes(message):
    """The step of the zero modes; None if the message has none."""
    return next((step for step in message.steps if step.kind == ZERO), None)


def resolved_lp(message):
    """(number, step) of the resolved LP steps of the positive half, smallest exponent first."""
    found = [
        (number, step)
        for number, step in enumerate(message.steps)
        if step.resolved and step.kind == LP and not step.conjugate
    ]
    return sorted(found, key=lambda pair: pair[1].exponent)
