#!/usr/bin/env python3
"""A run of each kind of particles: what a subscriber gets, against what must be so. That every
number arrives as the core has it is test_published's; that it is right, the core's tests'."""

import itertools
import math

import numpy as np
import yaml

import harness
import measured
from measured import of
from test_check import in_bag, said_of, shares
from hdlyap.msg import LpPhase, Mode
from hdlyap.data import containers, waves
from hdlyap.plots import repetition, report
from hdlyap.plots.figures import style

ROUNDING = 1e-9  # of sums over all of them
ORTHONORMAL = 1e-7
SLOPE = 1e-5  # of central differences
T, LP, ZERO = Mode.T, Mode.LP, Mode.ZERO
REST = ['spectrum', 'modes', 'steps', 'lp_phases', 't_phases', 'fields', 'structure', 'covariant']
REST += ['localization', 'gas', 'state']
LONG = dict(exponents='all', equilibration=10.0, warmup=60.0, report_interval=2.0, seed='2')
LONG.update(threads=1, field_interval=0.0, covariant_window=20.0, covariant_sampling=2.0)
CUT = dict(power=1.0, wca=2 ** (1 / 6))


def pair_energy(potential, r):
    if potential == 'power':
        return 100 * (1 - r**2) ** 4
    return 4 * (r**-12 - r**-6) + 1


