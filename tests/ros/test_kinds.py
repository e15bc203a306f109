"""A run of each kind of particles: what a subscriber gets, against what must be so. That every
number arrives as the core has it is test_published's; that it is right, the core's tests'."""

import math

import numpy as np
import yaml

import harness
from of_kind import LONG, LP, ORTHONORMAL, REST, ROUNDING, SLOPE, T, ZERO, OfKind
from test_check import said_of
from hdlyap.msg import LpPhase
from hdlyap.data import containers, space, waves
from hdlyap.plots import repetition, report
from hdlyap.plots.figures import style

pytestmark = harness.UNDER_A_MASTER

CUT = dict(power=1.0, wca=2 ** (1 / 6))


def pair_energy(potential, r):
    if potential == 'power':
        return 100 * (1 - r**2) ** 4
    return 4 * (r**-12 - r**-6) + 1


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
    WHAT.update(bond=BOND)
    STEPS = {(T, (1, 0)): (2, 3 * N - 4), (LP, (1, 0)): (4, 3 * N - 8), (ZERO, (0, 0)): (6, None)}
    ZEROS, SMALLEST, COVARIANT, Z = 0.05, 0.2, 0.3, (3.0, math.inf)
    FIELDS, PAIRS = 11, 10
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

    def test_lp_turns(self):
        phases = [p for p in self.messages['lp_phases'][-1].phases if (p.nx, p.ny) == (1, 0)]
        omega = [abs(p.omega) for p in phases if p.state == LpPhase.TRACKED]
        self.assertGreater(len(omega), 4)
        self.assertGreater(min(omega), 0.1)

    def test_shape(self):
        """Two disks, but for the lens that they share."""
        self.assertAlmostEqual(self.info.inertia, self.BOND**2 / 4 + 1 / 8, places=15)
        lens = math.acos(self.BOND) / 2 - self.BOND / 2 * math.sqrt(1 - self.BOND**2)
        self.assertAlmostEqual(self.info.packing_fraction, 0.5 * (math.pi / 2 - lens), places=14)


class Mixture(OfKind, harness.Case):
    N, KINDS_OF = 60, ((39, 21), (1.0, 1.4), (1.0, 3.0))
    SCENE = dict(LONG, number=N, density=0.572, aspect=0.1, second_fraction=0.35, scene='glass')
    SCENE.update(second_diameter=1.4, second_mass=3.0, duration=80.0, max_mode_number=2)
    SCENE.update(covariant_transient=20.0, observables=[*REST, 'hydro'])
    WHAT = dict(dimension=2, coordinates=2, zero_exponents=6, vectors=4 * N, second_mass=3.0)
    STEPS = {(T, (1, 0)): (2, 2 * N - 4), (LP, (1, 0)): (4, 2 * N - 8), (ZERO, (0, 0)): (6, None)}
    ZEROS, SMALLEST, COVARIANT, Z = 0.05, 0.2, 0.3, (6.0, 6.8)  # by theory 6.43
    SAID = [
        rf'{N} disks in .*, packing fraction 0.6, second_fraction 0.35, second_diameter 1.4, '
        'second_mass 3, 240 vec'
    ]

    def ideal(self, gas):
        return self.N / self.volume()

    def test_kinds(self):
        info = self.info
        found = info.kind_numbers, info.kind_diameters, info.kind_masses
        self.assertEqual(found[:2], self.KINDS_OF[:2])
        np.testing.assert_allclose(found[2], self.KINDS_OF[2], rtol=1e-12)

    def test_pairs(self):
        """Their rates are parts of that of all, which is that of theory, as far as the arrangement
        of sixty in a narrow box allows."""
        last = self.messages['gas'][-1]
        rates = [getattr(last, 'collision_rate_' + pair) for pair in space.PAIRS]
        self.assertAlmostEqual(sum(rates), last.collision_rate, places=9)
        expected = [getattr(last, 'expected_rate_' + pair) for pair in space.PAIRS]
        self.assertAlmostEqual(sum(rates) / sum(expected), 1.0, delta=0.06)
        self.assertAlmostEqual(last.compressibility, last.expected_compressibility, delta=0.4)

    def test_second_kind(self):
        """Its share of T(1,0) is its part of the mass, 63 of 102, but for what is not in the
        fields; its part of the disks is 0.35."""
        modes = self.messages['modes'][-1].modes
        shares = [one.second_kind for one in modes]
        self.assertTrue(0 < min(shares) and max(shares) < 1)
        of_t = [one.second_kind for one in modes if (one.kind, one.nx) == (T, 1)]
        np.testing.assert_allclose(of_t, 63 / 102, atol=0.1)


