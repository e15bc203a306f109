"""Summary: a run as tables and figures need it: its messages, and quantities over time that they
draw."""

from functools import cached_property

import numpy as np

from hdlyap import topics
from hdlyap.numbers import known
from hdlyap.parameters import with_effect

from . import space
from .course import Course
from .factors import StructureCourse
from .phases import PhaseCourse
from .reader import Missing, is_known
from .stages import PARTS

SMALLEST = 4  # how many of the smallest positive exponents are drawn over time


class Summary:
    """The messages of a data.run.Run, or of data.seeds.Seeds, whose spectrum, steps and fits are
    means. Each message is the last one, None if there is none. Averages from before ~reset_average
    do not count. Messages are read when they are first needed."""

    def __init__(self, data):
        self.data, self.info = data, data.info
        self.is_mean, self.left_out = data.is_mean, data.left_out
        if self.is_mean:
            self.info = with_effect(data.info, 'seed', ', '.join(data.seeds))
            self.info.run_id = ''

    summary = property(lambda self: self)  # a Run has it, too

    def __getattr__(self, topic):
        """The last message of a topic; None if there is none with averages."""
        if topic not in topics.MEASURED:
            raise AttributeError(f'Summary has no {topic}')
        message = self.data.last(topic, numpy=None) if self.data.has(topic) else None
        has_means = getattr(message, 'averaged_time', 1) > 0
        self.__dict__[topic] = message if has_means else None
        return self.__dict__[topic]

    @cached_property
    def growth(self):
        """Fluctuations over finite times; None if there are none."""
        try:
            return self.data.growth
        except Missing:
            return None

    @property
    def is_unpaired(self):
        """Whether all exponents are there, and not in pairs of opposite sign."""
        spectrum = self.spectrum
        return bool(spectrum and spectrum.pairing_error < 0 and np.isfinite(spectrum.exponent_sum))

    @property
    def positive_end(self):
        """The Lyapunov index of the last positive exponent, which is in front of the zero ones."""
        count = self.info.zero_exponents
        if not self.is_unpaired:
            return (self.phase_space - count) // 2
        if count == 0:
            return int(np.sum(np.asarray(self.spectrum.exponents) > 0))
        return self._vanishing[0]

    @property
    def zeros(self):
        """The Lyapunov indices of the exponents that vanish."""
        count = self.info.zero_exponents
        begin, end = self.positive_end, self.positive_end + count
        if self.is_unpaired and count > 0:
            begin, end = self._vanishing
        return range(begin + 1, end + 1)

    @property
    def _vanishing(self):
        """The places [first, end) of exponents that vanish, if they are not in pairs of opposite
        sign: those that are smallest together and, beside them, those that cannot be told from zero
        modes yet, whose norms grow as the time since the vectors began [T8]."""
        count, size = self.info.zero_exponents, np.abs(self.spectrum.exponents)
        first = int(np.convolve(size, np.ones(count), 'valid').argmin())
        time = self.spectrum.sim_time - self.info.equilibration
        apart = np.flatnonzero(size * time >= np.log1p(time))
        before, after = apart[apart < first], apart[apart >= first + count]
        return int(max(before, default=-1)) + 1, int(min(after, default=len(size)))

    @property
    def phase_space(self):
        """The dimension of phase space, which is the number of exponents."""
        return space.phase_space(self.info)

    @property
    def last_index(self):
        """The Lyapunov index of the last exponent of the run."""
        return self.spectrum.first_index + len(self.spectrum.exponents) - 1

    @property
    def sum_name(self):
        """The name of the sum of the run's positive exponents."""
        is_all = is_known(self.info) and self.last_index >= self.positive_end
        return 'h_KS' if is_all else 'sum of exponents'

    @property
    def sum_error(self):
        """The error of that sum; -1 if it is not known yet."""
        return self.spectrum.ks_entropy_error

    @cached_property
    def phases(self):
        course = PhaseCourse()
        for message in self.data.messages('lp_phases'):
            course.add(message)
        return course

    @cached_property
    def structure(self):
        course = StructureCourse()
        for message in self.data.messages('structure'):
            course.add(message, self.positive_end)
        return course

    @property
    def smallest(self):
        """The Lyapunov indices of the run's smallest positive exponents."""
        end = min(self.positive_end, self.last_index)
        return list(range(max(self.spectrum.first_index, end - SMALLEST + 1), end + 1))

    @property
    def is_caged(self):
        """Whether the last status says that particles are caged."""
        return self._status is not None and self._status.caged

    def warnings(self):
        """Yields a line for each run whose particles are caged or whose energy was off."""
        for run in self.data.runs:
            if run.summary.is_caged:
                yield (
                    f'{run.name}: {space.particle(run.info)}s have kept their places since the '
                    'averaging began: other seeds may differ by more than the errors'
                )
        yield from self.energies_off()

    def energies_off(self):
        """Yields a line for each run whose energy was off by more than was asked."""
        for run in self.data.runs:
            last = run.summary._status
            if last is not None and last.energy_error_most > last.energy_error_wanted:
                yield (
                    f'{run.name}: the energy was off by {last.energy_error_most:.2g}, asked was '
                    f'{last.energy_error_wanted:.2g}: the time step was too long'
                )

    @property
    def energy_error(self):
        """The largest relative error of the energy so far; None of particles without time steps."""
        last = self._status
        found = np.nan if last is None else last.energy_error_most
        return float(found) if 0 < found < np.inf else None

    @cached_property
    def _status(self):
        last = None
        for last in self.data.messages('status'):
            continue
        return last

    @property
    def began(self):
        """{stage: simulated time of its first status}"""
        found = {}
        for message in self.data.messages('status'):
            found.setdefault(message.stage, message.sim_time)
        return found

    def fields(self):
        """The last ModeField of each vector, one after the other, largest index first."""
        return reversed(list(self.data.fields.values()))

    def course(self):
        """Running means over averaged time; unknown errors are NaN."""
        small = [index - self.spectrum.first_index for index in self.smallest]
        course, n = Course(), len(small)
        for message in self.data.messages('spectrum'):
            if message.averaged_time > 0:
                errors = message.std_errors
                means = message.averaged_time, message.lambda_max, errors[0], _typical(errors)
                course.add((*means, *message.exponents[small], *errors[small]))
        table = course.table()
        return {
            'time': table[:, 0],
            'lambda_max': table[:, 1],
            'lambda_max_error': known(table[:, 2]),
            'error': known(table[:, 3]),
            'small': table[:, 4 : 4 + n],
            'small_errors': known(table[:, 4 + n :]),
        }

    def cost(self):
        """Wall seconds since the start over simulated time, by part; None if not recorded."""
        names = ['sim_time', 'wall_seconds', *(part + '_seconds' for part in PARTS)]
        course, last, before = Course(), np.zeros(len(names)), np.zeros(len(names))
        for message in self.data.messages('cost'):
            now = np.array([getattr(message, name) for name in names])
            before += np.where(now < last, last, 0.0)  # a resumed run may count from 0 again
            last = now
            course.add(before + now)
        table = course.table()
        return None if table is None else dict(zip(('time', 'wall', *PARTS), table.T))


def _typical(errors):
    """The root mean square of the errors that are known; -1 if none is."""
    errors = errors[errors > 0]
    return np.sqrt(np.mean(errors**2)) if len(errors) else -1.0
