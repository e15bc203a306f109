"""Whether anything depends on the time between orthonormalisations. Bags: one trajectory replayed
with several, the shortest first, which tests rounding alone; independent runs with a short one;
with a long one."""

import math

import matplotlib.pyplot as plt
import numpy as np

from hdlyap.data import reader, steps
from hdlyap.msg import RunStatus
from hdlyap.plots.figures.style import GREY, MEMBER_COLOURS, scene

from .. import averages
from ..bags import once
from ..row import Row

ROUNDING = 1e-17  # drawn for what agrees in every bit
SAME = 1e-9  # relative: averaged times that are one
NUMBERS = ('lambda_1', 'h_KS', 'T(1,0)', 'T(0,1)')  # compared between independent runs
TAKEN_BACK = 0.9  # of what was asked: the conditioning did not allow more
AT_LONG = (
    'with intervals of 8 Householder factorisations read 2.36 instead of 0.61 '
    'for lambda_1557 of 780 disks, without any error; '
    'here the conditioning shortens them (doc/performance.md)'
)
UNIT = '1/time unit'


class Trial:
    """One run. longest, mean: intervals in use; None if not known."""

    def __init__(self, bag):
        self.recording, self.info, self.asked = bag.recording, bag.info, f'{bag.info.interval:g}'
        # exponents by averaged time: they end at the last orthonormalisation
        self.spectra = {
            message.averaged_time: np.array(message.exponents)
            for message in bag.messages(reader.SPECTRUM)
            if message.averaged_time > 0
        }
        began = self.recording.began.get(RunStatus.AVERAGING, math.inf)
        costs = [message for message in bag.messages(reader.COST) if message.sim_time >= began]
        self.longest = max((message.interval for message in costs), default=None)
        number = costs[-1].orthonormalisations - costs[0].orthonormalisations if costs else 0
        self.mean = (costs[-1].sim_time - costs[0].sim_time) / number if number else None
        self.indices = {one.name: one.indices for one in steps.blocks(self.recording.steps)}
        self.is_taken_back = self.longest and self.longest < TAKEN_BACK * self.info.interval

    @property
    def in_use(self):
        """What was asked, with the longest interval in use if the conditioning took it back."""
        more = f' (longest in use {self.longest:.2f})' if self.is_taken_back else ''
        return self.asked + more

    def values(self):
        """{name: (value, standard error)} of what independent runs are compared by."""
        spectrum, found = self.recording.spectrum, steps.resolved(self.recording.steps)
        known = {
            one: (found[one].exponent, found[one].std_error) for one in NUMBERS if one in found
        }
        if spectrum is not None and len(spectrum.exponents):
            known['lambda_1'] = spectrum.exponents[0], spectrum.std_errors[0]
            known['h_KS'] = spectrum.ks_entropy, spectrum.ks_entropy_error
        return {name: pair for name, pair in known.items() if pair[1] > 0}

    def exponents_at(self, time):
        mine = (one for one in self.spectra if abs(one - time) <= SAME * time)
        return self.spectra.get(next(mine, None))


@once
def _trial(bag):
    return Trial(bag)


# ---- independent runs ----------------------------------------------------------------------------


def independent(bags):
    """A row of each number: its mean over the runs with the longest interval over that with the
    shortest, less 1."""
    short, long = ([_trial(bag) for bag in some] for some in bags[1:])
    for name in NUMBERS:
        row = Row(f'{name}: mean of longer over shorter intervals, less 1', 0.0, unit='%')
        means = [_mean_of(name, group) for group in (long, short)]
        if None not in means:
            ratio, error = averages.quotient(*means)
            row.measured, row.error = 100 * (ratio - 1), 100 * error
            row.remark = f'{_named(long)} over {_named(short)}'
        yield row


def _mean_of(name, trials):
    """(mean, its standard error) over the runs that know it: of their own errors, or of their
    scatter where that is larger; None of fewer than two."""
    known = [values[name] for values in (trial.values() for trial in trials) if name in values]
    if len(known) < 2:
        return None
    values, errors = np.array(known).T
    mean, scatter = averages.of_snapshots(values)
    return float(mean), float(max(scatter, np.linalg.norm(errors) / len(errors)))


