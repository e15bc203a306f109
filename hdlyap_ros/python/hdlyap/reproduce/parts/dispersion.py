"""Part 2: the dispersion relation of 780 disks, both branches, to second order."""

from hdlyap.plots import fits, steps
from hdlyap.plots.figures import dispersion as figure_of_dispersion

from ..row import Claim, Row

TITLE = 'Dispersion relation of 780 disks, density 0.8'
UNITS = {False: 'sigma/time unit', True: 'sigma^2/time unit'}


def runs(plan):
    return ['periodic']


def claims(bags):
    """None: the paper's slopes are beside the steps' exponents in part 1."""
    message = fits.chosen(bags['periodic'].recording.steps, fits.RELATIONS[2])
    of_kinds = fits.of(message) or (None, None)
    yield Claim(
        'fits with curvature',
        [
            _fit(fit, name)
            for symbol, fit in zip(('c_T', 'c_L'), of_kinds)
            for name in (symbol, symbol + '2')
        ],
    )


def _fit(fit, name):
    """A coefficient of ours."""
    values = {name: (value, error) for name, value, error in fit.values} if fit else {}
    measured, error = values.get(name, (None, 0.0))
    curved = name.endswith('2')
    # asked for is the curve; c alone is what one wave number gives
    relation = fits.RELATIONS[fit.terms if fit and name in values else 2]
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
