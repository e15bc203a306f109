"""bag file -> Recording: what one node said about its last run. Streams, keeps thinned courses of
scalars and the last of everything else, so a bag may be far larger than the memory."""

import numpy as np

from hdlyap.data import joined, reader
from hdlyap.data.reader import (
    COST,
    COVARIANT,
    FIELD,
    GAS,
    LOCALIZATION,
    PHASES,
    RUN_INFO,
    SPECTRUM,
    STATUS,
    STEPS,
    STRUCTURE,
    RecordingError,
)

from . import fits
from .course import Course
from .numbers import known
from .phases import PhaseCourse
from .run import Run
from .stages import PARTS
from .structure import StructureCourse

__all__ = ['RUN_INFO', 'SPECTRUM', 'RecordingError']  # of the reader, also known by these names
TYPES = (RUN_INFO, SPECTRUM, STATUS, COST, STEPS, PHASES, FIELD, COVARIANT, STRUCTURE)
TYPES += (LOCALIZATION, GAS)
LAST = (STEPS, COVARIANT, LOCALIZATION, GAS)  # of these the last one counts
SMALLEST = 4  # exponents whose course is kept, counted back from the last positive one


class Recording(Run):
    """The last run in the bag: its run_info, its last spectrum (None without exponents), the
    course of the averages since their last reset, the cost over time, and of the modes the last
    steps (None if unrecorded), the last field of each vector, the course of the LP phases and of
    structure factors, and the last of covariant vectors, of widths, and of the gas."""

    def __init__(self, info, runs=1):
        self.info = info
        self.runs = runs  # in the bag
        self.spectrum = None
        self.began = {}  # simulated time of the first status of each stage
        self.phases = PhaseCourse()
        self.structure = StructureCourse()
        self._history, self._costs = Course(), Course()
        self._last, self._fields = {}, {}

    @property
    def smallest(self):
        """Lyapunov indices of the smallest positive exponents carried."""
        end = min(self.positive_end, self.last_index)
        return list(range(max(self.spectrum.first_index, end - SMALLEST + 1), end + 1))

    @property
    def steps(self):
        """The last Steps message since averaging began; None if there is none."""
        return fits.chosen(self._averaged(STEPS), *self.choice)

    @property
    def covariant(self):
        """The last Covariant message, likewise: there is at least one window."""
        return self._averaged(COVARIANT)

    @property
    def gas(self):
        """The last Gas message, likewise."""
        return self._averaged(GAS)

    @property
    def localization(self):
        """The last Localization message; None if there is none."""
        return self._last[LOCALIZATION].message() if LOCALIZATION in self._last else None

    def _averaged(self, kind):
        message = self._last[kind].message() if kind in self._last else None
        return message if message is not None and message.averaged_time > 0 else None

    def fields(self):
        """The last ModeField of each vector, one after the other, largest index first."""
        for _, packed in sorted(self._fields.items(), reverse=True):
            yield packed.message()

    def add(self, kind, packed):
        """A message of one of TYPES. What counts only if it is the last one stays packed."""
        if kind in LAST:
            self._last[kind] = packed
        elif kind == FIELD:
            self._fields[packed.field_index()] = packed
        elif kind == STRUCTURE:
            self.structure.add(packed.message(np), self.positive_end)
        else:
            {
                SPECTRUM: self._add_spectrum,
                STATUS: self._add_status,
                COST: self._add_cost,
                PHASES: self.phases.add,
            }[kind](packed.message())

    def _add_spectrum(self, msg):
        if msg.averaged_time <= 0:
            return
        if self.spectrum is not None and msg.averaged_time < self.spectrum.averaged_time:
            self._history.clear()  # the averages were reset
            self._last.pop(COVARIANT, None)  # the next one takes a while
        self.spectrum = msg
        small = [index - msg.first_index for index in self.smallest]
        self._history.add(
            (
                msg.averaged_time,
                msg.lambda_max,
                msg.std_errors[0],
                max(msg.std_errors),
                *(msg.exponents[i] for i in small),
                *(msg.std_errors[i] for i in small),
            )
        )

    def _add_status(self, msg):
        self.began.setdefault(msg.stage, msg.sim_time)

    def _add_cost(self, msg):
        self._costs.add(
            (
                msg.sim_time,
                msg.wall_seconds,
                # older bags do not know every part
                *(getattr(msg, part + '_seconds', 0.0) for part in PARTS),
            )
        )

    def course(self):
        """Running means against averaged time, unknown errors as NaN."""
        table = self._history.table()
        n = len(self.smallest)
        course = {
            'time': table[:, 0],
            'lambda_max': table[:, 1],
            'lambda_max_error': table[:, 2],
            'largest_error': table[:, 3],
            'small': table[:, 4 : 4 + n],
            'small_errors': table[:, 4 + n :],
        }
        for name in ('lambda_max_error', 'largest_error', 'small_errors'):
            course[name] = known(course[name])
        return course

    def cost(self):
        """Wall seconds since the start against simulated time, by part; None if unrecorded."""
        table = self._costs.table()
        if table is None:
            return None
        cost = {'time': table[:, 0], 'wall': table[:, 1]}
        cost.update(zip(PARTS, table[:, 2:].T))
        return cost


def read(paths, node=None, types=TYPES, number=None):
    """The run of a bag, or of several that belong to one run: the last one of the given node, or of
    the only node in the bag, or the one of that number, from 1; of its messages those of the given
    types."""
    return of(joined.one(paths, node, number), types)


def of(run, types=TYPES):
    """Of a joined.Joined."""
    recording = Recording(run.info, run.runs)
    for packed in run.packed([kind for kind in types if kind != RUN_INFO]):
        recording.add(packed.kind, packed)
    return recording


def run_infos(path, node=None):
    """The run_info of every run of the given node, or of the only one in the bag, in their
    order."""
    return list(reader.run_infos(path, node).values())


def messages(path, kind, node=None):
    """Every message of one type of the last run of the given node, or of the only one in the
    bag."""
    for packed in joined.one(path, node).packed((kind,)):
        yield packed.message()
