#!/usr/bin/env python3
"""Scene and launch files: every scene runs as it is written, launching records whole runs."""

import os
import signal
import tempfile
import unittest

import rosbag
import roslaunch.config
import rospkg
import rospy
import rostest
import yaml

import harness
from harness import Process

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
SCENES = sorted(name[:-5] for name in os.listdir(os.path.join(LAUNCH, 'scenes')))


def load(scene):
    with open(os.path.join(LAUNCH, 'scenes', scene + '.yaml')) as file:
        return yaml.safe_load(file)


class Launch(unittest.TestCase):
    def test_scenes(self):
        for scene in SCENES:
            with self.subTest(scene=scene):
                self.check_scene(scene, load(scene))

    def check_scene(self, scene, params):
        listener = harness.Listener('run_info')
        self.addCleanup(listener.close)
        node = harness.start(params)
        self.addCleanup(node.stop)
        self.assertTrue(listener.wait_for(lambda message: True), node.text())
        node.send(signal.SIGINT)
        self.assertEqual(node.wait(), 0, node.text())
        listener.close()
        info = listener.messages[0]
        self.assertEqual(info.scene, scene)
        params = dict(harness.defaults(), **params)
        params['exponents'] = str(params['exponents'])
        self.assertEqual(params.pop('interval'), 'auto')
        if params['warmup'] == 'auto':
            params['warmup'] = info.warmup  # chosen
            self.assertGreaterEqual(info.warmup, 20.0 if info.vectors else 0.0)
        self.assertIn(params.pop('threads'), (0, info.threads))
        for name, value in params.items():
            self.assertEqual(getattr(info, name), value, name)

    def test_scenes_list_what_is_not_as_usual(self):
        """paper_periodic lists all."""
        usual = harness.defaults()
        self.assertEqual(set(load('paper_periodic')), set(usual))
        for scene in SCENES:
            if scene != 'paper_periodic':
                for name, value in load(scene).items():
                    self.assertNotEqual(value, usual[name], (scene, name))

    def roslaunch(self, folder, *args):
        process = Process(['roslaunch', 'hdlyap', *args], PWD=folder)
        self.addCleanup(process.stop)
        return process

    def test_record_and_replay(self):
        with tempfile.TemporaryDirectory() as folder:
            run = self.roslaunch(
                folder,
                'run.launch',
                'scene:=quick',
                'duration:=30',
                'seed:=18446744073709551615',
                'record:=true',
                'bag:=q.bag',
            )
            self.assertEqual(run.wait(), 0, run.text())
            bag = os.path.join(folder, 'q.bag')
            self.check_bag(bag)
            status = harness.Listener('status')
            self.addCleanup(status.close)
            replay = self.roslaunch(folder, 'replay.launch', 'bag:=' + bag, 'rate:=10')
            self.assertTrue(status.wait_for(harness.is_last))
            self.assertEqual(replay.wait(), 0, replay.text())

    def replayed(self, *args):
        """Type of a node of replay.launch -> its arguments."""
        config = roslaunch.config.load_config_default(
            [(os.path.join(LAUNCH, 'replay.launch'), ['bag:=q.bag', *args])], 0
        )
        return {node.type: node.args for node in config.nodes}

    def test_replay_in_rviz_stays(self):
        self.assertNotIn('--keep-alive', self.replayed()['replay'])
        looked_at = self.replayed('rviz:=true', 'node:=/other')
        self.assertIn('--keep-alive', looked_at['replay'])
        self.assertIn('--look=/other', looked_at['replay'])
        self.assertEqual(looked_at['view'], '--node /other')
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
                fields=fields,
                hydro=0,
                state=70,
                status=70,
                cost=70,
            ),
        )
        info = next(message for topic, message in messages if topic == '/hdlyap/run_info')
        self.assertEqual(
            (info.seed, info.duration, info.disks), ('18446744073709551615', 30.0, 100)
        )

    def test_refused_scene_ends_the_launch(self):
        with tempfile.TemporaryDirectory() as folder:
            run = self.roslaunch(folder, 'run.launch', 'scene:=quick', 'duration:=-1')
            run.wait()
            self.assertEqual(len(run.lines('FATAL')), 1, run.text())
            self.assertEqual(len(run.lines('exit code 2')), 1, run.text())


if __name__ == '__main__':
    rospy.init_node('test_launch')
    rostest.rosrun('hdlyap', 'launch', Launch)
