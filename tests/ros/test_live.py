"""Parameters that are changed while a run goes on: when they hold, what is refused, and that a bag
tells of it all."""

import concurrent.futures
import math
import os
import signal
import subprocess

import rosbag
import rospy
from std_srvs.srv import SetBool, Trigger
import yaml

from hdlyap.srv import Set
import harness
from harness import NODE, SHORT

pytestmark = harness.UNDER_A_MASTER

RUN = dict(harness.REPEATABLE, duration=0.0, report_interval=1.0, field_interval=1000.0)
TOPICS = RUN['observables']
BEGIN = 25.0  # of its averaging
SLOW = 40.0  # a pace at which a call hits the middle of it
CLOSE = 1e-9  # of simulated times


def is_multiple(time, interval):
    return abs(time / interval - round(time / interval)) < CLOSE * 1e3


class Live(harness.Case):
    def setUp(self):
        self.folder = self.new_folder()
        self.heard = {}

    def started(self, params, **how):
        """A node that is listened to as a recorder would."""
        self.heard = {
            topic: self.listen(topic) for topic in ['run_info', 'status', 'cost', *TOPICS]
        }
        return self.start(params, **how)

    def until(self, time):
        self.assertTrue(self.heard['status'].wait_for(lambda message: message.sim_time >= time))

    def call(self, assignment, node=NODE):
        return harness.service('set', Set, node)(assignment)

    def changed(self, assignment):
        """What run_info says of it."""
        before = len(self.changes())
        answer = self.call(assignment)
        self.assertTrue(answer.success, answer.message)
        name, value = assignment.split('=')
        self.assertIn('%s = %s from simulated time ' % (name, value), answer.message)
        self.sees(lambda: len(self.changes()) > before)
        change = self.changes()[-1]
        self.assertEqual((change.name, change.value), (name, value))
        now = getattr(self.info(), name)
        self.assertEqual(now, type(now)(value))
        return change

    def info(self):
        return self.heard['run_info'].messages[-1]

    def changes(self):
        return self.info().changes if self.heard['run_info'].messages else []

    def heard_of(self, node):
        """All of its messages."""
        messages = {topic: listener.all_of(node) for topic, listener in self.heard.items()}
        self.ends(node)
        return messages

    def times(self, topic):
        return sorted({message.sim_time for message in self.heard[topic].messages})

    def same(self, one, other):
        for topic in TOPICS:
            with self.subTest(topic=topic):
                self.assertGreater(len(one[topic]), 0)
                self.assert_same_bits(one[topic], other[topic])

    def test_reports_fields_and_duration(self):
        node = self.started(dict(RUN, pace=SLOW))
        self.until(BEGIN + 2.0)
        reports = self.changed('report_interval=0.25')
        self.assertEqual(reports.before, '1')
        self.until(reports.sim_time)
        fields = self.changed('field_interval=2')
        self.until(fields.sim_time + 3.0)
        end = math.ceil(fields.sim_time) + 60.0
        duration = self.changed('duration=%g' % (end - BEGIN))
        self.changed('pace=0')
        self.heard_of(node)
        times = self.times('state')
        self.assertEqual(times[-1], end)
        since = [time - reports.sim_time for time in times if time > reports.sim_time + CLOSE]
        for k, time in enumerate(since[:-1], 1):
            self.assertAlmostEqual(time, 0.25 * k, delta=CLOSE)
        for time in times:
            self.assertTrue(time > reports.sim_time or is_multiple(time - BEGIN, 1.0))
        shown = [time for time in self.times('fields') if fields.sim_time < time < end]
        self.assertGreater(len(shown), 10)
        for one, next_one in zip(shown, shown[1:]):  # the first report after each multiple
            self.assertEqual((next_one - BEGIN) // 2.0, (one - BEGIN) // 2.0 + 1)
        self.assertEqual(
            [change.name for change in self.changes()],
            ['report_interval', 'field_interval', 'duration', 'pace'],
        )
        self.assertEqual(duration.before, '0')
        self.assertEqual(rospy.get_param('/hdlyap/pace'), 0.0)  # as it was set last
        runs = {info.run_id for info in self.heard['run_info'].messages}
        self.assertEqual(len(runs), 1)

    @harness.SECOND_TIER
    def test_pace(self):
        """Also while it waits for a pace that is too slow, or is paused."""
        node = self.started(dict(RUN, pace=1.0e-4, duration=60.0))
        self.until(BEGIN + 1.0)
        self.changed('pace=20')
        self.until(BEGIN + 3.0)
        pause = harness.service('pause', SetBool)
        self.assertTrue(pause(True).success)
        self.changed('pace=0')
        change = self.changed('duration=80')
        self.assertTrue(pause(False).success)
        self.heard_of(node)
        self.assertEqual(self.times('status')[-1], BEGIN + 80.0)
        self.assertLess(change.sim_time, BEGIN + 60.0)

    def test_before_the_averaging(self):
        node = self.started(dict(RUN, warmup=2000.0, duration=1.0))
        change = self.changed('report_interval=7')
        self.assertLess(change.sim_time, 2000.0)
        self.until(change.sim_time + 20.0)
        node.send(signal.SIGINT)
        self.heard_of(node)
        since = [time for time in self.times('state') if time >= change.sim_time - CLOSE]
        self.assertAlmostEqual(since[2] - since[1], 7.0, delta=CLOSE)  # beyond the equilibration

    def test_target(self):
        node = self.started(dict(SHORT, observables=['spectrum'], threads=1, duration=0.0))
        self.assertTrue(self.heard['cost'].wait_for(lambda cost: cost.sim_time > 10.0))
        self.assertTrue(self.heard['status'].wait_for(lambda status: status.std_error > 0.0))
        change = self.changed('target=smallest 1000, lambda_max 50%')
        self.heard_of(node)
        self.assertIn('finished at simulated time', node.text())
        self.assertGreaterEqual(self.times('status')[-1], change.sim_time - CLOSE)

    def test_many_ask_while_it_pauses(self):
        """Four clients at once; each sends the next change as soon as it is answered."""
        node = self.started(dict(RUN, pace=SLOW))
        self.until(BEGIN + 2.0)
        self.assertTrue(harness.service('pause', SetBool)(True).success)
        with concurrent.futures.ThreadPoolExecutor(4) as clients:
            asked = ['pace=%d' % pace for pace in range(1, 41)]
            with harness.within(self, 10.0):
                answers = list(clients.map(self.call, asked))
        for assignment, answer in zip(asked, answers):
            self.assertTrue(answer.success, answer.message)
            self.assertIn(' = '.join(assignment.split('=')) + ' from ', answer.message)
        self.sees(lambda: len(self.changes()) == len(asked))
        with harness.within(self, 5.0):
            self.assertTrue(self.call('pace=0').success)
            self.assertTrue(harness.service('stop', Trigger)().success)
        self.heard_of(node)

    def test_stop(self):
        """As the end of the duration; a pause does not hold it."""
        kept = os.path.join(self.folder, 'stopped.checkpoint')
        node = self.started(dict(RUN, pace=SLOW, checkpoint=kept))
        stop = harness.service('stop', Trigger)
        self.until(BEGIN + 2.0)
        self.assertTrue(harness.service('pause', SetBool)(True).success)
        answer = stop()
        self.assertTrue(answer.success, answer.message)
        self.heard_of(node)
        last = self.heard['status'].messages[-1]
        self.assertEqual((last.stage, last.progress), (last.FINISHED, 1.0))
        self.assertEqual(answer.message, 'ends at simulated time %.6g' % last.sim_time)
        self.assertIn('finished at simulated time', node.text())
        self.assertTrue(os.path.exists(kept))
        self.assertEqual([change.name for change in self.changes()], ['duration'])

    def test_stop_before_the_averaging(self):
        node = self.started(dict(RUN, warmup=1.0e6))
        self.until(30.0)
        answer = harness.service('stop', Trigger)()
        self.assertFalse(answer.success)
        self.assertIn('nothing has been averaged yet', answer.message)
        node.send(signal.SIGINT)
        self.heard_of(node)

    def test_refused(self):
        node = self.started(dict(RUN, observables=['state'], wait_for_subscribers=['state']))
        self.until(BEGIN + 10.0)
        for assignment, why in {
            'number=50': 'number=50: is read at the start',
            'observables=[state]': 'is read at the start',
            'pace=fast': 'pace=fast: must be from 0',
            'pace=': 'must be from 0',
            'target=c_T 1%': 'target = c_T 1%: must be without c_T: ',
            'target_std_error=1': 'it is written target: smallest 0.01 now',
            'duration=5': 'duration = 5: must be 0 or at least',
            'pace=30 duration=2': 'must be one NAME=VALUE',
            'x\n' * 300: 'x?x?x',
        }.items():
            with self.subTest(assignment=assignment):
                answer = self.call(assignment)
                self.assertFalse(answer.success)
                self.assertIn(why, answer.message)
        # the same may come twice to who connects as it is published
        self.assertEqual(len({m.header.stamp for m in self.heard['run_info'].messages}), 1)
        self.assertEqual(len(self.changes()), 0)
        self.interrupt(node)
        self.assertEqual(node.lines('set: '), [])

    def test_changes_are_on_the_parameter_server(self):
        """The last one of each; what is refused is not."""
        node = self.started(dict(SHORT, duration=0.0, pace=20.0, wait_for_subscribers=['status']))
        self.until(3.0)
        for assignment in ('pace=30', 'report_interval=2', 'target=lambda_max 1e-9', 'pace=40'):
            self.assertTrue(self.call(assignment).success)
        self.assertFalse(self.call('pace=fast').success)
        last = dict(SHORT, wait_for_subscribers=['status'], duration=0.0)
        last.update(pace=40.0, report_interval=2.0, target='lambda_max 1e-9')
        self.sees(lambda: rospy.get_param('/' + NODE) == last, node)
        self.interrupt(node)

    @harness.SECOND_TIER
    def test_the_parameter_server_is_read_at_the_start(self):
        """Alone; lists as rosrun hands them on are lists, whatever blanks they have."""
        params = dict(SHORT, duration=0.0, pace=20.0, wait_for_subscribers='[ status,cost]')
        params.update(observables='[state,fields]', field_indices='[1,2]')
        node = self.started(dict(params, changes='[1e9 pace=3,2e9 pace=4]'))
        self.until(3.0)
        rospy.set_param('/%s/pace' % NODE, 1.5)
        self.until(5.0)
        node.send(signal.SIGINT)
        self.assertEqual(node.wait(), 0)
        self.assertEqual(self.info().pace, 20.0)

    def test_recorded_run_is_repeated(self):
        """By its bag alone: changes come again at their times."""
        node = self.started(dict(RUN, pace=SLOW))
        self.until(BEGIN + 2.0)
        self.changed('report_interval=0.3')
        self.until(BEGIN + 8.0)
        self.changed('field_interval=2')
        self.changed('report_interval=0.7')
        self.changed('duration=60')
        self.changed('pace=0')
        first = self.heard_of(node)
        bag = os.path.join(self.folder, 'run.bag')
        with rosbag.Bag(bag, 'w') as file:
            for second, info in enumerate(first['run_info'], start=1):
                file.write('/hdlyap/run_info', info, rospy.Time(second))
        scene = subprocess.check_output([*harness.command('repeat'), bag], text=True)
        params = yaml.safe_load(scene)
        self.assertEqual(
            (params['pace'], params['report_interval'], params['duration']), (SLOW, 1.0, 0.0)
        )
        self.assertEqual(len(params['changes']), 5)
        second = self.heard_of(self.started(params))
        self.same(first, second)
        self.assertEqual(
            [(c.sim_time, c.name, c.value) for c in first['run_info'][-1].changes[:4]],
            [(c.sim_time, c.name, c.value) for c in second['run_info'][-1].changes[:4]],
        )

    def test_resumed_after_a_change(self):
        """A run that is taken up goes on as the one that was not ended, with the changes of before
        given again, too: those whose time has come are made."""
        kept, end = (
            os.path.join(self.folder, name) for name in ('run.checkpoint', 'end.checkpoint')
        )
        params = dict(RUN, duration=50.0, field_interval=3.0)
        node = self.started(dict(params, pace=SLOW, checkpoint=kept))
        self.until(BEGIN + 2.0)
        change = self.changed('report_interval=0.3')
        self.changed('duration=60')
        self.until(change.sim_time + 2.0)
        node.send(signal.SIGINT)
        first = self.heard_of(node)
        del params['duration'], params['report_interval']
        second = self.heard_of(self.started(dict(params, resume=kept)))
        info = second['run_info'][0]
        self.assertEqual((info.report_interval, info.duration), (0.3, 60.0))
        self.assertEqual(len(info.changes), 0)
        changes = first['run_info'][-1].changes
        texts = ['%r %s=%s' % (c.sim_time, c.name, c.value) for c in changes]
        params.update(duration=50.0, report_interval=1.0, changes=texts)
        whole = self.heard_of(self.started(dict(params, checkpoint=end)))
        self.same({topic: first[topic] + second[topic] for topic in TOPICS}, whole)
        late = dict(params, resume=end, changes=[*texts, '1 pace=30'])  # in no order
        ended = self.heard_of(self.started(late))
        info = ended['run_info'][0]
        self.assertEqual((info.pace, info.report_interval, info.duration), (30.0, 0.3, 60.0))
        again = self.heard_of(self.started(dict(params, resume=kept)))
        self.same(second, again)
        # the second one is of a later interval if it came late
        self.assertEqual(again['run_info'][-1].changes, changes)

    def test_modes_of_the_viewer(self):
        viewer = harness.start_viewer()
        self.addCleanup(viewer.end)
        for assignment, success, words in (
            ('modes=T(1,0) LP(1,1)', True, 'modes = T(1,0) LP(1,1)'),
            ('modes=lowest', True, 'modes = lowest'),
            ('modes=T(1,0', False, 'modes = T(1,0: must be lowest or 1 to 8 names'),
            ('node=/other', False, 'other parameters are read at the start'),
        ):
            answer = self.call(assignment, 'viewer')
            self.assertEqual((answer.success, words in answer.message), (success, True), answer)
        self.sees(lambda: rospy.get_param('/viewer/modes', '') == 'lowest', viewer)
        viewer.send(signal.SIGINT)
        self.assertEqual(viewer.wait(), 0)
