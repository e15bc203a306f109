"""What part 12 makes of the responses of L and P, against a C that is known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
from hdlyap.plots import waves
import reproduced  # noqa: F401, finds the study
from study import halves
from study.parts import hydro
from study.row import UNDECIDED
from test_reproduction_hydro import Run
from turned import Turned

Q, ERROR = 0.8, 0.004
NUMBERS = {(1, 0): 0.19, (0, 1): 0.22}
NUMBER = 0.64 * np.eye(2)
SYMMETRIC = np.array([[0.64, -0.05], [-0.05, 0.64]])
LATE = 0.64 * np.array([[np.cos(0.07), np.sin(0.07)], [-np.sin(0.07), np.cos(0.07)]])


def responses(c, k, error=ERROR):
    """Of dq = a L + b P with the length Q and dp = C dq, as sums over the disks give them."""
    root = np.sqrt(8)
    values = {
        ('L', 'density'): Q,
        ('P', 'density'): 0.0,
        ('L', 'along'): Q * c[0, 0],
        ('P', 'along'): Q * (c[0, 1] - k / np.sqrt(2)),
        ('L', 'energy'): Q * (2 * k + root * c[1, 0]),
        ('P', 'energy'): Q * root * c[1, 1],
    }
    return {key: hydro.Response(value, error) for key, value in values.items()}


def rows(c, error=ERROR):
    found = {wave: responses(c, k, error) for wave, k in NUMBERS.items()}
    return judged({wave: halves.matrix(found[wave], k) for wave, k in NUMBERS.items()})


def judged(matrices):
    found = halves.ratio(matrices), halves.ahead(matrices), halves.swing(matrices, NUMBERS)
    return [row.judge({'open': of}) for row, of in zip(found, (0.05, 0.02, 0.02))]


class Halves(unittest.TestCase):
    def assertVerdicts(self, c, *verdicts):
        self.assertEqual(tuple(row.verdict for row in rows(c)), verdicts)

    def test_matrix(self):
        c = np.array([[0.6, -0.03], [-0.08, 0.7]])
        one = halves.matrix(responses(c, 0.3), 0.3)
        np.testing.assert_allclose(one.values, c, atol=1e-12)
        part = ERROR / Q
        np.testing.assert_allclose(one.errors, [[part, part], [part / 8**0.5, part / 8**0.5]])

    def test_number(self):
        self.assertVerdicts(NUMBER, 'agrees', 'agrees', 'agrees')

    def test_symmetric_is_no_number_and_not_late(self):
        self.assertVerdicts(SYMMETRIC, 'agrees', 'agrees', 'differs')
        _, mean, swing = rows(SYMMETRIC)
        self.assertAlmostEqual(mean.measured, 0, 12)
        self.assertAlmostEqual(swing.measured, -0.05 / 0.64, 12)
        # of two waves; each of two entries, over the trace
        each = ERROR / Q * np.hypot(1, 8**-0.5) / 1.28
        self.assertAlmostEqual(swing.error, each / 2**0.5, 12)

    def test_late_is_late_and_not_symmetric(self):
        self.assertVerdicts(LATE, 'agrees', 'differs', 'agrees')
        self.assertAlmostEqual(rows(LATE)[1].measured, -np.tan(0.07), 12)

    def test_unequal(self):
        self.assertVerdicts(np.diag([0.7, 0.6]), 'differs', 'agrees', 'agrees')

    def test_remark_has_the_responses_with_their_constants(self):
        remark = rows(SYMMETRIC)[2].remark
        along, energy = -0.19 / 2**0.5, 2 * 0.19
        for value in (Q * (along - 0.05), Q * along, Q * (energy - 0.05 * 8**0.5), Q * energy):
            self.assertIn(f'{value:.4f}', remark)

    def test_without_errors(self):
        """Not known: nothing is decided by them."""
        found = rows(NUMBER, error=0.0)
        self.assertEqual([row.error for row in found], [-1.0, -1.0, -1.0])
        self.assertEqual({row.verdict for row in found}, {UNDECIDED})


class OfABag(Turned):
    of = hydro

    def test_wave_number_is_the_box_s(self):
        info = made.run_info()
        numbers = {wave: np.hypot(*waves.wave_vector(info, *wave)) for wave in NUMBERS}
        run = Run()
        plain = run.of_lp

        def of_lp(wave, pairs):
            known = responses(SYMMETRIC, numbers[wave])
            run.known.update(
                {
                    mode: np.array([known.get((mode, kind), (0.0,))[0] for kind in hydro.KINDS])
                    for mode in 'LP'
                }
            )
            return plain(wave, pairs)

        run.of_lp = of_lp
        found = self.rows(self.bag(info, *run.messages()))
        row = found['the same at L less that mean']
        self.assertAlmostEqual(row.measured, -0.05 / 0.64, 9)
        self.assertAlmostEqual(found['angle of dp ahead of dq, mean of a turn'].measured, 0, 9)

    def test_finding(self):
        """What is symmetric lags near L; a number does not."""
        for c, verdict in ((SYMMETRIC, 'agrees'), (NUMBER, 'not decided')):
            matrices = {wave: halves.matrix(responses(c, k), k) for wave, k in NUMBERS.items()}
            row = halves.swing(matrices, NUMBERS).judge({'below': 0.0})
            self.assertEqual(row.verdict, verdict)

    def test_nothing_measured(self):
        verdicts = [row.verdict for row in judged({})]
        self.assertEqual(verdicts, ['not measured'] * 3)


if __name__ == '__main__':
    unittest.main()
