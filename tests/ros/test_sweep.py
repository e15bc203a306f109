#!/usr/bin/env python3
"""Several runs in one launch file, each in its own namespace; and what launch files say of
themselves."""

import glob
import os
import tempfile
import unittest
from xml.etree import ElementTree

import rosbag
from roslaunch import arg_dump
import roslib.packages
import rospkg
import rospy
import rostest

import harness
import made
from harness import Process
from made import T

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
DENSITIES = ['0.2', '0.65', '0.4']
GROUPS = ['density_0_2', 'density_0_65', 'density_0_4']


class Sweep(unittest.TestCase):
    def process(self, command, folder='.', **env):
        process = Process(command, PWD=folder, **env)
        self.addCleanup(process.stop)
        return process

    def table(self, text):
        """Of the lines below its head: densities with lambda_max, as printed."""
        lines = text.splitlines()
        self.assertRegex(text, '(?m)^density  lambda_max')
        head = next(k for k, line in enumerate(lines) if line.startswith('density  lambda_max'))
        return {
            line.split()[0]: line.split()[1]
            for line in lines[head + 1 : head + 1 + len(DENSITIES)]
            if line
        }

    def sweep(self, folder, *args, **env):
        return self.process(
            ['roslaunch', 'hdlyap', 'sweep.launch', 'scene:=quick', *args], folder, **env
        )

    def test_two_sweeps(self):
        """At once, of which one is recorded; the other, in a namespace and with a master of its
        own, has a density that is refused."""
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as other:
            recorded = self.sweep(
                folder,
                'densities:=' + ' '.join(DENSITIES),
                'record:=true',
                'seed:=5',
                'duration:=20',
            )
            seen = self.sweep(
                other,
                'densities:=0.3 2.5',
                'duration:=10',
                ROS_NAMESPACE='/lab',
                ROS_MASTER_URI='http://localhost:%d' % harness.free_port(),
            )
            recorded.wait()
            seen.wait()
            self.check_recorded(recorded, folder)
            self.check_seen(seen)
            self.assertEqual(os.listdir(other), [])

    def check_recorded(self, launch, folder):
        """One bag of each, whole, though the runs end one after the other; the table is that of the
        bags."""
        table = self.table(launch.text())
        self.assertEqual(list(table), sorted(DENSITIES), launch.text())
        paths = [os.path.join(folder, group + '.bag') for group in GROUPS]
        for path, group, density in zip(paths, GROUPS, DENSITIES):
            self.check_bag(path, '/%s/hdlyap' % group, float(density))
        again = self.process([roslib.packages.find_node('hdlyap', 'sweep_table')[0], *paths])
        self.assertEqual(again.wait(), 0, again.text())
        self.assertEqual(self.table(again.text()), table)

    def check_seen(self, launch):
        """The other run goes on to its end, and the table says what is missing."""
        self.assertEqual(list(self.table(launch.text()))[:1], ['0.3'], launch.text())
        self.assertEqual(
            len(launch.lines('sweep_table: density_2_5: no averages')), 1, launch.text()
        )
        self.assertEqual(len(launch.lines('FATAL')), 1)

    def check_bag(self, path, node, density):
        with rosbag.Bag(path) as bag:
            count = {
                topic: entry.message_count
                for topic, entry in bag.get_type_and_topic_info()[1].items()
            }
            info = next(message for _, message, _ in bag.read_messages(node + '/run_info'))
        self.assertEqual(count[node + '/spectrum'], 20)
        self.assertEqual((count[node + '/status'], count[node + '/cost']), (60, 60))
        self.assertEqual({topic.rsplit('/', 1)[0] for topic in count} - {''}, {node})
        self.assertEqual((info.density, info.threads, info.seed), (density, 1, '5'))

    def test_fits_on_different_bases_are_marked(self):
        """Of one form over the same wave numbers they share their number; a line explains each."""
        info, rows = made.run_info(), []
        with tempfile.TemporaryDirectory() as folder:
            for density, changes in (
                (0.5, {}),
                (0.4, {}),
                (0.6, dict(t_points=1, t_terms=1, t_k_max=0.99346, l_points=0, v_phases=0)),
            ):
                message = made.steps([made.step(info, T, 1, 0, 36, 37)])
                for name, value in changes.items():
                    setattr(message, name, value)
                rows.append(os.path.join(folder, f'{density}.bag'))
                made.write(
                    rows[-1], [made.run_info(density=density), made.spectrum([9.0], 50.0), message]
                )
            table = self.process([roslib.packages.find_node('hdlyap', 'sweep_table')[0], *rows])
            self.assertEqual(table.wait(), 0, table.text())
        self.assertEqual(
            [line.split() for line in table.text().strip().splitlines()[1:4]],
            [
                f'{density} 9.000(10) {fits} 50'.split()
                for density, fits in (
                    ('0.4', '1.400(12) [1] 1.500(20) [2] 1.612(23) [3]'),
                    ('0.5', '1.400(12) [1] 1.500(20) [2] 1.612(23) [3]'),
                    ('0.6', '1.400(12) [4]'),
                )
            ],
        )
        self.assertEqual(
            table.text().splitlines()[-4:],
            [
                '  [1] c k + c2 k^2 over 3 wave numbers 0.9935 .. 1.987',
                '  [2] c k + c2 k^2 over 2 wave numbers 0.9935 .. 1.405',
                '  [3] |omega| / k of the LP phases at 0.9935 .. 1.405',
                '  [4] c k over 1 wave number 0.9935',
            ],
        )

    def test_arguments_are_documented(self):
        """As `roslaunch --ros-args` lists them."""
        files = glob.glob(os.path.join(LAUNCH, '*.launch'))
        self.assertGreaterEqual(len(files), 5)
        for path in files:
            listed = arg_dump.get_args([path])
            for arg in ElementTree.parse(path).getroot().findall('arg'):
                name, doc = arg.get('name'), arg.get('doc')
                self.assertTrue(doc, '%s in %s' % (name, path))
                if arg.get('value') is None:
                    self.assertEqual(listed[name][0], doc, path)


if __name__ == '__main__':
    rospy.init_node('test_sweep')
    rostest.rosrun('hdlyap', 'sweep', Sweep)
