#!/usr/bin/env python3
"""A run of hard dumbbells: what a subscriber gets of angles, held against what must be so."""

import math
import os
import shutil
import unittest

import numpy as np

import harness
from measured import of
from test_check import check_scenes, in_bag, said_of, shares
from test_ranks import ENVIRONMENT, mpirun
from hdlyap.msg import LpPhase, Mode

TOPICS = ['run_info', 'spectrum', 'modes', 'steps', 'lp_phases', 't_phases', 'fields', 'structure']
TOPICS += ['covariant', 'localization', 'gas', 'state', 'status', 'cost']
N, BOND = 36, 0.4
SCENE = dict(particles='dumbbells', number=N, density=0.5, aspect=0.1, bond=BOND, seed='2')
SCENE.update(scene='pairs', exponents='all', equilibration=10.0, warmup=60.0, duration=60.0)
SCENE.update(report_interval=2.0, field_interval=0.0, max_mode_number=3, threads=1)
SCENE.update(covariant_window=20.0, covariant_transient=20.0, covariant_sampling=2.0)
SCENE.update(observables=TOPICS[1:-2])
VECTOR = 'dqx', 'dqy', 'dq_angle', 'dpx', 'dpy', 'dp_angle'
ROUNDING = 1e-9  # of sums over all of them
ORTHONORMAL = 1e-7


