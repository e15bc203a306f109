"""data.summary.Summary -> the text that hdlyap plot prints."""

import numpy as np

from hdlyap.data import printed, seeds, space
from hdlyap.data.containers import is_curved, radius
from hdlyap.data.reader import NoInfo, is_known
from hdlyap.numbers import known, with_error

from . import covariant_table, equation, paper, step_table

SHORT = (
    'too short for standard errors; rosrun hdlyap hdlyap_node --check SCENE says how long they take'
)
TAIL = 64  # most exponents in the table
COLUMNS = 4
MEAN = '  {:<16} {:>15} {:>15} {:>15} {:>12} {:>4}  {}'
HEAD = MEAN.format('', 'mean', 'stated error', 'from scatter', 'chi^2/(n-1)', 'n', '').rstrip()


def report(recording):
    if recording.is_mean:
        return _of_means(recording)
    blocks, lost = [_head(recording)], []
    for name, part in PARTS.items():
        try:
            blocks += part(recording)
        except NoInfo:
            lost.append(name)
    if lost:
        blocks.append(f'not here, as it needs run_info: {", ".join(lost)}')
    return '\n\n'.join(blocks)


def _of_spectrum(recording):
    return [] if recording.spectrum is None else [_sums(recording)]


def _of_tail(recording):
    return [] if recording.spectrum is None else [_tail(recording)]


def _of_steps(recording):
    if recording.steps is not None:
        return step_table.blocks(recording)
    return [] if recording.spectrum is None else _paper_block(recording)


def _of_gas(recording):
    return [] if recording.gas is None else [_gas(recording)]


def _of_averages(recording):
    """What the particles tell, block by block."""
    told = recording.averages
    if told is None:
        return
    width = max([15, *(len(one.name) for one in told.averages)])
    lines = [
        f'{one.name:<{width}} {with_error(one.value, one.std_error)} {one.unit}'.rstrip()
        for one in told.averages
    ]
    yield '\n'.join([f'averages, over {told.averaged_time:g}', *lines])


def _of_covariant(recording):
    return [] if recording.covariant is None else covariant_table.blocks(recording)


def _of_caged(recording):
    if recording.is_caged:
        yield (
            f'{space.particle(recording.info)}s have kept their places since the averaging began: '
            'errors hold\nfor this arrangement only, other seeds may differ by more'
        )


def _of_energy(recording):
    error = recording.energy_error
    if error is not None:
        yield f'energy error    {error:.1e} at most, relative'


# what a part is about: its blocks, of what was recorded
PARTS = {
    'the gas': _of_gas,
    'averages': _of_averages,
    'sums': _of_spectrum,
    'the last exponents': _of_tail,
    'steps': _of_steps,
    'covariant vectors': _of_covariant,
    'whether particles are caged': _of_caged,
    'the energy': lambda recording: [*_of_energy(recording), *recording.energies_off()],
}


def _of_means(recording):
    blocks = [_head(recording), *_of_gas(recording), *_of_averages(recording)]
    blocks += recording.energies_off()
    if recording.spectrum is None:
        return '\n\n'.join(blocks)
    blocks += [_means(recording), _tail(recording)]
    if recording.steps is not None:
        blocks.append(next(step_table.blocks(recording)))
    alone = recording.data.without_mean
    if alone:
        blocks.append(f'no means, see the single runs: {", ".join(alone)}')
    return '\n\n'.join(blocks)


def _means(recording):
    """The two errors and chi^2 of each mean."""
    of_all = recording.data
    count = len(of_all.runs)
    number = '1 seed' if count == 1 else f'{count} seeds'
    lines = [f'means over {number}, weighted with their averaged times', HEAD]
    assumed = printed.assumed(of_all)
    lines += [
        _mean(name, row, 'value', row['basis'])
        for name, row in of_all.results.iterrows()
        if name not in assumed
    ]
    if recording.steps is not None:
        found = of_all.steps[of_all.steps['resolved']]
        lines += [_mean(name, row, 'exponent') for name, row in found.iterrows()]
    lost = [fit.symbol for fit in of_all.runs[0].fits if fit.symbol not in of_all.results.index]
    if lost:
        lines.append(
            f'  {", ".join(lost)}: no mean, as runs have fits of other forms or wave numbers'
        )
    lines += [f'  {line}' for line in of_all.left_out]
    return '\n'.join(lines)


