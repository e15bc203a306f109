"""Comparison -> the text that hdlyap compare prints, and its verdict."""

import textwrap
from math import hypot, inf, isclose

from hdlyap.data import steps
from hdlyap.data.spectrum_test import FEWEST
from hdlyap.data.reader import RecordingError
from hdlyap.numbers import with_error

from .deviation import unlikeliest
from .report import origin, system

AGREE, DIFFER = 0, 1  # exit status
# Largest part of pairs of runs of one system that are said to differ; and its parts that are due to
# steps, to numbers, and to the spectrum.
CHANCE, STEPS, NUMBERS, SPECTRUM = 0.015, 0.01, 0.003, 0.002
LARGEST = 8  # most deviations in the list
# Below this averaged time, in units of 1 / the smallest positive exponent, the blocks of an error
# may be shorter than fluctuations last.
SHORT = 30
WIDTH = 40  # most characters of a parameter
ADDED = 0.05  # relative: errors add up to the one of b - a as nearly as they are shown
ROW = '  {:<14} {:>15} {:>15} {:>15} {:>7}  {}'
HEAD = ROW.format('', 'a', 'b', 'b - a', 'z', '{}')


def verdict(comparison):
    """(text, exit status)"""
    deviations = comparison.deviations
    odd = [one.name for one in deviations if not one.is_number]
    if odd:
        return f'differ: no number in a or b: {_short(odd)}', DIFFER
    if comparison.is_identical:
        return 'identical: the last spectrum and steps of both are the same in every bit', AGREE
    reasons = list(_reasons(comparison))
    if not reasons:
        raise RecordingError('nothing can be compared: no quantity has a known error in both bags')
    chance, reason = min(reasons, key=lambda one: min(1.0, one[0]))
    found = f'{reason}; chance alone makes two runs as unlike in {_percent(chance)} of comparisons'
    said, status = ('agree', AGREE) if chance >= CHANCE else ('differ', DIFFER)
    limit = f'runs differ below {_percent(CHANCE)}'
    return '\n'.join([*_warnings(comparison), f'{said}: {found}; {limit}']), status


def _reasons(comparison):
    """Yields (chance, text about it) for the step and the number that agree least, and for the
    spectrum. The chance of one is multiplied by their number, as is right however they are
    correlated (Bonferroni), and divided by the share of their kind in CHANCE."""
    kinds = (NUMBERS, 'numbers', comparison.numbers), (STEPS, 'steps', comparison.steps)
    for share, what, all_of in kinds:
        count = sum(one.judged and one.is_known for one in all_of)
        for one in unlikeliest(all_of):
            farthest = (
                f'{one.name} is {abs(one.z):.2f} errors apart, the farthest of {count} {what}'
            )
            yield one.chance * count * CHANCE / share, farthest
    if comparison.spectra:
        t2, groups, chance = comparison.spectra
        said = f'the spectra are apart by chi^2 = {t2:.3g} in {groups} groups of exponents'
        yield chance * CHANCE / SPECTRUM, said


def _percent(chance):
    return f'{100 * min(1.0, chance):.2g} %'.replace('1e+02', '100')


def _warnings(comparison):
    for letter, run in zip('ab', comparison.runs):
        length = _length_in_slowest(run)
        if length < SHORT:
            yield (
                f'{letter} is short: averaged over {length:.2g} times 1 / its smallest positive '
                f'exponent; below {SHORT}\n  single errors may be far too small, and runs that '
                'agree may seem to differ'
            )


def _length_in_slowest(run):
    """The averaged time in units of 1 / the smallest positive exponent; infinite without one."""
    if run.spectrum is None:
        return inf
    positive = run.spectrum.exponents[: run.positive_end + 1 - run.spectrum.first_index]
    return run.spectrum.averaged_time * min((x for x in positive if x > 0), default=inf)


def report(comparison):
    """The text without the verdict."""
    parts = _head, _parameters, _remarks, _quantities, _exponents, _largest
    return '\n\n'.join(block for part in parts for block in part(comparison))


def _head(comparison):
    a, b = comparison.runs
    lines = [f'{letter}  {origin(run.info)}' + _length(run) for letter, run in zip('ab', (a, b))]
    yield '\n'.join([*lines, f'both  {system(comparison.system)}'])


