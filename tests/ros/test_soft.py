#!/usr/bin/env python3
"""A run of soft disks: what a subscriber gets, held against what must be so of steps in time."""

import math
import os
import re

import numpy as np
import yaml
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

import harness
import test_dumbbells
from measured import of
from test_check import check_scenes, said_of
from hdlyap.msg import Mode
from hdlyap.plots import repetition, report
from hdlyap.plots.figures import style

TOPICS = ['run_info', 'spectrum', 'modes', 'steps', 'lp_phases', 't_phases', 'fields', 'structure']
TOPICS += ['covariant', 'localization', 'gas', 'state', 'status', 'cost']
N, CHOSEN = 36, [1, 66, 69]
SCENE = dict(particles='soft_disks', potential='power', number=N, density=0.2, aspect=0.05)
SCENE.update(scene='soft', seed='2', exponents='all', equilibration=10.0, warmup=60.0)
SCENE.update(duration=200.0, report_interval=2.0, field_interval=0.0, max_mode_number=1)
SCENE.update(covariant_window=20.0, covariant_transient=60.0, covariant_sampling=2.0, threads=1)
SCENE.update(observables=TOPICS[1:-2], field_indices=CHOSEN)
ZEROS = slice(2 * N - 3, 2 * N)  # of the positive half
ROUNDING = 1e-9  # of sums over all of them
ORTHONORMAL = 1e-7
SMALL = dict(particles='soft_disks', number=16, density=0.4, aspect=1.0, seed='3', threads=1)
SMALL.update(equilibration=5.0, warmup=20.0, observables=['spectrum'])
CUT = dict(power=1.0, wca=2 ** (1 / 6), lennard_jones=2.5)


def pair_energy(potential, r):
    if potential == 'power':
        return 100 * (1 - r**2) ** 4
    energy = 4 * (r**-12 - r**-6)
    if potential == 'wca':
        return energy + 1
    x = np.clip((r**2 - 4) / 2.25, 0, 1)
    return energy * (1 - 10 * x**3 + 15 * x**4 - 6 * x**5)


def energy(state, info, potential):
    """Of a particle, all pairs by their nearest images."""
    axes = 'xyz'[: info.dimension]
    q = of(state, *axes)
    box = of(info, *('box_' + axis for axis in axes))[:, None]
    apart = q[:, :, None] - q[:, None, :]
    apart -= box[:, None] * np.round(apart / box[:, None])
    r = np.sqrt(np.sum(apart**2, axis=0))[np.triu_indices(info.number, 1)]
    kinetic = np.sum(of(state, *('p' + axis for axis in axes)) ** 2) / 2
    return (kinetic + np.sum(pair_energy(potential, r[r < CUT[potential]]))) / info.number


