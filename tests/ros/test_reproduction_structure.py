"""Part 15 of the reproduction against structure factors and lines that are known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import test_structure
from made import LP, T
from reproduced import Part
from study.parts import structure

PERIODIC, REFLECTING = structure.RUNS
V = test_structure.OMEGA
REPORTS = 160  # a time unit apart
LP_LINE = 'omega / v k of LP(1,0), periodic'
T_LINE = 'omega over v k of LP modes there, T(1,0), periodic'


class Structure(Part):
    of = structure

    def found(self, info):
        return [made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)]

    def messages(self, boundary='periodic', reports=REPORTS, change=None, **told):
        info = made.run_info(boundary_x=boundary, boundary_y=boundary)
        found = self.found(info)
        course = [
            test_structure.message(info, 100.0 + t, found, means=t > reports - 3, **told)
            for t in range(reports)
        ]
        for one in course if change else ():
            change(one)
        last = made.steps(found, 60.0)
        last.v, last.v_error = V, 0.002 * V
        return [info, made.spectrum(np.linspace(9, 3, 37), 60.0), last, *course]

    def bags(self, name='', **told):
        return {
            PERIODIC: self.bag('periodic' + name, self.messages(**told)),
            REFLECTING: self.bag('reflecting', self.messages('reflecting')),
        }

    def verdicts(self, *arguments, **told):
        return [claim.verdict for claim in self.claims(self.bags(*arguments, **told)).values()]

    def test_as_classified(self):
        bags = self.bags()
        self.assertEqual([one.verdict for one in self.claims(bags).values()], 3 * ['agrees'])
        rows = self.rows(bags)
        peak = rows['peak of LP(1,0), reflecting']
        self.assertEqual((peak.published, peak.measured), 2 * ('(1,0) along',))
        self.assertEqual(peak.remark, '4 vectors; S 8.0, elsewhere at most 0.5')
        self.assertEqual(rows['peak of T(1,0), periodic'].measured, '(1,0) across')
        self.assertAlmostEqual(rows[LP_LINE].measured, 1.0, delta=0.01)
        line = rows[T_LINE]
        self.assertEqual(line.measured, 0.0)
        k = made.wave_number(made.run_info(), 1, 0)
        self.assertAlmostEqual(line.left_open, 4 * np.pi / (REPORTS - 1) / (V * k))

    def test_another_wave_or_direction(self):
        """Of a single vector."""
        shape = 2, len(test_structure.WAVES), 37

        def elsewhere(one):
            along, across = (np.array(part, dtype=float) for part in (one.along, one.across))
            if len(along):
                along.reshape(shape[1:])[2, 34] = 9.0
                one.along = along

        def across(one):
            one.along, one.across = one.across, one.along

        for name, change, lp in (
            ('a', elsewhere, '(1,0) along, (1,1) along'),
            ('b', across, '(1,0) across'),
        ):
            bags = self.bags(name, change=change)
            row = self.rows(bags)['peak of LP(1,0), periodic']
            self.assertEqual((row.measured, row.verdict), (lp, 'differs'))

    def test_lines_elsewhere(self):
        """LP modes that turn 4 % faster, T modes that turn."""
        for name, omega, verdicts in (
            ('slow', (0.96 * V, 0.0), ['agrees', 'differs', 'agrees']),
            ('fast', (1.04 * V, 0.0), ['agrees', 'differs', 'agrees']),
            ('turning', (V, 0.2 * V), ['agrees', 'agrees', 'differs']),
            ('standing', (0.0, 0.0), ['agrees', 'differs', 'agrees']),
        ):
            self.assertEqual(self.verdicts(name, omega=omega), verdicts, name)

    def test_too_short_to_tell(self):
        """Half of a line's width is 0.13 of v k."""
        row = self.rows(self.bags(reports=60))[T_LINE]
        self.assertEqual((row.measured, row.verdict), (0.0, 'not decided'))
        row = self.rows(self.bags('b', reports=10))[T_LINE]
        self.assertEqual(row.verdict, 'not measured')

    def test_steps_that_share_vectors_are_left_out(self):
        messages = self.messages()
        for step in messages[2].steps:
            step.set, step.members = 32, 2
            step.first_index, step.last_index = 32, 37
        bags = self.bags()
        bags[PERIODIC] = self.bag('mixed', messages)
        self.assertFalse([name for name in self.rows(bags) if 'periodic' in name])

    def test_figures_and_table(self):
        bags = self.bags()
        self.assertEqual(list(self.figures(bags)), list(structure.RUNS))
        header, lines = self.tables(bags)['structure']
        self.assertEqual(len(lines), 4)
        line = dict(zip(header, lines[1]))
        self.assertEqual((line['step'], line['peak'], line['elsewhere']), ('LP(1,0)', '8', '0.5'))
        self.assertAlmostEqual(float(line['omega']) / float(line['v_k']), 1.0, delta=0.01)

    def test_nothing_measured(self):
        messages = [made.run_info(), made.cost(1)]
        bags = {name: self.bag(name, messages) for name in structure.RUNS}
        self.measures_nothing(bags)
        self.assertEqual(self.tables(bags)['structure'][1], [])


if __name__ == '__main__':
    unittest.main()
