"""Recording -> the text about covariant vectors that hdlyap plot prints."""

from math import isfinite

import numpy as np

from hdlyap.data import steps
from hdlyap.numbers import with_error

from . import covariant

STEPS = 12  # most steps and conjugate steps in a table
UNRESOLVED = 4  # most waves without a step
LISTED = 8  # most indices in a line
ROUNDING = 1e-9  # rounding error of an angle [rad]
ROW = '  {:<18} {:<11} {:>13} {:>13} '
WEIGHTS = ROW + '{:>13} {:>13}'
ZERO = 'zero modes have no errors: they fall like 1 / t, of the averages or of a window'
MET = 1e-3  # spaces of two starts with at most this angle are the same [rad]


def blocks(recording):
    """Yields the parts of the text. recording.covariant must not be None."""
    yield _exponents(recording)
    yield from _weights(recording)
    yield _spaces(recording)
    yield _order(recording)
    yield _convergence(recording)


def _head(message):
    lost = (
        f', {message.lost_windows} left out as covariant_memory was too small'
        if message.lost_windows
        else ''
    )
    count = f'{message.windows} window' + ('s' if message.windows != 1 else '')
    return (
        f'covariant vectors: {message.averaged_time:g} time units in {count}{lost}, '
        f'{message.samples} samples (standard errors)'
    )


def _exponents(recording):
    compared = covariant.Compared(recording)
    head = ROW.format('exponents', 'indices', 'forward', 'backward')
    lines = [_head(recording.covariant), head + 'deviation in combined errors']
    for name, block in _chosen(recording):
        means = compared.over(block)
        if means is not None:
            both = with_error(*means[:2]), with_error(*means[2:4])
            lines.append(ROW.format(name, block.indices, *both) + f'{_deviation(means[4]):>9}')
    return '\n'.join([*lines, *_all_deviations(compared)])


def _chosen(recording):
    return list(covariant.blocks(recording))[:STEPS]


def _deviation(deviation):
    return f'{deviation:+.2f}' if isfinite(deviation) else '-'


def _all_deviations(compared):
    """Yields a line for all exponents but zero modes, and one for these: they fall with the time of
    a window, and not with that of the average."""
    zero = compared.is_zero
    for what, chosen in (('without zero modes', ~zero), ('zero modes', zero)):
        off = np.where(chosen, compared.deviation, np.nan)
        count = int(np.isfinite(off).sum())
        if count:
            place = int(np.nanargmax(np.abs(off)))
            yield (
                f'  {what}, {count} in all: root mean square {np.sqrt(np.nanmean(off ** 2)):.2f}, '
                f'largest {off[place]:+.2f} at {compared.indices[place]}'
            )
    is_known = np.isfinite(compared.deviation)
    if zero.any() and is_known.any() and not is_known[zero].any():
        yield f'  {ZERO}'


def _weights(recording):
    rows = []
    for name, block in _chosen(recording):
        half = name[: -len(block.name)] if name.endswith(block.name) else ''
        rows += [
            _weight_row(half + steps.name(step, recording.info), block.indices, weights)
            for step, weights in covariant.weights_over(recording, block)
        ]
    without = list(covariant.unresolved_weights(recording))[:UNRESOLVED]
    for weight, indices, weights in without:
        name = steps.name(weight, recording.info) + ' *'
        rows.append(_weight_row(name, _listed(indices), weights))
    if without:
        rows.append(
            '  * no step found: the vectors with the largest dq weights, '
            'as many as the step should have'
        )
    if rows:
        columns = 'Gram-Schmidt', 'covariant dq', 'covariant dp', 'by chance'
        title = 'weights in the fields of the step, means over its vectors (halves normalised)'
        yield '\n'.join([title, WEIGHTS.format('step', 'indices', *columns), *rows])


def _weight_row(name, indices, weights):
    cells = (f'{weight:.3f}' if isfinite(weight) else '-' for weight in weights)
    return WEIGHTS.format(name, indices, *cells)


def _listed(indices):
    """Indices as 386-389, or the first one if they are not consecutive."""
    together = indices[-1] - indices[0] == len(indices) - 1
    return f'{indices[0]}-{indices[-1]}' if together else f'{indices[0]} ..'


def _spaces(recording):
    message = recording.covariant
    if not message.angles:
        return 'angles between the unstable, centre and stable space: not all three are carried'
    lines = [
        'angles between spaces [rad]',
        f'  {"spaces":<16} {"smallest, mean":>15} {"least":>9} {"all, mean":>10}',
    ]
    for angle in message.angles:
        at = covariant.only_bin(angle.all_counts)
        remark = '   all within {:.0f} .. {:.0f} degrees'.format(*np.degrees(at)) if at else ''
        lines.append(
            f'  {covariant.SPACES[angle.spaces]:<16} {_angle(angle):>15} '
            f'{angle.least:>9.5f} {angle.mean_of_all:>10.5f}{remark}'
        )
    if message.null_angle >= 0:
        lines.append(
            f'  covariant centre to exact null space: {message.null_angle:.1e} at the last sample, '
            f'{message.largest_null_angle:.1e} at most'
        )
    return '\n'.join(lines)


def _angle(angle):
    """The mean smallest angle. If it never varies, its error is rounding, and left out."""
    return with_error(angle.mean, angle.std_error if angle.std_error > ROUNDING else -1.0)


def _order(recording):
    message = recording.covariant
    if len(message.exponents) < 2:
        return 'order of finite-time exponents: one vector has no neighbour'
    violations = np.array(message.violations)
    isolated = covariant.isolated(recording)
    names = ' '.join(map(str, isolated[:LISTED]))
    more = f' and {len(isolated) - LISTED} more' if len(isolated) > LISTED else ''
    behind = f': after the indices {names}{more}' if names else ''
    return (
        f'order of finite-time exponents: {(violations > 0).sum()} of {len(violations)} pairs of '
        f'neighbours changed it at times, {100 * violations.mean():.1f} % of the time on average\n'
        f'  dominated splittings ({len(isolated)}){behind}'
    )


def _convergence(recording):
    message = recording.covariant
    apart = np.array(message.start_mismatch)
    lines = [
        'angles between the results of two random starts where the last window ended',
        f'  vectors: sine {np.median(apart):.1e} in the median, {apart.max():.1e} at most '
        '(vectors of equal exponents never agree)',
    ]
    both = ('centre', message.centre_start_mismatch), ('stable', message.stable_start_mismatch)
    spaces = {name: value for name, value in both if value >= 0}
    if spaces:
        said = ', '.join(f'{name} {value:.1e}' for name, value in spaces.items())
        short = ': covariant_transient is too short' if max(spaces.values()) > MET else ''
        lines.append(f'  spaces: {said} rad{short}')
    return '\n'.join([*lines, _seconds(recording)])


def _seconds(recording):
    line = f'covariant vectors took {recording.covariant.seconds:.1f} s'
    cost = recording.cost()
    if cost is None:
        return line
    return line + (
        f', the tangent frame forwards (replay and orthonormalisation) '
        f'{cost["replay"][-1] + cost["ortho"][-1]:.1f} s, the run {cost["wall"][-1]:.1f} s'
    )
