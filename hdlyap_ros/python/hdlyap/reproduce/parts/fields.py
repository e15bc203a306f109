"""Part 4: the vector fields of the T, L and P modes of the smallest wave vectors, and T(1,1) as two
scalar patterns."""

import numpy as np

from hdlyap.data import reader
from hdlyap.plots import steps, waves
from hdlyap.plots.figures import modes
from hdlyap.plots.figures.pattern import pattern
from hdlyap.plots.figures.style import GREEN, INK, KIND_COLOURS, plt, scene

from .. import averages, pairs, projection
from ..row import ABOVE, BELOW, Claim, Row

TITLE = 'Vector fields of T, L and P modes'
RUN = 'periodic'
NODES = ((1, 0), (0, 1), (1, 1))
STEPS = [f'{kind}({nx},{ny})' for nx, ny in NODES for kind in ('T', 'LP')]
PATTERN = 'T(1,1)'
HALF = 0.5  # of a vector, by its squared norm
NEARER = 0.5  # to a rotation, 0, than to what vectors of no step would give, 1
LIMIT = 2.5  # root mean squares shown
WIDTH = 7.2  # of a figure [inch]
GRID = 60  # points along a direction


def runs(plan):
    return [RUN]


# ---- claims --------------------------------------------------------------------------------------


def claims(bags):
    info, found = bags[RUN].recording.info, _by_step(bags[RUN])
    of = {kind: [name for name in STEPS if name.startswith(kind + '(')] for kind in ('T', 'LP')}
    yield Claim(
        'T and LP modes are the vector fields of their wave vectors',
        [_inside(info, name, kind, found.get(name)) for kind in of for name in of[kind]],
        f'more than {HALF:g} of a vector lies in them',
    )
    yield Claim(
        'T modes are free of divergence',
        [
            _none(info, f'weight of {name} in the L fields', 'L', [[one] for one in found[name]])
            if name in found
            else Row(f'weight of {name} in the L fields', 0.0)
            for name in of['T']
        ],
        'no more of them lies in the L fields of their wave vector than of a random vector',
    )
    yield Claim(
        'L modes, reconstructed from the vectors of an LP step, are free of rotation',
        [_no_curl(info, name, _reconstructed(found, name)) for name in of['LP']],
        'no more of them lies in the T fields of their wave vector than of a random vector',
    )
    yield Claim(
        'the vectors of an LP step are nearly its L and P modes, rotated',
        [_rotated(name, _reconstructed(found, name)) for name in of['LP']],
        f'singular values of Q are 1 but for less than {NEARER:g}; of random vectors they are '
        'near 0',
    )


def _by_step(bag):
    """{name: the fields of its vectors at all times}"""
    found = {}
    for field in bag.messages(reader.FIELD):
        if steps.NAMES.get(field.kind) in ('T', 'LP'):
            found.setdefault(steps.name(field), []).append(field)
    return found


def _reconstructed(found, name):
    """Fields of its vectors that have L and P modes beside them: its vectors are its own."""
    return [field for field in found.get(name, ()) if field.pairs]


def _inside(info, name, letters, fields):
    quantity = f'weight of {name} in its {letters} fields'
    if not fields:
        return Row(quantity, HALF, sense=ABOVE)
    weights = [projection.weight(info, field, letters) for field in fields]
    chance = projection.chance(info, fields[0], letters)
    remark = f'{len(fields)} snapshots; by chance {chance:.4f}'
    return Row(quantity, HALF, *_mean(weights), remark=remark, sense=ABOVE)


def _no_curl(info, name, fields):
    quantity = f'weight of the L modes of {name} in the T fields'
    if not fields:
        return Row(quantity, 0.0)
    return _none(info, quantity, 'T', [pairs.modes(field, 'L') for field in fields])


def _none(info, quantity, letter, times):
    """No more than chance. times: of each, the fields that are averaged before the error is
    known."""
    weights = [np.mean([projection.weight(info, one, letter) for one in now]) for now in times]
    chance = projection.chance(info, times[0][0], letter)
    remark = f'{len(times)} snapshots; by chance {chance:.4f}'
    return Row(quantity, 0.0, *_mean(weights), left_open=chance, remark=remark)


