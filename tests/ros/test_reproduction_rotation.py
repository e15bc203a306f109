"""Part 6 of the reproduction, and what it and others measure a rotation with, against LP phases
that are known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

from hdlyap.msg import LpPhase

import made
import made_fields
from made import LP, T
import reproduced  # noqa: F401, finds the study
from study import blocks, rotation
from study.parts import turning
from turned import WEAK, Turned, Wave, course


def _alternating(t, first, second):
    """Quarters done by the time t if every other one takes longer."""
    periods, rest = divmod(t, first + second)
    return 2 * periods + (rest / first if rest < first else 1 + (rest - first) / second)


class Turning(Turned):
    of = turning

    TIMES = np.arange(0.2, 60, 0.2)
    WALLS = made.run_info(boundary_x='reflecting', boundary_y='reflecting')

    def waves(self, quarter, other, strength=0.9):
        size = strength**0.5
        return (
            Wave(1, 0, (0,), [[size], [1j * size]], np.pi / 2 / quarter),
            Wave(1, 1, (0,), [[size], [1j * size]], np.pi / 2 / other, step=1, index=28),
        )

    def measured(self, *waves, fields=()):
        return self.bag(self.WALLS, *course(self.TIMES, *waves), *fields)

    def test_quarters_and_whose_they_are(self):
        rows = self.rows(self.measured(*self.waves(3.2, 2.1)))
        one, other = rows['quarter period of LP(1,0)'], rows['quarter period of LP(1,1)']
        self.assertAlmostEqual(one.measured, 3.2, 6)
        self.assertAlmostEqual(other.measured, 2.1, 6)
        self.assertEqual((one.published, one.left_open, one.verdict), (3.2, 0.005, 'agrees'))
        self.assertEqual(other.verdict, 'differs')
        self.assertIn('the text', one.remark)
        # a wave number of pi / L instead of pi / (L - 1)
        self.assertIn(
            f'{3.2 * 40 ** 0.5 / (40 ** 0.5 - 1):.3f} if centres reached the walls', one.remark
        )
        self.assertIn('+52.4 % off', other.remark)
        self.assertLess(one.error, 1e-6)

    def test_an_l_mode_turns_to_p(self):
        """If the rate is above 0; of each LP step."""
        name = 'an L mode turns to P, and a P mode to -L'
        for way, verdict in ((1, 'agrees'), (-1, 'differs')):
            bag = self.measured(*self.waves(3.2, way * 2.1))
            claim = self.claims({turning.RUN: bag})[name]
            self.assertEqual((claim.verdict, claim.values), (verdict, 2))
            row = self.rows(bag)['omega of LP(1,1), reflecting']
            self.assertAlmostEqual(row.measured, way * np.pi / 2 / 2.1, 6)

    def test_strength_that_goes_with_the_rate(self):
        """Five turns of two vectors a quarter turn apart: on average each turns as on a circle.
        Weighed with |z|^2 the rate would be lower by (1 - 0.6)^2 / (1 + 0.6^2)."""
        self.TIMES = 0.2 * np.arange(321)
        one, _ = self.waves(3.2, 2.1)
        one.short = 0.6
        bag = self.measured(one)
        self.assertAlmostEqual(self.rows(bag)['quarter period of LP(1,0)'].measured, 3.2, 6)
        # each phase alike, also with others unknown
        one.weak = lambda t, vector, pair: vector == 1 and 6.5 < t < 38
        turns = rotation.read(self.measured(one))[1, 0].turns()
        theta = np.pi / 2 / 3.2 * self.TIMES[50:52]
        self.assertAlmostEqual(
            turns[50], np.diff(np.unwrap(np.arctan2(0.6 * np.sin(theta), np.cos(theta))))[0], 9
        )
        one.weak = lambda t, vector, pair: vector == int(t / 0.2 + 0.5) % 2
        self.assertTrue(np.isnan(rotation.read(self.measured(one))[1, 0].turns()).all())

    def test_phase_that_begins_anew(self):
        """Whole turns are lost then, and with them a quarter that has not been seen to its end."""
        one, _ = self.waves(3.2, 2.1)
        one.begun = (30.1,)
        bag = self.measured(one)
        rows = self.rows(bag)
        self.assertAlmostEqual(rows['quarter period of LP(1,0)'].measured, 3.2, 6)
        self.assertLess(rows['standard deviation of LP(1,0)'].measured, 1e-6)
        found = rotation.read(bag)[1, 0]
        first = np.searchsorted(found.time, 30.1)
        self.assertEqual(np.flatnonzero(np.isnan(found.phase).any(axis=1)).tolist(), [first])
        self.assertTrue(np.isnan(found.z[first]).all())
        self.assertEqual(np.flatnonzero(np.isnan(found.turns())).tolist(), [first - 1, first])

    def test_the_claim_is_of_either_wave(self):
        """One wave that agrees is enough; one alone that differs is not."""
        for quarter, other, verdict in (
            (3.2, 2.1, 'agrees'),
            (4.4, 3.2, 'agrees'),
            (3.05, 2.1, 'differs'),
        ):
            bags = {turning.RUN: self.measured(*self.waves(quarter, other))}
            claim = self.claims(bags)['3.20 is a quarter of a period']
            self.assertEqual((claim.verdict, claim.values), (verdict, 2))

    def test_quarters_that_wobble(self):
        wave, _ = self.waves(3.15, 2.1)
        wave.turned = lambda t, even=wave.turned: even(t) + 0.1 * np.sin(1.7 * t)
        rows = self.rows(self.measured(wave))
        remark = rows['quarter period of LP(1,0)'].remark
        k = made.wave_number(self.WALLS, 1, 0)
        with_wobble = np.pi / 2 / 3.15 + 0.1 * (np.sin(1.7 * 59.8) - np.sin(1.7 * 0.2)) / 59.6
        self.assertIn(f'k = {k:.5f}, omega / k = {with_wobble / k:.5f}', remark)
        self.assertRegex(remark, r'is \+1\.[4-8] % off')
        self.assertRegex(
            rows['standard deviation of LP(1,0)'].remark,
            r'^3\.20 is 0\.[2-9] of them from the mean',
        )

    def test_other_steps_alone(self):
        bag = self.measured(Wave(0, 1, (0,), [[1.0]], 0.5))
        self.assertEqual(sorted(rotation.read(bag)), [(0, 1)])
        self.assertEqual(self.figures(bag), {})
        self.assertEqual(self.tables(bag)['phases'][1], [])

    def test_scatter_of_single_quarters(self):
        fast, slow = np.pi / 2 / 3.0, np.pi / 2 / 3.5
        wave = Wave(
            1, 0, (0,), [[1.0]], lambda t: fast * t if t < 30 else fast * 30 + slow * (t - 30)
        )
        row = self.rows(self.measured(wave))['standard deviation of LP(1,0)']
        # nine of 3.0 and eight of 3.5
        self.assertAlmostEqual(row.measured, np.std([3.0] * 9 + [3.5] * 8), 6)
        self.assertEqual(row.verdict, '')

    def test_vectors_scatter_as_one(self):
        """The standard deviation is known no better from a second vector that does the same at the
        same times."""
        lengths = 0.2 * np.random.default_rng(1).integers(12, 20, 50)
        ends = np.cumsum(lengths)
        wave = Wave(
            1,
            0,
            (0,),
            [[1.0], [1.0]],
            lambda t: np.pi / 2 * np.interp(t, np.r_[0, ends], np.arange(51)),
        )
        self.TIMES = np.arange(0.0, ends[-1] - 0.5, 0.2)
        row = self.rows(self.measured(wave))['standard deviation of LP(1,0)']
        # from the first multiple of a quarter turn after the beginning to the last before the end
        both = np.tile(lengths[1:49], 2)
        self.assertAlmostEqual(row.measured, both.std(), 6)
        squares = ((both - both.mean()) ** 2).reshape(blocks.BLOCKS, -1).mean(axis=1)
        alone = 0.5 * squares.std(ddof=1) / 4 / both.std()
        self.assertAlmostEqual(row.error / alone, 2**0.5, 4)

    def test_uneven_quarters(self):
        wave = Wave(1, 0, (0,), [[1.0]], lambda t: np.pi / 2 * _alternating(t, 2.9, 3.3))
        self.TIMES = np.arange(0.1, 250, 0.1)
        rows = self.rows(self.measured(wave))
        self.assertAlmostEqual(rows['LP(1,0) from L to P, vector 1'].measured, 2.9, 6)
        self.assertAlmostEqual(rows['LP(1,0) from P to -L, vector 1'].measured, 3.3, 6)

    def test_short_run(self):
        self.TIMES = self.TIMES[:60]
        rows = self.rows(self.measured(*self.waves(3.2, 2.1)))
        self.assertEqual(rows['standard deviation of LP(1,0)'].verdict, 'not measured')
        self.assertAlmostEqual(rows['quarter period of LP(1,0)'].measured, 3.2, 6)

    def test_strength(self):
        for strength, verdict in ((0.95, 'agrees'), (0.8, 'differs')):
            rows = self.rows(self.measured(*self.waves(3.2, 2.1, strength)))
            row = rows['a^2 + b^2 of LP(1,0), mean']
            self.assertAlmostEqual(row.measured, strength, 6)
            self.assertEqual(row.verdict, verdict)
            self.assertAlmostEqual(rows['a^2 + b^2 of LP(1,1), mean'].measured, strength, 6)

    def test_untracked_is_left_out(self):
        one, other = self.waves(3.2, 2.1)
        one.weak = lambda t, vector, pair: vector == 0 and 20 < t < 30
        bag = self.measured(one, other)
        rows = self.rows(bag)
        self.assertAlmostEqual(rows['quarter period of LP(1,0)'].measured, 3.2, 6)
        self.assertLess(rows['standard deviation of LP(1,0)'].measured, 1e-6)

    def test_strength_of_weak_times(self):
        one, _ = self.waves(3.2, 2.1)
        one.weak = lambda t, vector, pair: vector == 0 and 20 < t < 30
        bag = self.measured(one)
        weak = np.mean((self.TIMES > 20) & (self.TIMES < 30))
        row = self.rows(bag)['a^2 + b^2 of LP(1,0), mean']
        self.assertAlmostEqual(row.measured, 0.9 - 0.5 * weak * (0.9 - 0.02), 6)
        # what is not resolved or not followed is left out
        found = rotation.read(bag)[1, 0]
        for state in (LpPhase.UNRESOLVED, LpPhase.COARSE):
            found.state[found.state == WEAK] = state
            self.assertAlmostEqual(found.strength()[0], 0.9, 6)
            found.state[found.state == state] = WEAK

    def fields(self, times):
        steps = [
            made.step(self.WALLS, LP, 1, 0, 32, 33),
            made.step(self.WALLS, LP, 1, 1, 28, 29),
            made.step(self.WALLS, T, 1, 1, 34, 34),
        ]
        return [
            made_fields.mode_field(
                self.WALLS, one, sim_time=t, modulations=(0,), index=one.first_index
            )
            for t in times
            for one in steps
        ]

    def test_snapshots_of_both_waves(self):
        # L at 9.6, P at 12.8, .. in the fields; in the course of the phase the vector has the other
        # sign. The other wave turns by 2.94 rad in 3.2.
        wave, other = self.waves(3.2, 1.71, 1.0)
        wave.amplitudes = np.array([[np.exp(-3j * np.pi / 2)], [1.0]])
        wave.turned = lambda t, even=wave.turned: even(t) + np.pi
        wave.sign = -1
        bag = self.measured(wave, other, fields=self.fields(np.arange(1.6, 25, 1.6)))
        found = turning._chosen(bag, rotation.read(bag)[1, 0])
        np.testing.assert_allclose([one.field.sim_time for one in found], [9.6, 12.8])
        np.testing.assert_allclose([one.z for one in found], [1, 1j], atol=1e-6)
        self.assertEqual(
            found[1].title.replace('-0.00', '0.00'), 'LP(1,0), $t=12.8$: $a=0.00$, $b=1.00$'
        )
        found = turning._chosen(bag, rotation.read(bag)[1, 1])
        turned = np.angle(found[1].z / found[0].z)
        self.assertAlmostEqual(turned, np.pi / 2 * 3.2 / 1.71, 6)
        figures = self.figures(bag)
        self.assertEqual(sorted(figures), ['circle', 'quarters'])
        self.assertEqual(len(figures['quarters'].axes), 4)

    def test_no_snapshots_where_no_phase_is_tracked(self):
        wave, _ = self.waves(3.2, 2.1)
        wave.weak = lambda t, vector, pair: vector == 0 and t > 3
        bag = self.measured(wave, fields=self.fields(np.arange(1.6, 25, 1.6)))
        self.assertEqual(sorted(self.figures(bag)), ['circle'])

    def test_table(self):
        _, lines = self.tables(self.measured(*self.waves(3.2, 2.1)))['phases']
        wave, time, _, a, b, phase = lines[3]
        self.assertEqual((wave, time), ('LP(1,0)', '0.8'))
        z = 0.9**0.5 * np.exp(1j * np.pi / 2 / 3.2 * 0.8)
        np.testing.assert_allclose(
            [float(a), float(b), float(phase)], [z.real, z.imag, np.angle(z)], atol=6e-5
        )

    def test_nothing_measured(self):
        bag = self.bag(self.WALLS, made.cost(1))
        self.assertEqual(
            {row.verdict for row in self.rows(bag).values() if row.published}, {'not measured'}
        )
        self.assertEqual(self.figures(bag), {})
        self.assertEqual(self.tables(bag)['phases'][1], [])


class Quarters(unittest.TestCase):
    def test_of_an_uneven_phase(self):
        time = np.arange(0.5, 6, 0.001)
        crossed = np.sqrt(rotation.QUARTER * np.arange(1, 23))
        for sign in (1, -1):
            from_l, found = rotation.quarters(time, sign * time**2)
            self.assertEqual(
                list(from_l[:4]), [False, True, False, True]
            )  # the first level is a quarter turn
            np.testing.assert_allclose(found, np.diff(crossed)[: len(found)], atol=1e-5)
            self.assertEqual(len(found), 21)

    def test_back_and_forth_over_a_multiple_counts_once(self):
        phase = np.array([0.1, 1.5, 1.6, 1.5, 1.6, 3.0, 3.2])
        np.testing.assert_allclose(
            rotation.quarters(np.arange(7.0), phase)[1],
            [5 + (np.pi - 3) / 0.2 - 1 - (np.pi / 2 - 1.5) / 0.1],
        )


class Blocks(unittest.TestCase):
    def test_mean_of_independent_values(self):
        values = np.random.default_rng(1).normal(3.0, 2.0, 16)
        mean, error = blocks.mean(values)
        self.assertAlmostEqual(mean, values.mean(), 12)
        # one value in each block: the textbook's error
        self.assertAlmostEqual(error, values.std(ddof=1) / 4, 12)

    def test_too_few(self):
        self.assertEqual(blocks.mean(np.ones(15)), (None, 0.0))


if __name__ == '__main__':
    unittest.main()
