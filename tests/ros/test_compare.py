"""compare against bags that are made here: what it finds, what it says, what it refuses."""

import unittest
from math import atan, cos, nan, pi, sin, sqrt
from unittest import mock

import numpy as np
import rospy

import hdlyap
import made
import trials
from bags import Bags, process, tool
from made import LP, T
from hdlyap.data.reader import RecordingError
from hdlyap.plots import verdict
from hdlyap.plots.comparison import Comparison
from hdlyap.plots.deviation import Deviation, unlikeliest

INFO = made.run_info()
ERROR = 0.01  # of the exponents
EXPONENTS = np.linspace(9, 3, 37)
# z is (b - a) / error of numbers up to 10, rounded, over errors of 0.01
Z_TOLERANCE = 10 * np.finfo(float).eps * 10 / ERROR
# the angles' integral: 64 nodes are exact to rounding for powers of a cosine up to 127
TAIL_TOLERANCE = 64 * np.finfo(float).eps


def shifted(z):
    """Exponents of a second run that deviate by z combined errors."""
    return EXPONENTS + sqrt(2) * ERROR * np.asarray(z)


def noise(seed=5):
    return np.random.default_rng(seed).normal(size=EXPONENTS.size)


def found(**fields):
    return [
        made.step(INFO, T, 1, 0, 36, 37, **fields),
        made.step(INFO, LP, 1, 0, 32, 35),
        made.unresolved(INFO, T, 1, 1, 4),
        made.zero_modes(),
    ]


def run(exponents=EXPONENTS, made_steps=None, error=ERROR, **fields):
    """Messages of a run: averages of half its time and of all of it."""
    info = made.run_info(**fields)
    of_run = {'run_id': info.run_id}
    return [
        info,
        made.spectrum(np.zeros_like(exponents), 25.0, error=error, **of_run),
        made.spectrum(exponents, 50.0, error=error, **of_run),
        made.steps(found() if made_steps is None else made_steps, **of_run),
    ]


# messages as no node sends them, but as they may be after others have changed them
unchecked = mock.patch('hdlyap.data.reader.check', lambda *_: None)


class Pairs(Bags):
    def bags(self, a, b):
        return self.write(a, 'a'), self.write(b, 'b')

    def compared(self, a, b):
        return Comparison(*(hdlyap.load(bag).summary for bag in self.bags(a, b)))

    def compare(self, a, b, status=0, how=tool):
        """What it prints."""
        return self.succeeds('compare', *self.bags(a, b), status=status, how=how)

    def cannot_compare(self, reason, a, b):
        with self.assertRaisesRegex(RecordingError, reason):
            verdict.verdict(self.compared(a, b))


class Identical(Pairs):
    def test_but_for_stamps_and_run_id(self):
        one, other = run(), run(run_id='two')
        for message in other:
            message.header.stamp = rospy.Time(7)
        one[0].packing_fraction = other[0].packing_fraction = nan  # known of neither
        text = self.compare(one, other, how=process)
        self.assertIn('\nidentical: ', text)
        self.assertIn('the same seed', text)
        self.assertNotRegex(text, 'parameters that differ|largest deviations')
        unknown = run(error=-1.0)
        self.assertIn('identical', verdict.verdict(self.compared(unknown, unknown))[0])

    def test_one_bit_is_seen(self):
        others = [run() for _ in range(3)]
        nearly = EXPONENTS.copy()
        nearly[20] = np.nextafter(nearly[20], 0)
        others[0][2].exponents = others[1][2].local_exponents = nearly
        others[2][-1].steps[0].multiplicity = np.nextafter(1.98, 2)
        for other in others:
            comparison = self.compared(run(), other)
            self.assertFalse(comparison.is_identical)
            self.assertEqual(verdict.verdict(comparison)[1], verdict.AGREE)


