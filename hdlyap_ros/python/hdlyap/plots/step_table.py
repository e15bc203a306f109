"""Recording -> the table of steps, with their exponents, fits, LP dynamics and cost."""

from math import isfinite

from hdlyap.data import fits, steps
from hdlyap.data.fields import words
from hdlyap.data.phases import turning
from hdlyap.data.reader import is_known
from hdlyap.msg import Step
from hdlyap.numbers import with_error

from . import paper

WIDTH = 100  # largest width of a line with a list of names
COLUMNS = (
    ('indices', '<10'),
    ('found', '>8'),
    ('of', '>3'),
    ('k [1/sigma]', '>12'),
    ('exponent', '>13'),
)
PAPER_COLUMNS = (('c k', '>8'), ('deviation', '>11'))
NO_ERROR = '  zero modes have no errors: nothing fluctuates, their exponents go to 0 as (ln t) / t'
SHARING = words(Step, 'sharing')


def blocks(recording):
    """Yields the parts of the table. recording.steps must not be None."""
    yield table(recording)
    yield _fits(recording)
    yield from _lp_dynamics(recording)
    yield from _cost(recording)


def table(recording):
    """The steps alone."""
    message = recording.steps
    fitted = {step.name: step.fitted for step in paper.steps(recording.info)}
    title = (
        f'steps: at least {100 * message.threshold:.0f} % of the expected multiplicity found '
        '(standard errors)'
    )
    rows = [_zero_cells(recording), *_rows(message, fitted, recording.info)]
    if fitted:
        title += f'\nc k: {paper.FITS} (+-3 %)'
    remarks = _remarks(message, recording.info)
    return '\n'.join([title, *_layout(rows, bool(fitted)), *remarks])


def _rows(message, fitted, info):
    """Yields the cells of each row, smallest exponent first."""
    for block in steps.blocks(message, info):
        if len(block.steps) > 1:
            yield _shared_cells(block)
        for step in block.steps:
            yield _cells(block, step, steps.name(step, info), fitted)


def _layout(rows, beside_paper):
    """Yields lines: a heading, then one for each row of cells."""
    columns = COLUMNS + (PAPER_COLUMNS if beside_paper else ())
    width = max(len(row[0]) for row in rows)
    for row in [['step'] + [title for title, _ in columns]] + rows:
        cells = (f'{cell:{form}}' for cell, (_, form) in zip(row[1:], columns))
        yield '  ' + ' '.join([f'{row[0]:<{width}}', *cells]).rstrip()


def _zero_cells(run):
    zero = steps.zero_modes(run.steps)
    if zero is None or not zero.resolved:
        if run.spectrum is None or not is_known(run.info):
            return ['zero modes', 'not resolved']
        carried = run.last_index > run.positive_end
        return ['zero modes', 'not found' if carried else 'not carried']
    indices, exponent = steps.Block([zero]).indices, with_error(zero.exponent, zero.std_error)
    return ['zero modes', indices, *_found(zero), '', exponent]


def _found(step):
    """The multiplicity that was found, and the expected one, of a step or a block."""
    return f'{step.multiplicity:.2f}', str(step.expected)


def _shared_cells(block):
    known = {step.sharing for step in block.steps} - {Step.SHARING_UNKNOWN}
    said = sorted({SHARING.get(value, '') for value in known} - {''})
    return [block.name, block.indices, *_found(block), '', ', '.join(said)]


def _cells(block, step, name, fitted):
    """The cells of a step. If it shares its set it is indented, below the row of the set."""
    cells = ['  ' + name, ''] if len(block.steps) > 1 else [name, block.indices]
    cells += [*_found(step), f'{step.wave_number:.5f}', with_error(step.exponent, step.std_error)]
    if name in fitted:
        cells += [f'{fitted[name]:.4f}', f'{100 * (step.exponent / fitted[name] - 1):+.2f} %']
    return cells


def _remarks(message, info):
    """Yields lines about steps that are not in the table."""
    missing = steps.unresolved(message)
    if missing:
        names = [steps.name(step, info) for step in missing]
        yield '  ' + _names(f'not resolved ({len(missing)}): ', names)
    forbidden = steps.impossible(message, info)
    if forbidden:
        yield '  ' + _names('do not exist between such walls: ', forbidden)
    zero = steps.zero_modes(message)
    if zero is not None and zero.resolved and not zero.std_error > 0:
        yield NO_ERROR
    half = [step for step in message.steps if step.conjugate]
    if half:
        yield '  ' + _conjugates(message, half, info)


