"""Part 4: the vector fields of the T and LP modes of the smallest wave vectors, and T(1,1) as two
scalar patterns."""

import numpy as np

from hdlyap.plots import recording, steps
from hdlyap.plots.figures import modes
from hdlyap.plots.figures.pattern import pattern
from hdlyap.plots.figures.style import INK, plt, scene

from .. import averages, projection
from ..row import ABOVE, BELOW, Claim, Row

TITLE = 'Vector fields of T and LP modes'
NODES = ((1, 0), (0, 1), (1, 1))
STEPS = [
    f'{kind}({nx},{ny})' for nx, ny in NODES for kind in ('T', 'LP')
]  # T and LP side by side in the figure
PATTERN = 'T(1,1)'
HALF, LITTLE = 0.5, 0.05  # of a vector, by its squared norm
LIMIT = 2.5  # root mean squares shown
WIDTH = 7.2  # of a figure [inch]
GRID = 60  # points along a direction


def runs(plan):
    return ['periodic']


def claims(bags):
    found = _by_step(bags['periodic'])
    yield Claim(
        'T and LP modes are the vector fields of their wave vectors',
        [
            _row(
                f'weight of {name} in its {letters} fields',
                bags,
                found.get(name),
                letters,
                HALF,
                ABOVE,
            )
            for name in STEPS
            for letters in ['T' if name.startswith('T') else 'LP']
        ],
        f'more than {HALF:g} of a vector lies in them',
    )
    yield Claim(
        'T modes are curls, which no gradient is part of',
        [
            _row(f'weight of {name} in the L fields', bags, found.get(name), 'L', LITTLE, BELOW)
            for name in STEPS
            if name.startswith('T')
        ],
        f'less than {LITTLE:g} of a vector lies in the L fields of its wave vector',
    )


def _by_step(bag):
    """{name: the fields of its vectors at all times}"""
    found = {}
    for field in bag.messages(recording.FIELD):
        if steps.NAMES.get(field.kind) in ('T', 'LP'):
            found.setdefault(steps.name(field), []).append(field)
    return found


def _row(quantity, bags, fields, letters, limit, sense):
    if not fields:
        return Row(quantity, limit, sense=sense)
    info = bags['periodic'].recording.info
    mean, error = averages.of_snapshots(
        [projection.weight(info, field, letters) for field in fields]
    )
    chance = projection.chance(info, fields[0], letters)
    return Row(
        quantity,
        limit,
        float(mean),
        float(error),
        remark=f'{len(fields)} snapshots; by chance {chance:.4f}',
        sense=sense,
    )


def figures(bags):
    run = bags['periodic'].recording
    figure = modes.draw(run, STEPS)
    if figure is not None:
        yield 'fields', figure
    panel = next(iter(modes.named(run, [PATTERN])), None)
    if panel is not None:
        yield 'patterns', _patterns(panel, run.info)


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
    info = bags['periodic'].recording.info
    lines = []
    for name, fields in _by_step(bags['periodic']).items():
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
