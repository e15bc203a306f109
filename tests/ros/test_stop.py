"""Asked to stop, the node ends within a second, whatever it is doing, and with its last message."""

import signal
import time
import xmlrpc.client

import rosgraph

import harness
import links
from harness import SHORT, is_last

pytestmark = harness.UNDER_A_MASTER

BOUND = 1.0  # seconds, the contract
ENDLESS = dict(SHORT, number=100, duration=0.0)


class Stop(harness.Case):
    def stop(self, node, ask=None):
        with harness.within(self, BOUND):
            (ask or (lambda: node.send(signal.SIGINT)))()
            self.ends(node)

    def check_stopped(self, status, spectrum):
        """Nothing is missing up to the last message."""
        self.assertTrue(is_last(status[-1]))
        times = [int(message.sim_time) for message in status]
        self.assertEqual(times[:-1], list(range(times[0], times[0] + len(times) - 1)))
        averaged = [int(message.sim_time) for message in spectrum]
        self.assertEqual(averaged, list(range(averaged[0], times[-2] + 1)))

    def stops_with_last_message(self, ask):
        status, spectrum = self.listen('status'), self.listen('spectrum')
        node = self.start(dict(ENDLESS, wait_for_subscribers=['status', 'spectrum']))
        self.assertTrue(spectrum.wait_for(lambda message: True))
        self.stop(node, lambda: ask(node))
        self.check_stopped(status.all_of(node), spectrum.all_of(node))
        self.assertEqual(len(node.lines('stopped at simulated time')), 1, node.text())
        return node

    def test_asked(self):
        """By Ctrl-C, by a system that ends, and by rosnode kill."""

        def kill(node):
            uri = rosgraph.Master('/test').lookupNode('/' + harness.NODE)
            xmlrpc.client.ServerProxy(uri).shutdown('/test', 'killed by a test')

        self.stops_with_last_message(lambda node: node.send(signal.SIGINT))
        self.stops_with_last_message(lambda node: node.send(signal.SIGTERM))
        node = self.stops_with_last_message(kill)
        self.assertEqual(len(node.lines('asked to shut down: killed by a test')), 1)

    def test_during_a_step(self):
        status = self.listen('status')
        node = self.start(
            dict(ENDLESS, wait_for_subscribers=['status']), probe={'PROBE_STEP_SECONDS': '1.6'}
        )
        self.assertTrue(status.wait_for(lambda message: True))
        before = status.messages[-1]
        self.stop(node)
        self.assertTrue(status.wait_for(is_last))
        self.assertEqual(status.messages[-1].sim_time, before.sim_time)

    def test_during_creation(self):
        """Of a frame so large that it is announced."""
        node = self.start(dict(number=2000, exponents='all', threads=1))
        self.sees(lambda: node.lines('creates 4000 tangent vectors of 2000 disks'))
        self.stop(node)
        self.assertEqual(node.lines('scene '), [])

    def test_while_waiting_for_subscribers(self):
        node = self.start(dict(SHORT, wait_for_subscribers=['state']))
        self.sees(lambda: node.lines('waiting for subscribers'))
        self.stop(node)

    @harness.SECOND_TIER
    def test_while_waiting_for_the_second_subscriber(self):
        links.register(self, 'state', '/gone')
        state = self.listen('state')
        node = self.start(dict(SHORT, wait_for_subscribers=['state']))
        self.sees(lambda: state.subscriber.get_num_connections() == 1)
        time.sleep(0.3)
        self.stop(node)
        self.assertEqual((state.messages, node.lines('WARN')), ([], []))

    @harness.SECOND_TIER
    def test_while_a_stopped_master_is_asked(self):
        """Who else has subscribed: no answer is no reason to start what is to stop."""
        master = harness.Master()
        self.addCleanup(master.stop)
        for name in ('/gone', '/gone_too'):
            links.register(self, 'cost', name, master.uri)
        node = self.start(dict(SHORT, wait_for_subscribers=['cost']), ROS_MASTER_URI=master.uri)
        cost = links.Link(links.node_port(node, master.uri), 'cost')
        self.addCleanup(cost.close)
        cost.greet()
        reader = links.Reader([cost])
        time.sleep(0.3)
        master.send(signal.SIGSTOP)
        time.sleep(0.3)  # the next question is out
        self.stop(node)
        reader.join(harness.PATIENCE)
        self.assertEqual((cost.seqs, node.lines('WARN')), ([0], []))  # the last word alone

    def test_while_keeping_pace(self):
        cost = self.listen('cost')
        node = self.start(
            dict(ENDLESS, pace=0.1, report_interval=0.01, wait_for_subscribers=['cost'])
        )
        self.assertTrue(cost.wait_for(lambda message: True))
        self.stop(node)

    @harness.SECOND_TIER
    def test_without_master(self):
        uri = 'http://localhost:%d' % harness.free_port()
        for args in ([], ['_number:=100']):
            with self.subTest(args=args):
                node = self.process([harness.executable(), *args], ROS_MASTER_URI=uri)
                self.sees(lambda: node.lines('master at'), node)
                self.stop(node)

    @harness.SECOND_TIER
    def test_master_comes_later(self):
        port = harness.free_port()
        node = self.process([harness.executable()], ROS_MASTER_URI='http://localhost:%d' % port)
        self.sees(lambda: node.lines('waiting for it'), node)
        master = harness.Master(port)
        self.addCleanup(master.stop)
        self.sees(lambda: node.lines('scene paper_periodic'))
        self.stop(node)

    @harness.SECOND_TIER
    def test_with_stopped_master(self):
        master = harness.Master()
        self.addCleanup(master.stop)
        node = self.start(ENDLESS, ROS_MASTER_URI=master.uri)
        self.sees(lambda: node.lines('scene unnamed'))
        time.sleep(0.3)
        master.send(signal.SIGSTOP)
        self.stop(node)
