#!/usr/bin/env python3
"""Every parameter: what is refused, with which words, and what is taken."""

import os
import re
import subprocess
import unittest

import rosgraph
import rospy
import rostest

import harness
from harness import SHORT

NAN, INFINITY = float('nan'), float('inf')
AT_ONCE = 8  # nodes: they spend most of their short life waiting
TIME = [-1, -1e-9, 2e12, 'x', '', [1.0], True, NAN, INFINITY]

# with covariant vectors, if it were longer
WINDOW = dict(
    observables=['covariant'], covariant_transient=1.0, covariant_window=1.0, covariant_sampling=1.0
)
COVARIANT = [0, -1, 0.9e-6, 2e12, 'x', '', [1.0], True, NAN, INFINITY]

# values that are refused whatever the other parameters are
BAD = dict(
    scene=[5, '', ['quick']],
    disks=['780', 780.0, 1, 0, -3, 1000001, True],
    density=['x', 0, -0.1, 1.1548, NAN, INFINITY, [0.8], False],
    aspect=['x', 0, -1, 1e7, NAN, INFINITY],
    boundary_x=['open', '', 1, 'Periodic'],
    boundary_y=['open', '', 1, ['periodic']],
    seed=['', '-1', '+1', ' 1', '1.5', '0x1', 'x', '18446744073709551616', 1.0, -1, True],
    exponents=['some', '', '0', '-1', '1.0', 0, -1, -2, 2.0, 81, '81', '99999999999', ['all']],
    equilibration=TIME,
    warmup=TIME,
    duration=TIME,
    target_std_error=TIME,
    interval=[0, 0.0, -1, 2e12, 'never', '', NAN, INFINITY, True],
    accuracy=[0, 0.9e-12, 1.1e-2, 'x', NAN, INFINITY],
    report_interval=[0, -1, 2e12, 'x', NAN, INFINITY],
    phase_interval=[0, 0.0, -1, 2e12, 'never', '', NAN, INFINITY, True],
    observables=[
        ['covariants'],
        ['modes', 'covariance'],
        ['run_info'],
        ['cost'],
        ['spectra'],
        [''],
        'spectrum',
        5,
        [1],
        True,
    ],
    threads=[-1, 1025, 1.0, '2'],
    wait_for_subscribers=[['nothing'], ['spectrum', ''], 'spectrum', 5, [1]],
    pace=[-1, 2e12, 'x', NAN, INFINITY],
    slow_vectors_rate=[0, 101, 'x', NAN],
    slow_vectors_count=['x', 1.5],
    max_wave_number=[-1, 1.1, 2.7, 2e12, 'x', '', [1], NAN, INFINITY, True],
    max_mode_number=[-1, 3, 1000001, 1.0, '2', '', [2], False],
    field_indices=[
        '',
        'all',
        'Steps',
        5,
        1.0,
        [],
        ['1'],
        [1.0],
        [1, 'steps'],
        [True],
        [[1]],
        [0],
        [-1],
        [38],
        [1, 2, 1000000],
    ],
    field_interval=TIME,
    changes=[
        '5 pace=1',
        5,
        [5],
        [''],
        ['pace=1'],
        ['5pace=1'],
        ['-5 pace=1'],
        ['nan pace=1'],
        ['inf pace=1'],
        ['5 pace'],
        ['5 pace=-1'],
        ['5 pace=nan'],
        ['5 pace=1', '6 disks=50'],
        ['5 paces=1'],
    ],
    checkpoint=[5, True, ['file']],
    checkpoint_interval=[-1, 2e12, 'x', NAN, INFINITY],
    resume=[5, True, ['file']],
    covariant_window=COVARIANT,
    covariant_transient=COVARIANT,
    covariant_sampling=COVARIANT,
    covariant_memory=[0, -1, 0.9e-3, 1.1e6, 'x', '', [1.0], True, NAN, INFINITY],
    covariant_storage=['', 'disk', 'file', 'Memory', 5, ['memory']],
    densty=[0.8],
    Disks=[100],
)
# what is no parameter any more, and a word about what it is now
GONE = dict(max_node=(2, 'max_mode_number'), covariant_folder=('/tmp', 'covariant_storage'))