def _rotated(name, fields):
    quantity = f'largest deviation of a singular value of Q from 1, {name}'
    if not fields:
        return Row(quantity, NEARER, sense=BELOW)
    residuals = (
        np.mean([getattr(one, part) for one in fields]) for part in ('residual_l', 'residual_p')
    )
    return Row(
        quantity,
        NEARER,
        *_mean([field.rotation_distance for field in fields]),
        remark=f'{len(fields)} snapshots; distance of the fields from the vectors: '
        + 'L {:.3f}, P {:.3f}'.format(*residuals),
        sense=BELOW,
    )


def _mean(values):
    mean, error = averages.of_snapshots(values)
    return float(mean), float(error)


# ---- figures and table ---------------------------------------------------------------------------


class Panel:
    """A reconstructed mode in place of modes.Panel."""

    def __init__(self, mode):
        self.field = mode
        self.name = f'{mode.letter}({mode.nx},{mode.ny})'
        self.title = f'{self.name}, $A=${waves.formula(mode.nx, mode.ny, mode.bits)}'
        self.colour = KIND_COLOURS['LP'] if mode.letter == 'L' else GREEN


def figures(bags):
    run = bags[RUN].recording
    panels = _panels(run)
    if panels:
        figure = modes.draw_panels(panels, run.info)
        figure.suptitle(
            f'{scene(run.info)}, $t={panels[0].field.sim_time:g}$: $\\delta q$ of T; '
            'L and P modes, from all vectors of LP',
            fontsize=9,
        )
        yield 'fields', figure
    panel = next(iter(modes.named(run, [PATTERN])), None)
    if panel is not None:
        yield 'patterns', _patterns(panel, run.info)


def _panels(run):
    """Of each wave vector a T vector, and an L mode beside the P mode of the same modulation."""
    found = []
    for nx, ny in NODES:
        found += modes.named(run, [f'T({nx},{ny})'])
        for panel in modes.named(run, [f'LP({nx},{ny})']):
            found += [Panel(pairs.modes(panel.field, letter)[0]) for letter in _letters(panel)]
    return found


def _letters(panel):
    return 'LP' if panel.field.pairs else ''


def _patterns(panel, info):
    """Both components over the box, and the lines on which what lies in the T fields vanishes."""
    field = panel.field
    height = 0.5 * WIDTH * info.box_y / info.box_x + 0.3
    figure, grid = plt.subplots(1, 2, figsize=(WIDTH, height), sharey=True, constrained_layout=True)
    size = (0.4 * WIDTH * 72 / info.box_x) ** 2  # about as large as the disks
    scale = np.sqrt(np.mean(np.square([field.dqx, field.dqy])))
    for axes, axis, values, shape in zip(grid, 'xy', (field.dqx, field.dqy), _shape(field, info)):
        pattern(axes, field.x, field.y, np.array(values) / scale, LIMIT, size)
        axes.contour(*_places(info), shape, levels=[0], colors=INK, linewidths=0.9)
        axes.set_xlim(0, info.box_x)
        axes.set_ylim(0, info.box_y)
        axes.set_xlabel(r'$x$  [$\sigma$]')
        axes.set_title(
            f'{panel.name}, $\\ell={field.index}$: $\\delta q_{axis}$ / rms', loc='left', fontsize=8
        )
    grid[0].set_ylabel(r'$y$  [$\sigma$]')
    figure.suptitle(
        f'{scene(info)}, $t={field.sim_time:g}$; lines: zeros of the fitted curl', fontsize=9
    )
    return figure


def _places(info):
    return np.meshgrid(np.linspace(0, info.box_x, GRID), np.linspace(0, info.box_y, GRID))


def _shape(field, info):
    """Both components of the fitted T field on the grid of places."""
    return projection.continued(info, field, 'T', *_places(info))


def tables(bags):
    info = bags[RUN].recording.info
    lines = []
    for name, fields in _by_step(bags[RUN]).items():
        if name in STEPS:
            lines += [
                (
                    name,
                    f'{field.sim_time:g}',
                    field.index,
                    *(f'{projection.weight(info, field, letters):.5f}' for letters in 'TLP'),
                )
                for field in fields
            ]
    yield 'weights', ('step', 'time', 'index', 'in_T_fields', 'in_L_fields', 'in_P_fields'), lines