class Dumbbells(harness.Case):
    @classmethod
    def setUpClass(cls):
        cls.messages = harness.whole_run(dict(SCENE, wait_for_subscribers=TOPICS), TOPICS)
        cls.info = cls.messages['run_info'][-1]
        cls.box = np.array([cls.info.box_x, cls.info.box_y])

    def test_what_they_are(self):
        info = self.info
        self.assertEqual((info.particles, info.dimension, info.coordinates), ('dumbbells', 2, 3))
        self.assertEqual(info.own, [f'bond={BOND:g}', 'inertia=disks'])
        self.assertAlmostEqual(info.inertia, BOND**2 / 4 + 1 / 8, places=15)
        # two disks, but for the lens that they share
        lens = math.acos(BOND) / 2 - BOND / 2 * math.sqrt(1 - BOND**2)
        self.assertAlmostEqual(info.packing_fraction, 0.5 * (math.pi / 2 - lens), places=14)
        self.assertEqual((info.zero_exponents, info.vectors), (6, 6 * N))

    def test_states(self):
        """Angles are those of the bonds: no two disks overlap, of neighbours that touch often."""
        least = np.inf
        for state in self.messages['state']:
            q, p = of(state, 'x', 'y'), of(state, 'px', 'py')
            angle, spin = of(state, 'angle', 'spin')
            self.assertEqual((len(state.z), len(state.pz), angle.shape), (0, 0, (N,)))
            self.assertTrue(((angle >= 0) & (angle <= 2 * np.pi)).all())
            self.assertTrue(((q >= 0) & (q <= self.box[:, None])).all())
            energy = np.sum(p**2) / 2 + self.info.inertia * np.sum(spin**2) / 2
            self.assertAlmostEqual(energy, N, delta=ROUNDING)
            np.testing.assert_allclose(p.sum(axis=1), 0.0, atol=ROUNDING)
            least = min(least, self.nearest(q, angle))
            self.assertAlmostEqual(state.kinetic_energy, N, delta=ROUNDING)
        self.assertGreater(least, 1 - ROUNDING)
        self.assertLess(least, 1.001)
        self.assertGreater(max(self.messages['state'][-1].angle), np.pi)

    def nearest(self, q, angle):
        """Least distance of disks of two dumbbells."""
        arm = BOND / 2 * np.array([np.cos(angle), np.sin(angle)])
        disks = np.concatenate([q + arm, q - arm], axis=1)
        apart = disks[:, :, None] - disks[:, None, :]
        apart -= self.box[:, None, None] * np.round(apart / self.box[:, None, None])
        distance = np.sqrt(np.sum(apart**2, axis=0))
        return distance[~np.tile(np.eye(N, dtype=bool), (2, 2))].min()

    def test_vectors(self):
        """Of one time they are orthonormal, angles included, and parts of rotation are theirs."""
        count, together = 0, {}
        for field in self.messages['fields']:
            vector = of(field, *VECTOR)
            self.assertEqual((vector.shape, len(field.dqz)), ((6, N), 0))
            together.setdefault(field.sim_time, []).append(vector.ravel())
            states = {state.sim_time: state for state in self.messages['state']}
            self.assertEqual(field.angle, states[field.sim_time].angle)
            self.assertEqual(field.spin, states[field.sim_time].spin)
        for vectors in together.values():
            products = np.array(vectors) @ np.array(vectors).T
            np.testing.assert_allclose(products, np.eye(len(vectors)), atol=ORTHONORMAL)
            count += len(vectors) - 1
        self.assertGreater(count, 10)

    def test_rotation(self):
        """A mean over what is published, one sample after the other; of a T step there is little,
        and none in null vectors that shift all of them."""
        now = {}
        for field in self.messages['fields']:
            dq = of(field, *VECTOR[:3])
            now[field.sim_time, field.index] = np.sum(dq[2] ** 2) / np.sum(dq**2)
        compared, modes = 0, self.messages['modes']
        for before, after in zip(modes, modes[1:]):
            if after.samples != before.samples + 1:
                continue
            for one, other in zip(before.modes, after.modes):
                sample = other.rotation * after.samples - one.rotation * before.samples
                self.assertTrue(-ROUNDING <= sample <= 1 + ROUNDING)
                published = now.get((after.sim_time, other.index))
                if published is not None:
                    self.assertAlmostEqual(sample, published, delta=1e-6)
                    compared += 1
        self.assertGreater(compared, 20)
        last = modes[-1].modes
        zero = [mode for mode in last if mode.kind == Mode.ZERO]
        self.assertEqual([mode.index for mode in zero], list(range(3 * N - 2, 3 * N + 4)))
        for mode in zero:
            self.assertLessEqual(mode.rotation, mode.null_p + 0.02)
        t = [mode.rotation for mode in last if mode.kind == Mode.T and mode.index < 3 * N]
        self.assertLess(max(t[-2:]), 0.1)
        self.assertGreater(last[N].rotation, 0.2)

    def test_reconstructed_modes(self):
        """Their places alone are no farther from the fields than all: P has A times spin, too."""
        root, compared = math.sqrt(self.info.inertia), 0
        for field in self.messages['fields']:
            phase = 2 * np.pi * field.nx * np.array(field.x) / self.box[0]
            p = of(field, 'px', 'py', 'spin') * [[1], [1], [root]]
            for pair in range(field.pairs if field.ny == 0 else 0):
                sine, own = field.modulation[pair], slice(pair * N, (pair + 1) * N)
                a, along = (
                    (np.sin(phase), np.cos(phase)) if sine else (np.cos(phase), -np.sin(phase))
                )
                wanted = np.array([along, 0 * a]), (a * p)
                for name, want, residual in zip('lp', wanted, (field.residual_l, field.residual_p)):
                    want = (want / np.linalg.norm(want))[:2]
                    got = of(field, name + '_x', name + '_y')[:, own]
                    self.assertLessEqual(np.linalg.norm(got - want), residual[pair] + ROUNDING)
                    compared += 1
        self.assertGreater(compared, 20)

    def test_spectrum(self):
        last = self.messages['spectrum'][-1]
        exponents = np.array(last.exponents)
        self.assertEqual(len(exponents), 6 * N)
        np.testing.assert_array_equal(exponents, -exponents[::-1])
        self.assertEqual(last.pairing_error, 0.0)
        self.assertLess(abs(exponents[3 * N - 3 : 3 * N]).max(), 0.05)
        self.assertGreater(exponents[3 * N - 4], 0.2)

    def test_steps_and_phases(self):
        steps = self.messages['steps'][-1].steps
        named = {(s.kind, s.nx, s.ny): s for s in steps if not s.conjugate}
        t, lp = named[Mode.T, 1, 0], named[Mode.LP, 1, 0]
        self.assertEqual((t.first_index, lp.first_index), (3 * N - 4, 3 * N - 8))
        self.assertEqual((t.expected, lp.expected), (2, 4))
        self.assertEqual((t.resolved, lp.resolved), (True, True))
        self.assertEqual(named[Mode.ZERO, 0, 0].expected, 6)
        phases = [p for p in self.messages['lp_phases'][-1].phases if (p.nx, p.ny) == (1, 0)]
        omega = [abs(p.omega) for p in phases if p.state == LpPhase.TRACKED]
        self.assertGreater(len(omega), 4)
        self.assertGreater(min(omega), 0.1)
        self.assertTrue(self.messages['t_phases'][-1].phases)

    def test_others(self):
        gas = self.messages['gas'][-1]
        self.assertAlmostEqual(gas.pressure, (gas.pressure_x + gas.pressure_y) / 2, places=12)
        # kT is 2 N over 3 N - 2 free momenta, of which 2 N - 2 are those of centres
        z = (3 * N - 2) / (2 * N - 2) * gas.pressure / 0.5
        self.assertAlmostEqual(gas.compressibility, z, places=9)
        self.assertGreater(gas.compressibility, 3.0)
        widths = np.array(self.messages['localization'][-1].widths)
        self.assertEqual(len(widths), 6 * N)
        self.assertTrue(((widths > 1 / N) & (widths <= 1)).all())
        self.assertEqual(len(self.messages['structure'][-1].peak), 6 * N)
        covariant = self.messages['covariant'][-1]
        self.assertEqual(len(covariant.exponents), 6 * N)
        both = np.array(covariant.exponents) + np.array(covariant.exponents)[::-1]
        self.assertLess(abs(both).max(), 0.3)

    def test_check(self):
        """What it says of the bag is what it takes."""
        said = said_of(self, SCENE)
        self.assertIn(f'{N} dumbbells in 26.8328 x 2.68328, packing fraction 0.587, 216 vec', said)
        report, fields, _ = shares(said)
        by_pairs = {field.pairs: in_bag('fields', [field]) for field in self.messages['fields']}
        steps = 3 * by_pairs[0] + 3 * by_pairs[2]  # T and LP of three waves
        self.assertAlmostEqual(fields['fields'] / steps, 1.0, delta=0.02)
        for topic in 'state', 'modes', 'spectrum':
            self.assertAlmostEqual(
                report[topic] * len(self.messages[topic]) / in_bag(topic, self.messages[topic]),
                1.0,
                delta=0.02,
            )