class OfKind:
    """The classes below are the table of kinds. WHAT: of run_info. OWN_ENERGY: of a particle, how
    exactly. STEPS: {(kind, nodes): (expected, first index or None)}. SAID: what --check says.
    FIELDS: as many weights of each of KINDS are compared at least. Z: of the gas, between these.
    ZEROS, COVARIANT: limits of vanishing exponents, and of sums of opposite covariant ones."""

    WHAT, STEPS, SAID = {}, {}, ()
    OWN_ENERGY, ZEROS, KINDS, FIELDS = (1.0, ROUNDING), math.inf, (T, LP), 3

    @classmethod
    def setUpClass(cls):
        topics = ['run_info', *cls.SCENE['observables'], 'status', 'cost']
        cls.messages = harness.whole_run(dict(cls.SCENE, wait_for_subscribers=topics), topics)
        cls.info = cls.messages['run_info'][-1]
        cls.axes = 'xyz'[: cls.info.dimension]
        cls.box = of(cls.info, *('box_' + axis for axis in cls.axes))
        cls.walls = of(cls.info, *('boundary_' + axis for axis in cls.axes)) == 'reflecting'

    def places(self, message):
        return of(message, *self.axes)

    def momenta(self, message):
        return of(message, *('p' + axis for axis in self.axes))

    def vector(self, field):
        """[dq, dp], each with what turns."""
        turning = ['_angle'] * (self.info.inertia > 0)
        return of(field, *(f'd{half}{one}' for half in 'qp' for one in [*self.axes, *turning]))

    def nodes(self, message):
        return of(message, *('n' + axis for axis in self.axes))

    # ---- what moves

    def test_what_moves(self):
        info, scene = self.info, self.SCENE
        for name, value in self.WHAT.items():
            self.assertEqual(getattr(info, name), value, name)
        self.assertEqual(info.particles, scene.get('particles', 'disks'))
        self.assertAlmostEqual(self.volume() * info.density / info.number, 1, places=14)
        for name in {'aspect', 'aspect_z'} & set(scene):
            self.assertAlmostEqual(
                self.box['xyz'.index(name[7:] or 'y')] / self.box[0], scene[name]
            )

    def volume(self):
        return np.prod(self.box)

    def test_states(self):
        """Inside, with the energy and the momentum that they began with, and no two overlap."""
        least, energy, error = math.inf, *self.OWN_ENERGY
        for state in self.messages['state']:
            q, p = self.places(state), self.momenta(state)
            self.inside(q)
            turning = self.info.inertia * np.sum(np.array(state.spin) ** 2)
            self.assertAlmostEqual(state.kinetic_energy, np.sum(p**2) / 2 + turning / 2, 9)
            found = (state.kinetic_energy + self.potential(q)) / self.info.number
            self.assertAlmostEqual(found, energy, delta=error)
            np.testing.assert_allclose(p.sum(axis=1)[self.free()], 0.0, atol=ROUNDING)
            least = min(least, self.apart(self.bodies(state), self.each()).min())
        self.near_contact(least)

    def inside(self, q):
        edge = 0.5 * self.walls - 1e-12
        self.assertTrue((q >= edge[:, None]).all() and (q <= (self.box - edge)[:, None]).all())

    def free(self):
        return ~self.walls

    def potential(self, q):
        return 0.0

    def each(self):
        return 1

    def bodies(self, state):
        """What is hard: [axes, bodies], of each particle as often as each() says."""
        return self.places(state)

    def apart(self, q, each=1):
        """Distances of bodies of two particles, by their nearest images."""
        apart = q[:, :, None] - q[:, None, :]
        for d in np.flatnonzero(self.free()):
            apart[d] -= self.box[d] * np.round(apart[d] / self.box[d])
        other = ~np.tile(np.eye(self.info.number, dtype=bool), (each, each))
        return np.sqrt(np.sum(apart**2, axis=0))[other & np.triu(other)]

    def near_contact(self, least):
        self.assertTrue(1 - ROUNDING < least < 1.01, least)

    # ---- vectors

    def test_vectors(self):
        """Those of one time are orthonormal, and of the state that they come with."""
        states, together = {one.sim_time: one for one in self.messages['state']}, {}
        for field in self.messages['fields']:
            together.setdefault(field.sim_time, []).append(self.vector(field).ravel())
            if field.sim_time in states:
                for name in (*self.axes, 'angle', 'spin'):
                    self.assertEqual(getattr(field, name), getattr(states[field.sim_time], name))
        for vectors in together.values():
            products = np.array(vectors) @ np.array(vectors).T
            np.testing.assert_allclose(products, np.eye(len(vectors)), atol=ORTHONORMAL)
        self.assertGreater(len(together), 2)

    def test_weights(self):
        """By least squares on the fields, made again from the nodes."""
        modes, kinds = {one.sim_time: one.modes for one in self.messages['modes']}, []
        for field in self.messages['fields']:
            if field.kind not in self.KINDS or field.sim_time not in modes:
                continue
            basis = np.array([part.ravel() for part in self.fields(field)]).T
            basis = basis / np.linalg.norm(basis, axis=0)
            dq = self.vector(field)[: self.info.coordinates].ravel()
            found = basis @ np.linalg.lstsq(basis, dq / np.linalg.norm(dq), rcond=None)[0]
            mode = modes[field.sim_time][field.index - 1]
            self.assertEqual(list(self.nodes(mode)), list(self.nodes(field)))
            self.assertAlmostEqual(np.sum(found**2), mode.weight_now, delta=ORTHONORMAL)
            kinds.append(field.kind)
        self.assertGreaterEqual(min(map(kinds.count, self.KINDS)), self.FIELDS)

    def test_reconstructed_modes(self):
        """L and P of each pair: their places are no farther from the fields than all of them."""
        compared = 0
        for field in (one for one in self.messages['fields'] if one.pairs):
            fields = list(self.fields(field))
            for name, parts in (('l', fields[::2]), ('p', fields[1::2])):
                rows = of(field, *(f'{name}_{axis}' for axis in self.axes))
                rows = rows.reshape(len(self.axes), field.pairs, -1).swapaxes(0, 1)
                for got, part, far in zip(rows, parts, getattr(field, 'residual_' + name)):
                    part = (part / np.linalg.norm(part))[: len(self.axes)]
                    self.assertLessEqual(np.linalg.norm(got - part), far + ROUNDING)
                    compared += 1
            over = [getattr(field, 'p_over_p' + axis) for axis in self.axes]
            self.assertEqual({len(one) for one in over}, {field.pairs * self.info.number})
        self.assertGreaterEqual(compared, 2 * self.FIELDS)

    def fields(self, field):
        """[coordinates, N] each."""
        k = np.array([self.wave(field, d)[0] for d in range(len(self.axes))])
        root = math.sqrt(self.info.inertia)
        momenta = [*self.momenta(field), *([root * np.array(field.spin)] if root else [])]
        still = np.zeros((len(momenta) - len(self.axes), self.info.number))
        for a, gradient in self.modulations(field):
            if field.kind == LP:
                yield np.array([*(k[:, None] * gradient), *still])
                yield np.array(momenta) * a
            else:
                for e in self.across(field, k):
                    yield np.array([*(e[:, None] * gradient), *still])

    def wave(self, field, d):
        """Wave number and coordinate along d, from where it is counted."""
        n, wall = self.nodes(field)[d], self.walls[d]
        k = np.pi * n / (self.box[d] - 1) if wall else 2 * np.pi * n / self.box[d]
        return k, self.places(field)[d] - 0.5 * wall

    def modulations(self, field):
        """For each A: A, and its derivatives over k, or A where k = 0."""
        nodes = self.nodes(field)
        free = [range(2) if n and not wall else [0] for n, wall in zip(nodes, self.walls)]
        for sines in itertools.product(*free[::-1]):  # x first, as bits have it
            sines, along = sines[::-1], []
            for derived in (None, *range(len(nodes))):
                parts = [
                    np.cos(k * u - np.pi / 2 * sines[d] + np.pi / 2 * (d == derived and n > 0))
                    for d, (n, (k, u)) in enumerate(
                        (n, self.wave(field, d)) for d, n in enumerate(nodes)
                    )
                ]
                along.append(np.prod(parts, axis=0))
            yield along[0], np.array(along[1:])

    def across(self, field, k):
        """Unit vectors across k, and across walls without nodes."""
        still = self.walls & (self.nodes(field) == 0)
        _, _, across = np.linalg.svd(np.array([k, *np.eye(len(k))[still]]))
        return across[1 + sum(still) :]

    # ---- exponents and steps

    def test_spectrum(self):
        """All of them in pairs; those that vanish are small."""
        info, last = self.info, self.messages['spectrum'][-1]
        exponents, zeros = np.array(last.exponents), info.zero_exponents // 2
        half = info.coordinates * info.number
        self.assertEqual(len(exponents), info.vectors)
        if info.vectors < 2 * half:
            self.assertEqual(info.vectors, half - zeros)
            return
        np.testing.assert_array_equal(exponents, -exponents[::-1])
        self.assertEqual(last.pairing_error, 0.0)
        largest = abs(exponents[half - zeros : half]).max()
        own = math.log(last.averaged_time) / last.averaged_time
        self.assertLess(largest, min(own, self.ZEROS))
        self.assertGreater(exponents[half - zeros - 1], max(2 * own, 3 * largest))
        self.null_space(self.messages['modes'][-1].modes, range(half - zeros + 1, half + zeros + 1))

    def null_space(self, modes, zeros):
        """They lie in it, as far as they have had the time to."""
        modes = [one for one in modes if one.kind == ZERO]
        self.assertEqual([one.index for one in modes], list(zeros))
        for one in modes:
            null = np.array([one.null_x, one.null_y, one.null_z])
            self.assertAlmostEqual(sum(null) + one.null_p, 1.0, delta=0.05)
            self.assertFalse(null[: len(self.walls)][self.walls].any())
            self.assertLessEqual(one.rotation, one.null_p + 0.02)

    def test_steps(self):
        """Nothing of what is not found is stated."""
        last = self.messages['steps'][-1].steps
        named = {(s.kind, tuple(self.nodes(s))): s for s in last if not s.conjugate}
        for key, (expected, first) in self.STEPS.items():
            self.assertEqual(named[key].expected, expected, key)
            if first:
                self.assertEqual((named[key].resolved, named[key].first_index), (True, first), key)
        measured.check(self, self.messages['steps'])
        for s in (s for message in self.messages['steps'] for s in message.steps):
            if not s.resolved:
                self.assertEqual((s.first_index, s.members, s.set), (0, 0, -1))
            elif s.kind in (T, LP):
                self.assertGreater(s.multiplicity, 0.4 * s.expected)
        phases = self.messages['lp_phases'][-1].phases
        self.assertTrue({(LP, tuple(self.nodes(phase))) for phase in phases} <= set(named))
        self.assertTrue(self.messages.get('t_phases', [None])[-1] is None or phases)

    def test_covariant(self):
        if 'covariant' not in self.messages:
            self.assertNotIn('covariant', self.SCENE['observables'])
            return
        last, half = self.messages['covariant'][-1], self.info.coordinates * self.info.number
        exponents = np.array(last.exponents)
        self.assertEqual(len(exponents), 2 * half)
        self.assertLess(abs(exponents + exponents[::-1]).max(), self.COVARIANT)

    # ---- the gas, and the bag

    def test_gas(self):
        last, info = self.messages['gas'][-1], self.info
        each = of(last, *('pressure_' + axis for axis in self.axes))
        self.assertAlmostEqual(last.pressure, each.mean(), places=12)
        self.assertAlmostEqual(last.compressibility, last.pressure / self.ideal(last), places=9)
        low, high = self.Z
        self.assertTrue(low < last.compressibility < high, last.compressibility)
        if last.temperature > 0:
            kinetic = len(self.axes) / 2 * (info.number - 1) / info.number * last.temperature
            energy, error = self.OWN_ENERGY
            self.assertAlmostEqual(last.potential_energy + kinetic, energy, delta=error)

    def test_check(self):
        """What it says of the bag is what it takes."""
        said = said_of(self, self.SCENE)
        for line in self.SAID:
            self.assertRegex(said, line)
        report, fields, window = shares(said)
        for topic in report:
            those = [m for m in self.messages[topic] if not len(getattr(m, 'along', ()))]
            if those:
                self.alike(report[topic], in_bag(topic, those) / len(those), topic)
        if 'structure' in fields:
            self.alike(fields['structure'], 16 * len(self.messages['structure'][-1].along))
        if 'covariant' in window:
            self.alike(window['covariant'], in_bag('covariant', self.messages['covariant'][-1:]))
        if 'field_indices' not in self.SCENE:
            steps = [
                s for s in self.messages['steps'][-1].steps if s.kind != ZERO and not s.conjugate
            ]
            pairs = sum(s.expected // 2 for s in steps if s.kind == LP)
            by_pairs = {one.pairs: in_bag('fields', [one]) for one in self.messages['fields']}
            of_pair = (by_pairs[2] - by_pairs[0]) / 2
            self.alike(fields['fields'], len(steps) * by_pairs[0] + pairs * of_pair)

    def alike(self, said, true, name=''):
        self.assertAlmostEqual(said / true, 1.0, delta=0.02, msg=name)


class Circle(OfKind, harness.Case):
    SCENE = dict(container='circle', number=120, density=0.7, equilibration=20.0, warmup=40.0)
    SCENE.update(scene='round', duration=60.0, report_interval=5.0)
    SCENE['observables'] = ['spectrum', 'modes', 'steps', 'lp_phases', 'fields', 'gas', 'state']
    WHAT = dict(container='circle', boundary_x='curved', boundary_y='curved', aspect=1.0)
    WHAT.update(zero_exponents=4, vectors=238)
    STEPS = {(LP, (1, 1)): (4, 235)}
    KINDS = (LP,)
    Z = 5.1, 5.4  # with 480 disks 5.175
    BITS = LpPhase.COS_M, LpPhase.SIN_M

    def volume(self):
        return np.pi * (0.5 * self.box[0]) ** 2

    def inside(self, q):
        radius = 0.5 * self.box[0]
        distance = np.hypot(*(q - radius))
        self.assertLessEqual(distance.max(), radius - 0.5 + 1e-12)
        self.assertGreater(distance.max(), radius - 1.5)

    def free(self):
        return np.array([False, False])

    def ideal(self, gas):
        return self.info.number / (np.pi * (0.5 * self.box[0] - 0.5) ** 2)

    def fields(self, field):
        """By differences of the modulation."""
        at = self.info, field.wave_number, field.nx
        for bits in self.BITS[: 2 if field.nx else 1]:
            x, y = self.places(field)
            gradient = np.array(
                [
                    containers.modulation(*at, bits, x + dx, y + dy)
                    - containers.modulation(*at, bits, x - dx, y - dy)
                    for dx, dy in ((SLOPE, 0.0), (0.0, SLOPE))
                ]
            )
            yield gradient
            yield self.momenta(field) * containers.modulation(*at, bits, x, y)

    def test_what_draws_it(self):
        info, radius = self.info, 0.5 * self.box[0]
        turned = 2 * np.pi * np.arange(128) / 128
        np.testing.assert_allclose(info.outline_x, radius * (1 + np.cos(turned)), atol=1e-12)
        np.testing.assert_allclose(info.outline_y, radius * (1 + np.sin(turned)), atol=1e-12)
        steps = {(s.kind, s.nx, s.ny): s for s in self.messages['steps'][-1].steps}
        steps = {key: one for key, one in steps.items() if one.kind != ZERO}
        self.assertEqual(len(steps), 13)  # the twelve longest, and one as long as the last
        for key, root in (((LP, 1, 1), 1.84118), ((T, 2, 1), 4.61256)):
            self.assertAlmostEqual(steps[key].wave_number * (radius - 0.5), root, places=4)
        last = self.messages['steps'][-1]
        self.assertTrue(last.l_points == 0 < last.t_points)
        bits = {phase.modulation for phase in self.messages['lp_phases'][-1].phases}
        self.assertEqual(bits, set(self.BITS))
        self.assertEqual(waves.plain_formula(2, 1, LpPhase.SIN_M), 'J2(kr) sin 2theta')

    def test_it_can_be_repeated(self):
        asked = repetition.parameters(self.info)
        for name, value in self.SCENE.items():
            self.assertEqual(asked[name], value, name)
        self.assertFalse({'aspect', 'boundary_x', 'boundary_y'} & set(asked))


class Spheres(OfKind, harness.Case):
    SCENE = dict(LONG, particles='spheres', number=128, density=0.5, aspect=0.25, aspect_z=0.3)
    SCENE.update(scene='balls', warmup=20.0, duration=70.0, report_interval=5.0, seed='3')
    SCENE.update(boundary_y='reflecting', max_mode_number=2, observables=[*REST, 'hydro'])
    SCENE.update(covariant_transient=20.0)
    del SCENE['field_interval'], SCENE['covariant_sampling'], SCENE['threads']
    WHAT = dict(
        dimension=3, coordinates=3, zero_exponents=6, vectors=6 * 128, boundary_z='periodic'
    )
    STEPS = {(LP, (1, 0, 0)): (4, 376), (T, (1, 0, 0)): (2, 380)}  # of T along z alone: walls
    STEPS.update({(T, (1, 1, 0)): (4, None), (T, (1, 0, 1)): (4, None), (T, (0, 1, 1)): (4, None)})
    STEPS[LP, (0, 1, 1)] = 4, None
    COVARIANT = 0.2
    Z = 1.0, math.inf

    def ideal(self, gas):
        return 128 / (1.5 * self.box[0] * (self.box[1] - 1) * self.box[2])


class Dumbbells(OfKind, harness.Case):
    N, BOND = 36, 0.4
    SCENE = dict(LONG, particles='dumbbells', number=N, density=0.5, aspect=0.1, bond=BOND)
    SCENE.update(scene='pairs', duration=60.0, max_mode_number=3, covariant_transient=20.0)
    SCENE.update(observables=REST)
    WHAT = dict(dimension=2, coordinates=3, zero_exponents=6, vectors=6 * N)
    WHAT['own'] = [f'bond={BOND:g}', 'inertia=disks']
    STEPS = {(T, (1, 0)): (2, 3 * N - 4), (LP, (1, 0)): (4, 3 * N - 8), (ZERO, (0, 0)): (6, None)}
    ZEROS, COVARIANT, Z = 0.05, 0.3, (3.0, math.inf)
    SAID = [f'{N} dumbbells in 26.8328 x 2.68328, packing fraction 0.587, 216 vec']

    def ideal(self, gas):
        """kT is 2 N over 3 N - 2 free momenta, of which 2 N - 2 are those of centres."""
        return 0.5 * (2 * self.N - 2) / (3 * self.N - 2)

    def each(self):
        return 2

    def bodies(self, state):
        self.assertTrue(all(0 <= angle <= 2 * np.pi for angle in state.angle))
        arm = self.BOND / 2 * np.array([np.cos(state.angle), np.sin(state.angle)])
        return np.concatenate([self.places(state) + arm, self.places(state) - arm], axis=1)

    def near_contact(self, least):
        """Of neighbours that touch often."""
        self.assertTrue(1 - ROUNDING < least < 1.001, least)
        self.assertGreater(max(self.messages['state'][-1].angle), np.pi)

    def test_shape(self):
        """Two disks, but for the lens that they share."""
        self.assertAlmostEqual(self.info.inertia, self.BOND**2 / 4 + 1 / 8, places=15)
        lens = math.acos(self.BOND) / 2 - self.BOND / 2 * math.sqrt(1 - self.BOND**2)
        self.assertAlmostEqual(self.info.packing_fraction, 0.5 * (math.pi / 2 - lens), places=14)


class Soft(OfKind):
    """No two collide; of the energy a part is that of pairs."""

    def potential(self, q):
        potential = self.SCENE.get('potential', 'wca')
        r = self.apart(q)
        return np.sum(pair_energy(potential, r[r < CUT[potential]]))

    def near_contact(self, least):
        kinetic = [state.kinetic_energy for state in self.messages['state']]
        self.assertGreater(np.std(kinetic), 0.01 * self.info.number)
        self.assertTrue(math.isnan(self.messages['gas'][-1].collision_rate))
        self.assertEqual(self.messages['spectrum'][-1].collisions, 0)
        self.assertTrue(math.isnan(self.info.packing_fraction))

    def null_space(self, modes, zeros):
        """The flow is in all of them, as far as they are no translations."""
        self.assertAlmostEqual(sum(one.null_p for one in modes), 1.0, delta=ORTHONORMAL)

    def ideal(self, gas):
        return (self.info.number - 1) * gas.temperature / self.volume()


class SoftDisks(Soft, harness.Case):
    N = 36
    SCENE = dict(LONG, particles='soft_disks', potential='power', number=N, density=0.2)
    SCENE.update(aspect=0.05, scene='soft', duration=200.0, max_mode_number=1)
    SCENE.update(covariant_transient=60.0, observables=REST, field_indices=[1, 66, 69])
    WHAT = dict(dimension=2, coordinates=2, zero_exponents=6, vectors=4 * N, inertia=0)
    STEPS = {(T, (1, 0)): (2, None), (LP, (1, 0)): (4, None), (ZERO, (0, 0)): (6, 2 * N - 2)}
    OWN_ENERGY, COVARIANT, FIELDS, Z = (1.0, 1e-5), 0.2, 0, (1.0, math.inf)
    SAID = [
        rf'is valid: {N} soft_disks in .*, potential power, energy 1, time_step 0\.00\d+, '
        'integrator pefrl, 144 vectors'
    ]

    def test_words(self):
        """Titles, reports and the scene file that repeats the run have what moves them, a step that
        is chosen to its last bit; --check has nothing that is known of hard ones alone."""
        own = 'potential power, energy 1, time step 0.004427, integrator pefrl'
        self.assertEqual(
            style.scene(self.info),
            f'soft: $N={self.N}$ soft disks\n{own}\n' r'$\rho=0.2$, $L_y/L_x=0.05$, periodic',
        )
        said = report.system(self.info)
        self.assertIn(f'N = {self.N} soft disks, {own}, density 0.2, box 60', said)
        again = yaml.safe_load(repetition.scene_file(self.info))
        self.assertEqual(again['potential'], 'power')
        self.assertEqual(f"time_step={again['time_step']:.17g}", self.info.own[2])
        dense = said_of(self, dict(self.SCENE, density=0.95, aspect=0.2))
        for hard in 'packing', 'keep their places', 'c_T', 'of steps', '780':
            self.assertNotIn(hard, dense)


class SoftSpheres(Soft, harness.Case):
    SCENE = dict(LONG, particles='soft_spheres', number=32, density=0.3, aspect=0.3, aspect_z=0.3)
    SCENE.update(seed='3', equilibration=5.0, duration=100.0, max_mode_number=1)
    SCENE.update(observables=['spectrum', 'modes', 'steps', 'lp_phases', 'fields', 'gas', 'state'])
    SCENE.update(field_indices=[1, 92])
    SCENE = {name: value for name, value in SCENE.items() if not name.startswith('covariant')}
    WHAT = dict(dimension=3, coordinates=3, zero_exponents=8, vectors=6 * 32)
    OWN_ENERGY, FIELDS, Z = (1.0, 5e-4), 0, (1.3, math.inf)


if __name__ == '__main__':
    harness.main('kinds')
