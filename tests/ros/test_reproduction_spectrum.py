"""Part 1 of the reproduction: exponents within a step, against what is known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import recorded
from made import LP, T
from study.parts import spectrum

ERROR = 1e-3


def run(*levels, shared=False):
    """Of 100 disks: T(1,0), LP(1,0) with these exponents, smallest first, of one set if shared."""
    info = recorded.info(100, 0.7, 0.867)
    found, last = [], 197
    for (kind, nx, ny), exponents in zip(((T, 1, 0), (LP, 1, 0)), levels):
        more = {'set': 1, 'members': 2} if shared else {}
        found.append(made.step(info, kind, nx, ny, last + 1 - len(exponents), last, **more))
        last -= len(exponents)
    small = [one for level in levels for one in level]
    every = recorded.stairs(info, [(one, 1) for one in small], error=ERROR)
    return {spectrum.RUN: recorded.Bag(recorded.Recorded(info, made.steps(found), every))}


class Equal(unittest.TestCase):
    def rows(self, bags):
        rows = {row.quantity: row.judge({'telling': 3.0}) for row in spectrum.equal(bags)}
        return [rows.get(f'exponents of {name}') for name in ('T(1,0)', 'LP(1,0)')]

    def test_chi2(self):
        exponents = [0.9, 0.901, 0.902, 0.907]
        t, lp = self.rows(run([0.6, 0.6], exponents))
        chi2 = np.sum((np.array(exponents) - np.mean(exponents)) ** 2) / ERROR**2
        self.assertAlmostEqual(lp.measured, chi2, places=6)
        self.assertEqual((lp.published, lp.count, lp.verdict), (3, 4, 'differs'))
        self.assertEqual(lp.remark, 'first over last, less 1: +0.78 %')
        self.assertEqual((t.measured, t.published, t.verdict), (0.0, 1, 'agrees'))

    def test_steps_that_share_vectors_need_not_be_equal(self):
        self.assertEqual(self.rows(run([0.6, 0.6], [0.9] * 4, shared=True)), [None, None])

    def test_unknown_errors(self):
        bags = run([0.6, 0.6], [0.9] * 4)
        bags[spectrum.RUN].recording.spectrum.std_errors = [-1.0] * 40
        self.assertEqual({row.verdict for row in self.rows(bags)}, {'not measured'})


if __name__ == '__main__':
    unittest.main()
