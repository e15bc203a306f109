"""hdlyap plot against bags that are made here: the table that it prints."""

import math

import numpy as np

from hdlyap.msg import Step

import golden
import made
from bags import Bags
from made import LP, T
from hdlyap.plots import paper, report
from test_covariant_pictures import FORWARD, everything

INFO = made.run_info()
HALF = np.linspace(3, 1, 37)
LOW, HIGH = made.step(INFO, T, 1, 0, 36, 37), made.step(INFO, LP, 1, 0, 32, 35)


def mirrored():
    return made.step(INFO, T, 1, 0, 44, 45, conjugate=True, exponent=3e-6 - LOW.exponent)


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

    def test_whole(self):
        """With rows of every kind: the lowest comes first, below its set who shares it."""
        shared = dict(set=7, members=2, expected=4, omega_error=-1.0)
        found = [
            HIGH,
            LOW,
            made.step(
                INFO, T, 1, 1, 24, 31, multiplicity=3.9, sharing=Step.SHARING_MIXING, **shared
            ),
            made.step(
                INFO, LP, 0, 1, 24, 31, multiplicity=3.5, sharing=Step.SHARING_COINCIDENT, **shared
            ),
            made.step(INFO, LP, 1, 1, 20, 23, omega=-1.61, omega_error=0.012),  # k = 1.40496
            made.unresolved(INFO, LP, 2, 2, 8),
            made.unresolved(INFO, T, 2, 2, 4),
            made.zero_modes(38),
            mirrored(),
        ]
        phases = made.lp_phases(INFO, found, 150.0)
        for phase in phases.phases[::3]:
            phase.state = phase.WEAK
        whole = made.spectrum(FORWARD, 50.0, pairing_error=2e-5)
        whole.std_errors = list(np.linspace(0.01, 0.08, 80))
        others = phases, made.gas(50.0), made.cost(200.0), everything()[-1]
        text = self.lines(INFO, whole, made.steps(found), *others)[1]
        golden.check(self, 'steps.txt', text + '\n')

    def test_divergence(self):
        """Beside the sum of all exponents, where the dynamics tells it; no pairs are spoken of."""
        info = made.run_info(number=1, zero_exponents=1)
        dissipative = made.spectrum([0.5, 0.001, -0.3, -0.451], 50.0, divergence=-0.2501)
        _, text = self.lines(info, dissipative)
        self.assertRegex(text, r'the exponent before the zero modes .*\n.*\n +1 +0\.5')
        self.assertIn('sum of all      -0.250(10)\nmean divergence -0.250(10)\n', text)
        self.assertNotIn('pairing', text)
        mirrored = made.spectrum(FORWARD, 50.0, pairing_error=0.0)  # by construction
        self.assertNotIn('pairing', self.lines(INFO, mirrored)[1])
        self.assertNotIn('Kaplan', text)
        self.assertNotIn('divergence', self.lines(INFO, made.spectrum(HALF, 50.0))[1])

    def test_shearing_walls(self):
        """The dimension beside the sum; the flow beside the pressure."""
        info = made.run_info(number=1, zero_exponents=3, boundary_y='shearing')
        found = made.spectrum([0.5, 0.001, -0.3, -0.451], 50.0, divergence=-0.2501)
        found.kaplan_yorke, found.kaplan_yorke_error = 3.4457, 0.02
        _, text = self.lines(info, found, made.shear_gas())
        self.assertIn('mean divergence -0.250(10)\nKaplan-Yorke    3.446(20)\n', text)
        self.assertIn('shear stress    0.062(10) per sigma^2\n', text)
        self.assertIn('v near low wall -0.250(10) sigma per time unit\n', text)
        self.assertIn('v near high one 0.375(10) sigma per time unit\n', text)
        self.assertNotIn('\ndivergence', text)
        self.assertIn('\ndivergence      -0.125(10) per', self.lines(info, made.shear_gas())[1])
        self.assertIn('y shearing, shear b 10\n', text)

    def test_what_is_not_known(self):
        """Errors, zero modes, partners, points of fits: it is said, or nothing is."""
        high = made.step(INFO, LP, 1, 0, 32, 35, std_error=-1.0)
        lost = made.unresolved(INFO, LP, 1, 0, 4)
        lost.conjugate = True
        few = dict(t_points=1, t_prior_share=1.0, t_k_max=0.99346, l_points=0, v_phases=0)
        round_ = dict(l_points=0, l_long_c2=math.nan)
        unknown = made.zero_modes(38)
        unknown.std_error = -1.0
        both = dict(exponents=np.linspace(3, 0, 43))
        for known, fields, said, not_said in (
            (
                [high, LOW, made.zero_modes()],
                {},
                r'LP\(1,0\) .* 1\.98367\n',
                r'resolved \(|Eckm|LP d',
            ),
            ([LOW, made.zero_modes()], {}, 'zero modes not carried', 'not found'),
            ([LOW, made.zero_modes()], both, 'zero modes not found', 'not carried'),
            ([LOW, mirrored(), lost], {}, 'half: 1 of 2 resolved', 'not resolved'),
            (
                [LOW],
                few,
                r' over 1 wave number 0\.9935, curvature assumed: .* boxes, m',
                'c_[TL][23]',
            ),
            ([LOW], few, r'c_L   not known: no step resolved\n  v     not known', 'c_L3'),
            ([LOW], round_, 'c_L   none: LP steps of a circle follow no relation\n', 'c_L2'),
            ([LOW, made.zero_modes()], {}, 'not carried', 'zero modes have'),
            ([unknown], both, r'\n  zero modes have no errors: ', 'xx'),
            ([], dict(averaged_time=0.0), 'lambda_max', 'steps'),
        ):
            _, text = self.run_with(*known, **fields)
            self.assertRegex(text, said)
            self.assertNotRegex(text, not_said)

    def test_too_short(self):
        for error, said in (
            (0.01, ''),
            (-1.0, ', too short for standard errors; rosrun .* --check SCENE .*'),
        ):
            _, text = self.lines(INFO, made.spectrum(HALF, 50.0, error=error))
            self.assertRegex(text, f'averaged time   50{said}\n')

    def test_steps_that_walls_forbid(self):
        """T(n,0) needs a field across walls along y; a wave that has its T is not named."""
        for x, y in (('reflecting', 'reflecting'), ('periodic', 'shearing')):
            info = made.run_info(boundary_x=x, boundary_y=y)
            found = [made.step(info, LP, 1, 0, 36, 37), made.unresolved(info, LP, 2, 0, 2)]
            for more, said in (
                ([], ('T\\(1,0\\) T\\(2,0\\)', 'none: no T step exists between such walls')),
                (
                    [made.unresolved(info, T, 2, 0, 1)],
                    ('T\\(1,0\\)', 'not known: no step resolved'),
                ),
            ):
                _, text = self.run_with(*found, *more, info=info, t_points=0)
                self.assertRegex(text, rf'\n  do not exist between such walls: {said[0]}\n')
                self.assertRegex(text, f'\n  c_T   {said[1]}\n')
        self.assertNotIn('do not exist', self.run_with(*found)[1])

    def test_disks_that_keep_their_places(self):
        said = 'disks have kept their places since the averaging began: errors hold'
        for caged in (False, True):
            status = made.status(50.0, caged=caged)
            _, text = self.lines(INFO, made.spectrum(HALF, 50.0), status)
            self.assertEqual(said in text, caged)

    def test_an_energy_that_was_off(self):
        said = 'the energy was off by 0.0016, asked was 0.0005: the time step was too long'
        for most, is_said in ((0.0016, True), (0.0004, False), (math.nan, False)):
            status = made.status(50.0, energy_error_most=most, energy_error_wanted=5e-4)
            _, text = self.lines(INFO, made.spectrum(HALF, 50.0), status)
            self.assertEqual(said in text, is_said)

    def test_steps_that_share_a_set(self):
        """In one word how; of one that is not known in none."""
        shared = dict(set=7, members=2, expected=4, multiplicity=3.5)
        for how, words in (
            (Step.SHARING_UNKNOWN, []),
            (Step.SHARING_COINCIDENT, ['coincide']),
            (Step.SHARING_BLENDED, ['blended']),
        ):
            lines, _ = self.run_with(
                made.step(INFO, T, 1, 1, 26, 33, sharing=how, **shared),
                made.step(INFO, LP, 0, 1, 26, 33, sharing=how, **shared),
            )
            self.assertEqual(lines['LP(0,1)+T(1,1)'], ['26-33', '7.00', '8', *words])

    def test_many_unresolved_steps_in_one_line(self):
        _, text = self.run_with(*(made.unresolved(INFO, T, n, 10, 4) for n in range(100)))
        line = next(line for line in text.splitlines() if 'not resolved (' in line)
        self.assertRegex(line, r'^  not resolved \(100\): T\(0,10\) .* and \d+ more$')
        self.assertLessEqual(len(line), 104)
        self.assertEqual(line.count('T(') + int(line.split()[-2]), 100)

    def test_paper_values_beside_the_fits(self):
        """By its form, c k alone or with the curvature: of exponents 2.3 k + 0.2 k^2."""
        slopes = r'by c k alone over the same waves\n  c_T   2\.6\d+\(\d+\) +Eck.*: 2\.535 \+-3 %\n'
        curves = r'by c k \+ c2 k\^2 alone .*\n  c_T   2\.300.* 1\.412\n  c_T2  0\.2.* 0\.086\n'
        for density, disks, there, fields in (
            (0.7, 400, slopes, {}),
            (0.7, 4000, slopes, dict(aspect=0.5, boundary_y='reflecting')),
            (0.4, 780, curves, {}),
            (0.7, 399, None, {}),
            (0.81, 780, None, {}),
            (0.09, 780, None, {}),
            (0.7, 400, None, dict(aspect=0.49)),
            (0.4, 780, None, dict(aspect=1.01)),
            (0.4, 780, None, dict(container='circle')),
            (0.7, 400, None, dict(particles='dumbbells')),
        ):
            info = made.run_info(number=disks, density=density, **fields)
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

    def test_lp_dynamics_that_are_not_known(self):
        found = [made.step(INFO, LP, 1, 1, 32, 35)]
        message = made.lp_phases(INFO, found, 150.0)
        made.turn(found, np.nan, -1.0)
        for phase in message.phases:
            phase.state = phase.WEAK
        _, text = self.lines(INFO, made.spectrum([3.0], 50.0), made.steps(found), message)
        self.assertRegex(text, r'LP\(1,1\) +- +- +0 of 8')