def _length(run):
    last = run.spectrum or run.steps
    return f', averaged over {last.averaged_time:g}' if last else ''


def _parameters(comparison):
    rows = [
        f'  {name:<20} {_short(a):<{WIDTH}} {_short(b)}'.rstrip()
        for name, a, b in comparison.parameters
    ]
    if rows:
        yield '\n'.join(['parameters that differ'] + rows)


def _short(value):
    text = ' '.join(map(_word, value)) if isinstance(value, (list, tuple)) else str(value)
    return textwrap.shorten(text, WIDTH, placeholder=' ...') or '""'


def _word(element):
    """An element of a list as text; a change with its time, parameter and value."""
    if hasattr(element, 'sim_time'):
        return f'{element.sim_time:g} {element.name}={element.value}'
    return str(element)


def _remarks(comparison):
    a, b = comparison.runs
    lines = []
    if set(a.info.seed.split(', ')) & set(b.info.seed.split(', ')):  # means have several seeds
        lines.append(
            'the same seed: where the runs share their trajectory their errors are no '
            'measure of their difference'
        )
    lines += [f'{letter}: {line}' for letter, run in zip('ab', (a, b)) for line in run.left_out]
    lines += [f'no steps in {letter}' for letter, run in zip('ab', (a, b)) if run.steps is None]
    if lines:
        yield '\n'.join(lines)


def _quantities(comparison):
    rows = [_row(one) for one in comparison.exponents[:1] + comparison.sums]
    half = [one for one in comparison.steps if not one.origins[0].conjugate]
    rows += [_row(one, _of_step(one)) for one in half]  # the others are their opposites
    rows += [_row(one, _of_fit(one)) for one in comparison.fits]
    rows += [_row(one) for one in comparison.gas]
    once = [
        f'  resolved in {letter} alone: {" ".join(names)}'
        for letter, names in zip('ab', comparison.found_once)
        if names
    ]
    apart = [
        f'  {a.symbol} is not compared: a {a.measured}, {a.basis}; b {b.measured}, {b.basis}'
        for a, b in comparison.unlike
    ]
    yield '\n'.join([HEAD.format('').rstrip(), *rows, *once, *apart])


def _row(one, remark=''):
    z = f'{one.z:+.2f}' if one.is_known else '-'
    measured = [with_error(value, error) for value, error in zip(one.values, one.errors)]
    measured.append(with_error(one.difference, one.error))
    remark += '' if one.judged else ' (not judged)'
    if one.is_joint and not isclose(one.error, hypot(*one.errors), rel_tol=ADDED):
        remark += ' (error of b - a from the samples of both)'
    return ROW.format(one.name, *measured, z, remark).rstrip()


def _of_step(one):
    a, b = one.origins
    indices = dict.fromkeys(steps.Block([step]).indices for step in (a, b))
    found = f'{a.multiplicity:.2f} and {b.multiplicity:.2f} of {a.expected}'
    return f'{" and ".join(indices)}: {found}'


def _of_fit(one):
    a, b = one.origins
    return ' and '.join(dict.fromkeys((a.basis, b.basis)))


def _exponents(comparison):
    exponents = comparison.exponents
    judged = [one for one in exponents if one.judged]
    if not judged:
        return
    seen = [one for one in judged if one.is_known]
    text = (
        f'exponents: {len(seen)} of {len(exponents)} compared, {len(judged) - len(seen)} of '
        f'unknown error, {len(exponents) - len(judged)} zero'
    )
    if seen:
        mean = sum(one.z**2 for one in seen) / len(seen)
        text += f'\n  mean square of b - a in errors {mean:.2f}; in groups, as neighbours '
        text += f'fluctuate together: {_of_spectra(comparison.spectra)}'
    yield text


def _of_spectra(found):
    if not found:
        return f'chi^2 needs {FEWEST} samples'
    t2, groups, chance = found
    return f'chi^2 = {t2:.3g} in {groups} groups, probability {chance:.2g}'


def _largest(comparison):
    largest = [one for one in unlikeliest(comparison.deviations, LARGEST) if one.z]
    rows = [HEAD.format('chance'), *(_row(one, f'{one.chance:.1e}') for one in largest)]
    if largest:
        yield '\n'.join(['largest deviations, and the probability of each alone', *rows])