# values that are refused together: the name that the line begins with, and the parameters
BAD_TOGETHER = [
    ('density', dict(density=1.1)),
    ('density', dict(disks=100, aspect=0.0001)),
    ('density', dict(disks=2, density=1.01)),
    ('exponents', dict(disks=5, exponents=21)),
    ('observables', dict(exponents='none', observables=['spectrum'])),
    ('observables', dict(exponents='none', observables=['state', 'modes'])),
    ('observables', dict(exponents='none', observables=['hydro'])),
    ('phase_interval', dict(phase_interval=1.0, observables=['steps'])),
    ('max_mode_number', dict(max_mode_number=1, max_wave_number=1.5)),
    ('max_mode_number', dict(max_mode_number=3, disks=20, aspect=0.9)),
    ('max_mode_number', dict(max_mode_number=1, observables=['spectrum', 'state'])),
    ('max_mode_number', dict(max_mode_number=1, exponents='none')),
    ('max_wave_number', dict(max_wave_number=1.5, observables=[])),
    ('observables', dict(exponents='none', observables=['state', 'covariant'])),
    ('covariant_window', dict(covariant_window=49.0)),
    ('covariant_transient', dict(covariant_transient=99.0)),
    ('covariant_sampling', dict(covariant_sampling=4.0)),
    ('covariant_memory', dict(covariant_memory=3.0)),
    ('covariant_storage', dict(covariant_storage='recompute')),
    *(
        (name, dict(WINDOW, **{name: value}))
        for name in ('covariant_window', 'covariant_transient', 'covariant_sampling')
        for value in (0, -1, 2e12, NAN)
    ),
    ('covariant_sampling', dict(WINDOW, covariant_sampling=1.5)),
    ('covariant_window', dict(WINDOW, disks=400, duration=1e6, covariant_window=1e5)),
    ('warmup', dict(WINDOW, covariant_transient=1.5)),
    ('duration', dict(WINDOW, covariant_window=1.5)),
    ('field_indices', dict(WINDOW, field_indices=[1])),
    ('field_indices', dict(field_indices=[1], observables=['modes', 'steps'])),
    ('field_indices', dict(field_indices=[1], exponents='none')),
    ('field_indices', dict(field_indices=[3], exponents=2)),
    ('slow_vectors_count', dict(slow_vectors_count=3, exponents=2)),
    ('slow_vectors_count', dict(slow_vectors_count=-1)),
    ('wait_for_subscribers', dict(observables=['state'], wait_for_subscribers=['spectrum'])),
    ('wait_for_subscribers', dict(exponents='none', wait_for_subscribers=['spectrum'])),
]

# values that are taken, with the field of run_info that shows them
GOOD = [
    (dict(duration='1.5'), dict(duration=1.5)),
    (dict(duration='1e0', accuracy='1e-6'), dict(duration=1.0, accuracy=1e-6)),
    (dict(duration=1), dict(duration=1.0)),
    (dict(exponents='5'), dict(exponents='5', vectors=5)),
    (dict(exponents=5), dict(exponents='5', vectors=5)),
    (dict(exponents='all'), dict(exponents='all', vectors=80)),
    (dict(exponents='none'), dict(exponents='none', vectors=0, observables=['state'])),
    (dict(seed=7), dict(seed='7')),
    (dict(seed='18446744073709551615'), dict(seed='18446744073709551615')),
    (dict(observables=[]), dict(observables=[])),
    (dict(observables=['state', 'spectrum']), dict(observables=['spectrum', 'state'])),
    (dict(interval='auto'), dict(interval=0.0)),
    (dict(interval=0.25, threads=1), dict(interval=0.25, threads=1)),
    (dict(boundary_x='reflecting'), dict(boundary_x='reflecting', zero_exponents=4)),
    (dict(max_mode_number=1), dict(max_mode_number=1, wave_nx=(1, 0, 1), wave_ny=(0, 1, 1))),
    (dict(max_wave_number='1.2'), dict(max_wave_number=1.2, wave_nx=(1, 0), wave_ny=(0, 1))),
    (
        dict(max_wave_number=0, max_mode_number=0, observables=['spectrum']),
        dict(max_wave_number=0.0, max_mode_number=0, wave_nx=(), wave_ny=()),
    ),
    (dict(field_indices='steps'), dict(field_indices='steps')),
    (dict(field_indices='steps', exponents='none'), dict(field_indices='steps', wave_nx=())),
    (dict(field_indices=[37, 1]), dict(field_indices='[37, 1]')),
    (
        dict(field_interval=0, observables=['state']),
        dict(field_interval=0.0, observables=['state']),
    ),
    (dict(field_interval='2.5'), dict(field_interval=2.5, wait_for_subscribers=['run_info'])),
    (
        dict(
            covariant_window=50,
            covariant_transient='100',
            covariant_sampling=5.0,
            covariant_memory=4,
            covariant_storage='memory',
        ),
        dict(covariant_storage='memory', covariant_memory=4.0),
    ),
    (
        dict(WINDOW, max_mode_number=1, exponents=3),
        dict(
            observables=['covariant'],
            wave_nx=(1, 0, 1),
            covariant_window=1.0,
            covariant_transient=1.0,
        ),
    ),
    (
        dict(
            WINDOW,
            duration=3.0,
            covariant_storage='recompute',
            covariant_memory='0.25',
            covariant_sampling=0.5,
        ),
        dict(
            covariant_storage='recompute',
            covariant_memory=0.25,
            covariant_sampling=0.5,
            covariant_transient=1.0,
        ),
    ),
    (dict(observables=['hydro', 'steps']), dict(observables=['steps', 'hydro'])),
    (
        dict(checkpoint='', checkpoint_interval=0.0, resume=''),
        dict(checkpoint='', checkpoint_interval=0.0, resumed_time=-1.0),
    ),
]