def _named(trials):
    longest = max(trials, key=lambda trial: trial.longest or 0.0)
    return f'{len(trials)} runs of interval {longest.in_use}'


# ---- one trajectory ------------------------------------------------------------------------------


def _replayed(bags):
    """(trials, the latest time up to which every one has averaged, of each the deviations of its
    exponents from those of the first); None without one: exponents of different times differ by
    what has grown in between."""
    trials = [_trial(bag) for bag in bags[0]]
    found = {time: [one.exponents_at(time) for one in trials] for time in trials[0].spectra}
    common = {time: every for time, every in found.items() if all(one is not None for one in every)}
    time = max(common, default=None)
    every = common.get(time, [None])
    return trials, time, [None if one is None else np.abs(one - every[0]) for one in every]


def replayed(bags):
    trials, time, deviations = _replayed(bags)
    for trial, off in zip(trials[1:], deviations[1:] if time else len(trials) * [None]):
        quantity = f'largest deviation, interval {trial.in_use} from {trials[0].asked}'
        # each of the two may be off by what was asked for
        row = Row(quantity, 0.0, unit=UNIT, left_open=2 * trial.info.accuracy)
        if off is not None:
            row.measured, at = float(off.max()), 1 + int(off.argmax())
            row.remark = f'index {at} of {len(off)}, averaged over {time:g}'
            row.remark += f'; {AT_LONG}' if trial.is_taken_back else ''
        yield row
    yield from (_indices(trials[0], trial) for trial in trials[1:])


def _indices(first, trial):
    """The indices of the steps that both runs found: one on the edge of being resolved may be found
    in one of them, as they look at their vectors at other times."""
    quantity = f'indices of all steps, interval {trial.in_use} and {first.asked}'
    both = sorted(set(first.indices) & set(trial.indices))
    alone = sorted(set(first.indices) ^ set(trial.indices))
    if not both:
        return Row(quantity, 'the same')
    other = [name for name in both if first.indices[name] != trial.indices[name]]
    remark = [f'{len(both)} sets']
    remark += [f'differ: {" ".join(other)}'] if other else []
    remark += [f'found in one run alone: {" ".join(alone)}'] if alone else []
    measured = f'{len(other)} differ' if other else 'the same'
    return Row(quantity, 'the same', measured, remark='; '.join(remark))


def longest(bags):
    for one in map(_trial, bags[0]):
        remark = f'mean {one.mean:.3g}' if one.mean else ''
        yield Row(f'asked {one.asked}', None, one.longest, 0.0, 'time unit', remark)


def picture(bags):
    trials, time, deviations = _replayed(bags)
    if time is None:
        return None
    figure, axes = plt.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    for trial, off, colour in zip(trials[1:], deviations[1:], MEMBER_COLOURS):
        label = f'{trial.asked}, {trial.longest:.2f}' if trial.longest else trial.asked
        style = {'color': colour, 'markersize': 2.5, 'rasterized': True, 'label': label}
        axes.semilogy(np.arange(1, len(off) + 1), np.maximum(off, ROUNDING), '.', **style)
    info = trials[0].info
    axes.axhline(
        info.accuracy, color=GREY, linewidth=0.8, linestyle=':', label='accuracy asked for'
    )
    axes.set_ylim(top=30 * info.accuracy)
    label = rf'$|\lambda_\ell - \lambda_\ell$(interval {trials[0].asked})$|$  [1/time unit]'
    axes.set(xlabel=r'index $\ell$', ylabel=label)
    below = {'loc': 'upper center', 'bbox_to_anchor': (0.5, -0.16), 'ncol': 2, 'markerscale': 3}
    axes.legend(title='interval asked, longest in use', **below)
    figure.suptitle(f'{scene(info)}, averaged over {time:g} time units', fontsize=9)
    return figure