class Agreeing(Pairs):
    def test_each_z_is_the_one_that_was_made(self):
        z = noise()
        comparison = self.compared(run(), run(shifted(z), run_id='two', seed='2'))
        for one, expected in zip(comparison.exponents, z):
            self.assertLess(abs(one.z - expected), Z_TOLERANCE, one.name)
        largest = unlikeliest(comparison.deviations)[0]
        self.assertEqual(largest, comparison.exponents[int(np.argmax(abs(z)))])
        names = [one.name for one in comparison.numbers]
        self.assertEqual(names, ['lambda_max', 'h_KS', 'c_T', 'c_L', 'v'])
        self.assertEqual([one.name for one in comparison.steps], ['T(1,0)', 'LP(1,0)'])
        self.assertIsNone(comparison.spectra)  # there are two samples of each
        self.assertEqual(verdict.verdict(comparison)[1], verdict.AGREE)

    def test_what_is_printed(self):
        z = noise()
        other = run(shifted(z), run_id='two', seed='2', observables=['steps', 'state'])
        text = self.compare(run(), other)
        for said in (
            r'both  N = 20, density 0\.5, packing 0\.3927, box 6\.325 x 6\.325, x periodic, y',
            r'\n  seed +1 +2\n',
            r'\n  observables +"" +steps state\n',
            fr'\n  lambda_max +9\.000\(10\) .* {z[0]:+.2f}',
            r'\n  T\(1,0\) .* \+0\.00  36-37: 1\.98 and 1\.98 of 2\n',
            r'\n  c_T +1\.4000\(40\) .* over 3 wave numbers 0\.9935 \.\. 1\.987 .*\n',
            fr'of b - a in errors {np.mean(z * z):.2f}; .*: chi\^2 needs 8 samples',
            'exponents: 37 of 37 compared, 0 of unknown error, 0 zero',
            r'\nagree: lambda_max is \d\.\d\d errors apart, the farthest of 5 numbers; chance '
            r'alone makes two runs as unlike in 100 % of comparisons; runs differ below 1.5 %\n',
        ):
            self.assertRegex(text, said)
        self.assertNotIn('the same seed', text)

    def test_sum_has_its_own_error(self):
        (one,) = self.compared(run(), run(shifted(np.ones(37)))).sums
        self.assertEqual(one.name, 'h_KS')
        self.assertEqual(list(one.errors), [ERROR * 37] * 2)
        self.assertLess(abs(one.z - 1.0), Z_TOLERANCE * 37)

    def test_each_error_stands_beside_its_value(self):
        text = self.compare(run(error=0.02), run(shifted(np.ones(37))))
        self.assertRegex(text, r'lambda_max +9\.000\(20\) +9\.014\(10\) +0\.014\(22\) +\+0\.63')

    def test_a_part_of_the_spectrum(self):
        part = run(EXPONENTS[:5], made_steps=[])
        names = [one.name for one in self.compared(part, part).sums]
        self.assertEqual(names, ['sum of exponents'])
        comparison = self.compared(run([3.0], made_steps=[]), run([3.02], made_steps=[]))
        names = [one.name for one in comparison.exponents]
        self.assertEqual((names, comparison.sums), (['lambda_max'], []))


