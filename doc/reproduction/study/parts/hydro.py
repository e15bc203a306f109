"""Part 12: what T, L and P modes are in terms of density, momentum and energy."""

from collections import namedtuple

import numpy as np

from hdlyap.msg import LpPhase, Mode

from hdlyap.data import waves
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, plt, scene
from hdlyap.numbers import with_error
from hdlyap.data.reader import PHASES

from .. import blocks, halves
from ..bags import once
from ..files import cells
from ..row import SIGMAS, Row

RUN = 'hydro'
HYDRO = 'hdlyap/Hydro'
WAVES = ((1, 0), (0, 1))
SMALL = 0.05  # of the largest response of a kind: less than this is zero
ZERO, NOT_ZERO, BOTH = 'zero', 'not zero', 'zero at one wave, not at the other'
# one HydroMode field each: the momentum's part along grad A, and along curl A
KINDS = ('density', 'along', 'across', 'energy')
NAMES = {
    'density': 'density',
    'along': 'momentum along grad A',
    'across': 'momentum along curl A',
    'energy': 'energy',
}
UNITS = {
    'density': '',
    'along': 'sigma/time unit',
    'across': 'sigma/time unit',
    'energy': 'sigma^2/time unit^2',
}
# T: 0, curl A, 0; L: laplacian A, grad A, laplacian A; P: 0, grad A, A
TABLE = {'T': ('across',), 'L': ('density', 'along', 'energy'), 'P': ('along', 'energy')}
Response = namedtuple('Response', 'value error')
FLOOR = 'LP', 'across'  # what noise alone is like along curl A


def table(bags):
    found = responses(bags[RUN])
    return [_entry(found, mode, kind) for mode in TABLE for kind in KINDS]


def number(bags):
    """Whether C is one."""
    matrices, numbers = _matrices(bags)
    return [halves.ratio(matrices), halves.swing(matrices, numbers)]


def symmetric(bags):
    row = halves.swing(*_matrices(bags))
    row.quantity = 'angle of dp at L less that of a turn, over all'
    return [row]


def delay(bags):
    return [halves.ahead(_matrices(bags)[0])]


def _matrices(bags):
    """({wave: Matrix}, {wave: k})"""
    found, info = responses(bags[RUN]), bags[RUN].info
    numbers = {wave: float(np.hypot(*waves.wave_vector(info, *wave))) for wave in found}
    return {wave: halves.matrix(ones, numbers[wave]) for wave, ones in found.items()}, numbers


def _entry(found, mode, kind):
    words = {_word(found[wave], mode, kind) for wave in WAVES if wave in found}
    word = next(iter(words), None) if len(words) < 2 else None if None in words else BOTH
    published = NOT_ZERO if kind in TABLE[mode] else ZERO
    row = Row(f'{NAMES[kind]}: {mode}', published, word, caught=f'{100 * SMALL:g} % of the largest')
    row.remark = _remark(found, mode, kind)
    return row


def _word(found, mode, kind):
    """Less than SMALL of the largest of its kind is zero, if known as well as that; None if not
    known well enough."""
    if kind == 'across' and not _stands_out(found):
        return None
    one = found[mode, kind]
    small = SMALL * max(abs(found[other, kind].value) for other in TABLE)
    uncertain = SIGMAS * one.error
    if abs(one.value) < small:
        return ZERO if uncertain < small else None
    return NOT_ZERO if uncertain < abs(one.value) else None


def _stands_out(found):
    """Whether T answers along curl A by more than LP vectors do. It is the root of a mean square,
    which noise alone makes larger than zero; so is theirs."""
    one, noise = found['T', 'across'], found[FLOOR]
    return one.value - noise.value > SIGMAS * np.hypot(one.error, noise.error)


def _remark(found, mode, kind):
    numbers = _numbers(found, mode, kind)
    noise = (
        f'; rms of LP vectors: {_numbers(found, *FLOOR)}'
        if numbers and (mode, kind) == ('T', 'across')
        else ''
    )
    return numbers + (f' {UNITS[kind]}' if numbers else '') + noise


def _numbers(found, mode, kind):
    return ', '.join(
        f'{with_error(*found[wave][mode, kind])} at ({wave[0]},{wave[1]})'
        for wave in WAVES
        if wave in found
    )