class Soft(harness.Case):
    @classmethod
    def setUpClass(cls):
        cls.messages = harness.whole_run(dict(SCENE, wait_for_subscribers=TOPICS), TOPICS)
        cls.info = cls.messages['run_info'][-1]

    def test_what_they_are(self):
        """A step that is chosen is said, to its last bit."""
        info = self.info
        self.assertEqual((info.particles, info.dimension, info.coordinates), ('soft_disks', 2, 2))
        null = [mode.null_p for mode in self.messages['modes'][-1].modes]
        self.assertEqual(len(null), 4 * N)
        self.assertAlmostEqual(sum(null), 1.0, delta=ORTHONORMAL)  # the flow is in all of them
        potential, each, step, integrator = info.own
        self.assertEqual(
            (potential, each, integrator), ('potential=power', 'energy=1', 'integrator=pefrl')
        )
        self.assertRegex(step, r'^time_step=0\.00\d+$')
        self.assertTrue(math.isnan(info.packing_fraction))
        self.assertEqual((info.zero_exponents, info.vectors, info.inertia), (6, 4 * N, 0))

    def test_states(self):
        """Of the energy a part is that of pairs, which is another one at each report."""
        kinetic = [state.kinetic_energy for state in self.messages['state']]
        self.assertGreater(len(kinetic), 130)
        for state in self.messages['state']:
            q, p = of(state, 'x', 'y'), of(state, 'px', 'py')
            box = np.array([[self.info.box_x], [self.info.box_y]])
            self.assertTrue(((q >= 0) & (q <= box)).all())
            self.assertAlmostEqual(energy(state, self.info, 'power'), 1.0, delta=1e-5)
            self.assertAlmostEqual(np.sum(p**2) / 2, state.kinetic_energy, delta=ROUNDING)
            np.testing.assert_allclose(p.sum(axis=1), 0.0, atol=ROUNDING)
        self.assertLess(np.mean(kinetic), 0.99 * N)
        self.assertGreater(np.std(kinetic), 0.01 * N)

    def test_spectrum(self):
        """Zeros are as small as a shear lets them be: well below ln t / t."""
        last = self.messages['spectrum'][-1]
        exponents = np.array(last.exponents)
        self.assertEqual((len(exponents), last.pairing_error, last.collisions), (4 * N, 0.0, 0))
        np.testing.assert_array_equal(exponents, -exponents[::-1])
        own = math.log(last.averaged_time) / last.averaged_time
        self.assertLess(abs(exponents[ZEROS]).max(), own)
        self.assertGreater(exponents[2 * N - 4], 2 * own)

    def test_steps_and_phases(self):
        """T(1,0) and LP(1,0) share a set of six; nothing of what is not found is stated."""
        steps = {(s.kind, s.nx): s for s in self.messages['steps'][-1].steps if not s.conjugate}
        t, lp, zero = steps[Mode.T, 1], steps[Mode.LP, 1], steps[Mode.ZERO, 0]
        self.assertEqual((t.expected, lp.expected, zero.expected), (2, 4, 6))
        self.assertTrue(zero.resolved)
        self.assertEqual((zero.first_index, zero.last_index), (2 * N - 2, 2 * N + 3))
        found = [s for message in self.messages['steps'] for s in message.steps if s.resolved]
        self.assertIn((Mode.T, 1), {(s.kind, s.nx) for s in found})
        for s in [s for message in self.messages['steps'] for s in message.steps]:
            if not s.resolved:
                self.assertTrue(math.isnan(s.exponent) and math.isnan(s.multiplicity))
                self.assertEqual((s.first_index, s.members, s.set), (0, 0, -1))
            elif s.kind != Mode.ZERO:
                self.assertGreater(s.multiplicity, 0.4 * s.expected)
        self.assertGreater(len(self.messages['lp_phases']), 90)
        self.assertGreater(len(self.messages['t_phases']), 90)

    def test_vectors(self):
        """Of one time they are orthonormal, and of the states that they come with."""
        states = {state.sim_time: state for state in self.messages['state']}
        together = {}
        for field in self.messages['fields']:
            vector = of(field, 'dqx', 'dqy', 'dpx', 'dpy')
            self.assertEqual((vector.shape, len(field.dq_angle)), ((4, N), 0))
            self.assertEqual(field.x, states[field.sim_time].x)
            together.setdefault(field.sim_time, []).append(vector.ravel())
        for vectors in together.values():
            products = np.array(vectors) @ np.array(vectors).T
            np.testing.assert_allclose(products, np.eye(len(vectors)), atol=ORTHONORMAL)
            self.assertEqual(len(vectors), len(CHOSEN))
        self.assertGreater(len(together), 90)

    def test_covariant(self):
        """Pairs of them, too; those of the centre have the exponent zero."""
        last = self.messages['covariant'][-1]
        exponents = np.array(last.exponents)
        self.assertEqual(len(exponents), 4 * N)
        self.assertLess(abs(exponents + exponents[::-1]).max(), 0.2)
        self.assertLess(abs(exponents[2 * N - 3 : 2 * N + 3]).max(), 0.05)
        self.assertGreater(last.samples, 10)

    def test_others(self):
        widths = np.array(self.messages['localization'][-1].widths)
        self.assertEqual(len(widths), 4 * N)
        self.assertTrue(((widths > 1 / N) & (widths <= 1)).all())
        self.assertEqual(len(self.messages['structure'][-1].peak), 4 * N)

    def test_gas(self):
        """They do not collide; what is told fits together, and to the states."""
        info, last = self.info, self.messages['gas'][-1]
        self.assertEqual(len(self.messages['gas']), 100)
        self.assertTrue(math.isnan(last.collision_rate))
        self.assertEqual(last.collision_rate_error, -1)
        self.assertAlmostEqual(last.pressure, (last.pressure_x + last.pressure_y) / 2, places=12)
        thin = (N - 1) * last.temperature / (info.box_x * info.box_y)
        self.assertAlmostEqual(last.compressibility, last.pressure / thin, places=9)
        self.assertAlmostEqual(
            last.potential_energy + (N - 1) / N * last.temperature, 1.0, delta=1e-5
        )
        kinetic = [s.kinetic_energy for s in self.messages['state'] if s.sim_time > 70]
        error = np.std(kinetic) / np.sqrt(len(kinetic))
        self.assertAlmostEqual(
            last.temperature, np.mean(kinetic) / (N - 1), delta=4 * error / (N - 1)
        )
        self.assertAlmostEqual(last.averaged_time, last.sim_time - 70.0, delta=0.01)

    def test_words(self):
        """Titles, reports and the scene file that repeats the run have what moves them."""
        own = 'potential power, energy 1, time step 0.004427, integrator pefrl'
        self.assertEqual(
            style.scene(self.info),
            f'soft: $N={N}$ soft disks\n{own}\n' r'$\rho=0.2$, $L_y/L_x=0.05$, periodic',
        )
        self.assertIn(f'N = {N} soft disks, {own}, density 0.2, box 60', report.system(self.info))
        again = yaml.safe_load(repetition.scene_file(self.info))
        self.assertEqual(again['potential'], 'power')
        self.assertEqual(f"time_step={again['time_step']:.17g}", self.info.own[2])

    def test_check(self):
        """It says what they are moved by, and nothing that is known of hard ones alone."""
        said = said_of(self, dict(SCENE, density=0.95, aspect=0.2))
        self.assertRegex(
            said,
            rf'is valid: {N} soft_disks in .*, potential power, energy 1, time_step 0\.00\d+, '
            'integrator pefrl, 144 vectors',
        )
        for hard in 'packing', 'keep their places', 'c_T', 'of steps', '780':
            self.assertNotIn(hard, said)