class Parameters(unittest.TestCase):
    def check_refused(self, cases):
        """cases: (what the line begins with, what is in it, parameters, arguments)."""
        for first in range(0, len(cases), AT_ONCE):
            some = cases[first : first + AT_ONCE]
            nodes = [
                harness.start(params, 'refused_%d' % k, args=args)
                for k, (_, _, params, args) in enumerate(some)
            ]
            for node, (begin, value, params, _) in zip(nodes, some):
                self.addCleanup(node.stop)
                with self.subTest(params=params):
                    self.refused(node, begin, value)
        self.assert_nothing_seen()

    def refused(self, node, begin, value):
        self.assertEqual(node.wait(), 2, node.text())
        self.assertEqual(len(node.text().splitlines()), 1, node.text())
        self.assertRegex(node.text(), r'\[FATAL\] \[[0-9.]+\]: %s.*must be ' % re.escape(begin))
        self.assertIn(value, node.text())

    def assert_nothing_seen(self):
        # the master remembers the type of every topic that was ever advertised
        types = dict(rosgraph.Master('/test').getTopicTypes())
        self.assertEqual([topic for topic in types if topic.startswith('/refused')], [])

    def test_refused(self):
        self.check_refused(
            [
                (name + ' = ', shown(value), dict(SHORT, **{name: value}), [])
                for name, values in BAD.items()
                for value in values
            ]
        )

    def test_every_parameter_is_refused(self):
        """With a value of a type that none has."""
        self.check_refused(
            [(name + ' = ', '', dict(SHORT, **{name: [[1]]}), []) for name in harness.defaults()]
        )

    def test_gone(self):
        self.check_refused(
            [
                (name + ' = ', now, dict(SHORT, **{name: value}), [])
                for name, (value, now) in GONE.items()
            ]
        )

    def test_refused_together(self):
        self.check_refused(
            [(name + ' = ', '', dict(SHORT, **params), []) for name, params in BAD_TOGETHER]
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
                timeout=10,
                text=True,
                capture_output=True,
            )
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            self.assertRegex(done.stdout.strip(), said)

    def test_refused_argument(self):
        self.check_refused([('argument disks=5', '', SHORT, ['disks=5'])])

    def test_taken(self):
        for params, shows in GOOD:
            with self.subTest(params=params):
                self.taken(params, shows)

    def test_lists_on_the_command_line(self):
        self.taken(
            {},
            dict(observables=['fields', 'state'], field_indices='[1, 7]'),
            args=['_observables:=[fields, state]', '_field_indices:=[1, 7]'],
        )
        self.check_refused(
            [
                ('observables', '[fields, spectra]', SHORT, ['_observables:=[fields,spectra]']),
                ('field_indices', '[0]', SHORT, ['_field_indices:=[0]']),
            ]
        )

    def taken(self, params, shows, args=()):
        listener = harness.Listener('run_info')
        self.addCleanup(listener.close)
        node = harness.start(dict(SHORT, wait_for_subscribers=['run_info'], **params), args=args)
        self.addCleanup(node.stop)
        self.assertEqual(node.wait(), 0, node.text())
        self.assertTrue(listener.wait_for(lambda info: True))
        for field, value in shows.items():
            self.assertEqual(getattr(listener.messages[0], field), value)
        listener.close()

    def test_scene_names(self):
        """A name alone chooses no system, and the usual one's is nobody else's."""
        begin = 'scene = '
        self.check_refused(
            [
                (begin, 'quick', dict(scene='quick'), []),
                (begin, 'given with its disks', dict(scene='quick', duration=5.0), []),
            ]
        )
        self.taken({}, dict(scene='unnamed'))
        self.taken(dict(scene='mine'), dict(scene='mine'))

    def test_defaults(self):
        listener = harness.Listener('run_info')
        self.addCleanup(listener.close)
        node = harness.start({})
        self.addCleanup(node.stop)
        self.assertTrue(listener.wait_for(lambda info: True), node.text())
        info = listener.messages[0]
        want = dict(harness.defaults(), vectors=1557, zero_exponents=6)
        want.update(wave_nx=(1, 0, 1, 2, 0, 2, 1, 2), wave_ny=(0, 1, 1, 0, 2, 1, 2, 2))
        for name in ('interval', 'phase_interval'):
            self.assertEqual((want.pop(name), getattr(info, name)), ('auto', 0.0))
        self.assertEqual(want.pop('warmup'), 'auto')
        self.assertAlmostEqual(info.warmup, 97.48, delta=0.01)  # 3 / (0.05 c_T k), c_T = 3.285
        self.assertEqual(want.pop('threads'), 0)
        for field, value in want.items():
            self.assertEqual(getattr(info, field), value, field)


def shown(value):
    """As the node shows it: not every number as python does."""
    return value if isinstance(value, str) else ''


if __name__ == '__main__':
    rospy.init_node('test_parameters')
    rostest.rosrun('hdlyap', 'parameters', Parameters)