@once
def responses(bag):
    """{wave: {(mode, kind): Response}}: to a vector that is a T, an L or a P field alone,
    normalised [T15]. Responses of the vectors of LP(n) are regressed on their coefficients (a, b)
    at the same modulation and time. Of those of T(n) no coefficients are in the bag, but their
    response along curl A is in proportion to them. FLOOR: root of the mean square of the LP
    vectors' own along curl A, as that of T is found."""
    coefficients = _coefficients(bag)
    sums = {wave: ([], [], []) for wave in WAVES}
    for message in bag.messages(HYDRO):
        now = coefficients.get(message.sim_time, {})
        of_wave = {}
        for one in message.responses:
            if one.index and (one.nx, one.ny) in sums:
                of_wave.setdefault((one.nx, one.ny), []).append(one)
        for wave, ones in of_wave.items():
            of_t, of_lp, noise = sums[wave]
            of_t.append(_t_sums([one for one in ones if one.kind == Mode.T]))
            of_lp.append(_lp_sums([(one, now[_key(one)]) for one in ones if _key(one) in now]))
            noise.append(_squares([one for one in ones if one.kind == Mode.LP]))
    estimated = {wave: _all_estimated(*of_wave) for wave, of_wave in sums.items()}
    return {
        wave: found
        for wave, found in estimated.items()
        if len(found) == len(TABLE) * len(KINDS) + 1
    }


def _key(one):
    return one.nx, one.ny, one.modulation, one.index


def _coefficients(bag):
    """{time: {(nx, ny, modulation, index): (a, b)}} where a phase is tracked: LP vectors alone."""
    return {
        message.sim_time: {
            _key(phase): (phase.a, phase.b)
            for phase in message.phases
            if phase.state == LpPhase.TRACKED
        }
        for message in bag.messages(PHASES)
    }


def _values(one):
    return np.array([getattr(one, kind) for kind in KINDS])


# ---- at one time: sums over vectors and modulations ---------------------------------------------


def _t_sums(ones):
    """Products with the response along curl A, and vectors."""
    products = sum((one.across * _values(one) for one in ones), np.zeros(len(KINDS)))
    return np.r_[products, len({one.index for one in ones})]


def _squares(ones):
    """Of responses along curl A, and vectors."""
    return np.array(
        [sum(one.across**2 for one in ones), len({one.index for one in ones})], dtype=float
    )


def _lp_sums(pairs):
    """Of the normal equations: three products of a and b, and those of either with the
    responses."""
    total = np.zeros(3 + 2 * len(KINDS))
    for one, (a, b) in pairs:
        total += np.r_[a * a, a * b, b * b, a * _values(one), b * _values(one)]
    return total


# ---- sums over time -> responses -----------------------------------------------------------


def _t_estimate(sums):
    """A vector's coefficients at all modulations have squares that add up to one."""
    across = KINDS.index('across')
    size = np.sqrt(sums[across] / sums[-1])
    return sums[:-1] / sums[across] * size


def _lp_estimate(sums):
    """L, then P."""
    gram = np.array([[sums[0], sums[1]], [sums[1], sums[2]]])
    return np.linalg.solve(gram, sums[3:].reshape(2, -1)).ravel()


def _all_estimated(of_t, of_lp, noise):
    every = {mode: [(one, kind) for one in mode for kind in KINDS] for mode in ('T', 'LP')}
    return {
        **_estimated(_t_estimate, of_t, every['T']),
        **_estimated(_lp_estimate, of_lp, every['LP']),
        **_estimated(lambda sums: np.sqrt(sums[:1] / sums[1]), noise, [FLOOR]),
    }


def _estimated(estimate, sums, keys):
    """{(mode, kind): Response} of keys; nothing where there is nothing to estimate from."""
    sums = np.array([one for one in sums if np.any(one)])
    values, errors = blocks.of_sums(estimate, sums)
    if values is None:
        return {}
    return {
        key: Response(float(value), float(error)) for key, value, error in zip(keys, values, errors)
    }


# ---- as a figure and a table ---------------------------------------------------------------


def figures(bags):
    found = responses(bags[RUN])
    if found:
        yield 'responses', _draw(bags[RUN].info, found)


def tables(bags):
    header = 'wave', 'mode', 'response', 'value', 'error', 'published', 'found'
    yield 'responses', header, [
        (
            *('({},{})'.format(*wave), mode, kind, *cells('.5g .2g', *one)),
            NOT_ZERO if kind in TABLE[mode] else ZERO,
            _word(found, mode, kind) or 'not known',
        )
        for wave, found in responses(bags[RUN]).items()
        for (mode, kind), one in found.items()
        if mode in TABLE
    ]


def _draw(info, found):
    figure, row = plt.subplots(1, len(KINDS), figsize=(7.6, 2.9), constrained_layout=True)
    width = 0.8 / len(found)
    for axes, kind in zip(row, KINDS):
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
        unit = UNITS[kind].replace('^2', '$^2$').replace('sigma', r'$\sigma$')
        axes.set_title(NAMES[kind] + (f'\n[{unit}]' if unit else '\n'), fontsize=8)
    # where there is room
    row[KINDS.index('across')].legend(fontsize=7, title='wave', title_fontsize=7)
    row[0].set_ylabel('response to a pure mode')
    grey = f'grey: less than {100 * SMALL:g} % of the largest, bars: {SIGMAS:g} standard errors'
    figure.suptitle(f'{scene(info)}; {grey}', fontsize=9)
    return figure
