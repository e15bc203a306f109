"""Recorded vectors as fields: how much of them lies in the T, L and P fields of their wave vector,
and the P mode before and after division by the momenta."""

import matplotlib.pyplot as plt
import numpy as np

from hdlyap.data import steps, waves
from hdlyap.data.reader import FIELD
from hdlyap.plots.figures import modes, p_mode
from hdlyap.plots.figures.page import Page
from hdlyap.plots.figures.pattern import pattern
from hdlyap.plots.figures.style import GREEN, INK, KIND_COLOURS, scene

from .. import averages, projection
from ..averages import UNKNOWN
from ..bags import once
from ..row import Row

NODES = ((1, 0), (0, 1), (1, 1))
STEPS = {kind: [f'{kind}({nx},{ny})' for nx, ny in NODES] for kind in ('T', 'LP')}
PATTERN, P_MODE = 'T(1,1)', 'LP(1,0)'
LIMIT = 2.5  # root mean squares shown
WIDTH = 7.2  # of a figure [inch]
GRID = 60  # points along a direction


class Mode:
    """An L or a P mode that a field of an LP step has beside its vector [T14], of one pair, in
    place of that field, and in place of modes.Panel."""

    said, arrows = '', modes.Panel.arrows

    def __init__(self, field, info, letter, pair):
        self.field, self.info, bits = self, info, field.modulation[pair]
        for name in 'kind nx ny sim_time index exponent x y px py'.split():
            setattr(self, name, getattr(field, name))
        part = slice(pair * len(field.x), (pair + 1) * len(field.x))
        both = (field.l_x, field.l_y) if letter == 'L' else (field.p_x, field.p_y)
        self.dq = self.dqx, self.dqy = np.array([both[0][part], both[1][part]])
        self.z = self.dqz = self.angle = self.dq_angle = ()  # of disks
        self.name = f'{letter}({field.nx},{field.ny})'
        self.title = f'{self.name}, $A=${waves.formula(field.nx, field.ny, bits)}'
        self.colour = KIND_COLOURS['LP'] if letter == 'L' else GREEN


@once
def _by_step(bag):
    """{name: the fields of its vectors at all times}"""
    found = {}
    for field in bag.messages(FIELD):
        if steps.NAMES.get(field.kind) in STEPS:
            found.setdefault(steps.name(field), []).append(field)
    return found


def _fields(bag, name):
    return _by_step(bag).get(name, [])


def _reconstructed(bag, name):
    """Fields of its vectors that have L and P modes beside them: its vectors are its own."""
    return [field for field in _fields(bag, name) if field.pairs]


def _mean(quantity, times, number, published=None, remark='', **more):
    """Row of the mean of a number over snapshots. times: of each, what is averaged before the error
    is known."""
    means = [np.mean([number(one) for one in now]) for now in times]
    value = averages.of_snapshots(means) if means else UNKNOWN
    return Row(quantity, published, *value, remark=remark if means else '', **more)


def _weight(bag, quantity, letters, times, published=None):
    """Where none is published, no more than by chance."""
    chance = projection.chance(bag.info, times[0][0], letters) if times else None
    remark = f'{len(times)} snapshots; by chance {chance:.4f}' if times else ''
    left_open = chance if published == 0 else None

    def weight(field):
        return projection.weight(bag.info, field, letters)

    return _mean(quantity, times, weight, published, remark, left_open=left_open)


def inside(bag):
    for letters, names in STEPS.items():
        for name in names:
            times = [[one] for one in _fields(bag, name)]
            yield _weight(bag, f'weight of {name} in its {letters} fields', letters, times)


def divergence(bag):
    for name in STEPS['T']:
        times = [[one] for one in _fields(bag, name)]
        yield _weight(bag, f'weight of {name} in the L fields', 'L', times, published=0.0)


def rotation(bag):
    for name in STEPS['LP']:
        times = [
            [Mode(field, bag.info, 'L', pair) for pair in range(field.pairs)]
            for field in _reconstructed(bag, name)
        ]
        quantity = f'weight of the L modes of {name} in the T fields'
        yield _weight(bag, quantity, 'T', times, published=0.0)


def rotated(bag):
    for name in STEPS['LP']:
        fields, remark = _reconstructed(bag, name), ''
        if fields:
            left = [np.mean([getattr(one, f'residual_{of}') for one in fields]) for of in 'lp']
            about = 'distance of the fields from the vectors: L {:.3f}, P {:.3f}'.format(*left)
            remark = f'{len(fields)} snapshots; {about}'
        quantity, times = f'largest deviation of a singular value of Q from 1, {name}', zip(fields)
        yield _mean(quantity, times, lambda one: one.rotation_distance, remark=remark)


