"""Part 1: the spectrum of 780 disks, and the indices of its smallest steps."""

from hdlyap.plots import paper, steps
from hdlyap.plots.figures import spectrum as figure_of_spectrum

from ..row import INFERRED, OURS, PAPER, Claim, Row

TITLE = 'Spectrum and index table of 780 disks, density 0.8'

SHOWN_LP = 1535  # the vector of LP(1,1) that the paper shows


def runs(plan):
    return ['periodic']


def claims(bags):
    recording = bags['periodic'].recording
    found = {block.name: block for block in steps.blocks(recording.steps)}
    stated = [_indices_row(step, found) for step in paper.INDICES]
    shown = next((one.name for one in found.values() if one.first <= SHOWN_LP <= one.last), None)
    named = Row(f'step of vector {SHOWN_LP}', 'LP(1,1)', shown if found else None)
    yield Claim(
        f'indices of the five smallest steps, and the step of vector {SHOWN_LP}',
        [*stated[:5], named],
        'the same',
        PAPER,
    )
    yield Claim(
        'indices of T(2,0) and LP(1,1), by their multiplicities beside what is stated',
        stated[5:],
        'the same',
        INFERRED,
    )
    yield Claim(
        'exponents of the five smallest steps are c k, with c of the fits at density 0.8',
        [_exponent_row(step, found) for step in paper.steps(recording.info)],
        'within 3 %',
        OURS,
    )


def _indices_row(step, found):
    kind, nx, ny, first, last = step
    name = f'{kind}({nx},{ny})'
    measured = found[name].indices if name in found else None
    return Row(f'indices of {name}', f'{first}-{last}', measured)


def _exponent_row(step, found):
    block = found.get(step.name)
    return Row(
        f'exponent of {step.name}',
        step.fitted,
        block and block.steps[0].exponent,
        block.steps[0].std_error if block else 0.0,
        paper.FIT_ACCURACY * step.fitted,
        '1/time unit',
    )


def figures(bags):
    yield 'spectrum', figure_of_spectrum.draw(bags['periodic'].recording)


def tables(bags):
    spectrum = bags['periodic'].recording.spectrum
    yield 'exponents', ('index', 'exponent', 'std_error'), [
        (spectrum.first_index + i, f'{exponent:.7g}', f'{error:.2g}')
        for i, (exponent, error) in enumerate(zip(spectrum.exponents, spectrum.std_errors))
    ]
