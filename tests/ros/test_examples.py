"""The example beside a running node: its numbers are found again from what the test itself
hears."""

import math
import xmlrpc.client

import numpy as np
import rosgraph
import rospy
from std_msgs.msg import Float64

import harness
import links
from harness import MODES
from hdlyap.data import series
from hdlyap.msg import LpPhase, LpPhases
from roslib.packages import find_node

pytestmark = harness.UNDER_A_MASTER

ROUNDING = 1e-6  # of regressions in another order
STATES = {
    LpPhase.UNRESOLVED: 'its step is not resolved',
    LpPhase.WEAK: 'too weak to have a phase',
    LpPhase.COARSE: 'turns too far between samples',
    LpPhase.TRACKED: 'followed',
}


def example(name):
    return find_node('hdlyap', name)[0]


def expected_deviations(messages, ours):
    """Percent of a turn off the line through all that has been followed without a break."""
    expected, times, phases, last = [], [], [], None
    for message in messages:
        phase = ours(message)
        if phase.state != LpPhase.TRACKED or times[-1:] == [message.sample_time]:
            continue
        began = message.sample_time - phase.tracked_time
        if last is None or abs(began - last) > 0.1:
            times, phases = [], []
        last = began
        times.append(message.sample_time)
        phases.append(phase.phase)
        line = np.polyfit(times, phases, 1) if len(times) > 2 else (0.0, phase.phase)
        expected.append(100 * (phase.phase - np.polyval(line, message.sample_time)) / (2 * math.pi))
    return expected


def outward(uri):
    """(topic, name of the subscriber) of a node's connections."""
    with xmlrpc.client.ServerProxy(uri) as proxy:
        return {(link[4], link[1]) for link in proxy.getBusInfo('/test')[2] if link[2] == 'o'}


class Examples(harness.Case):
    @staticmethod
    def is_heard(name):
        """Its deviation by this test."""
        uri = rosgraph.Master('/test').lookupNode(name)
        return (name + '/deviation', rospy.get_name()) in outward(uri)

    def watch(self, name='watch_phase', **params):
        return self.start(params, name=name, command=[example('watch_phase')])


class Beside(Examples):
    """The example and the test hear all of one run."""

    def test_numbers_of_a_run(self):
        watch = self.watch(number=2)
        deviations = self.hear('/watch_phase/deviation', Float64)
        listeners = {topic: self.listen(topic) for topic in ('lp_phases', 'steps', 'spectrum')}
        node = self.start(dict(MODES, duration=250.0, pace=100.0, wait_for_subscribers=['cost']))
        wanted = {
            ('/hdlyap/' + topic, name)
            for topic, name in (
                ('lp_phases', '/watch_phase'),
                ('lp_phases', rospy.get_name()),
                ('steps', rospy.get_name()),
                ('spectrum', rospy.get_name()),
            )
        }
        self.sees(lambda: wanted <= outward(links.node_uri(node)), node)
        self.sees(lambda: self.is_heard('/watch_phase'), watch)
        _, status = self.listen('cost'), self.listen('status')  # the run begins
        self.ends(node)
        self.assertTrue(status.wait_for(harness.is_last))
        phases, steps = (listeners[topic].messages for topic in ('lp_phases', 'steps'))
        self.assertEqual((len(phases), len(steps)), (250, 250))
        self.check_deviations(phases, deviations, watch)
        self.interrupt(watch)
        self.check_states(phases, watch)
        self.check_errors(listeners['spectrum'].messages)

    def check_errors(self, messages):
        """Those that the node states are those of its samples, by the time for which they remember
        each other."""
        samples = [message for message in messages if message.local_time > 0]
        values = [message.local_exponents for message in samples]
        errors = series.standard_error(values, [message.local_time for message in samples])
        ratios = errors / np.array(messages[-1].std_errors)
        self.assertGreater(np.isfinite(ratios).mean(), 0.9)
        self.assertAlmostEqual(np.nanmedian(ratios), 1, delta=0.2)

    @staticmethod
    def ours(message):
        return [phase for phase in message.phases if (phase.nx, phase.ny) == (1, 0)][1]

    def check_deviations(self, messages, deviations, watch):
        expected = expected_deviations(messages, self.ours)
        self.assertGreater(len(expected), 50)
        self.assertGreater(max(map(abs, expected)), 1.0)
        self.sees(lambda: len(deviations) >= len(expected), watch)
        np.testing.assert_allclose([each.data for each in deviations], expected, atol=ROUNDING)

    def check_states(self, messages, watch):
        """A line for each change, a warning unless it is followed."""
        states = [self.ours(message).state for message in messages]
        changes = [state for state, before in zip(states, [None] + states) if state != before]
        said = watch.lines('phase 2 of LP(1,0): ')
        self.assertEqual(
            [line.split('LP(1,0): ')[1].split('\033')[0] for line in said],
            [STATES[state] for state in changes],
        )
        self.assertEqual(
            ['INFO' in line for line in said], [state == LpPhase.TRACKED for state in changes]
        )
        self.assertGreater(len(watch.lines('omega = ')), 0, watch.text())


class Alone(Examples):
    def test_refused_parameters(self):
        cases = [
            ('nx', -1),
            ('nx', 1.5),
            ('nx', 'x'),
            ('nx', True),
            ('ny', -1),
            ('nx', 0),
            ('number', 0),
            ('number', '1'),
            ('node', 5),
            ('node', ['hdlyap']),
            ('nz', 1),
            ('Number', 1),
        ]
        nodes = [
            self.start({name: value}, name='refused_%d' % k, command=[example('watch_phase')])
            for k, (name, value) in enumerate(cases)
        ]
        for node, (name, value) in zip(nodes, cases):
            with self.subTest(name=name, value=value):
                self.ends(node, 2)
                self.assertEqual(len(node.text().splitlines()), 1, node.text())
                self.assertRegex(node.text(), r'\[FATAL\] \[[0-9.]+\]: %s = .*: must be ' % name)

    def publisher(self, topic, kind):
        publisher = rospy.Publisher(topic, kind, queue_size=100)
        self.addCleanup(publisher.unregister)
        return publisher

    def test_followed_anew(self):
        """Between two reports, and in another run: the line begins again."""
        publisher = self.publisher('/made/lp_phases', LpPhases)
        watch = self.watch(node='made')
        deviations = self.hear('/watch_phase/deviation', Float64)
        self.sees(lambda: publisher.get_num_connections() and self.is_heard('/watch_phase'), watch)
        # times, and how long it has been followed by then
        made = [
            (t, t - began)
            for began, times in ((0.5, range(1, 4)), (7.0, range(10, 16)), (1.5, range(9, 13)))
            for t in times
        ]
        messages = [
            LpPhases(
                sim_time=t + 0.25,
                sample_time=t,
                phases=[
                    LpPhase(
                        nx=1,
                        state=LpPhase.TRACKED,
                        tracked_time=tracked,
                        phase=t + 0.1 * (7 * k % 5),
                    )
                ],
            )
            for k, (t, tracked) in enumerate(made)
        ]
        for message in messages:
            publisher.publish(message)
        self.sees(lambda: len(deviations) >= len(messages), watch)
        np.testing.assert_allclose(
            [each.data for each in deviations],
            expected_deviations(messages, lambda message: message.phases[0]),
            atol=ROUNDING,
        )
        self.interrupt(watch)
