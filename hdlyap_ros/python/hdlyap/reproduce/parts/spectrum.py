"""Part 1: the spectrum of 780 disks, and the indices of its smallest steps."""

from hdlyap.plots import paper, steps
from hdlyap.plots.figures import spectrum as figure_of_spectrum

from ..row import Row

TITLE = 'Spectrum and index table of 780 disks, density 0.8'


def runs(plan):
    return ['periodic']


def rows(bags):
    recording = bags['periodic'].recording
    found = {block.name: block for block in steps.blocks(recording.steps)}
    for kind, nx, ny, first, last in paper.INDICES:
        name = f'{kind}({nx},{ny})'
        yield Row(
            f'indices of {name}', f'{first}-{last}', found[name].indices if name in found else None
        )
    for step in paper.steps(recording.info):
        block = found.get(step.name)
        yield Row(
            f'exponent of {step.name}, c k',
            step.fitted,
            block and block.steps[0].exponent,
            block.steps[0].std_error if block else 0.0,
            paper.FIT_ACCURACY * step.fitted,
            '1/time unit',
            'the paper\'s fit of slopes',
        )


def figures(bags):
    yield 'spectrum', figure_of_spectrum.draw(bags['periodic'].recording)


def tables(bags):
    spectrum = bags['periodic'].recording.spectrum
    yield 'exponents', ('index', 'exponent', 'std_error'), [
        (spectrum.first_index + i, f'{exponent:.7g}', f'{error:.2g}')
        for i, (exponent, error) in enumerate(zip(spectrum.exponents, spectrum.std_errors))
    ]