def _names(start, names):
    """A line with as many names as fit."""
    text = start
    for count, name in enumerate(names):
        if len(f'{text}{name} ') > WIDTH - len('and 999 more'):
            return f'{text}and {len(names) - count} more'
        text += name + ' '
    return text.rstrip()


def _conjugates(message, half, info):
    """A line about the negative half: how many steps are resolved, and how far they are from being
    the opposites of the positive ones."""
    found = [step for step in half if step.resolved]
    line = f'conjugate steps of the negative half: {len(found)} of {len(half)} resolved'
    mirror = steps.resolved(message, info)
    names = ((steps.name(step, info), step.exponent) for step in found)
    sums = [abs(exponent + mirror[name].exponent) for name, exponent in names if name in mirror]
    return line + (f', largest |sum with its partner| {max(sums):.1e}' if any(sums) else '')


def _fits(recording):
    lines = ['fits over the resolved steps [sigma/time unit, sigma^2/time unit ..], k [1/sigma]']
    branches = paper.branches(recording.info)
    for fit in fits.of(recording.steps):
        lines += _fit_lines(fit, recording)
        branch = branches.get(steps.NAMES[fit.kind])
        if branch and fit.count and fit.symbol != 'v':
            lines += _beside_paper(fit, fits.curve(recording.steps, fit, branch.terms), branch)
    return '\n'.join(line.rstrip() for line in lines)


def _fit_lines(fit, recording):
    """Lines about a fit: its basis, and its coefficients."""
    if not fit.count:
        return [f'  {fit.symbol:<5} {_why_none(fit, recording)}']
    basis = f'{steps.NAMES[fit.kind]} steps: {fit.basis}'
    if fit.symbol == 'v':
        basis = f'{fit.basis}, {fit.count} of them'
    values = [
        f'  {name:<5} {with_error(value, error)}' for name, value, error in fit.measured_values
    ]
    return [f'  {basis}{fit.beside}', *values]


def _why_none(fit, recording):
    if fit.is_unrelated:
        return 'none: LP steps of a circle follow no relation'
    exists = any(step.kind == fit.kind for step in recording.steps.steps)
    if not exists and steps.impossible(recording.steps, recording.info):
        return 'none: no T step exists between such walls'
    return 'not known' if fit.symbol == 'v' else 'not known: no step resolved'


def _beside_paper(fit, curve, branch):
    """Yields lines that compare a fit of the paper's form, over the same waves, with the paper's
    values."""
    if curve is None:
        return
    accuracy = f' +-{100 * paper.FIT_ACCURACY:.0f} %' if branch.terms == 1 else ''
    yield f'  by {fits.RELATIONS[branch.terms]} alone over the same waves'
    columns = zip(fit.values, curve.coefficients, curve.errors, branch.coefficients)
    for (name, _, _), value, error, published in columns:
        ours = with_error(value, error)
        yield f'  {name:<5} {ours:<15}Eckmann et al. 2005: {published:.3f}{accuracy}'


def _lp_dynamics(recording):
    """Yields a table with a line for each resolved LP step; nothing if phases were not recorded."""
    if recording.phases.last is None:
        return
    lines = [
        'LP dynamics: rotation of the vectors between L and P [rad/time unit, sigma/time unit]',
        f'  {"step":<14} {"omega":<15} {"v = omega / k":<15} phases tracked',
    ]
    for number, step in steps.resolved_lp(recording.steps):
        phases = [recording.phases.last.phases[i] for i in recording.phases.of_step(number)]
        omega, error, tracked = turning(step, phases)
        k, cells = step.wave_number, ('-', '-')
        if isfinite(omega):
            cells = with_error(omega, error), with_error(omega / k, error / k)
        name, (omega, v) = steps.name(step, recording.info), cells
        lines.append(f'  {name:<14} {omega:<15} {v:<15} {tracked} of {len(phases)}')
    if len(lines) > 2:
        yield '\n'.join(lines)


def _cost(recording):
    cost = recording.cost()
    if cost is not None and cost['wall'][-1] > 0:
        spent, wall = cost['modes'][-1], cost['wall'][-1]
        yield (
            f'classification, steps and phases took {100 * spent / wall:.1f} % of the run '
            f'({spent:.1f} s of {wall:.1f} s)'
        )
