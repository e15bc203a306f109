"""Part 5: the P mode of LP(1,0), before and after division by the momenta."""

import numpy as np

from hdlyap.plots import recording, steps
from hdlyap.plots.figures import p_mode

from .. import averages
from ..row import Row

TITLE = 'P mode of LP(1,0), divided by the momenta'
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
        return self.after[0].amplitude / self.after[1].amplitude

    @property
    def ratio_error(self):
        return abs(self.ratio) * np.hypot(*(fit.error / fit.amplitude for fit in self.after))


def runs(plan):
    return ['periodic']


def rows(bags):
    shown = _shown(bags['periodic'])
    # single amplitudes are no test of the paper's 1: by least squares both axes are 1 together
    for axis, name in enumerate('xy'):
        yield _amplitude(shown, axis, name)
    yield Row(
        'ratio of these amplitudes',
        1.0,
        shown and shown.ratio,
        shown.ratio_error if shown else 0.0,
        remark='tells more than both: weighted with p^2 they are 1 together, by least squares',
    )
    times = _times(bags['periodic'])
    yield _mean(
        times,
        'amplitude along x / (1 - residual^2), mean',
        None,
        lambda one: one.after[0].amplitude / one.spanned,
    )
    yield _mean(
        times,
        'amplitude along y / (1 - residual^2), mean',
        None,
        lambda one: one.after[1].amplitude / one.spanned,
    )
    yield _mean(times, 'ratio of the amplitudes, mean', 1.0, lambda one: one.ratio)
    yield _mean(
        times, 'distance of the P field from the vectors, residual', None, lambda one: one.residual
    )
    for axis, name in enumerate('xy'):
        yield _mean(
            times,
            f'scatter of phi_P,{name} about A / its rms',
            None,
            lambda one: one.before[axis].scatter,
        )
        yield _mean(
            times, f'the same of phi_P,{name} / p_{name}', None, lambda one: one.after[axis].scatter
        )


def _shown(bag):
    """What the figure shows; None without it."""
    field = p_mode.chosen(bag.recording)
    if field is None or steps.name(field) != STEP:
        return None
    return Snapshot(field, p_mode.clearest(field), bag.recording.info)


def _amplitude(shown, axis, name):
    quantity = f'amplitude of phi_P,{name} / p_{name} on A / (1 - residual^2)'
    if shown is None:
        return Row(quantity)
    fit = shown.after[axis]
    return Row(
        quantity,
        None,
        fit.amplitude / shown.spanned,
        fit.error / shown.spanned,
        remark=f'of the figure: amplitude {fit.amplitude:.3f}, residual {shown.residual:.3f}',
    )


def _times(bag):
    """Of each time, the Snapshots of its pairs."""
    info = bag.recording.info
    return [[Snapshot(field, pair, info) for pair in range(field.pairs)] for field in _fields(bag)]


def _fields(bag):
    return [
        field
        for field in bag.messages(recording.FIELD)
        if field.pairs and (steps.NAMES[field.kind], field.nx, field.ny) == ('LP', 1, 0)
    ]


def _mean(times, quantity, published, number):
    if not times:
        return Row(quantity, published)
    mean, error = averages.of_snapshots(
        [np.mean([number(one) for one in pairs]) for pairs in times]
    )
    return Row(
        quantity,
        published,
        float(mean),
        float(error),
        remark=SNAPSHOTS.format(len(times), len(times[0])),
    )


def figures(bags):
    if _shown(bags['periodic']) is not None:
        yield 'p_mode', p_mode.draw(bags['periodic'].recording)


def tables(bags):
    lines = []
    for field, pairs in zip(_fields(bags['periodic']), _times(bags['periodic'])):
        for pair, one in enumerate(pairs):
            numbers = [one.residual] + [
                number
                for axis in (0, 1)
                for number in (
                    one.after[axis].amplitude,
                    one.after[axis].error,
                    one.before[axis].scatter,
                    one.after[axis].scatter,
                )
            ]
            lines.append((f'{field.sim_time:g}', pair, *(f'{number:.5g}' for number in numbers)))
    yield 'amplitudes', (
        'time',
        'pair',
        'residual',
        *(
            f'{name}_{axis}'
            for axis in 'xy'
            for name in ('amplitude', 'error', 'scatter_before', 'scatter_after')
        ),
    ), lines
