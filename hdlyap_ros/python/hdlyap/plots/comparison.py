"""Two recordings -> the parameters that the runs share, and the deviations of all that both have
measured."""

import copy
import io

import numpy as np

from hdlyap.data import fits, space, steps
from hdlyap.data.run import OF_ALL
from hdlyap.data.spectrum_test import SpectrumTest
from hdlyap.data.joined import different, system
from hdlyap.data.reader import RecordingError

from hdlyap.numbers import known

from .deviation import FREEDOM, Deviation

# fields that differ even if runs are identical; parameters are compared one by one
NOT_OF_SYSTEM = ('header', 'run_id', 'given', 'parameters')
SLOPES = 'c_T', 'c_L', 'v'
SUMS = 'h_KS', 'sum of exponents'
STEPPED = 'time_step', 'integrator'  # parameters that do not change the system


class Comparison:
    """Compares the runs a and b of one system: exponents, h_KS, steps, fits, gas and
    averages, both in `gas`. `unlike`: (fit of
    a, fit of b) if their forms or wave numbers differ. What decides is fixed beforehand: the
    resolved `steps`, a few `numbers`, and the spectrum as a whole."""

    def __init__(self, a, b):
        self.runs = a, b
        _refuse_other_systems(a.info, b.info)
        _refuse_without_exponents(a, b)
        self._fluctuations = _fluctuations(a, b)
        self.exponents = _exponents(a, b)
        self.exponents[0] = self._together(self.exponents[0], [0])
        self._positive = range(min(a.positive_end, a.last_index) + 1 - a.spectrum.first_index)
        is_sum = len(self.exponents) > 1
        self.sums = [self._together(_sum(a, b), self._positive)] if is_sum else []
        self.sums += _of_all(a, b)
        self.steps = [self._together(one, _members(one, a), False) for one in _steps(a, b)]
        self.gas = [*_gas(a, b, {one.name for one in self.sums}), *_averages(a, b)]
        pairs = _pairs_of_fits(a, b)
        self.fits = [one for pair in pairs if pair[0].is_like(pair[1]) for one in _fits(a, b, pair)]
        self.unlike = [pair for pair in pairs if not pair[0].is_like(pair[1])]

    @property
    def deviations(self):
        return [*self.exponents, *self.sums, *self.steps, *self.fits, *self.gas]

    @property
    def numbers(self):
        """lambda_max, h_KS, sum and dimension of unpaired ones, c_T, c_L, v, all of the gas."""
        slopes = [one for one in self.fits if one.name in SLOPES]
        return [*self.exponents[:1], *self.sums, *slopes, *self.gas]

    @property
    def spectra(self):
        """(T^2, groups, chance) of the spectra as a whole; None if too few samples were recorded.
        Only positive exponents count, because the others are their opposites."""
        taken = self._positive
        if not self._fluctuations.is_known or not len(taken):
            return None
        difference = np.array([one.difference for one in self.exponents])
        return self._fluctuations.spectra(difference, taken, _times(self.runs))

    def _together(self, one, members, of_sampling=True):
        """A mean or sum of exponents with the error from the blocks of both runs; unchanged if that
        is not known, or if it is smaller than what several seeds say, or than a stated error that
        is not of sampling alone."""
        if not self._fluctuations.is_known or not len(members) or not one.is_known:
            return one
        weights = np.zeros(len(self.exponents))
        weights[members] = 1.0 if one.name in SUMS else 1 / len(members)
        error = self._fluctuations.error(weights, _times(self.runs))
        if error > one.error or of_sampling and not any(run.is_mean for run in self.runs):
            one.know_better(error, self._fluctuations.freedom)
        return one

    @property
    def is_identical(self):
        """Whether the last spectrum and the last steps are the same in every bit, as far as both
        runs have them."""
        a, b = self.runs
        pairs = [(a.spectrum, b.spectrum), (a.steps, b.steps)]
        both = [pair for pair in pairs if None not in pair]
        return bool(both) and all(_bits(one) == _bits(other) for one, other in both)

    @property
    def found_once(self):
        """Names of the steps that are resolved in a alone, and of those in b alone."""
        a, b = (_resolved(run) for run in self.runs)
        info = self.runs[0].info
        return (
            [_step_name(a[key], info) for key in a if key not in b],
            [_step_name(b[key], info) for key in b if key not in a],
        )

    @property
    def parameters(self):
        """(name, value of a, value of b) of parameters that differ."""
        a, b = (run.info for run in self.runs)
        names = [one.name for one in a.parameters] + a.__slots__
        for name in dict.fromkeys(name for name in names if name not in NOT_OF_SYSTEM):
            values = [getattr(info, name, None) for info in (a, b)]
            unknown = all(value != value for value in values)  # both are NaN
            if values[0] != values[1] and not unknown:
                yield name, *values

    @property
    def system(self):
        """run_info of a; of the parameters that only some particles have, those that b shares."""
        a, b = (run.info for run in self.runs)
        shared = copy.copy(a)
        shared.parameters = [one for one in a.parameters if not one.own or one in b.parameters]
        return shared


