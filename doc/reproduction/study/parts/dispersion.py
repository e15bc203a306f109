"""Part 2: the dispersion relation of 780 disks, both branches, to second order."""

from hdlyap.data import fits, steps
from hdlyap.plots.figures import dispersion as figure_of_dispersion

from ..files import cells
from ..row import Row

RUN = 'periodic'
UNITS = {False: 'sigma/time unit', True: 'sigma^2/time unit'}
COLUMNS = 'kind', 'nx', 'ny', 'k', 'exponent', 'std_error', 'multiplicity', 'expected'


def coefficients(bags):
    message = fits.chosen(bags[RUN].recording.steps, fits.RELATIONS[2])
    for symbol, fit in zip(('c_T', 'c_L'), fits.of(message) or (None, None)):
        for name in (symbol, symbol + '2'):
            yield _fit(fit, name)


def _fit(fit, name):
    """A coefficient of ours."""
    values = {name: (value, error) for name, value, error in fit.values} if fit else {}
    measured, error = values.get(name, (None, 0.0))
    # asked for is the curve; c alone is what one wave number gives
    relation = fits.RELATIONS[fit.terms if fit and name in values else 2]
    count = fit.count if fit else 0
    remark, unit = f'over {count} wave number' + ('s' if count != 1 else ''), UNITS[name[-1] == '2']
    return Row(f'{name} of lambda = {relation}', None, measured, max(error, 0.0), unit, remark)


def figures(bags):
    yield 'dispersion', figure_of_dispersion.draw(bags[RUN].recording)


def tables(bags):
    found = steps.resolved(bags[RUN].recording.steps).values()
    yield 'steps', (*COLUMNS, 'steps_of_its_vectors'), [
        cells(
            's s s .6f .7g .2g .4f s s',
            *(steps.NAMES[one.kind], one.nx, one.ny, one.wave_number, one.exponent, one.std_error),
            *(one.multiplicity, one.expected, one.members),
        )
        for one in sorted(found, key=lambda one: (one.kind, one.wave_number))
    ]
