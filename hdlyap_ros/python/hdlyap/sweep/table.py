"""Points -> a table as text, and as CSV."""

from math import isfinite, sqrt

from scipy.special import fdtrc

from hdlyap import whole
from hdlyap.data import space
from hdlyap.numbers import with_error
from hdlyap.plots.deviation import FREEDOM

from .points import FITTED, NAN, QUANTITIES, varied

CHANCE = 0.02  # probability that a table says of some value that seeds differ although they agree


class Marks:
    """Numbers the bases of fits, in the order in which they appear."""

    def __init__(self, points):
        self._numbers = {}
        for point in points:
            for name in FITTED:
                if name in point.values:
                    basis = point.values[name].fit.basis
                    self._numbers.setdefault(basis, len(self._numbers) + 1)

    def of(self, fit):
        """The mark of a fit, e.g. ' [1]'; empty if there is no fit."""
        return f' [{self._numbers[fit.basis]}]' if fit else ''

    def explained(self):
        """Yields lines that explain the marks; none if there is no fit."""
        if self._numbers:
            yield 'forms of the fits and their wave numbers k [1/sigma]:'
        for basis, number in self._numbers.items():
            yield f'  [{number}] {basis}'


def text(points):
    """Yields the lines of the table."""
    names, fixed = varied(points)
    marks = Marks(points)
    yield 'the same in all: ' + ', '.join(f'{name} {_plain(x)}' for name, x in fixed.items())
    rows = []
    for point in points:
        rows.append([*_of_system(point, names), *(_cell(point, q, marks) for q in QUANTITIES)])
        rows[-1] += [str(len(point.runs)), f'{point.data.averaged_time:g}']
    yield from _table([*names, *QUANTITIES, 'seeds', 'averaged time'], rows)
    yield from marks.explained()
    for point in points:
        yield from (*point.remarks, *point.data.left_out, *point.data.summary.energies_off())
    if any(point.unlike for point in points):
        yield 'unlike: no mean, as the fits of the seeds differ in form or wave numbers'
    several = [point for point in points if len(point.runs) > 1]
    if several:
        yield 'both errors of the means over seeds; the table above has the larger:'
        head = 'quantity', 'from those stated', 'from the scatter', 'chi^2/(seeds - 1)'
        rows = [
            [*_of_system(point, names), name, *_errors(value)]
            for point in several
            for name, value in point.values.items()
        ]
        yield from _table([*names, *head], rows)
        yield from _scattered(points, names)


def _scattered(points, names):
    """Yields a line for each value whose seeds differ by more than their errors. The squared ratio
    of scatter and error, which a seed knows by FREEDOM degrees of freedom, has the F distribution.
    The probability of chance is multiplied by the number of values."""
    all_of = [(point, *one) for point in points for one in point.values.items()]
    known = [one for one in all_of if one[-1].scatter > 0 and one[-1].std_error > 0]
    for point, name, value in known:
        ratio = (value.scatter / value.std_error) ** 2
        chance = len(known) * float(fdtrc(value.runs - 1, FREEDOM * value.runs, ratio))
        if chance < CHANCE:
            where = ', '.join(map(' '.join, zip(names, _of_system(point, names))))
            yield (
                f'{name} ({where}): the seeds differ by {sqrt(ratio):.1f} times their errors, '
                f'which happens by chance in {100 * chance:.1g} % of such tables; steps of some '
                'seeds may mix: see their runs'
            )


def _plain(value):
    return value if isinstance(value, str) else f'{value:.10g}'


def _of_system(point, names):
    return [_plain(point.system[name]) for name in names]


def _cell(point, name, marks):
    if name in point.unlike:
        return 'unlike'
    if name not in point.values:
        return ''
    value = point.values[name]
    misfit = f', misfit {value.misfit:.1f}' if isfinite(value.misfit) else ''
    return with_error(value.value, value.error) + misfit + marks.of(value.fit)


def _errors(value):
    chi2 = value.chi2 / (value.runs - 1) if value.runs > 1 else NAN
    return map(_digits, (value.std_error, value.scatter, chi2))


def _digits(error):
    return f'{error:.2g}' if isfinite(error) else '-'


def _table(head, rows):
    rows = [head, *rows]
    widths = [max(map(len, column)) for column in zip(*rows)]
    for cells in rows:
        yield '  '.join(f'{cell:<{width}}' for cell, width in zip(cells, widths)).rstrip()


def csv(points, path):
    """Writes the table as CSV with all digits. A number that is not known is empty; the head has
    the units."""
    units = {'density': f' [1/sigma^{len(space.axes(points[0].data.info))}]'}
    head = [name + units.get(name, '') for name in points[0].system]
    head += ['seeds', 'averaged time [time units]']
    for name, unit in QUANTITIES.items():
        head += [f'{name} [{unit}]', f'{name} std_error', f'{name} scatter', f'{name} chi2']
        head += [f'{name} misfit', f'{name} basis'] if name in FITTED else []
    whole.write_csv(path, head, map(_row, points))


def _row(point):
    row = [
        *map(_plain, point.system.values()),
        ' '.join(point.data.seeds),
        f'{point.data.averaged_time:g}',
    ]
    for name in QUANTITIES:
        value = point.values.get(name)
        numbers = value[:4] if value else [NAN] * 4
        if name in FITTED:
            numbers = [*numbers, value.misfit if value else NAN]
        row += [repr(x) if isfinite(x) else '' for x in numbers]
        if name in FITTED:
            row.append(value.fit.basis if value else '')
    return row
