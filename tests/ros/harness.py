"""Starts hdlyap_node as a process of its own, as a user would, and sees what it does."""

import contextlib
import functools
import glob
import itertools
import os
import shutil
import signal
import subprocess
import tempfile
import threading
import time
import unittest
import uuid
import weakref

import pytest
import roslib.packages
import rosgraph
import rospy
import yaml

import measured
from hdlyap import parameters, topics  # noqa: F401  which reads parameters as fields
from hdlyap.msg import Mode, RunStatus
from hdlyap.runs.ranks import free_port

UNDER_A_MASTER = pytest.mark.under_a_master  # rostest runs this file
SECOND_TIER = pytest.mark.second_tier  # a test, a class or a file of tests/run.sh --all
NODE = 'hdlyap'
# a run of a fraction of a second
SHORT = dict(number=20, density=0.7, aspect=1.0, equilibration=1.0, warmup=1.0, duration=2.0)
# a box so long that its steps are found within a second
MODES = dict(number=60, density=0.8, aspect=0.06, equilibration=10.0, warmup=60.0, duration=20.0)
# reports come at the same times whatever the speed; nobody's listening changes what is computed
REPEATABLE = dict(
    number=60,
    density=0.8,
    aspect=0.06,
    equilibration=5.0,
    warmup=20.0,
    duration=30.0,
    threads=1,
    report_interval=0.5,
    observables=['spectrum', 'modes', 'steps', 'lp_phases', 'fields', 'state'],
    field_interval=3.0,
    wait_for_subscribers='all',
)
OF_OTHERS = {'averages'}  # topics that disks do not have
# of a scene of disks that may be short: covariant vectors need long transients
UNSEEN = {'covariant', *OF_OTHERS}
TYPES = {name: kind for name, kind in topics.RECORDED.items() if name not in UNSEEN}
OBSERVABLES = [topic for topic in TYPES if topic not in ('run_info', 'status', 'cost')]
# in every report of the averaging
AVERAGES = 'spectrum', 'modes', 'steps', 'lp_phases', 't_phases', 'hydro', 'structure'
AVERAGES += 'localization', 'fluctuations', 'gas'
PATIENCE = 60.0  # seconds, for what has no bound of its own
# seconds within which all has ended that was asked to, on a busy machine: roslaunch alone takes up
# to 17
SOON = 90.0
POLL = 0.1  # seconds between two looks at all processes, each of which takes some ms


@functools.lru_cache(maxsize=None)
def program(name):
    return roslib.packages.find_node('hdlyap', name)[0]


def command(name):
    """Of hdlyap, as a user types it."""
    return [shutil.which('hdlyap'), name]


def executable():
    return program('hdlyap_node')


def defaults():
    """Every parameter, as the node prints them."""
    return yaml.safe_load(subprocess.check_output([executable(), '--parameters'], text=True))


def probed(command=None):
    """Environment in which probe.c, built beside the node, stands before the functions of a command
    (None: of the node, whose core then hides none)."""
    folder = os.path.dirname(executable())
    names = ['hdlyap_probe.so'] if command else ['hdlyap_probe.so', 'open/libhdlyap_core.so.0']
    return {'LD_PRELOAD': ':'.join(os.path.join(folder, name) for name in names)}


def wait_until(condition, seconds=PATIENCE, every=0.01):
    """The condition's value, as soon as it is true, at the latest after so many seconds."""
    end = time.monotonic() + seconds
    while True:
        value = condition()  # looked at once: it may be true for a moment only
        if value or time.monotonic() >= end:
            return value
        time.sleep(every)


def slowness():
    """How many times as long as its own processor time a moment of work takes: 1 if nobody else
    computes."""
    begin, spent = time.monotonic(), time.thread_time()
    while time.thread_time() - spent < 0.05:
        pass
    return max(1.0, (time.monotonic() - begin) / 0.05)


@contextlib.contextmanager
def within(test, seconds):
    """Fails if a block takes longer than so many seconds of a machine that does nothing else. On a
    slower or busy one it may take longer by the same factor (slowness)."""
    slow, begin = slowness(), time.monotonic()
    yield
    taken = time.monotonic() - begin
    test.assertLess(taken, seconds * max(slow, slowness()))


