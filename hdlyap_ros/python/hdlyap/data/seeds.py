"""Runs of one system with several seeds -> means over them, with their errors."""

import warnings
from functools import cached_property

import numpy as np
import pandas

from hdlyap import topics

from . import joined, printed, space
from .frames import frame
from .reader import Missing, RecordingError
from .run import OF_ALL, Run
from .summary import Summary

# If no run states an error, the scatter of at least FEWEST runs, the longest at most RATIO times
# the shortest, is one: it is known as well as compare assumes (plots.deviation.FREEDOM).
FEWEST, RATIO = 8, 2.0


def load(*bags, node=None, run=None, form=None, k=None):
    """Reads bags. Returns a Run for one bag, or for bags that are parts of one run (split by
    rosbag, or resumed from a checkpoint), and Seeds for bags of several seeds. Other bags are
    refused. node, run: which one, if there are several in a bag; run counts from 1, and is the last
    one if not given. form, k: fits of another form ('c k', 'c k + c2 k^2') than the node's, if k is
    given only over wave numbers from k[0] to k[1]."""
    found = [Run(*of_one, form, k) for of_one in joined.runs(bags, node, run)]
    return found[0] if len(found) == 1 else Seeds(found)


def one(*bags, node=None, run=None):
    """Reads bags of one run. Returns a Run; raises RecordingError if they are several runs."""
    found = load(*bags, node=node, run=run)
    if found.is_mean:
        seeds = ', '.join(run.info.seed for run in found.every)
        raise RecordingError(f'{found.every[0].name} ...: of several runs, with the seeds {seeds}')
    return found