def _mean(name, row, column, remark=''):
    count = int(row['runs'])
    chi2 = f'{row["chi2"] / (count - 1):.2f}' if count > 1 and np.isfinite(row['chi2']) else '-'
    stated, scatter = (
        f'{row[error]:.2g}' if np.isfinite(row[error]) else '-'
        for error in ('std_error', 'scatter')
    )
    value = with_error(row[column], float(seeds.errors(row)))
    return MEAN.format(name, value, stated, scatter, chi2, count, remark).rstrip()


def _head(recording):
    if not is_known(recording.info):
        run_id = recording.info.run_id
        return f'run {run_id}: no run_info in the bag, so its parameters are not known'
    head = f'scene {recording.info.scene}: {system(recording.info)}\n{origin(recording.info)}'
    runs = recording.data.runs_in_bag
    if runs > 1:
        head += f'\none of {runs} runs in the bag; --run 1 .. {runs} chooses'
    return head


def system(info):
    if space.without_box(info):
        return space.without_box(info)
    packing = f', packing {info.packing_fraction:.4g}' if info.packing_fraction > 0 else ''
    if is_curved(info):
        size = f'{info.box_x:.3f} x {info.box_y:.3f}'
        size = f'R = {radius(info):.4f}' if radius(info) else size
        named = f'N = {info.number}{space.named(info)}'
        return f'{named}, density {info.density:g}{packing}, {info.container}, {size}'
    return (
        f'N = {info.number}{space.named(info)}, density {info.density:g}{packing}, box '
        + ' x '.join(f'{edge:.3f}' for edge in space.along(info, 'box_'))
        + ''.join(f', {axis} {getattr(info, "boundary_" + axis)}' for axis in space.axes(info))
        + space.shear(info)
    )


def origin(info):
    run = f'run {info.run_id}' if info.run_id else 'means over seeds'
    return f'seed {info.seed}, hdlyap {info.version}, {run}'


def _sums(recording):
    spectrum = recording.spectrum
    short = '' if spectrum.std_errors[0] > 0 else f', {SHORT}'
    lines = [
        f'averaged time   {spectrum.averaged_time:g}{short}',
        *([f'collisions      {spectrum.collisions}'] if spectrum.collisions else []),
        f'lambda_max      {with_error(spectrum.lambda_max, spectrum.std_errors[0])}',
    ]
    error = recording.sum_error
    total = with_error(spectrum.ks_entropy, error)
    if recording.sum_name == 'h_KS':
        each, of_each = spectrum.ks_entropy / recording.info.number, error / recording.info.number
        lines += [f'h_KS            {total}', f'h_KS / N        {with_error(each, of_each)}']
    elif len(spectrum.exponents) > 1:
        lines.append(f'sum of the {len(spectrum.exponents)} exponents carried {total}')
    if spectrum.pairing_error > 0:  # it is 0 where one half is the mirror image of the other
        lines.append(f'pairing error   {spectrum.pairing_error:.2e}')
    of_all = {'exponent_sum': 'sum of all', 'divergence': 'mean divergence'}
    of_all['kaplan_yorke'] = 'Kaplan-Yorke'
    for name, words in of_all.items() if spectrum.pairing_error < 0 else ():
        value = getattr(spectrum, name)
        if np.isfinite(value):
            lines.append(f'{words:<15} {with_error(value, getattr(spectrum, name + "_error"))}')
    return '\n'.join(lines)


