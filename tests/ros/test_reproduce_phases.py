"""Part 7 of the reproduction against LP phases that are known."""

import unittest

import numpy as np

import made
from made import LP
from hdlyap.reproduce import blocks
from hdlyap.reproduce.parts import phases
from turned import Turned, Wave, course


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
        k = made.wave_number(self.INFO, 1, 0)
        self.assertAlmostEqual(rows['omega of LP(1,0)'].measured, 1.5 * k, 3)
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 3)
        self.assertAlmostEqual(rows['omega / k of LP(1,1)'].measured, 1.5, 3)
        self.assertAlmostEqual(rows['v, common'].measured, 1.5, 3)
        self.assertEqual(rows['omega in proportion to k'].verdict, 'agrees')
        self.assertLess(rows['chi^2 / freedom of omega = v k'].measured, 9)

    def test_errors_are_of_blocks_of_time(self):
        (wave,) = self.waves(1.5, wobble=0.02)
        rows = self.rows(self.measured(wave))
        row, velocity = rows['omega of LP(1,0)'], rows['omega / k of LP(1,0)']
        turned = np.array([wave.turned(t) for t in self.TIMES])
        rates = np.array([piece.mean() for piece in np.array_split(np.diff(turned), blocks.BLOCKS)])
        self.assertAlmostEqual(row.error, rates.std(ddof=1) / 4, delta=0.1 * row.error)
        self.assertGreater(row.error, 0)
        self.assertAlmostEqual(velocity.error * made.wave_number(self.INFO, 1, 0), row.error, 12)

    def test_velocity_that_depends_on_k(self):
        rows = self.rows(self.measured(*self.waves(1.5, 1.6, wobble=0.02)))
        row = rows['omega in proportion to k']
        self.assertEqual((row.measured, row.verdict), ('no', 'differs'))
        one, other = rows['omega / k of LP(1,0)'], rows['omega / k of LP(1,1)']
        # two values, one degree of freedom
        chi2 = (one.measured - other.measured) ** 2 / (one.error**2 + other.error**2)
        self.assertAlmostEqual(rows['chi^2 / freedom of omega = v k'].measured / chi2, 1, 6)
        common = rows['v, common']
        self.assertAlmostEqual(
            common.error, chi2**0.5 * (one.error**-2 + other.error**-2) ** -0.5, 6
        )
        self.assertRegex(one.remark, r'^-\d+\.\d standard errors')

    def test_proportion_is_not_told_from_rates_known_poorly(self):
        """Two rates 2 % apart: with errors of 0.9 % they may be the same, with 1.1 % nothing is
        said; what differs by more than its error differs all the same."""
        for off, error, word in ((0.02, 0.009, 'yes'), (0.02, 0.011, None), (0.2, 0.011, 'no')):
            line = phases.Line(
                [_Velocity(1.5, 1.5 * 0.005), _Velocity(1.5 * (1 + off), 1.5 * (1 + off) * error)]
            )
            self.assertEqual(line.holds, word)
            self.assertIn(f'largest error is {100 * error:.2g} %', line.known_to)
        row = self.rows(self.measured(*self.waves(1.5, 1.5, wobble=0.02)))[
            'omega in proportion to k'
        ]
        self.assertIn('largest error is 0.', row.remark)

    def test_against_the_slope(self):
        slope = 4.624304  # c_L of the paper at density 0.8
        for v, word in (
            (1.02 * slope, 'near c_L'),
            (1.13 * slope, 'above c_L'),
            (0.9 * slope, 'below c_L'),
        ):
            info, steps = self.INFO, made.steps(
                [made.step(self.INFO, LP, 1, 0, 32, 35, exponent=4.0)]
            )
            row = phases.against_slope('v', v, 0.001, _Recording(info, steps))
            self.assertEqual((row.measured, row.published), (word, 'above c_L'))
            self.assertEqual(row.verdict, 'agrees' if word == 'above c_L' else 'differs')
            # one standard error of 3 %: what is within 12 % cannot be told
            row = phases.against_slope('v', v, 0.03 * slope, _Recording(info, steps))
            self.assertEqual(row.measured, word if word == 'above c_L' else None)
            self.assertIn(f'v / c_L = {v / slope:.3f} with the paper\'s', row.remark)
            self.assertIn(
                f'{v * made.wave_number(info, 1, 0) / 4.0:.3f} with our LP(1,0)', row.remark
            )

    def test_fluctuation(self):
        rows = self.rows(self.measured(*self.waves(1.5, 1.5, wobble=0.2)))
        row = rows['phase fluctuation of LP(1,0), sin kx x']
        # of a sine over whole periods, in percent of a turn; the straight line takes a little of it
        self.assertAlmostEqual(row.measured, 100 * 0.2 / 2**0.5 / (2 * np.pi), delta=0.1)
        self.assertIn('2.3 % over the 299 of the longest curve', row.remark)
        self.assertIn('phase fluctuation of LP(1,1), sin kx x sin ky y', rows)

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
        row = rows['phase fluctuation of LP(1,0), cos kx x']
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