class Seeds:
    """Independent `runs` of one system. The frames `spectrum`, `steps`, `results`, `gas` and
    `averages` have means over them, weighted with the averaged times, and two errors: `std_error`
    follows from the errors that the runs state, `scatter` from the differences between runs (from n
    runs it is known to 1 / sqrt(2 n - 2)). `chi2` has `runs` - 1 degrees of freedom; if it is
    far above that, the runs differ by more than their errors allow. A run that is too short to know
    any of its errors is in no mean: `left_out` names it."""

    is_mean, runs_in_bag = True, 1
    summary = cached_property(Summary)

    def __init__(self, runs):
        self.every = runs  # with runs that are left out
        self.paths = [path for run in runs for path in run.paths]

    @property
    def runs(self):
        return self._split[0]

    @property
    def left_out(self):
        return self._split[1]

    @property
    def info(self):
        return self.runs[0].info

    @property
    def seeds(self):
        return [run.info.seed for run in self.runs]

    @cached_property
    def _split(self):
        """The runs that know an error, or all if none does, and a line for each of the others."""
        taken = [run for run in self.every if _knows_errors(run)] or self.every
        lines = [
            f'{", ".join(run.paths)}, seed {run.info.seed}, is left out: averaged over '
            f'{_measured(run)[1]:.3g}, too short to know its errors'
            for run in self.every
            if run not in taken
        ]
        for line in lines:
            warnings.warn(line)  # commands print them
        return taken, lines

    def __repr__(self):
        what = space.particle(self.info)
        return f'<hdlyap runs of {self.info.number} {what}s, seeds {", ".join(self.seeds)}>'

    def __getattr__(self, name):
        if not name.startswith('_') and (hasattr(Run, name) or name in topics.MEASURED):
            raise AttributeError(
                f'{name} belongs to one run, but these are {len(self.runs)}: use runs[0].{name}'
            )
        raise AttributeError(name)

    @property
    def averaged_time(self):
        """The sum over all runs."""
        return float(self._weights.sum())

    @cached_property
    def _weights(self):
        return np.array([run.averaged_times[-1] for run in self.runs])

    @cached_property
    def spectrum(self):
        frames = [run.spectrum for run in self.runs]
        if len({(one.index[0], len(one)) for one in frames}) > 1:
            raise RecordingError('the runs do not have the same exponents')
        return self._mean(frames, 'exponent')

    @cached_property
    def steps(self):
        """The columns of a run, and those of means. A step is resolved if it is so in at least one
        run. exponent and multiplicity are means over these runs; all else comes from the first of
        them. `scatter` is that between runs, here too."""
        frames = [run.steps for run in self.runs]
        found = [one[one['resolved']] for one in frames]
        about = pandas.concat([*found, frames[0]])
        about = about[~about.index.duplicated()].loc[frames[0].index]
        made = self._mean(found, 'exponent', index=about.index)
        multiplicity = self._mean(found, 'multiplicity', index=about.index)['multiplicity']
        columns = {**about, 'multiplicity': multiplicity, **made}
        units = {**frames[0].attrs['units'], **made.attrs['units']}
        return frame(columns, units, made.index)

    @cached_property
    def results(self):
        """lambda_max, the sum of the positive exponents, and those fits to steps that have the same
        form and wave numbers in all runs. The error of the form of a fit is the same for all seeds,
        so it is in both errors in full."""
        frames = [run.results for run in self.runs]
        fits = [fit for fit in self.runs[0].fits if self._is_in_all(fit)]
        of_fits = [name for fit in fits for name, _, _ in fit.values]
        names = [*self._sums, *of_fits]
        frames = [one.loc[names] for one in frames]
        sampled = [one.assign(std_error=_of_sampling(one)) for one in frames]
        made = self._mean(sampled, 'value')
        of_form = np.max([_beyond(one) for one in frames], axis=0)
        made['sampling_error'] = np.fmax(made['std_error'], made['scatter'])
        for name in ('std_error', 'scatter'):
            made[name] = np.hypot(made[name], of_form)
        # the misfit of all runs: chi^2 of all over the degrees of freedom of all
        made['misfit'] = np.sqrt(np.mean([one['misfit'] ** 2 for one in frames], axis=0))
        return made.join(frames[0][['unit', 'basis']])

    @property
    def _sums(self):
        """The names of results in front of those of fits. Of few exponents the Kaplan-Yorke
        dimension may be known of some runs alone: it has no mean."""
        fitted = {name for run in self.runs for fit in run.fits for name, *_ in fit.values}
        in_all = set.intersection(*(set(run.results.index) for run in self.runs))
        return [name for name in self.runs[0].results.index if name in in_all - fitted]

    @cached_property
    def gas(self):
        """Collision rate, or temperature and potential energy, and pressure."""
        return self._mean_of('gas')

    @cached_property
    def averages(self):
        """What the particles of a program's own tell."""
        return self._mean_of('averages')

    def _mean_of(self, topic):
        frames = [getattr(run, topic) for run in self.runs]
        weights = np.array([run.last(topic).averaged_time for run in self.runs])
        return self._mean(frames, 'value', weights).join(frames[0][['unit']])

    def table(self):
        """Results with their errors as texts, 0.4299(28), and units; see data.printed."""
        return printed.of(self)

    def scatter_of_few(self, frame, row):
        """(the error of the mean of a row of `frame` from the differences between runs, its degrees
        of freedom), of however few runs, none of which states an error; NaN and 1 of one run, or of
        runs that are not alike."""
        found = [(getattr(run, frame), run.averaged_times[-1]) for run in self.runs]
        found = [(one.loc[row], weight) for one, weight in found if row in one.index]
        found = [(one.get('value', one.get('exponent')), weight) for one, weight in found]
        found = [(value, weight) for value, weight in found if np.isfinite(value)]
        values = [[value] for value, _ in found]
        weights, unknown = [weight for _, weight in found], np.full((len(found), 1), np.nan)
        scatter = mean(np.array(values, dtype=float), unknown, weights, fewest=2)[2]
        return float(scatter[0]), max(1, len(values) - 1)

    # ---- as messages of one run, which figures and comparison take ----------------------------

    def has(self, topic):
        return topic in self._fills and all(run.has(topic) for run in self.runs)

    @property
    def without_mean(self):
        """The topics of which a run has messages, and that have no mean."""
        found = [topic for topic in topics.MEASURED if any(run.has(topic) for run in self.runs)]
        return [topic for topic in found if not self.has(topic)]

    def last(self, topic, numpy=None):
        """A message of 'spectrum', 'steps', 'gas' or 'averages', with lists: the means, and the
        larger one of the two errors."""
        message = self.runs[0].last(topic, numpy)
        message.run_id = ''
        message.averaged_time = sum(run.last(topic).averaged_time for run in self.runs)
        self._fills[topic](message)
        return message

    @property
    def _fills(self):
        fills = self._fill_spectrum, self._fill_steps, self._fill_gas, self._fill_averages
        return dict(zip(('spectrum', 'steps', 'gas', 'averages'), fills))

    def _fill_averages(self, message):
        for one in message.averages:
            error = errors(self.averages.loc[one.name])
            one.value = self.averages.loc[one.name, 'value']
            one.std_error = error if np.isfinite(error) else -1.0

    def _fill_gas(self, message):
        for name, error in errors(self.gas).items():
            setattr(message, name, self.gas.loc[name, 'value'])
            setattr(message, name + '_error', error if np.isfinite(error) else -1.0)

    def _fill_spectrum(self, message):
        message.collisions = sum(run.last('spectrum').collisions for run in self.runs)
        message.exponents = self.spectrum['exponent'].tolist()
        message.std_errors = errors(self.spectrum).tolist()
        message.lambda_max, message.ks_entropy = self.results['value'].iloc[:2].tolist()
        message.ks_entropy_error = float(errors(self.results).iloc[1])
        message.pairing_error = message.divergence_error = -1.0
        message.divergence = np.nan
        for name in OF_ALL:
            there = name in self.results.index
            setattr(message, name, self.results.loc[name, 'value'] if there else np.nan)
            error = float(errors(self.results.loc[[name]]).iloc[0]) if there else -1.0
            setattr(message, name + '_error', error)

    def _fill_steps(self, message):
        """Fills steps from the first run in which each is resolved; multiplicities and exponents
        are means. A fit that has not the same form in all runs is left out."""
        found = {}
        for run in self.runs:
            for name, step in zip(run.steps.index, run.last('steps').steps):
                if step.resolved:
                    found.setdefault(name, step)
        names = self.runs[0].steps.index
        message.steps = [found.get(name, step) for name, step in zip(names, message.steps)]
        for name, step in found.items():
            mean = self.steps.loc[name]
            step.exponent, step.std_error = mean['exponent'], errors(mean)
            step.multiplicity = mean['multiplicity']
        for symbol, points in (('c_T', 't_points'), ('c_L', 'l_points'), ('v', 'v_phases')):
            if symbol not in self.results.index:
                setattr(message, points, 0)
        for name, error in errors(self.results).iloc[len(self._sums) :].items():
            field, row = name.lower(), self.results.loc[name]
            setattr(message, field, row['value'])
            setattr(message, field + '_error', error)
            if hasattr(message, field + '_sampling_error'):
                setattr(message, field + '_sampling_error', row['sampling_error'])
        for symbol, letter in (('c_T', 't'), ('c_L', 'l'), ('v', 'v')):
            misfit = self.results['misfit'].get(symbol, np.nan)
            setattr(message, f'{letter}_misfit', misfit if np.isfinite(misfit) else -1.0)

    def _is_in_all(self, fit):
        return all(any(fit.is_like(other) for other in run.fits) for run in self.runs)

    def _mean(self, frames, name, weights=None, index=None):
        """The mean of a column of frames, and its errors. weights: averaged times. index: the rows,
        some of which a frame may lack; if it is None, all frames have the same rows."""
        weights = self._weights if weights is None else weights
        index = frames[0].index if index is None else index
        there = np.array([index.isin(one.index) for one in frames])
        values, errors = (
            np.array([one[column].reindex(index) for one in frames], dtype=float)
            for column in (name, 'std_error')
        )
        columns = name, 'std_error', 'scatter', 'chi2', 'runs'
        made = dict(zip(columns, mean(values, errors, weights, there)))
        units = dict.fromkeys(columns[:3], '1/time unit' if name == 'exponent' else '')
        return frame(made, units, index)


