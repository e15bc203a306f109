"""Part 9 of the reproduction against runs that are known exactly."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import recorded
from made import LP, T
from hdlyap.plots import paper
import reproduced
from study import slopes
from study.parts import smallest

ERROR = 2e-4
ALIKE = 'lambda_T: reflecting over periodic at equal k, less 1'


# of all steps: their wave numbers overlap
EVERY = {
    'periodic': [(kind, *nodes) for kind in (T, LP) for nodes in ((1, 0), (0, 1), (1, 1))],
    'reflecting': [(kind, *nodes) for kind in (T, LP) for nodes in ((2, 1), (2, 2), (3, 2))],
}


def run(box, boundary, factor, every=False):
    """Steps on the paper's curves times a factor; T(1,1) is the smallest one between walls."""
    disks, aspect = recorded.BOXES[box]
    info = recorded.info(disks, 0.4, aspect, boundaries=(boundary, boundary))
    waves = {
        'periodic': ((T, 1, 0), (LP, 1, 0), (LP, 0, 1)),
        'reflecting': ((T, 1, 1), (LP, 1, 0), (LP, 1, 1)),
    }
    found = []
    for number, (kind, nx, ny) in enumerate((EVERY if every else waves)[boundary]):
        k = made.wave_number(info, nx, ny)
        c, c2 = paper.CURVES['T' if kind == T else 'LP']
        found.append(
            made.step(
                info,
                kind,
                nx,
                ny,
                100 - 4 * number,
                101 - 4 * number,
                exponent=factor * (c * k + c2 * k * k),
                std_error=ERROR,
            )
        )
    return recorded.Bag(recorded.Recorded(info, made.steps(found)))


def bags(**factors):
    return {
        smallest.run_of(boundary, box): run(box, boundary, factors.get(boundary, 1.0))
        for boundary in smallest.BOUNDARIES
        for box in recorded.BOXES
    }


