"""Part 7 of the reproduction against LP phases that are known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
from made import LP, T
import reproduced  # noqa: F401, finds the study
from study import blocks
from study.parts import phases
from study.row import Scatter
from study.velocity import over_slope
from turned import Turned, Wave, course


SCATTER = 'omega / k of the LP steps about their mean'


class Phases(Turned):
    of = phases

    INFO = made.run_info(density=0.8)
    TIMES = np.arange(1.0, 301.0)
    FOUND = [made.step(INFO, LP, 1, 0, 32, 35), made.step(INFO, LP, 1, 1, 24, 31)]

    def waves(self, *velocities, wobble=0.0):
        """Of (1,0) and (1,1); wobble: amplitude of a deviation of period 10."""
        made_waves = []
        for number, (v, (nx, ny), bits) in enumerate(
            zip(velocities, ((1, 0), (1, 1)), ((0, 1), (0, 1, 2, 3)))
        ):
            omega = v * made.wave_number(self.INFO, nx, ny)
            amplitudes = 0.5 * np.exp(1j * np.arange(4 * len(bits)).reshape(4, -1))
            made_waves.append(
                Wave(
                    nx,
                    ny,
                    bits,
                    amplitudes,
                    step=number,
                    rate=lambda t, omega=omega: omega * t + wobble * np.sin(0.2 * np.pi * t),
                )
            )
        return made_waves

    def measured(self, *waves):
        return self.bag(self.INFO, *course(self.TIMES, *waves), made.steps(self.FOUND, 300.0))

    def test_rates(self):
        bag = self.measured(*self.waves(1.5, 1.5, wobble=0.02))
        rows = self.rows(bag)
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 3)
        self.assertAlmostEqual(rows['omega / k of LP(1,1)'].measured, 1.5, 3)
        self.assertAlmostEqual(rows['v, common'].measured, 1.5, 3)
        self.assertEqual(rows[SCATTER].verdict, 'agrees')

    def test_errors_are_of_blocks_of_time(self):
        (wave,) = self.waves(1.5, wobble=0.02)
        rows = self.rows(self.measured(wave))
        velocity = rows['omega / k of LP(1,0)']
        error = velocity.error * made.wave_number(self.INFO, 1, 0)
        turned = np.array([wave.turned(t) for t in self.TIMES])
        rates = np.array([piece.mean() for piece in np.array_split(np.diff(turned), blocks.BLOCKS)])
        self.assertAlmostEqual(error, rates.std(ddof=1) / 4, delta=0.1 * error)
        self.assertGreater(error, 0)

    def test_velocity_that_depends_on_k(self):
        rows = self.rows(self.measured(*self.waves(1.5, 1.6, wobble=0.02)))
        row = rows[SCATTER]
        self.assertEqual((row.published, row.verdict), (1, 'differs'))
        one, other = rows['omega / k of LP(1,0)'], rows['omega / k of LP(1,1)']
        # two values, one degree of freedom
        chi2 = (one.measured - other.measured) ** 2 / (one.error**2 + other.error**2)
        self.assertAlmostEqual(row.measured / chi2, 1, 6)
        common = rows['v, common']
        self.assertAlmostEqual(
            common.error, chi2**0.5 * (one.error**-2 + other.error**-2) ** -0.5, 6
        )
        self.assertRegex(one.remark, r', -\d+\.\d standard errors')

    def test_proportion_is_not_told_from_rates_known_poorly(self):
        """A rate that is off by two percent would have been seen with errors of 0.2 %, not with 0.9
        %; what differs by more than its error differs all the same."""
        for off, error, verdict in (
            (0.002, 0.002, 'agrees'),
            (0.002, 0.009, 'not decided'),
            (0.2, 0.009, 'differs'),
        ):
            line = phases.Line([_Velocity(v, v * error) for v in (1.5, 1.5 * (1 + off))])
            self.assertEqual(Scatter('v', *line.scatter, telling=2.0).verdict, verdict)

    def test_over_the_slope(self):
        slope = 4.624304  # c_L of the paper at density 0.8
        step = made.step(self.INFO, LP, 1, 0, 32, 35, exponent=4.0, std_error=0.04)
        row = over_slope('v', 5.0, 0.1, _Recording(self.INFO, made.steps([step])))
        ratio = 5.0 * made.wave_number(self.INFO, 1, 0) / 4.0
        self.assertAlmostEqual(row.measured, ratio, 12)
        self.assertAlmostEqual(row.error, ratio * np.hypot(0.02, 0.01), 12)
        self.assertIn(f'{5.0 / slope:.3f} with that of the paper\'s fit', row.remark)
        self.assertEqual(row.verdict, '')

    def test_fluctuation(self):
        rows = self.rows(self.measured(*self.waves(1.5, 1.5, wobble=0.2)))
        row = rows['LP(1,0), sin kx x']
        # of a sine over whole periods, in percent of a turn; the straight line takes a little of it
        self.assertAlmostEqual(row.measured, 100 * 0.2 / 2**0.5 / (2 * np.pi), delta=0.1)
        self.assertIn('2.3 % over the 299 of the longest curve', row.remark)
        self.assertIn('LP(1,1), sin kx x sin ky y', rows)

    def test_error_of_a_fluctuation(self):
        """Of times that are independent, however many vectors there are: of fewer than two none is
        known."""
        squares = [1.0, 4.0, 2.0, 9.0, 2.5, 5.5]
        for independent, error in (
            (1.0, 0.0),
            (1.9, 0.0),
            (2.0, np.std(squares)),
            (5.0, np.std(squares) / 2),
        ):
            rms, found = phases._root(squares, independent)
            self.assertAlmostEqual(rms, 2.0, 12)
            self.assertAlmostEqual(found, error / (2 * 2.0), 12)

    def test_untracked_is_left_out(self):
        (wave,) = self.waves(1.5)
        wave.weak = lambda t, vector, pair: (vector + pair + int(t / 30)) % 3 == 0
        rows = self.rows(self.measured(wave))
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 6)
        wave.weak = lambda t, vector, pair: 100 < t < 120
        rows = self.rows(self.measured(wave))
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 6)
        row = rows['LP(1,0), cos kx x']
        self.assertLess(row.measured, 1e-6)
        self.assertIn('over the 180 of the longest curve', row.remark)

    def test_figure_and_table(self):
        bag = self.measured(*self.waves(1.5, 1.6))
        figure = self.figures(bag)['phases']
        self.assertTrue(
            figure.axes[0].get_legend().get_texts()[0].get_text().startswith('LP(1,0): $v = 1.5')
        )
        header, lines = self.tables(bag)['phases']
        self.assertEqual(len(header), len(lines[0]))
        name, index, bits, time, phase = lines[1]
        self.assertEqual((name, bits, time), ('LP(1,0)', 'cos cos', '3'))  # every other of 300
        self.assertAlmostEqual(float(phase), 1.5 * made.wave_number(self.INFO, 1, 0) * 3, 3)

    T_STEPS = [made.step(INFO, T, 1, 0, 36, 37), made.step(INFO, T, 0, 1, 30, 31)]

    def standing(self, name='T', omega=0.0, error=1e-3, members=1):
        """LP(1,0) turns with 1.5 k, T modes with omega."""
        found = [*self.FOUND, *self.T_STEPS]
        self.T_STEPS[1].members = members
        self.T_STEPS[1].set = self.FOUND[0].set if members > 1 else self.T_STEPS[1].first_index
        messages = [made.t_phases(found, t, began=100.0) for t in (101.0, 102.0, 103.0, 104.0)]
        for phase in messages[-1].phases:
            phase.omega, phase.omega_error = omega, error
        (wave,) = self.waves(1.5)
        turning = course(self.TIMES, wave)
        return super().bag(self.INFO, *turning, *messages, made.steps(found, 300.0))

    def test_t_modes_that_stand_or_move(self):
        """Between a vector of LP(1,0), 1.5, and 0."""
        k = made.wave_number(self.INFO, 1, 0)
        for omega, error, verdict in (
            (0.0, 1e-3 * k, 'agrees'),
            (0.0, 0.031 * k, 'not decided'),  # less than a tenth of 1.5 would not be seen
            (0.004 * k, 1e-3 * k, 'differs'),
            (-0.004 * k, 1e-3 * k, 'differs'),
            (1.5 * k, 1e-3 * k, 'differs'),
            (0.0, -1.0, 'not measured'),
        ):
            row = self.rows(self.standing(omega=omega, error=error))['omega / k of T(1,0)']
            self.assertEqual(row.verdict, verdict)
            if error > 0:
                self.assertAlmostEqual(row.measured, omega / k, 12)
                self.assertAlmostEqual(row.error, error / k, 12)

    def test_diffusion_of_t_modes(self):
        rows = self.rows(self.standing())
        self.assertIn('D of its phase 0.00040(10) ', rows['omega / k of T(1,0)'].remark)

    def test_mixed_t_steps_are_left_out(self):
        rows = self.rows(self.standing(members=2))
        self.assertIn('omega / k of T(1,0)', rows)
        self.assertNotIn('omega / k of T(0,1)', rows)

    def test_figure_of_t_modes(self):
        """Times and phases of the first vector of each, and LP(1,0) beside them."""
        lines = self.figures(self.standing())['standing'].axes[0].lines
        (curve,) = [one for one in lines if len(one.get_xdata()) == 4][:1]
        np.testing.assert_allclose(curve.get_xdata(), [101.0, 102.0, 103.0, 104.0])
        np.testing.assert_allclose(curve.get_ydata(), 0.25)
        begin, end = lines[-1].get_xdata()
        turns = np.ptp(lines[-1].get_ydata())
        rate = 1.5 * made.wave_number(self.INFO, 1, 0) / (2 * np.pi)
        self.assertAlmostEqual(turns / (end - begin), rate, 3)

    def test_nothing_measured(self):
        bag = self.bag(self.INFO, made.cost(1))
        rows = self.rows(bag)
        self.assertEqual({row.verdict for row in rows.values()}, {'not measured'})
        self.assertIn('v, common', rows)
        self.assertEqual(self.figures(bag), {})
        self.assertEqual(self.tables(bag)['phases'][1], [])


class _Velocity:
    def __init__(self, *known):
        self.velocity = lambda: known


class _Recording:
    def __init__(self, info, steps):
        self.info, self.steps = info, steps


if __name__ == '__main__':
    unittest.main()
