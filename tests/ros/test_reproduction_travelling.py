"""Part 13 of the reproduction against waves that travel as is known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
from made import LP
import reproduced  # noqa: F401, finds the study
from study import rotation
from study.parts import travelling
from turned import Turned, Wave, course


class Travelling(Turned):
    of = travelling

    INFO = made.run_info(density=0.8)
    K = made.wave_number(INFO, 1, 0)
    OMEGA = 5.2 * K
    TIMES = np.arange(0.1, 40, 0.1)
    RIGHT, LEFT, STANDING = (1.0, -1.0j), (1.0, 1.0j), (1.0, 1.0)

    def measured(self, *amplitudes, weak=None, omega=OMEGA):
        wave = Wave(1, 0, (0, 1), np.array(amplitudes) / 2**0.5, omega)
        wave.weak = weak or wave.weak
        return self.bag(
            self.INFO,
            *course(self.TIMES, wave),
            made.steps([made.step(self.INFO, LP, 1, 0, 32, 35, exponent=4.6 * self.K)]),
        )

    def test_velocity(self):
        bag = self.measured(self.STANDING, self.RIGHT)
        rows = self.rows(bag)
        ratio = rows['front velocity / (omega / k), same times']
        self.assertAlmostEqual(ratio.measured, 1.0, 6)
        self.assertEqual((ratio.published, ratio.verdict), (None, ''))
        self.assertIn('locked within a quarter turn', ratio.remark)
        slope = rows['front velocity, mean slope']
        self.assertIn('39.8 time units, towards +x, handedness +1.00', slope.remark)
        self.assertAlmostEqual(slope.measured, 5.2, 6)
        self.assertAlmostEqual(rows['omega / k of LP(1,0), same run'].measured, 5.2, 6)
        over = rows['v / c_L']
        self.assertAlmostEqual(over.measured, 5.2 / 4.6, 6)
        # errors of the blocks' rates, and of the step
        self.assertAlmostEqual(over.error / over.measured, made.ERROR / (4.6 * self.K), 6)
        self.assertIn('1.124 with that of the paper', over.remark)
        self.assertLess(rows['unevenness of the front, rms'].measured, 1e-6)

    def test_towards_minus_x(self):
        rows = self.rows(self.measured(self.STANDING, self.LEFT))
        self.assertAlmostEqual(rows['front velocity / (omega / k), same times'].measured, 1.0, 6)
        self.assertIn(
            'towards -x, mirrored, handedness -1.00', rows['front velocity, mean slope'].remark
        )
        self.assertAlmostEqual(rows['front velocity, mean slope'].measured, 5.2, 6)
        # the same field if everything turns backwards
        rows = self.rows(self.measured(self.RIGHT, omega=-self.OMEGA))
        self.assertIn('towards -x', rows['front velocity, mean slope'].remark)
        self.assertAlmostEqual(rows['front velocity / (omega / k), same times'].measured, 1.0, 6)

    def test_uneven_wave_has_steps_and_the_same_mean(self):
        rows = self.rows(self.measured((1.0, -0.5j)))
        # theta of an ellipse is never further than a quarter turn from the phase
        self.assertAlmostEqual(
            rows['front velocity, mean slope'].measured,
            5.2,
            delta=2 * rotation.QUARTER / self.K / 39.8,
        )
        self.assertIn(
            f'handedness {2 * 0.5 / 1.25:+.2f}', rows['front velocity, mean slope'].remark
        )
        # blocks of a turn hardly see the steps
        self.assertLess(rows['front velocity, mean slope'].error, 0.1)
        # rms of theta - omega t: tan theta = 0.5 tan omega t
        turn = np.linspace(0, 2 * np.pi, 100001)
        off = np.std(np.unwrap(np.arctan2(0.5 * np.sin(turn), np.cos(turn))) - turn) / self.K
        self.assertAlmostEqual(rows['unevenness of the front, rms'].measured, off, delta=0.05 * off)

    def test_wave_that_turns_round(self):
        """Of two stretches the longer counts."""
        wave = Wave(1, 0, (0, 1), [(1.0, -1.0j)], self.OMEGA)
        half = 24.95
        right, left = np.array([self.RIGHT]), np.array([self.LEFT])
        messages = []
        for t in self.TIMES:
            wave.amplitudes = right if t < half else left
            messages += course([t], wave)
        rows = self.rows(self.bag(self.INFO, *messages))
        ratio = rows['front velocity / (omega / k), same times']
        self.assertAlmostEqual(ratio.measured, 1.0, 6)
        remark = rows['front velocity, mean slope'].remark
        self.assertIn('24.8 time units, towards +x', remark)

    def test_handedness(self):
        for amplitudes, size in (
            ((self.RIGHT, self.LEFT), 1.0),
            ((self.STANDING, self.RIGHT), 0.5),
            (((1.0, -0.5j), (0.5j, 1.0)), 0.8),
        ):
            row = self.rows(self.measured(*amplitudes))['handedness of LP(1,0), mean size']
            self.assertAlmostEqual(row.measured, size, 9)
            self.assertEqual(row.verdict, 'agrees')

    def test_a_standing_wave_does_not_travel(self):
        row = self.rows(self.measured(self.STANDING, self.STANDING))[
            'handedness of LP(1,0), mean size'
        ]
        self.assertEqual(row.verdict, 'differs')

    def test_vector_tracked_throughout_is_chosen(self):
        bag = self.measured(
            self.RIGHT,
            (1.0, -0.6j),
            weak=lambda t, vector, pair: (vector, pair) == (0, 1) and 10 < t < 12,
        )
        rows = self.rows(bag)
        self.assertIn(f'handedness {1.2 / 1.36:+.2f}', rows['front velocity, mean slope'].remark)
        header, lines = self.tables(bag)['stretches']
        self.assertEqual(len(header), len(lines[0]))
        # index, from when and how long both pairs of each have been tracked without a break
        self.assertEqual(
            [line[:3] for line in lines],
            [('33', '0.1', '39.8'), ('32', '12', '27.9'), ('32', '0.1', '9.9')],
        )
        self.assertEqual(lines[1][3:5], ('1.000', '5.2'))

    def test_front_is_where_the_field_vanishes(self):
        bag = self.measured((0.8, 0.6 * np.exp(-1.2j)))
        front = travelling.chosen(rotation.read(bag)[1, 0])
        x = front.sign * front.place
        derivatives = -np.sin(self.K * x), np.cos(self.K * x)  # of cos k x and sin k x, over k
        np.testing.assert_allclose(
            sum(a * d for a, d in zip(front.l_part, derivatives)), 0, atol=1e-9
        )

    def test_figure(self):
        bag = self.measured((0.8, 0.6 * np.exp(-1.2j)))
        figure = self.figures(bag)['wave']
        time, cos, sin, _ = map(float, self.tables(bag)['front'][1][7])
        shown = figure.axes[0].collections[0].get_array().reshape(travelling.PLACES + 1, -1)
        place = 0.3 * self.INFO.box_x
        self.assertAlmostEqual(
            shown[60, 7], -cos * np.sin(self.K * place) + sin * np.cos(self.K * place), 3
        )
        z = np.array([0.8, 0.6 * np.exp(-1.2j)]) / 2**0.5 * np.exp(1j * self.OMEGA * time)
        np.testing.assert_allclose([cos, sin], z.real, atol=6e-5)

    def test_nothing_measured(self):
        bag = self.bag(self.INFO, made.cost(1))
        self.assertEqual({row.verdict for row in self.rows(bag).values()}, {'not measured'})
        self.assertEqual(self.figures(bag), {})
        self.assertEqual(self.tables(bag)['front'][1], [])


if __name__ == '__main__':
    unittest.main()
