"""hdlyap plot against bags that are made here: the table that it prints."""

import math

import numpy as np

from hdlyap.msg import Step

import made
from bags import Bags
from made import LP, T
from hdlyap.plots import paper, report

INFO = made.run_info()
HALF = np.linspace(3, 1, 37)
LOW, HIGH = made.step(INFO, T, 1, 0, 36, 37), made.step(INFO, LP, 1, 0, 32, 35)


class Table(Bags):
    """Made steps: c = 1.4 and 1.5, c2 = 0.1 and 0.5, in a box of 6.3246 x 6.3246: k = 0.99346."""

    def lines(self, *messages):
        """The text as {first word of a line: rest of its words}, and the text."""
        text = report.report(self.recorded(messages))
        return {words[0]: words[1:] for words in map(str.split, text.splitlines()) if words}, text

    def run_with(self, *known, info=INFO, exponents=HALF, averaged_time=50.0, **fields):
        message = made.steps(list(known), averaged_time)
        for name, value in fields.items():
            setattr(message, name, value)
        return self.lines(info, made.spectrum(exponents, 50.0), message)

    def test_steps(self):
        """The lowest comes first."""
        high = made.step(INFO, LP, 1, 0, 32, 35, std_error=-1.0)
        lines, text = self.run_with(high, LOW, made.zero_modes())
        self.assertIn('at least 50 % of the expected multiplicity', text)
        self.assertEqual(lines['T(1,0)'], ['36-37', '1.98', '2', '0.99346', '1.4895(20)'])
        self.assertEqual(lines['LP(1,0)'], ['32-35', '3.96', '4', '0.99346', '1.98367'])
        self.assertLess(text.index('T(1,0)'), text.index('LP(1,0)'))
        self.assertIn('zero modes not carried', text)
        self.assertNotRegex(text, r'resolved \(|Eckmann|LP dynamics')

    def test_disks_that_keep_their_places(self):
        said = 'disks have kept their places since the averaging began: errors are those'
        for caged in (False, True):
            with self.subTest(caged=caged):
                status = made.status(50.0, caged=caged)
                _, text = self.lines(INFO, made.spectrum(HALF, 50.0), status)
                self.assertEqual(said in text, caged)

    def test_steps_that_share_a_set(self):
        shared = dict(set=7, members=2, expected=4)
        unknown = dict(shared, sharing=Step.SHARING_UNKNOWN)
        lines, text = self.run_with(
            made.step(INFO, T, 1, 1, 26, 33, multiplicity=3.9, **unknown),
            made.step(INFO, LP, 0, 1, 26, 33, multiplicity=3.5, **unknown),
        )
        self.assertEqual(lines['LP(0,1)+T(1,1)'], ['26-33', '7.40', '8'])
        self.assertEqual(lines['T(1,1)'], ['3.90', '4', '1.40496', '2.1643(20)'])
        self.assertEqual(lines['LP(0,1)'], ['3.50', '4', '0.99346', '1.9837(20)'])
        self.assertIn('\n    T(1,1) ', text)
        for first, second, words in (
            (Step.SHARING_COINCIDENT, Step.SHARING_COINCIDENT, ['coincide']),
            (Step.SHARING_BLENDED, Step.SHARING_BLENDED, ['blended']),
            (Step.SHARING_MIXING, Step.SHARING_COINCIDENT, ['coincide,', 'mixing']),
        ):
            lines, _ = self.run_with(
                made.step(INFO, T, 1, 1, 26, 33, sharing=first, multiplicity=3.5, **shared),
                made.step(INFO, LP, 0, 1, 26, 33, sharing=second, multiplicity=3.5, **shared),
            )
            self.assertEqual(lines['LP(0,1)+T(1,1)'], ['26-33', '7.00', '8', *words])

    def test_unresolved_steps_in_one_line(self):
        lost = [made.unresolved(INFO, kind, 2, 2, n) for kind, n in ((LP, 8), (T, 4))]
        _, text = self.run_with(LOW, *lost, made.zero_modes())
        self.assertIn('\n  not resolved (2): LP(2,2) T(2,2)\n', text)
        _, text = self.run_with(*(made.unresolved(INFO, T, n, 10, 4) for n in range(100)))
        line = next(line for line in text.splitlines() if 'not resolved (' in line)
        self.assertRegex(line, r'^  not resolved \(100\): T\(0,10\) .* and \d+ more$')
        self.assertLessEqual(len(line), 104)
        self.assertEqual(line.count('T(') + int(line.split()[-2]), 100)

    def test_both_halves(self):
        for zero, said in (
            (made.zero_modes(38), r'zero modes +38-43 +6\.00 +6 +0\.000100\(30\)'),
            (made.zero_modes(), 'zero modes not found'),
        ):
            _, text = self.run_with(zero, exponents=np.linspace(3, 0, 43))
            self.assertRegex(text, said)
        mirrored = made.step(INFO, T, 1, 0, 44, 45, conjugate=True, exponent=-LOW.exponent + 3e-6)
        lost = made.unresolved(INFO, LP, 1, 0, 4)
        lost.conjugate = True
        _, text = self.run_with(LOW, mirrored, lost)
        self.assertIn('half: 1 of 2 resolved, largest |sum with its partner| 3.0e-06', text)
        self.assertEqual(text.count('T(1,0)'), 1)

    def test_fits(self):
        lines, text = self.run_with(LOW)
        for name, value in (
            ('c_T', '1.400(12)'),
            ('c_T2', '0.100(34)'),
            ('c_T3', '0.200(50)'),
            ('c_L', '1.500(20)'),
            ('c_L2', '0.50(10)'),
            ('c_L3', '0.70(10)'),
            ('v', '1.612(23)'),
        ):
            self.assertEqual(lines[name], [value], name)
        form, long = 'steps: c k + c2 k^2 + c3 k^3 over', '% of the curvature from long boxes'
        for basis in (
            f'T {form} 3 wave numbers 0.9935 .. 1.987 (lever arm 2), 25 {long}, misfit 1.2\n  c_T ',
            f'LP {form} 2 wave numbers 0.9935 .. 1.405 (lever arm 1.41), 50 {long}\n  c_L ',
            '|omega| / k of the LP phases at 0.9935 .. 1.405, 8 of them, misfit 2.5\n  v ',
        ):
            self.assertIn('\n  ' + basis, text)
        few = dict(t_points=1, t_prior_share=1.0, t_k_max=0.99346, l_points=0, v_phases=0)
        lines, text = self.run_with(**few)
        self.assertEqual(lines['c_T'], ['1.400(12)'])
        self.assertRegex(text, r' over 1 wave number 0\.9935, 100 % of .* boxes, misfit 1\.2\n')
        self.assertIn('c_L   not known: no step resolved', text)
        self.assertNotIn('c_L2', lines)
        self.assertEqual(lines['v'], ['not', 'known'])
        _, text = self.run_with(LOW, l_points=0, l_long_c2=math.nan)
        self.assertIn('c_L   none: LP steps of a circle follow no relation\n', text)
        self.assertNotIn('steps', self.run_with(LOW, averaged_time=0.0)[1])

    def test_paper_values_beside_the_fits(self):
        """By its form, c k alone or with the curvature: of exponents 2.3 k + 0.2 k^2."""
        slopes = r'by c k alone over the same waves\n  c_T   2\.6\d+\(\d+\) +Eck.*: 2\.535 \+-3 %\n'
        curves = r'by c k \+ c2 k\^2 alone .*\n  c_T   2\.300.* 1\.412\n  c_T2  0\.2.* 0\.086\n'
        for density, disks, there in (
            (0.7, 400, slopes),
            (0.4, 780, curves),
            (0.7, 399, None),
            (0.81, 780, None),
        ):
            info = made.run_info(disks=disks, density=density)
            waves = [made.step(info, T, n, 0, 38 - 2 * n, 39 - 2 * n) for n in (1, 2)]
            for wave in waves:
                wave.exponent = (2.3 + 0.2 * wave.wave_number) * wave.wave_number
            _, text = self.run_with(*waves, info=info, t_k_min=made.K, t_k_max=2 * made.K)
            self.assertEqual('Eckmann' in text, there is not None, (density, disks))
            self.assertRegex(text, there or 'fits')

    def test_paper_scene(self):
        info = made.paper_info()
        known = [made.step(info, T, 1, 0, 1556, 1557), made.step(info, LP, 1, 0, 1550, 1553)]
        for step, fitted in zip(known, (paper.slope_t(0.8), paper.slope_l(0.8))):
            step.exponent = 0.99 * fitted * step.wave_number
        lines, _ = self.run_with(*known, info=info, exponents=np.linspace(6, 1, 1557))
        row = ['1556-1557', '1.98', '2', '0.18736', '0.6093(20)', '0.6155', '-1.00', '%']
        self.assertEqual(lines['T(1,0)'], row)
        self.assertEqual(lines['LP(1,0)'][-3:], ['0.8664', '-1.00', '%'])

    def test_lp_dynamics(self):
        step = made.step(INFO, LP, 1, 1, 32, 35, omega=-1.61, omega_error=0.012)  # k = 1.40496
        message = made.lp_phases(INFO, [made.zero_modes(), step], 150.0)
        said = INFO, made.spectrum([3.0], 50.0), made.steps([made.zero_modes(), step]), message
        tracked = (1.50, 0.01, 3), (-1.60, 0.02, 3), (1.52, -1.0, 3)
        others = [(9.0, 0.01, state) for state in (1, 2, 1, 1, 0)]
        for phase, values in zip(message.phases, [*tracked, *others]):
            phase.omega, phase.omega_error, phase.state = values
        row = r'LP\(1,1\) +{} +{} +{} of 8'.format
        self.assertRegex(self.lines(*said)[1], row(r'1\.610\(12\)', r'1\.1459\(85\)', 3))
        made.turn([step], np.nan, -1.0)
        for phase in message.phases:
            phase.state = phase.WEAK
        self.assertRegex(self.lines(*said)[1], row('-', '-', 0))

    def test_cost_of_classification(self):
        _, text = self.lines(INFO, made.spectrum([3.0], 50.0), made.steps([]), made.cost(200.0))
        self.assertIn('took 5.0 % of the run (10.0 s of 200.0 s)', text)
