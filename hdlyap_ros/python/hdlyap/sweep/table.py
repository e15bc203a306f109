"""Points -> a table as text, and as CSV."""

from math import isfinite, sqrt

from scipy.special import fdtrc

from hdlyap import whole
from hdlyap.data import printed, space
from hdlyap.numbers import with_error
from hdlyap.plots.deviation import FREEDOM
from hdlyap.plots.latex import cell, symbol, tabular, unit

from .points import FITTED, NAN, quantities, varied

PACKING, RUN = 'packing', 'run'  # columns that are no parameters

BESIDE = 4  # most systems with a column for each in LaTeX
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
    names, fixed = _columns(points)
    marks = Marks(points)
    if fixed:
        yield _same(fixed)
    head, rows = _cells(points, names, lambda point, name: _cell(point, name, marks))
    yield from _table(head, rows)
    yield from marks.explained()
    for point in points:
        yield from (*point.remarks, *point.data.left_out, *point.warnings)
    if any(point.unlike for point in points):
        yield 'unlike: no mean, as the fits of the seeds differ in form or wave numbers'
    rows = [
        [*_of_system(point, names), name, *_errors(value)]
        for point in points
        for name, value in point.values.items()
        if len(point.runs) > 1 and isfinite(value.error)
    ]
    if rows:
        yield 'both errors of the means over seeds; the table above has the larger:'
        head = 'quantity', 'from those stated', 'from the scatter', 'chi^2/(seeds - 1)'
        yield from _table([*names, *head], rows)
        yield from _scattered(points, [name for name in names if name not in (PACKING, RUN)])


def latex(points, style):
    """Yields the lines of the table for LaTeX: of one system with a row for each quantity, of few
    with a column for each system, which fits on a page, of more with a row for each."""
    if len(points) == 1:
        yield from _of_one(points[0], style)
        return
    names, fixed = _columns(points)
    marks, info = Marks(points), points[0].data.info
    head, rows = _cells(points, names, _bare)
    of = quantities(points)
    columns = [(name, of.get(name, _unit(name, info)), *cells) for name, *cells in zip(head, *rows)]
    others = {*names, *of}
    alike = [one for one in columns if one[0] not in others and len(set(one[2:])) == 1]
    fixed.update((name, cell) for name, _, cell, *_ in alike)
    if fixed:
        yield f'% {_same(fixed)}'
    columns = [one for one in columns if one not in alike]
    yield from (_beside if len(points) <= BESIDE else _below)(columns, style)
    yield from (f'% {line}' for line in marks.explained())
    yield from (f'% {line}' for point in points for line in point.warnings)


def _below(columns, style):
    head, units, *rows = zip(*columns)
    return tabular(head, rows, style, units)


def _beside(columns, style):
    head, *rows = [(symbol(name), unit(of), *cells) for name, of, *cells in columns]
    return tabular([cell(one, style) for one in head], rows, style)


def _of_one(point, style):
    found = printed.of(point.data)
    yield f'% {point.data.name if len(point.runs) == 1 else "means over seeds"}'
    rows = [
        [symbol(name), row['k'], row['value'], unit(row['unit'])] for name, row in found.iterrows()
    ]
    units = '', found.attrs['units']['k'], '', ''
    yield from tabular(['quantity', 'k', 'value', 'unit'], rows, style, units)
    yield from (f'% {line}' for line in point.warnings)


def _unit(name, info):
    found = {'density': f'1/sigma^{len(space.axes(info))}', 'averaged time': 'time units'}
    return found.get(name, '')


def _columns(points):
    """varied(points), with the names of runs first and the packing fraction after the density."""
    names, fixed = varied(points)
    names = [RUN, *names] if any(point.run for point in points) else names
    packing = {_packing(point) for point in points}
    if 0 in packing:  # particles without a size
        return names, fixed
    if len(packing) > 1:
        names.insert(names.index('density') + 1 if 'density' in names else len(names), PACKING)
        return names, fixed
    places = list(fixed.items())
    at = list(fixed).index('density') + 1 if 'density' in fixed else len(fixed)
    return names, dict([*places[:at], (PACKING, f'{packing.pop():.4g}'), *places[at:]])


def _packing(point):
    found = getattr(point.data.info, 'packing_fraction', 0)
    return found if found > 0 and 'density' in point.system else 0


def _cells(points, names, cell):
    """The head and the rows of all that was measured. cell: makes a text of (point, quantity)."""
    shown = [
        q
        for q in quantities(points)
        if any(q in point.values or q in point.unlike for point in points)
    ]
    errors = [point.energy_error for point in points]
    has_errors = any(error is not None for error in errors)
    rows = []
    for point, error in zip(points, errors):
        rows.append([*_of_system(point, names), *(cell(point, q) for q in shown)])
        rows[-1] += [_digits(NAN if error is None else error)] if has_errors else []
        rows[-1] += [str(len(point.runs)), f'{point.data.averaged_time:g}']
    energy = ['energy error'] if has_errors else []
    return [*names, *shown, *energy, 'seeds', 'averaged time'], rows


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


def _same(fixed):
    return 'the same in all: ' + ', '.join(f'{name} {_plain(x)}' for name, x in fixed.items())


def _plain(value):
    return value if isinstance(value, str) else f'{value:.10g}'


def _of_system(point, names):
    return [_part(point, name) for name in names]


def _part(point, name):
    if name == RUN:
        return point.run
    return f'{_packing(point):.4g}' if name == PACKING else _plain(point.system[name])


def _cell(point, name, marks):
    if name in point.unlike:
        return 'unlike'
    if name not in point.values:
        return ''
    value = point.values[name]
    misfit = f', misfit {value.misfit:.1f}' if isfinite(value.misfit) else ''
    return with_error(value.value, value.error) + misfit + marks.of(value.fit)


def _bare(point, name):
    """A cell without misfit and mark."""
    value = point.values.get(name)
    return with_error(value.value, value.error) if value else '-'


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
    for name, of_it in quantities(points).items():
        head += [
            f'{name} [{of_it}]' if of_it else name,
            f'{name} std_error',
            f'{name} scatter',
            f'{name} chi2',
        ]
        head += [f'{name} misfit', f'{name} basis'] if name in FITTED else []
    names = list(quantities(points))
    whole.write_csv(path, head, (_row(point, names) for point in points))


def _row(point, names):
    row = [
        *map(_plain, point.system.values()),
        ' '.join(point.data.seeds),
        f'{point.data.averaged_time:g}',
    ]
    for name in names:
        value = point.values.get(name)
        numbers = value[:4] if value else [NAN] * 4
        if name in FITTED:
            numbers = [*numbers, value.misfit if value else NAN]
        row += [repr(x) if isfinite(x) else '' for x in numbers]
        if name in FITTED:
            row.append(value.fit.basis if value and value.fit else '')  # an average has none
    return row