def _bits(message):
    message = copy.copy(message)
    message.header, message.run_id = type(message.header)(), ''
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def _refuse_other_systems(a, b):
    names = [name for name in system(a) if name not in STEPPED]
    found = list(different(a, b, names))
    shown = [one for one in found if '' not in one] or found  # without boundary_z of disks
    others = [f'{name} {one} and {other}' for name, one, other in shown]
    if others:
        why = 'the runs are of different systems and are not compared'
        table = 'hdlyap table shows runs of several systems side by side'
        raise RecordingError(f'{why}: {", ".join(others)}; {table}')


def _refuse_without_exponents(a, b):
    for run, which in ((a, 'first'), (b, 'second')):
        if run.spectrum is None:
            raise RecordingError(f'no averaged spectrum in the {which} bag')
    carried = [(run.spectrum.first_index, run.last_index) for run in (a, b)]
    if carried[0] != carried[1]:
        ranges = '{}-{} and {}-{}'.format(*carried[0], *carried[1])
        raise RecordingError(f'the runs cannot be compared: they carry the exponents {ranges}')


def _times(runs):
    return [run.spectrum.averaged_time for run in runs]


def _fluctuations(a, b):
    """The SpectrumTest of the exponents of both runs."""
    times = np.array(_times((a, b)))[:, None]
    errors = known([run.spectrum.std_errors for run in (a, b)])
    sides = [run.data.runs for run in (a, b)]
    return SpectrumTest(sides, (errors**2 * times).mean(axis=0), _scattered(a, b, errors))


def _scattered(a, b, errors):
    """Which part of the squared errors of exponents the scatter over seeds alone says."""
    parts = [
        np.median(_excess(run.data.spectrum, known_)) if run.is_mean else 0.0
        for run, known_ in zip((a, b), errors)
    ]
    return float(np.mean(parts))


def _excess(frame, error):
    """Which part of the square of an error the scatter over seeds has beyond what is stated."""
    stated = frame['std_error'] ** 2
    more = np.nan_to_num(frame['scatter']) ** 2 - np.nan_to_num(stated)
    with np.errstate(divide='ignore', invalid='ignore'):
        return np.nan_to_num(np.fmax(more, 0.0) / np.square(error))


def _deviation(name, pair, values, errors, where, **more):
    """The Deviation of a quantity of two runs, or of means over seeds. Its errors are the larger
    ones of those stated and of the scatter, as the messages of means have them; where: (name of the
    frame of Run and Seeds, row) with both. The scatter over n seeds has n - 1 degrees of freedom.
    Where no run states an error, it is the error however few there are."""
    found = [_of_side(run, error, *where) for run, error in zip(pair, known(errors))]
    errors, freedom = zip(*found)
    return Deviation(name, values, errors, freedom=freedom, **more)


def _of_side(run, error, frame, row):
    """(error, its degrees of freedom)"""
    if not run.is_mean:
        return error, FREEDOM
    if np.isnan(error):
        return run.data.scatter_of_few(frame, row)
    of = getattr(run.data, frame).loc[row]
    excess, count = float(_excess(of, error)), int(of['runs'])
    return error, count - 1 if excess > 0 else FREEDOM * count


def _members(one, run):
    """Places of the exponents of a step; none if it shares its set, or has other indices in the
    other run."""
    a, b = one.origins
    if (a.first_index, a.last_index) != (b.first_index, b.last_index) or max(
        a.members, b.members
    ) > 1:
        return []
    return range(
        a.first_index - run.spectrum.first_index, a.last_index + 1 - run.spectrum.first_index
    )


