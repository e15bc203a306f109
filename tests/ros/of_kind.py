"""What a subscriber gets of a run of any kind of particles, against what must be so: test_kinds."""

import itertools
import math

import numpy as np

import harness
import measured
from measured import of
from test_check import in_bag, said_of, shares
from hdlyap.msg import Mode

ROUNDING = 1e-9  # of sums over all of them
ORTHONORMAL = 1e-7
SLOPE = 1e-5  # of central differences
T, LP, ZERO = Mode.T, Mode.LP, Mode.ZERO
REST = ['spectrum', 'modes', 'steps', 'lp_phases', 't_phases', 'fields', 'structure', 'covariant']
REST += ['localization', 'gas', 'state']
LONG = dict(exponents='all', equilibration=10.0, warmup=60.0, report_interval=2.0, seed='2')
LONG.update(threads=1, field_interval=0.0, covariant_window=20.0, covariant_sampling=2.0)


class OfKind:
    """Those of test_kinds are the table of kinds. WHAT: of run_info. OWN_ENERGY: of a particle, how
    exactly. STEPS: {(kind, nodes): (expected, first index or None)}. SAID: what --check says.
    FIELDS: as many weights of each of KINDS are compared at least. Z: of the gas, between these.
    ZEROS, COVARIANT: limits of vanishing exponents, and of sums of opposite covariant ones.
    SMALLEST: of the others, more. PAIRS: of vectors of one time are compared, more."""

    WHAT, STEPS, SAID = {}, {}, ()
    OWN_ENERGY, ZEROS, KINDS, FIELDS = (1.0, 4e-12), math.inf, (T, LP), 4
    SMALLEST, PAIRS = 0.0, 5

    @classmethod
    def setUpClass(cls):
        topics = ['run_info', *cls.SCENE['observables'], 'status', 'cost']
        cls.messages = harness.whole_run(dict(cls.SCENE, wait_for_subscribers=topics), topics)
        cls.info = cls.messages['run_info'][-1]
        cls.axes = 'xyz'[: cls.info.dimension]
        cls.box = of(cls.info, *('box_' + axis for axis in cls.axes))
        cls.masses, cls.diameters = (
            np.repeat(getattr(cls.info, 'kind_' + of_each), cls.info.kind_numbers)
            for of_each in ('masses', 'diameters')
        )
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
            edge = self.box['xyz'.index(name[7:] or 'y')]
            self.assertAlmostEqual(edge / (self.box[0] * scene[name]), 1, places=14)

    def volume(self):
        return np.prod(self.box)

    def test_states(self):
        """Inside, with the energy and the momentum that they began with, and no two overlap."""
        least, energy, error = math.inf, *self.OWN_ENERGY
        for state in self.messages['state']:
            q, p = self.places(state), self.momenta(state)
            self.inside(q)
            turning = self.info.inertia * np.sum(np.array(state.spin) ** 2)
            twice = np.sum(p**2 / self.masses)
            self.assertAlmostEqual(state.kinetic_energy, twice / 2 + turning / 2, 9)
            found = (state.kinetic_energy + self.potential(q)) / self.info.number
            self.assertAlmostEqual(found, energy, delta=error)
            np.testing.assert_allclose(p.sum(axis=1)[self.free()], 0.0, atol=1e-10)
            least = min(least, self.apart(self.bodies(state), self.each()).min())
        self.near_contact(least)

    def inside(self, q):
        edge = 0.5 * self.walls[:, None] * self.diameters - 1e-12
        self.assertTrue((q >= edge).all() and (q <= self.box[:, None] - edge).all())

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
        """Distances of bodies of two particles over those at contact, by their nearest images."""
        apart = q[:, :, None] - q[:, None, :]
        for d in np.flatnonzero(self.free()):
            apart[d] -= self.box[d] * np.round(apart[d] / self.box[d])
        other = ~np.tile(np.eye(self.info.number, dtype=bool), (each, each))
        contact = np.tile((self.diameters[:, None] + self.diameters) / 2, (each, each))
        return (np.sqrt(np.sum(apart**2, axis=0)) / contact)[other & np.triu(other)]

    def near_contact(self, least):
        self.assertTrue(1 - ROUNDING < least < 1.01, least)

    # ---- vectors

    def test_vectors(self):
        """Those of one time are orthonormal, and of the state that they come with."""
        states, together = {one.sim_time: one for one in self.messages['state']}, {}
        for field in self.messages['fields']:
            together.setdefault(field.sim_time, []).append(self.vector(field).ravel())
            for name in 'x', 'y', 'z', 'angle', 'spin':
                self.assertEqual(getattr(field, name), getattr(states[field.sim_time], name))
        asked = self.SCENE.get('field_indices')
        for vectors in together.values():
            self.assertEqual(len(vectors), len(asked or vectors))
            products = np.array(vectors) @ np.array(vectors).T
            np.testing.assert_allclose(products, np.eye(len(vectors)), atol=ORTHONORMAL)
        self.assertGreater(sum(map(len, together.values())) - len(together), self.PAIRS)
        for message in self.messages.get('localization', ()):
            widths = np.array(message.widths)
            self.assertTrue(((widths > 1 / self.info.number) & (widths <= 1)).all())
            self.assertEqual(len(widths), self.info.vectors)

    def test_weights(self):
        """By least squares on the fields, made again from the nodes."""
        modes, found_of = {one.sim_time: one.modes for one in self.messages['modes']}, []
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
            found_of.append((field.kind, tuple(self.nodes(field))))
        kinds = [kind for kind, _ in found_of]
        self.assertGreaterEqual(min(map(kinds.count, self.KINDS)), self.FIELDS)
        first = {key for key, (_, first) in self.STEPS.items() if first and key[0] in self.KINDS}
        self.assertLessEqual(first, set(found_of))

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
                    if not self.info.inertia:  # with what turns that is more than the places
                        self.assertAlmostEqual(np.sum(got**2), 1 - far**2, delta=1e-6)
                    compared += 1
            over = [getattr(field, 'p_over_p' + axis) for axis in self.axes]
            self.assertEqual({len(one) for one in over}, {field.pairs * self.info.number})
        self.assertGreaterEqual(compared, 2 * self.FIELDS)

    def fields(self, field):
        """[coordinates, N] each."""
        k = np.array([self.wave(field, d)[0] for d in range(len(self.axes))])
        root = math.sqrt(self.info.inertia)
        heavy = np.sqrt(self.masses)
        momenta = [*self.momenta(field) / heavy, *([root * np.array(field.spin)] if root else [])]
        still = np.zeros((len(momenta) - len(self.axes), self.info.number))
        for a, gradient in self.modulations(field):
            if field.kind == LP:
                yield np.array([*(k[:, None] * gradient * heavy), *still])
                yield np.array(momenta) * a
            else:
                for e in self.across(field, k):
                    yield np.array([*(e[:, None] * gradient * heavy), *still])

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
        self.assertGreater(exponents[half - zeros - 1], max(self.SMALLEST, 2 * own, 3 * largest))
        self.null_space(self.messages['modes'][-1].modes, range(half - zeros + 1, half + zeros + 1))

    def null_space(self, modes, zeros):
        """They lie in it, as far as they have had the time to."""
        modes = [one for one in modes if one.kind == ZERO]
        self.assertEqual([one.index for one in modes], list(zeros))
        null = np.array([of(one, *('null_' + axis for axis in self.axes)) for one in modes])
        self.assertFalse(null[:, self.walls].any())
        self.assertGreater(null[:, self.free()].max(axis=0).min(), 0.2)
        for one, translations in zip(modes, null):
            self.assertAlmostEqual(sum(translations) + one.null_p, 1.0, delta=0.05)
            self.assertLessEqual(one.rotation, one.null_p + 0.02)

    def test_steps(self):
        """Nothing of what is not found is stated."""
        last = self.messages['steps'][-1].steps
        named = {(s.kind, tuple(self.nodes(s))): s for s in last if not s.conjugate}
        for key, (expected, first) in self.STEPS.items():
            one = named[key]
            self.assertEqual(one.expected, expected, key)
            if first:
                found = one.resolved, one.first_index, one.last_index
                self.assertEqual(found, (True, first, first + expected - 1), key)
        measured.check(self, self.messages['steps'])
        for s in (s for message in self.messages['steps'] for s in message.steps):
            if not s.resolved:
                self.assertEqual((s.first_index, s.members, s.set), (0, 0, -1))
            elif s.kind in (T, LP):
                self.assertGreater(s.multiplicity, 0.4 * s.expected)
        phases = self.messages['lp_phases'][-1].phases
        self.assertTrue({(LP, tuple(self.nodes(phase))) for phase in phases} <= set(named))
        of_t = self.messages.get('t_phases')
        self.assertTrue(of_t is None or of_t[-1].phases)

    def test_covariant(self):
        if 'covariant' not in self.messages:
            self.assertNotIn('covariant', self.SCENE['observables'])
            return
        last, half = self.messages['covariant'][-1], self.info.coordinates * self.info.number
        exponents = np.array(last.exponents)
        self.assertEqual(len(exponents), 2 * half)
        self.assertLess(abs(exponents + exponents[::-1]).max(), self.COVARIANT)
        zeros = self.info.zero_exponents // 2
        self.assertLess(abs(exponents[half - zeros : half + zeros]).max(), 0.05)
        waves = {nodes for kind, nodes in self.STEPS if kind != ZERO}
        self.assertLessEqual(waves, {tuple(self.nodes(weight)) for weight in last.weights})

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
        observed = {'status', 'cost', *self.SCENE['observables']}
        self.assertEqual(set(report), observed - {'fields', 'covariant'})
        self.assertEqual(set(fields), observed & {'fields', 'structure'})
        self.assertEqual(set(window), observed & {'covariant'})
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
