"""Part 14: the claim that nothing depends on the time between orthonormalisations: independent runs
with other intervals, and one trajectory replayed with them, which tests rounding alone."""

import math

import numpy as np

from hdlyap.msg import RunStatus
from hdlyap.data import reader, steps
from hdlyap.plots.figures.style import GREY, MEMBER_COLOURS, plt, scene

from .. import averages
from ..bags import once
from ..files import cells
from ..row import Row

ROUNDING = 1e-17  # drawn for what agrees in every bit
SAME = 1e-9  # relative: averaged times that are one
STEPS = ('T(1,0)', 'LP(1,0)')
NUMBERS = ('lambda_1', 'h_KS', 'T(1,0)', 'T(0,1)')  # compared between independent runs
REPLAYED, INDEPENDENT = 'interval_', 'independent_'  # names of runs
TAKEN_BACK = 0.9  # of what was asked: the conditioning did not allow more
AT_LONG = (
    'with intervals of 8 Householder factorisations read 2.36 instead of 0.61 '
    'for lambda_1557 of 780 disks, without any error; '
    'here the conditioning shortens them (doc/performance.md)'
)
UNIT = '1/time unit'


class Trial:
    """One run of them."""

    def __init__(self, bag):
        self.recording = bag.recording
        self.info, self.steps = self.recording.info, self.recording.steps
        self.asked = self.info.interval
        # exponents by averaged time: they end at the last orthonormalisation
        self.spectra = {
            message.averaged_time: np.array(message.exponents)
            for message in bag.messages(reader.SPECTRUM)
            if message.averaged_time > 0
        }
        began = self.recording.began.get(RunStatus.AVERAGING, math.inf)
        costs = [message for message in bag.messages(reader.COST) if message.sim_time >= began]
        self.longest = max((message.interval for message in costs), default=None)
        self.mean = _mean_interval(costs)
        self.bound = costs[-1].error_bound if costs else None
        self.indices = {block.name: block.indices for block in steps.blocks(self.steps)}
        self.found = steps.resolved(self.steps)

    @property
    def name(self):
        return f'{self.asked:g}'

    @property
    def in_use(self):
        """What was asked, with the longest interval in use if the conditioning took it back."""
        if not self.longest or self.longest >= TAKEN_BACK * self.asked:
            return self.name
        return f'{self.name} (longest in use {self.longest:.2f})'

    def values(self):
        """{name: (value, standard error)} of what independent runs are compared by."""
        spectrum = self.recording.spectrum
        known = {}
        if spectrum is not None and len(spectrum.exponents):
            known['lambda_1'] = spectrum.exponents[0], spectrum.std_errors[0]
            known['h_KS'] = spectrum.ks_entropy, spectrum.ks_entropy_error
        for name in NUMBERS:
            if name in self.found:
                known[name] = self.found[name].exponent, self.found[name].std_error
        return {name: pair for name, pair in known.items() if pair[1] > 0}

    def exponents_at(self, time):
        return next(
            (self.spectra[mine] for mine in self.spectra if abs(mine - time) <= SAME * time), None
        )


def _mean_interval(costs):
    """Simulated time between two orthonormalisations."""
    if len(costs) < 2 or costs[-1].orthonormalisations == costs[0].orthonormalisations:
        return None
    return (costs[-1].sim_time - costs[0].sim_time) / (
        costs[-1].orthonormalisations - costs[0].orthonormalisations
    )


class Trials:
    """All runs of one trajectory, the shortest interval first: the others are held against it."""

    def __init__(self, bags):
        trials = [_trial(bags[name]) for name in bags if name.startswith(REPLAYED)]
        self.first, *self.others = sorted(trials, key=lambda trial: trial.asked)
        self.time = self._common_time()

    def _common_time(self):
        """The latest time up to which every run has averaged; None without one. Exponents of
        different times differ by what has grown in between."""
        times = [
            time
            for time in self.first.spectra
            if all(trial.exponents_at(time) is not None for trial in self.others)
        ]
        return max(times, default=None)

    def deviations(self, trial):
        """Of all exponents from those of the shortest interval; None without a common time."""
        if self.time is None:
            return None
        return np.abs(trial.exponents_at(self.time) - self.first.exponents_at(self.time))


@once
def _trial(bag):
    return Trial(bag)


def replayed(bags):
    trials = Trials(bags)
    yield from (_deviation(trials, trial) for trial in trials.others)
    yield from (_indices(trials.first, trial) for trial in trials.others)


