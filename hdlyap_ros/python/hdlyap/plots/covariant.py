"""Compares covariant vectors of a run with its Gram-Schmidt vectors: exponents, weights, angles,
order."""

from functools import partial
from math import pi

import numpy as np

from hdlyap.data import space, steps
from hdlyap.data.fields import words
from hdlyap.msg import CovariantAngle
from hdlyap.numbers import known

SPACES = words(CovariantAngle, 'spaces')
RIGHT_ANGLE = pi / 2


def indices(message):
    """The Lyapunov indices of the elements of a message's arrays."""
    return np.arange(message.first_index, message.first_index + len(message.exponents))


def between(message):
    """Places on an axis for numbers about an index and the next one."""
    return indices(message)[:-1] + 0.5


class Compared:
    """Exponents of the forward and the backward pass at the indices of covariant vectors; exponents
    and errors that are not known are NaN."""

    def __init__(self, run):
        message = run.covariant
        self.indices = indices(message)
        self.backward = np.array(message.exponents, dtype=float)
        self.backward_error = known(message.std_errors)
        self.forward, self.forward_error = self._forward(run.spectrum)
        # as for independent means; as both come from one trajectory, deviations are well below 1
        self.combined = np.hypot(self.forward_error, self.backward_error)
        self.deviation = _ratio(self.backward - self.forward, self.combined)
        self.is_zero = np.isin(self.indices, run.zeros)

    def _forward(self, spectrum):
        found = np.full((2, len(self.indices)), np.nan)
        if spectrum is not None:
            places = self.indices - spectrum.first_index
            there = (places >= 0) & (places < len(spectrum.exponents))
            found[0, there] = np.array(spectrum.exponents)[places[there]]
            found[1, there] = known(spectrum.std_errors)[places[there]]
        return found

    def over(self, block):
        """(forward, its error, backward, its error, deviation in combined errors) as means over a
        block; None unless the run has all of its vectors."""
        inside = within(self.indices, block)
        if inside is None:
            return None
        # members of a step fluctuate together, so their errors do not average out
        of_all = self.forward, self.forward_error, self.backward, self.backward_error
        means = [float(values[inside].mean()) for values in of_all]
        forward, forward_error, backward, backward_error = means
        combined = np.hypot(forward_error, backward_error)
        return (*means, float(_ratio(np.array(backward - forward), np.array(combined))))


def _ratio(difference, error):
    """difference / error; NaN if the error is not known or 0."""
    usable = np.isfinite(error) & (error > 0)
    return np.where(usable, difference / np.where(usable, error, 1.0), np.nan)


def within(numbers, block):
    """Which of the indices belong to a block; None unless they have all of the block."""
    inside = (numbers >= block.first) & (numbers <= block.last)
    return inside if inside.sum() == block.last - block.first + 1 else None


def blocks(run):
    """Yields (name, block) of the zero modes, then of the steps of both halves, smallest |exponent|
    first."""
    found = steps.all_blocks(run.steps, run.info)
    # each step comes before its conjugate, whose exponents differ by sign and errors only
    order = {block.name: place for place, block in enumerate(found) if not block.conjugate}
    for block in sorted(found, key=lambda one: (order.get(one.name, len(found)), one.conjugate)):
        half = 'conj. ' if block.conjugate else ''
        yield half + block.name if block.kind != steps.ZERO else 'zero modes', block


# ---- weights ----------------------------------------------------------------------------------


def chance(run, weight):
    """The weight of a vector without any preference."""
    return 2.0 * weight.dimension / space.phase_space(run.info)


def weights_over(run, block):
    """Yields (step, weights) for the steps of a block, if the run has its vectors. The weights are
    means over them: of Gram-Schmidt dq, of covariant dq and dp, and by chance."""
    inside = within(indices(run.covariant), block)
    name_of = partial(steps.name, info=run.info)
    for step in block.steps if inside is not None else ():
        found = next((one for one in run.covariant.weights if name_of(one) == name_of(step)), None)
        if found is None:
            continue
        yield step, (*_means(found, inside), chance(run, found))


def unresolved_weights(run):
    """Yields (weight, indices, weights) for waves without a step among the positive exponents,
    lowest waves first. The vectors are those with the largest dq weights, as many as the space of
    the wave's fields has dimensions."""
    numbers = indices(run.covariant)
    carried = int((numbers <= run.positive_end).sum())
    resolved = steps.resolved(run.steps, run.info)
    for weight in run.covariant.weights:
        if steps.name(weight, run.info) in resolved or weight.dimension > carried:
            continue
        best = np.sort(np.argsort(weight.dq[:carried], kind='stable')[carried - weight.dimension :])
        yield weight, numbers[best], (*_means(weight, best), chance(run, weight))


def _means(weight, chosen):
    return tuple(
        np.array(values)[chosen].mean() for values in (weight.gram_schmidt, weight.dq, weight.dp)
    )


# ---- angles, order ----------------------------------------------------------------------------


def edges(counts):
    return np.linspace(0, RIGHT_ANGLE, len(counts) + 1)


def density(counts):
    """The probability per radian; zeros if the histogram is empty."""
    counts = np.array(counts, dtype=float)
    return counts / max(counts.sum(), 1.0) * len(counts) / RIGHT_ANGLE


def only_bin(counts):
    """(from, to) of the only bin that is not empty [rad]; None if there are several or none."""
    filled = np.flatnonzero(counts)
    return tuple(edges(counts)[filled[0] : filled[0] + 2]) if len(filled) == 1 else None


def is_splitting(run, before):
    """Whether the exponents differ after these indices: both ends are not among the zero ones."""
    return ~np.isin(before, run.zeros[:-1])


def isolated(run):
    """Indices after which the splitting is dominated: no later vector ever grew more."""
    before = indices(run.covariant)[:-1]
    never = np.array(run.covariant.domination_violations) == 0
    return before[never & is_splitting(run, before)]
