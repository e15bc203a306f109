"""Tables for a paper: numbers with their errors, units, LaTeX."""

import os
import unittest

import numpy as np

import hdlyap
import made
from bags import Bags
from made import LP, T
from hdlyap.plots import latex, report
from hdlyap.sweep import points, table

INFO = made.run_info()
HALF = np.linspace(9, 3, 37)


class Printed(Bags):
    def bag(self, name, density=0.5, seed='1', shift=0.0, **fields):
        info = made.run_info(density=density, seed=seed, run_id=name)
        found = [made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)]
        message = made.steps([*found, made.step(info, T, 1, 0, 44, 45, conjugate=True)])
        message.run_id = name
        for key, value in fields.items():
            setattr(message, key, value)
        gas, spectrum = made.gas(run_id=name), made.spectrum(HALF + shift, 50.0, run_id=name)
        return self.write([info, spectrum, message, gas], name)

    def test_of_a_run(self):
        found = hdlyap.load(self.bag('one', t_points=1, t_prior_share=1.0)).table()
        rows = {name: tuple(row) for name, row in found.iterrows()}
        self.assertEqual(rows['lambda_max'], ('9.000(10)', '1/time unit', ''))
        self.assertEqual(rows['h_KS'], ('222.00(37)', '1/time unit', ''))
        self.assertEqual(rows['h_KS/N'], ('11.100(18)', '1/time unit', ''))
        self.assertEqual(rows['c_T'], ('1.400(12)', 'sigma/time unit', ''))
        self.assertEqual(rows['c_L2'][0], '0.50(10)')
        self.assertNotIn('c_T2', rows)  # it is assumed
        self.assertEqual(rows['pressure'], ('1.250(10)', '1/sigma^2', ''))
        self.assertEqual(rows['T(1,0)'], ('1.4895(20)', '1/time unit', '0.99346'))
        self.assertNotIn('T(1,0)*', rows)

    def test_of_seeds(self):
        """The larger one of both errors: here that of the scatter, 0.1 / sqrt(2)."""
        paths = [self.bag(str(k), seed=str(k), shift=0.1 * k) for k in (1, 2)]
        self.assertEqual(hdlyap.load(*paths).table().loc['lambda_max', 'value'], '9.150(50)')
        assumed = {'t_points': 1, 't_prior_share': 1.0}
        for more, there in (({}, True), (assumed, False)):
            paths = [self.bag(f'{k}{there}', seed=str(k), **more) for k in (1, 2)]
            text = report.report(hdlyap.load(*paths).summary)
            self.assertIn('\n  c_T  ', text)
            self.assertEqual('\n  c_T2 ' in text, there)

    def test_latex_of_a_run(self):
        (point,) = points.read([self.bag('one')])[0]
        for style, number in (('plain', '$1.400(12)$'), ('siunitx', r'\num{1.400(12)}')):
            lines = list(table.latex([point], style))
            self.assertIn(rf'$c_{{\mathrm{{T}}}}$ &  & {number} & $\sigma$/time unit \\', lines)
            self.assertIn(r'\end{tabular}', lines)
        self.assertTrue(any(line.startswith('T(1,0) & ') for line in lines))

    def test_latex_of_several(self):
        """What is the same in all is said above; few systems have a column each."""
        found, _ = points.read([self.bag(f'b{k}', 0.4 + 0.1 * k) for k in range(5)])
        said, _, _, head, units, _, *rows = table.latex(found, 'plain')
        same = '% the same in all: number 20, aspect 1, boundary periodic'
        self.assertEqual(said, same + ', seeds 1, averaged time 50')
        self.assertTrue(head.startswith(r'$\rho$ & packing & $\lambda_\mathrm{max}$ & '), head)
        self.assertTrue(units.startswith(r'[1/$\sigma^2$] &  & [1/time unit] & '), units)
        self.assertTrue(rows[0].startswith('$0.4$ & $0.3142$ & $9.000(10)$ & '), rows[0])
        self.assertIn(r' & $3.250(20)$ & $1.250(10)$ \\', rows[0])  # of the gas
        _, begin, _, head, _, packing, *rows = table.latex(found[:2], 'siunitx')
        self.assertEqual(begin, r'\begin{tabular}{llll}')
        self.assertEqual(head, r'$\rho$ & 1/$\sigma^2$ & \num{0.4} & \num{0.5} \\')
        self.assertEqual(packing, r'packing &  & \num{0.3142} & \num{0.3927} \\')
        pressure = r'pressure & 1/$\sigma^2$ & \num{1.250(10)} & \num{1.250(10)} \\'
        self.assertIn(pressure, rows)

    def test_command(self):
        path = self.bag('one')
        text = self.succeeds('table', path, '--latex', 'siunitx', '--out', self.out)
        self.assertIn(r'\num{9.000(10)}', text)
        self.assertIn('sweep.tex', os.listdir(self.out))


class Latex(unittest.TestCase):
    def test_cell(self):
        for text, plain, siunitx in (
            ('0.61252(67)', '$0.61252(67)$', r'\num{0.61252(67)}'),
            ('12.3(1.5)', '$12.3(1.5)$', r'\num{12.3 +- 1.5}'),
            ('1234(23)', '$1234(23)$', r'\num{1234(23)}'),
            ('-2.35(50)', '$-2.35(50)$', r'\num{-2.35(50)}'),
            ('3.8e-16', r'$3.8\times 10^{-16}$', r'\num{3.8e-16}'),
            ('-', '--', '--'),
            ('number_16', r'number\_16', r'number\_16'),
        ):
            self.assertEqual(
                (latex.cell(text, 'plain'), latex.cell(text, 'siunitx')), (plain, siunitx)
            )

    def test_names_and_units(self):
        self.assertEqual(latex.symbol('c_L3'), r'$c_{\mathrm{L},3}$')
        self.assertEqual(latex.symbol('collision_rate'), 'collision rate')
        self.assertEqual(latex.symbol('kaplan_yorke'), 'Kaplan-Yorke dimension')
        self.assertEqual(latex.unit('sigma^2/time unit'), r'$\sigma^2$/time unit')
        self.assertEqual(latex.unit('kg m^2 s^-12'), r'kg m$^2$ s$^{-12}$')
        for text, wanted in (
            ('% of J_0', r'\% of J\_0'),
            ('{x}~\\^y', r'\{x\}\textasciitilde{}\textbackslash{}\textasciicircum{}y'),
        ):
            self.assertEqual(latex.unit(text), wanted)
            self.assertEqual(latex.cell(text, 'plain'), wanted)
