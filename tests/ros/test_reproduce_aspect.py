"""Part 10 of the reproduction against runs that are known exactly."""

import os
import unittest

import numpy as np

import made
import recorded
from made import LP, T
from hdlyap.plots import paper
from hdlyap.reproduce import plan
from hdlyap.reproduce.parts import aspect

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..')
DISKS = {
    'periodic': (99, 197, 296, 395),
    'walls_lp': (28, 56, 84, 112),
    'walls_t': (471, 273, 225, 216),
}
STEPS = {
    'periodic': ((LP, 1, 0), (T, 1, 0)),
    'walls_lp': ((LP, 1, 0),),
    'walls_t': ((LP, 1, 1), (T, 1, 1)),
}
ASPECTS = (0.25, 0.5, 0.75, 1.0)
ERROR = 0.002  # relative


def run(which, i, factor, disks=None):
    boundary = 'periodic' if which == 'periodic' else 'reflecting'
    info = recorded.info(disks or DISKS[which][i], 0.4, ASPECTS[i], boundaries=(boundary, boundary))
    found = []
    for number, (kind, nx, ny) in enumerate(STEPS[which]):
        k = made.wave_number(info, nx, ny)
        c, c2 = paper.CURVES['T' if kind == T else 'LP']
        exponent = factor * (c * k + c2 * k * k)
        found.append(
            made.step(
                info,
                kind,
                nx,
                ny,
                50 - 4 * number,
                51 - 4 * number,
                exponent=exponent,
                std_error=ERROR * exponent,
            )
        )
    return recorded.Bag(recorded.Recorded(info, made.steps(found)))


def bags(factors=(1.0, 1.0, 1.0, 1.0)):
    return {
        f'aspect_{name}_{which}': run(which, i, factors[i])
        for i, name in enumerate(aspect.ASPECTS)
        for which in DISKS
    }


