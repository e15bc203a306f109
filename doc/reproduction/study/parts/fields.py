"""Part 4: the vector fields of the T, L and P modes of the smallest wave vectors, and T(1,1) as two
scalar patterns."""

import numpy as np

from hdlyap.data import reader, steps, waves
from hdlyap.plots.figures import modes
from hdlyap.plots.figures.pattern import pattern
from hdlyap.plots.figures.style import GREEN, INK, KIND_COLOURS, plt, scene

from .. import averages, pairs, projection
from ..bags import once
from ..files import cells
from ..row import Row

RUN = 'periodic'
NODES = ((1, 0), (0, 1), (1, 1))
STEPS = {kind: [f'{kind}({nx},{ny})' for nx, ny in NODES] for kind in ('T', 'LP')}
PATTERN = 'T(1,1)'
LIMIT = 2.5  # root mean squares shown
WIDTH = 7.2  # of a figure [inch]
GRID = 60  # points along a direction


@once
def _by_step(bag):
    """{name: the fields of its vectors at all times}"""
    found = {}
    for field in bag.messages(reader.FIELD):
        if steps.NAMES.get(field.kind) in ('T', 'LP'):
            found.setdefault(steps.name(field), []).append(field)
    return found


def _fields(bags, name):
    return _by_step(bags[RUN]).get(name, [])


def _reconstructed(bags, name):
    """Fields of its vectors that have L and P modes beside them: its vectors are its own."""
    return [field for field in _fields(bags, name) if field.pairs]


# ---- rows ----------------------------------------------------------------------------------------


def inside(bags):
    info = bags[RUN].recording.info
    for letters, names in STEPS.items():
        for name in names:
            times = [[one] for one in _fields(bags, name)]
            yield _weight(info, f'weight of {name} in its {letters} fields', letters, times)


def divergence(bags):
    """No more than chance."""
    for name in STEPS['T']:
        times = [[one] for one in _fields(bags, name)]
        yield _none(bags, f'weight of {name} in the L fields', 'L', times)


def rotation(bags):
    for name in STEPS['LP']:
        times = [pairs.modes(field, 'L') for field in _reconstructed(bags, name)]
        yield _none(bags, f'weight of the L modes of {name} in the T fields', 'T', times)


def _none(bags, quantity, letter, times):
    info = bags[RUN].recording.info
    row = _weight(info, quantity, letter, times)
    row.published = 0.0
    if times:
        row.left_open = projection.chance(info, times[0][0], letter)
    return row


def _weight(info, quantity, letters, times):
    """times: of each, the fields that are averaged before the error is known."""
    if not times:
        return Row(quantity)
    weights = [np.mean([projection.weight(info, one, letters) for one in now]) for now in times]
    chance = projection.chance(info, times[0][0], letters)
    remark = f'{len(times)} snapshots; by chance {chance:.4f}'
    return Row(quantity, None, *_mean(weights), remark=remark)


def rotated(bags):
    for name in STEPS['LP']:
        row = Row(f'largest deviation of a singular value of Q from 1, {name}')
        fields = _reconstructed(bags, name)
        if fields:
            row.measured, row.error = _mean([field.rotation_distance for field in fields])
            left = [np.mean([one.residual_l for one in fields])]
            left += [np.mean([one.residual_p for one in fields])]
            about = 'L {:.3f}, P {:.3f}'.format(*left)
            apart = f'distance of the fields from the vectors: {about}'
            row.remark = f'{len(fields)} snapshots; {apart}'
        yield row


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
        what = r'$\delta q$ of T; L and P modes, from all vectors of LP'
        at = f'$t={panels[0].field.sim_time:g}$'
        figure.suptitle(f'{scene(run.info)}, {at}: {what}', fontsize=9)
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
            letters = 'LP' if panel.field.pairs else ''
            found += [Panel(pairs.modes(panel.field, letter)[0]) for letter in letters]
    return found


def _patterns(panel, info):
    """Both components over the box, and the lines on which what lies in the T fields vanishes."""
    field = panel.field
    size = WIDTH, 0.5 * WIDTH * info.box_y / info.box_x + 0.3
    figure, grid = plt.subplots(1, 2, figsize=size, sharey=True, constrained_layout=True)
    disks = (0.4 * WIDTH * 72 / info.box_x) ** 2  # about as large as they are
    scale = np.sqrt(np.mean(np.square([field.dqx, field.dqy])))
    places = np.meshgrid(np.linspace(0, info.box_x, GRID), np.linspace(0, info.box_y, GRID))
    shapes = projection.continued(info, field, 'T', *places)
    for axes, axis, values, shape in zip(grid, 'xy', (field.dqx, field.dqy), shapes):
        pattern(axes, field.x, field.y, np.array(values) / scale, LIMIT, disks)
        axes.contour(*places, shape, levels=[0], colors=INK, linewidths=0.9)
        title = f'{panel.name}, $\\ell={field.index}$: $\\delta q_{axis}$ / rms'
        axes.set_title(title, loc='left', fontsize=8)
        axes.set(xlim=(0, info.box_x), ylim=(0, info.box_y), xlabel=r'$x$  [$\sigma$]')
    grid[0].set_ylabel(r'$y$  [$\sigma$]')
    at = f'{scene(info)}, $t={field.sim_time:g}$; lines: zeros of the fitted curl'
    figure.suptitle(at, fontsize=9)
    return figure


def tables(bags):
    info = bags[RUN].recording.info
    names = {name for some in STEPS.values() for name in some}
    header = 'step', 'time', 'index', 'in_T_fields', 'in_L_fields', 'in_P_fields'
    yield 'weights', header, [
        cells(
            's g s .5f .5f .5f',
            *(name, field.sim_time, field.index),
            *(projection.weight(info, field, letter) for letter in 'TLP'),
        )
        for name, fields in _by_step(bags[RUN]).items()
        if name in names
        for field in fields
    ]
