"""Part 14 of the reproduction: runs of one trajectory that deviate by what is known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
from made import LP, T
import reproduced
from reproduced import Part
from study.parts import intervals

EXPONENTS = np.linspace(9, 3, 37)
ACCURACY = 1e-8


class Intervals(Part):
    of = intervals

    def trial(self, interval, deviation=0.0, index=20, first=36, times=(10.0, 20.0), only=2):
        """One run; its exponents are those of the time, and one of them is off."""
        info = made.run_info(interval=interval, accuracy=ACCURACY)
        messages = [info]
        for number, (stage, in_use) in enumerate(
            ((0, 9.0), (1, 5.0), (2, 2.5), (2, 0.75), (3, 0.5))
        ):
            cost = made.cost(100.0 + number)
            cost.interval, cost.orthonormalisations = min(in_use, interval), 4 * number
            cost.error_bound = 3e-10
            messages += [cost, made.status(100.0 + number, stage=stage)]
        for time in times:
            exponents = EXPONENTS + 0.1 / time
            exponents[index - 1] += deviation
            messages.append(made.spectrum(exponents, time))
        steps = [made.step(info, T, 1, 0, first, first + 1), made.step(info, LP, 1, 0, 32, 35)]
        return self.bag(f'interval_{interval:g}', [*messages, made.steps(steps[:only])])

    def bags(self, *trials):
        return {f'interval_{number}': trial for number, trial in enumerate(trials)}

    def test_runs(self):
        found = reproduced.part_of(intervals).runs
        self.assertEqual(len(found), len(set(found)))
        for start, count in (('interval_', 5), ('independent_0_5_', 6), ('independent_8_', 6)):
            self.assertEqual(sum(name.startswith(start) for name in found), count)

    def test_deviations_are_of_one_time(self):
        """The last run has averaged for longer; that is no deviation."""
        rows = self.rows(
            self.bags(
                self.trial(8.0, 1e-9, times=(10.0, 20.0, 20.5)),
                self.trial(0.25),
                self.trial(1.0, -3e-8, index=5),
            )
        )
        far, near = (
            rows[f'largest deviation, interval {name} from 0.25']
            for name in (1, '8 (longest in use 2.50)')
        )
        rounding = 10 * np.finfo(float).eps * 10
        self.assertAlmostEqual(far.measured, 3e-8, delta=rounding)
        self.assertAlmostEqual(near.measured, 1e-9, delta=rounding)
        self.assertEqual(
            (far.verdict, near.verdict, far.published, far.left_open),
            ('differs', 'agrees', 0.0, 2 * ACCURACY),
        )
        self.assertTrue(far.remark.startswith('index 5 of 37, averaged over 20'), far.remark)
        self.assertTrue(near.remark.startswith('index 20 of 37, averaged over 20'), near.remark)
        self.assertEqual(near.cells()[2], '1.0e-09')

    def test_no_common_time(self):
        bags = self.bags(self.trial(0.25, times=(10.0,)), self.trial(1.0, times=(11.0,)))
        row = self.rows(bags)['largest deviation, interval 1 from 0.25']
        self.assertEqual(row.verdict, 'not measured')
        self.assertEqual(self.figures(bags), {})

    def test_interval_in_use(self):
        """Of the averaging, not of the time before it."""
        rows = self.rows(self.bags(self.trial(0.25), self.trial(8.0)))
        row = rows['asked 8']
        self.assertEqual((row.measured, row.remark), (2.5, 'mean 0.25'))
        self.assertEqual(rows['asked 0.25'].measured, 0.25)

    def test_what_other_programs_get_where_the_interval_was_not_taken(self):
        rows = self.rows(self.bags(self.trial(0.25), self.trial(1.0), self.trial(8.0)))
        said = {
            name: '2.36' in rows[f'largest deviation, interval {name} from 0.25'].remark
            for name in (1, '8 (longest in use 2.50)')
        }
        self.assertEqual(list(said.values()), [False, True])

    def test_indices(self):
        rows = self.rows(self.bags(self.trial(0.25), self.trial(1.0), self.trial(8.0, first=35)))
        same, other = (
            rows[f'indices of all steps, interval {name} and 0.25']
            for name in (1, '8 (longest in use 2.50)')
        )
        self.assertEqual(
            (same.measured, same.verdict, same.remark), ('the same', 'agrees', '2 sets')
        )
        self.assertEqual((other.measured, other.verdict), ('1 differ', 'differs'))
        self.assertEqual(other.remark, '2 sets; differ: T(1,0)')

    def test_a_step_found_in_one_run_alone(self):
        long = self.trial(8.0, only=1)
        row = self.rows(self.bags(self.trial(0.25), long))[
            'indices of all steps, interval 8 (longest in use 2.50) and 0.25'
        ]
        self.assertEqual((row.measured, row.verdict), ('the same', 'agrees'))
        self.assertEqual(row.remark, '1 sets; found in one run alone: LP(1,0)')

    def independent(self, interval, number, largest, error=0.01):
        """One run of them; its h_KS is twice the largest exponent, its T(1,0) a tenth."""
        info = made.run_info(interval=interval)
        cost = made.cost(100.0)
        cost.interval = min(interval, 2.5)
        spectrum = made.spectrum([largest, 1.0], 20.0, error=error)
        spectrum.ks_entropy, spectrum.ks_entropy_error = 2 * largest, 2 * error
        step = made.step(info, T, 1, 0, 36, 37, exponent=0.1 * largest, std_error=0.1 * error)
        status = made.status(100.0, stage=2)
        messages = [info, status, cost, spectrum, made.steps([step])]
        name = f'independent_{interval:g}_{number}'
        return {name: self.bag(name, messages)}

    def compared(self, short, long, error=0.01):
        bags = self.bags(self.trial(0.25), self.trial(1.0))
        for interval, values in ((0.5, short), (8.0, long)):
            for number, value in enumerate(values):
                bags.update(self.independent(interval, number, value, error))
        claim = self.claims(bags)['exponents do not depend on the interval: independent runs']
        return claim, {row.quantity.partition(':')[0]: row for row in claim.rows}

    def test_independent_runs(self):
        """Means of four and of three; errors of the runs, which scatter no more."""
        claim, rows = self.compared([9.0] * 4, [9.09] * 3)
        for name, value in (('lambda_1', 9.0), ('h_KS', 18.0), ('T(1,0)', 0.9)):
            row = rows[name]
            self.assertAlmostEqual(row.measured, 1.0, places=9)
            relative = 0.01 / 9 * np.hypot(1 / 4**0.5, 9 / 9.09 / 3**0.5)
            self.assertAlmostEqual(row.error, 101 * relative, places=9)
            self.assertEqual(row.verdict, 'differs')
            self.assertEqual(
                row.remark, '3 runs of interval 8 (longest in use 2.50) over 4 runs of interval 0.5'
            )
        self.assertEqual(rows['T(0,1)'].verdict, 'not measured')
        self.assertEqual((claim.verdict, claim.values), ('differs', 3))

    def test_errors_of_independent_runs_are_their_scatter(self):
        claim, rows = self.compared([8.9, 9.0, 9.1, 9.0], [9.0, 9.09, 9.0, 9.0])
        scatter = [np.std(one, ddof=1) / 2 for one in ([8.9, 9.0, 9.1, 9.0], [0.09, 0, 0, 0])]
        row = rows['lambda_1']
        self.assertAlmostEqual(row.error / 100, np.hypot(*scatter) / 9, delta=1e-4)
        self.assertEqual((row.verdict, claim.verdict), ('agrees', 'agrees'))
        claim, _ = self.compared([9.0] * 4, [9.0] * 4, error=0.1)
        self.assertEqual(claim.verdict, 'not decided')

    def test_figure(self):
        (axes,) = self.figures(self.bags(self.trial(0.25), self.trial(1.0, 1e-9)))['intervals'].axes
        drawn = axes.lines[0].get_ydata()
        self.assertEqual(np.argmax(drawn), 19)
        self.assertAlmostEqual(drawn[19] / 1e-9, 1, delta=1e-4)
        self.assertEqual(drawn[0], intervals.ROUNDING)

    def test_tables(self):
        tables = self.tables(self.bags(self.trial(0.25), self.trial(1.0, 1e-9)))
        header, lines = tables['runs']
        line = dict(zip(header, lines[1]))
        info = made.run_info()
        expected = {
            'interval': '1',
            'longest_in_use': '1',
            'mean_in_use': '0.25',
            'error_bound': '3e-10',
            'c_T': '1.4',
            'c_L': '1.5',
            'v': '1.612',
            'lambda_max': '9.005',
        }
        self.assertEqual({name: line[name] for name in expected}, expected)
        self.assertAlmostEqual(
            float(line['T(1,0)_exponent']), made.exponent(info, T, 1, 0), delta=1e-8
        )
        self.assertEqual(
            (line['T(1,0)_multiplicity'], line['LP(1,0)_multiplicity']), ('1.98', '3.96')
        )
        self.assertEqual(tables['indices'][1][0], ('0.25', 'T(1,0)', '36-37'))
        self.assertEqual(tables['deviations'][1][19], ('20', '1.0e-09'))

    def test_without_spectrum_and_steps(self):
        bags = {
            f'interval_{number}': self.bag(f'interval_{number}', [made.run_info(interval=number)])
            for number in (1.0, 2.0)
        }
        self.measures_nothing(bags)


if __name__ == '__main__':
    unittest.main()
