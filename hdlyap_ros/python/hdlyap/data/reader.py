"""A bag -> the messages of one node, one after the other. This is the only module that opens a bag.
It streams, so a bag may be far larger than memory. Anything wrong with a bag raises RecordingError.
Texts in a bag may come from anybody, so control characters are replaced and long texts are cut."""

import contextlib
import math
import os
import re
import stat
import struct

import rosbag

from hdlyap import fault, topics
from hdlyap.progress import Progress

from . import space
from .possible import check

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TYPES = {message._type: message for message in topics.RECORDED.values()}
RUN_INFO, SPECTRUM = 'hdlyap/RunInfo', 'hdlyap/Spectrum'
STATUS, COST = 'hdlyap/RunStatus', 'hdlyap/Cost'
PHASES, T_PHASES = 'hdlyap/LpPhases', 'hdlyap/TPhases'
FIELD, STATE = 'hdlyap/ModeField', 'hdlyap/State'
HYDRO = 'hdlyap/Hydro'
# messages with means: the kind of the number that follows sim_time
AMOUNTS = {'averaged_time': '<d', 'samples': '<I'}
FOURTH = {kind: message.__slots__[3] for kind, message in TYPES.items()}
MEANS = {kind: AMOUNTS[slot] for kind, slot in FOURTH.items() if slot in AMOUNTS}
NAME, PATH, LINE, LIST = 200, 4096, 8192, 4096  # longest text, path, error; most elements of a list
PATHS = ('value', 'effect', 'given')
VERSION = re.compile(r'\d[\w.+~-]{0,30}', re.ASCII)
FIRST_LINE = 100  # bytes that the first line of a bag (#ROSBAG V2.0) never has


class RecordingError(Exception):
    """The text is a line for the user: what is wrong with which bag."""

    def __init__(self, text):
        super().__init__(plain(text, LINE))


class Missing(RecordingError):
    """Something was not recorded, or not measured."""


class NoInfo(Missing):
    """Something needs run_info, which was not recorded."""


def plain(text, longest=NAME):
    """A text that a terminal shows in one line and does not obey; at most `longest` characters."""
    text = text if len(text) <= longest else text[: longest - 3] + '...'
    return ''.join(
        letter if letter.isprintable() else ' ' if letter.isspace() else '?' for letter in text
    )


class Packed:
    """A serialised message of hdlyap. Unpacking all messages, most of which are not needed, would
    cost more than all else. Every message but run_info begins with header, run_id and sim_time,
    which are read from the bytes."""

    def __init__(self, path, kind, data, recorded):
        self.path, self.kind, self.recorded = path, kind, recorded  # its type, its time in the bag
        self.info = None  # run_info, if it is known
        self._data = data
        _, after_frame = self._string(12)  # after seq and stamp
        self.run_id, self._after_run_id = self._string(after_frame)

    def _string(self, at):
        (length,) = struct.unpack_from('<I', self._data, at)
        return self._data[at + 4 : at + 4 + length].decode(), at + 4 + length

    @property
    def seq(self):
        return struct.unpack_from('<I', self._data)[0]

    @property
    def sim_time(self):
        return struct.unpack_from('<d', self._data, self._after_run_id)[0]

    @property
    def averaged_time(self):
        """averaged_time of a message with means, where it follows sim_time."""
        return self.amount

    @property
    def amount(self):
        """How much is in the means of a message: averaged_time or samples, by MEANS."""
        return struct.unpack_from(MEANS[self.kind], self._data, self._after_run_id + 8)[0]

    @property
    def version(self):
        """version of a RunInfo, where it follows run_id."""
        return self._string(self._after_run_id)[0]

    def field_index(self):
        """The Lyapunov index of a ModeField, where it follows sim_time."""
        return struct.unpack_from('<I', self._data, self._after_run_id + 8)[0]

    def field_wave(self, directions=2):
        """kind, nx, ny and, in space, nz of a ModeField, where they follow the index."""
        return struct.unpack_from('<B' + directions * 'I', self._data, self._after_run_id + 12)

    def message(self, numpy=None):
        """The message. Its arrays are lists or, given the module numpy, numpy arrays, which share
        memory with the packed message."""
        blank = TYPES[self.kind]()
        try:
            if numpy:
                blank.deserialize_numpy(self._data, numpy)
            else:
                blank.deserialize(self._data)
            check(blank, self.info)
        except Exception as error:  # damaged bytes make genpy raise anything
            if _is_of_another(error):
                raise
            raise _damaged(self.path, error)
        return blank


