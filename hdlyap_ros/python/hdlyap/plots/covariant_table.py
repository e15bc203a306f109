"""Recording -> what hdlyap plot prints of covariant vectors."""

from math import isfinite

import numpy as np

from hdlyap.data import steps
from hdlyap.numbers import with_error

from . import covariant

STEPS = 12  # steps and conjugate steps in a table
UNRESOLVED = 4  # waves without a step
LISTED = 8  # indices in a line
ROUNDING = 1e-9  # of an angle [rad]
MET = 1e-3  # angle between spaces of two starts that are taken for one [rad]


def blocks(recording):
    """The parts of the text; recording.covariant is there."""
    yield _exponents(recording)
    yield from _weights(recording)
    yield _spaces(recording)
    yield _order(recording)
    yield _convergence(recording)


def _head(message):
    lost = f', {message.lost_windows} lost for want of room' if message.lost_windows else ''
    count = f'{message.windows} window' + ('s' if message.windows != 1 else '')
    return (
        f'covariant vectors: {message.averaged_time:g} time units in {count}{lost}, '
        f'{message.samples} samples (standard errors)'
    )


def _exponents(recording):
    compared = covariant.Compared(recording)
    lines = [
        _head(recording.covariant),
        f'  {"exponents":<18} {"indices":<11} {"forward":>13} {"backward":>13} '
        'deviation in combined errors',
    ]
    for name, block in _chosen(recording):
        means = compared.over(block)
        if means is not None:
            forward, forward_error, backward, backward_error, deviation = means
            lines.append(
                f'  {name:<18} {block.indices:<11} {with_error(forward, forward_error):>13} '
                f'{with_error(backward, backward_error):>13} {_deviation(deviation):>9}'
            )
    return '\n'.join([*lines, *_all_deviations(compared)])


def _chosen(recording):
    return list(covariant.blocks(recording))[:STEPS]


def _deviation(deviation):
    return f'{deviation:+.2f}' if isfinite(deviation) else '-'


def _all_deviations(compared):
    """The zero modes for themselves: what is left of them falls with the time of a window, not with
    an average."""
    for what, chosen in (
        ('without zero modes', ~compared.is_zero),
        ('zero modes', compared.is_zero),
    ):
        off = np.where(chosen, compared.deviation, np.nan)
        count = int(np.isfinite(off).sum())
        if count:
            place = int(np.nanargmax(np.abs(off)))
            yield (
                f'  {what}, {count} in all: root mean square {np.sqrt(np.nanmean(off ** 2)):.2f}, '
                f'largest {off[place]:+.2f} at {compared.indices[place]}'
            )


def _weights(recording):
    rows = []
    for name, block in _chosen(recording):
        half = name[: -len(block.name)] if name.endswith(block.name) else ''
        rows += [
            _weight_row(half + steps.name(step, recording.info), block.indices, weights)
            for step, weights in covariant.weights_over(recording, block)
        ]
    remark = []
    for weight, indices, weights in list(covariant.unresolved_weights(recording))[:UNRESOLVED]:
        rows.append(
            _weight_row(steps.name(weight, recording.info) + ' *', _listed(indices), weights)
        )
        remark = [
            '  * no step found: as many vectors as its fields have dimensions, '
            'those with the largest dq weights'
        ]
    if rows:
        yield '\n'.join(
            [
                'weights in the fields of the step, means over its vectors (halves normalised)',
                f'  {"step":<18} {"indices":<11} {"Gram-Schmidt":>13} {"covariant dq":>13} '
                f'{"covariant dp":>13} {"by chance":>13}',
                *rows,
                *remark,
            ]
        )


def _weight_row(name, indices, weights):
    return f'  {name:<18} {indices:<11} ' + ' '.join(
        f'{weight:>13.3f}' if isfinite(weight) else f'{"-":>13}' for weight in weights
    )


def _listed(indices):
    """386-389, or the first of them."""
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
        remark = (
            f'   all within {np.degrees(at[0]):.0f} .. {np.degrees(at[1]):.0f} degrees'
            if at
            else ''
        )
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
    """Mean of the smallest one; where it never varies, its error is rounding."""
    return with_error(angle.mean, angle.std_error if angle.std_error > ROUNDING else -1.0)


def _order(recording):
    message = recording.covariant
    if len(message.exponents) < 2:
        return 'order of finite-time exponents: of one vector there is none'
    violations = np.array(message.violations)
    isolated = covariant.isolated(message)
    names = ' '.join(map(str, isolated[:LISTED]))
    more = f' and {len(isolated) - LISTED} more' if len(isolated) > LISTED else ''
    changed = int((violations > 0).sum())
    return '\n'.join(
        [
            f'order of finite-time exponents: {changed} of {len(violations)} pairs of neighbours '
            f'ever changed it, {100 * violations.mean():.1f} % of the time on average',
            f'  dominated splittings ({len(isolated)})'
            + (f': behind {names}{more}' if names else ''),
        ]
    )


def _convergence(recording):
    message = recording.covariant
    apart = np.array(message.start_mismatch)
    lines = [
        'how far two random starts are apart where the last window ended',
        f'  vectors: sine {np.median(apart):.1e} in the middle, {apart.max():.1e} at most '
        '(those of equal exponents never meet)',
    ]
    spaces = {
        name: value
        for name, value in (
            ('centre', message.centre_start_mismatch),
            ('stable', message.stable_start_mismatch),
        )
        if value >= 0
    }
    if spaces:
        lines.append(
            '  spaces: '
            + ', '.join(f'{name} {value:.1e}' for name, value in spaces.items())
            + ' rad'
            + (': covariant_transient is too short' if max(spaces.values()) > MET else '')
        )
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
