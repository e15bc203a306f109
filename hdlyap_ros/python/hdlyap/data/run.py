"""One run, as recorded or, from a node, so far -> numpy arrays and pandas frames, which are read
when they are first needed."""

import heapq
from collections import deque, namedtuple
from functools import cached_property
from operator import attrgetter

import numpy as np
import pandas

from hdlyap import msg, topics
from hdlyap.numbers import known

from . import dataset, fields, fits, fluctuations, frames, joined, printed, reader, space
from . import structure
from .disks import Disks
from .reader import Missing
from .summary import Summary

TOPICS = {name: message._type for name, message in topics.RECORDED.items()}
# name of an array: the field whose unit it has
ARRAYS = {
    'times': (msg.Spectrum, 'sim_time'),
    'averaged_times': (msg.Spectrum, 'averaged_time'),
    'exponents': (msg.Spectrum, 'exponents'),
    'std_errors': (msg.Spectrum, 'std_errors'),
    'local.lengths': (msg.Spectrum, 'averaged_time'),
    'local.exponents': (msg.Spectrum, 'local_exponents'),
    'positions': (msg.State, 'x'),
    'momenta': (msg.State, 'px'),
}
# sums of all exponents -> their units; there are none where exponents are in pairs
OF_ALL = {'exponent_sum': '1/time unit', 'kaplan_yorke': ''}
Averages = namedtuple('Averages', 'times averaged_times exponents std_errors local last')
# samples: their ends, lengths and exponents; samples do not overlap
Local = namedtuple('Local', 'times lengths exponents')