def run_infos(path, node=None):
    """{run_id: run_info} of every run of the given node, or of the only one in the bag, in their
    order. run_info is published again after each change of a parameter; the one with most changes
    is taken."""
    with opened(path) as bag:
        topics = _topics(bag, path, node, (RUN_INFO,))
        runs = {}
        for packed in _packed(bag, topics):
            info = _cleaned(packed.message())
            if packed.run_id not in runs or changes(info) > changes(runs[packed.run_id]):
                runs[packed.run_id] = info
        if not runs:
            raise NoInfo(f'{path}: no run_info in it; record that topic too')
        return runs


def without_info(path, node=None):
    """{run_id: Unknown} of every run in a bag without run_info, in their order."""
    runs = {}
    for packed in messages(path, node):
        runs.setdefault(packed.run_id, {})[packed.kind] = packed
    lasts = {run_id: [one.message() for one in of.values()] for run_id, of in runs.items()}
    return {run_id: Unknown(path, run_id, told) for run_id, told in lasts.items()}


class Unknown:
    """Stands for the run_info of a run whose bags have none. Its messages show whether there is a
    direction z, whether particles turn and whether there are two kinds; every other parameter
    raises NoInfo."""

    def __init__(self, path, run_id, told):
        self.path, self.run_id, self.changes = path, run_id, ()
        self.dimension = 3 if space.shows(told, ('z', 'nz')) else 2
        self.kind_numbers = (0,) * (1 + space.shows(told, ('second_kind', 'collision_rate_12')))
        self.inertia = math.inf if space.shows(told, ('angle', 'rotation')) else 0.0

    def __getattr__(self, name):
        if name.startswith('__'):
            raise AttributeError(name)
        raise NoInfo(f'{self.path}: no run_info in it, so {name} is not known')


def is_known(info):
    return not isinstance(info, Unknown)


def changes(info):
    """The number of changes of parameters during the run."""
    return len(info.changes)


def _cleaned(info):
    for name, kind in zip(info.__slots__, info._slot_types):
        value, longest = getattr(info, name), PATH if name in PATHS else NAME
        if kind == 'string':
            setattr(info, name, plain(value, longest))
        elif kind == 'string[]':
            setattr(info, name, [plain(text, longest) for text in value[:LIST]])
        elif kind.endswith('[]'):
            setattr(info, name, value[:LIST])
    for part in (*getattr(info, 'changes', ()), *getattr(info, 'parameters', ())):  # have none
        _cleaned(part)
    return info


def messages(path, node=None, kinds=TYPES, at=None):
    """Yields packed messages of these types from the given node, or from the only one in the bag,
    in their order. at: only messages that were recorded at this time."""
    with opened(path) as bag:
        yield from _packed(bag, _topics(bag, path, node, kinds), at)


def start(path, node, run_id):
    """The simulated time of the first message of a run in a bag."""
    later = messages(path, node, [kind for kind in TYPES if kind != RUN_INFO])
    return next((packed.sim_time for packed in later if packed.run_id == run_id), math.inf)


def recorded(bag, topics=None, at=None):
    """Yields (topic, (type, data, ..), time) in the order in which messages came. rosbag would sort
    by time, and mix them if the clock was set back."""
    index = bag._get_entries(bag._get_connections(topics))
    places = sorted(entry.position for entry in index if at is None or entry.time == at)
    return (_read(bag, place) for place in places)


def _read(bag, place):
    """Reads a message. rosbag would make a program from the definition in the bag and run it, which
    would let a bag run code. Messages of hdlyap are read with the installed definitions."""
    made = rosbag.bag._get_message_type
    rosbag.bag._get_message_type = lambda connection: None
    try:
        return bag._read_message(place, raw=True)
    finally:
        rosbag.bag._get_message_type = made


