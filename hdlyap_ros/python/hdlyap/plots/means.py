"""Runs of several seeds -> one that figures and comparison take for a run: its exponents, steps and
fits are means over the seeds, its errors the larger ones of those that the runs state and of those
that the scatter between them shows."""

import copy

import numpy as np

from hdlyap.data import joined

from . import recording
from .numbers import with_error
from .run import Run


def read(paths, node=None, types=recording.TYPES, number=None, choice=(None, None)):
    """The Recording of bags of one run, or the Means of bags of several seeds; choice: of the fits,
    see fits.chosen."""
    found = joined.runs(paths, node, number)
    if len(found) == 1:
        made = recording.of(found[0], types)
        made.choice = choice
        return made
    from hdlyap.data import run, seeds  # only here: pandas takes a while

    return Means(seeds.Seeds([run.Run(one, *choice) for one in found]))


ROW = '  {:<16} {:>15} {:>15} {:>15} {:>12} {:>4}  {}'
HEAD = ROW.format('', 'mean', 'stated error', 'from scatter', 'chi^2/(n-1)', 'n', '').rstrip()


class Means(Run):
    """`seeds` are the data.seeds.Seeds."""

    runs = 1  # in a bag, as of a Recording

    def __init__(self, seeds):
        self.seeds = seeds
        self.left_out = seeds.left_out
        self.info = copy.copy(seeds.info)
        self.info.seed, self.info.run_id = ', '.join(seeds.seeds), ''
        self.spectrum = self._spectrum()
        if all(run.has('steps') for run in seeds.runs):
            self.steps = self._steps()

    def _spectrum(self):
        message = copy.copy(self.seeds.runs[0].last('spectrum'))
        frame, results = self.seeds.spectrum, self.seeds.results
        message.run_id, message.averaged_time = '', self.seeds.averaged_time
        message.collisions = sum(run.last('spectrum').collisions for run in self.seeds.runs)
        message.exponents = frame['exponent'].tolist()
        message.std_errors = errors(frame).tolist()
        message.lambda_max, message.ks_entropy = results['value'].iloc[:2].tolist()
        message.ks_entropy_error = float(errors(results).iloc[1])
        message.pairing_error = -1.0
        return message

    def _steps(self):
        """As in the first run that has them: multiplicities and exponents are means."""
        message = copy.deepcopy(self.seeds.runs[0].last('steps'))
        message.run_id, message.averaged_time = '', self.seeds.averaged_time
        found = {}
        for run in self.seeds.runs:
            for name, step in zip(run.steps.index, run.last('steps').steps):
                if step.resolved:
                    found.setdefault(name, copy.copy(step))
        message.steps = [
            found.get(name, step)
            for name, step in zip(self.seeds.runs[0].steps.index, message.steps)
        ]
        for name, error in errors(self.seeds.steps).items():
            mean = self.seeds.steps.loc[name]
            found[name].exponent, found[name].std_error = mean['exponent'], error
            found[name].multiplicity = mean['multiplicity']
        self._fits(message)
        return message

    def _fits(self, message):
        """A fit that is not of the same form in all runs is none."""
        results, error = self.seeds.results, errors(self.seeds.results)
        for symbol, points in (('c_T', 't_points'), ('c_L', 'l_points'), ('v', 'v_phases')):
            if symbol not in results.index:
                setattr(message, points, 0)
        for name in results.index[2:]:
            setattr(message, name.lower(), results['value'][name])
            setattr(message, name.lower() + '_error', error[name])
            if hasattr(message, name.lower() + '_sampling_error'):
                setattr(message, name.lower() + '_sampling_error', results['sampling_error'][name])
        message.t_misfit = message.l_misfit = message.v_misfit = -1.0

    def table(self):
        """What hdlyap plot prints of them beside the exponents: both errors and chi^2."""
        seeds = self.seeds
        count = len(seeds.runs)
        number = '1 seed' if count == 1 else f'{count} seeds'
        lines = [f'means over {number}, weighted with their averaged times', HEAD]
        lines += [_row(name, row, 'value', row['basis']) for name, row in seeds.results.iterrows()]
        if self.steps is not None:
            lines += [_row(name, row, 'exponent') for name, row in seeds.steps.iterrows()]
        lost = [fit.symbol for fit in seeds.runs[0].fits if fit.symbol not in seeds.results.index]
        if lost:
            lines.append(f'  {", ".join(lost)}: of other forms or wave numbers in other runs')
        lines += [f'  {line}' for line in self.left_out]
        return '\n'.join(lines)


def errors(frame):
    """The larger one of both; the only one while the other is not known."""
    return np.fmax(frame['std_error'], frame['scatter'])


def _row(name, row, column, remark=''):
    count = int(row['runs'])
    chi2 = f'{row["chi2"] / (count - 1):.2f}' if count > 1 and np.isfinite(row['chi2']) else '-'
    stated, scatter = (
        f'{row[error]:.2g}' if np.isfinite(row[error]) else '-'
        for error in ('std_error', 'scatter')
    )
    value = with_error(row[column], float(np.fmax(row['std_error'], row['scatter'])))
    return ROW.format(name, value, stated, scatter, chi2, count, remark).rstrip()
