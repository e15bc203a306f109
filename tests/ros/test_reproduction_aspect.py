"""Part 10 of the reproduction against runs that are known exactly."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import recorded
from made import LP, T
from hdlyap.plots import paper
import reproduced
from study.parts import aspect

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
        self.assertEqual(sorted(bags()), sorted(reproduced.part_of(aspect).runs))

    def test_wave_numbers_of_the_plan(self):
        """All within what the rounding of N moves: k falls as N^-1/2, and N is rounded by a
        half."""
        planned = reproduced.plan()
        for which, _, nodes in aspect.SERIES:
            for name, ratio in zip(aspect.ASPECTS, ASPECTS):
                asked = planned[f'aspect_{name}_{which}']
                walls = 'periodic' if which == 'periodic' else 'reflecting'
                ends = asked.get('boundary_x', 'periodic'), asked.get('boundary_y', 'periodic')
                self.assertEqual((asked['aspect'], *ends), (ratio, walls, walls))
                info = recorded.info(asked['disks'], 0.4, ratio, boundaries=ends)
                self.assertAlmostEqual(
                    made.wave_number(info, *nodes) / aspect.WAVE_NUMBER,
                    1,
                    delta=1.5 * 0.5 / 2 / asked['disks'],
                )

    def test_slopes(self):
        ((_, header, lines),) = aspect.tables(bags((1.0, 1.01, 1.0, 1.04)))
        found = {(line[0], line[1], line[2]): dict(zip(header, line)) for line in map(list, lines)}
        line = found['reflecting', 'T(1,1)', '0.5']
        k, slope = float(line['wave_number']), float(line['slope'])
        self.assertAlmostEqual(slope, 1.01 * (1.412 + 0.086 * k), places=4)
        self.assertAlmostEqual(float(line['slope_error']) / slope, ERROR, places=4)

    def test_constant(self):
        rows = recorded.by_quantity(aspect, bags((1.0, 1.0, 1.0, 1.08)))
        for name in ('c_T, periodic, T(1,0)', 'c_L, reflecting, LP(1,1)'):
            row = rows[f'{name} about their mean']
            self.assertEqual((row.verdict, row.published, row.count), ('differs', 3, 4))
            self.assertRegex(row.remark, r'; farthest at A = 1\.00, \+6\.[0-9]+ %$')
        for claim in reproduced.claims(aspect, bags()).values():
            self.assertEqual(claim.verdict, 'agrees')
        found = [(claim.name, claim.values) for claim in reproduced.claims(aspect, bags()).values()]
        name = 'slopes do not depend on the aspect ratio'
        self.assertEqual(found, [(f'{name}, periodic', 8), (f'{name}, reflecting', 12)])

    def test_mixtures_are_left_out(self):
        """What shares its vectors with a step of the other kind is no slope."""
        found = bags()
        lp, t = found['aspect_100_periodic'].recording.steps.steps
        lp.set = t.set
        rows = recorded.by_quantity(aspect, found)
        row = rows['c_T, periodic, T(1,0) about their mean']
        self.assertEqual((row.count, row.published), (3, 2))
        self.assertTrue(row.remark.endswith('; at A = 1.00 it shares its vectors with LP(1,0)'))

    def test_one_below_the_mean_deviates_too(self):
        row = recorded.by_quantity(aspect, bags((1.0, 0.92, 1.0, 1.0)))[
            'c_T, periodic, T(1,0) about their mean'
        ]
        self.assertRegex(row.remark, r'; farthest at A = 0\.50, -5\.[89][0-9]* %$')

    def test_boxes_that_would_not_have_been_told_apart(self):
        found = bags()
        for bag in found.values():
            for step in bag.recording.steps.steps:
                step.std_error *= 3
        verdicts = set(recorded.verdicts(aspect, found).values())
        self.assertEqual(verdicts, {'not decided'})

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
        self.assertEqual({row.verdict for row in recorded.rows(aspect, bare)}, {'not measured'})
        self.assertEqual(recorded.pictures(self, aspect, bare), [])
        ((_, _, lines),) = aspect.tables(bare)
        self.assertEqual({line[4] for line in lines}, {'not resolved'})

    def test_one_run_without_steps(self):
        found = bags()
        found['aspect_050_walls_t'] = recorded.Bag(
            recorded.Recorded(found['aspect_050_walls_t'].recording.info)
        )
        row = recorded.by_quantity(aspect, found)['c_T, reflecting, T(1,1) about their mean']
        self.assertEqual((row.verdict, row.count), ('agrees', 3))
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