class Spheres(harness.Case):
    """A run in space, with what its bag says and its pictures draw."""

    SCENE = dict(SMALL, particles='soft_spheres', number=32, density=0.3, exponents='all')
    SCENE.update(warmup=60.0, duration=100.0, report_interval=2.0, max_mode_number=1)
    SCENE.update(aspect=0.3, aspect_z=0.3, wait_for_subscribers='all', field_indices=[1, 92])
    SCENE.update(observables=['spectrum', 'modes', 'steps', 'fields', 'gas', 'state'])

    @classmethod
    def setUpClass(cls):
        topics = ['run_info', *cls.SCENE['observables'], 'cost']
        cls.messages = harness.whole_run(dict(cls.SCENE, wait_for_subscribers=topics), topics)

    def test_what_is_told(self):
        (info, *_), spectrum = self.messages['run_info'], self.messages['spectrum'][-1]
        self.assertEqual((info.particles, info.dimension, info.coordinates), ('soft_spheres', 3, 3))
        self.assertEqual((info.zero_exponents, info.vectors), (8, 6 * 32))
        exponents = np.array(spectrum.exponents)
        np.testing.assert_array_equal(exponents, -exponents[::-1])
        self.assertGreater(exponents[91], 3 * abs(exponents[92:100]).max())
        for state in self.messages['state']:
            q, p = of(state, 'x', 'y', 'z'), of(state, 'px', 'py', 'pz')
            box = of(info, 'box_x', 'box_y', 'box_z')[:, None]
            self.assertTrue(((q >= 0) & (q <= box)).all())
            np.testing.assert_allclose(p.sum(axis=1), 0.0, atol=ROUNDING)
            self.assertAlmostEqual(energy(state, info, 'wca'), 1.0, delta=5e-4)
        for field in self.messages['fields']:
            vector = of(field, 'dqx', 'dqy', 'dqz', 'dpx', 'dpy', 'dpz')
            self.assertAlmostEqual(np.sum(vector**2), 1.0, places=7)

    def test_gas(self):
        """P V is (N - 1) kT and a third of the virial, along three directions."""
        info, last = self.messages['run_info'][0], self.messages['gas'][-1]
        each = of(last, 'pressure_x', 'pressure_y', 'pressure_z')
        self.assertAlmostEqual(last.pressure, each.mean(), places=12)
        thin = 31 * last.temperature / np.prod(of(info, 'box_x', 'box_y', 'box_z'))
        self.assertAlmostEqual(last.compressibility, last.pressure / thin, places=9)
        whole = last.potential_energy + 1.5 * 31 / 32 * last.temperature
        self.assertAlmostEqual(whole, 1.0, delta=5e-4)
        self.assertGreater(last.compressibility, 1.3)
        for name in 'pressure', 'pressure_z', 'temperature', 'potential_energy', 'compressibility':
            error, value = getattr(last, name + '_error'), getattr(last, name)
            self.assertTrue(0 < error < 0.1 * value, f'{name} {value} +- {error}')


class Energies(harness.Case):
    def test_each_potential(self):
        """As given, and as exact as THEORY says of the step that is chosen."""
        for potential, own, error in (
            ('wca', 0.7, 5e-4),
            ('lennard_jones', -0.5, 1e-5),
            ('power', 2.5, 1e-5),
        ):
            scene = dict(SMALL, number=36, potential=potential, energy=own, exponents='none')
            scene.update(duration=20.0, observables=['state'])
            heard = ['run_info', 'state']
            messages = harness.whole_run(dict(scene, wait_for_subscribers=heard), heard)
            with self.subTest(potential=potential):
                for state in messages['state']:
                    got = energy(state, messages['run_info'][0], potential)
                    self.assertAlmostEqual(got, own, delta=error * max(abs(own), 1.0))

    def test_pairs(self):
        """All of them are carried: nothing follows by construction."""
        scene = dict(SMALL, exponents='all_independent', duration=200.0, potential='power')
        spectrum = harness.whole_run(
            dict(scene, wait_for_subscribers=['spectrum']), ['spectrum', 'cost']
        )
        last = spectrum['spectrum'][-1]
        self.assertGreater(last.pairing_error, 0.0)
        self.assertLess(last.pairing_error, 0.04)