def longest(bags):
    trials = Trials(bags)
    for one in (trials.first, *trials.others):
        remark = f'mean {one.mean:.3g}' if one.mean else ''
        yield Row(f'asked {one.name}', None, one.longest, 0.0, 'time unit', remark)


# ---- independent runs ----------------------------------------------------------------------------


def independent(bags):
    """A row of each number: its mean over the runs with the longest interval over that with the
    shortest, less 1."""
    groups = {}
    for name in bags:
        if name.startswith(INDEPENDENT):
            trial = _trial(bags[name])
            groups.setdefault(trial.asked, []).append(trial)
    short, long = (groups[end(groups)] if groups else [] for end in (min, max))
    for name in NUMBERS:
        row = Row(f'{name}: mean of longer over shorter intervals, less 1', 0.0, unit='%')
        means = [_mean_of(name, group) for group in (short, long)]
        if None not in means:
            ratio, error = averages.quotient(*means[::-1])
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


def _deviation(trials, trial):
    deviations = trials.deviations(trial)
    quantity = f'largest deviation, interval {trial.in_use} from {trials.first.name}'
    row = Row(quantity, 0.0, unit=UNIT)
    row.left_open = 2 * trial.info.accuracy  # each of the two may be off by what was asked for
    if deviations is not None:
        row.measured, at = float(deviations.max()), 1 + int(deviations.argmax())
        row.remark = f'index {at} of {len(deviations)}, averaged over {trials.time:g}'
        if trial.longest and trial.longest < TAKEN_BACK * trial.asked:
            row.remark += '; ' + AT_LONG
    return row


def _indices(first, trial):
    """The indices of the steps that both runs found: one on the edge of being resolved may be found
    in one of them, as they look at their vectors at other times."""
    quantity = f'indices of all steps, interval {trial.in_use} and {first.name}'
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


def figures(bags):
    trials = Trials(bags)
    if trials.time is None:
        return
    figure, axes = plt.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    for trial, colour in zip(trials.others, MEMBER_COLOURS):
        deviations = np.maximum(trials.deviations(trial), ROUNDING)
        style = {'color': colour, 'markersize': 2.5, 'rasterized': True, 'label': _label(trial)}
        axes.semilogy(np.arange(1, len(deviations) + 1), deviations, '.', **style)
    asked = trials.first.info.accuracy
    axes.axhline(asked, color=GREY, linewidth=0.8, linestyle=':', label='accuracy asked for')
    axes.set_ylim(top=30 * asked)
    label = rf'$|\lambda_\ell - \lambda_\ell$(interval {trials.first.name})$|$  [1/time unit]'
    axes.set(xlabel=r'index $\ell$', ylabel=label)
    below = {'loc': 'upper center', 'bbox_to_anchor': (0.5, -0.16), 'ncol': 2, 'markerscale': 3}
    axes.legend(title='interval asked, longest in use', **below)
    long = f'averaged over {trials.time:g} time units'
    figure.suptitle(f'{scene(trials.first.info)}, {long}', fontsize=9)
    yield 'intervals', figure


def _label(trial):
    return f'{trial.name}, {trial.longest:.2f}' if trial.longest else trial.name


def tables(bags):
    trials = Trials(bags)
    every = trials.first, *trials.others
    in_use = 'interval', 'longest_in_use', 'mean_in_use', 'error_bound', 'lambda_max'
    of_steps = [f'{name}_{what}' for name in STEPS for what in ('exponent', 'multiplicity')]
    header = (*in_use, 'largest_deviation', *of_steps, 'c_T', 'c_L', 'v')
    yield 'runs', header, [_line(trials, trial) for trial in every]
    yield 'indices', ('interval', 'steps', 'indices'), [
        (trial.name, *one) for trial in every for one in trial.indices.items()
    ]
    if trials.time is not None:
        deviations = [trials.deviations(trial) for trial in trials.others]
        yield 'deviations', ('index', *(f'interval_{trial.name}' for trial in trials.others)), [
            (index, *(f'{value:.1e}' for value in values))
            for index, values in enumerate(zip(*deviations), start=1)
        ]


def _line(trials, trial):
    deviations, spectrum = trials.deviations(trial), trial.recording.spectrum
    largest = None if deviations is None else deviations.max()
    numbers = [trial.longest, trial.mean, trial.bound, spectrum and spectrum.lambda_max, largest]
    for name in STEPS:
        step = trial.found.get(name)
        numbers += [step and step.exponent, step and step.multiplicity]
    numbers += [getattr(trial.steps, name) if trial.steps else None for name in ('c_t', 'c_l', 'v')]
    return cells('s' + 12 * ' .10g', trial.name, *numbers)
