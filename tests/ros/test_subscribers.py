"""Many subscribers, those that stop reading, or come and go, and a master that is restarted: none
of them slows the node, fills its memory or keeps it from ending."""

import os
import random
import signal
import threading
import time

import harness
import links
from harness import MODES, OBSERVABLES, SHORT, TYPES

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

LOST = 30.0  # seconds within which who waits in vain has ended
BOUND = 1.0  # seconds from a request to stop to the end, the contract
MB = 1 << 20
QUEUE_BYTES = 128e6  # of one topic at most, see topics/publishers.c
SLACK = 32 * MB  # of what is fragmented, and the node's own growth
EVERY_TOPIC = dict(
    MODES,
    equilibration=1.0,
    warmup=1.0,
    duration=100.0,
    report_interval=0.25,
    field_interval=0.0,
    observables=OBSERVABLES,
)
# messages of 160 kB, thousands of them in a second
BULKY = dict(
    number=5000, exponents='none', observables=['state'], report_interval=0.02, duration=0.0
)

MESSAGE = 4 * 8 * BULKY['number']
# messages so large that a queue is soon full
BULKIER = dict(BULKY, number=20000, report_interval=0.002)
FULL = QUEUE_BYTES / (4 * 8 * BULKIER['number'])  # messages
STEADY = 200e3  # bytes a second: a third of a message
READS_NOTHING = 5.0  # seconds for which a run waits for one that reads nothing


def resident(node):
    """Bytes."""
    with open('/proc/%d/statm' % node.process.pid) as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE')


def open_files(node):
    return len(os.listdir('/proc/%d/fd' % node.process.pid))


