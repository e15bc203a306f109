"""What may happen to a node on a machine that is short of something, or in hands that send signals:
it ends with the status that stands for it and one line that names it, or goes on; it never
crashes."""

import os
import random
import resource
import signal
import tempfile
import time

from std_srvs.srv import SetBool

import harness
import links
from harness import MODES, OBSERVABLES, SHORT

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

BOUND = 1.0  # seconds from a request to stop to the end, the contract
FAULT = 3  # exit status
MB = 1 << 20
AT_ONCE = 5  # nodes that run at the same time
# all stages, with two threads: OpenBLAS and OpenMP start theirs
THREADED = dict(MODES, warmup=10.0, duration=5.0, observables=OBSERVABLES, threads=2)
ENDLESS = dict(SHORT, number=100, duration=0.0)
LIMITS = [limit * MB for limit in range(160, 1360, 60)]
ENOUGH = 1600 * MB  # of address space, for two threads
STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def limited(limit):
    """Before the program: so much address space, and two processors as far as OpenBLAS sees."""
    return ['prlimit', '--as=%d' % limit, 'env', 'OMP_NUM_THREADS=2']


class Faults(harness.Case):
    @classmethod
    def setUpClass(cls):
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup's would be handed on

    def running(self, params, **kw):
        """A node whose topics are there, and its messages of cost, which it has waited for."""
        node = self.start(dict(params, wait_for_subscribers=['cost']), **kw)
        cost = links.Link(links.node_port(node), 'cost')
        self.addCleanup(cost.close)
        self.addCleanup(links.Reader([cost]).join, harness.PATIENCE)
        self.sees(lambda: len(cost.seqs) > 0)
        return node, cost

    def test_no_address_of_a_master(self):
        """roscpp would die of these."""
        for address in '', 'localhost:1', 'ftp://localhost:1', 'http://localhost':
            for words, own in (([], address), (['__master:=' + address], 'http://localhost:1')):
                node = self.process([harness.executable(), *words], ROS_MASTER_URI=own)
                self.ends(node, 2, "ROS_MASTER_URI = '%s': must be http://HOST:PORT" % address)
                self.assertEqual(len(node.text().strip().splitlines()), 1, node.text())

    def goes_on(self, node, cost):
        now = len(cost.seqs)
        self.sees(lambda: len(cost.seqs) > now + 5, node)
        self.assertEqual(cost.gaps(), 0)

    def stops(self, node, numbers=(signal.SIGINT,)):
        with harness.within(self, BOUND):
            for number in numbers:
                node.send(number)
            self.ends(node)

    def check_out_of_memory(self, node):
        self.ends(node, FAULT)
        self.assertEqual(len(node.lines('FATAL')), 1, node.text())
        self.assertEqual(len(node.lines('out of memory')), 1, node.text())

    # ---- memory ----

    def test_address_space(self):
        """Everything between too little to begin with and enough."""
        for params in (THREADED, dict(THREADED, exponents='none', observables=['state'])):
            ends = []
            for first in range(0, len(LIMITS), AT_ONCE):
                nodes = [
                    self.start(
                        params,
                        name='limited_%d' % k,
                        command=[*limited(limit), harness.executable()],
                    )
                    for k, limit in enumerate(LIMITS[first : first + AT_ONCE])
                ]
                ends += [node.wait() for node in nodes]
                for node in nodes:
                    if node.wait() != 0:
                        self.check_out_of_memory(node)
            self.assertEqual(ends[0], FAULT)
        self.runs(THREADED, command=[*limited(ENOUGH), harness.executable()])

    def test_no_thread_to_begin_with(self):
        """A node that could not be created returns from main: no destructor may run then, of
        roscpp's that has started by half (or of the probe's, which writes the counts)."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'counts')
            for threads in '01234':
                viewer = harness.start_viewer(
                    probe={'PROBE_THREADS': threads, 'PROBE_COUNTS': path}
                )
                self.addCleanup(viewer.end)
                self.ends(viewer, FAULT)
                self.assertEqual(len(viewer.lines('FATAL')), 1, viewer.text())
                self.assertFalse(os.path.exists(path), threads)

    def test_each_part_of_the_run(self):
        """Memory is out for the core, from its first block to the last one, which a report
        needs."""
        blocks = harness.counts(self, dict(SHORT, observables=OBSERVABLES))['memory_alloc']
        self.assertGreater(blocks, 100)
        moments = [1] + [blocks * k // 6 for k in range(1, 6)]
        moments += range(blocks - 8, blocks)  # of the report, of the first interval
        for first in range(0, len(moments), AT_ONCE):
            nodes = [
                self.start(
                    dict(SHORT, observables=OBSERVABLES),
                    name='short_%d' % k,
                    probe={'PROBE_MEMORY_AFTER': str(after)},
                )
                for k, after in enumerate(moments[first : first + AT_ONCE])
            ]
            for node in nodes:
                self.check_out_of_memory(node)

    def test_limit_in_mid_run(self):
        """Not a byte more than it has. Messages that find no room are named, the run goes on."""
        node, cost = self.running(
            dict(
                number=20000,
                exponents='none',
                equilibration=0.1,
                duration=0.0,
                report_interval=0.02,
            )
        )
        deaf = links.Link(links.node_port(node), 'state', '/deaf')
        self.addCleanup(deaf.close)
        with open('/proc/%d/statm' % node.process.pid) as file:
            size = int(file.read().split()[0]) * os.sysconf('SC_PAGE_SIZE')
        resource.prlimit(node.process.pid, resource.RLIMIT_AS, (size, size))
        for _ in range(20):
            self.goes_on(node, cost)
        self.stops(node)

    # ---- threads ----

    def test_threads_that_are_not_granted(self):
        """OpenBLAS would wait for them for ever."""
        for limit, granted in (
            (dict(OMP_THREAD_LIMIT='1'), 1),
            (dict(OMP_MAX_ACTIVE_LEVELS='0'), 1),
            (dict(OMP_DYNAMIC='true'), 2),
        ):
            with self.subTest(limit=limit):
                node = self.runs(THREADED, **limit)
                self.assertRegex(node.text(), rf'\b{granted} threads?\b')
                said = node.lines('OpenMP grants 1 of 2 threads')
                self.assertEqual(len(said), 2 - granted, node.text())

    # ---- signals ----

    def test_hangup(self):
        node, _ = self.running(ENDLESS)
        self.stops(node, [signal.SIGHUP])
        self.assertEqual(len(node.lines('stopped at simulated time')), 1, node.text())

    def test_ignored(self):
        """Hangups below nohup, and somebody else's alarm."""
        for number, before in ((signal.SIGHUP, ['nohup']), (signal.SIGALRM, [])):
            command = [*before, harness.executable()]
            node, cost = self.running(dict(ENDLESS, pace=20.0), command=command)
            node.send(number)
            self.goes_on(node, cost)
            self.stops(node)

    def test_closed_output(self):
        """Nobody reads what it says: SIGPIPE."""
        node, cost = self.running(
            dict(ENDLESS, pace=20.0),
            command=['bash', '-c', 'exec "$@" > >(true) 2>&1', 'bash', harness.executable()],
        )
        self.goes_on(node, cost)
        self.stops(node)

    def test_stopped_and_continued(self):
        node, cost = self.running(dict(ENDLESS, pace=20.0))
        for seconds in (0.1, 1.5):
            node.send(signal.SIGSTOP)
            time.sleep(seconds)
            now = len(cost.seqs)
            time.sleep(0.1)
            self.assertEqual(len(cost.seqs), now)
            node.send(signal.SIGCONT)
            self.goes_on(node, cost)
        self.stops(node)

    def burst(self, randomly):
        kinds = STOPS + (signal.SIGCONT, signal.SIGPIPE, signal.SIGALRM, signal.SIGWINCH)
        return [signal.SIGINT] + randomly.choices(kinds, k=30)

    def test_bursts(self):
        """At any stage: equilibrating, averaging, paused, in a step that outlasts the node."""
        randomly = random.Random(3)
        stages = dict(
            equilibrating=(dict(ENDLESS, equilibration=1e6), {}),
            averaging=(ENDLESS, {}),
            paused=(ENDLESS, {}),
            step=(dict(ENDLESS, report_interval=1.0e-3), dict(probe={'PROBE_STEP_SECONDS': '0.7'})),
        )
        for stage, (params, how) in stages.items():
            with self.subTest(stage=stage):
                node, _ = self.running(params, **how)
                if stage == 'paused':
                    self.assertTrue(harness.service('pause', SetBool)(True).success)
                self.stops(node, self.burst(randomly))

    def test_at_any_moment_of_the_start(self):
        """Before main nobody but the kernel answers a signal; not a line has been printed then."""
        for delay in (0.0, 0.01, 0.02, 0.04, 0.08, 0.16):
            nodes = [self.start(ENDLESS, name='starting_%d' % number) for number in STOPS]
            time.sleep(delay)
            with harness.within(self, BOUND):
                for node, number in zip(nodes, STOPS):
                    node.send(number)
                for node, number in zip(nodes, STOPS):
                    if node.wait() != 0:
                        self.assertEqual((node.wait(), node.text()), (-number, ''))

    # ---- the disk that logs go to ----

    def test_full_disk_of_the_log(self):
        """What a node says is lost with the disk; what it computes is not."""
        for args in (['__log:=/dev/full'], ['__log:=/nowhere/at/all.log'], ['__log:=/']):
            with self.subTest(args=args):
                self.runs(
                    SHORT,
                    args=args,
                    command=['sh', '-c', 'exec "$@" >/dev/full', 'sh', harness.executable()],
                )
