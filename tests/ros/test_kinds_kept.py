"""Each kind of particles interrupted, and on two ranks; their checkpoints and scene files."""

import os
import shutil
import unittest

import numpy as np

import bags
import harness
import made
import test_kinds
from hdlyap.numbers import with_error
from of_kind import REST
from test_check import check_scenes
from test_ranks import ENVIRONMENT, mpirun

pytestmark = harness.UNDER_A_MASTER
# between walls that shear
FLOW = dict(number=24, density=0.4, aspect=0.4, boundary_y='shearing', shear_b=5.0, scene='flow')
FLOW.update(equilibration=10.0, warmup=60.0, duration=40.0, report_interval=1.0, threads=1)
FLOW.update(observables=['spectrum', 'modes', 'steps', 'localization', 'gas', 'state'])
FLOW.update(wait_for_subscribers='all')


class Again(harness.Case):
    # without windows of covariant vectors: one that is under way begins anew
    KINDS = [
        {name: value for name, value in scene.items() if not name.startswith('covariant')}
        for scene in (
            test_kinds.Dumbbells.SCENE,
            test_kinds.Mixture.SCENE,
            test_kinds.SoftDisks.SCENE,
        )
    ]
    for one in KINDS:
        one.update(observables=[name for name in REST if name != 'covariant'], duration=40.0)
        one.update(wait_for_subscribers='all', report_interval=1.0)
    KINDS.append(FLOW)

    def test_a_resumed_run_is_the_uninterrupted_one(self):
        for scene in self.KINDS:
            kept = os.path.join(self.new_folder(), 'run.checkpoint')
            whole = self.recorded(scene)
            first = self.recorded(dict(scene, checkpoint=kept, pace=20.0), stop_after=90.0)
            second = self.recorded(dict(scene, resume=kept))
            self.assertLess(second['run_info'][0].resumed_time, 105.0)
            for topic in scene['observables']:
                with self.subTest(scene=scene['scene'], topic=topic):
                    self.assertTrue(second[topic])
                    self.assert_same_bits(first[topic] + second[topic], whole[topic])

    @unittest.skipUnless(shutil.which('mpirun'), 'one rank')
    def test_two_ranks_are_as_one(self):
        """The same particles, and the same exponents, parts of rotation to what these are known."""
        for scene in self.KINDS:
            one = self.recorded(scene)
            two = self.recorded(scene, command=mpirun(), **ENVIRONMENT)
            self.assertEqual(two['run_info'][0].ranks, 2)
            self.assert_same_bits(two['state'], one['state'])
            bound = one['cost'][-1].error_bound + two['cost'][-1].error_bound
            both = [run['spectrum'][-1].exponents for run in (two, one)]
            np.testing.assert_allclose(*both, rtol=0, atol=bound, equal_nan=False)
            both = [[mode.rotation for mode in run['modes'][-1].modes] for run in (one, two)]
            np.testing.assert_allclose(*both, rtol=0, atol=1e-4, equal_nan=False)


class Flow(harness.Case):
    SCENE = dict(FLOW, duration=600.0, report_interval=20.0)
    SCENE['observables'] = ['spectrum', 'steps', 'gas', 'state']

    def bag(self, name, **more):
        """The bag of a run, and its last messages."""
        stop_after = 200.0 if 'checkpoint' in more else None
        found = self.recorded(dict(self.SCENE, **more), stop_after)
        path = os.path.join(self.folder, name)
        made.write(path, [message for those in found.values() for message in those])
        return path, {topic: those[-1] for topic, those in found.items()}

    def test_in_bags(self):
        """What tools say of a run that stopped and went on, and beside another seed."""
        self.folder = self.new_folder()
        kept, out = (os.path.join(self.folder, name) for name in ('kept', 'out'))
        first, _ = self.bag('first.bag', checkpoint=kept, pace=50.0)
        second, last = self.bag('second.bag', resume=kept)
        other, _ = self.bag('other.bag', seed='3')
        text = bags.tool('plot', first, second, '--out', out).out
        self.assertIn('x periodic, y shearing, shear b 5\n', text)
        for words, topic, name in (
            ('sum of all', 'spectrum', 'exponent_sum'),
            ('mean divergence', 'spectrum', 'divergence'),
            ('Kaplan-Yorke', 'spectrum', 'kaplan_yorke'),
            ('shear stress', 'gas', 'shear_stress'),
            ('v near low wall', 'gas', 'velocity_low'),
            ('v near high one', 'gas', 'velocity_high'),
        ):
            value, error = (getattr(last[topic], name + more) for more in ('', '_error'))
            self.assertGreater(error, 0.0, name)
            self.assertIn(f'\n{words:<15} {with_error(value, error)}', text)
        compared = bags.tool('compare', second, other).out
        self.assertRegex(compared, r'\n *exponent_sum .*\n *kaplan_yorke ')
        self.assertNotRegex(compared, r'\n *divergence ')
        table = bags.tool('table', second, other, '--out', out).out
        self.assertRegex(table, 'exponent_sum +kaplan_yorke +shear_stress +velocity_low')


class Kept(harness.Case):
    def test_a_checkpoint_says_what_moves(self):
        """Alone; nobody can say otherwise."""
        disks, spheres, small = dict(particles='disks'), dict(particles='spheres'), dict(bond=0.6)
        bonds = dict(particles='dumbbells', bond=0.5)
        for own, others in (
            (disks, [(spheres, 'disks')]),
            (spheres, [(disks, 'spheres')]),
            (bonds, [(disks, 'dumbbells'), (small, '0.5'), (dict(inertia='points'), 'disks')]),
        ):
            edge = (20 / 0.3) ** (1 / (3 if own is spheres else 2))
            path, said = os.path.join(self.new_folder(), 'kept'), f'{own["particles"]} in {edge:g}'
            scene = dict(own, number=20, aspect=1.0, density=0.3, exponents='none')
            scene.update(equilibration=1.0, duration=2.0, checkpoint=path, observables=['state'])
            self.ends(self.start(scene), 0, said)
            self.ends(self.start(dict(resume=path, duration=3.0)), 0, said)
            for other, must_be in others:
                ((name, value),) = other.items()
                refused = f'{name} = {value}: must be {must_be}'
                self.ends(self.start(dict(other, resume=path)), 2, refused)


class Scenes(harness.Case):
    def test_each_is_valid_and_says_nothing_twice(self):
        flat = r'(?m)^waves +T,LP\(1,0\)'
        for kind, count, number, *lines in (
            ('spheres', 3, 108, r'(?m)^waves +(T,)?LP\(1,0,0\)'),
            ('dumbbells', 2, 60, r', packing fraction 0\.', flat),
            ('soft_disks', 2, 60, flat),
        ):
            check_scenes(self, kind, count, number, *lines)
