"""What /diagnostics says of a run on which something is wrong, and that it stops saying so."""

import os
import re
import tempfile

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
import rospy

import harness
import links
from harness import MODES, SHORT
from hdlyap.msg import RunStatus

pytestmark = harness.UNDER_A_MASTER

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
LIVE = dict(SHORT, duration=0.0, pace=20.0, threads=1)
# more than the buffers of a socket hold, in a second
BULKY = dict(
    number=20000,
    density=0.1,
    exponents='none',
    observables=['state'],
    pace=0.5,
    equilibration=0.0,
    warmup=0.0,
    report_interval=0.025,
    duration=0.0,
)


class Diagnostics(harness.Case):
    def setUp(self):
        self.statuses = []
        subscriber = rospy.Subscriber(
            '/diagnostics', DiagnosticArray, lambda message: self.statuses.append(message.status[0])
        )
        self.addCleanup(subscriber.unregister)

    def said(self, level, *words):
        """The first status from now on of that level with these words; its values and message."""
        start = len(self.statuses)

        def fits():
            return [
                status
                for status in self.statuses[start:]
                if status.level == level and all(word in status.message for word in words)
            ]

        self.assertTrue(harness.wait_until(fits), self.statuses[-1:])
        status = fits()[0]
        return dict({pair.key: pair.value for pair in status.values}, message=status.message)

    def test_several_at_once(self):
        """Of a run whose disks overlap and whose errors stay what they are."""
        self.start(
            dict(LIVE, equilibration=100.0, pace=200.0),
            probe=dict(PROBE_OVERLAP='1e-10', PROBE_STD_ERROR='0.25'),
        )
        values = self.said(
            ERROR,
            'disks overlap by 1e-10, rounding explains ',
            '; errors of the smallest exponents do not fall: 0.25 after ',
        )
        self.assertEqual(values['overlap'], '1e-10')
        self.assertEqual(values['error of the smallest exponents'], '0.25')
        averaged = float(values['averaged time'])
        self.assertLess(averaged, float(values['simulated time']) - 99)
        told = re.search('averaging, 0.25 after ([^;]*)', values['message']).group(1)
        self.assertAlmostEqual(float(told) / averaged, 1.0, delta=0.01)

    def test_exponents_that_reach_no_step(self):
        """In the log once, and in status, too."""
        node = self.start(dict(MODES, exponents=4, duration=0.0, pace=20.0))
        said = 'exponents = 4: none of them belongs to a step, which modes, '
        self.said(WARN, said, ' includes all')
        self.assertIn(said, rospy.wait_for_message('/hdlyap/status', RunStatus).warning)
        node.stop()
        self.assertEqual(node.text().count(said), 1)

    def test_subscriber_behind(self):
        """One that does not read for seconds; and then does."""
        node = self.start(dict(BULKY, wait_for_subscribers=['state']))
        link = links.Link(links.node_port(node), 'state')
        self.addCleanup(link.close)
        link.greet()
        values = self.said(WARN, 'a subscriber of /hdlyap/state is ', ' s behind')
        self.assertEqual(values['topic that it is behind in'], '/hdlyap/state')
        self.assertGreaterEqual(float(values['seconds that a subscriber is behind']), 3.0)
        self.addCleanup(links.Reader([link]).join, harness.PATIENCE)
        self.addCleanup(node.stop)
        values = self.said(OK)
        self.assertEqual(link.gaps(), 0)
        for key in ('overlap', 'energy error'):
            self.assertLess(float(values[key]), 1e-11)

    def test_collisions_of_a_resumed_run(self):
        """Those before it was resumed do not count as of its first second."""
        with tempfile.TemporaryDirectory() as folder:
            kept = os.path.join(folder, 'kept')
            node = self.runs(dict(LIVE, pace=0.0, duration=3000.0, checkpoint=kept))
            before = int(re.search('([0-9]+) collisions', node.text()).group(1))
            self.start(dict(resume=kept, duration=0.0, pace=1.0))
            values = self.said(OK)
        self.assertLess(float(values['collisions per second']), 0.1 * before)
