"""Part 5: the P mode of LP(1,0), before and after division by the momenta."""

import numpy as np

from hdlyap.data import reader, steps
from hdlyap.plots.figures import p_mode

from .. import averages
from ..bags import once
from ..files import cells
from ..row import Row

RUN = 'periodic'
STEP = 'LP(1,0)'
SNAPSHOTS = 'mean over {} snapshots, {} pairs each; error from their scatter'


class Snapshot:
    """Both quotients of one pair at one time."""

    def __init__(self, field, pair, info):
        mode = p_mode.PMode(field, pair, info)
        self.before = [mode.fit(axis, divided=False) for axis in (0, 1)]
        self.after = [mode.fit(axis) for axis in (0, 1)]
        # of the P field, what the measured vectors of the step span: least squares shrinks it to
        # that
        self.spanned = 1 - field.residual_p[pair] ** 2
        self.residual = field.residual_p[pair]

    @property
    def ratio(self):
        """(value, standard error)"""
        return averages.quotient(*((fit.amplitude, fit.error) for fit in self.after))


@once
def _times(bag):
    """(time, the Snapshots of its pairs) of each."""
    info = bag.recording.info
    return [
        (field.sim_time, [Snapshot(field, pair, info) for pair in range(field.pairs)])
        for field in bag.messages(reader.FIELD)
        if field.pairs and (steps.NAMES[field.kind], field.nx, field.ny) == ('LP', 1, 0)
    ]


def _shown(bag):
    """What the figure shows; None without it."""
    field = p_mode.chosen(bag.recording)
    if field is None or steps.name(field) != STEP:
        return None
    return Snapshot(field, p_mode.clearest(field), bag.recording.info)


def ratio(bags):
    yield _mean(bags, 'ratio of the amplitudes on A', lambda one: one.ratio[0], 1.0)


def smooth(bags):
    for axis, name in enumerate('xy'):
        quantity = f'scatter about A, phi_P,{name} / p_{name} over phi_P,{name}'
        yield _mean(bags, quantity, _scatter_over, axis=axis)


def _scatter_over(one, axis):
    return one.after[axis].scatter / one.before[axis].scatter


def amplitudes(bags):
    """Single amplitudes are no test of the paper's 1: by least squares both axes are 1 together."""
    shown = _shown(bags[RUN])
    for axis, name in enumerate('xy'):
        row = Row(f'amplitude of phi_P,{name} / p_{name} on A / (1 - residual^2)')
        if shown is not None:
            fit = shown.after[axis]
            row.measured, row.error = fit.amplitude / shown.spanned, fit.error / shown.spanned
            at = f'amplitude {fit.amplitude:.3f}, residual {shown.residual:.3f}'
            row.remark = f'of the figure: {at}'
        yield row
    both = shown.ratio if shown else (None, 0.0)
    yield Row('ratio of these amplitudes', None, *both, remark='of the figure alone')
    for axis, name in enumerate('xy'):
        quantity = f'amplitude along {name} / (1 - residual^2), mean'
        yield _mean(bags, quantity, lambda one, at=axis: one.after[at].amplitude / one.spanned)
    yield _mean(bags, 'distance of the P field from the vectors', lambda one: one.residual)
    for axis, name in enumerate('xy'):
        quantity = f'scatter of phi_P,{name} about A / its rms'
        yield _mean(bags, quantity, lambda one, at=axis: one.before[at].scatter)
        quantity = f'the same of phi_P,{name} / p_{name}'
        yield _mean(bags, quantity, lambda one, at=axis: one.after[at].scatter)


def _mean(bags, quantity, number, published=None, **which):
    times = _times(bags[RUN])
    if not times:
        return Row(quantity, published)
    means = [np.mean([number(one, **which) for one in pairs]) for _, pairs in times]
    mean, error = averages.of_snapshots(means)
    remark = SNAPSHOTS.format(len(times), len(times[0][1]))
    return Row(quantity, published, float(mean), float(error), remark=remark)


def figures(bags):
    if _shown(bags[RUN]) is not None:
        yield 'p_mode', p_mode.draw(bags[RUN].recording)


def tables(bags):
    names = 'amplitude', 'error', 'scatter_before', 'scatter_after'
    header = 'time', 'pair', 'residual', *(f'{name}_{axis}' for axis in 'xy' for name in names)
    yield 'amplitudes', header, [
        cells('g s .5g' + 8 * ' .5g', time, pair, one.residual, *_numbers(one))
        for time, pairs in _times(bags[RUN])
        for pair, one in enumerate(pairs)
    ]


def _numbers(one):
    for before, after in zip(one.before, one.after):
        yield from (after.amplitude, after.error, before.scatter, after.scatter)
