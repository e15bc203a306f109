#!/usr/bin/env python3
"""hdlyap replay: when it says what a bag holds, for whom it waits, and what it refuses."""

import os
import threading
import time
import types
from unittest import mock

import rosbag
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from visualization_msgs.msg import MarkerArray

import harness
import made
from hdlyap.commands.replay import Clock
from hdlyap.msg import RunInfo, RunStatus, State, Steps

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
        self.heard = []  # (wall time, type, simulated time)

    def record(self, *runs, ahead=0):
        """ahead: messages of each run before the clock is set back by an hour."""
        with rosbag.Bag(self.bag, 'w') as bag:
            for number, run_id in enumerate(runs):
                for k, (topic, message) in enumerate(run(run_id)):
                    seconds = 10 * (number + 1) + (3600 if k < ahead else 0)
                    bag.write(topic, message, rospy.Time(seconds, 1000000 * k))

    def listen_to(self, *topics):
        kinds = dict(run_info=RunInfo, status=RunStatus, state=State)
        for name in topics:
            subscriber = rospy.Subscriber(
                '/hdlyap/' + name, kinds[name], self.keep, name, queue_size=None
            )
            self.addCleanup(subscriber.unregister)

    def keep(self, message, name):
        self.heard.append((time.monotonic(), name, getattr(message, 'sim_time', None)))

    def replay(self, *args):
        process = self.process([*REPLAY, self.bag, *args])
        return process

    def times(self, name):
        return [time_ for _, kind, time_ in self.heard if kind == name]

    def test_by_simulated_time(self):
        """Evenly, however fast the run was and in whatever order its topics were recorded; one run
        after the other."""
        self.record('one', 'two')
        self.listen_to('state', 'status', 'run_info')
        replay = self.replay('--pace', '20', '--wait')
        diagnostics = rospy.Subscriber('/diagnostics', DiagnosticArray, lambda message: None)
        self.addCleanup(diagnostics.unregister)
        self.ends(replay)
        self.sees(lambda: len(self.heard) == 2 * (1 + 2 * REPORTS))
        for name in ('state', 'status'):
            self.assertEqual(self.times(name), 2 * list(range(1, REPORTS + 1)))
        walls = [wall for wall, name, _ in self.heard if name == 'state'][:REPORTS]
        self.assertGreater(walls[-1] - walls[0], 0.95 * (REPORTS - 1) / 20)
        half = REPORTS // 2  # one message may come late on a busy machine
        spans = [later - walls[k] for k, later in enumerate(walls[half:])]
        self.assertGreater(max(spans), 0.95 * half / 20)
        self.assertIn('replay: at the end, t = 30', replay.text())

    def test_late_messages_delay_nothing(self):
        """Covariant vectors are of times long past."""
        running = threading.Event()
        running.set()
        wall = types.SimpleNamespace(now=0.0)
        with mock.patch('hdlyap.commands.replay.time') as clock:
            clock.monotonic = lambda: wall.now
            clock.sleep = lambda seconds: setattr(wall, 'now', wall.now + seconds)
            due = Clock(types.SimpleNamespace(pace=2.0, rate=1.0), running)
            for time_ in (1.0, 11.0, 3.0, 5.0, 12.0):
                due.wait_for(types.SimpleNamespace(run='one', time=time_, wall=0.0))
        self.assertAlmostEqual(wall.now, 5.5)

    def test_clock_set_back(self):
        """What follows takes its time, too: a message each millisecond, fifty times as slow."""
        self.record('one', ahead=2 + REPORTS)
        self.listen_to('state', 'status')
        replay = self.replay('--rate', '0.02')
        self.ends(replay)
        self.sees(lambda: len(self.heard) == 2 * REPORTS)
        self.assertEqual(self.times('state'), list(range(1, REPORTS + 1)))
        walls = [wall for wall, name, _ in self.heard if name == 'state']
        after = range(REPORTS // 2, REPORTS // 2 + 5)  # one may come late on a busy machine
        paces = [(walls[-1] - walls[k]) / (REPORTS - 1 - k) for k in after]
        self.assertGreater(max(paces), 0.95 / 20)

    def test_from_some_time_on(self):
        self.record('one')
        self.listen_to('state', 'run_info')
        replay = self.replay('--pace', '1000', '--begin', '28', '--keep-alive')
        self.sees(lambda: replay.lines('at the end'), replay)
        self.sees(lambda: self.times('run_info'))
        self.assertLessEqual(set(self.times('state')), {28.0, 29.0, 30.0})

    def test_waits_for_who_looks(self):
        """Not for hdlyap view, which is told what the run is, and opens rviz then."""
        self.record('one')
        self.listen_to('run_info', 'state', 'status')
        replay = self.replay('--pace', '1000', '--look', '/hdlyap')
        self.sees(lambda: self.times('run_info'), replay)
        self.process([*harness.command('view'), '--node', '/hdlyap'], DISPLAY=':0')
        self.sees(lambda: self.looks('/view_'))
        time.sleep(0.3)  # replay asks every 0.1 s
        self.assertEqual(self.times('state'), [])
        look = rospy.Subscriber('/hdlyap/markers', MarkerArray, lambda message: None)
        self.addCleanup(look.unregister)
        self.ends(replay)
        self.sees(lambda: len(self.times('state')) == REPORTS)
        self.assertEqual(self.times('state')[0], 1.0)

    def looks(self, name):
        topics = dict(rosgraph.Master('/test').getSystemState()[1])
        return any(who.startswith(name) for who in topics.get('/hdlyap/markers', ()))

    def test_nothing_is_lost_at_the_start(self):
        """For who has subscribed; the whole bag takes a moment."""
        self.record('one')
        self.listen_to('state', 'status')
        replay = self.replay('--rate', '1000')
        self.ends(replay)
        self.assertTrue(harness.wait_until(lambda: len(self.heard) == 2 * REPORTS), self.heard)

    def test_what_is_refused(self):
        """In one line."""
        with open(self.bag, 'w') as file:
            file.write('no bag')
        self.check_refused('not a readable bag')
        self.record('one')
        size = os.path.getsize(self.bag)
        self.check_refused('no messages from t = 31 on', '--begin', '31')
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
        for args in (('--pace', '0'), ('--rate', 'nan'), ('--rate', '2', '--pace', '2')):
            replay = self.replay(*args)
            self.ends(replay, 2)

    def check_refused(self, words, *args):
        replay = self.replay(*args)
        self.ends(replay, 1)
        self.assertRegex(replay.text(), r'\Ahdlyap replay: %s: .*%s.*\n\Z' % (self.bag, words))


if __name__ == '__main__':
    harness.main('replay')