class Slow(harness.Case):
    def test_slow_vectors(self):
        """Those of T(1,0) lie in its fields, angles all but still."""
        scene = dict(SCENE, observables=['steps'], pace=60.0, slow_vectors_rate=50.0)
        scene = {name: value for name, value in scene.items() if not name.startswith('covariant')}
        messages = harness.whole_run(scene, ['run_info', 'slow_vectors'])
        box_x, found = messages['run_info'][-1].box_x, 0
        for message in messages['slow_vectors']:
            self.assertEqual(len(message.dqz), 0)
            dq = of(message, 'dqx', 'dqy', 'dq_angle').reshape(3, -1, N)
            phase = 2 * np.pi * np.array(message.x) / box_x
            fields = np.sqrt(2 / N) * np.array([np.cos(phase), np.sin(phase)])
            for k in range(dq.shape[1]):
                if (message.kind[k], message.nx[k], message.ny[k]) != (Mode.T, 1, 0):
                    continue
                whole = np.sum(dq[:, k] ** 2)
                self.assertGreater(np.sum((fields @ dq[1, k]) ** 2), 0.7 * whole)
                self.assertLess(np.sum(dq[2, k] ** 2), 0.1 * whole)
                found += 1
        self.assertGreater(found, 20)


class Flight(harness.Case):
    def test_a_spin_turns_the_angle(self):
        """In a gas so thin that hardly any of them meets another one between two reports."""
        step = 0.01
        scene = dict(particles='dumbbells', number=40, density=0.01, aspect=1.0, exponents='none')
        scene.update(equilibration=5.0, duration=20 * step, report_interval=step)
        scene.update(observables=['state'], wait_for_subscribers=['state'], inertia='points')
        states = harness.whole_run(scene, ['state'])['state'][-20:]
        free = 0
        for before, after in zip(states, states[1:]):
            same = np.array(before.spin) == np.array(after.spin)
            turned = np.array(before.angle) + step * np.array(before.spin) - np.array(after.angle)
            turned -= 2 * np.pi * np.round(turned / (2 * np.pi))
            self.assertLess(abs(turned[same]).max(), ROUNDING)
            free += np.sum(same)
        self.assertGreater(free, 19 * 40 * 0.9)


