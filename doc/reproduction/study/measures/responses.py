"""What T, L and P modes are in terms of density, momentum and energy; and C of dp = C dq on the
fields of L and P, with what it says of the halves' angle.

A vector's dq half is a L + b P, normalised fields; its dp half, in units of |dq|, is C (a, b). With
q = |dq| the sums over the disks give [T15]

    density  L: q                  P: 0
    along    L: q c_LL             P: q (c_LP - k / sqrt 2)
    energy   L: q (2 k + 8^(1/2) c_PL)    P: q 8^(1/2) c_PP

where the terms in k are those of dq, with momenta of the variance 1. C is a number if c_LL = c_PP
and c_LP = c_PL = 0. While (a, b) goes round, the phase of dp less that of dq is

    (c_PL - c_LP) / 2 c + (c_PL + c_LP) / 2 c cos 2 phi + ..,    c = (c_LL + c_PP) / 2.

The mean is an angle by which dp is ahead; the second part is none: it is a C that is symmetric, but
no number.
"""

from collections import namedtuple

import matplotlib.pyplot as plt
import numpy as np

from hdlyap.data import waves
from hdlyap.data.reader import PHASES
from hdlyap.msg import LpPhase, Mode
from hdlyap.numbers import with_error
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, scene

from .. import averages, blocks
from ..bags import once
from ..row import SIGMAS, Row

HYDRO = 'hdlyap/Hydro'
WAVES = ((1, 0), (0, 1))
SMALL = 0.05  # of the largest response of a kind: less than this is zero
ZERO, NOT_ZERO, BOTH = 'zero', 'not zero', 'zero at one wave, not at the other'
ALONG, ENERGY = 'sigma/time unit', 'sigma^2/time unit^2'
# one HydroMode field each: (name, unit); the momentum's part along grad A, and along curl A
KINDS = {
    'density': ('density', ''),
    'along': ('momentum along grad A', ALONG),
    'across': ('momentum along curl A', ALONG),
    'energy': ('energy', ENERGY),
}
# T: 0, curl A, 0; L: laplacian A, grad A, laplacian A; P: 0, grad A, A
TABLE = {'T': ('across',), 'L': ('density', 'along', 'energy'), 'P': ('along', 'energy')}
Response = namedtuple('Response', 'value error')
FLOOR = 'LP', 'across'  # what noise alone is like along curl A


# ---- messages -> responses -----------------------------------------------------------------------


@once
def responses(bag):
    """{wave: {(mode, kind): Response}}: to a vector that is a T, an L or a P field alone,
    normalised [T15]. Responses of the vectors of LP(n) are regressed on their coefficients (a, b)
    at the same modulation and time. Of those of T(n) no coefficients are in the bag, but their
    response along curl A is in proportion to them. FLOOR: root of the mean square of the LP
    vectors' own along curl A, as that of T is found."""
    coefficients, sums = _coefficients(bag), {wave: ([], [], []) for wave in WAVES}
    for message in bag.messages(HYDRO):
        now, of_wave = coefficients.get(message.sim_time, {}), {}
        for one in message.responses:
            if one.index and (one.nx, one.ny) in sums:
                of_wave.setdefault((one.nx, one.ny), []).append(one)
        for wave, ones in of_wave.items():
            of_t = [one for one in ones if one.kind == Mode.T]
            of_lp = [one for one in ones if one.kind == Mode.LP]
            known = [(one, now[_key(one)]) for one in ones if _key(one) in now]
            for all_times, some in zip(
                sums[wave], (_products(of_t), _normal(known), _products(of_lp))
            ):
                all_times.append(some)
    found = {wave: _estimated(*of_wave) for wave, of_wave in sums.items()}
    return {wave: ones for wave, ones in found.items() if len(ones) == len(TABLE) * len(KINDS) + 1}


def _key(one):
    return one.nx, one.ny, one.modulation, one.index


def _coefficients(bag):
    """{time: {(nx, ny, modulation, index): (a, b)}} where a phase is tracked: LP vectors alone."""
    return {
        message.sample_time: {
            _key(phase): (phase.a, phase.b)
            for phase in message.phases
            if phase.state == LpPhase.TRACKED
        }
        for message in bag.messages(PHASES)
    }


def _values(one):
    return np.array([getattr(one, kind) for kind in KINDS])