class Differing(Pairs):
    def test_the_largest_exponent(self):
        z = np.zeros(37)
        z[0] = -10.0
        text = self.compare(run(), run(shifted(z), seed='2'), status=1)
        self.assertIn(
            '\ndiffer: lambda_max is 10.00 errors apart, the farthest of 5 numbers; chance', text
        )
        after_head = text[text.index('largest deviations') :].splitlines()[2]
        self.assertRegex(after_head, r'  lambda_max +.* -10\.00  \d\.\de-0\d')

    def test_two_in_a_hundred(self):
        """Of two steps, as Student's t with 14 degrees of freedom: each 0.005, of 3.33."""
        for off, status in ((3.25, verdict.AGREE), (3.4, verdict.DIFFER)):
            far = made.exponent(INFO, T, 1, 0) + off * sqrt(2) * made.ERROR
            comparison = self.compared(run(), run(made_steps=found(exponent=far), seed='2'))
            self.assertEqual(verdict.verdict(comparison)[1], status)

    def test_one_step_or_fit(self):
        far = made.exponent(INFO, T, 1, 0) + 10 * sqrt(2) * made.ERROR
        faster = run()
        faster[-1].v += 10 * sqrt(2) * faster[-1].v_error
        for name, other in (('T(1,0)', run(made_steps=found(exponent=far))), ('v', faster)):
            comparison = self.compared(run(), other)
            self.assertEqual(unlikeliest(comparison.deviations)[0].name, name)
            self.assertEqual(verdict.verdict(comparison)[1], verdict.DIFFER)

    @unchecked
    def test_what_is_no_number(self):
        """Agrees with nothing, itself not either, whatever its error, also where nothing else would
        be judged."""
        eighth, half = EXPONENTS.copy(), list(EXPONENTS)
        eighth[7] = np.nan
        zeros, no_zeros = ([*half, *[zero] * 6, *-EXPONENTS[::-1]] for zero in (0.0, np.nan))
        nothing = EXPONENTS * np.nan
        for a, b, error, name in (
            (EXPONENTS, eighth, ERROR, 'lambda_8'),
            (EXPONENTS, eighth, np.inf, 'lambda_8'),
            (EXPONENTS, eighth, -1.0, 'lambda_8'),
            (eighth, eighth, ERROR, 'lambda_8'),
            (EXPONENTS, nothing, np.inf, r'lambda_max .* \.\.\.'),
            (EXPONENTS, EXPONENTS * np.inf, ERROR, r'lambda_max .* \.\.\.'),
            (zeros, no_zeros, ERROR, 'lambda_38 .*'),
        ):
            comparison = self.compared(*(run(one, made_steps=[], error=error) for one in (a, b)))
            text, status = verdict.verdict(comparison)
            self.assertEqual(status, verdict.DIFFER)
            self.assertRegex(text, f'^differ: no number in a or b: {name}$')
            verdict.report(comparison)
        one = self.compared(run(), run(eighth)).exponents[7]
        self.assertEqual((one.z, one.chance), (np.inf, 0.0))
        text = self.compare(run(), run(nothing, error=np.inf), status=1)
        self.assertIn('\ndiffer: no number in a or b: lambda_max ', text)

    def test_errors_whose_squares_are_no_numbers(self):
        for error in (1e-200, 1e200):
            off, on = (Deviation('', (0.0, z * error), (error, error)) for z in (10.0, 0.1))
            self.assertLess(off.chance, 1e-4)
            self.assertGreater(on.chance, 0.9)

    def test_without_any_error(self):
        self.assertEqual(Deviation('', (1.0, 1.0), (0.0, 0.0)).z, 0.0)
        off = Deviation('', (1.0, 2.0), (0.0, 0.0))
        self.assertEqual((off.z, off.chance), (np.inf, 0.0))


class Steps(Pairs):
    def names(self, comparison, judged=True):
        return [one.name for one in comparison.steps + comparison.fits if one.judged == judged]

    def test_are_found_by_their_waves(self):
        comparison = self.compared(run(), run(made_steps=found()[::-1]))
        names = ['T(1,0)', 'LP(1,0)', 'c_T', 'c_T2', 'c_T3', 'c_L', 'c_L2', 'c_L3', 'v']
        self.assertEqual(self.names(comparison), names)
        self.assertEqual({one.z for one in comparison.steps}, {0.0})

    def test_assumed_coefficients_are_not_compared(self):
        pair = run(), run()
        for messages in pair:
            messages[-1].t_prior_share = 1.0
        comparison = self.compared(*pair)
        names = ['T(1,0)', 'LP(1,0)', 'c_T', 'c_L', 'c_L2', 'c_L3', 'v']
        self.assertEqual(self.names(comparison), names)

    def test_of_one_run_alone(self):
        other = run(made_steps=[found()[1], made.step(INFO, T, 2, 0, 36, 37)])
        comparison = self.compared(run(), other)
        self.assertEqual(comparison.found_once, (['T(1,0)'], ['T(2,0)']))
        # the T curve is through other points
        self.assertEqual(self.names(comparison), ['LP(1,0)', 'c_L', 'c_L2', 'c_L3', 'v'])
        said = '\n  resolved in a alone: T(1,0)\n  resolved in b alone: T(2,0)\n  c_T is not'
        self.assertIn(said, verdict.report(comparison))

    def test_zero_modes_are_not_judged(self):
        pair = []
        for value in (0.0, -1.0):
            zero = made.zero_modes(38)
            zero.exponent = value or zero.exponent
            half = EXPONENTS if value else shifted(np.ones(37))
            whole = [*half, *[value] * 6, *-EXPONENTS[::-1]]
            pair.append(run(whole, made_steps=[zero]))
        comparison = self.compared(*pair)
        said = 'exponents: 74 of 80 compared, 0 of unknown error, 6 zero'
        self.assertIn(said + '\n  mean square of b - a in errors 0.50;', verdict.report(comparison))
        names = [one.name for one in comparison.exponents if not one.judged]
        self.assertEqual(names, [f'lambda_{index}' for index in range(38, 44)])
        self.assertEqual(verdict.verdict(comparison)[1], verdict.AGREE)

    def test_conjugate_steps_have_a_name_of_their_own(self):
        mirrored = made.step(INFO, T, 1, 0, 44, 45, conjugate=True, exponent=-2.0)
        pair = run(made_steps=[found()[0], mirrored])
        names = sorted(one.name for one in self.compared(pair, pair).steps)
        self.assertEqual(names, ['T(1,0)', 'T(1,0)*'])
        text = verdict.report(self.compared(pair, pair))
        self.assertIn('  T(1,0)  ', text)
        self.assertNotIn('T(1,0)*', text)  # the opposite of the one above

    def test_without_steps(self):
        comparison = self.compared(run(), run()[:-1])
        self.assertEqual((comparison.steps, comparison.fits), ([], []))
        self.assertIn('\nno steps in b\n', verdict.report(comparison))
        self.assertTrue(comparison.is_identical)