class Aspect(unittest.TestCase):
    def test_the_runs_are_those_of_the_plan(self):
        self.assertEqual(sorted(bags()), sorted(aspect.runs(None)))

    def test_wave_numbers_of_the_plan(self):
        """All within what the rounding of N moves: k falls as N^-1/2, and N is rounded by a
        half."""
        for quick in (False, True):
            planned = plan.runs(ROOT, quick)
            for which, _, nodes in aspect.SERIES:
                for name, ratio in zip(aspect.ASPECTS, ASPECTS):
                    asked = planned[f'aspect_{name}_{which}'].parameters
                    self.assertEqual(asked['aspect'], ratio)
                    walls = 'periodic' if which == 'periodic' else 'reflecting'
                    self.assertEqual(
                        [asked.get('boundary_x', 'periodic'), asked.get('boundary_y', 'periodic')],
                        [walls] * 2,
                    )
                    info = recorded.info(
                        asked['disks'], asked['density'], ratio, boundaries=(walls, walls)
                    )
                    self.assertAlmostEqual(
                        made.wave_number(info, *nodes) / aspect.WAVE_NUMBER,
                        1,
                        delta=1.5 * 0.5 / 2 / asked['disks'],
                    )

    def test_slopes(self):
        rows = recorded.by_quantity(aspect, bags((1.0, 1.01, 1.0, 1.04)))
        row = rows['c_T, reflecting, T(1,1), A = 0.50']
        k = float(row.remark.rpartition('k = ')[2].partition(';')[0])
        self.assertAlmostEqual(row.measured, 1.01 * (1.412 + 0.086 * k), places=4)
        self.assertAlmostEqual(row.error, ERROR * row.measured, places=9)
        self.assertTrue(row.remark.startswith('N = 273, k = 0.'))
        self.assertEqual(len(rows), 5 * 5)

    def test_published_are_smallest_steps_of_the_papers_boxes(self):
        for which, disks, i, said in (
            ('periodic', 400, 3, {(T, 1, 0), (LP, 1, 0)}),
            ('periodic', 800, 1, {(T, 1, 0), (LP, 1, 0)}),
            ('periodic', 801, 1, ()),
            ('periodic', 399, 3, ()),
            ('periodic', 471, 0, ()),
            ('walls_lp', 400, 1, {(LP, 1, 0)}),
            ('walls_t', 400, 2, {(T, 1, 1)}),
        ):  # LP(1,1) is not the smallest
            name = f'aspect_{aspect.ASPECTS[i]}_{which}'
            rows = recorded.by_quantity(aspect, {**bags(), name: run(which, i, 1.0, disks)})
            boundary = 'periodic' if which == 'periodic' else 'reflecting'
            for kind, nx, ny in STEPS[which]:
                symbol, text = ('c_T', 'T') if kind == T else ('c_L', 'LP')
                row = rows[f'{symbol}, {boundary}, {text}({nx},{ny}), A = {ASPECTS[i]:.2f}']
                self.assertTrue(row.remark.startswith(f'N = {disks}, '))
                if (kind, nx, ny) in said:
                    self.assertAlmostEqual(
                        row.published, row.measured, places=9
                    )  # of made: on the curves
                    self.assertAlmostEqual(row.published_error, 0.03 * row.published, places=9)
                    self.assertIn('; 3 %: that of the density fits', row.remark)
                    self.assertEqual(row.verdict, 'agrees')
                else:
                    self.assertEqual((row.published, row.verdict), (None, ''))
                    self.assertIn('; outside of the paper\'s range', row.remark)

    def test_constant(self):
        rows = recorded.by_quantity(aspect, bags((1.0, 1.0, 1.0, 1.08)))
        for name in ('c_T, periodic, T(1,0)', 'c_L, reflecting, LP(1,1)'):
            row = rows[f'{name}: largest deviation from the mean over A']
            self.assertAlmostEqual(row.measured, 100 * (1.08 / 1.02 - 1), delta=0.3)
            self.assertAlmostEqual(row.error, 100 * ERROR * 1.08 / 1.02, delta=0.01)
            self.assertEqual(row.verdict, 'differs')
            self.assertIn('at A = 1.00', row.remark)
        rows = recorded.by_quantity(aspect, bags())
        row = rows['c_T, periodic, T(1,0): largest deviation from the mean over A']
        self.assertEqual((row.verdict, row.enough), ('agrees', 1.0))
        self.assertTrue(row.remark.endswith(' for 3; 3 %: that of the density fits'), row.remark)

    def test_slopes_that_share_their_vectors_are_said(self):
        found = bags()
        lp, t = found['aspect_100_periodic'].recording.steps.steps
        lp.set = t.set
        rows = recorded.by_quantity(aspect, found)
        self.assertIn(
            'mean 1.4', rows['c_T, periodic, T(1,0): largest deviation from the mean over A'].remark
        )
        for name in ('c_T, periodic, T(1,0)', 'c_L, periodic, LP(1,0)'):
            remark = rows[f'{name}: largest deviation from the mean over A'].remark
            self.assertIn(' of 4 boxes, ', remark)
            self.assertIn(' for 3; 1 of them share vectors; ', remark)
        self.assertIn(
            'shares its vectors with LP(1,0)', rows['c_T, periodic, T(1,0), A = 1.00'].remark
        )

    def test_one_below_the_mean_deviates_too(self):
        row = recorded.by_quantity(aspect, bags((1.0, 0.92, 1.0, 1.0)))[
            'c_T, periodic, T(1,0): largest deviation from the mean over A'
        ]
        self.assertAlmostEqual(row.measured, 100 * (0.92 / 0.98 - 1), delta=0.3)
        self.assertIn('at A = 0.50', row.remark)

    def test_mean_and_chi2(self):
        series = aspect.Series(bags(), 'walls_lp', 'LP', (1, 0))
        for point, slope, error in zip(
            series.points, (1.5, 1.5, 1.6, 1.6), (0.01, 0.01, 0.01, 0.02)
        ):
            point.exponent, point.error = slope * point.wave_number, error * point.wave_number
        mean, chi2 = series.mean()
        weights = 1e4 * np.array([1, 1, 1, 0.25])
        expected = weights @ [1.5, 1.5, 1.6, 1.6] / weights.sum()
        self.assertAlmostEqual(mean, expected)
        self.assertAlmostEqual(chi2, weights @ (np.array([1.5, 1.5, 1.6, 1.6]) - expected) ** 2)

    def test_not_measured(self):
        bare = {
            name: recorded.Bag(recorded.Recorded(bag.recording.info))
            for name, bag in bags().items()
        }
        self.assertEqual({row.verdict for row in aspect.rows(bare)}, {'not measured'})
        self.assertEqual(recorded.pictures(self, aspect, bare), [])
        ((_, _, lines),) = aspect.tables(bare)
        self.assertEqual({line[4] for line in lines}, {'not resolved'})

    def test_one_run_without_steps(self):
        found = bags()
        found['aspect_050_walls_t'] = recorded.Bag(
            recorded.Recorded(found['aspect_050_walls_t'].recording.info)
        )
        rows = recorded.by_quantity(aspect, found)
        self.assertEqual(rows['c_T, reflecting, T(1,1), A = 0.50'].verdict, 'not measured')
        self.assertEqual(
            rows['c_T, reflecting, T(1,1): largest deviation from the mean over A'].verdict,
            'agrees',
        )
        self.assertEqual(recorded.pictures(self, aspect, found), ['aspect'])

    def test_table(self):
        ((name, header, lines),) = aspect.tables(bags())
        self.assertEqual((name, len(lines)), ('aspect', 20))
        line = dict(zip(header, lines[1]))
        self.assertEqual(
            (line['boundaries'], line['step'], line['aspect'], line['disks']),
            ('periodic', 'LP(1,0)', '0.5', 197),
        )
        k = float(line['wave_number'])
        self.assertAlmostEqual(float(line['slope']), 1.422 + 0.55 * k, places=4)

    def test_figure(self):
        self.assertEqual(recorded.pictures(self, aspect, bags()), ['aspect'])


if __name__ == '__main__':
    unittest.main()
