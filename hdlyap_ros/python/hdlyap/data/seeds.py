"""Runs of one system with several seeds -> means over them, with their errors."""

from functools import cached_property

import numpy as np
import pandas

from . import joined, tables
from .reader import RecordingError
from .run import Run


def load(*bags, node=None, run=None):
    """A Run of one bag, or of bags that are parts of one run (split by rosbag, or resumed from a
    checkpoint); Seeds of bags of several seeds. Others are refused. node, run: which, if there are
    several in a bag; run counts from 1, without it the last one is taken."""
    found = joined.runs(bags, node, run)
    return Run(found[0]) if len(found) == 1 else Seeds([Run(one) for one in found])


class Seeds:
    """`runs` of the same system, which are independent. The frames `spectrum`, `steps`, `results`
    and `gas` have means over them, weighted with the averaged times, and two errors: `std_error`
    from the errors that the runs state, `scatter` from how far the runs are apart (of n runs it is
    itself known to 1 / sqrt(2 n - 2)). `chi2` is of `runs` - 1 degrees of freedom; far above that
    the runs are further apart than their errors allow."""

    def __init__(self, runs):
        self.runs, self.info = runs, runs[0].info
        self.paths = [path for run in runs for path in run.paths]
        self.seeds = [run.info.seed for run in runs]

    def __repr__(self):
        return f'<hdlyap runs of {self.info.disks} disks, seeds {", ".join(self.seeds)}>'

    def __getattr__(self, name):
        if not name.startswith('_') and hasattr(Run, name):
            raise AttributeError(
                f'{name} is of one run, these are {len(self.runs)}: runs[0].{name}'
            )
        raise AttributeError(name)

    @property
    def averaged_time(self):
        """Of all together."""
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
        """Those that are resolved in at least one run; means over the runs in which they are."""
        frames = [run.steps[run.steps['resolved']] for run in self.runs]
        names = list(dict.fromkeys(name for one in frames for name in one.index))
        about = pandas.concat(frames)
        about = about[~about.index.duplicated()].loc[names, ['kind', 'nx', 'ny', 'wave_number']]
        frames = [one.reindex(names) for one in frames]
        made = self._mean(frames, 'exponent')
        multiplicity = self._mean(frames, 'multiplicity')['multiplicity']
        columns = {**about, 'multiplicity': multiplicity, **made}
        return tables.frame(columns, {'wave_number': '1/sigma', **made.attrs['units']}, made.index)

    @cached_property
    def results(self):
        """lambda_max, the sum of the positive exponents, and of the fits over steps those that
        are of one form over the same wave numbers in all runs."""
        frames = [run.results for run in self.runs]
        fits = [fit for fit in self.runs[0].fits if self._is_in_all(fit)]
        names = [*frames[0].index[:2], *(name for fit in fits for name, _, _ in fit.values)]
        made = self._mean([one.loc[names] for one in frames], 'value')
        return made.join(frames[0][['unit', 'basis']])

    @cached_property
    def gas(self):
        """Collision rate and pressure."""
        frames = [run.gas for run in self.runs]
        weights = np.array([run.last('gas').averaged_time for run in self.runs])
        return self._mean(frames, 'value', weights).join(frames[0][['unit']])

    def _is_in_all(self, fit):
        return all(any(fit.is_like(other) for other in run.fits) for run in self.runs)

    def _mean(self, frames, name, weights=None):
        """Of a column of frames with the same rows, beside its errors; weights: averaged times."""
        weights = self._weights if weights is None else weights
        values, errors = (
            np.array([one[column] for one in frames], dtype=float) for column in (name, 'std_error')
        )
        columns = name, 'std_error', 'scatter', 'chi2', 'runs'
        made = dict(zip(columns, mean(values, errors, weights)))
        units = dict.fromkeys(columns[:3], '1/time unit' if name == 'exponent' else '')
        return tables.frame(made, units, frames[0].index)


def mean(values, errors, weights):
    """(mean, its error from those stated, its error from the scatter, chi^2, number) over the rows
    in which a value is known. The weights are not 1 / errors^2: an error of few blocks is itself
    uncertain, and by chance small ones would count too much."""
    there = np.isfinite(values)
    weights = np.where(there, np.asarray(weights, dtype=float)[:, None], 0.0)
    count, total = there.sum(axis=0), weights.sum(axis=0)
    with np.errstate(divide='ignore', invalid='ignore'):
        of_all = np.where(there, weights * values, 0.0).sum(axis=0) / total
        stated = np.sqrt(np.where(there, (weights * errors) ** 2, 0.0).sum(axis=0)) / total
        squares = np.where(there, values - of_all, 0.0) ** 2
        scatter = np.sqrt((weights * squares).sum(axis=0) / (total * (count - 1)))
        chi2 = np.where(there, squares / errors**2, 0.0).sum(axis=0)
    return of_all, stated, np.where(count > 1, scatter, np.nan), chi2, count