class Fits(Pairs):
    """Only those of one form over the same wave numbers are compared."""

    def check_apart(self, symbol, reason, a, b):
        """One line says why; what remains does not differ."""
        comparison = self.compared(a, b)
        self.assertEqual([one.symbol for one, _ in comparison.unlike], [symbol])
        self.assertFalse([one for one in comparison.fits if one.name.startswith(symbol)])
        self.assertEqual(len(comparison.fits) + (1 if symbol == 'v' else 3), 7)
        text = verdict.report(comparison)
        self.assertRegex(text, rf'\n  {symbol} is not compared: {reason}(\n|$)')
        self.assertEqual(verdict.verdict(comparison)[1], verdict.AGREE)

    @unchecked
    def test_of_another_form(self):
        """26 errors apart, which means nothing."""
        other = run()
        line = other[-1]
        line.l_points, line.l_prior_share, line.l_k_max = 1, np.nan, line.l_k_min
        line.c_l, line.c_l2, line.c_l3 = 5.01, np.nan, np.nan
        self.check_apart(
            'c_L',
            r'a 1\.500\(20\), c k \+ c2 k\^2 \+ c3 k\^3 over 2 wave numbers 0\.9935 \.\. 1\.405.*; '
            r'b 5\.010\(20\), c k over 1 wave number 0\.9935',
            run(),
            other,
        )

    def test_errors_of_sampling(self):
        """What the form leaves open is the same in both."""
        other = run()
        other[-1].c_t += 0.012
        found = {one.name: one for one in self.compared(run(), other).fits}
        self.assertAlmostEqual(found['c_T'].z, 0.012 / np.hypot(0.004, 0.004), 9)

    def test_of_another_range(self):
        for field in ('t_k_min', 't_k_max', 'v_k_min', 'v_k_max'):
            other = run()
            setattr(other[-1], field, 1.2)
            other[-1].c_t, other[-1].v = (2.0, 1.612) if field.startswith('t') else (1.4, 2.0)
            self.check_apart('c_T' if field.startswith('t') else 'v', '.* 1.2.*', run(), other)

    def test_of_another_wave_between(self):
        """As many of the same range."""
        others = [
            [made.step(INFO, T, n, 0, 38 - 2 * n, 39 - 2 * n) for n in numbers]
            for numbers in ((1, 2, 4), (1, 3, 4))
        ]
        self.check_apart('c_T', '.*', *(run(made_steps=steps) for steps in others))

    def test_one_wave_number_of_a_square_box(self):
        """Through T(1,0) in one run, through T(0,1) in the other."""
        pair = [run(made_steps=[made.step(INFO, T, *n, 36, 37)]) for n in ((1, 0), (0, 1))]
        comparison = self.compared(*pair)
        self.assertEqual(comparison.unlike, [])
        self.assertEqual(len(comparison.fits), 7)