class Soft(OfKind):
    """No two collide; of the energy a part is that of pairs."""

    def potential(self, q):
        potential = self.SCENE.get('potential', 'wca')
        r = self.apart(q)
        return np.sum(pair_energy(potential, r[r < CUT[potential]]))

    def near_contact(self, least):
        kinetic = [state.kinetic_energy for state in self.messages['state']]
        self.assertGreater(np.std(kinetic), 0.01 * self.info.number)
        self.assertLess(np.mean(kinetic), 0.99 * self.info.number)
        self.assertEqual(self.messages['spectrum'][-1].collisions, 0)
        self.assertTrue(math.isnan(self.info.packing_fraction))

    def null_space(self, modes, zeros):
        """The flow is in all of them, as far as they are no translations."""
        self.assertAlmostEqual(sum(one.null_p for one in modes), 1.0, delta=ORTHONORMAL)

    def ideal(self, gas):
        return (self.info.number - 1) * gas.temperature / self.volume()

    def test_gas(self):
        """Its temperature is that of the states."""
        super().test_gas()
        gas, begin = self.messages['gas'][-1], self.SCENE['equilibration'] + self.SCENE['warmup']
        self.assertTrue(math.isnan(gas.collision_rate) and gas.collision_rate_error == -1)
        self.assertAlmostEqual(gas.averaged_time, gas.sim_time - begin, delta=0.01)
        states = [state for state in self.messages['state'] if state.sim_time > begin]
        kt = np.array([one.kinetic_energy for one in states]) / (self.info.number - 1)
        kt *= 2 / len(self.axes)
        error = np.std(kt) / math.sqrt(len(kt))
        self.assertAlmostEqual(gas.temperature, np.mean(kt), delta=4 * error)


class SoftDisks(Soft, harness.Case):
    N = 36
    SCENE = dict(LONG, particles='soft_disks', potential='power', number=N, density=0.2)
    SCENE.update(aspect=0.05, scene='soft', duration=200.0, max_mode_number=1)
    SCENE.update(covariant_transient=60.0, observables=REST, field_indices=[1, 66, 69])
    WHAT = dict(dimension=2, coordinates=2, zero_exponents=6, vectors=4 * N, inertia=0)
    STEPS = {(T, (1, 0)): (2, None), (LP, (1, 0)): (4, None), (ZERO, (0, 0)): (6, 2 * N - 2)}
    OWN_ENERGY, COVARIANT, FIELDS, Z = (1.0, 1e-5), 0.2, 0, (1.0, math.inf)
    PAIRS = 180
    SAID = [
        rf'is valid: {N} soft_disks in .*, potential power, energy 1, time_step 0\.00\d+, '
        'integrator pefrl, 144 vectors'
    ]

    def test_often(self):
        """So many of each; of a set that T(1,0) and LP(1,0) share T is found, at times."""
        for topic, least in (('lp_phases', 90), ('t_phases', 90), ('gas', 99), ('state', 130)):
            self.assertGreater(len(self.messages[topic]), least, topic)
        self.assertGreater(self.messages['covariant'][-1].samples, 10)
        found = [s for one in self.messages['steps'] for s in one.steps if s.resolved]
        self.assertIn((T, 1), {(s.kind, s.nx) for s in found})

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
        self.assertEqual(again['time_step'], self.info.time_step)
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

    def test_errors(self):
        last = self.messages['gas'][-1]
        for name in 'pressure', 'pressure_z', 'temperature', 'potential_energy', 'compressibility':
            error, value = getattr(last, name + '_error'), getattr(last, name)
            self.assertTrue(0 < error < 0.1 * value, f'{name} {value} +- {error}')
