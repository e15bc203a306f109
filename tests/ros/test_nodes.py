"""Nodes beside each other, under other names, at a pace, and in a system that runs on simulated
time."""

import os
import signal
import statistics
import subprocess
import tempfile
import time
import xmlrpc.client

from diagnostic_msgs.msg import DiagnosticArray
import rosgraph
from rosgraph_msgs.msg import Clock
from roscpp.srv import GetLoggers, SetLoggerLevel
import rospy
from std_srvs.srv import SetBool, Trigger

import harness
import links
from harness import SHORT, TYPES, Process

pytestmark = harness.UNDER_A_MASTER

TOPICS = ['spectrum', 'state', 'status', 'cost']
RUN = dict(
    SHORT,
    threads=1,
    equilibration=0.0,
    warmup=0.0,
    duration=12.0,
    report_interval=0.5,
    observables=['spectrum', 'state'],
    wait_for_subscribers='all',
)
REPORTS = 24
PACE = 10.0
UNREACHED = '10.255.255.1'  # of a network that is private, and of nobody here


class Run:
    """One node of any name, and everything that it says."""

    def __init__(self, test, params, name='/hdlyap', args=(), **env):
        self.name, self.messages = name, {topic: [] for topic in ['run_info', *TOPICS]}
        for topic, messages in self.messages.items():
            subscriber = rospy.Subscriber(
                name + '/' + topic, TYPES[topic], messages.append, queue_size=None
            )
            test.addCleanup(subscriber.unregister)
        rospy.set_param(name, params)
        namespace, base = name.rsplit('/', 1)
        self.node = Process(
            [harness.executable(), '__name:=' + base, '__ns:=' + namespace, *args], **env
        )
        test.addCleanup(self.node.stop)

    def service(self, name, kind):
        return harness.service(name, kind, self.name[1:])

    def has(self, count):
        return harness.wait_until(lambda: len(self.messages['state']) >= count)

    def numbers(self):
        """All that does not depend on clocks."""
        return (
            [
                (m.sim_time, m.collisions, m.exponents, m.std_errors)
                for m in self.messages['spectrum']
            ],
            [(m.sim_time, m.x, m.y, m.px, m.py) for m in self.messages['state']],
        )

    def stamps(self):
        return [message.header.stamp.to_sec() for message in self.messages['state']]


