"""The smallest steps of runs, the fits through them, stairs of exponents and crossings."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

from hdlyap.msg import LpPhase, LpPhases

import made
import recorded
from made import LP, T
from hdlyap.plots import dispersion, paper
import reproduced  # noqa: F401, finds the study
from study import crossing, slopes, stairs


class Points(unittest.TestCase):
    def setUp(self):
        self.info = recorded.info(400, 0.4, 0.5)

    def recorded(self, *steps, **more):
        return recorded.Recorded(self.info, made.steps(list(steps)), **more)

    def test_a_step_by_its_nodes(self):
        run = self.recorded(
            made.step(self.info, T, 1, 0, 796, 797),
            made.step(self.info, LP, 1, 0, 792, 795),
            made.step(self.info, LP, 0, 1, 788, 791),
        )
        point = slopes.find(run, LP, 1, 0)
        k = 2 * np.pi / self.info.box_x
        self.assertAlmostEqual(point.wave_number, k, places=12)
        self.assertAlmostEqual(point.slope, 1.5 + 0.5 * k, places=12)
        self.assertAlmostEqual(point.slope_error, made.ERROR / k, places=12)
        self.assertEqual((point.name, point.members, point.remark), ('LP(1,0)', 4, ''))
        self.assertIsNone(slopes.find(run, T, 0, 1))

    def test_without_steps(self):
        run = recorded.Recorded(self.info)
        self.assertIsNone(slopes.find(run, T, 1, 0))
        self.assertIsNone(slopes.smallest(run, T))
        self.assertIsNone(slopes.by_index(run, T, 1, 0))
        self.assertEqual(slopes.velocity(run, 1, 0)[2], 0)

    def test_unresolved_and_conjugate_steps_are_none(self):
        run = self.recorded(
            made.unresolved(self.info, T, 1, 0, 2),
            made.step(self.info, LP, 1, 0, 804, 807, conjugate=True),
        )
        self.assertIsNone(slopes.smallest(run, T))
        self.assertIsNone(slopes.smallest(run, LP))

    def test_smallest_is_of_its_kind(self):
        run = self.recorded(
            made.step(self.info, LP, 0, 1, 788, 791),
            made.step(self.info, LP, 1, 0, 792, 795),
            made.step(self.info, T, 0, 1, 796, 797),
        )
        self.assertEqual(slopes.smallest(run, LP).name, 'LP(1,0)')
        self.assertEqual(slopes.smallest(run, T).name, 'T(0,1)')

    def test_a_square_box_has_both_directions(self):
        self.info = recorded.info(400, 0.4, 1.0)
        shared = dict(set=3, members=2)
        run = self.recorded(
            made.step(
                self.info,
                LP,
                1,
                0,
                790,
                797,
                exponent=0.3,
                std_error=0.001,
                multiplicity=3.0,
                **shared,
            ),
            made.step(
                self.info,
                LP,
                0,
                1,
                790,
                797,
                exponent=0.4,
                std_error=0.002,
                multiplicity=1.0,
                **shared,
            ),
        )
        point = slopes.smallest(run, LP)
        self.assertEqual((point.name, point.members, point.remark), ('LP(1,0)+LP(0,1)', 8, ''))
        self.assertAlmostEqual(point.exponent, 0.325)
        self.assertAlmostEqual(point.error, 0.002)
        self.assertEqual(slopes.find(run, LP, 1, 0).remark, '')  # of one wave number: no mixture

    def test_smallest_says_what_is_smaller_and_not_resolved(self):
        run = self.recorded(
            made.unresolved(self.info, LP, 1, 0, 4),
            made.unresolved(self.info, T, 1, 0, 2),
            made.unresolved(self.info, T, 1, 1, 4),
            made.step(self.info, T, 0, 1, 796, 797),
            made.step(self.info, LP, 0, 1, 788, 791),
        )
        self.assertEqual(slopes.smallest(run, T).remark, 'T(1,0) not resolved')
        self.assertEqual(slopes.find(run, T, 0, 1).remark, '')
        # one that the boundaries do not have is not missed
        run = self.recorded(
            made.unresolved(self.info, T, 1, 0, 0), made.step(self.info, T, 0, 1, 796, 797)
        )
        self.assertEqual(slopes.smallest(run, T).remark, '')

    def test_noted(self):
        plain = slopes.Point('T(1,0)', 0.1, 0.2, 0.001, 2)
        shared = slopes.Point('T(1,0)', 0.1, 0.2, 0.001, 2, 'so', shares=['LP(0,1)'])
        beyond = slopes.Point('T(0,1)', 0.1, 0.2, 0.001, 2, shares=['LP(0,1)'], skipped=['T(1,0)'])
        self.assertEqual(slopes.noted([plain, None]), '')
        self.assertEqual(slopes.noted([plain, shared]), '1 of them share vectors')
        self.assertEqual(
            slopes.noted([plain, shared, beyond]),
            '2 of them share vectors; 1 of them beyond a smaller step that is not resolved',
        )
        self.assertEqual(shared.remark, 'so; shares its vectors with LP(0,1)')

    def test_unknown_error(self):
        run = self.recorded(made.step(self.info, T, 1, 0, 796, 797, std_error=-1.0))
        self.assertEqual(slopes.find(run, T, 1, 0).slope_error, -1.0)

    def test_velocity(self):
        found = [
            made.step(self.info, T, 1, 0, 796, 797),
            made.step(self.info, LP, 1, 0, 792, 795),
            made.step(self.info, LP, 0, 1, 788, 791),
        ]
        phases = made.lp_phases(self.info, found, 50.0)
        found[2].omega *= 2  # another step has another one
        v, error, count = slopes.velocity(self.recorded(*found, phases=phases), 1, 0)
        self.assertAlmostEqual(v, made.VELOCITY, places=12)
        self.assertAlmostEqual(error, 0.01 * made.VELOCITY, places=12)  # not divided by sqrt(8)
        self.assertEqual(count, 8)
        lost = LpPhases(phases=[LpPhase(step=1, nx=1, ny=0, state=LpPhase.WEAK)])
        self.assertEqual(slopes.velocity(self.recorded(*found, phases=lost), 1, 0)[2], 0)


class ByIndex(unittest.TestCase):
    """Of the smallest steps that projection did not resolve."""

    def run_of(self, levels, *resolved):
        info = recorded.info(400, 0.1, 0.867)
        steps = [made.unresolved(info, T, 1, 0, 2), made.unresolved(info, LP, 1, 0, 4), *resolved]
        return info, recorded.Recorded(info, made.steps(steps), recorded.stairs(info, levels))

    def test_both_by_their_degeneracy(self):
        info, run = self.run_of([(0.10, 4), (0.12, 2), (0.15, 2)])
        lp, t = slopes.by_index(run, LP, 1, 0), slopes.by_index(run, T, 1, 0)
        self.assertAlmostEqual(lp.exponent, 0.10)
        self.assertAlmostEqual(t.exponent, 0.12)
        self.assertAlmostEqual(t.wave_number, 2 * np.pi / info.box_x)
        self.assertEqual(
            (lp.error, lp.remark), (1e-3, 'not resolved; by its 4 equal exponents 794-797')
        )

    def test_nothing_behind_a_stair_that_fits_neither(self):
        _, run = self.run_of([(0.10, 6), (0.2, 2), (0.3, 4)])
        self.assertIsNone(slopes.by_index(run, T, 1, 0))
        self.assertIsNone(slopes.by_index(run, LP, 1, 0))

    def test_not_the_vectors_of_another_step(self):
        info = recorded.info(400, 0.1, 0.867)
        other = made.step(info, LP, 0, 1, 794, 797)
        _, run = self.run_of([(0.10, 4), (0.12, 2), (0.15, 4)], other)
        self.assertAlmostEqual(slopes.by_index(run, LP, 1, 0).exponent, 0.15)

    def test_nothing_where_another_step_has_a_part_of_the_stair(self):
        info = recorded.info(400, 0.1, 0.867)
        for first, last in ((794, 795), (796, 797)):
            _, run = self.run_of(
                [(0.10, 4), (0.12, 2), (0.15, 4)], made.step(info, T, 0, 1, first, last)
            )
            self.assertIsNone(slopes.by_index(run, LP, 1, 0))


class Stairs(unittest.TestCase):
    def counts(self, levels, error):
        info = recorded.info(400, 0.4, 0.867)
        found = stairs.stairs(
            recorded.Recorded(info, None, recorded.stairs(info, levels, error=error))
        )
        self.assertEqual(found[0].last, 797)
        return [stair.count for stair in found[: len(levels)]]

    def test_counted_where_exponents_jump(self):
        self.assertEqual(self.counts([(0.5, 2), (0.52, 3), (0.8, 4)], 1e-3), [2, 3, 4])

    def test_a_difference_within_the_errors_is_no_jump(self):
        self.assertEqual(
            self.counts([(0.5, 2), (0.52, 3), (0.8, 4)], 0.01)[:2], [5, 4]
        )  # .02 < 3 sqrt(2) .01

    def test_nor_one_within_a_percent(self):
        self.assertEqual(self.counts([(0.5, 2), (0.504, 3), (0.8, 4)], 1e-6)[:2], [5, 4])

    def test_the_zero_modes_are_none_of_them(self):
        info = recorded.info(20, 0.5, 1.0)
        exponents = [*np.linspace(3, 1, 35), 0.5, 0.5, *[1e-4] * 6, *[-0.5] * 37]
        run = recorded.Recorded(info, None, made.spectrum(exponents, 10.0, error=1e-3))
        first = stairs.stairs(run)[0]
        self.assertEqual((first.first, first.last), (36, 37))


class Fits(unittest.TestCase):
    def points(self, c, c2, numbers, error=1e-3, shift=0.0):
        return [
            slopes.Point('', k, c * k + c2 * k * k + shift * (-1) ** i, error, 2)
            for i, k in enumerate(numbers)
        ]

    def test_known_curve(self):
        curve = slopes.curve(self.points(1.4, 0.5, (0.05, 0.1, 0.15, 0.2)) + [None])
        self.assertAlmostEqual(curve.c, 1.4, places=12)
        self.assertAlmostEqual(curve.c2, 0.5, places=12)
        value, error = curve.at(0.1)
        self.assertAlmostEqual(value, 0.145, places=12)
        # against numpy's straight line through lambda / k
        k = np.array([0.05, 0.1, 0.15, 0.2])
        _, covariance = np.polyfit(k, 1.4 + 0.5 * k, 1, w=k / 1e-3, cov='unscaled')
        self.assertAlmostEqual(curve.c2_error, np.sqrt(covariance[0, 0]), places=10)
        self.assertAlmostEqual(curve.c_error, np.sqrt(covariance[1, 1]), places=10)
        self.assertAlmostEqual(
            curve.correlation, covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1])
        )
        self.assertAlmostEqual(
            error, 0.1 * np.sqrt(np.array([0.1, 1]) @ covariance @ np.array([0.1, 1])), places=12
        )

    def test_weights(self):
        exact = self.points(1.4, 0.5, (0.05, 0.1, 0.15))
        off = slopes.Point('', 0.2, 0.9, 1e3, 2)
        curve = slopes.curve(exact + [off])
        self.assertAlmostEqual(curve.c, 1.4, places=6)

    def test_errors_grow_with_the_scatter(self):
        numbers = np.linspace(0.05, 0.2, 8)
        calm = slopes.curve(self.points(1.4, 0.5, numbers, shift=1e-5))
        wild = slopes.curve(self.points(1.4, 0.5, numbers, shift=1e-2))
        self.assertLess(calm.chi2, 1)
        self.assertAlmostEqual(wild.c_error / calm.c_error, np.sqrt(wild.chi2 / 6), places=9)

    def test_one_wave_number(self):
        """Of a square box, say: c alone, the mean of lambda / k."""
        line = dispersion.Curve([0.1, 0.1], [0.14, 0.15], [1e-3, 1e-3])
        self.assertAlmostEqual(line.c, 1.45)
        self.assertEqual((line.c2, line.c2_error, line.freedom), (0.0, 0.0, 1))
        self.assertAlmostEqual(line.chi2, 50.0)
        self.assertAlmostEqual(line.c_error, np.sqrt(50.0 / 2) * 0.01)

    def test_too_few_points(self):
        self.assertIsNone(slopes.curve(self.points(1.4, 0.5, (0.1, 0.1))))
        self.assertIsNone(slopes.curve(self.points(1.4, 0.5, (0.1, 0.2), error=-1.0)))
        self.assertEqual(slopes.curve(self.points(1.4, 0.5, (0.1, 0.2))).freedom, 0)

    def test_mean_difference(self):
        numbers = (0.05, 0.1, 0.15)
        one = slopes.curve(self.points(1.4, 0.5, numbers))
        other = slopes.curve(self.points(1.428, 0.51, numbers))  # 2 % more at every k
        difference, error = dispersion.mean_difference(one, other, 0.05, 0.15)
        self.assertAlmostEqual(difference, 0.02, places=12)
        # every exponent moved by its error, one after the other
        moved = [
            self.difference_with(numbers, which, i) - 0.02 for which in range(2) for i in range(3)
        ]
        self.assertAlmostEqual(error / np.linalg.norm(moved), 1.0, delta=0.01)

    def difference_with(self, numbers, which, i):
        pair = [self.points(1.4, 0.5, numbers), self.points(1.428, 0.51, numbers)]
        pair[which][i].exponent += 1e-3
        return dispersion.mean_difference(*map(slopes.curve, pair), 0.05, 0.15)[0]


class Crossings(unittest.TestCase):
    def test_of_the_fits(self):
        place = crossing.of_fits()
        self.assertAlmostEqual(paper.slope_l(place), paper.slope_t(place), places=6)
        low, high = crossing.of_fits_between()
        self.assertAlmostEqual(1.03 * paper.slope_l(low), 0.97 * paper.slope_t(low), places=6)
        self.assertAlmostEqual(0.97 * paper.slope_l(high), 1.03 * paper.slope_t(high), places=6)
        self.assertTrue(low < place < high)

    def test_measured(self):
        density = np.arange(0.1, 0.85, 0.1)
        place, error = crossing.measured(density, density - 0.37, np.zeros(8))
        self.assertAlmostEqual(place, 0.37)
        self.assertAlmostEqual(error, 0.0)
        self.assertEqual(crossing.measured(density, density + 1, density), (None, 0.0))
        place, error = crossing.measured(density[2:4], density[2:4] - 0.37, np.array([0.01, 0.02]))
        self.assertAlmostEqual(place, 0.37)
        self.assertAlmostEqual(
            error, np.hypot(0.3 * 0.01, 0.7 * 0.02)
        )  # a straight line through both

    def test_error_from_those_of_the_slopes(self):
        density = np.arange(0.1, 0.85, 0.1)
        apart = (density - 0.37) * (1 + density)  # a parabola: the cubic moves nothing
        errors = 1e-5 * np.arange(1, 9)
        _, error = crossing.measured(density, apart, errors)
        # on its way through zero it rises by 1.37: Lagrange's polynomials of the four nearest, over
        # that
        near = density[1:5]
        weights = [
            np.prod([(0.37 - other) / (one - other) for other in near if other != one])
            for one in near
        ]
        expected = np.linalg.norm(weights * errors[1:5]) / 1.37
        self.assertAlmostEqual(error / expected, 1.0)
        # however large they are: none is lost where it moves the crossing beyond the densities
        self.assertAlmostEqual(
            crossing.measured(density, apart, 1e5 * errors)[1] / (1e5 * expected), 1.0
        )

    def test_a_crossing_at_a_density_that_was_run(self):
        density = np.arange(0.1, 0.85, 0.1)
        for root in density[1:]:
            self.assertAlmostEqual(crossing.measured(density, density - root, np.zeros(8))[0], root)

    def test_a_curve_that_a_parabola_misses(self):
        density = np.arange(0.1, 0.85, 0.1)
        place, error = crossing.measured(density, density**6 - 0.37**6, np.zeros(8))
        self.assertGreater(abs(place - 0.37), 1e-4)
        self.assertLess(abs(place - 0.37), error)


if __name__ == '__main__':
    unittest.main()
