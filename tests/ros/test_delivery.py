"""A recorder misses nothing, and nobody who listens, or does not, holds a run up."""

import os
import re
import signal
import time

import rosbag
import rosgraph

import harness
import links
from hdlyap.msg import RunStatus
from harness import MODES, OBSERVABLES, SHORT, TYPES, Process, is_last

pytestmark = harness.UNDER_A_MASTER

# some hundred messages of each topic, in less than a second
MANY = dict(
    MODES,
    equilibration=1.0,
    warmup=1.0,
    duration=100.0,
    report_interval=0.25,
    field_interval=0.0,
    observables=OBSERVABLES,
    wait_for_subscribers='all',
)
REPORTS, AVERAGED_REPORTS = 408, 400
# thousands of messages of each topic, as fast as they can be made: rosbag keeps 100 of a topic that
# it has not looked at
FLOOD_TOPICS = ('spectrum', 'modes', 'steps', 'state')
FLOOD = dict(
    number=100,
    density=0.4,
    aspect=1.0,
    exponents=20,
    equilibration=1.0,
    warmup=1.0,
    duration=12.0,
    report_interval=0.01,
    observables=list(FLOOD_TOPICS),
    wait_for_subscribers='all',
)
FLOOD_REPORTS, FLOOD_AVERAGED = 1400, 1200


