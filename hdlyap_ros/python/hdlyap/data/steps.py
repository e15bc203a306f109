"""Steps message -> blocks: steps whose vectors mix are in one block. run_info says whether
particles are spheres, whose waves have three numbers of nodes; without it they are disks."""

import numpy as np

from hdlyap.data.fields import words
from hdlyap.data.reader import is_known
from hdlyap.msg import Step

from . import space

NAMES = words(Step, 'kind')
ZERO, T, LP = NAMES


def name(step, info=None):
    """The name of a Step, or of anything else with kind, nx and ny."""
    return NAMES[step.kind] if step.kind == ZERO else wave_name(kind_name(step.kind), step, info)


def kind_name(kind):
    """The name of a kind, also of one that only another version knows."""
    return NAMES.get(kind, f'kind {kind}')


def wave_name(kind, wave, info=None):
    """The name of a step with this wave: T(1,0); for spheres T(1,0,0)."""
    return f'{kind}{nodes_name(wave, info)}'


def nodes_name(wave, info):
    return '(' + ','.join(map(str, space.nodes(wave, info))) + ')'


class Block:
    """The resolved steps of one set of vectors, which several steps may share."""

    def __init__(self, steps, info=None):
        self._info = info
        self.steps = sorted(steps, key=lambda step: (step.wave_number, step.kind))
        self.first, self.last = steps[0].first_index, steps[0].last_index
        self.conjugate = steps[0].conjugate
        self.multiplicity = sum(step.multiplicity for step in steps)
        self.expected = sum(step.expected for step in steps)

    @property
    def name(self):
        return '+'.join(name(step, self._info) for step in self.steps)

    @property
    def kind(self):
        """The kind of its steps; None if it has both kinds."""
        kinds = {step.kind for step in self.steps}
        return kinds.pop() if len(kinds) == 1 else None

    @property
    def indices(self):
        return f'{self.first}-{self.last}' if self.last > self.first else f'{self.first}'

    @property
    def height(self):
        """The mean exponent of its vectors."""
        shares = [step.multiplicity for step in self.steps]
        return np.average(
            [step.exponent for step in self.steps], weights=shares if sum(shares) > 0 else None
        )


def _every(message):
    """All steps of a message; none without a message."""
    return message.steps if message is not None else ()


def _half(message, conjugate):
    """Steps of one half of the spectrum without the zero modes."""
    return [s for s in _every(message) if s.kind != ZERO and s.conjugate == conjugate]


def blocks(message, info=None, conjugate=False):
    """Resolved steps of one half, smallest |lambda| first."""
    sets = {}
    for step in _half(message, conjugate):
        if step.resolved:
            sets.setdefault(step.set, []).append(step)
    found = (Block(steps, info) for steps in sets.values())
    return sorted(found, key=lambda block: abs(block.height))


def all_blocks(message, info=None):
    """The blocks of the zero modes, if they are resolved, and of both halves; none without a
    message."""
    zero = zero_modes(message)
    found = [Block([zero])] if zero is not None and zero.resolved else []
    return found + blocks(message, info) + blocks(message, info, conjugate=True)


def resolved(message, info=None, conjugate=False):
    """{name: step} of one half."""
    return {name(step, info): step for step in _half(message, conjugate) if step.resolved}


def unresolved(message):
    """The steps of the positive half that are not resolved."""
    return [step for step in _half(message, False) if not step.resolved]


def impossible(message, info):
    """Names of the T steps that flat walls forbid: of waves that only have an LP step."""
    if not is_known(info) or not {'reflecting', 'shearing'} & {
        getattr(info, f'boundary_{axis}', '') for axis in 'xyz'
    }:
        return []
    waves = {T: [], LP: []}
    for step in _half(message, False):
        waves.get(step.kind, []).append(space.nodes(step, info))
    return [f'T({",".join(map(str, wave))})' for wave in waves[LP] if wave not in waves[T]]


def zero_modes(message):
    """The step of the zero modes; None if there is none."""
    return next((step for step in _every(message) if step.kind == ZERO), None)


def resolved_lp(message):
    """(number, step) of the resolved LP steps of the positive half, smallest exponent first."""
    found = [
        (number, step)
        for number, step in enumerate(_every(message))
        if step.resolved and step.kind == LP and not step.conjugate
    ]
    return sorted(found, key=lambda pair: pair[1].exponent)
