"""bag file -> Recording: what one node said about its last run. Streams, keeps only scalars
and the last spectrum, so a bag may be far larger than the memory."""

import sys

import numpy as np
import rosbag

RUN_INFO, SPECTRUM, COST = 'hdlyap/RunInfo', 'hdlyap/Spectrum', 'hdlyap/Cost'
SMALLEST = 4    # exponents whose course is kept, counted back from the last positive one
STAGES = ('events', 'replay', 'ortho', 'spectrum', 'publish')


class RecordingError(Exception):
    """One line for the user: what is wrong with which bag."""


class Recording:
    """The last run in the bag: its run_info, its last spectrum (None without exponents), the
    course of the averages since their last reset, and the cost over time."""

    def __init__(self, info):
        self.info = info
        self.spectrum = None
        self._history = []
        self._costs = []

    @property
    def positive_end(self):
        """Lyapunov index of the last positive exponent."""
        return (4 * self.info.disks - self.info.zero_exponents) // 2

    @property
    def last_index(self):
        """Lyapunov index of the last exponent carried."""
        return self.spectrum.first_index + len(self.spectrum.exponents) - 1

    @property
    def smallest(self):
        """Lyapunov indices of the smallest positive exponents carried."""
        end = min(self.positive_end, self.last_index)
        return list(range(max(self.spectrum.first_index, end - SMALLEST + 1), end + 1))

    def add_spectrum(self, msg):
        if msg.averaged_time <= 0:
            return
        if self.spectrum is not None and msg.averaged_time < self.spectrum.averaged_time:
            self._history.clear()   # the averages were reset
        self.spectrum = msg
        small = [index - msg.first_index for index in self.smallest]
        self._history.append((msg.averaged_time, msg.lambda_max, msg.std_errors[0],
                              max(msg.std_errors),
                              *(msg.exponents[i] for i in small),
                              *(msg.std_errors[i] for i in small)))

    def add_cost(self, msg):
        self._costs.append((msg.sim_time, msg.phase, msg.wall_seconds,
                            *(getattr(msg, stage + '_seconds') for stage in STAGES)))

    def course(self):
        """Running means against averaged time, unknown errors as NaN."""
        table = np.array(self._history)
        n = len(self.smallest)
        course = {'time': table[:, 0], 'lambda_max': table[:, 1], 'lambda_max_error': table[:, 2],
                  'largest_error': table[:, 3], 'small': table[:, 4:4 + n],
                  'small_errors': table[:, 4 + n:]}
        for name in ('lambda_max_error', 'largest_error', 'small_errors'):
            course[name] = known(course[name])
        return course

    def cost(self):
        """Wall seconds since the start against simulated time, by stage; None if unrecorded."""
        if not self._costs:
            return None
        table = np.array(self._costs)
        cost = {'time': table[:, 0], 'phase': table[:, 1].astype(int), 'wall': table[:, 2]}
        cost.update(zip(STAGES, table[:, 3:].T))
        return cost


def known(errors):
    """Standard errors with the messages' -1 for 'not yet known' as NaN."""
    errors = np.asarray(errors, dtype=float)
    return np.where(errors < 0, np.nan, errors)


def read(path, node=None):
    """The last run of the given node, or of the only node in the bag."""
    try:
        with rosbag.Bag(path) as bag:
            return _read_run(bag, path, _topics_of_node(bag, path, node))
    except rosbag.ROSBagUnindexedException:
        raise RecordingError(f'{path}: not closed properly; repair it with rosbag reindex')
    except rosbag.ROSBagException as error:
        raise RecordingError(f'{path}: not a readable bag: {error}')
    except OSError as error:
        raise RecordingError(f'{path}: {error.strerror or error}')


def _topics_of_node(bag, path, node):
    """{topic: type} of the messages of ours, below one node's name."""
    nodes = {}
    for topic, entry in bag.get_type_and_topic_info().topics.items():
        if entry.msg_type in (RUN_INFO, SPECTRUM, COST):
            nodes.setdefault(topic.rpartition('/')[0], {})[topic] = entry.msg_type
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
    messages = bag.read_messages(topics=list(topics))
    for topic, msg, _ in _with_progress(messages, bag.get_message_count(list(topics))):
        if topics[topic] == RUN_INFO:
            if recording is None or recording.info.run_id != msg.run_id:
                recording = Recording(msg)
        elif recording is not None and recording.info.run_id == msg.run_id:
            recording.add_spectrum(msg) if topics[topic] == SPECTRUM else recording.add_cost(msg)
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
