"""Part 16 of the reproduction against widths that are known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
from made import LP, T
from reproduced import Part
from study.parts import localization
from study.parts.localization import COSINE, random_width

WIDE, SPREAD, ORDER = (
    'the vector of the largest exponent is localised, those of the modes are not',
    'a T mode is spread as its wave is',
    'the larger the exponent, the more localised the vector, among the largest',
)


def width(parts):
    parts = parts / parts.sum()
    return np.exp(-(parts * np.log(parts)).sum()) / parts.size


class Localization(Part):
    of = localization

    def bags(self, widths=None, errors=None, name='run'):
        """37 vectors: T(1,0) is 36-37, LP(1,0) is 32-35."""
        info = made.run_info()
        found = [made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)]
        messages = [info, made.spectrum(np.linspace(9, 3, 37), 60.0), made.steps(found)]
        if widths is not None:
            told = {} if errors is None else {'std_errors': errors}
            messages.append(made.localization(widths, error=0.005, **told))
        return {'hydro': self.bag(name, messages)}

    def usual(self):
        return np.array([*np.linspace(0.1, 0.6, 31), 0.6, 0.65, 0.65, 0.7, 0.73, 0.74])

    def verdicts(self, widths, name):
        claims = self.claims(self.bags(widths, name=name))
        return [claims[one].verdict for one in (WIDE, ORDER, SPREAD)]

    def test_widths(self):
        rows = self.rows(self.bags(self.usual()))
        for name, expected, count in (
            ('vector 1', 0.1, ''),
            ('LP(1,0)', 0.65, '4 vectors, '),
            ('vector 10', 0.25, ''),
            ('vector 18', self.usual()[17], ''),
        ):
            row = rows[f'width of {name}']
            self.assertAlmostEqual(row.measured, expected)
            self.assertAlmostEqual(row.error, 0.005)
            self.assertEqual(row.remark, count + '20 times')
        ratio = rows['width of vector 1 over that of vector 3']
        self.assertAlmostEqual(ratio.measured, 0.1 / self.usual()[2])
        self.assertAlmostEqual(
            ratio.error / ratio.measured, np.hypot(0.05, 0.005 / self.usual()[2])
        )

    def test_verdicts(self):
        even, backwards, narrow = np.full(37, 0.6), self.usual(), self.usual()
        backwards[:30] = backwards[29::-1]
        narrow[-2:] = 0.5
        flat = self.usual()
        flat[-2:] = 1.0  # spread evenly
        for widths, verdicts in (
            (self.usual(), ['agrees', 'agrees', 'agrees']),
            (even, ['differs', 'not decided', 'differs']),
            (backwards, ['differs', 'differs', 'agrees']),
            (narrow, ['agrees', 'agrees', 'differs']),
            (flat, ['agrees', 'agrees', 'differs']),
        ):
            self.assertEqual(self.verdicts(widths, f'{widths[0]}{widths[-1]}'), verdicts)

    def test_errors_that_are_not_known(self):
        errors = np.full(37, 0.005)
        errors[[0, 35]] = -1.0
        rows = self.rows(self.bags(self.usual(), errors))
        self.assertEqual(rows['width of vector 1'].verdict, 'not decided')
        ratio = rows['width of vector 1 over that of vector 3']
        self.assertEqual(ratio.verdict, 'not decided')

    def test_of_a_random_vector(self):
        """Those of 20 disks scatter by 6 %: the mean of 4000 is known to 0.1 %."""
        rng = np.random.default_rng(4)
        for disks in (20, 100):
            entropies = [
                np.log(width(np.square(rng.normal(size=(4, disks))).sum(axis=0)))
                for _ in range(4000)
            ]
            self.assertAlmostEqual(np.exp(np.mean(entropies)) / random_width(disks), 1, delta=4e-3)

    def test_of_a_cosine(self):
        x = (np.arange(10000) + 0.5) / 10000
        self.assertAlmostEqual(width(np.cos(2 * np.pi * x) ** 2), COSINE, 4)

    def test_figure_and_table(self):
        bags = self.bags(self.usual())
        self.assertEqual(list(self.figures(bags)), ['widths'])
        header, lines = self.tables(bags)['widths']
        self.assertEqual(
            (header, lines[0]), (('index', 'width', 'std_error'), ('1', '0.1', '0.005'))
        )
        self.assertEqual(len(lines), 37)

    def test_without_widths(self):
        bags = self.bags()
        claims = self.claims(bags)
        for name in (WIDE, SPREAD, ORDER):
            self.assertEqual(claims[name].verdict, 'not measured')
        self.assertEqual(self.figures(bags), {})
        self.assertEqual(self.tables(bags)['widths'][1], [])


if __name__ == '__main__':
    unittest.main()