class Nodes(harness.Case):
    def run_to_end(self, *args, **kw):
        run = Run(self, *args, **kw)
        self.ended(run)
        return run

    def ended(self, run, reports=REPORTS):
        self.ends(run.node)
        self.assertTrue(run.has(reports))
        last = run.messages['status']
        self.sees(lambda: last and harness.is_last(last[-1]))

    def test_two_at_once_and_pace(self):
        """One is paused while the other, of another seed, runs to its end; nothing of that is in
        the numbers."""
        alone = [self.run_to_end(dict(RUN, seed=seed), '/alone_' + seed) for seed in ('1', '2')]
        paced = Run(self, dict(RUN, seed='1', pace=PACE), '/left/hdlyap')
        self.assertTrue(paced.has(3))
        self.assertTrue(paced.service('pause', SetBool)(True).success)
        other = self.run_to_end(dict(RUN, seed='2'), '/right/hdlyap')
        self.assertLess(len(paced.messages['state']), REPORTS)
        self.assertTrue(paced.service('pause', SetBool)(False).success)
        self.ended(paced)
        for before, beside in zip(alone, (paced, other)):
            self.assertEqual(len(before.numbers()[1]), REPORTS)
            self.assertEqual(before.numbers(), beside.numbers())
        self.assertNotEqual(*(run.numbers() for run in alone))
        # by stamps: no report comes early, and a busy machine delays only some of them
        between = [b - a for a, b in zip(paced.stamps(), paced.stamps()[1:])]
        self.assertAlmostEqual(
            statistics.median(between) * PACE / RUN['report_interval'], 1.0, delta=0.3
        )
        self.assertGreater(
            paced.stamps()[-1] - paced.stamps()[0],
            0.95 * (REPORTS - 1) * RUN['report_interval'] / PACE,
        )

    def test_names(self):
        elsewhere = self.hear('/elsewhere/curve', TYPES['spectrum'])
        run = Run(
            self,
            dict(RUN, seed='3', duration=0.0, pace=PACE),
            '/lab/room/two',
            args=['/lab/room/two/spectrum:=/elsewhere/curve'],
        )
        self.assertTrue(run.has(3) and harness.wait_until(lambda: elsewhere))
        self.assertEqual(run.messages['run_info'][0].seed, '3')
        self.assertEqual(run.messages['spectrum'], [])
        topics = {topic for topic, _ in rospy.get_published_topics('/lab')}
        self.assertEqual(
            topics,
            {
                '/lab/room/two/' + name
                for name in ('run_info', 'state', 'status', 'cost', 'slow_vectors')
            },
        )
        self.assertIn(
            '/lab/room/two', dict(rosgraph.Master('/nodes').getSystemState()[0])['/rosout']
        )
        status = rospy.wait_for_message('/diagnostics', DiagnosticArray, harness.PATIENCE).status[0]
        self.assertEqual(status.name, '/lab/room/two')
        run.service('checkpoint', Trigger)
        self.interrupt(run.node)

    def test_loggers_are_listed_again_and_again(self):
        """roscpp's own service of Debian kills a node at the second call. A level that is set is
        told, and obeyed."""
        run = Run(self, dict(RUN, duration=0.0, pace=PACE))
        self.assertTrue(run.has(1))
        watch = self.process([harness.program('watch_phase'), '__name:=watch'])
        viewer = harness.start_viewer()
        self.addCleanup(viewer.end)
        for name, node in (('hdlyap', run.node), ('watch', watch), ('viewer', viewer)):
            with self.subTest(node=name):
                self.check_loggers(name, node)
        self.assertTrue(run.has(len(run.messages['state']) + 2))
        self.interrupt(run.node)
        self.assertFalse(run.node.lines('stopped at simulated time'), run.node.text())

    def check_loggers(self, name, node):
        ours, others = 'ros.hdlyap', 'ros.roscpp'
        listed = harness.service('get_loggers', GetLoggers, name)

        def levels():
            return {one.name: one.level for one in listed().loggers}

        for _ in range(20):
            self.assertEqual(levels()[others], 'info')
        for level in ('debug', 'error', 'fatal', 'warn'):
            harness.service('set_logger_level', SetLoggerLevel, name)(ours, level)
            self.assertEqual([levels()[one] for one in (ours, others)], [level, 'info'])
        told = subprocess.check_output(['rosconsole', 'list', '/' + name], text=True).split()
        self.assertEqual(told, sorted(levels()))
        self.assertTrue(node.running(), node.text())

    def registered(self, uri):
        """What a master knows: publishers, services, and the viewer's first subscriber."""
        publishers, subscribers, services = rosgraph.Master('/test', uri).getSystemState()
        first = [one for one in subscribers if one[0] == '/hdlyap/run_info']
        return sorted([name, sorted(nodes)] for name, nodes in publishers + services + first)

    def heard_by_viewer(self, uri):
        """The address that the viewer hears run_info from."""
        viewer = rosgraph.Master('/test', uri).lookupNode('/viewer')
        _, _, found = xmlrpc.client.ServerProxy(viewer).getBusInfo('/test')
        return [link[1] for link in found if link[4] == '/hdlyap/run_info']

    def test_master_comes_back(self):
        """And knows all that it knew before; a viewer hears the next node, too."""
        port = harness.free_port()
        master = harness.Master(port)
        self.addCleanup(master.stop)
        env = {'ROS_MASTER_URI': master.uri}
        node = self.start(dict(SHORT, duration=0.0, pace=PACE), **env)
        viewer = harness.start_viewer(**env)
        self.addCleanup(viewer.end)
        for last in (['/hdlyap/set', ['/hdlyap']], ['/viewer/set', ['/viewer']]):
            self.sees(lambda: last in self.registered(master.uri), node)
        before = self.registered(master.uri)
        self.assertIn(['/hdlyap/run_info', ['/viewer']], before)
        master.stop()
        master = harness.Master(port)
        self.addCleanup(master.stop)
        self.sees(lambda: self.registered(master.uri) == before, node)
        said = 'did not know this node, which has registered again'
        self.sees(lambda: node.lines(said), node)
        said = subprocess.check_output(
            ['rosservice', 'call', '/hdlyap/pause', 'true'], text=True, env={**os.environ, **env}
        )
        self.assertIn('success: True', said)
        self.interrupt(node)
        node = self.start(dict(SHORT, duration=0.0, pace=PACE), **env)
        address = links.node_uri(node, master.uri)
        self.sees(lambda: self.heard_by_viewer(master.uri) == [address], viewer)
        self.interrupt(viewer)
        self.interrupt(node)
        self.assertEqual(self.registered(master.uri), [])

    def start_unreached(self):
        """A node that waits for subscribers at an address that nobody reaches, and says so."""
        node = self.start(dict(SHORT, wait_for_subscribers=['status']), ROS_HOSTNAME=UNREACHED)
        own = 'this node does not answer at its own address http://%s:' % UNREACHED
        self.sees(lambda: own in node.text(), node)
        return node

    def test_an_address_that_nobody_reaches(self):
        """Is told by who waits for the node, which never went away."""
        node = self.start_unreached()
        follow = self.process([*harness.command('follow'), '--timeout', '3'])
        viewer = self.process([harness.program('viewer')], ROS_HOSTNAME=UNREACHED)
        wrong = '/hdlyap has the address http://%s:' % UNREACHED
        self.ends(follow, 1, 'hdlyap follow: ' + wrong, 'ROS_IP or ROS_HOSTNAME must be')
        self.assertNotIn('went away', follow.text())
        said = '/hdlyap does not answer at its address http://%s:' % UNREACHED
        self.sees(lambda: viewer.lines(said), viewer)
        view = self.process(harness.command('view'), DISPLAY=':nobody')
        wrong = 'hdlyap view: /viewer has the address http://%s:' % UNREACHED
        self.sees(lambda: view.lines(wrong), view)
        self.assertTrue(node.running(), node.text())

    @harness.SECOND_TIER
    def test_recorder_of_an_address_that_nobody_reaches(self):
        self.start_unreached()
        recorder = self.process(
            [harness.program('record'), '_bag:=' + self.new_folder() + '/b.bag']
        )
        wrong = 'waiting for a node to record: /hdlyap has the address http://%s:' % UNREACHED
        self.sees(lambda: recorder.lines(wrong), recorder)

    def check_simulated_time(self):
        follow = self.process([*harness.command('follow'), '--node', '/timeless'])
        run = Run(self, dict(RUN, duration=0.0, pace=PACE), '/timeless')
        self.assertTrue(run.has(3))
        self.assertTrue(run.service('pause', SetBool)(True).success)
        self.assertTrue(run.service('pause', SetBool)(False).success)
        self.sees(follow.text)
        run.node.send(signal.SIGINT)
        self.ended(run, reports=3)
        self.assertLess(abs(run.stamps()[-1] - time.time()), 600)
        self.ends(follow)

    @harness.SECOND_TIER
    def test_simulated_time(self):
        """Without a clock, and with one that is none; who has set it is left alone."""
        rospy.set_param('/use_sim_time', True)
        self.addCleanup(rospy.delete_param, '/use_sim_time')
        self.check_simulated_time()
        self.assertNotIn('/clock', dict(rospy.get_published_topics()))
        clock = rospy.Publisher('/clock', Clock, queue_size=1)
        self.addCleanup(clock.unregister)
        ticks = iter(range(10**9, 0, -1))
        timer = rospy.Timer(
            rospy.Duration(0.01), lambda event: clock.publish(Clock(rospy.Time(next(ticks))))
        )
        self.addCleanup(timer.shutdown)
        self.check_simulated_time()
        self.assertIs(rospy.get_param('/use_sim_time'), True)

    @harness.SECOND_TIER
    def test_the_clock_is_set(self):
        """By an hour in the midst of a run, forwards and backwards: nothing waits for it, and all
        that is measured goes on."""
        with tempfile.TemporaryDirectory() as folder:
            for jump in (3600, -3600):
                self.check_clock(jump, os.path.join(folder, 'kept%d' % jump))

    def check_clock(self, jump, kept):
        params = dict(RUN, duration=0.0, pace=PACE, checkpoint=kept, checkpoint_interval=0.2)
        jumps = dict(harness.probed(), PROBE_CLOCK_JUMP=str(jump))
        heard = self.hear('/diagnostics', DiagnosticArray)
        run = Run(self, params, '/jump_%s' % ('ahead' if jump > 0 else 'back'), **jumps)
        begin = time.monotonic()

        def has_jumped(header):
            return abs(header.stamp.to_sec() - jump - time.time()) < 600

        def reports():
            return [message for message in run.messages['cost'] if has_jumped(message.header)]

        self.sees(lambda: reports() and os.path.exists(kept))
        before, known = os.stat(kept).st_mtime_ns, len(heard)
        self.sees(lambda: os.stat(kept).st_mtime_ns > before)
        self.sees(lambda: len(heard) > known + 1)
        self.assertTrue(has_jumped(heard[known + 1].header))
        values = {pair.key: pair.value for pair in heard[known + 1].status[0].values}
        self.assertGreater(float(values['collisions per second']), 0)
        self.interrupt(run.node)
        first, last = reports()[0], reports()[-1]
        simulated, wall = (
            getattr(last, name) - getattr(first, name) for name in ('sim_time', 'wall_seconds')
        )
        self.assertLess(last.wall_seconds, time.monotonic() - begin)
        self.assertLess(simulated, PACE * (wall + 1))  # a second of delay may be made up