def _products(ones):
    """At one time: sums of products with the response along curl A, and vectors."""
    products = sum((one.across * _values(one) for one in ones), np.zeros(len(KINDS)))
    return np.r_[products, len({one.index for one in ones})]


def _normal(pairs):
    """At one time: sums of the normal equations, three products of a and b, and those of either
    with the responses."""
    total = np.zeros(3 + 2 * len(KINDS))
    for one, (a, b) in pairs:
        total += np.r_[a * a, a * b, b * b, a * _values(one), b * _values(one)]
    return total


def _of_t(sums):
    """A vector's coefficients at all modulations have squares that add up to one."""
    across = list(KINDS).index('across')
    return sums[:-1] / sums[across] * np.sqrt(sums[across] / sums[-1])


def _of_lp(sums):
    """L, then P."""
    gram = np.array([[sums[0], sums[1]], [sums[1], sums[2]]])
    return np.linalg.solve(gram, sums[3:].reshape(2, -1)).ravel()


def _noise(sums):
    return np.sqrt(sums[[list(KINDS).index('across')]] / sums[-1])


def _estimated(*all_sums):
    """{(mode, kind): Response}; nothing where there is nothing to estimate from."""
    found = {}
    every = [[(mode, kind) for mode in modes for kind in KINDS] for modes in ('T', 'LP')]
    for estimate, sums, keys in zip((_of_t, _of_lp, _noise), all_sums, (*every, [FLOOR])):
        sums = np.array([one for one in sums if np.any(one)])
        values, errors = blocks.of_sums(estimate, sums)
        if values is not None:
            found.update(zip(keys, map(Response, map(float, values), map(float, errors))))
    return found


# ---- the table -----------------------------------------------------------------------------------


def table(bag):
    return [_entry(responses(bag), mode, kind) for mode in TABLE for kind in KINDS]


def _entry(found, mode, kind):
    words = {_word(found[wave], mode, kind) for wave in WAVES if wave in found}
    word = next(iter(words), None) if len(words) < 2 else None if None in words else BOTH
    (name, unit), published = KINDS[kind], NOT_ZERO if kind in TABLE[mode] else ZERO
    remark = f'{_numbers(found, mode, kind)} {unit}' if found else ''
    if found and (mode, kind) == ('T', 'across'):
        remark += f'; rms of LP vectors: {_numbers(found, *FLOOR)}'
    caught = f'{100 * SMALL:g} % of the largest'
    return Row(f'{name}: {mode}', published, word, remark=remark, caught=caught)


def _word(found, mode, kind):
    """Less than SMALL of the largest of its kind is zero, if known as well as that; None if not
    known well enough."""
    if kind == 'across' and not _stands_out(found):
        return None
    one, uncertain = found[mode, kind], SIGMAS * found[mode, kind].error
    small = SMALL * max(abs(found[other, kind].value) for other in TABLE)
    if abs(one.value) < small:
        return ZERO if uncertain < small else None
    return NOT_ZERO if uncertain < abs(one.value) else None


def _stands_out(found):
    """Whether T answers along curl A by more than LP vectors do. It is the root of a mean square,
    which noise alone makes larger than zero; so is theirs."""
    above, error = averages.difference(found['T', 'across'], found[FLOOR])
    return above > SIGMAS * error


def _numbers(found, mode, kind):
    ones = [(wave, found[wave][mode, kind]) for wave in WAVES if wave in found]
    return ', '.join(f'{with_error(*one)} at ({nx},{ny})' for (nx, ny), one in ones)