def errors(frame):
    """The larger one of the two errors; the known one if the other is not known."""
    return np.fmax(frame['std_error'], frame['scatter'])


def _of_sampling(frame):
    """The errors of sampling; 0 if the form of a fit decides."""
    errors, sampling = frame['std_error'], frame['sampling_error']
    return sampling.where(sampling.notna() | errors.isna(), 0.0)


def _beyond(frame):
    """The part of errors that is not sampling; 0 if they are not known."""
    squares = frame['std_error'] ** 2 - _of_sampling(frame) ** 2
    return np.sqrt(np.fmax(np.nan_to_num(squares), 0.0))


def _measured(run):
    """A frame with errors, and its averaged time: of exponents or, if there are none, of gas, or of
    averages."""
    try:
        return run.spectrum, run.averaged_times[-1]
    except Missing:
        topic = 'gas' if run.has('gas') else 'averages'
        return getattr(run, topic), run.last(topic).averaged_time


def _knows_errors(run):
    try:
        return np.isfinite(_measured(run)[0]['std_error']).any()
    except Missing:
        return True


def mean(values, errors, weights, there=True, fewest=FEWEST):
    """(mean, its error from the stated errors, its error from the scatter, chi^2, number of runs)
    of each column, over the runs that have it and know its error. A run that is too short to know
    the error is left out: its value is further off than its weight says, and scatter with it is no
    good error: with two runs (Student's t with one degree of freedom) every eighth mean is beyond
    five errors. If no run knows the error, the mean is over all runs; it has an error only if there
    are `fewest` runs or more, within RATIO. Weights are not 1 / errors^2: an error from few blocks
    is uncertain, and values whose error is small by chance would count too much."""
    known = there & np.isfinite(errors)
    is_stated = known.any(axis=0)
    # a value that is not finite is not left out, so that the mean is not finite either
    used = np.where(is_stated, known | ~np.isfinite(values), True) & there
    weights = np.asarray(weights, dtype=float)[:, None] * used
    count, total = used.sum(axis=0), weights.sum(axis=0)
    alike = weights.max(axis=0) <= RATIO * np.where(used, weights, np.inf).min(axis=0)
    is_error = (count > 1) & (is_stated | (count >= fewest) & alike)
    with np.errstate(divide='ignore', invalid='ignore'):
        of_all = np.where(used, weights * values, 0.0).sum(axis=0) / total
        stated = np.sqrt(np.where(used, (weights * errors) ** 2, 0.0).sum(axis=0)) / total
        squares = np.where(used, values - of_all, 0.0) ** 2
        scatter = np.sqrt((weights * squares).sum(axis=0) / (total * (count - 1)))
        chi2 = np.where(used, squares / errors**2, 0.0).sum(axis=0)
    return of_all, stated, np.where(is_error, scatter, np.nan), chi2, count
