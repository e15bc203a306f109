"""Part 2: the dispersion relation of 780 disks, both branches, to second order."""

from hdlyap.plots import comparison, paper, steps
from hdlyap.plots.figures import dispersion as figure_of_dispersion

from ..row import Row

TITLE = 'Dispersion relation of 780 disks, density 0.8'
# the paper's slopes have no curvature: they are meant for the smallest steps
SMALLEST = ('T(1,0)', 'T(0,1)', 'LP(1,0)', 'LP(0,1)')
UNITS = {False: 'sigma/time unit', True: 'sigma^2/time unit'}


def runs(plan):
    return ['periodic']


def rows(bags):
    recording = bags['periodic'].recording
    found = steps.resolved(recording.steps)
    for published in paper.steps(recording.info):
        if published.name in SMALLEST:
            yield _slope(published, found.get(published.name))
    for name, _, points in comparison.FITS[:-1]:
        yield _fit(recording.steps, name, points)


def _slope(published, step):
    """lambda / k of one step."""
    k = published.wave_number
    slope = published.fitted / k
    return Row(
        f'lambda / k of {published.name}',
        slope,
        step and step.exponent / k,
        max(step.std_error, 0.0) / k if step else 0.0,
        paper.FIT_ACCURACY * slope,
        UNITS[False],
        'c of the paper\'s fit at this density',
    )


def _fit(message, name, points):
    """Ours of lambda = c k + c2 k^2."""
    curved = name.endswith('2')
    count = getattr(message, points) if message else 0
    known = count > (1 if curved else 0)
    waves = f'{count} wave number' + ('s' if count != 1 else '')
    return Row(
        f'{name[0]}{name[1:].upper()} of lambda = c k + c2 k^2',
        None,
        getattr(message, name) if known else None,
        max(getattr(message, name + '_error'), 0.0) if known else 0.0,
        unit=UNITS[curved],
        remark=f'over {waves}',
    )


def figures(bags):
    figure = figure_of_dispersion.draw(bags['periodic'].recording)
    if figure is not None:
        yield 'dispersion', figure


def tables(bags):
    found = steps.resolved(bags['periodic'].recording.steps)
    header = (
        'kind',
        'nx',
        'ny',
        'k',
        'exponent',
        'std_error',
        'multiplicity',
        'expected',
        'steps_of_its_vectors',
    )
    yield 'steps', header, [
        (
            steps.NAMES[step.kind],
            step.nx,
            step.ny,
            f'{step.wave_number:.6f}',
            f'{step.exponent:.7g}',
            f'{step.std_error:.2g}',
            f'{step.multiplicity:.4f}',
            step.expected,
            step.members,
        )
        for step in sorted(found.values(), key=lambda step: (step.kind, step.wave_number))
    ]
