"""Part 3 of the reproduction: angles and ratios of the two halves of made vectors."""
# Second tier: tests/run.sh --all

import unittest
from unittest import mock

import numpy as np

import made
from reproduced import Part
from study.parts import coordinates

DISKS, END = 20, 37  # of 80 vectors 38 .. 43 are zero modes
COUNT = 4 * DISKS
REPORTS = 20
ACCURACY = 1e-8
ROUNDING = 1e3 * np.finfo(float).eps
EXPONENTS = np.concatenate(
    [np.linspace(9, 2, END), [0.04, 0.02, 0.01, -0.01, -0.02, -0.04], np.linspace(-2, -9, END)]
)
EXPONENTS[29] += 0.5
ANGLES = 'cos Theta_l + cos Theta_(4N+1-l)'


def symmetric():
    """(cos Theta, ratio) of vectors as the symplectic symmetry wants them."""
    cos = np.concatenate([np.linspace(0.8, 0.99, COUNT // 2), -np.linspace(0.99, 0.8, COUNT // 2)])
    ratio = np.concatenate([np.linspace(8, 0.5, COUNT // 2), 1 / np.linspace(0.5, 8, COUNT // 2)])
    return cos, ratio


def spectrum(cos, ratio, time):
    made_spectrum = made.spectrum(EXPONENTS, time, pairing_error=0.25)
    made_spectrum.cos_theta, made_spectrum.dp_dq_ratio = cos, ratio
    return made_spectrum


class Coordinates(Part):
    of = coordinates

    def bags(self, *spectra, zeros=38, **fields):
        info = made.run_info(accuracy=ACCURACY, **fields)
        return {
            'halves': self.bag(
                'halves', [info, made.cost(1), *spectra, made.steps([made.zero_modes(zeros)])]
            )
        }

    def full(self, change=lambda cos, ratio, report: None):
        """A report of before the averaging, and all of it; change(cos, ratio, number of the report)
        in place."""
        spectra = [spectrum(-symmetric()[0], symmetric()[1], 0.0)]
        for report in range(REPORTS):
            cos, ratio = symmetric()
            change(cos, ratio, report)
            spectra.append(spectrum(cos, ratio, 2.0 * (report + 1)))
        return self.bags(*spectra)

    def test_cosines_beside_the_zero_modes(self):
        def change(cos, ratio, report):
            cos[END - 1] = 1.0 - 0.01 * (report // 2)  # pairs of reports are a block
            cos[END + 6] = -0.95

        rows = self.rows(self.full(change))
        below, above = (
            rows[f'cos Theta just {where} the zero modes, index {index}']
            for where, index in (('below', 37), ('above', 44))
        )
        self.assertEqual((below.published, above.published, below.verdict), (None, None, ''))
        self.assertAlmostEqual(below.measured, 1 - 0.045, delta=ROUNDING)
        self.assertAlmostEqual(
            below.error, 0.01 * np.std(range(10), ddof=1) / np.sqrt(10), delta=ROUNDING
        )
        self.assertAlmostEqual(above.measured, -0.95, delta=ROUNDING)
        self.assertEqual(below.remark, 'mean over 20 reports')

    def test_cosines_beside_the_papers_of_its_size_alone(self):
        with mock.patch.object(
            coordinates.paper, 'DISKS', DISKS
        ):  # as if its run had been as small
            rows = self.rows(
                self.full(
                    lambda cos, ratio, report: cos.__setitem__([END - 1, END + 6], [0.99, -0.95])
                )
            )
        below, above = (
            rows[f'cos Theta just {where} the zero modes, index {index}']
            for where, index in (('below', 37), ('above', 44))
        )
        self.assertEqual((below.published, above.published, below.left_open), (1.0, -1.0, 0.02))
        self.assertEqual((below.verdict, above.verdict), ('agrees', 'differs'))

    def test_symmetric_vectors(self):
        rows = self.rows(self.full())
        for quantity in (
            "ln(C / C'), mean over the positive half",
            f'{ANGLES}, mean over the positive half',
            "largest mean |C / C' - 1|",
            f'largest mean |{ANGLES}|',
            'sum of |dq|^2 less |dp|^2 of the conjugates, positive half',
        ):
            self.assertAlmostEqual(rows[quantity].measured, 0.0, delta=ROUNDING)
        pairing = rows['pairing error, max |lambda_l + lambda_(4N+1-l)|']
        self.assertEqual(pairing.measured, 0.25)
        total = rows['sum of the exponents of both halves']
        self.assertAlmostEqual(total.measured, 0.5, delta=ROUNDING)

    def test_one_vector_off_in_one_report(self):
        def change(cos, ratio, report):
            if report == 7:
                ratio[4] *= 2
                cos[10] += 0.1

        symmetric_ratio = symmetric()[1][4]
        rows = self.rows(self.full(change))
        self.assertAlmostEqual(
            rows["ln(C / C'), mean over the positive half"].measured,
            np.log(2) / END / REPORTS,
            delta=ROUNDING,
        )
        largest = rows["largest mean |C / C' - 1|"]
        self.assertAlmostEqual(largest.measured, 1 / REPORTS, delta=ROUNDING)
        self.assertTrue(largest.remark.startswith('index 5;'), largest.remark)
        angle = rows[f'largest mean |{ANGLES}|']
        self.assertAlmostEqual(angle.measured, 0.1 / REPORTS, delta=ROUNDING)
        self.assertTrue(angle.remark.startswith('index 11;'), angle.remark)
        excess = rows['sum of |dq|^2 less |dp|^2 of the conjugates, positive half']
        self.assertAlmostEqual(
            excess.measured,
            1 / (1 + symmetric_ratio**2) - 1 / (1 + 4 * symmetric_ratio**2),
            delta=ROUNDING,
        )
        self.assertEqual((excess.verdict, excess.left_open), ('differs', ACCURACY))

    def test_two_vectors_that_mix_leave_what_they_span(self):
        """Of |dq|^2 the one has more by what the other has less: no excess, though C and C'
        differ."""

        def change(cos, ratio, report):
            dq2 = 1 / (1 + ratio[4:6] ** 2)
            ratio[4:6] = np.sqrt(1 / (dq2 + [0.01, -0.01]) - 1)

        rows = self.rows(self.full(change))
        self.assertGreater(rows["largest mean |C / C' - 1|"].measured, 0.1)
        self.assertAlmostEqual(
            rows['sum of |dq|^2 less |dp|^2 of the conjugates, positive half'].measured,
            0.0,
            delta=ROUNDING,
        )

    def test_zero_modes_beside_the_papers_of_its_size_alone(self):
        ends = ('first zero exponent', 'last zero exponent')
        rows = self.rows(self.full())
        self.assertEqual(
            [(rows[name].published, rows[name].measured) for name in ends], [(None, 38), (None, 43)]
        )
        self.assertEqual(rows[ends[0]].remark, '38-43, by their size')
        large = np.linspace(9, 2, 1557)
        for zeros, found, verdict in (
            ([0.04, 0.02, 0.01], [1558, 1563], 'agrees'),
            ([1.9, 0.02, 0.01], [1559, 1562], 'differs'),
        ):  # whatever the scene says
            exponents = [*large, *zeros, *-np.array(zeros[::-1]), *-large[::-1]]
            rows = self.rows(self.bags(made.spectrum(exponents, 20.0), zeros=1558, disks=780))
            self.assertEqual([rows[name].published for name in ends], [1558, 1563])
            self.assertEqual(
                [(rows[name].measured, rows[name].verdict) for name in ends],
                [(index, verdict) for index in found],
            )
        rows = self.rows(self.bags(zeros=1558, disks=780))
        self.assertEqual([rows[name].verdict for name in ends], ['not measured'] * 2)
        self.assertEqual(
            rows['cos Theta just below the zero modes, index 1557'].verdict, 'not measured'
        )

    def test_zero_modes_beside_the_limits(self):
        """Their angle falls like the inverse of the age of the frame: 3 / age here."""

        def change(cos, ratio, report):
            age = spectrum(cos, ratio, 2.0 * (report + 1)).sim_time - made.run_info().equilibration
            cos[END : END + 3] = 1 - 0.5 * (3.0 / age) ** 2
            cos[END + 3 : END + 6] = -cos[END]

        rows = self.rows(self.full(change))
        shown = [name for name in rows if name.startswith('|cos Theta| of zero mode ')]
        self.assertEqual(len(shown), 6)
        row = rows['|cos Theta| of zero mode 41']
        self.assertTrue(row.remark.startswith('cos Theta -0.9'), row.remark)
        self.assertTrue(row.remark.endswith('of the frame: 3.00 to 3.00'), row.remark)

    def test_independent_pairs(self):
        """EXPONENTS are no pairs but for what is set so: chi^2 of the vectors of steps."""
        info = made.run_info(accuracy=ACCURACY)
        steps = made.steps([made.step(info, made.T, 1, 0, 36, 37)])
        for off, verdict in ((0.0, 'agrees'), (0.08, 'differs')):
            half = np.linspace(3, 1, END)
            exponents = [*half, *[0.0] * (COUNT - 2 * END), *-half[::-1]]
            exponents[-37] += off
            last = made.spectrum(exponents, 20.0, error=1e-3)
            last.cos_theta, last.dp_dq_ratio = symmetric()
            bags = {'halves': self.bag(f'halves{off}', [info, last, steps])}
            rows = self.rows(bags)
            row = rows['lambda_l + lambda_(4N+1-l) of the vectors of steps']
            self.assertAlmostEqual(row.measured, off**2 / 2 / 1e-6, delta=1e-6)
            self.assertEqual((row.published, row.verdict), (2, verdict))
            total = rows['sum of the exponents of both halves']
            self.assertAlmostEqual(total.measured, off, delta=1e-9)
            self.assertEqual((total.left_open, total.verdict), (2 * ACCURACY, verdict))

    def test_independent_pairs_of_unknown_error(self):
        """Of a run that is too short for errors: no chi^2."""
        steps = made.steps([made.step(made.run_info(), made.T, 1, 0, 36, 37)])
        last = made.spectrum(np.linspace(3, -3, COUNT), 20.0, error=-1.0)
        last.cos_theta, last.dp_dq_ratio = symmetric()
        bags = {'halves': self.bag('halves', [made.run_info(accuracy=ACCURACY), last, steps])}
        row = self.rows(bags)['lambda_l + lambda_(4N+1-l) of the vectors of steps']
        self.assertEqual((row.measured, row.verdict), (None, 'not measured'))

    def test_cosines_of_steps(self):
        rows = self.rows(self.full())
        cos, _ = symmetric()
        self.assertAlmostEqual(
            rows['cos Theta of largest exponent'].measured, cos[0], delta=ROUNDING
        )
        self.assertAlmostEqual(
            rows['cos Theta of the positive half, mean'].measured, cos[:END].mean(), delta=ROUNDING
        )
        steps = made.steps([made.step(made.run_info(), made.T, 1, 0, 36, 37)])
        info = made.run_info(accuracy=ACCURACY)
        spectra = [spectrum(*symmetric(), 2.0 * report) for report in range(1, REPORTS)]
        bags = {'halves': self.bag('halves', [info, *spectra, steps])}
        row = self.rows(bags)['cos Theta of T(1,0)']
        self.assertAlmostEqual(row.measured, cos[35:37].mean(), delta=ROUNDING)
        self.assertEqual(row.remark, 'indices 36-37')

    def test_figure(self):
        def change(cos, ratio, report):
            ratio[-5] *= 2

        whole, near, ratio = self.figures(self.full(change))['coordinates'].axes
        cos, symmetric_ratio = symmetric()
        np.testing.assert_allclose(whole.lines[0].get_ydata(), cos)
        np.testing.assert_allclose(near.lines[0].get_xdata(), range(END + 1 - 20, END + 6 + 21))
        self.assertEqual(near.get_title(loc='left'), '(b) shaded: zero modes 38-43')
        np.testing.assert_allclose(near.lines[0].get_ydata(), cos[END - 20 : END + 26])
        conjugate, own = (line.get_ydata() for line in ratio.lines[:2])
        np.testing.assert_allclose(own, symmetric_ratio[:END])
        np.testing.assert_allclose(
            conjugate, symmetric_ratio[:END] / np.where(np.arange(END) == 4, 2, 1)
        )

    def test_tables(self):
        tables = self.tables(self.full())
        self.assertEqual(len(tables['cos_theta'][1]), COUNT)
        self.assertEqual(tables['cos_theta'][1][0][:2], ('1', '0.80000'))
        self.assertEqual(tables['ratios'][1][0][:4:3], ('1', '8'))
        self.assertEqual(len(tables['ratios'][1]), END)

    def test_half_of_the_vectors(self):
        info = made.run_info()
        self.measures_nothing(
            {'halves': self.bag('halves', [info, made.spectrum(EXPONENTS[:END], 1.0)])}
        )


if __name__ == '__main__':
    unittest.main()