class Again(harness.Case):
    # without windows of covariant vectors: one that is under way begins anew
    RUN = {name: value for name, value in SCENE.items() if not name.startswith('covariant')}
    RUN.update(observables=[name for name in SCENE['observables'] if name != 'covariant'])
    RUN.update(wait_for_subscribers='all', duration=40.0, report_interval=1.0)

    def test_a_resumed_run_is_the_uninterrupted_one(self):
        kept = os.path.join(self.new_folder(), 'run.checkpoint')
        whole = self.recorded(self.RUN)
        first = self.recorded(dict(self.RUN, checkpoint=kept, pace=20.0), stop_after=90.0)
        second = self.recorded(dict(self.RUN, resume=kept))
        self.assertLess(second['run_info'][0].resumed_time, 105.0)
        for topic in self.RUN['observables']:
            with self.subTest(topic=topic):
                self.assertTrue(second[topic])
                self.assert_same_bits(first[topic] + second[topic], whole[topic])

    @unittest.skipUnless(shutil.which('mpirun'), 'one rank')
    def test_two_ranks_are_as_one(self):
        """The same dumbbells, and the same exponents, parts of rotation to what these are known."""
        one = self.recorded(self.RUN)
        two = self.recorded(self.RUN, command=mpirun(), **ENVIRONMENT)
        self.assertEqual(two['run_info'][0].ranks, 2)
        self.assert_same_bits(two['state'], one['state'])
        bound = one['cost'][-1].error_bound + two['cost'][-1].error_bound
        np.testing.assert_allclose(
            two['spectrum'][-1].exponents, one['spectrum'][-1].exponents, rtol=0, atol=bound
        )
        first, second = ([mode.rotation for mode in run['modes'][-1].modes] for run in (one, two))
        np.testing.assert_allclose(first, second, rtol=0, atol=1e-4)


class Kept(harness.Case):
    def test_a_checkpoint_says_what_moves(self):
        kept = os.path.join(self.new_folder(), 'kept')
        scene = dict(particles='dumbbells', number=20, aspect=1.0, density=0.3, bond=0.5)
        scene.update(exponents='none', equilibration=1.0, duration=2.0, checkpoint=kept)
        self.runs(dict(scene, observables=['state']))
        self.ends(self.start(dict(resume=kept, duration=3.0)), 0, '20 dumbbells in 8.16497')
        refused = dict(particles='disks'), dict(bond=0.6), dict(inertia='points')
        for other, said in zip(refused, ('must be dumbbells', 'must be 0.5', 'must be disks')):
            name, value = next(iter(other.items()))
            self.ends(self.start(dict(other, resume=kept)), 2, f'{name} = {value}: {said}')


class Scenes(harness.Case):
    def test_each_is_valid_and_says_nothing_twice(self):
        lines = r', packing fraction 0\.', r'(?m)^waves +T,LP\(1,0\)'
        check_scenes(self, 'dumbbells', 2, 60, *lines)


if __name__ == '__main__':
    harness.main('dumbbells')
