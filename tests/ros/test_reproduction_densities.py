"""Part 8 of the reproduction against runs that are known exactly."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import recorded
from made import LP, T
from hdlyap.plots import paper
import reproduced  # noqa: F401, finds the study
from study import crossing, velocity
from study.parts import densities

OFF = 1.01  # our slopes over the paper's fits
ERROR = 0.001  # relative, of exponents
CROSS = 'c_T is above c_L at low density and below it at high density'
V_OVER_C = {0.7: 1.08, 0.8: 1.14}


def info_of(density):
    return recorded.info(780, density, 0.867)


def run(density, resolved=(T, LP), levels=None, velocity=None, first_t=1556):
    info = info_of(density)
    k = made.wave_number(info, 1, 0)
    exponents = {T: OFF * k * paper.slope_t(density), LP: OFF * k * paper.slope_l(density)}
    found = [
        made.step(
            info,
            kind,
            1,
            0,
            first,
            last,
            exponent=exponents[kind],
            std_error=ERROR * exponents[kind],
        )
        if kind in resolved
        else made.unresolved(info, kind, 1, 0, last - first + 1)
        for kind, first, last in ((T, first_t, first_t + 1), (LP, 1550, 1553))
    ]
    phases = made.lp_phases(info, found, 50.0)
    v = velocity or OFF * paper.slope_l(density) * V_OVER_C.get(density, 1.0)
    made.turn(found, v * k, 0.002 * v * k)
    spectrum = recorded.stairs(info, levels or [(exponents[T], 2), (exponents[LP], 4)])
    return recorded.Bag(recorded.Recorded(info, made.steps(found), spectrum, phases))


def bags(**replaced):
    found = {name: run(tenths / 10) for tenths, name in enumerate(densities.RUNS, start=1)}
    return {**found, **replaced}


class Densities(unittest.TestCase):
    def test_slopes(self):
        rows = recorded.by_quantity(densities, bags())
        for kind, slope in (('c_T', paper.slope_t), ('c_L', paper.slope_l)):
            for density in np.arange(1, 9) / 10:
                row = rows[f'{kind} at density {density:.1f}']
                self.assertAlmostEqual(row.published, slope(density), places=9)
                self.assertAlmostEqual(row.left_open, 0.03 * slope(density), places=9)
                self.assertAlmostEqual(row.measured, OFF * slope(density), places=9)
                self.assertAlmostEqual(row.error, ERROR * row.measured, places=9)
                self.assertEqual((row.verdict, row.remark), ('agrees', '+1.0 % of the fit'))

    def test_velocity_and_its_ratio(self):
        rows = recorded.by_quantity(densities, bags())
        v = rows['v at density 0.7']
        self.assertAlmostEqual(v.measured, 1.08 * OFF * paper.slope_l(0.7), places=9)
        self.assertAlmostEqual(v.error, 0.002 * v.measured, places=9)
        over = 1.612 / velocity.of_fields(0.7)  # of made.steps
        self.assertEqual(
            v.remark, f'8 phases of LP(1,0); all 8 phases: 1.612(23), {over:.3f} Z / sqrt(2)'
        )
        close, c_l = rows['v - c_L at density 0.5'], OFF * paper.slope_l(0.5)
        self.assertAlmostEqual(close.measured, 0.0, places=9)
        self.assertAlmostEqual(close.error, np.hypot(0.001, 0.002) * c_l, places=9)
        self.assertEqual((close.published, close.left_open, close.verdict), (0.0, 0.1, 'agrees'))
        self.assertEqual(close.remark, 'v / c_L 1.0000(22)')
        self.assertEqual(rows['v / c_L at density 0.6'].verdict, '')
        for density, said in ((0.7, '1.0800(24)'), (0.8, '1.1400(25)')):
            above = rows[f'v / c_L at density {density}']
            self.assertEqual(above.cells()[1:3], ('above 1', said))
            self.assertEqual(above.verdict, 'agrees')

    def test_velocity_of_the_fields(self):
        """Of the equation of motion, beside what the last full run has measured."""
        for line in recorded.table('08_densities'):
            over = float(line['v_all']) / velocity.of_fields(float(line['density']))
            self.assertAlmostEqual(over, 1.0, delta=0.03)

    def test_a_velocity_elsewhere_differs(self):
        far = run(0.5, velocity=0.12 + OFF * paper.slope_l(0.5))
        rows = recorded.by_quantity(densities, bags(density_05=far))
        self.assertEqual(rows['v - c_L at density 0.5'].verdict, 'differs')
        for v, verdict in (
            (0.99, 'differs'),
            (0.995, 'not decided'),  # 2.2 standard errors to either side
            (1.005, 'not decided'),
            (1.01, 'agrees'),
        ):
            other = run(0.8, velocity=v * OFF * paper.slope_l(0.8))
            rows = recorded.by_quantity(densities, bags(density_08=other))
            self.assertEqual(rows['v / c_L at density 0.8'].verdict, verdict)

    def test_mean_over_the_fit(self):
        """1 % above it at all densities, but for one: its error is their scatter."""
        low = run(0.3)
        for step in low.recording.steps.steps:
            step.exponent *= 0.96
        row = recorded.by_quantity(densities, bags(density_03=low))[
            'c_T over its fit, less 1, mean'
        ]
        off = [1.0] * 7 + [100 * (OFF * 0.96 - 1)]
        self.assertAlmostEqual(row.measured, np.mean(off), places=9)
        self.assertAlmostEqual(row.error, np.std(off, ddof=1) / 8**0.5, places=9)

    def test_crossing(self):
        """On the side of the fits at each density; exchanged, all are wrong."""
        rows = recorded.by_quantity(densities, bags())
        row, low = rows['density at which c_T = c_L'], rows['c_T - c_L at density 0.1']
        # both branches are off by the same factor
        self.assertLess(abs(row.measured - crossing.of_fits()), 3 * row.error)
        self.assertLess(row.error, 0.003)
        self.assertNotIn('slopes', row.remark)
        apart = OFF * (paper.slope_t(0.1) - paper.slope_l(0.1))
        self.assertAlmostEqual(low.measured, apart, places=9)
        error = ERROR * OFF * np.hypot(paper.slope_t(0.1), paper.slope_l(0.1))
        self.assertAlmostEqual(low.error, error, places=9)
        self.assertIn(f'{apart / error:+.0f} standard errors', low.remark)
        self.assertEqual([low.cells()[1], low.verdict], ['above 0', 'agrees'])
        self.assertEqual(rows['c_T - c_L at density 0.4'].cells()[1], 'below 0')
        exchanged = bags()
        for bag in exchanged.values():
            t, lp = bag.recording.steps.steps
            t.exponent, lp.exponent = lp.exponent, t.exponent
        self.assertEqual(recorded.verdicts(densities, exchanged)[CROSS], 'differs')

    def test_a_crossing_says_which_slopes_share_their_vectors(self):
        mixed = run(0.3)
        t, lp = mixed.recording.steps.steps
        lp.first_index, lp.last_index, lp.set = t.first_index, t.last_index, t.set
        row = recorded.by_quantity(densities, bags(density_03=mixed))['density at which c_T = c_L']
        self.assertTrue(row.remark.endswith('; 16 slopes, 2 of them share vectors'), row.remark)

    def test_by_degeneracy_where_unresolved(self):
        k = made.wave_number(info_of(0.1), 1, 0)
        low = run(0.1, resolved=(T,), levels=[(0.9 * k, 4), (1.0 * k, 2)], first_t=1552)
        row = recorded.by_quantity(densities, bags(density_01=low))['c_L at density 0.1']
        self.assertAlmostEqual(row.measured, 0.9, places=9)
        self.assertIn('not resolved; by its 4 equal exponents', row.remark)

    def test_not_measured(self):
        k = made.wave_number(info_of(0.1), 1, 0)
        low = run(0.1, resolved=(), levels=[(0.9 * k, 6)])
        bare = recorded.Bag(recorded.Recorded(info_of(0.2)))
        found = bags(density_01=low, density_02=bare)
        rows = recorded.by_quantity(densities, found)
        for quantity in (
            'c_T at density 0.1',
            'c_L at density 0.1',
            'c_T at density 0.2',
            'v at density 0.2',
            'v - c_L at density 0.1',
            'v - c_L at density 0.2',
        ):
            verdict = rows[quantity].verdict
            self.assertEqual(verdict, 'not measured', quantity)
        self.assertEqual(recorded.pictures(self, densities, found), ['densities'])

    def test_nothing_at_all(self):
        found = {name: recorded.Bag(recorded.Recorded(info_of(0.1))) for name in densities.RUNS}
        self.assertEqual({row.verdict for row in recorded.rows(densities, found)}, {'not measured'})
        self.assertEqual(recorded.pictures(self, densities, found), [])

    def test_relations_to_c_l(self):
        """Those of the fits are as straight as ours."""
        rows = recorded.by_quantity(densities, bags())
        row = rows['c_T over c_L, farthest from its straight line']
        self.assertEqual((row.count, row.verdict), (8, 'agrees'))
        slope = np.array([paper.slope_l(one / 10) for one in range(1, 9)])
        other = np.array([paper.slope_t(one / 10) for one in range(1, 9)])
        expected = np.polyfit(slope, other, 2, w=1 / other)[0] / OFF
        found = rows['curvature of c_T over c_L, coefficient of c_L^2']
        self.assertAlmostEqual(found.measured, expected, delta=0.2 * abs(expected))

    def test_relations_without_a_density(self):
        """Slopes of a mixture, and a velocity without an error, are left out."""
        found = bags()
        lone = found['density_03'].recording
        lone.steps.steps[0].set = lone.steps.steps[1].set
        found['density_05'].recording.steps.steps[1].omega_error = -1.0
        rows = recorded.by_quantity(densities, found)
        for symbol, count in (('c_T', 7), ('v', 6)):
            row = rows[f'{symbol} over c_L, farthest from its straight line']
            self.assertEqual(row.count, count)

    def test_table(self):
        (name, header, lines), (other, columns, scales) = densities.tables(bags())
        self.assertEqual((name, len(lines)), ('densities', 8))
        self.assertEqual((other, len(scales)), ('scales', 8))
        self.assertEqual({len(one) for one in scales}, {len(columns)})
        numbers = dict(zip(columns, scales[6]))
        k = made.wave_number(info_of(0.7), 1, 0)
        self.assertEqual((numbers['k_min'], numbers['k_max']), (f'{k:.4g}',) * 2)
        self.assertEqual(numbers['v'], f'{1.08 * OFF * paper.slope_l(0.7):.4g}')
        line = dict(zip(header, lines[6]))
        self.assertEqual(line['density'], '0.7')
        self.assertAlmostEqual(float(line['c_l']), OFF * paper.slope_l(0.7), places=4)
        self.assertAlmostEqual(float(line['c_t_fit']), paper.slope_t(0.7), places=4)
        self.assertAlmostEqual(float(line['v']), 1.08 * OFF * paper.slope_l(0.7), places=4)

    def test_figure(self):
        self.assertEqual(recorded.pictures(self, densities, bags()), ['densities'])


if __name__ == '__main__':
    unittest.main()
