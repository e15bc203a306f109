"""Waves of spheres: names, gradients, transverse fields, and what of a vector is expected."""

import unittest

import numpy as np

import made
import made_fields
from made import LP, T
from hdlyap.msg import LpPhase
from hdlyap.data import waves
from hdlyap.plots import expected

INFO = made.spheres()
FIRST = made.step(INFO, T, 1, 0, 53, 56)
SECOND = made.step(INFO, LP, 1, 0, 49, 52)
Q = made_fields.balls(INFO)[0]


class Waves(unittest.TestCase):
    def test_wave_vector(self):
        walls = made.spheres(boundary_y='reflecting', boundary_z='reflecting')
        found = waves.wave_vector(walls, 2, 1, 3)
        np.testing.assert_allclose(found, [np.pi / 2, np.pi / 1.5, 3 * np.pi])

    def test_formulas(self):
        for bits, words, formula in (
            (0, 'cos kx x cos kz z', r'$\cos k_x x\,\cos k_z z$'),
            (LpPhase.SIN_Z, 'cos kx x sin kz z', r'$\cos k_x x\,\sin k_z z$'),
            (9, 'sin kx x cos kz z, second', r'$\sin k_x x\,\cos k_z z$, second'),
        ):
            self.assertEqual(waves.plain_formula(1, 0, bits, 2), words)
            self.assertEqual(waves.formula(1, 0, bits, 2), formula)
        self.assertEqual((waves.COS_M, waves.SIN_M), (16, 17))

    def test_gradient(self):
        """By small differences; a wall is half a diameter away."""
        info, h = made.spheres(boundary_z='reflecting'), 1e-5
        for bits in waves.modulations(info, 1, 1, nz=1):
            where = (info, 1, 1, bits)
            found = waves.gradient(*where, *Q[:2], 1, Q[2])
            for d in range(3):
                up, down = (Q + sign * h * np.eye(3)[d][:, None] for sign in (1, -1))
                ends = [waves.modulation(*where, *q[:2], 1, q[2]) for q in (up, down)]
                np.testing.assert_allclose(found[d], (ends[0] - ends[1]) / (2 * h), atol=1e-8)

    def test_transverse(self):
        """Both fields are across k and across each other in their sums of squares, have no
        divergence, and none goes through a wall."""
        walls = made.spheres(boundary_y='reflecting')
        for info, nodes, count in (
            (INFO, (1, 1, 1), 16),
            (INFO, (0, 0, 1), 4),
            (walls, (1, 0, 1), 4),
        ):
            bits = waves.modulations(info, *nodes[:2], transverse=True, nz=nodes[2])
            self.assertEqual(len(bits), count)
            h = 1e-5 * np.eye(3)
            for one in bits:
                ends = [
                    [waves.transverse(info, nodes, one, Q + s * h[d][:, None])[d] for d in range(3)]
                    for s in (1, -1)
                ]
                divergence = np.sum(np.subtract(*ends), axis=0) / 2e-5
                np.testing.assert_allclose(divergence, 0, atol=1e-8)
            table = [waves.transverse(info, nodes, one, Q).ravel() for one in bits]
            self.assertEqual(np.linalg.matrix_rank(table), count)
        at_wall = np.array([[1.3], [0.5], [0.7]])
        for one in waves.modulations(walls, 1, 0, transverse=True, nz=1):
            self.assertEqual(waves.transverse(walls, (1, 0, 1), one, at_wall)[1], 0)
        everywhere = made.spheres(**{'boundary_' + axis: 'reflecting' for axis in 'xyz'})
        self.assertEqual(waves.modulations(everywhere, 1, 0, transverse=True), [])
        self.assertEqual(len(waves.modulations(everywhere, 1, 1, transverse=True)), 1)

    def test_expected(self):
        """Of fields alone all, at other places, too; of noise beside them the rest."""
        info = made.spheres(number=400)
        q, p = made_fields.balls(info)
        phase = 2 * np.pi * q[0] / 8
        dq = np.array([0 * phase, 3 * np.sin(phase), 4 * np.cos(phase)])
        one = expected.Expected(made_fields.ball_field(info, FIRST, dq), [FIRST], info)
        self.assertEqual(one.along, [0])
        self.assertAlmostEqual(one.weight, 1)
        at = one.at(np.array([[2.0], [0], [0]]))[:, 0]
        scale = np.sqrt(np.mean(np.sum(dq**2, axis=0)))
        np.testing.assert_allclose(at * scale, [0, 3, 0], atol=1e-9)
        noisy = dq + 3 * np.random.default_rng(1).normal(size=dq.shape)
        one = expected.Expected(made_fields.ball_field(info, FIRST, noisy), [FIRST], info)
        self.assertAlmostEqual(one.weight, 12.5 / (12.5 + 27), delta=0.05)
        lp = np.array([np.cos(phase), 0 * phase, 0 * phase]) + p * np.sin(phase)
        one = expected.Expected(made_fields.ball_field(info, SECOND, lp), [SECOND], info)
        self.assertAlmostEqual(one.weight, 1)
