"""bag file -> Recording: what one node said about its last run. Streams, keeps thinned courses of
scalars and the last of everything else, so a bag may be far larger than the memory."""

import contextlib
import heapq
import os
import struct

import genpy
import rosbag

from .course import Course
from .numbers import known
from .phases import PhaseCourse
from .progress import Progress
from .run import Run
from .stages import PARTS

RUN_INFO, SPECTRUM = 'hdlyap/RunInfo', 'hdlyap/Spectrum'
STATUS, COST = 'hdlyap/RunStatus', 'hdlyap/Cost'
STEPS, PHASES, FIELD = 'hdlyap/Steps', 'hdlyap/LpPhases', 'hdlyap/ModeField'
COVARIANT, STATE = 'hdlyap/Covariant', 'hdlyap/State'
TYPES = (RUN_INFO, SPECTRUM, STATUS, COST, STEPS, PHASES, FIELD, COVARIANT)
SMALLEST = 4  # exponents whose course is kept, counted back from the last positive one
DAMAGE = (genpy.DeserializationError, struct.error, UnicodeDecodeError, KeyError)


class RecordingError(Exception):
    """One line for the user: what is wrong with which bag."""


class Recording(Run):
    """The last run in the bag: its run_info, its last spectrum (None without exponents), the
    course of the averages since their last reset, the cost over time, and of the modes the last
    steps (None if unrecorded), the last field of each vector, and the course of the LP phases,
    and the last of covariant vectors."""

    def __init__(self, info, runs=1):
        self.info = info
        self.runs = runs  # in the bag
        self.spectrum = None
        self.began = {}  # simulated time of the first status of each stage
        self.phases = PhaseCourse()
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
        return self._averaged(STEPS)

    @property
    def covariant(self):
        """The last Covariant message, likewise: there is at least one window."""
        return self._averaged(COVARIANT)

    def _averaged(self, kind):
        message = self._last[kind].message() if kind in self._last else None
        return message if message is not None and message.averaged_time > 0 else None

    def fields(self):
        """The last ModeField of each vector, one after the other, largest index first."""
        for _, packed in sorted(self._fields.items(), reverse=True):
            yield packed.message()

    def add(self, kind, packed):
        """A message of one of TYPES. What counts only if it is the last one stays packed."""
        if kind in (STEPS, COVARIANT):
            self._last[kind] = packed
        elif kind == FIELD:
            self._fields[packed.field_index()] = packed
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


class Packed:
    """A serialised message of ours. To unpack a field of every mode only to throw it away would
    cost more than all else; header, run_id and sim_time begin every message but run_info."""

    def __init__(self, data, pytype):
        self._data, self._pytype = data, pytype
        _, after_frame = self._string(12)  # seq and stamp
        self.run_id, self._after_run_id = self._string(after_frame)

    def _string(self, at):
        (length,) = struct.unpack_from('<I', self._data, at)
        return self._data[at + 4 : at + 4 + length].decode(), at + 4 + length

    def sim_time(self):
        """Not of run_info."""
        return struct.unpack_from('<d', self._data, self._after_run_id)[0]

    def field_index(self):
        """Lyapunov index of a ModeField: it follows sim_time."""
        return struct.unpack_from('<I', self._data, self._after_run_id + 8)[0]

    def field_wave(self):
        """kind, nx and ny of a ModeField, which follow the index."""
        return struct.unpack_from('<BII', self._data, self._after_run_id + 12)

    def message(self):
        return self._pytype().deserialize(self._data)


def read(path, node=None, types=TYPES, number=None):
    """The last run of the given node, or of the only node in the bag, or the one of that number,
    from 1; of its messages those of the given types."""
    with opened(path) as bag:
        return _read_run(bag, path, _topics_of_node(bag, path, node, types), number)


def run_infos(path, node=None):
    """The run_info of every run of the given node, or of the only one in the bag, in their
    order."""
    with opened(path) as bag:
        return _runs(bag, path, _topics_of_node(bag, path, node, TYPES))


def messages(path, kind, node=None):
    """Every message of one type of the last run of the given node, or of the only one in the
    bag."""
    with opened(path) as bag:
        topics = _topics_of_node(bag, path, node, (RUN_INFO, kind))
        run_id = _runs(bag, path, topics)[-1].run_id
        for name, packed in _packed(bag, topics):
            if name == kind and packed.run_id == run_id:
                yield packed.message()


@contextlib.contextmanager
def opened(path):
    """The bag; whatever is wrong with it is a RecordingError."""
    try:
        with rosbag.Bag(path) as bag:
            yield bag
    except rosbag.ROSBagUnindexedException:
        raise RecordingError(
            f'{path}: not closed, as of a recording that goes on or was cut off; '
            f'if it was: rosbag reindex {path}'
        )
    except rosbag.ROSBagException as error:
        raise RecordingError(f'{path}: not a readable bag: {error}')
    except DAMAGE as error:
        raise RecordingError(f'{path}: damaged: {error}')
    except OSError as error:
        raise RecordingError(f'{path}: {error.strerror or error}{_unfinished(path)}')


def _unfinished(path):
    """rosbag record gives a bag its name when it is whole."""
    active = path + '.active'
    return (
        f'; {active} is there: it is still recorded, or was cut off, and then needs '
        f'rosbag reindex {active}'
        if os.path.exists(active)
        else ''
    )


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


def _read_run(bag, path, topics, number):
    runs = _runs(bag, path, topics)
    number = len(runs) if number is None else number
    if not 1 <= number <= len(runs):
        raise RecordingError(f'{path}: no run {number} in it, only 1 .. {len(runs)}')
    info = runs[number - 1]
    recording = Recording(info, len(runs))
    for kind, packed in _packed(bag, topics):
        if kind != RUN_INFO and packed.run_id == info.run_id:
            recording.add(kind, packed)
    return recording


def _runs(bag, path, topics):
    """RunInfo of every run, in the order of their beginnings; each file of a bag that was split has
    it."""
    about = bag.get_type_and_topic_info(topics).topics
    named = [topic for topic in about if about[topic].msg_type == RUN_INFO]
    runs = {}
    for _, packed in _packed(bag, named) if named else ():
        if packed.run_id not in runs:
            runs[packed.run_id] = packed.message()
    if not runs:
        raise RecordingError(f'{path}: no run_info in it; record that topic too')
    return list(runs.values())


def _packed(bag, topics):
    """(type, Packed) of the messages of these topics."""
    messages = bag.read_messages(topics=topics, raw=True)
    for _, raw, _ in Progress('reading').over(messages, bag.get_message_count(topics)):
        yield raw[0], Packed(raw[1], raw[-1])


def in_time(path, types, node=None, number=None):
    """(type, Packed) of these types of one run, as read() chooses it, in the order of simulated
    time: a recorder mixes topics a little."""
    with opened(path) as bag:
        topics = _topics_of_node(bag, path, node, (RUN_INFO, *types))
        runs = _runs(bag, path, topics)
        run_id = runs[-1 if number is None else number - 1].run_id
        kinds = bag.get_type_and_topic_info(topics).topics

        def of(topic):
            for _, raw, _ in bag.read_messages(topics=[topic], raw=True):
                packed = Packed(raw[1], raw[-1])
                if packed.run_id == run_id:
                    yield packed.sim_time(), raw[0], packed

        wanted = [of(topic) for topic in topics if kinds[topic].msg_type in types]
        for _, kind, packed in heapq.merge(*wanted, key=lambda item: item[0]):
            yield kind, packed
