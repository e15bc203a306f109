"""Parts 6, 7 and 13 of the reproduction against LP phases that are known: rows, figures, tables."""

import os
import tempfile
import unittest

import numpy as np

from hdlyap.msg import LpPhase, LpPhases

import made
from made import LP, T
from hdlyap_plots.figures.style import plt
from hdlyap_reproduce import blocks, rotation
from hdlyap_reproduce.bag import Bag
from hdlyap_reproduce.parts import phases, travelling, turning

WEAK = LpPhase.WEAK


class Made(unittest.TestCase):
    """Bags with waves of known angular velocity."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, 'run.bag')
        self.addCleanup(plt.close, 'all')

    def bag(self, *messages):
        made.write(self.path, messages)
        return Bag(self.path)

    def rows(self, part, bag):
        return {row.quantity: row for row in part.rows({part.RUN: bag})}

    def figures(self, part, bag):
        return dict(part.figures({part.RUN: bag}))

    def tables(self, part, bag):
        return {name: (header, list(lines)) for name, header, lines in part.tables({part.RUN: bag})}

    def assertDrawn(self, figure):
        figure.canvas.draw()
        self.assertGreater(np.unique(np.asarray(figure.canvas.buffer_rgba())).size, 10)


class Wave:
    """z = amplitude exp(i phase(t)) for every vector and pair; phase: a rate, or a function of time. With short below 1
    a circle becomes an ellipse with that axis along b, on which |z| and the rate depend on the phase."""

    short = 1.0
    begun = ()          # times at which tracking begins anew

    def __init__(self, nx, ny, bits, amplitudes, rate, step=0, index=32):
        self.nx, self.ny, self.bits, self.step, self.index = nx, ny, bits, step, index
        self.amplitudes = np.array(amplitudes, dtype=complex)
        self.turned = rate if callable(rate) else lambda t: rate * t
        self.weak = lambda t, vector, pair: False
        self.sign = 1       # of the vectors, against that with which their tracking began

    def at(self, t):
        for vector, row in enumerate(self.amplitudes):
            for pair, amplitude in enumerate(row):
                turn = float(np.angle(amplitude) + self.turned(t))
                on_circle = np.exp(1j * turn)
                z = abs(amplitude) * (on_circle.real + 1j * self.short * on_circle.imag)
                phase = turn + np.angle(z / on_circle)
                since = max((begin for begin in self.begun if begin <= t), default=0.0)
                if since:
                    phase -= 2 * np.pi * round((np.angle(amplitude) + self.turned(since)) / (2 * np.pi))
                one = LpPhase(step=self.step, nx=self.nx, ny=self.ny, modulation=self.bits[pair],
                              index=self.index + vector, state=LpPhase.TRACKED, a=z.real, b=z.imag, phase=phase,
                              omega=1.0, omega_error=0.1, tracked_time=t - since)
                one.a, one.b = self.sign * one.a, self.sign * one.b
                if self.weak(t, vector, pair):
                    one.state, one.phase, one.a, one.b = WEAK, 1e3 * np.sin(1e3 * t), 0.1, -0.1
                yield one


def course(times, *waves):
    return [LpPhases(run_id='one', sim_time=t, samples_per_report=1,
                     phases=[one for wave in waves for one in wave.at(t)]) for t in times]


def _alternating(t, first, second):
    """Quarters done by the time t if every other one takes longer."""
    periods, rest = divmod(t, first + second)
    return 2 * periods + (rest / first if rest < first else 1 + (rest - first) / second)


# ---- turning -----------------------------------------------------------------------------------------------------

class Turning(Made):
    TIMES = np.arange(0.2, 60, 0.2)
    WALLS = made.run_info(boundary_x='reflecting', boundary_y='reflecting')

    def waves(self, quarter, other, strength=0.9):
        size = strength ** 0.5
        return (Wave(1, 0, (0,), [[size], [1j * size]], np.pi / 2 / quarter),
                Wave(1, 1, (0,), [[size], [1j * size]], np.pi / 2 / other, step=1, index=28))

    def measured(self, *waves, fields=()):
        return self.bag(self.WALLS, *course(self.TIMES, *waves), *fields)

    def test_quarters_and_whose_they_are(self):
        rows = self.rows(turning, self.measured(*self.waves(3.2, 2.1)))
        one, other = rows['quarter period of LP(1,0)'], rows['quarter period of LP(1,1)']
        self.assertAlmostEqual(one.measured, 3.2, 6)
        self.assertAlmostEqual(other.measured, 2.1, 6)
        self.assertEqual((one.published, one.published_error, one.verdict), (3.2, 0.005, 'agrees'))
        self.assertEqual(other.verdict, 'differs')
        self.assertIn('the text', one.remark)
        # a wave number of pi / L instead of pi / (L - 1)
        self.assertIn(f'{3.2 * 40 ** 0.5 / (40 ** 0.5 - 1):.3f} if centres reached the walls', one.remark)
        self.assertIn('+52.4 % off', other.remark)
        self.assertLess(one.error, 1e-6)

    def test_strength_that_goes_with_the_rate(self):
        """Five turns of two vectors a quarter turn apart: on average each turns as on a circle. Weighed with |z|^2 the
        rate would be lower by (1 - 0.6)^2 / (1 + 0.6^2)."""
        self.TIMES = 0.2 * np.arange(321)
        one, _ = self.waves(3.2, 2.1)
        one.short = 0.6
        bag = self.measured(one)
        self.assertAlmostEqual(self.rows(turning, bag)['quarter period of LP(1,0)'].measured, 3.2, 6)
        # each phase alike, also with others unknown
        one.weak = lambda t, vector, pair: vector == 1 and 6.5 < t < 38
        turns = rotation.read(self.measured(one))[1, 0].turns()
        theta = np.pi / 2 / 3.2 * self.TIMES[50:52]
        self.assertAlmostEqual(turns[50], np.diff(np.unwrap(np.arctan2(0.6 * np.sin(theta), np.cos(theta))))[0], 9)
        one.weak = lambda t, vector, pair: vector == int(t / 0.2 + 0.5) % 2
        self.assertTrue(np.isnan(rotation.read(self.measured(one))[1, 0].turns()).all())

    def test_phase_that_begins_anew(self):
        """Whole turns are lost then, and with them a quarter that has not been seen to its end."""
        one, _ = self.waves(3.2, 2.1)
        one.begun = (30.1,)
        bag = self.measured(one)
        rows = self.rows(turning, bag)
        self.assertAlmostEqual(rows['quarter period of LP(1,0)'].measured, 3.2, 6)
        self.assertLess(rows['single quarters of LP(1,0), standard deviation'].measured, 1e-6)
        found = rotation.read(bag)[1, 0]
        first = np.searchsorted(found.time, 30.1)
        self.assertEqual(np.flatnonzero(np.isnan(found.phase).any(axis=1)).tolist(), [first])
        self.assertTrue(np.isnan(found.z[first]).all())
        self.assertEqual(np.flatnonzero(np.isnan(found.turns())).tolist(), [first - 1, first])

    def owner(self, quarter, other):
        # single quarters that scatter by a few percent
        waves = self.waves(quarter, other)
        for wave in waves:
            even = wave.turned
            wave.turned = lambda t, even=even: even(t) + 0.1 * np.sin(1.7 * t)
        return self.rows(turning, self.measured(*waves))['3.20 is a quarter period of']

    def test_owner(self):
        row = self.owner(3.15, 2.1)
        self.assertEqual((row.measured, row.verdict), ('LP(1,0)', 'agrees'))
        remark = self.rows(turning, Bag(self.path))['quarter period of LP(1,0)'].remark
        k = made.wave_number(self.WALLS, 1, 0)
        with_wobble = np.pi / 2 / 3.15 + 0.1 * (np.sin(1.7 * 59.8) - np.sin(1.7 * 0.2)) / 59.6
        self.assertIn(f'k = {k:.5f}, omega / k = {with_wobble / k:.5f}', remark)
        self.assertRegex(remark, r'is \+1\.[4-8] % off, or 0\.[2-9] standard deviations of single quarters')
        row = self.owner(4.4, 3.25)
        self.assertEqual((row.measured, row.verdict), ('LP(1,1)', 'differs'))
        self.assertEqual(self.owner(5.0, 2.0).measured, 'neither')

    def test_no_owner_without_a_rival(self):
        for nearest in (3.15, 2.1):
            wave, _ = self.waves(nearest, 2.1)
            wave.turned = lambda t, even=wave.turned: even(t) + 0.1 * np.sin(1.7 * t)
            rows = self.rows(turning, self.measured(wave))
            self.assertTrue(rows['single quarters of LP(1,0), standard deviation'].measured)
            self.assertEqual(rows['3.20 is a quarter period of'].verdict, 'not measured')

    def test_other_steps_alone(self):
        bag = self.measured(Wave(0, 1, (0,), [[1.0]], 0.5))
        self.assertEqual(sorted(rotation.read(bag)), [(0, 1)])
        self.assertEqual(self.figures(turning, bag), {})
        self.assertEqual(self.tables(turning, bag)['phases'][1], [])

    def test_scatter_of_single_quarters(self):
        fast, slow = np.pi / 2 / 3.0, np.pi / 2 / 3.5
        wave = Wave(1, 0, (0,), [[1.0]], lambda t: fast * t if t < 30 else fast * 30 + slow * (t - 30))
        row = self.rows(turning, self.measured(wave))['single quarters of LP(1,0), standard deviation']
        # nine of 3.0 and eight of 3.5
        self.assertAlmostEqual(row.measured, np.std([3.0] * 9 + [3.5] * 8), 6)
        self.assertEqual(row.verdict, '')

    def test_vectors_scatter_as_one(self):
        """The standard deviation is known no better from a second vector that does the same at the same times."""
        lengths = 0.2 * np.random.default_rng(1).integers(12, 20, 50)
        ends = np.cumsum(lengths)
        wave = Wave(1, 0, (0,), [[1.0], [1.0]],
                    lambda t: np.pi / 2 * np.interp(t, np.r_[0, ends], np.arange(51)))
        self.TIMES = np.arange(0.0, ends[-1] - 0.5, 0.2)
        row = self.rows(turning, self.measured(wave))['single quarters of LP(1,0), standard deviation']
        # from the first multiple of a quarter turn after the beginning to the last before the end
        both = np.tile(lengths[1:49], 2)
        self.assertAlmostEqual(row.measured, both.std(), 6)
        squares = ((both - both.mean()) ** 2).reshape(blocks.BLOCKS, -1).mean(axis=1)
        alone = 0.5 * squares.std(ddof=1) / 4 / both.std()
        self.assertAlmostEqual(row.error / alone, 2 ** 0.5, 4)

    def test_uneven_quarters(self):
        wave = Wave(1, 0, (0,), [[1.0]], lambda t: np.pi / 2 * _alternating(t, 2.9, 3.3))
        self.TIMES = np.arange(0.1, 250, 0.1)
        rows = self.rows(turning, self.measured(wave))
        self.assertAlmostEqual(rows['quarters of LP(1,0) from L to P, vector 1'].measured, 2.9, 6)
        self.assertAlmostEqual(rows['quarters of LP(1,0) from P to -L, vector 1'].measured, 3.3, 6)

    def test_short_run(self):
        self.TIMES = self.TIMES[:60]
        rows = self.rows(turning, self.measured(*self.waves(3.2, 2.1)))
        self.assertEqual(rows['3.20 is a quarter period of'].verdict, 'not measured')
        self.assertEqual(rows['single quarters of LP(1,0), standard deviation'].verdict, 'not measured')
        self.assertAlmostEqual(rows['quarter period of LP(1,0)'].measured, 3.2, 6)

    def test_strength(self):
        for strength, verdict in ((0.95, 'agrees'), (0.8, 'differs')):
            rows = self.rows(turning, self.measured(*self.waves(3.2, 2.1, strength)))
            row = rows['a^2 + b^2 of LP(1,0), mean']
            self.assertAlmostEqual(row.measured, strength, 6)
            self.assertEqual(row.verdict, verdict)
            # of this wave the paper does not say it
            self.assertEqual((rows['a^2 + b^2 of LP(1,1), mean'].published, row.published), (None, 1.0))
            self.assertAlmostEqual(rows['a^2 + b^2 of LP(1,1), mean'].measured, strength, 6)

    def test_untracked_is_left_out(self):
        one, other = self.waves(3.2, 2.1)
        one.weak = lambda t, vector, pair: vector == 0 and 20 < t < 30
        bag = self.measured(one, other)
        rows = self.rows(turning, bag)
        self.assertAlmostEqual(rows['quarter period of LP(1,0)'].measured, 3.2, 6)
        self.assertLess(rows['single quarters of LP(1,0), standard deviation'].measured, 1e-6)

    def test_strength_of_weak_times(self):
        one, _ = self.waves(3.2, 2.1)
        one.weak = lambda t, vector, pair: vector == 0 and 20 < t < 30
        bag = self.measured(one)
        weak = np.mean((self.TIMES > 20) & (self.TIMES < 30))
        row = self.rows(turning, bag)['a^2 + b^2 of LP(1,0), mean']
        self.assertAlmostEqual(row.measured, 0.9 - 0.5 * weak * (0.9 - 0.02), 6)
        # what is not resolved or not followed is left out
        found = rotation.read(bag)[1, 0]
        for state in (LpPhase.UNRESOLVED, LpPhase.COARSE):
            found.state[found.state == WEAK] = state
            self.assertAlmostEqual(found.strength()[0], 0.9, 6)
            found.state[found.state == state] = WEAK

    def fields(self, times):
        step = made.step(self.WALLS, LP, 1, 0, 32, 33)
        other = made.step(self.WALLS, T, 1, 1, 34, 34)
        return [made.mode_field(self.WALLS, one, sim_time=t, modulations=(0,), index=one.first_index)
                for t in times for one in (step, other)]

    def test_snapshots(self):
        # L at 9.6, P at 12.8, .. in the fields; in the course of the phase the vector has the other sign
        wave, _ = self.waves(3.2, 2.1, 1.0)
        wave.amplitudes = np.array([[np.exp(-3j * np.pi / 2)], [1.0]])
        wave.turned = lambda t, even=wave.turned: even(t) + np.pi
        wave.sign = -1
        bag = self.measured(wave, fields=self.fields(np.arange(1.6, 25, 1.6)))
        found = turning._chosen(bag, rotation.read(bag))
        np.testing.assert_allclose([one.field.sim_time for one in found], [9.6, 12.8, 16.0, 19.2])
        np.testing.assert_allclose([one.z for one in found], [1, 1j, -1, -1j], atol=1e-6)
        self.assertEqual(found[1].title.replace('-0.00', '0.00'), '$t=12.8$: $a=0.00$, $b=1.00$')
        figures = self.figures(turning, bag)
        self.assertEqual(sorted(figures), ['circle', 'quarters'])
        for figure in figures.values():
            self.assertDrawn(figure)
        self.assertEqual(len(figures['quarters'].axes), 4)

    def test_no_snapshots_where_no_phase_is_tracked(self):
        wave, _ = self.waves(3.2, 2.1)
        wave.weak = lambda t, vector, pair: vector == 0 and t > 11
        bag = self.measured(wave, fields=self.fields(np.arange(1.6, 25, 1.6)))
        self.assertEqual(sorted(self.figures(turning, bag)), ['circle'])

    def test_table(self):
        _, lines = self.tables(turning, self.measured(*self.waves(3.2, 2.1)))['phases']
        wave, time, _, a, b, phase = lines[3]
        self.assertEqual((wave, time), ('LP(1,0)', '0.8'))
        z = 0.9 ** 0.5 * np.exp(1j * np.pi / 2 / 3.2 * 0.8)
        np.testing.assert_allclose([float(a), float(b), float(phase)], [z.real, z.imag, np.angle(z)], atol=6e-5)

    def test_nothing_measured(self):
        bag = self.bag(self.WALLS, made.cost(1))
        self.assertEqual({row.verdict for row in turning.rows({turning.RUN: bag}) if row.published}, {'not measured'})
        self.assertEqual(self.figures(turning, bag), {})
        self.assertEqual(self.tables(turning, bag)['phases'][1], [])


class Quarters(unittest.TestCase):
    def test_of_an_uneven_phase(self):
        time = np.arange(0.5, 6, 0.001)
        crossed = np.sqrt(rotation.QUARTER * np.arange(1, 23))
        for sign in (1, -1):
            from_l, found = rotation.quarters(time, sign * time ** 2)
            self.assertEqual(list(from_l[:4]), [False, True, False, True])      # the first level is a quarter turn
            np.testing.assert_allclose(found, np.diff(crossed)[:len(found)], atol=1e-5)
            self.assertEqual(len(found), 21)

    def test_back_and_forth_over_a_multiple_counts_once(self):
        phase = np.array([0.1, 1.5, 1.6, 1.5, 1.6, 3.0, 3.2])
        np.testing.assert_allclose(rotation.quarters(np.arange(7.0), phase)[1],
                                   [5 + (np.pi - 3) / 0.2 - 1 - (np.pi / 2 - 1.5) / 0.1])


class Blocks(unittest.TestCase):
    def test_mean_of_independent_values(self):
        values = np.random.default_rng(1).normal(3.0, 2.0, 16)
        mean, error = blocks.mean(values)
        self.assertAlmostEqual(mean, values.mean(), 12)
        # one value in each block: the textbook's error
        self.assertAlmostEqual(error, values.std(ddof=1) / 4, 12)

    def test_too_few(self):
        self.assertEqual(blocks.mean(np.ones(15)), (None, 0.0))


# ---- phases ------------------------------------------------------------------------------------------------------

class Phases(Made):
    INFO = made.run_info(density=0.8)
    TIMES = np.arange(1.0, 301.0)
    FOUND = [made.step(INFO, LP, 1, 0, 32, 35), made.step(INFO, LP, 1, 1, 24, 31)]

    def waves(self, *velocities, wobble=0.0):
        """Of (1,0) and (1,1); wobble: amplitude of a deviation of period 10."""
        made_waves = []
        for number, (v, (nx, ny), bits) in enumerate(zip(velocities, ((1, 0), (1, 1)), ((0, 1), (0, 1, 2, 3)))):
            omega = v * made.wave_number(self.INFO, nx, ny)
            amplitudes = 0.5 * np.exp(1j * np.arange(4 * len(bits)).reshape(4, -1))
            made_waves.append(Wave(nx, ny, bits, amplitudes, step=number,
                                   rate=lambda t, omega=omega: omega * t + wobble * np.sin(0.2 * np.pi * t)))
        return made_waves

    def measured(self, *waves):
        return self.bag(self.INFO, *course(self.TIMES, *waves), made.steps(self.FOUND, 300.0))

    def test_rates(self):
        bag = self.measured(*self.waves(1.5, 1.5, wobble=0.02))
        rows = self.rows(phases, bag)
        k = made.wave_number(self.INFO, 1, 0)
        self.assertAlmostEqual(rows['omega of LP(1,0)'].measured, 1.5 * k, 3)
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 3)
        self.assertAlmostEqual(rows['omega / k of LP(1,1)'].measured, 1.5, 3)
        self.assertAlmostEqual(rows['v, common'].measured, 1.5, 3)
        self.assertEqual(rows['omega in proportion to k'].verdict, 'agrees')
        self.assertLess(rows['chi^2 / freedom of omega = v k'].measured, 9)

    def test_errors_are_of_blocks_of_time(self):
        wave, = self.waves(1.5, wobble=0.02)
        row = self.rows(phases, self.measured(wave))['omega of LP(1,0)']
        turned = np.array([wave.turned(t) for t in self.TIMES])
        rates = np.array([piece.mean() for piece in np.array_split(np.diff(turned), blocks.BLOCKS)])
        self.assertAlmostEqual(row.error, rates.std(ddof=1) / 4, delta=0.1 * row.error)
        self.assertGreater(row.error, 0)
        velocity = self.rows(phases, Bag(self.path))['omega / k of LP(1,0)']
        self.assertAlmostEqual(velocity.error * made.wave_number(self.INFO, 1, 0), row.error, 12)

    def test_velocity_that_depends_on_k(self):
        rows = self.rows(phases, self.measured(*self.waves(1.5, 1.6, wobble=0.02)))
        row = rows['omega in proportion to k']
        self.assertEqual((row.measured, row.verdict), ('no', 'differs'))
        one, other = rows['omega / k of LP(1,0)'], rows['omega / k of LP(1,1)']
        # two values, one degree of freedom
        chi2 = (one.measured - other.measured) ** 2 / (one.error ** 2 + other.error ** 2)
        self.assertAlmostEqual(rows['chi^2 / freedom of omega = v k'].measured / chi2, 1, 6)
        common = rows['v, common']
        self.assertAlmostEqual(common.error, chi2 ** 0.5 * (one.error ** -2 + other.error ** -2) ** -0.5, 6)
        self.assertRegex(one.remark, r'^-\d+\.\d standard errors')

    def test_proportion_is_not_told_from_rates_known_poorly(self):
        """Two rates 2 % apart: with errors of 0.9 % they may be the same, with 1.1 % nothing is said; what differs by
        more than its error differs all the same."""
        for off, error, word in ((0.02, 0.009, 'yes'), (0.02, 0.011, None), (0.2, 0.011, 'no')):
            line = phases.Line([_Velocity(1.5, 1.5 * 0.005), _Velocity(1.5 * (1 + off), 1.5 * (1 + off) * error)])
            self.assertEqual(line.holds, word)
            self.assertIn(f'largest error is {100 * error:.2g} %', line.known_to)
        row = self.rows(phases, self.measured(*self.waves(1.5, 1.5, wobble=0.02)))['omega in proportion to k']
        self.assertIn('largest error is 0.', row.remark)

    def test_against_the_slope(self):
        slope = 4.624304      # c_L of the paper at density 0.8
        for v, word in ((1.02 * slope, 'near c_L'), (1.13 * slope, 'above c_L'), (0.9 * slope, 'below c_L')):
            info, steps = self.INFO, made.steps([made.step(self.INFO, LP, 1, 0, 32, 35, exponent=4.0)])
            row = phases.against_slope('v', v, 0.001, _Recording(info, steps))
            self.assertEqual((row.measured, row.published), (word, 'above c_L'))
            self.assertEqual(row.verdict, 'agrees' if word == 'above c_L' else 'differs')
            # one standard error of 3 %: what is within 12 % cannot be told
            row = phases.against_slope('v', v, 0.03 * slope, _Recording(info, steps))
            self.assertEqual(row.measured, word if word == 'above c_L' else None)
            self.assertIn(f'v / c_L = {v / slope:.3f} with the paper\'s', row.remark)
            self.assertIn(f'{v * made.wave_number(info, 1, 0) / 4.0:.3f} with our LP(1,0)', row.remark)

    def test_fluctuation(self):
        rows = self.rows(phases, self.measured(*self.waves(1.5, 1.5, wobble=0.2)))
        row = rows['phase fluctuation of LP(1,0), sin kx x']
        # of a sine over whole periods, in percent of a turn; the straight line takes a little of it
        self.assertAlmostEqual(row.measured, 100 * 0.2 / 2 ** 0.5 / (2 * np.pi), delta=0.1)
        self.assertIn('2.3 % over the 299 of the longest curve', row.remark)
        self.assertIn('phase fluctuation of LP(1,1), sin kx x sin ky y', rows)

    def test_error_of_a_fluctuation(self):
        """Of times that are independent, however many vectors there are: of fewer than two none is known."""
        squares = [1.0, 4.0, 2.0, 9.0, 2.5, 5.5]
        for independent, error in ((1.0, 0.0), (1.9, 0.0), (2.0, np.std(squares)), (5.0, np.std(squares) / 2)):
            rms, found = phases._root(squares, independent)
            self.assertAlmostEqual(rms, 2.0, 12)
            self.assertAlmostEqual(found, error / (2 * 2.0), 12)

    def test_untracked_is_left_out(self):
        wave, = self.waves(1.5)
        wave.weak = lambda t, vector, pair: (vector + pair + int(t / 30)) % 3 == 0
        rows = self.rows(phases, self.measured(wave))
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 6)
        wave.weak = lambda t, vector, pair: 100 < t < 120
        rows = self.rows(phases, self.measured(wave))
        self.assertAlmostEqual(rows['omega / k of LP(1,0)'].measured, 1.5, 6)
        row = rows['phase fluctuation of LP(1,0), cos kx x']
        self.assertLess(row.measured, 1e-6)
        self.assertIn('over the 180 of the longest curve', row.remark)

    def test_figure_and_table(self):
        bag = self.measured(*self.waves(1.5, 1.6))
        figure = self.figures(phases, bag)['phases']
        self.assertDrawn(figure)
        self.assertTrue(figure.axes[0].get_legend().get_texts()[0].get_text().startswith('LP(1,0): $v = 1.5'))
        header, lines = self.tables(phases, bag)['phases']
        self.assertEqual(len(header), len(lines[0]))
        name, index, bits, time, phase = lines[1]
        self.assertEqual((name, bits, time), ('LP(1,0)', 'cos cos', '3'))   # every other of 300
        self.assertAlmostEqual(float(phase), 1.5 * made.wave_number(self.INFO, 1, 0) * 3, 3)

    def test_nothing_measured(self):
        bag = self.bag(self.INFO, made.cost(1))
        rows = self.rows(phases, bag)
        self.assertEqual({row.verdict for row in rows.values()}, {'not measured'})
        self.assertIn('v, common', rows)
        self.assertEqual(self.figures(phases, bag), {})
        self.assertEqual(self.tables(phases, bag)['phases'][1], [])


class _Velocity:
    def __init__(self, *known):
        self.velocity = lambda: known


class _Recording:
    def __init__(self, info, steps):
        self.info, self.steps = info, steps


# ---- travelling --------------------------------------------------------------------------------------------------

class Travelling(Made):
    INFO = made.run_info(density=0.8)
    K = made.wave_number(INFO, 1, 0)
    OMEGA = 5.2 * K
    TIMES = np.arange(0.1, 40, 0.1)
    RIGHT, LEFT, STANDING = (1.0, -1.0j), (1.0, 1.0j), (1.0, 1.0)

    def measured(self, *amplitudes, weak=None, omega=OMEGA):
        wave = Wave(1, 0, (0, 1), np.array(amplitudes) / 2 ** 0.5, omega)
        wave.weak = weak or wave.weak
        return self.bag(self.INFO, *course(self.TIMES, wave),
                        made.steps([made.step(self.INFO, LP, 1, 0, 32, 35, exponent=4.6 * self.K)]))

    def test_velocity(self):
        bag = self.measured(self.STANDING, self.RIGHT)
        rows = self.rows(travelling, bag)
        ratio = rows['front velocity / (omega / k), same times']
        self.assertAlmostEqual(ratio.measured, 1.0, 6)
        self.assertEqual((ratio.published, ratio.verdict), (None, ''))
        self.assertIn('locked within a quarter turn', ratio.remark)
        self.assertIn('39.8 time units, towards +x, handedness +1.00', ratio.remark)
        self.assertAlmostEqual(rows['front velocity, mean slope'].measured, 5.2, 6)
        self.assertAlmostEqual(rows['omega / k of LP(1,0), same run'].measured, 5.2, 6)
        row = rows['front velocity against c_L']
        self.assertEqual((row.measured, row.verdict), ('above c_L', 'agrees'))
        self.assertLess(rows['unevenness of the front, rms'].measured, 1e-6)

    def test_towards_minus_x(self):
        rows = self.rows(travelling, self.measured(self.STANDING, self.LEFT))
        self.assertAlmostEqual(rows['front velocity / (omega / k), same times'].measured, 1.0, 6)
        self.assertIn('towards -x, mirrored, handedness -1.00', rows['front velocity, mean slope'].remark)
        self.assertAlmostEqual(rows['front velocity, mean slope'].measured, 5.2, 6)
        # the same field if everything turns backwards
        rows = self.rows(travelling, self.measured(self.RIGHT, omega=-self.OMEGA))
        self.assertIn('towards -x', rows['front velocity, mean slope'].remark)
        self.assertAlmostEqual(rows['front velocity / (omega / k), same times'].measured, 1.0, 6)

    def test_uneven_wave_has_steps_and_the_same_mean(self):
        rows = self.rows(travelling, self.measured((1.0, -0.5j)))
        # theta of an ellipse is never further than a quarter turn from the phase
        self.assertAlmostEqual(rows['front velocity, mean slope'].measured, 5.2,
                               delta=2 * rotation.QUARTER / self.K / 39.8)
        self.assertIn(f'handedness {2 * 0.5 / 1.25:+.2f}', rows['front velocity, mean slope'].remark)
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
        row = self.rows(travelling, self.bag(self.INFO, *messages))['front velocity / (omega / k), same times']
        self.assertAlmostEqual(row.measured, 1.0, 6)
        self.assertIn('24.8 time units, towards +x', row.remark)

    def test_handedness(self):
        for amplitudes, size in (((self.RIGHT, self.LEFT), 1.0), ((self.STANDING, self.RIGHT), 0.5),
                                 (((1.0, -0.5j), (0.5j, 1.0)), 0.8)):
            row = self.rows(travelling, self.measured(*amplitudes))['handedness of LP(1,0), mean size']
            self.assertAlmostEqual(row.measured, size, 9)

    def test_vector_tracked_throughout_is_chosen(self):
        bag = self.measured(self.RIGHT, (1.0, -0.6j),
                            weak=lambda t, vector, pair: (vector, pair) == (0, 1) and 10 < t < 12)
        rows = self.rows(travelling, bag)
        self.assertIn(f'handedness {1.2 / 1.36:+.2f}', rows['front velocity, mean slope'].remark)
        header, lines = self.tables(travelling, bag)['stretches']
        self.assertEqual(len(header), len(lines[0]))
        # index, from when and how long both pairs of each have been tracked without a break
        self.assertEqual([line[:3] for line in lines], [(33, '0.1', '39.8'), (32, '12', '27.9'), (32, '0.1', '9.9')])
        self.assertEqual(lines[1][3:5], ('1.000', '5.2'))

    def test_front_is_where_the_field_vanishes(self):
        bag = self.measured((0.8, 0.6 * np.exp(-1.2j)))
        front = travelling.chosen(rotation.read(bag)[1, 0])
        x = front.sign * front.place
        derivatives = -np.sin(self.K * x), np.cos(self.K * x)     # of cos k x and sin k x, over k
        np.testing.assert_allclose(sum(a * d for a, d in zip(front.l_part, derivatives)), 0, atol=1e-9)

    def test_figure(self):
        bag = self.measured((0.8, 0.6 * np.exp(-1.2j)))
        figure = self.figures(travelling, bag)['wave']
        self.assertDrawn(figure)
        time, cos, sin, _ = map(float, self.tables(travelling, bag)['front'][1][7])
        shown = figure.axes[0].collections[0].get_array().reshape(travelling.PLACES + 1, -1)
        place = 0.3 * self.INFO.box_x
        self.assertAlmostEqual(shown[60, 7], -cos * np.sin(self.K * place) + sin * np.cos(self.K * place), 3)
        z = np.array([0.8, 0.6 * np.exp(-1.2j)]) / 2 ** 0.5 * np.exp(1j * self.OMEGA * time)
        np.testing.assert_allclose([cos, sin], z.real, atol=6e-5)

    def test_nothing_measured(self):
        bag = self.bag(self.INFO, made.cost(1))
        self.assertEqual({row.verdict for row in travelling.rows({travelling.RUN: bag})}, {'not measured'})
        self.assertEqual(self.figures(travelling, bag), {})
        self.assertEqual(self.tables(travelling, bag)['front'][1], [])


if __name__ == '__main__':
    unittest.main()
