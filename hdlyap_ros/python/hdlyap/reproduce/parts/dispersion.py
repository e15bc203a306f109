"""Part 2: the dispersion relation of 780 disks, both branches, to second order."""

from hdlyap.plots import fits, paper, steps
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
    for symbol, fit in zip(('c_T', 'c_L'), fits.of(recording.steps) or (None, None)):
        for name in (symbol, symbol + '2'):
            yield _fit(fit, name)


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


def _fit(fit, name):
    """A coefficient of ours."""
    values = {name: (value, error) for name, value, error in fit.values} if fit else {}
    measured, error = values.get(name, (None, 0.0))
    curved = name.endswith('2')
    # asked for is the curve; c alone is what one wave number gives
    relation = fits.RELATIONS[fit.terms if name in values else 2]
    count = fit.count if fit else 0
    return Row(
        f'{name} of lambda = {relation}',
        None,
        measured,
        max(error, 0.0),
        unit=UNITS[curved],
        remark=f'over {count} wave number' + ('s' if count != 1 else ''),
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