class Smallest(unittest.TestCase):
    def test_the_runs_are_those_of_the_plan(self):
        self.assertEqual(sorted(bags()), sorted(smallest.runs()))
        elsewhere = {name for names in smallest.ELSEWHERE.values() for name in names}
        self.assertEqual({*bags(), *elsewhere}, set(reproduced.part_of(smallest).runs))

    def test_fits(self):
        rows = recorded.by_quantity(smallest, bags(periodic=1.01, reflecting=1.01))
        for symbol, kind in (('lambda_T', 'T'), ('lambda_L', 'LP')):
            c, c2 = paper.CURVES[kind]
            self.assertAlmostEqual(rows[f'c of {symbol}'].measured, 1.01 * c, places=9)
            self.assertAlmostEqual(rows[f'c2 of {symbol}'].measured, 1.01 * c2, places=8)
            self.assertLess(rows[f'c of {symbol}'].error, 0.01)

    def test_the_coefficients_are_of_both_boundaries(self):
        found = bags(reflecting=1.02)
        curve = slopes.curve(
            smallest.points(found, 'LP', 'periodic') + smallest.points(found, 'LP', 'reflecting')
        )
        rows = recorded.by_quantity(smallest, found)
        for name, value, error in (('c', curve.c, curve.c_error), ('c2', curve.c2, curve.c2_error)):
            row = rows[f'{name} of lambda_L']
            self.assertAlmostEqual(row.measured, value, places=12)
            self.assertAlmostEqual(row.error, error, places=12)
        self.assertIn(f'with c2: {curve.correlation:.2f}', rows['c of lambda_L'].remark)

    def test_exponents_at_the_ends_of_the_range(self):
        info = recorded.info(780, 0.4, 0.5)
        k = np.pi / (info.box_x - 1)  # the smallest of all
        there = 1.422 * k + 0.55 * k * k
        for factor, verdict in ((1.0, 'agrees'), (1.03, 'differs'), (0.97, 'differs')):
            found = bags(periodic=factor, reflecting=factor)
            row = recorded.by_quantity(smallest, found)['lambda_L at smallest k']
            self.assertAlmostEqual(row.published, there, places=9)
            self.assertAlmostEqual(row.left_open, 0.015 * there, places=9)
            self.assertAlmostEqual(row.measured, factor * there, places=9)
            self.assertEqual(row.verdict, verdict)
            self.assertIn(f'k = {k:.4f}, 12 boxes', row.remark)
        values = {
            claim.name: claim.values for claim in reproduced.claims(smallest, bags()).values()
        }
        self.assertEqual(values['lambda_T = 1.412 k + 0.086 k^2'], 12)

    def test_one_curve(self):
        """chi^2 is of the errors: one box that is 5 % off is seen in its boundary alone."""
        found = bags()
        for step in found[smallest.run_of('reflecting', '600_075')].recording.steps.steps:
            step.exponent *= 1.05
        rows = recorded.by_quantity(smallest, found)
        for symbol, kind in (('lambda_T', 'T'), ('lambda_L', 'LP')):
            seen, other = (
                rows[f'{symbol}, {boundary}, about its curve']
                for boundary in ('reflecting', 'periodic')
            )
            curve = slopes.curve(smallest.points(found, kind, 'reflecting'))
            self.assertAlmostEqual(seen.measured, curve.chi2)
            self.assertEqual((seen.published, seen.verdict), (4, 'differs'))
            self.assertEqual((other.verdict, other.count), ('agrees', 6))

    def test_alike(self):
        for factor, verdict in ((1.02, 'differs'), (1.0, 'agrees')):
            rows = recorded.by_quantity(smallest, bags(reflecting=factor))
            for row in (rows[ALIKE], rows[ALIKE.replace('_T', '_L')]):
                self.assertAlmostEqual(row.measured, 100 * (factor - 1), places=6)
                self.assertEqual((row.verdict, row.telling), (verdict, 3.0))
        self.assertTrue(row.remark.endswith('; between walls with LP(1,1)'))

    def test_hardly_known_is_not_alike(self):
        loose = bags()
        for bag in loose.values():
            for step in bag.recording.steps.steps:
                step.std_error *= 30
        row = recorded.by_quantity(smallest, loose)[ALIKE]
        self.assertGreater(5 * row.error, 3.0)
        self.assertEqual(row.verdict, 'not decided')

    def test_what_the_fits_go_through(self):
        """Not mixtures with the other branch."""
        found = bags()
        one, other = (
            found[smallest.run_of('periodic', box)].recording.steps.steps
            for box in ('400_05', '600_075')
        )
        one[0].set = one[1].set  # T(1,0) with LP(1,0)
        one[0].exponent = one[1].exponent = 0.25
        other[1].resolved = False  # LP(1,0), so that LP(0,1) is taken
        rows = recorded.by_quantity(smallest, found)
        left = '1 left out, 1 of them share vectors'
        beyond = '1 of them beyond a smaller step that is not resolved'
        for name, said in (
            ('lambda_T at smallest k', f'11 boxes, {left}'),
            ('lambda_T, reflecting, about its curve', '6 boxes'),
            ('lambda_L, periodic, about its curve', f'5 boxes, {left}; {beyond}'),
        ):
            self.assertTrue(rows[name].remark.endswith(said), rows[name].remark)
        self.assertAlmostEqual(rows['c of lambda_T'].measured, 1.412, places=9)

    def test_common_range(self):
        self.assertEqual(smallest.common([(0.1, 0.2), (0.05, 0.13)]), (0.1, 0.13))
        low, high = smallest.common([(0.1, 0.2), None])
        self.assertLess(high, low)

    def test_curvature_of_l_beyond_that_of_t(self):
        row = recorded.by_quantity(smallest, bags())['c2 of lambda_L less c2 of lambda_T']
        curves = [smallest.Branch(bags(), kind).curves['both'] for kind in ('LP', 'T')]
        self.assertAlmostEqual(row.measured, 0.55 - 0.086, places=8)
        self.assertAlmostEqual(row.error, np.hypot(*(one.c2_error for one in curves)), places=9)
        self.assertEqual((row.cells()[1], row.verdict), ('above 0', 'agrees'))

    def test_alike_at_other_densities(self):
        """All steps that have vectors of their own; runs that are not there are not measured."""
        quantity = '{}: reflecting over periodic at equal k, less 1, density {}'
        for factor, verdict in ((1.02, 'agrees'), (1.05, 'differs'), (0.95, 'differs')):
            found = bags()
            found['periodic'] = run('780_0867', 'periodic', 1.0, every=True)
            found['reflecting'] = run('780_0867', 'reflecting', factor, every=True)
            rows = recorded.by_quantity(smallest, found)
            for symbol in ('lambda_T', 'lambda_L'):
                row = rows[quantity.format(symbol, '0.8')]
                self.assertAlmostEqual(row.measured, 100 * (factor - 1), places=6)
                self.assertEqual((row.verdict, row.left_open), (verdict, 3.0))
                missing = rows[quantity.format(symbol, '0.2')]
                self.assertEqual(missing.verdict, 'not measured')

    def test_one_wave_number_beside_a_curve(self):
        """Of two steps, in the range of the periodic ones."""
        found = bags()
        found['density_02'] = run('780_0867', 'periodic', 1.0, every=True)
        found['walls_02'] = run('780_0867', 'reflecting', 1.01, every=True)
        for step in found['walls_02'].recording.steps.steps:
            step.resolved = (step.nx, step.ny) == (2, 1)
        row = recorded.by_quantity(smallest, found)[ALIKE + ', density 0.2']
        self.assertAlmostEqual(row.measured, 1.0, places=6)
        steps = found['walls_02'].recording.steps.steps
        (step,) = [one for one in steps if one.kind == T and one.resolved]
        periodic = smallest._all(found, 'density_02', T)
        value, error = slopes.curve(periodic).at(step.wave_number)
        both = np.hypot(ERROR / step.exponent, error / value)
        self.assertAlmostEqual(row.error, 101 * both, places=6)
        self.assertEqual(row.remark, f'of the fit at k = {step.wave_number:.4f}')

    def test_not_measured(self):
        bare = {
            name: recorded.Bag(recorded.Recorded(bag.recording.info))
            for name, bag in bags().items()
        }
        verdicts = {row.verdict for row in recorded.rows(smallest, bare)}
        self.assertEqual(verdicts, {'not measured'})
        self.assertEqual(recorded.pictures(self, smallest, bare), [])
        ((_, _, lines),) = smallest.tables(bare)
        self.assertEqual({line[4] for line in lines}, {'none resolved'})

    def test_one_run_without_steps(self):
        found = bags()
        name = smallest.run_of('reflecting', '780_1')
        found[name] = recorded.Bag(recorded.Recorded(found[name].recording.info))
        rows = recorded.by_quantity(smallest, found)
        self.assertAlmostEqual(rows['c of lambda_T'].measured, 1.412, places=9)
        self.assertEqual(recorded.pictures(self, smallest, found), ['smallest'])

    def test_table(self):
        ((name, header, lines),) = smallest.tables(bags())
        self.assertEqual((name, len(lines)), ('smallest', 30))
        line = dict(zip(header, lines[6]))
        self.assertEqual(
            (line['boundaries'], line['disks'], line['kind'], line['step']),
            ('reflecting', 400, 'T', 'T(1,1)'),
        )
        info = recorded.info(400, 0.4, 0.5)
        k = np.pi * np.hypot(1 / (info.box_x - 1), 1 / (info.box_y - 1))
        self.assertAlmostEqual(float(line['wave_number']), k, places=5)
        self.assertAlmostEqual(float(line['slope']), 1.412 + 0.086 * k, places=5)

    def test_figure(self):
        self.assertEqual(recorded.pictures(self, smallest, bags()), ['smallest'])


if __name__ == '__main__':
    unittest.main()