def _gas(recording):
    gas, info = recording.gas, recording.info
    periodic = set(space.along(info, 'boundary_')) == {'periodic'}
    axes = space.axes(info)
    of_z = f'Z = p {"V" if space.is_solid(info) else "A"} / N'
    of_z += ' kT' if info.coordinates == 3 or gas.temperature > 0 else ''  # kT is 1 for disks
    each = ', '.join(
        with_error(getattr(gas, 'pressure_' + axis), getattr(gas, f'pressure_{axis}_error'))
        for axis in axes
    )
    per = f'per {space.particle(info)} and time unit'
    rows = [
        ('collision rate', gas.collision_rate, gas.collision_rate_error, per),
        *_of_pairs(gas, info),
        ('pressure', gas.pressure, gas.pressure_error, f'per sigma^{len(axes)}'),
        ('  of ' + ', '.join('p' + axis for axis in axes), each, -1.0, ''),
        (of_z, gas.compressibility, gas.compressibility_error, ''),
        ('temperature', gas.temperature, gas.temperature_error, 'epsilon'),
        ('potential / N', gas.potential_energy, gas.potential_energy_error, 'epsilon'),
        ('shear stress', gas.shear_stress, gas.shear_stress_error, f'per sigma^{len(axes)}'),
        ('v near low wall', gas.velocity_low, gas.velocity_low_error, 'sigma per time unit'),
        ('v near high one', gas.velocity_high, gas.velocity_high_error, 'sigma per time unit'),
    ]
    if not recording.spectrum:  # which has it, too
        rows.append(('divergence', gas.divergence, gas.divergence_error, 'per time unit'))
    lines = [f'gas, averaged over {gas.averaged_time:g}']
    for name, value, error, unit in rows:
        if value != value:
            continue  # such particles have none
        text = value if isinstance(value, str) else with_error(value, error)
        lines.append(f'{name:<15} {text} {unit}'.rstrip())
    reference = equation.of(info)
    if reference and periodic and info.density <= reference.most:
        lines.append(f'{"":<15} {reference.compressibility(info.density):.6f} by {reference.by}')
    return '\n'.join(lines)


def _of_pairs(gas, info):
    """Rows of what the pairs of kinds of a mixture have of the collision rate, and of what theory
    says."""
    if not space.is_mixture(info):
        return
    names = ['collision_rate_' + pair for pair in space.PAIRS]
    measured = [with_error(getattr(gas, name), getattr(gas, name + '_error')) for name in names]
    expected = [f'{getattr(gas, "expected_rate_" + pair):.4g}' for pair in space.PAIRS]
    yield '  pairs ' + ', '.join(space.PAIRS), ', '.join(measured), -1.0, ''
    yield '  by theory', ', '.join(expected) + f'; Z {gas.expected_compressibility:.4g}', -1.0, ''


def _tail(recording):
    spectrum = recording.spectrum
    end = min(recording.positive_end, recording.last_index)
    first = max(spectrum.first_index, end - TAIL + 1)
    what = 'before the zero modes' if end == recording.positive_end else 'carried'
    cells = []
    for index in range(first, end + 1):
        i = index - spectrum.first_index
        value = with_error(spectrum.exponents[i], spectrum.std_errors[i])
        cells.append(f'{index:6d} {value:>12}')
    head = f'{"index":>6} {"exponent":>12}'
    number = 'exponent' if len(cells) == 1 else f'last {len(cells)} exponents'
    return '\n'.join([f'the {number} {what} (standard errors)', *_in_columns(head, cells)])


def _in_columns(head, cells):
    """Lines of a table whose cells go downwards, then to the right."""
    rows = -(-len(cells) // COLUMNS)
    columns = [cells[start : start + rows] for start in range(0, len(cells), rows)]
    yield '  '.join([head] * len(columns))
    for row in range(rows):
        yield '  '.join(column[row] for column in columns if row < len(column))


def _paper_block(recording):
    """For a run without steps: the steps that the paper has at the same indices."""
    spectrum = recording.spectrum
    head = '  step     indices      k [1/sigma]  mean exponent      error    c k     deviation'
    first, last = spectrum.first_index, recording.last_index
    steps = paper.steps(recording.info)
    lines = [_paper_line(spectrum, s) for s in steps if first <= s.first and s.last <= last]
    if lines:
        yield '\n'.join([f'steps beside the {paper.FITS} (+-3 %)', head, *lines])


def _paper_line(spectrum, step):
    inside = slice(step.first - spectrum.first_index, step.last + 1 - spectrum.first_index)
    mean = np.mean(spectrum.exponents[inside])
    # the members of a step fluctuate together, so their errors do not average out
    error = np.mean(known(spectrum.std_errors[inside]))
    return (
        f'  {step.name:<8} {step.first}-{step.last}  {step.wave_number:11.5f}  '
        f'{mean:13.5f}   {error:8.5f}  {step.fitted:6.4f}  '
        f'{100 * (mean / step.fitted - 1):+8.2f} %'
    )