def _gas(a, b, beside):
    """Deviations of all quantities of the gas; none unless all runs have them. The divergence is
    the sum of all exponents: it counts once. beside: names of those sums that are compared."""
    if not all(one.has('gas') for run in (a, b) for one in run.data.runs):
        return []
    found = []
    names = a.data.gas.index
    for name in names.drop('divergence', errors='ignore') if 'exponent_sum' in beside else names:
        values, errors = (
            [getattr(run.gas, name + what) for run in (a, b)] for what in ('', '_error')
        )
        found.append(_deviation(name.replace('_', ' '), (a, b), values, errors, ('gas', name)))
    return found


def _averages(a, b):
    """Of what the particles of both tell."""
    if not all(one.has('averages') for run in (a, b) for one in run.data.runs):
        return []
    told = [{one.name: one for one in run.averages.averages} for run in (a, b)]
    return [
        _deviation(
            name,
            (a, b),
            [one[name].value for one in told],
            [one[name].std_error for one in told],
            ('averages', name),
        )
        for name in told[0]
        if name in told[1]
    ]


def _exponents(a, b):
    values = zip(a.spectrum.exponents, b.spectrum.exponents)
    columns = zip(values, zip(a.spectrum.std_errors, b.spectrum.std_errors))
    found = []
    for index, measured in enumerate(columns, start=a.spectrum.first_index):
        name = 'lambda_max' if index == 1 else f'lambda_{index}'
        # zero exponents fall like 1/t, so that they have no errors of means
        where = 'spectrum', index
        found.append(_deviation(name, (a, b), *measured, where, judged=index not in a.zeros))
    return found


def _sum(a, b):
    """The Deviation of the sum of the positive exponents."""
    values, errors = (a.spectrum.ks_entropy, b.spectrum.ks_entropy), (a.sum_error, b.sum_error)
    return _deviation(a.sum_name, (a, b), values, errors, ('results', a.sum_name))


def _of_all(a, b):
    """Deviations of the sum of all exponents and of the Kaplan-Yorke dimension, if they are not in
    pairs."""
    found = []
    for name in OF_ALL:
        values, errors = (
            [getattr(run.spectrum, name + what) for run in (a, b)] for what in ('', '_error')
        )
        if (
            np.isfinite(values).all()
            and max(a.spectrum.pairing_error, b.spectrum.pairing_error) < 0
        ):
            found.append(_deviation(name, (a, b), values, errors, ('results', name)))
    return found


def _resolved(run):
    """{(kind, nodes, conjugate): Step} of the resolved steps, smallest |exponent| first."""
    found = [step for step in (run.steps.steps if run.steps else ()) if step.resolved]
    return {
        (step.kind, space.nodes(step, run.info), step.conjugate): step
        for step in sorted(found, key=lambda step: abs(step.exponent))
    }


def _step_name(step, info):
    return steps.name(step, info) + ('*' if step.conjugate else '')


def _steps(a, b):
    """Deviations of the steps that both runs resolve; their origins are the two Steps."""
    in_a, in_b = _resolved(a), _resolved(b)
    found = []
    for pair in [(in_a[key], in_b[key]) for key in in_a if key in in_b]:
        values, errors = zip(*((step.exponent, step.std_error) for step in pair))
        name, judged = _step_name(pair[0], a.info), pair[0].kind != steps.ZERO
        more = {'judged': judged, 'origins': pair}
        found.append(_deviation(name, (a, b), values, errors, ('steps', name), **more))
    return found


def _pairs_of_fits(a, b):
    """(fit of a, fit of b) of each kind that both runs have."""
    return [pair for pair in zip(fits.of(a.steps), fits.of(b.steps)) if all(f.count for f in pair)]


def _fits(a, b, pair):
    """Deviations of the coefficients of two fits with the same form and wave numbers. Their errors
    are those of sampling if they are stated, because the error of the form is the same in both.
    Their origins are the fits."""
    found = []
    both = enumerate(zip(*(fit.measured_values for fit in pair)))
    for place, ((name, value, error), (_, other, others)) in both:
        sampling = [fit.sampling_errors[place] for fit in pair]
        errors = (error, others) if np.isnan(sampling).any() else sampling
        where = 'results', name
        found.append(_deviation(name, (a, b), (value, other), errors, where, origins=pair))
    return found
