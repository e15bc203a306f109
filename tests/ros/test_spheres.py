#!/usr/bin/env python3
"""A run of hard spheres: what a subscriber gets of z, and its fields made again in numpy."""

import copy
import itertools
import os

import numpy as np

import harness
from measured import of
from test_check import check_scenes, in_bag, said_of, shares
from hdlyap.msg import Mode

TOPICS = ['run_info', 'spectrum', 'modes', 'steps', 'lp_phases', 't_phases', 'fields', 'gas']
TOPICS += ['state', 'covariant', 'hydro', 'structure', 'status', 'cost']
SCENE = dict(particles='spheres', number=128, density=0.5, aspect=0.25, aspect_z=0.3)
SCENE.update(scene='balls', equilibration=10.0, warmup=20.0, duration=70.0, report_interval=5.0)
SCENE.update(boundary_y='reflecting', observables=TOPICS[1:-2], seed='3', covariant_window=20.0)
SCENE.update(covariant_transient=20.0, exponents='all', max_mode_number=2)
ROUNDING = 1e-7
SLOPE = 1e-4  # of central differences
VECTOR = 'dqx', 'dqy', 'dqz', 'dpx', 'dpy', 'dpz'


def nodes(message):
    return message.nx, message.ny, message.nz


class Spheres(harness.Case):
    @classmethod
    def setUpClass(cls):
        cls.messages = harness.whole_run(dict(SCENE, wait_for_subscribers=TOPICS), TOPICS)
        cls.info = cls.messages['run_info'][-1]
        cls.box = of(cls.info, 'box_x', 'box_y', 'box_z')

    def coordinate(self, field, d, moved=0.0):
        """Wave number and coordinate along d, from where it is counted; of disks moved along dq."""
        n = nodes(field)[d]
        q = of(field, 'x', 'y', 'z')[d] + moved * of(field, *VECTOR)[d]
        walls = self.boundaries()[d] == 'reflecting'
        k = np.pi * n / (self.box[d] - 1) if walls else 2 * np.pi * n / self.box[d]
        return k, q - 0.5 * walls

    def factor(self, field, d, sine, derived=0, moved=0.0):
        """cos k u or sin k u of one coordinate, or its derivative over k."""
        k, u = self.coordinate(field, d, moved)
        return np.cos(k * u - np.pi / 2 * sine + np.pi / 2 * derived)

    def gradients(self, field, moved=0.0):
        """For each modulation A: A, and its derivatives over k, or A where k = 0; [disks] each."""
        free = [
            range(2) if n and wall != 'reflecting' else [0]
            for n, wall in zip(
                nodes(field), of(self.info, 'boundary_x', 'boundary_y', 'boundary_z')
            )
        ]
        for sines in itertools.product(*free):
            parts = [self.factor(field, d, sines[d], 0, moved) for d in range(3)]
            along = []
            for d in range(3):
                derived = list(parts)
                if nodes(field)[d]:
                    derived[d] = self.factor(field, d, sines[d], 1, moved)
                along.append(np.prod(derived, axis=0))
            yield np.prod(parts, axis=0), np.array(along)

    def basis(self, field):
        """Its subspace, [fields, 3, disks]: of T by an SVD, all e that walls allow."""
        k = np.array([self.coordinate(field, d)[0] for d in range(3)])
        if field.kind == Mode.LP:
            momenta = of(field, 'px', 'py', 'pz')
            pairs = [(k[:, None] * s, momenta * a) for a, s in self.gradients(field)]
            return [part for pair in pairs for part in pair]
        return [e[:, None] * s for _, s in self.gradients(field) for e in self.across(field, k)]

    def across(self, field, k):
        """Unit vectors across k, and across walls without nodes."""
        walls = [n == 0 and b == 'reflecting' for n, b in zip(nodes(field), self.boundaries())]
        forbidden = [np.eye(3)[d] for d in range(3) if walls[d]]
        _, _, across = np.linalg.svd(np.array([k, *forbidden]))
        return across[1 + len(forbidden) :]

    def sums(self, field, moved):
        """Of each modulation: density and momentum along k, over k; energy; momentum across k."""
        k = np.array([self.coordinate(field, d)[0] for d in range(3)])
        p = of(field, 'px', 'py', 'pz') + moved * of(field, *VECTOR[3:])
        for a, s in self.gradients(field, moved):
            along, *others = (np.sum(p * e[:, None] * s) for e in (k, *self.across(field, k)))
            size = np.linalg.norm(k)
            yield np.array([a.sum() / size, along / size, np.sum(p**2 * a), *others])

    def boundaries(self):
        return of(self.info, 'boundary_x', 'boundary_y', 'boundary_z')

    def test_what_draws_it(self):
        info, edge = self.info, np.cbrt(128 / (0.5 * 0.25 * 0.3))
        np.testing.assert_allclose(self.box, [edge, 0.25 * edge, 0.3 * edge], rtol=1e-14)
        self.assertEqual((info.particles, info.dimension), ('spheres', 3))
        self.assertEqual((info.aspect_z, info.container), (0.3, 'rectangle'))
        self.assertEqual(list(self.boundaries()), ['periodic', 'reflecting', 'periodic'])
        self.assertEqual((info.zero_exponents, info.vectors), (6, 6 * 128))
        steps = {nodes(s) for s in self.messages['steps'][-1].steps if s.kind == Mode.LP}
        self.assertEqual(steps, set(zip(info.wave_nx, info.wave_ny, info.wave_nz)))
        for state in self.messages['state']:
            q, p = of(state, 'x', 'y', 'z'), of(state, 'px', 'py', 'pz')
            self.assertEqual(q.shape, (3, 128))
            self.assertTrue(((q >= 0) & (q <= self.box[:, None])).all())
            self.assertTrue((abs(q[1] - self.box[1] / 2) <= self.box[1] / 2 - 0.5 + 1e-12).all())
            self.assertAlmostEqual(np.sum(p**2) / 2, 128.0, places=9)
            np.testing.assert_allclose(p.sum(axis=1)[[0, 2]], 0.0, atol=1e-10)
            self.assertGreaterEqual(self.nearest(q), 1.0 - 1e-9)

    def nearest(self, q):
        apart = q[:, :, None] - q[:, None, :]
        for d in (0, 2):
            apart[d] -= self.box[d] * np.round(apart[d] / self.box[d])
        distance = np.sqrt(np.sum(apart**2, axis=0)) + 9.0 * np.eye(q.shape[1])
        return distance.min()

    def test_steps(self):
        steps = self.messages['steps'][-1].steps
        named = {(s.kind, nodes(s)): s for s in steps if s.kind != Mode.ZERO and not s.conjugate}
        lp, t = named[Mode.LP, (1, 0, 0)], named[Mode.T, (1, 0, 0)]
        # of T along z alone: y would go through the walls
        self.assertEqual((lp.expected, t.expected, t.resolved, lp.resolved), (4, 2, True, True))
        self.assertEqual((t.first_index, lp.first_index), (380, 376))
        self.assertEqual(
            (named[Mode.T, (1, 1, 0)].expected, named[Mode.T, (1, 0, 1)].expected), (4, 4)
        )
        self.assertEqual(
            (named[Mode.LP, (0, 1, 1)].expected, named[Mode.T, (0, 1, 1)].expected), (4, 4)
        )
        self.assertAlmostEqual(lp.wave_number * self.box[0], 2 * np.pi, places=12)
        phases = self.messages['lp_phases'][-1].phases
        self.assertTrue({nodes(phase) for phase in phases} <= {key[1] for key in named})
        self.assertTrue(self.messages['t_phases'][-1].phases)

    def test_weights(self):
        """By least squares on the fields, of all vectors of the same time."""
        modes = {message.sim_time: message.modes for message in self.messages['modes']}
        kinds = set()
        for field in self.messages['fields']:
            vector = of(field, *VECTOR)
            self.assertAlmostEqual(np.sum(vector**2), 1.0, delta=ROUNDING)
            if field.kind not in (Mode.T, Mode.LP) or field.sim_time not in modes:
                continue
            basis = np.array([part.ravel() for part in self.basis(field)]).T
            basis, dq = basis / np.linalg.norm(basis, axis=0), vector[:3].ravel()
            dq /= np.linalg.norm(dq)
            found = basis @ np.linalg.lstsq(basis, dq, rcond=None)[0]
            mode = modes[field.sim_time][field.index - 1]
            self.assertEqual(nodes(mode), nodes(field))
            self.assertAlmostEqual(np.sum(found**2), mode.weight_now, delta=ROUNDING)
            kinds.add((field.kind, nodes(field)))
        self.assertLessEqual({(Mode.T, (1, 0, 0)), (Mode.LP, (1, 0, 0))}, kinds)

    def test_null_space(self):
        """In its middle the vectors lie in it, as far as they have had the time to."""
        zero = [m for m in self.messages['modes'][-1].modes if m.kind == Mode.ZERO]
        self.assertEqual([m.index for m in zero], list(range(382, 388)))
        for m in zero:
            self.assertAlmostEqual(m.null_x + m.null_z + m.null_p, 1.0, delta=0.05)
            self.assertEqual(m.null_y, 0.0)
        self.assertGreater(max(m.null_z for m in zero), 0.2)

    def test_reconstructed_modes(self):
        for field in self.messages['fields']:
            if not field.pairs:
                continue
            for kind, residual in ('l', field.residual_l), ('p', field.residual_p):
                rows = of(field, *(f'{kind}_{d}' for d in 'xyz')).reshape(3, field.pairs, -1)
                norms2 = np.sum(rows**2, axis=(0, 2))
                np.testing.assert_allclose(norms2, 1 - np.array(residual) ** 2, atol=1e-6)
            self.assertEqual(len(field.p_z), len(field.p_over_pz))
            return
        self.fail('no LP step of its own')

    def test_response(self):
        """Of each published vector by differences of the sums themselves."""
        hydro = {message.sim_time: message.responses for message in self.messages['hydro']}
        kinds = set()
        for field in self.messages['fields']:
            if field.kind not in (Mode.T, Mode.LP) or field.sim_time not in hydro:
                continue
            of_it = [r for r in hydro[field.sim_time] if r.index == field.index]
            of_it.sort(key=lambda r: [r.modulation >> d & 1 for d in range(3)])
            pairs = zip(self.sums(field, SLOPE), self.sums(field, -SLOPE))
            wanted = [(up - down) / (2 * SLOPE * np.sqrt(128 / 2)) for up, down in pairs]
            self.assertEqual(len(of_it), len(wanted))
            for r, (density, along, energy, *across) in zip(of_it, wanted):
                got = [r.density, r.along, r.energy, np.hypot(r.across, r.across_second)]
                want = [density, along, energy, np.linalg.norm(across)]
                np.testing.assert_allclose(got, want, atol=1e-6)
                kinds.add(field.kind)
        self.assertEqual(kinds, {Mode.T, Mode.LP})

    def test_structure(self):
        """Amplitudes of the published vectors at their strongest waves, from the vectors."""
        structures = {message.sim_time: message for message in self.messages['structure']}
        checked = 0
        for field in self.messages['fields']:
            s = structures.get(field.sim_time)
            if s is None or not s.peak[field.index - 1]:
                continue
            wave = s.peak[field.index - 1] - 1
            at = copy.copy(field)
            at.nx, at.ny, at.nz = s.nx[wave], s.ny[wave], s.nz[wave]
            along, across = self.amplitudes(at)
            vectors, column = len(s.peak), field.index - 1
            got = np.reshape(s.amplitude_along, (8, vectors))[:, column]
            np.testing.assert_allclose(np.sort(got[got != 0]), np.sort(along), atol=1e-6)
            got = np.reshape(s.amplitude_across, (16, vectors))[:, column]
            self.assertAlmostEqual(np.sum(got**2), np.sum(across**2), delta=1e-6)
            checked += 1
        self.assertGreater(checked, 3)

    def amplitudes(self, field):
        """Of dq, with norm 1, along k and across it: of all modulations."""
        k = np.array([self.coordinate(field, d)[0] for d in range(3)])
        dq, walls = of(field, *VECTOR[:3]), self.boundaries() == 'reflecting'
        dq *= np.sqrt(2.0 ** sum(walls & (np.array(nodes(field)) > 0))) / np.linalg.norm(dq)
        directions = [k / np.linalg.norm(k), *self.across(field, k)]
        found = np.array(
            [[np.sum(dq * e[:, None] * s) for e in directions] for _, s in self.gradients(field)]
        )
        return found[:, 0], found[:, 1:]

    def test_gas(self):
        gas = self.messages['gas'][-1]
        each = of(gas, 'pressure_x', 'pressure_y', 'pressure_z')
        volume = self.box[0] * (self.box[1] - 1) * self.box[2]
        self.assertAlmostEqual(gas.pressure, each.mean(), places=12)
        self.assertAlmostEqual(gas.compressibility, 1.5 * gas.pressure * volume / 128, places=9)
        self.assertTrue((of(gas, 'pressure_x_error', 'pressure_z_error') != 0).all())

    def test_covariant(self):
        last = self.messages['covariant'][-1]
        self.assertEqual(len(last.exponents), 6 * 128)
        self.assertIn((0, 1, 1), {nodes(weight) for weight in last.weights})
        local = np.array(last.exponents) + np.array(last.exponents)[::-1]
        self.assertLess(abs(local).max(), 0.2)

    def test_check(self):
        """What it says of the bag is what it takes."""
        report, fields, window = shares(said_of(self, SCENE))
        for topic in report:
            of = [m for m in self.messages[topic] if not len(getattr(m, 'along', ()))]
            self.near(report[topic], in_bag(topic, of) / len(of))
        self.near(fields['structure'], 16 * len(self.messages['structure'][-1].along))
        steps = [
            s for s in self.messages['steps'][-1].steps if s.kind != Mode.ZERO and not s.conjugate
        ]
        pairs = sum(s.expected // 2 for s in steps if s.kind == Mode.LP)
        by_pairs = {field.pairs: in_bag('fields', [field]) for field in self.messages['fields']}
        of_pair = (by_pairs[2] - by_pairs[0]) / 2
        self.near(fields['fields'], len(steps) * by_pairs[0] + pairs * of_pair)
        self.near(window['covariant'], in_bag('covariant', self.messages['covariant'][-1:]))

    def near(self, said, true):
        self.assertAlmostEqual(said / true, 1.0, delta=0.02)


class Scenes(harness.Case):
    def test_each_is_valid_and_says_nothing_twice(self):
        check_scenes(self, 'spheres', 3, 108, r'(?m)^waves +(T,)?LP\(1,0,0\)')


class Kept(harness.Case):
    def test_a_checkpoint_says_what_moves(self):
        """Alone; nobody can say otherwise."""
        for particles, other in ('disks', 'spheres'), ('spheres', 'disks'):
            path = os.path.join(self.new_folder(), 'kept')
            scene = dict(particles=particles, number=20, aspect=1.0, density=0.3)
            scene.update(exponents='none', equilibration=1.0, duration=2.0, checkpoint=path)
            self.ends(self.start(dict(scene, observables=['state'])), 0, f'20 {particles} in ')
            self.ends(self.start(dict(resume=path, duration=3.0)), 0, f'20 {particles} in ')
            said = f'particles = {other}: must be {particles}'
            self.ends(self.start(dict(resume=path, particles=other)), 2, said)


if __name__ == '__main__':
    harness.main('spheres')