class Steps(harness.Case):
    """What a step that is too long does, and what is said of it."""

    def test_zeros_that_split(self):
        cases = [('power', 'verlet', 0.01, 0.0), ('power', 'pefrl', 0.03, 2)]
        cases += [('wca', 'verlet', 0.006, 0.67), ('wca', 'pefrl', 0.006, 0.67)]
        for potential, integrator, step, power in cases:
            scene = dict(SMALL, potential=potential, integrator=integrator, time_step=step)
            text = self.runs(dict(scene, exponents='all', duration=400.0)).text()
            self.assertNotIn('collisions', text)
            lines = re.findall(r'time_step = .* it falls as time_step\^[\d.]+', text)
            if not power:
                self.assertEqual(lines, [])
                continue
            (line,) = lines
            numbers = re.fullmatch(
                'time_step = (.*) is too long for the zero exponents: the largest is (.*), not '
                r'(.*); it falls as time_step\^(.*)',
                line,
            )
            said, largest, own, of_step = map(float, numbers.groups())
            self.assertEqual((said, own, of_step), (step, 0.015, power))  # ln 400 / 400
            self.assertGreater(largest, 0.02)

    def test_an_energy_that_is_off(self):
        """Said when it is so, and at the end; the last message and diagnostics have that of the
        end."""
        scene = dict(SMALL, exponents='none', potential='wca', integrator='verlet')
        scene.update(observables=['state'], wait_for_subscribers=['status'], duration=400.0)
        said = 'the energy has been off by .*, asked is 0.0005: take a shorter time_step or a'
        for step, is_off in ((0.006, True), (0.0, False)):
            heard = self.listen('status')
            diagnosed = self.hear('/diagnostics', DiagnosticArray)
            node = self.start(dict(scene, time_step=step))
            last = heard.all_of(node)[-1]
            self.ends(node, 0)
            self.assertEqual(len(re.findall(said, node.text())), 2 if is_off else 0)
            self.assertEqual(last.energy_error_wanted, 5e-4)
            self.assertEqual(last.energy_error_most > 5e-4, is_off)
            values = {
                'energy error': abs(last.energy_error),
                'largest energy error': last.energy_error_most,
            }
            self.sees(lambda: self.values(diagnosed).get('stage') == 'finished', node)
            for key, value in values.items():
                self.assertEqual(self.values(diagnosed)[key], f'{value:.6g}')
            status = diagnosed[-1].status[0]
            self.assertEqual(status.level, DiagnosticStatus.WARN if is_off else DiagnosticStatus.OK)
            self.assertEqual(bool(re.search(said, status.message)), is_off)

    @staticmethod
    def values(diagnosed):
        """Of the last of these messages; none before the first."""
        found = diagnosed[-1].status[0].values if diagnosed else []
        return {pair.key: pair.value for pair in found}

    def test_energy_that_is_lost(self):
        """Named, with the step; what was computed stays, and no checkpoint is said that is not."""
        kept = os.path.join(self.new_folder(), 'kept')
        states = self.listen('state')
        scene = dict(SMALL, exponents='none', time_step=0.014, integrator='verlet')
        scene.update(observables=['state'], wait_for_subscribers=['state'], checkpoint=kept)
        scene.update(equilibration=0.0, duration=1e4, potential='lennard_jones', energy=0.5)
        scene.update(number=24, density=0.7, report_interval=0.1)
        node = self.start(scene)
        heard = states.all_of(node)
        self.ends(node, 3, 'the energy is not conserved: the time step is too long, 0.014')
        self.assertGreater(len(heard), 5)
        self.assertEqual('the checkpoint is' in node.text(), os.path.exists(kept))


class Again(test_dumbbells.Again):
    RUN = {name: value for name, value in SCENE.items() if not name.startswith('covariant')}
    RUN.update(observables=[name for name in SCENE['observables'] if name != 'covariant'])
    RUN.update(wait_for_subscribers='all', duration=40.0, report_interval=1.0)
    RUN.update(equilibration=10.0, warmup=60.0)


class Scenes(harness.Case):
    def test_each_is_valid_and_says_nothing_twice(self):
        check_scenes(self, 'soft_disks', 2, 60, r'(?m)^waves +T,LP\(1,0\)')


if __name__ == '__main__':
    harness.main('soft')