class UnknownErrors(Pairs):
    def test_of_some(self):
        one = run(shifted(noise()), error=1.0)
        for index in (0, 5):
            one[2].std_errors[index] = -1.0
        one[2].ks_entropy_error = -1.0
        comparison = self.compared(run(), one)
        text = verdict.report(comparison)
        self.assertIn('exponents: 35 of 37 compared, 2 of unknown error', text)
        self.assertRegex(text, r'\n  lambda_max .* +-\n')
        self.assertRegex(text, r'\n  h_KS .* +-\n')
        self.assertEqual([one.is_known for one in comparison.numbers], [False] * 2 + [True] * 3)

    def test_of_all(self):
        other = run(shifted(noise()), error=-1.0, made_steps=[])
        other[-1].t_points = other[-1].l_points = other[-1].v_phases = 0
        self.cannot_compare('no quantity has a known error in both', run(), other)
        other[1].std_errors = other[2].std_errors = [np.inf] * EXPONENTS.size
        self.cannot_compare('std_errors = inf: must be from', run(), other)
        unchecked(self.cannot_compare)('no quantity has a known error in both', run(), other)


class Refusals(Pairs):
    def test_other_systems(self):
        for name, value in (
            ('number', 40),
            ('density', 0.51),
            ('aspect', 0.9),
            ('boundary_x', 'reflecting'),
            ('boundary_y', 'reflecting'),
        ):
            said = f'{name} .* and {value}; hdlyap table shows runs of several systems'
            self.cannot_compare(said, run(), run(**{name: value}))
        pair = run(boundary_z=''), run(boundary_z='periodic', number=40)
        self.cannot_compare('compared: number 20 and 40; hdlyap table', *pair)
        pair = run(boundary_z=''), run(boundary_z='periodic')
        self.cannot_compare('compared: boundary_z  and periodic; hdlyap table', *pair)
        said = 'number 20 and 40, density 0.5 and 0.6'
        said = 'hdlyap compare: the runs are of different systems and are not compared: ' + said
        self.refuses(said, 'compare', *self.bags(run(), run(density=0.6, number=40)), status=2)

    def test_steps_of_another_length(self):
        """Are the same system: that is how one sees what they cost."""
        soft = [
            run(own=[f'potential={potential}', f'time_step={step}'])
            for potential, step in (('wca', 0.01), ('wca', 0.005), ('power', 0.01))
        ]
        text = self.compare(*soft[:2])
        self.assertRegex(text, r'(?m)^parameters that differ\n  time_step +0\.01 +0\.005$')
        self.assertNotIn('time step', text)  # of both
        self.cannot_compare('potential wca and power', *soft[1:])

    def test_what_does_not_collide(self):
        """Has a temperature that is compared, and a potential energy."""
        warm = [
            [*run(shifted(noise(seed)), seed=str(seed)), made.soft_gas(temperature=value)]
            for seed, value in ((1, 0.6), (2, 0.7))
        ]
        text = self.compare(*warm, status=1)
        self.assertRegex(text, r'temperature +0\.600\(10\) +0\.700\(10\) ')
        self.assertRegex(text, r'pressure +1\.250\(10\) +1\.250\(10\) ')
        self.assertRegex(text, r'potential energy +0\.500\(10\) +0\.500\(10\) ')
        self.assertNotRegex(text, 'collision|nan')

    def test_what_is_not_there(self):
        bare = [INFO, made.cost(1)]
        self.cannot_compare('exponents 1-37 and 1-36', run(), run(EXPONENTS[:-1]))
        self.cannot_compare('no averaged spectrum in the second bag', run(), bare)
        self.cannot_compare('no averaged spectrum in the first bag', bare[:1], run())

    def test_one_of_several_nodes(self):
        paths = self.bags(run(), run())
        for name in 'ab':
            self.write(run(EXPONENTS + 1), name, node='/other', mode='a')
        text = self.succeeds('compare', *paths, '--node', 'other')
        self.assertRegex(text, r'lambda_max +10\.000\(10\)')

    def test_short(self):
        """Is said. The slowest takes 4 time units: 100 of them are 25 of those."""
        for length, said in (
            (121.0, None),
            (100.0, 'b is short: averaged over 25 times 1 / its smallest positive'),
        ):
            pair = [
                [INFO, made.spectrum([value, *[0.25] * 36, *[1e-9] * 6], time)]
                for value, time in ((3.0, 121.0), (3.001, length))
            ]
            text = verdict.verdict(self.compared(*pair))[0]
            self.assertIn(said or 'agree', text)
            self.assertNotIn('a is short', text)
            self.assertEqual('is short' in text, said is not None)
            self.assertTrue(text.splitlines()[-1].startswith('agree'))


