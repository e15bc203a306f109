"""Relations to c_L of part 8 of the reproduction, and the gas beside the modes, against what is
known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import reproduced  # noqa: F401, finds the study
from study import relations, scales

X = np.array([0.9, 1.0, 1.2, 1.5, 1.9, 2.4, 3.3, 4.6])
TRIALS = 400


def points(y, error=0.002, x=X):
    return [(one, error * one, other, error * other) for one, other in zip(x, y)]


def rows(**triples):
    found = relations.straight(triples) + relations.beside(triples)
    return {row.quantity: row.judge({'open': 3.0}) for row in found}


class Relations(unittest.TestCase):
    def test_curvature(self):
        row = rows(c_T=points(0.4 + 0.6 * X + 0.05 * X**2))[
            'curvature of c_T over c_L, coefficient of c_L^2'
        ]
        self.assertAlmostEqual(row.measured, 0.05, 9)
        self.assertIn('chi^2 0 for 5, ', row.remark)

    def test_error_of_the_curvature(self):
        """Errors of both, of what is fitted and of c_L."""
        rng = np.random.default_rng(3)
        y = 0.4 + 0.9 * X - 0.05 * X**2
        found = [
            relations.Polynomial(
                points(
                    y * (1 + 0.002 * rng.normal(size=8)), x=X * (1 + 0.002 * rng.normal(size=8))
                ),
                2,
            )
            for _ in range(TRIALS)
        ]
        values = [one.curvature[0] for one in found]
        bare = np.median([one.curvature[1] for one in found])
        self.assertAlmostEqual(np.mean(values), -0.05, delta=4 * np.std(values) / TRIALS**0.5)
        # larger on average, as errors grow where the points scatter more
        self.assertAlmostEqual(bare / np.std(values), 1.05, delta=0.12)
        self.assertAlmostEqual(np.mean([one.chi2 for one in found]), 5, delta=0.7)

    def test_errors_grow_with_the_scatter(self):
        y = 0.4 + 0.6 * X + 0.02 * (-1) ** np.arange(8)
        small, large = (relations.Polynomial(points(y, error), 2) for error in (0.0005, 0.001))
        self.assertAlmostEqual(small.curvature[1] / large.curvature[1], 1, 2)
        self.assertAlmostEqual(small.chi2 / large.chi2, 4, 1)

    def test_straight(self):
        straight = 0.4 + 0.6 * X
        kinked = straight.copy()
        kinked[3] *= 1.06
        name = 'v over c_L, farthest from its straight line'
        for y, error, verdict in (
            (straight, 0.002, 'agrees'),
            (kinked, 0.002, 'differs'),
            (0.4 + 0.6 * X + 0.05 * X**2, 0.002, 'differs'),
            (straight, 0.02, 'not decided'),
        ):
            row = rows(v=points(y, error))[name]
            self.assertEqual(row.verdict, verdict)
            self.assertEqual(row.count, 8)
        row = rows(v=points(kinked))[name]
        self.assertIn('at c_L = 1.500; ', row.remark)
        self.assertGreater(row.measured, 0)

    def test_where_it_is_c_l(self):
        found = rows(c_T=points(0.5 + 0.6 * X), v=points(-0.3 + 1.2 * X))
        self.assertAlmostEqual(found['c_L at which c_T = c_L'].measured, 1.25, 9)
        self.assertAlmostEqual(found['c_L at which v = c_L'].measured, 1.5, 9)
        self.assertGreater(found['c_L at which c_T = c_L'].error, 0)

    def test_too_few(self):
        for count in (0, 1, 2):
            for row in rows(c_T=points(X)[:count]).values():
                self.assertEqual(row.measured, None)


class Scales(unittest.TestCase):
    def test_dilute(self):
        """Mean free path 1 / (2 sqrt(2) rho sigma), sound sqrt(2), as kT = 1 and c_v = 1."""
        line = dict(zip(scales.HEADER, scales.line(1e-4, 0.70711, [0.002, 0.001])))
        self.assertAlmostEqual(float(line['mean_free_path']) * 1e-4 * 8**0.5, 1, 3)
        self.assertAlmostEqual(float(line['sound_velocity']), 2**0.5, 3)
        self.assertAlmostEqual(float(line['sound_over_v']), 2, 3)
        self.assertEqual((line['k_min'], line['k_max']), ('0.001', '0.002'))
        self.assertAlmostEqual(float(line['k_max_times_path']), 0.002 / 1e-4 / 8**0.5, 2)

    def test_nothing_measured(self):
        line = scales.line(0.4, None, [])
        self.assertEqual(len(line), len(scales.HEADER))
        self.assertEqual(line.count(''), 6)


if __name__ == '__main__':
    unittest.main()