def picture(bag):
    found = responses(bag)
    if not found:
        return None
    figure, row = plt.subplots(1, len(KINDS), figsize=(7.6, 2.9), constrained_layout=True)
    width = 0.8 / len(found)
    for axes, (kind, (name, unit)) in zip(row, KINDS.items()):
        for number, (wave, colour) in enumerate(zip(found, (BLUE, VERMILION))):
            ones = [found[wave][mode, kind] for mode in TABLE]
            places = np.arange(len(TABLE)) + width * (number - 0.5 * (len(found) - 1))
            values, errors = [one.value for one in ones], [SIGMAS * one.error for one in ones]
            style = {'color': colour, 'ecolor': GREY, 'label': '({},{})'.format(*wave)}
            axes.bar(places, values, width, yerr=errors, **style)
        largest = max(abs(found[wave][mode, kind].value) for wave in found for mode in TABLE)
        axes.axhspan(-SMALL * largest, SMALL * largest, color=GREY, alpha=0.3, linewidth=0)
        axes.axhline(0, color=GREY, linewidth=0.5)
        axes.set_xticks(range(len(TABLE)))
        axes.set_xticklabels(TABLE)
        unit = unit.replace('^2', '$^2$').replace('sigma', r'$\sigma$')
        axes.set_title(name + (f'\n[{unit}]' if unit else '\n'), fontsize=8)
    # where there is room
    row[list(KINDS).index('across')].legend(fontsize=7, title='wave', title_fontsize=7)
    row[0].set_ylabel('response to a pure mode')
    grey = f'grey: less than {100 * SMALL:g} % of the largest, bars: {SIGMAS:g} standard errors'
    figure.suptitle(f'{scene(bag.info)}; {grey}', fontsize=9)
    return figure


# ---- C of dp = C dq ------------------------------------------------------------------------------


class Matrix:
    """C, ((LL, LP), (PL, PP)), from {(mode, kind): Response} at one wave number, and its errors."""

    def __init__(self, found, k):
        self.k, self.q = k, found['L', 'density'].value
        parts = (('L', 'along'), ('P', 'along')), (('L', 'energy'), ('P', 'energy'))
        of_dq = np.array([[0.0, -k / np.sqrt(2)], [2 * k, 0.0]])
        scale = np.array([[1.0, 1.0], [np.sqrt(8), np.sqrt(8)]])
        both = np.array([[[*found[part]] for part in row] for row in parts])
        self.values = (both[..., 0] / self.q - of_dq) / scale
        self.errors = both[..., 1] / abs(self.q) / scale

    def ratio(self):
        return averages.quotient(*((self.values[at], self.errors[at]) for at in ((0, 0), (1, 1))))

    def angle(self, sign):
        """(c_PL + sign c_LP) / 2 c"""
        (_, lp), (pl, _) = self.values
        error = np.hypot(self.errors[1, 0], self.errors[0, 1])
        return (pl + sign * lp) / np.trace(self.values), error / np.trace(self.values)

    def beside_a_number(self):
        """The two responses that C decides, beside those of a number C."""
        along, energy, root = -self.k / np.sqrt(2), 2 * self.k, np.sqrt(8)
        return (
            f'momentum of P {self.q * (along + self.values[0, 1]):.4f}, '
            f'{self.q * along:.4f} if C were a number, energy of L '
            f'{self.q * (energy + root * self.values[1, 0]):.4f}, {self.q * energy:.4f}'
        )


def _matrices(bag):
    """{wave: Matrix}"""
    found = responses(bag).items()
    k = {wave: float(np.hypot(*waves.wave_vector(bag.info, *wave))) for wave, _ in found}
    return {'({},{})'.format(*wave): Matrix(ones, k[wave]) for wave, ones in found}


def _mean(bag, quantity, published, unit, of):
    """Row over the waves by their errors."""
    row, found = Row(quantity, published, unit=unit), _matrices(bag)
    ones = {wave: of(one) for wave, one in found.items()}
    if ones:
        values, errors = zip(*ones.values())
        is_known = min(errors) > 0
        mean = averages.weighted(values, errors) if is_known else (float(np.mean(values)), -1.0)
        row.measured, row.error = mean[:2]
        row.remark = ', '.join(f'{with_error(*one)} at {wave}' for wave, one in ones.items())
    return row


def number(bag):
    """Whether C is one."""
    yield _mean(bag, 'C on L over C on P, of dp = C dq', 1.0, '', Matrix.ratio)
    yield _swing(bag, 'the same at L less that mean')


def symmetric(bag):
    yield _swing(bag, 'angle of dp at L less that of a turn, over all')


def _swing(bag, quantity):
    row = _mean(bag, quantity, 0.0, 'rad', lambda one: one.angle(+1))
    beside = [f'{wave}: {one.beside_a_number()}' for wave, one in _matrices(bag).items()]
    row.remark = '; '.join(filter(None, [row.remark, *beside]))
    return row


def delay(bag):
    quantity = 'angle of dp ahead of dq, mean of a turn'
    yield _mean(bag, quantity, 0.0, 'rad', lambda one: one.angle(-1))