class Chance(unittest.TestCase):
    def test_tails_of_student(self):
        """Abramowitz and Stegun, 26.7.3 and 26.7.4; errors of different sizes have the freedom of
        the larger one, equal ones that of both."""
        for z in (0.0, 0.3, 1.0, -2.5, 6.0):
            angle = atan(abs(z) / sqrt(7))
            c = cos(angle)
            odd = 1 - 2 / pi * (angle + sin(angle) * (c + 2 / 3 * c**3 + 8 / 15 * c**5))
            one = Deviation('', (0.0, z), (1.0, 1e-9))
            self.assertLess(abs(one.chance - odd), TAIL_TOLERANCE)
            squared = 14 / (14 + z * z)  # cosine of the angle for 14
            terms = np.cumprod([1.0] + [squared * (2 * i - 1) / (2 * i) for i in range(1, 7)])
            both = Deviation('', (0.0, z * sqrt(2)), (1.0, 1.0))
            even = 1 - sqrt(1 - squared) * terms.sum()
            self.assertLess(abs(both.chance - even), TAIL_TOLERANCE)
        self.assertEqual(Deviation('', (0.0, np.inf), (1.0, 1.0)).chance, 0.0)


class Power(unittest.TestCase):
    """Of made-up runs with known fluctuations, see trials.py; all from fixed seeds."""

    def test_what_is_there_is_seen_and_what_is_not_is_not(self):
        for exponents, blocks, seeds in ((20, 30, 1), (197, 30, 1), (20, 10, 3)):
            found = {
                name: trials.share(exponents, blocks, seeds, planted, 100)
                for name, planted in trials.PLANTED.items()
            }
            with self.subTest(exponents=exponents, blocks=blocks, seeds=seeds, found=found):
                self.assertLessEqual(found['nothing'], 0.04)  # of 2 in 100 expected
                self.assertGreaterEqual(found['all by 3 errors'], 0.95)
                self.assertGreaterEqual(found['a step by 5 errors'], 0.9)  # of 95 or more

    def test_the_whole_spectrum_decides(self):
        """Where neither a number nor a step does: neighbours all apart, up and down by turns."""
        world = trials.World(197)
        a, b = ([world.run(60)] for _ in 'ab')
        one, other = world.said(a), world.said(b)
        shift = 2.5 * np.hypot(one.spectrum.std_errors, other.spectrum.std_errors)
        shift *= np.sign(np.sin(np.arange(197) / 197 * 8 * pi))
        shift[[0, *range(160, 197)]] = 0
        text, status = verdict.verdict(Comparison(one, world.said(b, shift)))
        self.assertEqual(status, verdict.DIFFER)
        self.assertRegex(text, 'differ: the spectra are apart by chi.2 = .* in 16 groups')

    def test_opposite_exponents_tell_nothing_more(self):
        """They are those of the positive half, up to rounding."""
        world = trials.World(60)
        halves = [world.run(40) for _ in 'ab']
        rounding = 1e-15 * world.random.normal(size=halves[0].shape)
        wholes = [np.concatenate([one, rounding - one[:, ::-1]], axis=1) for one in halves]
        of_half, of_all = (
            Comparison(*(world.said([one]) for one in some)) for some in (halves, wholes)
        )
        for one, other in zip(of_half.spectra, of_all.spectra):
            self.assertAlmostEqual(one, other, delta=1e-9 * one)
        self.assertAlmostEqual(of_half.sums[0].error, of_all.sums[0].error, 12)

    def test_a_few_exponents(self):
        world = trials.World(60)
        world.steps = []
        pair = [world.said([world.run(40)[:, :10]]) for _ in 'ab']
        numbers = Comparison(*pair).numbers
        self.assertEqual([0 < one.chance < 1 for one in numbers], [True, True])

    def test_blocks_that_remember_each_other(self):
        """Stated errors are larger then, and the fluctuations grow to them."""
        world = trials.World(20)
        samples = [[local_] for local_ in (world.run(30), world.run(30))]
        for factor in (0.5, 2.0):
            pair = [world.said(one) for one in samples]
            errors = np.hypot(*(run.spectrum.std_errors for run in pair))
            for run_ in pair:
                run_.spectrum.std_errors = [factor * error for error in run_.spectrum.std_errors]
            largest = Comparison(*pair).exponents[0]
            self.assertAlmostEqual(largest.error / errors[0], max(1.0, factor), delta=0.1)