@contextlib.contextmanager
def opened(path):
    """Opens a bag as a rosbag.Bag."""
    try:
        _refuse_no_bag(path)
        with rosbag.Bag(path) as bag:
            yield bag
    except RecordingError:
        raise
    except rosbag.ROSBagUnindexedException:
        raise RecordingError(
            f'{path}: not closed: its recording goes on, or was cut off and needs '
            f'rosbag reindex {path}'
        )
    except rosbag.ROSBagException as error:
        raise RecordingError(f'{path}: not a readable bag: {error}')
    except Exception as error:  # damaged bytes make rosbag and genpy raise anything
        if _is_of_another(error):
            raise
        if isinstance(error, OSError):
            raise RecordingError(f'{path}: {error.strerror or error}{_unfinished(path)}')
        if isinstance(error, MemoryError):
            raise RecordingError(f'{path}: needs more memory than there is')
        raise _damaged(path, error)


def _is_of_another(error):
    """Whether an error is not the fault of a bag: somebody has not answered, or this package has a
    mistake."""
    if isinstance(error, ConnectionError):
        return True
    return (
        isinstance(error, fault.OURS) and fault.is_in(error, PACKAGE) or fault.is_of_others(error)
    )


def _refuse_no_bag(path):
    """Refuses a file for whose first line rosbag would wait, or read on forever."""
    if not stat.S_ISREG(os.stat(path).st_mode):
        raise RecordingError(f'{path}: not a readable bag: no regular file')
    with open(path, 'rb') as file:
        if len(file.readline(FIRST_LINE)) == FIRST_LINE:
            raise RecordingError(f'{path}: not a readable bag: its first line is not that of a bag')


def _damaged(path, error):
    return RecordingError(f'{path}: damaged: {str(error) or type(error).__name__}')


def _unfinished(path):
    """A hint if the bag is still being recorded: rosbag record renames it at the end."""
    active = path + '.active'
    return (
        f'; {active} is there: it is still recorded, or was cut off, and then needs '
        f'rosbag reindex {active}'
        if os.path.exists(active)
        else ''
    )


def _topics(bag, path, node, kinds):
    """The topics of one node with messages of these types."""
    nodes = {}
    for one in bag._get_connections():
        if one.datatype in TYPES:
            nodes.setdefault(one.topic.rpartition('/')[0], []).append(one)
    if not nodes:
        raise RecordingError(f'{path}: nothing in it was published by hdlyap_node')
    names = ', '.join(sorted(nodes))
    if node is None and len(nodes) > 1:
        raise RecordingError(f'{path}: several nodes, choose one with --node: {names}')
    wanted = next(iter(nodes)) if node is None else '/' + node.strip('/')
    if wanted not in nodes:
        raise RecordingError(f'{path}: no node {node} in it, only {names}')
    refuse_others(bag, nodes[wanted])
    return list(dict.fromkeys(one.topic for one in nodes[wanted] if one.datatype in kinds))


def refuse_others(bag, connections):
    """Refuses messages of hdlyap whose definition differs from the installed one."""
    for one in connections:
        if one.datatype in TYPES and one.md5sum != TYPES[one.datatype]._md5sum:
            raise RecordingError(
                f'{bag.filename}: {_writer(bag, connections)}, whose message {one.datatype} '
                'differs from the installed one: read the bag with the version that wrote it'
            )


def _writer(bag, connections):
    infos = [one.topic for one in connections if one.datatype == RUN_INFO]
    with contextlib.suppress(Exception):  # another version may have anything there
        _, raw, time = next(iter(recorded(bag, infos)))
        found = VERSION.fullmatch(Packed(bag.filename, RUN_INFO, raw[1], time).version)
        return f'written by hdlyap {found.group()}'
    return 'written by another version of hdlyap'


def _packed(bag, topics, at=None):
    """Yields the packed messages of these topics; none if there is no topic."""
    if topics:
        found = recorded(bag, topics, at)
        for _, raw, time in Progress('reading').over(found, bag.get_message_count(topics)):
            yield Packed(bag.filename, raw[0], raw[1], time)
