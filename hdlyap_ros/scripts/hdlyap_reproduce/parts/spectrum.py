"""Part 1: the spectrum of 780 disks, and the indices of its smallest steps."""

from hdlyap_plots import paper, steps
from hdlyap_plots.figures import spectrum as figure_of_spectrum

from ..row import Row

TITLE = 'Spectrum and index table of 780 disks, density 0.8'
# the paper's index table: indices of each step
INDICES = {'T(1,0)': '1556-1557', 'T(0,1)': '1554-1555', 'LP(1,0)': '1550-1553', 'T(1,1)': '1546-1549',
           'LP(0,1)': '1542-1545', 'T(2,0)': '1540-1541', 'LP(1,1)': '1532-1539'}


def runs(plan):
    return ['periodic']


def rows(bags):
    recording = bags['periodic'].recording
    found = {block.name: block for block in steps.blocks(recording.steps)}
    for name, indices in INDICES.items():
        yield Row(f'indices of {name}', indices, found[name].indices if name in found else None)
    yield Row('zero modes begin at', 1558, recording.positive_end + 1)
    for step in paper.steps(recording.info):
        block = found.get(step.name)
        yield Row(f'exponent of {step.name}, c k', step.fitted, block and block.steps[0].exponent,
                  block.steps[0].std_error if block else 0.0, paper.FIT_ACCURACY * step.fitted, '1/time unit',
                  'the paper\'s fit of slopes')


def figures(bags):
    yield 'spectrum', figure_of_spectrum.draw(bags['periodic'].recording)


def tables(bags):
    spectrum = bags['periodic'].recording.spectrum
    yield 'exponents', ('index', 'exponent', 'std_error'), [
        (spectrum.first_index + i, f'{exponent:.7g}', f'{error:.2g}')
        for i, (exponent, error) in enumerate(zip(spectrum.exponents, spectrum.std_errors))]