class Delivery(harness.Case):
    def setUp(self):
        self.folder = self.new_folder()

    def record(self, bag, name):
        topics = ['/hdlyap/' + topic for topic in TYPES]
        # not `rosbag record`: that wrapper may end before its recorder has closed the bag
        command = ['rosrun', 'rosbag', 'record', '-O', bag, '--buffsize=0']
        recorder = Process(command + topics + ['__name:=' + name])
        self.addCleanup(links.end, recorder)
        return recorder

    def record_all(self, names):
        """Recorders that the node will know of, by the bags that they write."""
        bags = {os.path.join(self.folder, name + '.bag'): '/' + name for name in names}
        recorders = {bag: self.record(bag, name[1:]) for bag, name in bags.items()}
        master = rosgraph.Master('/test')

        def known():
            subscribed = dict(master.getSystemState()[1])
            return all(
                set(bags.values()) <= set(subscribed.get('/hdlyap/' + topic, ())) for topic in TYPES
            )

        self.sees(known)
        return recorders

    def check_flood(self, bag):
        """header.seq of each topic: from 0, without a gap, as many as reports."""
        seqs = {}
        with rosbag.Bag(bag) as file:
            for topic, message, _ in file.read_messages():
                seqs.setdefault(topic.rsplit('/', 1)[1], []).append(message.header.seq)
        # a latched one comes twice to whom connects while it is published, by roscpp
        seqs['run_info'] = sorted(set(seqs['run_info']))
        counts = dict.fromkeys(('state', 'status', 'cost'), FLOOD_REPORTS)
        counts.update(dict.fromkeys(('spectrum', 'modes', 'steps'), FLOOD_AVERAGED), run_info=1)
        self.assertEqual({topic: len(seq) for topic, seq in seqs.items()}, counts)
        for topic, seq in seqs.items():
            self.assertEqual(seq, list(range(counts[topic])), topic)

    def test_flood_recorded(self):
        """By two recorders, of which one stands still for a second. Where there are too few
        processors for all, they come before the node."""
        recorders = self.record_all(['first', 'second'])
        cost = self.listen('cost')
        node = self.start(FLOOD, command=['nice', '-n', '4', harness.executable()])
        self.assertTrue(cost.wait_for(lambda message: message.sim_time > 4.0))
        one = list(recorders.values())[0]
        one.send(signal.SIGSTOP)
        time.sleep(1.0)
        one.send(signal.SIGCONT)
        self.ends(node)
        self.assertEqual(node.lines('WARN'), [])
        for bag, recorder in recorders.items():
            recorder.send(signal.SIGINT)
            recorder.wait()
            self.check_flood(bag)

    @harness.SECOND_TIER
    def test_recorder_that_stands_still(self):
        """It is not waited for without an end, and what it loses is said."""
        recorder = self.record_all(['record']).popitem()[1]
        cost = self.listen('cost')
        node = self.start(FLOOD)
        self.assertTrue(cost.wait_for(lambda message: message.sim_time > 4.0))
        recorder.send(signal.SIGSTOP)
        with harness.within(self, 15.0):
            self.ends(node)
        self.assertEqual(len(node.lines('/record has read nothing of')), 1, node.text())
        left = [
            re.search(r'has not read the last (\d+) messages of /hdlyap/(\w+)', line).groups()
            for line in node.lines('has not read the last')
        ]
        self.assertEqual(
            sorted(topic for _, topic in left),
            ['cost', 'modes', 'spectrum', 'state', 'status', 'steps'],
        )
        self.assertTrue(all(500 < int(count) <= FLOOD_REPORTS for count, _ in left), left)
        links.end(recorder)

    def test_subscriber_that_stands_still_at_the_end(self):
        """One with rospy drops what its sockets hold when it hears that the node has left: so the
        node leaves once it answers."""
        node = self.start(dict(MANY, wait_for_subscribers=['status'], duration=20.0))
        echo = self.process(['rostopic', 'echo', '/hdlyap/status/stage'])
        self.sees(lambda: '---' in echo.text(), echo)
        echo.send(signal.SIGSTOP)
        self.sees(lambda: node.lines('finished at'))
        time.sleep(1.0)
        self.assertTrue(node.running(), node.text())
        echo.send(signal.SIGCONT)
        self.ends(node)
        self.sees(lambda: echo.text().split()[-2:] == [str(RunStatus.FINISHED), '---'], echo)
        self.assertEqual(node.lines('WARN'), [])

    @harness.SECOND_TIER
    def test_subscriber_that_does_not_answer(self):
        """It is not waited for without an end, and is named."""
        node = self.start(dict(MANY, wait_for_subscribers=['status'], duration=20.0))
        echo = self.process(['rostopic', 'echo', '/hdlyap/status/stage'])
        self.sees(lambda: '---' in echo.text(), echo)
        echo.send(signal.SIGSTOP)
        with harness.within(self, 20.0):
            self.ends(node)
        self.assertRegex(node.text(), 'WARN.* /rostopic_.* does not answer: it may not read the la')
        links.end(echo)

    def test_slow_subscriber(self):
        slow = self.listen('state', delay=0.2)
        status = self.listen('status')
        node = self.start(dict(MANY, wait_for_subscribers=['state', 'status']))
        self.assertTrue(status.wait_for(lambda message: message.sim_time == 90))
        self.assertLess(len(slow.messages), 100)
        self.ends(node)
        self.assertTrue(status.wait_for(is_last))
        slow.delay = 0.0
        self.assertTrue(slow.wait_for(lambda message: message.sim_time == 102))
        self.assertEqual(len(slow.messages), REPORTS)

    def test_waits_for_subscribers(self):
        info = self.listen('run_info')
        state = self.listen('state')
        node = self.start(dict(SHORT, wait_for_subscribers=['state', 'spectrum']))
        self.assertTrue(info.wait_for(lambda message: True))
        self.sees(lambda: node.lines('waiting for subscribers'))
        self.assertEqual(state.messages, [])
        spectrum = self.listen('spectrum')
        self.ends(node)
        self.assertEqual((len(state.messages), len(spectrum.messages)), (4, 2))
        self.assertEqual(node.lines('WARN'), [])

    def links(self, node, topics, name, master=None):
        port = links.node_port(node, master)
        some = [links.Link(port, topic, name) for topic in topics]
        for link in some:
            self.addCleanup(link.close)
            link.greet()
        return some

    @harness.SECOND_TIER
    def test_waits_for_all_who_have_subscribed(self):
        """Each topic has a subscriber at once, but that is not the only one."""
        for topic in TYPES:
            links.register(self, topic, '/early')
            links.register(self, topic, '/late')
        node = self.start(MANY)
        # by then run_info is out: roscpp may send it twice to whom connects while it is published
        self.sees(self.has_services)
        early = self.links(node, TYPES, '/early')
        reader = links.Reader(early)
        time.sleep(0.5)  # as long as the whole run
        late = self.links(node, TYPES, '/late')
        readers = [reader, links.Reader(late)]
        self.ends(node)
        for reader in readers:
            reader.join(harness.PATIENCE)
        for first, second in zip(early, late):
            with self.subTest(topic=first.topic):
                self.assertEqual(
                    len(second.seqs) >= AVERAGED_REPORTS / 2, first.topic != 'run_info'
                )
                self.assertEqual(first.seqs, second.seqs)
        self.assertEqual(node.lines('WARN'), [])

    @harness.SECOND_TIER
    def test_does_not_wait_for_ever(self):
        """For one that has subscribed and is gone."""
        links.register(self, 'cost', '/gone')
        cost, state, status = map(self.listen, ('cost', 'state', 'status'))
        node = self.runs(dict(SHORT, wait_for_subscribers=['cost', 'state']))
        warnings = node.lines('WARN')
        self.assertEqual(len(warnings), 1, node.text())
        # or, on a machine that is busy, that its master has not told it in these seconds
        said = (
            'cost: 1 of 2 subscribers connected after 3 s|: the ROS master does not answer in time'
        )
        self.assertRegex(warnings[0], said)
        self.assertTrue(status.wait_for(is_last))
        said = cost.messages, state.messages
        self.assertTrue(harness.wait_until(lambda: list(map(len, said)) == [4, 4]), said)

    def has_services(self, uri=None):
        """The last that the node asks its master for: until then it would wait for another one."""
        services = rosgraph.Master('/test', uri).getSystemState()[2]
        return '/%s/stop' % harness.NODE in dict(services)

    @harness.SECOND_TIER
    def test_master_dies_before_the_run(self):
        """Or hangs: nobody knows who else has subscribed."""
        for number in (signal.SIGKILL, signal.SIGSTOP):
            with self.subTest(signal=number):
                master = harness.Master()
                self.addCleanup(master.stop)
                node = self.start(
                    dict(SHORT, wait_for_subscribers=['run_info', 'cost']),
                    ROS_MASTER_URI=master.uri,
                )
                cost = self.links(node, ['cost'], '/cost', master.uri)[0]
                self.sees(lambda: node.lines('waiting for subscribers'))
                master.send(number)
                info = links.Link(cost.socket.getpeername()[1], 'run_info')
                self.addCleanup(info.close)
                while len(cost.seqs) < 4 and not cost.closed:
                    cost.read()
                self.assertEqual(len(cost.seqs), 4, node.text())
                self.assertEqual(
                    len(node.lines('the run starts with the subscribers connected now')),
                    1,
                    node.text(),
                )
                master.send(signal.SIGCONT)
                self.ends(node)
