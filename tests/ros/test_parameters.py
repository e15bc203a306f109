#!/usr/bin/env python3
"""Parameters as ROS hands them on: types of the parameter server, lists of the command line, scenes
that are started. What each may be is tested without nodes, in test_refusals.cpp."""

import os
import re
import subprocess

import rosgraph
import rospy
import yaml

import harness
from harness import SHORT

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../launch/scenes')
HEARD = dict(wait_for_subscribers=['run_info'])
# what a scene file cannot say, or says in another type
REFUSED = [
    ('density', float('nan')),
    ('duration', float('inf')),
    ('warmup', True),
    ('seed', 1.0),
    ('exponents', ['all']),
    ('observables', [[1]]),
    ('field_indices', [True]),
    ('interval', dict(auto=1)),
    ('scene', 'quick'),
]
ARGUMENTS = {
    'argument disks=5: must be _parameter:=value': 'disks=5',
    'observables = [fields, spectra]: must be a list out of ': '_observables:=[fields,spectra]',
    'field_indices = [0]: must be steps or a list of integers from 1 to 37': '_field_indices:=[0]',
}
TAKEN = dict(
    scene='mine',
    disks=30,
    density=0.6,
    aspect=0.5,
    boundary_x='reflecting',
    boundary_y='periodic',
    seed='12345678901234',
    exponents='7',
    equilibration=0.5,
    warmup=0.75,
    duration=2.0,
    target_std_error=1.0e-6,
    interval=0.5,
    accuracy=1.0e-7,
    report_interval=0.25,
    max_mode_number=1,
    observables=['spectrum', 'modes', 'state'],
    threads=1,
    pace=1.0e3,
    checkpoint_interval=5.0,
    wait_for_subscribers=['run_info', 'state'],
)


class Parameters(harness.Case):
    def test_refused(self):
        """In one line, before anything happens."""
        nodes = {
            name
            + ' = ': self.start(
                {name: value} if name == 'scene' else dict(SHORT, **{name: value}),
                name='refused_' + name,
            )
            for name, value in REFUSED
        }
        for k, (line, argument) in enumerate(ARGUMENTS.items()):
            nodes[line] = self.start(SHORT, name='refused_%d' % k, args=[argument])
        for line, node in nodes.items():
            with self.subTest(line=line):
                self.ends(node, 2)
                self.assertEqual(len(node.text().splitlines()), 1, node.text())
                self.assertRegex(
                    node.text(), r'\[FATAL\] \[[0-9.]+\]: %s.*must be ' % re.escape(line[:16])
                )
                self.assertIn(line, node.text())
        # the master remembers the type of every topic that was ever advertised
        types = dict(rosgraph.Master('/test').getTopicTypes())
        self.assertEqual([topic for topic in types if topic.startswith('/refused')], [])

    def test_too_many_disks(self):
        """Known before the first block is asked for: how much, how much there is, what fits."""
        for disks in (40000, 1000000):
            with self.subTest(disks=disks):
                node = self.start(dict(disks=disks))
                self.ends(node, 3)
                self.assertEqual(len(node.text().splitlines()), 1, node.text())
                self.assertRegex(
                    node.text(),
                    rf'out of memory: disks = {disks} with {2 * disks - 3} exponents need \S+ GB, '
                    r'there are \S+ GB \(\w+\); exponents = \d+ would fit, or disks = \d+',
                )

    def told(self, node, info):
        """run_info, and that the node ends well."""
        self.assertTrue(info.wait_for(lambda message: True), node.text())
        if node.running():
            self.interrupt(node)
        info.close()
        return info.messages[0]

    def test_taken(self):
        """And what is below the node's name on the parameter server stays what was set there."""
        info, _ = self.listen('run_info'), self.listen('state')
        node = self.runs(TAKEN)
        self.assertEqual(rospy.get_param('/hdlyap'), TAKEN)
        message = self.told(node, info)
        for name, value in TAKEN.items():
            self.assertEqual(getattr(message, name), value, name)

    def test_lists_on_the_command_line(self):
        info = self.listen('run_info')
        args = ['_observables:=[fields, state]', '_field_indices:=[1, 7]']
        message = self.told(self.start(dict(SHORT, **HEARD), args=args), info)
        self.assertEqual(
            (message.observables, message.field_indices), (['fields', 'state'], '[1, 7]')
        )

    def test_scenes(self):
        """Some of them start as they are written; without parameters it is paper_periodic."""
        for scene, vectors in dict(quick=197, trajectory_only=0, paper_periodic=1557).items():
            with self.subTest(scene=scene):
                params = {}
                if scene != 'paper_periodic':
                    with open(os.path.join(SCENES, scene + '.yaml')) as file:
                        params = yaml.safe_load(file)
                message = self.told(self.start(dict(params, **HEARD)), self.listen('run_info'))
                self.assertEqual((message.scene, message.vectors), (scene, vectors))
                for name, value in params.items():
                    self.assertEqual(str(getattr(message, name)), str(value), name)
                self.assertAlmostEqual(
                    message.box_x * message.box_y * message.density, message.disks
                )

    def test_without_a_master(self):
        env = dict(os.environ, ROS_MASTER_URI='http://localhost:1')
        for argument, said in (
            ('--help', 'Exit status: 0 finished or stopped, 2 refused'),
            ('--version', r'^hdlyap \d+\.\d+\.\d+$'),
            ('--parameters', '(?m)^disks: 780$'),
        ):
            done = subprocess.run(
                [harness.executable(), argument],
                env=env,
                timeout=harness.PATIENCE,
                text=True,
                capture_output=True,
            )
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            self.assertRegex(done.stdout.strip(), said)


if __name__ == '__main__':
    harness.main('parameters')