def pictures(bag):
    """Of each wave vector a T vector, and an L mode beside the P mode of the same modulation."""
    run, panels = bag.recording, []
    for nx, ny in NODES:
        panels += modes.named(run, [f'T({nx},{ny})'])
        for panel in modes.named(run, [f'LP({nx},{ny})']):
            letters = 'LP' if panel.field.pairs else ''
            panels += [Mode(panel.field, run.info, one, 0) for one in letters]
    if not panels:
        return None
    page = Page()
    modes.draw_panels(page, panels, run.info)
    what = r'$\delta q$ of T; L and P modes, from all vectors of LP'
    page.figure.suptitle(f'{scene(run.info)}, $t={panels[0].field.sim_time:g}$: {what}', fontsize=9)
    return page.figure


def patterns(bag):
    """Picture of both components over the box, and the lines on which what lies in the T fields
    vanishes."""
    panel, info = next(iter(modes.named(bag.recording, [PATTERN])), None), bag.info
    if panel is None:
        return None
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


# ---- P mode --------------------------------------------------------------------------------------


class Snapshot:
    """Both quotients of one pair of LP(1,0) at one time."""

    def __init__(self, field, pair, info):
        mode = p_mode.PMode(field, pair, info)
        self.before = [mode.fit(axis, divided=False) for axis in (0, 1)]
        self.after = [mode.fit(axis) for axis in (0, 1)]
        self.residual = field.residual_p[pair]
        # of the P field, what the measured vectors span: least squares shrinks it to that
        self.spanned = 1 - self.residual**2

    @property
    def ratio(self):
        """(value, standard error)"""
        return averages.quotient(*((fit.amplitude, fit.error) for fit in self.after))


@once
def _snapshots(bag):
    """Of the pairs at each time."""
    return [
        [Snapshot(field, pair, bag.info) for pair in range(field.pairs)]
        for field in _reconstructed(bag, P_MODE)
    ]


def _of_times(bag, quantity, number, published=None):
    times = _snapshots(bag)
    pairs = len(times[0]) if times else 0
    remark = f'mean over {len(times)} snapshots, {pairs} pairs each; error from their scatter'
    return _mean(quantity, times, number, published, remark)


def ratio(bag):
    yield _of_times(bag, 'ratio of the amplitudes on A', lambda one: one.ratio[0], 1.0)


def smooth(bag):
    for at, name in enumerate('xy'):
        quantity = f'scatter about A, phi_P,{name} / p_{name} over phi_P,{name}'
        yield _of_times(bag, quantity, lambda one: one.after[at].scatter / one.before[at].scatter)


def amplitudes(bag):
    """Single amplitudes are no test of the paper's 1: by least squares both axes are 1 together."""
    shown = _shown(bag)
    for at, name in enumerate('xy'):
        row = Row(f'amplitude of phi_P,{name} / p_{name} on A / (1 - residual^2)')
        if shown is not None:
            fit = shown.after[at]
            row.measured, row.error = fit.amplitude / shown.spanned, fit.error / shown.spanned
            about = f'amplitude {fit.amplitude:.3f}, residual {shown.residual:.3f}'
            row.remark = f'of the figure: {about}'
        yield row
    both = shown.ratio if shown else UNKNOWN
    yield Row('ratio of these amplitudes', None, *both, remark='of the figure alone')
    for at, name in enumerate('xy'):
        quantity = f'amplitude along {name} / (1 - residual^2), mean'
        yield _of_times(bag, quantity, lambda one: one.after[at].amplitude / one.spanned)
    yield _of_times(bag, 'distance of the P field from the vectors', lambda one: one.residual)
    for at, name in enumerate('xy'):
        quantity = f'scatter of phi_P,{name} about A / its rms'
        yield _of_times(bag, quantity, lambda one: one.before[at].scatter)
        yield _of_times(
            bag, f'the same of phi_P,{name} / p_{name}', lambda one: one.after[at].scatter
        )


def _shown(bag):
    """What the figure shows; None without it."""
    field = p_mode.chosen(bag.recording)
    if field is None or steps.name(field) != P_MODE:
        return None
    return Snapshot(field, p_mode.clearest(field), bag.info)


def picture_of_p(bag):
    return p_mode.draw(bag.recording).figure if _shown(bag) is not None else None