class Subscribers(harness.Case):
    def link(self, port, topic, name='/links'):
        link = links.Link(port, topic, name)
        self.addCleanup(link.close)
        return link

    def read(self, some):
        reader = links.Reader(some)
        self.addCleanup(reader.join, harness.PATIENCE)
        return reader

    def stop(self, node):
        with harness.within(self, BOUND):
            self.interrupt(node)

    def test_stopped_reading(self):
        """What they have not read is dropped; memory stays that of one queue, which they share."""
        node = self.start(dict(BULKY, wait_for_subscribers=['state', 'cost']))
        port = links.node_port(node)
        deaf = [self.link(port, 'state', '/deaf_%d' % k) for k in range(3)]
        for link in deaf:
            link.greet()
        before = resident(node)
        cost = self.link(port, 'cost')
        self.read([cost])
        reports = int(2 * QUEUE_BYTES / MESSAGE)
        self.sees(lambda: len(cost.seqs) > reports)
        self.assertEqual(cost.gaps(), 0)
        self.assertLess(resident(node) - before, QUEUE_BYTES + SLACK)
        self.stop(node)
        self.assertEqual(cost.gaps(), 0)

    def trickle(self, link, every=0.05):
        """Reads a link steadily, STEADY bytes a second; as fast as it goes once that is set."""
        hurry = threading.Event()

        def read():
            while not link.closed:
                if hurry.wait(every):
                    link.read()
                else:
                    link.read(int(STEADY * every))

        threading.Thread(target=read, daemon=True).start()
        self.addCleanup(hurry.set)
        return hurry

    def test_one_does_not_read_and_one_reads_slowly(self):
        """The run waits for each as long as it reads: the slow one misses nothing, and is named."""
        node = self.start(dict(BULKIER, wait_for_subscribers=['state', 'cost', 'status']))
        costs = self.listen('cost')
        port = links.node_port(node)
        dead, slow = (self.link(port, 'state', name) for name in ('/dead', '/slow'))
        dead.greet()
        slow.greet()
        hurry = self.trickle(slow)
        self.listen('status')
        self.sees(lambda: node.lines('/dead has read nothing of /hdlyap/state for 5 s'), node)
        reports = costs.messages[-1].sim_time
        time.sleep(2 * READS_NOTHING)
        self.assertGreater(costs.messages[-1].sim_time, reports)
        self.assertEqual(node.lines('/slow has read nothing'), [])
        self.assertGreater(
            len(node.lines('waits for /slow, which reads /hdlyap/state slowly: ')), 1
        )
        hurry.set()
        self.sees(lambda: len(slow.seqs) > FULL, node)
        self.stop(node)
        self.assertEqual(slow.gaps(), 0)
        cost = costs.all_of(node)[-1]
        self.assertGreater(cost.waiting_seconds, READS_NOTHING)
        self.assertLess(cost.waiting_seconds, cost.wall_seconds)
        self.assertLess(cost.publish_seconds, 0.5 * cost.waiting_seconds)

    def test_run_that_waits_for_nobody(self):
        """Nobody is named who reads nothing; the log says what is lost."""
        node = self.start(
            dict(BULKIER, slow_subscribers='drop', wait_for_subscribers=['state', 'cost'])
        )
        costs = self.listen('cost')
        self.link(links.node_port(node), 'state', '/dead').greet()
        with harness.within(self, READS_NOTHING):
            self.sees(lambda: len(costs.messages) > 2 * FULL, node)
        self.stop(node)
        self.assertEqual(costs.all_of(node)[-1].waiting_seconds, 0.0)
        self.assertEqual(node.lines('has read nothing'), [])
        self.assertEqual(node.lines('waits for'), [])
        self.assertEqual(len(node.lines('messages of /hdlyap/state were not sent to all')), 1)

    def test_flood(self):
        """Thousands of reports in a second, on all topics, nothing else to do."""
        times = dict(equilibration=0.1, warmup=0.1, duration=0.0, report_interval=1.0e-4)
        params = dict(times, number=2, density=0.3, aspect=1.0, exponents='all')
        node = self.start(dict(params, observables=OBSERVABLES, wait_for_subscribers='all'))
        port = links.node_port(node)
        every = {topic: self.link(port, topic) for topic in TYPES}
        before = resident(node)
        self.read(every.values())
        self.sees(lambda: len(every['state'].seqs) > 5000)
        some = [link for topic, link in every.items() if topic != 'run_info']
        queues = sum(1000 * link.bytes / max(len(link.seqs), 1) for link in some)
        self.assertLess(resident(node) - before, queues + SLACK)
        self.stop(node)

    def test_come_and_go(self):
        """Hundreds of times, at all stages of a connection."""
        randomly = random.Random(1)
        node = self.start(dict(EVERY_TOPIC, duration=0.0, pace=25.0, wait_for_subscribers=['cost']))
        port = links.node_port(node)
        cost = self.link(port, 'cost')
        self.read([cost])
        self.sees(lambda: len(cost.seqs) > 10)
        files, before = open_files(node), resident(node)
        for k in range(400):
            guest = links.Link(port, randomly.choice(list(TYPES)), '/guest_%d' % k)
            if randomly.random() < 0.7:
                guest.greet()
            guest.close()
        self.sees(lambda: open_files(node) <= files)
        self.assertLess(resident(node) - before, SLACK)
        now = len(cost.seqs)
        self.sees(lambda: len(cost.seqs) > now + 10)
        self.stop(node)
        self.assertEqual(cost.gaps(), 0)

    def master(self):
        """One of its own, and what finds it."""
        master = harness.Master()
        self.addCleanup(master.stop)
        return master, dict(ROS_MASTER_URI=master.uri)

    def test_nobody_can_come(self):
        """Who waits for subscribers, or for a node to record, ends when the master is killed, or
        hangs; a run that is under way goes on, and all of them say so."""
        killed, of_killed = self.master()
        hanging, of_hanging = self.master()
        self.addCleanup(hanging.send, signal.SIGCONT)
        kept = os.path.join(self.new_folder(), 'kept')
        waiting = dict(SHORT, wait_for_subscribers='all')
        nodes = [
            self.start(dict(waiting, checkpoint=kept), name='one', **of_killed),
            self.start(waiting, name='two', **of_hanging),
        ]
        runs = self.start(dict(SHORT, duration=0.0, pace=5.0), name='three', **of_killed)
        recorder = self.process([harness.program('record'), '_bag:=' + kept], **of_killed)
        for node in nodes:
            self.sees(lambda: node.lines('waiting for subscribers'), node)
        self.sees(lambda: runs.lines('scene '), runs)
        self.sees(lambda: recorder.lines('nobody publishes'), recorder)
        killed.stop()
        hanging.send(signal.SIGSTOP)
        with harness.within(self, LOST):
            for node in nodes:
                self.ends(node, 5, 'does not answer: subscribers that are connected stay so')
                self.assertEqual(len(node.lines('FATAL')), 1, node.text())
            self.ends(recorder, 1, 'no node to record can be found without the ROS master')
        self.assertTrue(os.path.exists(kept))
        self.assertEqual(len(runs.lines('nobody finds this node')), 1, runs.text())
        self.assertTrue(runs.running())
        self.stop(runs)
        hanging.send(signal.SIGCONT)

    def test_master_restarted(self):
        """Connections outlive it; the node ends in an orderly way."""
        master = harness.Master()
        uri, port_of_master = master.uri, int(master.uri.rsplit(':', 1)[1])
        self.addCleanup(master.stop)
        node = self.start(
            dict(SHORT, duration=0.0, pace=20.0, wait_for_subscribers=['cost', 'state']),
            ROS_MASTER_URI=uri,
        )
        port = links.node_port(node, uri)
        some = [self.link(port, topic) for topic in ('cost', 'state')]
        self.read(some)
        for _ in range(3):
            now = len(some[0].seqs)
            self.sees(lambda: len(some[0].seqs) > now + 5)
            master.stop()
            now = len(some[0].seqs)
            self.sees(lambda: len(some[0].seqs) > now + 5)
            master = harness.Master(port_of_master)
            self.addCleanup(master.stop)
        late = self.link(port, 'cost', '/late')
        late.greet()
        self.sees(lambda: node.lines('has registered again'), node)
        self.stop(node)
        self.assertEqual([link.gaps() for link in some], [0, 0])
        self.assertEqual(len(node.lines('stopped at simulated time')), 1, node.text())
