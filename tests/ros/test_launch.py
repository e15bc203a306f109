#!/usr/bin/env python3
"""Launch files: launching records whole runs."""

import os
import re
import signal
import tempfile

import rosbag
import roslaunch.config
import rospkg

import harness
from harness import Process

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')


class Launch(harness.Case):
    def roslaunch(self, folder, *args):
        process = Process(['roslaunch', 'hdlyap', *args], PWD=folder)
        self.addCleanup(process.stop)
        return process

    def test_record_and_replay(self):
        """A bag of the same name is kept; the launch ends by itself, with the result of the run."""
        with tempfile.TemporaryDirectory(prefix="o'brien's runs ") as folder:
            with open(os.path.join(folder, 'q.bag'), 'w') as file:
                file.write('of a year')
            run = self.roslaunch(
                folder,
                'run.launch',
                'scene:=quick',
                'duration:=30',
                'seed:=18446744073709551615',
                'record:=true',
                'bag:=q.bag',
                'checkpoint:=' + os.path.join(folder, 'kept'),
            )
            self.assertEqual(run.wait(), 0, run.text())
            bag = os.path.join(folder, 'q.bag')
            self.check_bag(bag)
            kept = os.path.join(folder, 'kept')
            self.check_result(run, 30, 'the bag is ' + bag, 'the checkpoint is ' + kept)
            self.assertEqual(sorted(os.listdir(folder)), ['kept', 'q.bag', 'q.bag.old'])
            self.assertEqual(len(run.lines('q.bag was there already')), 1, run.text())
            with open(bag + '.old') as file:
                self.assertEqual(file.read(), 'of a year')
            status = harness.Listener('status')
            self.addCleanup(status.close)
            replay = self.roslaunch(folder, 'replay.launch', 'bag:=' + bag, 'rate:=10')
            self.assertTrue(status.wait_for(harness.is_last))
            self.assertEqual(replay.wait(), 0, replay.text())

    def test_no_folder_for_a_bag(self):
        run = self.roslaunch('.', 'run.launch', 'record:=true', 'bag:=nowhere/q.bag')
        run.wait()
        self.assertEqual(len(run.lines('must be in a folder that is there')), 1, run.text())
        self.assertEqual(run.lines('Recording to'), [])

    def check_result(self, run, averaged, *words):
        """Is printed last."""
        result = run.text().split('result: ')[-1]
        self.assertRegex(result, r'averaged %s.* time units, lambda_max [0-9.]+' % averaged)
        self.assertRegex(result, r' T\(1,0\) .* [0-9.]+')
        self.assertRegex(result, r' c_T  [0-9.()]+ over \d+ wave number')
        for word in words:
            self.assertIn(word, result)

    def test_first_scene(self):
        """It finds T and LP steps with their errors, says so, goes on, and says its result when it
        is asked to end."""
        run = self.roslaunch('.', 'run.launch')
        row = r' %s\(1,0\) .* [0-9.]+\([0-9.]+\)'
        self.assertTrue(
            harness.wait_until(
                lambda: all(re.search(row % kind, run.text()) for kind in ('T', 'LP'))
            ),
            run.text(),
        )
        self.assertEqual(run.lines('result:'), [])
        self.assertTrue(run.running())
        run.send(signal.SIGINT)
        self.assertEqual(run.wait(), 0, run.text())
        self.check_result(run, '')

    def test_namespace(self):
        """Node, recorder and who prints meet in it, whatever the node's name is."""
        with tempfile.TemporaryDirectory() as folder:
            args = 'record:=true bag:=q.bag scene:=quick duration:=30'.split()
            run = self.roslaunch(folder, 'run.launch', '__ns:=grp', 'name:=a', *args)
            self.assertEqual(run.wait(), 0, run.text())
            self.check_result(run, 30, 'q.bag')
            with rosbag.Bag(os.path.join(folder, 'q.bag')) as bag:
                topics = set(bag.get_type_and_topic_info()[1])
            self.assertIn('/grp/a/steps', topics)

    def test_resumed_alone(self):
        """With the scene of the checkpoint."""
        args = ['checkpoint:=q.checkpoint', 'name:=kept', 'table:=0']
        with tempfile.TemporaryDirectory() as folder:
            first = self.roslaunch(folder, 'run.launch', 'scene:=quick', 'duration:=5', *args)
            self.assertEqual(first.wait(), 0, first.text())
            self.assertEqual(len(first.lines('finished at simulated time 45')), 1, first.text())
            more = self.roslaunch(
                folder, 'run.launch', 'resume:=q.checkpoint', 'duration:=10', *args
            )
            self.assertEqual(more.wait(), 0, more.text())
            self.assertEqual(len(more.lines('scene quick: 100 disks')), 1, more.text())
            self.assertEqual(len(more.lines('finished at simulated time 50')), 1, more.text())
            self.assertEqual(more.lines('averaged'), [])

    def replayed(self, *args):
        """Type of a node of replay.launch, or its command -> its arguments."""
        config = roslaunch.config.load_config_default(
            [(os.path.join(LAUNCH, 'replay.launch'), ['bag:=q.bag', *args])], 0
        )
        of_ours = {
            node.args.split()[0]: node.args for node in config.nodes if node.type == 'hdlyap'
        }
        return {**of_ours, **{node.type: node.args for node in config.nodes}}

    def test_replay_in_rviz_stays(self):
        self.assertNotIn('--keep-alive', self.replayed()['replay'])
        looked_at = self.replayed('rviz:=true', 'node:=/other')
        self.assertIn('--keep-alive', looked_at['replay'])
        self.assertIn('--look=/other', looked_at['replay'])
        self.assertEqual(looked_at['view'], 'view --node /other')
        self.assertIn('viewer', looked_at)
        self.assertNotIn('viewer', self.replayed('rviz:=true', 'viewer:=false'))
        self.assertNotIn('view', self.replayed('viewer:=true'))
        self.assertIn('--rate=1.0', self.replayed()['replay'])
        self.assertIn('--pace=2.5', self.replayed('pace:=2.5')['replay'])

    def check_bag(self, path):
        with rosbag.Bag(path) as bag:
            messages = [(topic, message) for topic, message, _ in bag.read_messages()]
        count = {
            name: sum(topic == '/hdlyap/' + name for topic, _ in messages) for name in harness.TYPES
        }
        fields = sum(
            len(harness.examples(message.steps))
            for topic, message in messages
            if topic == '/hdlyap/steps' and message.sim_time - 40 in (1, 10, 20, 30)
        )
        self.assertEqual(
            count,
            dict(
                run_info=1,
                spectrum=30,
                modes=30,
                steps=30,
                lp_phases=30,
                t_phases=0,
                fields=fields,
                hydro=0,
                structure=0,
                localization=0,
                gas=0,
                state=70,
                status=70,
                cost=70,
            ),
        )
        info = next(message for topic, message in messages if topic == '/hdlyap/run_info')
        self.assertEqual(
            (info.seed, info.duration, info.disks), ('18446744073709551615', 30.0, 100)
        )

    def test_what_is_refused_ends_the_launch(self):
        """With one line of what is wrong; no bag is touched."""
        refused = {
            'duration:=-1': 'duration = -1: must be from 0',
            'duration:=abc': 'duration = abc: must be a number',
            'params:={disk: 50}': 'disk = 50: must be removed',
            'table:=often': 'table = often: must be a number',
        }
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'q.bag'), 'w') as file:
                file.write('of a year')
            runs = {
                argument: self.roslaunch(
                    folder,
                    'run.launch',
                    argument,
                    'name:=refused_%d' % k,
                    'record:=true',
                    'bag:=q.bag',
                )
                for k, argument in enumerate(refused)
            }
            for argument, run in runs.items():
                with self.subTest(argument=argument):
                    run.wait()
                    self.assertEqual(len(run.lines('FATAL')), 1, run.text())
                    self.assertEqual(len(run.lines(refused[argument])), 1, run.text())
                    self.assertEqual(len(run.lines('exit code 2')), 1, run.text())
                    self.assertNotIn('<param', run.text())
            self.assertEqual(os.listdir(folder), ['q.bag'])

    def test_who_is_waited_for_is_said(self):
        """At once, and again after ten seconds."""
        node = harness.start(dict(harness.SHORT, wait_for_subscribers=['steps', 'cost']), 'alone')
        self.addCleanup(node.stop)
        missing = 'waiting for subscribers of /alone: steps, cost'
        self.assertTrue(harness.wait_until(lambda: node.lines(missing)), node.text())
        self.assertEqual(node.lines('still ' + missing), [])
        self.assertTrue(harness.wait_until(lambda: node.lines('still ' + missing)), node.text())


if __name__ == '__main__':
    harness.main('launch')
