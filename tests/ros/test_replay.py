"""hdlyap replay: when it says what a bag holds, and what it refuses."""

import math
import os
import signal
import time

import rosbag
import rospy
from diagnostic_msgs.msg import DiagnosticArray

import harness
import made
from hdlyap.msg import RunInfo, RunStatus, State, Steps

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

REPLAY = harness.command('replay')
REPORTS = 30  # of a run, a time unit apart; recorded within milliseconds


def run(run_id):
    """(topic, message) as a recorder meets them that looks into one topic after the other."""
    info = made.run_info(run_id=run_id, number=1)
    states = [State(run_id=run_id, sim_time=t, x=[0.5], y=[0.5]) for t in range(1, REPORTS + 1)]
    statuses = [made.status(float(t), run_id) for t in range(1, REPORTS + 1)]
    statuses[-1].stage = RunStatus.FINISHED
    return [
        ('/hdlyap/run_info', info),
        *(('/hdlyap/status', message) for message in statuses[:5]),
        *(('/hdlyap/state', message) for message in states[:10]),
        ('/diagnostics', DiagnosticArray()),
        *(('/hdlyap/status', message) for message in statuses[5:]),
        *(('/hdlyap/state', message) for message in states[10:]),
    ]


class Replayed(harness.Case):
    def setUp(self):
        self.bag = os.path.join(self.new_folder(), 'run.bag')

    def record(self, *runs, ahead=0):
        """ahead: messages of each run before the clock is set back by an hour."""
        with rosbag.Bag(self.bag, 'w') as bag:
            for number, run_id in enumerate(runs):
                for k, (topic, message) in enumerate(run(run_id)):
                    seconds = 10 * (number + 1) + (3600 if k < ahead else 0)
                    bag.write(topic, message, rospy.Time(seconds, 1000000 * k))

    def written(self, *args):
        """[(stamp, topic, type, bytes, whether it is latched)] of the bag that is played."""
        out = os.path.join(self.new_folder(), 'out.bag')
        self.ends(self.process([*REPLAY, self.bag, '--out', out, *args]))
        with rosbag.Bag(out) as bag:
            latched = {one.topic: one.header['latching'] for one in bag._get_connections()}
            return [
                (stamp.to_sec(), topic, raw[0], raw[1], latched[topic] in (b'1', '1'))
                for topic, raw, stamp in bag.read_messages(raw=True)
            ]

    def states(self, *args):
        """[(stamp after the first message, simulated time)] of states."""
        found = self.written(*args)
        states = [(one[0] - found[0][0], one[3]) for one in found if one[1] == '/hdlyap/state']
        return [(stamp, State().deserialize(data).sim_time) for stamp, data in states]

    def check_states(self, found, wanted, first=0.0):
        self.assertEqual([time_ for _, time_ in found], wanted)
        for (stamp, _), k in zip(found, range(len(wanted))):
            self.assertAlmostEqual(stamp, first + k, places=5)

    def test_by_simulated_time(self):
        """Evenly, however fast the run was and in whatever order its topics were recorded; one run
        after the other. Nothing but the stamps changes."""
        self.record('one', 'two')
        every = [float(t) for t in range(1, REPORTS + 1)]
        found = self.states()
        self.check_states(found[:REPORTS], every)
        self.check_states(found[REPORTS:], every, found[REPORTS][0])
        self.assertAlmostEqual(found[REPORTS][0], REPORTS - 1, places=5)
        with rosbag.Bag(self.bag) as bag:
            before = sorted((topic, *raw[:2]) for topic, raw, _ in bag.read_messages(raw=True))
        after = self.written()
        self.assertEqual(sorted(one[1:4] for one in after), before)
        self.assertEqual({one[1] for one in after if one[4]}, {'/hdlyap/run_info'})

    def test_late_messages_delay_nothing(self):
        """Covariant vectors are of times long past."""
        with rosbag.Bag(self.bag, 'w') as bag:
            for second, time_ in enumerate((1.0, 11.0, 12.0, 3.0, 5.0, 13.0)):
                state = State(run_id='one', sim_time=time_, x=[0.5], y=[0.5])
                bag.write('/hdlyap/state', state, rospy.Time(10 + 5 * second))
        stamps = [round(stamp, 5) for stamp, _ in self.states()]
        self.assertEqual(stamps, [0.0, 10.0, 10.0, 10.0, 11.0, 12.0])

    def test_clock_set_back(self):
        self.record('one', ahead=2 + REPORTS)
        self.check_states(self.states(), [float(t) for t in range(1, REPORTS + 1)])

    def test_from_some_time_on(self):
        """At first what the run is; all else after the time in which rviz opens."""
        self.record('one')
        found = self.states('--begin', '28', '--lead', '5', '--pace', '3')
        self.check_states(found, [28.0, 29.0, 30.0], first=15.0)
        self.assertEqual(self.written('--begin', '28')[0][1], '/hdlyap/run_info')

    def test_what_comes_before_any_time(self):
        """Messages of other packages take nothing of the lead, and delay nothing."""
        info, *others = run('one')
        stranger = '/diagnostics', DiagnosticArray()
        for first in ([stranger, info], [info, stranger]):
            with rosbag.Bag(self.bag, 'w') as bag:
                for k, (topic, message) in enumerate([*first, *others]):
                    bag.write(topic, message, rospy.Time(10, 1000000 * k))
            every = [float(t) for t in range(1, REPORTS + 1)]
            self.check_states(self.states('--lead', '5'), every, first=5.0)

    def test_played(self):
        """For who has subscribed nothing is lost, at the pace that was asked for."""
        self.record('one')
        walls = []
        subscriber = rospy.Subscriber(
            '/hdlyap/state', State, lambda m: walls.append((time.monotonic(), m.sim_time))
        )
        self.addCleanup(subscriber.unregister)
        replay = self.process([*REPLAY, self.bag, '--pace', '20'])
        self.ends(replay)
        self.sees(lambda: len(walls) == REPORTS)
        half = REPORTS // 2  # one message may come late on a busy machine
        spans = [later[0] - walls[k][0] for k, later in enumerate(walls[half:])]
        self.assertGreater(max(spans), 0.95 * half / 20)

    def test_interrupted(self):
        """In a pause; its bag goes with it."""
        self.record('one')
        replay = self.process([*REPLAY, self.bag, '--pause', '__name:=paused'])
        rospy.wait_for_service('/paused/pause_playback', harness.PATIENCE)
        replay.send(signal.SIGINT)
        self.ends(replay, 128 + signal.SIGINT)

    def test_killed(self):
        """As a shell says it."""
        self.record('one')
        replay = self.process([*REPLAY, self.bag, '--pause', '__name:=killed'])
        rospy.wait_for_service('/killed/pause_playback', harness.PATIENCE)
        with open('/proc/{0}/task/{0}/children'.format(replay.process.pid)) as file:
            (player,) = map(int, file.read().split())
        os.kill(player, signal.SIGKILL)
        self.ends(replay, 128 + signal.SIGKILL)

    def test_what_is_refused(self):
        """In one line."""
        with open(self.bag, 'w') as file:
            file.write('no bag')
        self.check_refused('not a readable bag')
        self.record('one')
        size = os.path.getsize(self.bag)
        self.check_refused('no messages from t = 31 on', '--begin', '31')
        out = [*REPLAY, self.bag, '--out', self.bag + '.out', '--keep-alive', '--loop', 'a:=b']
        replay = self.process(out)
        self.ends(replay, 2)
        said = 'hdlyap replay: --loop --keep-alive a:=b: must not be given with --out\n'
        self.assertEqual(replay.text(), said)
        os.truncate(self.bag, size // 2)
        self.check_refused('not closed')
        os.remove(self.bag)
        self.check_refused('No such file')
        other = type('Other', (Steps,), dict(_md5sum='a' * 32))
        with rosbag.Bag(self.bag, 'w') as bag:
            bag.write('/hdlyap/run_info', RunInfo(version='0.0.7'), rospy.Time(1))
            bag.write('/hdlyap/steps', other(), rospy.Time(1))
        self.check_refused('written by hdlyap 0.0.7, whose message hdlyap/Steps differs')
        with rosbag.Bag(self.bag, 'w') as bag:
            bag.write('/\x1b[2J/run_info', RunInfo(), rospy.Time(1))
        self.check_refused(r'damaged: topic /\?\[2J/run_info is no legal ROS name')
        for time_, said in ((math.nan, 'nan'), (1e10, r'1e\+10'), (-1.0, '-1')):
            with rosbag.Bag(self.bag, 'w') as bag:
                bag.write('/hdlyap/state', State(sim_time=time_, x=[0.5], y=[0.5]), rospy.Time(1))
            self.check_refused(rf'/hdlyap/state: sim_time = {said}: must be from 0 to 1e\+09')
        for pace in '0', 'nan':
            self.ends(self.process([*REPLAY, self.bag, '--pace', pace]), 2)

    def check_refused(self, words, *args):
        replay = self.process([*REPLAY, self.bag, *args])
        self.ends(replay, 1)
        self.assertRegex(replay.text(), r'\Ahdlyap replay: %s: .*%s.*\n\Z' % (self.bag, words))
