"""bag file -> Recording: what one node said about its last run. Streams, keeps thinned courses of
scalars and the last of everything else, so a bag may be far larger than the memory."""

import struct
import sys

import genpy
import rosbag

from .course import Course
from .numbers import known
from .phases import PhaseCourse
from .run import Run
from .stages import STAGES

RUN_INFO, SPECTRUM, COST = 'hdlyap/RunInfo', 'hdlyap/Spectrum', 'hdlyap/Cost'
STEPS, PHASES, FIELD = 'hdlyap/Steps', 'hdlyap/LpPhases', 'hdlyap/ModeField'
TYPES = (RUN_INFO, SPECTRUM, COST, STEPS, PHASES, FIELD)
SMALLEST = 4    # exponents whose course is kept, counted back from the last positive one
DAMAGE = (genpy.DeserializationError, struct.error, UnicodeDecodeError, KeyError)


class RecordingError(Exception):
    """One line for the user: what is wrong with which bag."""


class Recording(Run):
    """The last run in the bag: its run_info, its last spectrum (None without exponents), the
    course of the averages since their last reset, the cost over time, and of the modes the last
    steps (None if unrecorded), the last field of each vector, and the course of the LP phases."""

    def __init__(self, info):
        self.info = info
        self.spectrum = None
        self.phases = PhaseCourse()
        self._history, self._costs = Course(), Course()
        self._steps, self._fields = None, {}

    @property
    def smallest(self):
        """Lyapunov indices of the smallest positive exponents carried."""
        end = min(self.positive_end, self.last_index)
        return list(range(max(self.spectrum.first_index, end - SMALLEST + 1), end + 1))

    @property
    def steps(self):
        """The last Steps message since averaging began; None if there is none."""
        steps = self._steps and self._steps.message()
        return steps if steps and steps.averaged_time > 0 else None

    def fields(self):
        """The last ModeField of each vector, one after the other, largest index first."""
        for _, packed in sorted(self._fields.items(), reverse=True):
            yield packed.message()

    def add(self, kind, packed):
        """A message of one of TYPES. What counts only if it is the last one stays packed."""
        if kind == STEPS:
            self._steps = packed
        elif kind == FIELD:
            self._fields[packed.field_index()] = packed
        else:
            {SPECTRUM: self._add_spectrum, COST: self._add_cost,
             PHASES: self.phases.add}[kind](packed.message())

    def _add_spectrum(self, msg):
        if msg.averaged_time <= 0:
            return
        if self.spectrum is not None and msg.averaged_time < self.spectrum.averaged_time:
            self._history.clear()   # the averages were reset
        self.spectrum = msg
        small = [index - msg.first_index for index in self.smallest]
        self._history.add((msg.averaged_time, msg.lambda_max, msg.std_errors[0],
                           max(msg.std_errors),
                           *(msg.exponents[i] for i in small),
                           *(msg.std_errors[i] for i in small)))

    def _add_cost(self, msg):
        self._costs.add((msg.sim_time, msg.phase, msg.wall_seconds,
                         # older bags do not know every stage
                         *(getattr(msg, stage + '_seconds', 0.0) for stage in STAGES)))

    def course(self):
        """Running means against averaged time, unknown errors as NaN."""
        table = self._history.table()
        n = len(self.smallest)
        course = {'time': table[:, 0], 'lambda_max': table[:, 1], 'lambda_max_error': table[:, 2],
                  'largest_error': table[:, 3], 'small': table[:, 4:4 + n],
                  'small_errors': table[:, 4 + n:]}
        for name in ('lambda_max_error', 'largest_error', 'small_errors'):
            course[name] = known(course[name])
        return course

    def cost(self):
        """Wall seconds since the start against simulated time, by stage; None if unrecorded."""
        table = self._costs.table()
        if table is None:
            return None
        cost = {'time': table[:, 0], 'phase': table[:, 1].astype(int), 'wall': table[:, 2]}
        cost.update(zip(STAGES, table[:, 3:].T))
        return cost


class Packed:
    """A serialised message of ours. To unpack a field of every mode only to throw it away would
    cost more than all else; header, run_id and sim_time begin every message but run_info."""

    def __init__(self, data, pytype):
        self._data, self._pytype = data, pytype
        _, after_frame = self._string(12)   # seq and stamp
        self.run_id, self._after_run_id = self._string(after_frame)

    def _string(self, at):
        length, = struct.unpack_from('<I', self._data, at)
        return self._data[at + 4:at + 4 + length].decode(), at + 4 + length

    def field_index(self):
        """Lyapunov index of a ModeField: it follows sim_time."""
        return struct.unpack_from('<I', self._data, self._after_run_id + 8)[0]

    def message(self):
        return self._pytype().deserialize(self._data)


def read(path, node=None, types=TYPES):
    """The last run of the given node, or of the only node in the bag; of its messages those of the
    given types."""
    try:
        with rosbag.Bag(path) as bag:
            return _read_run(bag, path, _topics_of_node(bag, path, node, types))
    except rosbag.ROSBagUnindexedException:
        raise RecordingError(f'{path}: not closed properly; repair it with rosbag reindex')
    except rosbag.ROSBagException as error:
        raise RecordingError(f'{path}: not a readable bag: {error}')
    except DAMAGE as error:
        raise RecordingError(f'{path}: damaged: {error}')
    except OSError as error:
        raise RecordingError(f'{path}: {error.strerror or error}')


def _topics_of_node(bag, path, node, types):
    """Topics with messages of these types, below one node's name."""
    nodes = {}
    for topic, entry in bag.get_type_and_topic_info().topics.items():
        if entry.msg_type in types:
            nodes.setdefault(topic.rpartition('/')[0], []).append(topic)
    if not nodes:
        raise RecordingError(f'{path}: nothing in it was published by hdlyap_node')
    names = ', '.join(sorted(nodes))
    if node is None:
        if len(nodes) > 1:
            raise RecordingError(f'{path}: several nodes, choose one with --node: {names}')
        return next(iter(nodes.values()))
    if '/' + node.strip('/') not in nodes:
        raise RecordingError(f'{path}: no node {node} in it, only {names}')
    return nodes['/' + node.strip('/')]


def _read_run(bag, path, topics):
    recording = None
    messages = bag.read_messages(topics=topics, raw=True)
    for _, raw, _ in _with_progress(messages, bag.get_message_count(topics)):
        kind, data, pytype = raw[0], raw[1], raw[-1]
        packed = Packed(data, pytype)
        if kind == RUN_INFO:
            if recording is None or recording.info.run_id != packed.run_id:
                recording = Recording(packed.message())
        elif recording is not None and recording.info.run_id == packed.run_id:
            recording.add(kind, packed)
    if recording is None:
        raise RecordingError(f'{path}: no run_info in it; record that topic too')
    return recording


def _with_progress(messages, total):
    """Passes the messages on; a percentage on the terminal where that takes a while."""
    show = sys.stderr.isatty() and total > 1000
    for count, message in enumerate(messages):
        if show and count % (total // 100) == 0:
            print(f'\rreading {100 * count // total} %', end='', file=sys.stderr, flush=True)
        yield message
    if show:
        print('\r\033[K', end='', file=sys.stderr, flush=True)