class Run:
    """`info` is its run_info; without one (a part of a bag) what needs a parameter raises NoInfo.
    Arrays have a row for each message: `times` (simulated),
    `averaged_times`, `exponents` and `std_errors` of the running means; `local` the samples. Frames
    are of the last message: `spectrum`, `modes`, `steps`, `phases`, `t_phases`, `covariant`,
    `localization`, `fluctuations`, `gas`, `averages`, `results`; or of all: `cost`, `status`,
    `course(topic)`. `structure` has structure factors, `growth` fluctuations over finite times,
    `state` positions and momenta, `fields` the last field of each vector. Of spheres each has z
    beside x and y, as fields[index].dqz, steps['nz'], gas.loc['pressure_z'].
    Of dumbbells `own` has the bond, info.inertia is a number, and they turn: state.angles(time),
    modes['rotation'], fields[index].dq_angle.
    What was averaged before ~reset_average does not count."""

    def __init__(self, parts, runs_in_bag=1, form=None, k=None):
        self.parts, self.runs_in_bag = parts, runs_in_bag
        self._form, self._k = form, k  # choice of fits, see data.fits.chosen
        last = [part.info for part in parts if part.run_id == parts[-1].run_id]
        self.info = max(last, key=reader.changes)
        self.paths = list(dict.fromkeys(part.path for part in parts))

    def __repr__(self):
        info = self.info
        if not reader.is_known(info):
            return f'<hdlyap run {info.run_id}: no run_info, so its parameters are not known>'
        what = space.particle(info)
        return f'<hdlyap run {info.run_id}: {info.scene}, {info.number} {what}s, seed {info.seed}>'

    # ---- as of Seeds ------------------------------------------------------------------------

    is_mean, left_out = False, ()
    runs = property(lambda self: [self])
    seeds = property(lambda self: [self.info.seed])
    averaged_time = property(lambda self: float(self.averaged_times[-1]))
    summary = cached_property(Summary)

    @property
    def own(self):
        """{name: value} of the parameters that only these particles have."""
        return space.own(self.info)

    # ---- messages ---------------------------------------------------------------------------

    @property
    def is_complete(self):
        """Whether the run went to its end."""
        last = None
        for last in self.packed((reader.STATUS,)):
            continue
        last = last and last.message()
        return bool(last) and last.stage == msg.RunStatus.FINISHED and last.progress >= 1

    @property
    def units(self):
        """The units of the arrays; those of a frame are in its attrs."""
        return {name: fields.of(kind)[field].unit for name, (kind, field) in ARRAYS.items()}

    @property
    def name(self):
        """The name of the run in messages to the user."""
        return ', '.join(self.paths)

    def packed(self, kinds):
        """Messages of these types except run_info, each once."""
        return joined.packed(self.parts, kinds)

    def in_time(self, kinds):
        """Messages as packed() has them, sorted by simulated time, which a recorder of several
        topics does not quite keep."""
        streams = (self.packed((kind,)) for kind in kinds)
        return heapq.merge(*streams, key=lambda packed: packed.sim_time)

    def messages(self, topic):
        """The messages of a topic ('spectrum', 'fields' ..), one after the other, with numpy
        arrays; those since the last reset, but of topics.OF_THE_RUN all."""
        for packed in self._counting(topic):
            yield packed.message(np)

    def _counting(self, topic):
        """The packed messages of a topic that were published after the last ~reset_average."""
        begin = -np.inf if topic in topics.OF_THE_RUN else self.last_reset
        found = self.packed((TOPICS[topic],))
        return (packed for packed in found if packed.sim_time > begin)

    @property
    def last_reset(self):
        """A simulated time: what was published up to then was averaged before the last
        ~reset_average, and does not count; -inf without a reset."""
        return self._seen.begin

    # ---- running means and samples ----------------------------------------------------------

    times = property(attrgetter('_averages.times'))
    averaged_times = property(attrgetter('_averages.averaged_times'))
    exponents = property(attrgetter('_averages.exponents'))
    std_errors = property(attrgetter('_averages.std_errors'))
    local = property(attrgetter('_averages.local'))

    @cached_property
    def _averages(self):
        rows, samples = [], []
        for message in self.messages('spectrum'):
            if message.averaged_time > 0:
                rows.append(message)
                if message.local_time != 0:  # otherwise its sample was in the message before
                    samples.append((message.sim_time, message.local_time, message.local_exponents))
        if not rows:
            raise self._missing('spectrum')
        return Averages(
            np.array([row.sim_time for row in rows]),
            np.array([row.averaged_time for row in rows]),
            np.array([row.exponents for row in rows]),
            known([row.std_errors for row in rows]),
            Local(*map(np.array, zip(*samples))) if samples else _no_samples(rows[-1]),
            rows[-1],
        )

    # ---- frames -----------------------------------------------------------------------------

    @cached_property
    def spectrum(self):
        return frames.of(self._averages.last, self.info)

    def __getattr__(self, topic):
        """The frame of the last message of a topic."""
        if topic not in topics.MEASURED:
            raise AttributeError(f'{type(self).__name__!r} object has no attribute {topic!r}')
        made = self.__dict__[topic] = frames.of(self.last(topic), self.info)
        return made

    def __dir__(self):
        return [*super().__dir__(), *topics.MEASURED]

    phases = property(attrgetter('lp_phases'))

    @cached_property
    def results(self):
        """lambda_max, the sum of the positive exponents, those of OF_ALL that there are, and the
        fits to steps if there are any, with their bases. sampling_error is the part of the errors
        of c and v by which another run of the same box may differ; the rest grows with the
        misfit."""
        last = self._averages.last
        rate, none = fields.of(last)['lambda_max'].unit, ''
        rows = [
            ('lambda_max', last.lambda_max, *[last.std_errors[0]] * 2, -1.0, rate, none),
            (
                self.summary.sum_name,
                last.ks_entropy,
                *[last.ks_entropy_error] * 2,
                -1.0,
                rate,
                none,
            ),
        ]
        rows += [
            (name, getattr(last, name), *[getattr(last, name + '_error')] * 2, -1.0, unit, none)
            for name, unit in OF_ALL.items()
            if np.isfinite(getattr(last, name)) and last.pairing_error < 0
        ]
        units = fields.of(msg.Steps)
        rows += [
            (*of_value, sampling, fit.misfit, units[of_value[0].lower()].unit, fit.basis)
            for fit in self.fits
            for of_value, sampling in zip(fit.values, fit.sampling_errors)
        ]
        unknown = 'std_error', 'sampling_error', 'misfit'
        made = pandas.DataFrame(rows, columns=['quantity', 'value', *unknown, 'unit', 'basis'])
        for name in unknown:
            made[name] = known(made[name])
        return made.set_index('quantity')

    @cached_property
    def fits(self):
        """The data.fits.Fit of each kind that there is."""
        found = fits.of(self.last('steps')) if self.has('steps') else []
        return [fit for fit in found if fit.count]

    def over_time(self):
        """{name: frame} of the running means, their errors and the samples. A frame has a column
        for each Lyapunov index."""
        index = pandas.Index(self.spectrum.index, name='index')
        of_two, times, local = pandas.MultiIndex.from_arrays, self.times, self.local
        rows = of_two([times, self.averaged_times], names=['sim_time', 'averaged_time'])
        samples = of_two([local.times, local.lengths], names=['sim_time', 'length'])
        return {
            'exponents': pandas.DataFrame(self.exponents, rows, index),
            'std_errors': pandas.DataFrame(self.std_errors, rows, index),
            'local_exponents': pandas.DataFrame(local.exponents, samples, index),
        }

    def table(self):
        """Results with their errors as texts, 0.4299(28), and units; see data.printed."""
        return printed.of(self)

    def to_xarray(self):
        """One xarray.Dataset of all topics; see data.dataset."""
        return dataset.of(self)

    @cached_property
    def cost(self):
        return frames.numbers(self._all('cost'))

    @cached_property
    def status(self):
        return frames.numbers(self._all('status'))

    def course(self, topic):
        """Frame of all messages of a topic, by simulated time: in course('lp_phases')['phase'], for
        one, unstack() makes a column of each phase."""
        names = [*topics.MEASURED, *sorted(topics.OF_THE_RUN)]
        if topic not in names:
            raise reader.RecordingError(f'course of {topic!r}: must be one of {", ".join(names)}')
        return frames.over_time(self._all(topic), self.info)

    @cached_property
    def structure(self):
        """The last mean structure factors; see structure.Structure."""
        return structure.Structure(self._last_with('structure', 'along', 'means'))

    @cached_property
    def growth(self):
        """The last fluctuations over finite times: see fluctuations.Growth."""
        return fluctuations.Growth(self._last_with('fluctuations', 'orders', 'orders'), self.info)

    def _last_with(self, topic, slot, what):
        """The last message in which this array has elements."""
        last = None
        for last in (one for one in self.messages(topic) if len(getattr(one, slot))):
            continue
        if last is None:
            raise self._missing(f'{topic} with {what}')
        return last

    def tables(self):
        """{name: frame} of all that was recorded but run_info; see frames.tables."""
        found = {}
        for topic in filter(self.has, topics.RECORDED):
            if topic != 'fields':
                found.update(frames.tables(topic, self.messages(topic), self.info))
        of_vectors = {}
        for index, message in self.fields.items():
            for name, one in frames.tables('fields', [message], self.info).items():
                of_vectors.setdefault(name, {})[index] = one
        return {**found, **{name: frames.keyed(one, 'vector') for name, one in of_vectors.items()}}

    @property
    def covariant_orders(self):
        """Order of covariant vectors' growth over finite times: see fluctuations.Orders."""
        return fluctuations.Orders(self.last('covariant'))

    def amplitudes(self, indices, direction):
        """A frame of all amplitudes of these vectors' waves, 'along' or 'across' k."""
        return structure.amplitudes(self._all('structure'), list(indices), direction)

    # ---- disks and vectors ------------------------------------------------------------------

    @cached_property
    def state(self):
        found = Disks(self)
        if not len(found.times):
            raise self._missing('state')
        return found

    @cached_property
    def fields(self):
        """{Lyapunov index: ModeField}, the last one of each vector."""
        last = {packed.field_index(): packed for packed in self._counting('fields')}
        return {index: packed.message(np) for index, packed in sorted(last.items())}

    # ---- messages ---------------------------------------------------------------------------

    @cached_property
    def _seen(self):
        """The Seen of small messages, and of those with means, for which the bag is read once."""
        seen = Seen()
        for packed in self.packed([TOPICS[topic] for topic in topics.MEASURED]):
            seen.add(packed)
        return seen

    def _last(self, topic):
        """The last Packed of a topic; None if there is none."""
        if topic in topics.MEASURED:
            return self._seen.last(TOPICS[topic])
        return next(iter(deque(self._counting(topic), maxlen=1)), None)

    def has(self, topic):
        """Whether a topic has a message; 'spectrum' must have averages."""
        return self._last(topic) is not None

    def last(self, topic, numpy=np):
        """The last message of a topic, with numpy arrays, or with lists if numpy is None."""
        packed = self._last(topic)
        if packed is None:
            raise self._missing(topic)
        message = packed.message(numpy)
        return fits.chosen(message, self._form, self._k) if topic == 'steps' else message

    def _all(self, topic):
        found = list(self.messages(topic))
        if not found:
            raise self._missing(topic)
        return found

    def _missing(self, topic):
        what = 'averaged spectrum' if topic == 'spectrum' else f'message of {topic}'
        return Missing(f'{self.name}: no {what} in it')


class Seen:
    """The last message of each type, and `begin`: up to this simulated time all was averaged before
    the last ~reset_average. Means of less than before show that there was a reset, after the
    message before; averaged times of later spectra say when."""

    def __init__(self):
        self._before = self._start = -np.inf
        self._last, self._means = {}, {}

    def add(self, packed):
        if packed.kind in reader.MEANS:
            self._note_reset(packed, self._means.get(packed.kind))
            self._means[packed.kind] = packed
        if packed.kind != reader.SPECTRUM or packed.amount > 0:
            self._last[packed.kind] = packed

    def _note_reset(self, packed, before):
        is_spectrum = packed.kind == reader.SPECTRUM
        if before is not None and packed.amount < before.amount:
            self._before = max(self._before, before.sim_time)
            self._start = np.inf if is_spectrum else self._start
        if is_spectrum and packed.amount > 0:
            self._start = min(self._start, packed.sim_time - packed.amount)

    @property
    def begin(self):
        return max(self._before, self._start if self._start < np.inf else -np.inf)

    def last(self, kind):
        packed = self._last.get(kind)
        return packed if packed is not None and packed.sim_time > self.begin else None


def _no_samples(message):
    return Local(np.empty(0), np.empty(0), np.empty((0, len(message.exponents))))
