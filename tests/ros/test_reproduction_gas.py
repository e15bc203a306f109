"""Part 17 of the reproduction against gases that are known."""
# Second tier: tests/run.sh --all

import unittest
from math import sqrt

import numpy as np

import made
from made import LP, T
from hdlyap.plots import equation
from reproduced import Part
from study.parts import gas

STATE = "pressures are those of Henderson's equation of state"
RATE = 'disks collide as often as the pressure says'
DENSITIES = [tenths / 10 for tenths in range(1, 9)]
OF_V = made.VELOCITY  # v of all phases


class Gas(Part):
    of = gas

    def bags(self, z=1.0, rate=1.0, error=1e-3, name='', messages=True):
        """Z and rate: over what they should be; error: relative, of both."""
        bags = {}
        for run, density in zip(gas.RUNS, DENSITIES):
            info = made.run_info(density=density)
            found = [made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)]
            told = [info, made.steps(found), made.lp_phases(info, found, 150.0)]
            if messages:
                told.append(self.message(density, z, rate, error))
            bags[run] = self.bag(run + name, told)
        return bags

    def message(self, density, z, rate, error):
        z *= float(equation.compressibility(density))
        rate *= float(equation.collision_rate(z))
        is_known = error >= 0
        return made.gas(
            compressibility=z,
            pressure=z * density,
            pressure_error=z * density * error if is_known else -1.0,
            collision_rate=rate,
            collision_rate_error=rate * error if is_known else -1.0,
        )

    def test_as_it_should_be(self):
        claims = self.claims(self.bags())
        self.assertEqual([claims[name].verdict for name in (STATE, RATE)], 2 * ['agrees'])
        self.assertEqual([claims[name].values for name in (STATE, RATE)], [7, 8])
        row = claims[STATE].rows[4]
        z = float(equation.compressibility(0.5))
        self.assertEqual(row.quantity, 'Z at density 0.5')
        self.assertAlmostEqual(row.published, z)
        self.assertAlmostEqual(row.error, 1e-3 * z)
        self.assertAlmostEqual(row.left_open, 0.01 * z)

    def test_other_pressures_and_rates(self):
        for z, rate, verdicts in (
            (1.02, 1.0, ['differs', 'agrees']),
            (0.98, 1.0, ['differs', 'agrees']),
            (1.0, 1.05, ['agrees', 'differs']),
            (1.0, 2.0, ['agrees', 'differs']),  # every collision counted for both disks
        ):
            claims = self.claims(self.bags(z, rate, name=f'{z}{rate}'))
            self.assertEqual([claims[name].verdict for name in (STATE, RATE)], verdicts)

    def test_errors(self):
        """Z and rate known to 0.1 %: at density 0.1 Z - 1 is known to 0.66 % of it."""
        z = float(equation.compressibility(0.1))
        row = self.claims(self.bags())[RATE].rows[0]
        self.assertAlmostEqual(row.measured, 1.0)
        self.assertAlmostEqual(row.error, 1e-3 * np.hypot(1, z / (z - 1)))
        claims = self.claims(self.bags(error=-1.0, name='unknown'))
        self.assertEqual([claims[name].verdict for name in (STATE, RATE)], 2 * ['not decided'])

    def test_sound_and_free_path(self):
        """Of Henderson's Z: its own velocity, but for the parabola through three densities; the
        mean speed is sqrt(pi / 2)."""
        rows = self.rows(self.bags())
        for density in DENSITIES[1:-1]:
            row = rows[f'velocity of sound at density {density:.1f}']
            self.assertAlmostEqual(row.measured / equation.sound_velocity(density), 1, delta=0.02)
            self.assertTrue(0 < row.error < 0.01 * row.measured)
            self.assertIn(f'v 1.600, {1.6 / row.measured:.3f} of it', row.remark)
        path = rows['mean free path at density 0.2']
        z = float(equation.compressibility(0.2))
        self.assertAlmostEqual(path.measured, np.sqrt(np.pi / 2) / equation.collision_rate(z))
        self.assertAlmostEqual(path.error, 1e-3 * path.measured)
        k = made.wave_number(made.run_info(), 1, 0)
        self.assertEqual(path.remark, f'times k of LP(1,0), {k:.4f}: {k * path.measured:.3f}')

    def test_v_over_z(self):
        row = self.rows(self.bags())['v over Z / sqrt(2) at density 0.4']
        z = float(equation.compressibility(0.4))
        self.assertAlmostEqual(row.measured, OF_V / (z / sqrt(2)))
        self.assertGreater(row.error, 1e-3 * row.measured)

    def test_figure_and_table(self):
        bags = self.bags()
        left, right = self.figures(bags)['gas'].axes
        places, z = [one for one in left.lines if len(one.get_xdata()) == 8][0].get_data()
        np.testing.assert_allclose(places, DENSITIES)
        np.testing.assert_allclose(z, equation.compressibility(DENSITIES))
        sound, v = (one.lines[0] for one in right.containers)
        np.testing.assert_allclose(v.get_ydata(), OF_V)
        header, lines = self.tables(bags)['gas']
        self.assertEqual(len(lines), 8)
        self.assertEqual(dict(zip(header, lines[3]))['density'], '0.4')

    def test_two_densities_have_no_sound(self):
        bags = self.bags()
        for run, density in list(zip(gas.RUNS, DENSITIES))[2:]:
            bags[run] = self.bag(run + 'no', [made.run_info(density=density), made.cost(1)])
        rows = self.rows(bags)
        self.assertFalse([name for name in rows if name.startswith('velocity of sound')])
        self.assertIn('mean free path at density 0.2', rows)

    def test_without_gas(self):
        bags = self.bags(messages=False)
        with self.subTest('made of bags of before'):
            for name, claim in self.claims(bags).items():
                for row in claim.rows:
                    self.assertEqual(row.verdict, 'not measured', name)
        self.assertEqual(self.figures(bags), {})
        self.assertEqual(self.tables(bags)['gas'][1], [])


if __name__ == '__main__':
    unittest.main()