class Process:
    """A process whose output is kept; stopped at the latest by stop()."""

    def __init__(self, command, **env):
        self.output = tempfile.TemporaryFile('w+')
        folder = tempfile.mkdtemp()  # what it leaves there when it is killed goes with this object
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        self.process = subprocess.Popen(
            command,
            stdout=self.output,
            stderr=subprocess.STDOUT,
            env=dict(os.environ, TMPDIR=folder, **env),
        )

    def send(self, number):
        self.process.send_signal(number)

    def wait(self, seconds=PATIENCE):
        """Exit status; raises subprocess.TimeoutExpired."""
        return self.process.wait(seconds)

    def running(self):
        return self.process.poll() is None

    def text(self):
        # opened again: a process shares its place in the file, and would write over what is read
        # from the start
        with open('/proc/self/fd/%d' % self.output.fileno(), errors='replace') as file:
            return file.read()

    def lines(self, word):
        return [line for line in self.text().splitlines() if word in line]

    def stop(self):
        if self.running():
            self.send(signal.SIGKILL)
            self.wait()

    def end(self):
        """Stopped, but it may say so before. Its master would go on telling its port who publishes,
        or to shut down: a node of another test may have it by then."""
        if self.running():
            self.send(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                self.wait(2.0)
        self.stop()


class Master(Process):
    """A ROS master that can be killed."""

    def __init__(self, port=None):
        port = port or free_port()
        self.uri = 'http://localhost:%d' % port
        super().__init__(['rosmaster', '--core', '-p', str(port)])
        assert wait_until(lambda: rosgraph.is_master_online(self.uri))


def start(params, name=NODE, probe=None, args=(), command=None, **env):
    """hdlyap_node with exactly these private parameters; probe: what probe.c is asked for; command:
    another build of it, and what that is run by."""
    master = rosgraph.Master('/harness', env.get('ROS_MASTER_URI'))
    master.setParam('/' + name, params)
    if probe is not None:
        env.update(probe, **probed(command))
    return Process([*(command or [executable()]), '__name:=' + name, *args], **env)


def start_viewer(params=(), **how):
    """With exactly these private parameters, as the node /viewer."""
    return start(dict(params), name='viewer', command=[program('viewer')], **how)


def counts(test, params):
    """What probe.c has counted of a run that ends by itself, by name without hd_."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'counts')
        node = start(params, probe={'PROBE_COUNTS': path})
        test.addCleanup(node.stop)
        test.assertEqual(node.wait(), 0, node.text())
        with open(path) as file:
            return {name: int(count) for name, count in map(str.split, file)}


def calls(test, params):
    """Of functions of the core that compute something for somebody, and of those that publish."""
    return {name: count for name, count in counts(test, params).items() if name != 'memory_alloc'}


def examples(steps):
    """Numbers of those of which a field is published: found, in the positive half, the first of its
    set."""
    first = {}
    for number, step in enumerate(steps):
        if step.resolved and not step.conjugate and step.kind != Mode.ZERO:
            first.setdefault(step.set, number)
    return list(first.values())


class Listener:
    """All messages of one of the node's topics, in the order of their arrival."""

    def __init__(self, topic, delay=0.0):
        self.messages = []
        self.delay = delay
        self.arrived = threading.Condition()
        self.subscriber = rospy.Subscriber(
            '/%s/%s' % (NODE, topic), topics.TYPES[topic], self.keep, queue_size=None
        )

    def keep(self, message):
        time.sleep(self.delay)
        with self.arrived:
            self.messages.append(message)
            self.arrived.notify_all()

    def wait_for(self, condition, seconds=PATIENCE):
        """True once a message fulfils the condition."""
        with self.arrived:
            return self.arrived.wait_for(lambda: any(map(condition, self.messages)), seconds)

    def all_of(self, node):
        """Messages of a node that ends: the last ones are still read when it has."""
        node.wait()
        wait_until(lambda: not self.subscriber.get_num_connections())
        self.close()
        return self.messages

    def close(self):
        self.subscriber.unregister()


def service(name, kind, node=NODE):
    """To be called, once it is there."""
    full = '/%s/%s' % (node, name)
    rospy.wait_for_service(full, PATIENCE)
    return rospy.ServiceProxy(full, kind)


def is_last(status):
    """Whether it is the last one of a run."""
    return status.stage == RunStatus.FINISHED


def whole_run(params, topics):
    """All messages of a run that ends by itself, {topic: messages}."""
    listeners = {topic: Listener(topic) for topic in ('status', *topics)}
    node = start(params)
    try:
        messages = {topic: listener.all_of(node) for topic, listener in listeners.items()}
    finally:
        node.stop()
    assert node.wait() == 0, node.text()
    return messages


class Case(unittest.TestCase):
    """Nodes, other processes, listeners and folders that end with the test."""

    def start(self, params, **how):
        node = start(params, **how)
        self.addCleanup(node.end)
        return node

    def process(self, command, **env):
        process = Process(command, **env)
        self.addCleanup(process.end)
        return process

    def runs(self, params, **how):
        """A node that ends by itself."""
        node = self.start(params, **how)
        self.ends(node)
        return node

    def recorded(self, params, stop_after=None, **how):
        """{topic: messages} of a run, interrupted from a simulated time on if there is one."""
        topics = ['run_info', 'status', 'cost', *params['observables']]
        listeners = {topic: self.listen(topic) for topic in topics}
        node = self.start(params, **how)
        if stop_after:
            listeners['state'].wait_for(lambda message: message.sim_time >= stop_after)
            node.send(signal.SIGINT)
        messages = {topic: listener.all_of(node) for topic, listener in listeners.items()}
        self.ends(node)
        return messages

    def assert_same_bits(self, messages, wanted):
        """But for what the clock and the run's name are; assertEqual would look for the difference
        of so long bytes for hours."""
        pairs = itertools.zip_longest(measured.bits(messages), measured.bits(wanted))
        differ = [number for number, (one, other) in enumerate(pairs) if one != other]
        self.assertEqual(differ[:1], [], f'first of {len(differ)} that differ')

    def ends(self, process, status=0, *words):
        self.assertEqual(process.wait(), status, process.text())
        for word in words:
            self.assertIn(word, process.text())

    def interrupt(self, process, status=0):
        process.send(signal.SIGINT)
        self.assertEqual(process.wait(), status, process.text())

    def sees(self, condition, process=None, **how):
        """Waits until it is true; a process is one that tells why it is not."""
        self.assertTrue(wait_until(condition, **how), process and process.text())

    def listen(self, topic, **how):
        listener = Listener(topic, **how)
        self.addCleanup(listener.close)
        return listener

    def hear(self, topic, kind):
        """All messages of any topic."""
        heard = []
        subscriber = rospy.Subscriber(topic, kind, heard.append, queue_size=None)
        self.addCleanup(subscriber.unregister)
        return heard

    def new_folder(self, **how):
        folder = tempfile.TemporaryDirectory(**how)
        self.addCleanup(folder.cleanup)
        return folder.name


class InFolder(unittest.TestCase):
    """A folder that goes with the test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)


class Traced(unittest.TestCase):
    """Processes that begin others: those are found by what they inherit."""

    def trace(self):
        self.mark = uuid.uuid4().hex
        self.addCleanup(self.kill_all)

    def ours(self, word='', variable=''):
        """Processes of this test whose command line has the word, and whose environment has the
        variable."""
        found = []
        for folder in glob.glob('/proc/[0-9]*'):
            with contextlib.suppress(OSError), open(folder + '/environ', 'rb') as environ, open(
                folder + '/cmdline', 'rb'
            ) as command:
                has = environ.read().decode(errors='replace').split('\0') + ['']
                if {'HDLYAP_MARK=' + self.mark, variable} <= set(
                    has
                ) and word.encode() in command.read():
                    found.append(int(os.path.basename(folder)))
        return found

    def kill_all(self):
        for pid in self.ours():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

    def assert_none_left(self):
        self.assertTrue(wait_until(lambda: not self.ours(), SOON, POLL), self.ours())
