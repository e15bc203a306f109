"""Part 2 of the reproduction: slopes of single steps, fits, and the table of steps."""
# Second tier: tests/run.sh --all

import math
import unittest

import made
from made import LP, T
from reproduced import Part
from study.parts import dispersion


class Dispersion(Part):
    of = dispersion

    def bags(self, *found, **fields):
        info = made.paper_info()
        message = made.steps([step(info) if callable(step) else step for step in found])
        for name, value in fields.items():
            setattr(message, name, value)
        return info, {'periodic': self.bag('periodic', [info, made.cost(1), message])}

    def full(self):
        info = made.paper_info()
        return self.bags(
            made.step(info, T, 1, 0, 1556, 1557, exponent=0.62),
            made.step(info, T, 0, 1, 1554, 1555, exponent=0.9),
            made.step(info, LP, 1, 0, 1550, 1553, exponent=0.86),
            made.step(info, LP, 0, 1, 1542, 1545, exponent=1.1),
        )

    def test_fits_are_the_runs(self):
        info, bags = self.full()
        rows = self.rows(bags)
        found = [
            rows[f'{name} of lambda = c k + c2 k^2'] for name in ('c_T', 'c_T2', 'c_L', 'c_L2')
        ]
        x, y = (2 * math.pi / edge for edge in (info.box_x, info.box_y))
        for (c, c2), first, second in zip(
            (found[:2], found[2:]), (0.62, 0.86), (0.9, 1.1)  # two steps, two coefficients
        ):
            for k, exponent in ((x, first), (y, second)):
                self.assertAlmostEqual(c.measured * k + c2.measured * k * k, exponent, 9)
        self.assertEqual([row.remark for row in found], ['over 2 wave numbers'] * 4)
        self.assertEqual([row.verdict for row in found], [''] * 4)

    def test_a_fit_needs_its_wave_numbers(self):
        rows = self.rows(
            self.bags(made.step(made.paper_info(), T, 1, 0, 1556, 1557), t_points=1, l_points=0)[1]
        )
        self.assertEqual(
            [rows[f'{name} of lambda = c k + c2 k^2'].verdict for name in ('c_T2', 'c_L', 'c_L2')],
            ['not measured'] * 3,
        )
        self.assertNotIn('c_T of lambda = c k + c2 k^2', rows)
        self.assertEqual(rows['c_T of lambda = c k'].verdict, '')
        self.assertEqual(rows['c_T of lambda = c k'].remark, 'over 1 wave number')

    def test_table_and_figure(self):
        info, bags = self.full()
        header, lines = self.tables(bags)['steps']
        self.assertEqual(header[:4], ('kind', 'nx', 'ny', 'k'))
        k = f'{made.wave_number(info, 1, 0):.6f}'
        self.assertEqual(lines[0], ('T', '1', '0', k, '0.62', '0.002', '1.9800', '2', '1'))
        self.assertEqual([line[0] for line in lines], ['T', 'T', 'LP', 'LP'])
        self.assertEqual(list(self.figures(bags)), ['dispersion'])

    def test_without_steps(self):
        self.measures_nothing({'periodic': self.bag('periodic', [made.paper_info(), made.cost(1)])})


if __name__ == '__main__':
    unittest.main()
