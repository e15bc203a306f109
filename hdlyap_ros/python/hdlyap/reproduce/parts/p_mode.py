"""Part 5: the P mode of LP(1,0), before and after division by the momenta."""

import numpy as np

from hdlyap.data import reader
from hdlyap.plots import steps
from hdlyap.plots.figures import p_mode

from .. import averages
from ..row import BELOW, EQUAL, PAPER, Claim, Row

TITLE = 'P mode of LP(1,0), divided by the momenta'
STEP = 'LP(1,0)'
SMOOTHER = 0.8
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


def runs(plan):
    return ['periodic']


def claims(bags):
    shown, times = _shown(bags['periodic']), _times(bags['periodic'])
    yield Claim(
        'phi_P,x / p_x and phi_P,y / p_y are one function A',
        [_mean(times, 'ratio of the amplitudes on A', lambda one: one.ratio[0], 1.0)],
        'a ratio of 1',
        PAPER,
    )
    yield Claim(
        'phi_P is not smooth, divided by the momenta it is',
        [
            _mean(
                times,
                f'scatter about A, phi_P,{name} / p_{name} over phi_P,{name}',
                lambda one, axis=axis: one.after[axis].scatter / one.before[axis].scatter,
                SMOOTHER,
                BELOW,
            )
            for axis, name in enumerate('xy')
        ],
        f'the division takes the scatter about A (over its rms) to less than {SMOOTHER:g} of it',
    )
    # single amplitudes are no test of the paper's 1: by least squares both axes are 1 together
    yield Claim('amplitudes, scatter', list(_beside(shown, times)))


def _beside(shown, times):
    for axis, name in enumerate('xy'):
        yield _amplitude(shown, axis, name)
    ratio = shown.ratio if shown else (None, 0.0)
    yield Row('ratio of these amplitudes', None, *ratio, remark='of the figure alone')
    for axis, name in enumerate('xy'):
        yield _mean(
            times,
            f'amplitude along {name} / (1 - residual^2), mean',
            lambda one, axis=axis: one.after[axis].amplitude / one.spanned,
        )
    yield _mean(times, 'distance of the P field from the vectors', lambda one: one.residual)
    for axis, name in enumerate('xy'):
        yield _mean(
            times,
            f'scatter of phi_P,{name} about A / its rms',
            lambda one, axis=axis: one.before[axis].scatter,
        )
        yield _mean(
            times,
            f'the same of phi_P,{name} / p_{name}',
            lambda one, axis=axis: one.after[axis].scatter,
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
        for field in bag.messages(reader.FIELD)
        if field.pairs and (steps.NAMES[field.kind], field.nx, field.ny) == ('LP', 1, 0)
    ]


def _mean(times, quantity, number, published=None, sense=EQUAL):
    if not times:
        return Row(quantity, published, sense=sense)
    mean, error = averages.of_snapshots(
        [np.mean([number(one) for one in pairs]) for pairs in times]
    )
    return Row(
        quantity,
        published,
        float(mean),
        float(error),
        remark=SNAPSHOTS.format(len(times), len(times[0])),
        sense=sense,
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
