"""Part 5 of the reproduction: the modulation in the quotients of a P mode, with what is known of
it."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import made_fields
from made import LP
from hdlyap.plots.figures.p_mode import EPSILON, Fit
from reproduced import Part
from study.parts import p_mode

RESIDUAL = 0.6  # 1 - residual^2 = 0.64
ROUNDING = 1e3 * np.finfo(float).eps
TRIALS = 400


def field(info, amplitudes, sim_time=150.0, noise=0.0, seed=1, nodes=(1, 0)):
    """Both pairs of LP(1,0): phi_P,x = amplitude A p_x + noise, with the residual that least
    squares would have had."""
    rng = np.random.default_rng(seed)
    one = made.step(info, LP, *nodes, 32, 35)
    k = 2 * np.pi / info.box_x
    x, _, *momenta = made_fields.disks(info)
    eps = EPSILON * np.mean(np.square(momenta))
    raw, over = [], []
    for a in (np.cos(k * x), np.sin(k * x)):
        phi = [
            size * a * p + noise * rng.normal(size=x.size) for size, p in zip(amplitudes, momenta)
        ]
        raw.append(phi)
        over.append([part * p / (p * p + eps) for part, p in zip(phi, momenta)])
    parts = [
        np.concatenate([pair[axis] for pair in values]) for values in (raw, over) for axis in (0, 1)
    ]
    return made_fields.mode_field(
        info,
        one,
        sim_time=sim_time,
        modulations=(0, 1 if nodes[0] else 2),
        residual_p=[RESIDUAL, RESIDUAL + 0.1],
        **dict(zip(('p_x', 'p_y', 'p_over_px', 'p_over_py'), parts)),
    )


class PMode(Part):
    of = p_mode

    def bags(self, *fields, info=None):
        info = info or made.run_info()
        steps = [made.step(info, LP, 1, 0, 32, 35)]
        return {'periodic': self.bag('periodic', [info, made.cost(1), made.steps(steps), *fields])}

    def test_amplitudes_without_noise(self):
        rows = self.rows(self.bags(field(made.run_info(), (0.64, 0.32))))
        for name, expected in (
            ('amplitude of phi_P,x / p_x on A / (1 - residual^2)', 1.0),
            ('amplitude of phi_P,y / p_y on A / (1 - residual^2)', 0.5),
            ('ratio of these amplitudes', 2.0),
        ):
            self.assertAlmostEqual(rows[name].measured, expected, delta=ROUNDING)
            self.assertAlmostEqual(rows[name].error, 0, delta=ROUNDING)
            # x and y are 1 together by least squares: their ratio alone tells
            self.assertIsNone(rows[name].published)
        self.assertIn(
            'amplitude 0.640, residual 0.600',
            rows['amplitude of phi_P,x / p_x on A / (1 - residual^2)'].remark,
        )

    def test_means_over_snapshots(self):
        info = made.run_info()
        rows = self.rows(self.bags(field(info, (0.6, 0.6), 150), field(info, (0.8, 0.4), 170)))
        spanned = np.mean([1 / (1 - r * r) for r in (RESIDUAL, RESIDUAL + 0.1)])
        for name, low, high in (
            ('amplitude along x / (1 - residual^2), mean', 0.6 * spanned, 0.8 * spanned),
            ('ratio of the amplitudes on A', 1.0, 2.0),
        ):
            self.assertAlmostEqual(rows[name].measured, (low + high) / 2, delta=ROUNDING)
            self.assertAlmostEqual(rows[name].error, (high - low) / 2, delta=ROUNDING)
        self.assertEqual(
            [name for name, row in rows.items() if row.published == 1.0],
            ['ratio of the amplitudes on A'],
        )
        residual = rows['distance of the P field from the vectors']
        self.assertAlmostEqual(residual.measured, RESIDUAL + 0.05)
        self.assertIn('2 snapshots, 2 pairs', residual.remark)

    def test_scatter_before_and_after(self):
        """After: noise alone. Before: all of it, but for what a sum over few disks has of A by
        chance."""
        info = made.run_info()
        one = field(info, (0.64, 0.64), noise=0.5)
        rows = self.rows(self.bags(one))
        a = np.cos(2 * np.pi * np.array(one.x) / info.box_x)
        other = np.sin(2 * np.pi * np.array(one.x) / info.box_x)
        expected = [[], []]
        for shape, part in ((a, slice(20)), (other, slice(20, 40))):
            phi, p = np.array(one.p_x)[part], np.array(one.px)
            for found, basis in zip(expected, (shape, shape * p)):
                rest = phi - basis * (phi @ basis) / (basis @ basis)
                found.append(np.sqrt((rest @ rest) / (phi @ phi)))
        for name, values in (
            ('scatter of phi_P,x about A / its rms', expected[0]),
            ('the same of phi_P,x / p_x', expected[1]),
        ):
            self.assertAlmostEqual(rows[name].measured, np.mean(values), delta=ROUNDING)
        self.assertGreater(
            rows['scatter of phi_P,x about A / its rms'].measured,
            1.2 * rows['the same of phi_P,x / p_x'].measured,
        )

    def test_error_is_the_scatter_of_amplitudes(self):
        """Of as many trials it is known to 1 / sqrt(2 TRIALS), here five times that; and no
        bias."""
        rng = np.random.default_rng(3)
        a, weights = np.cos(np.linspace(0, 6, 100)), np.linspace(0.1, 3, 100)
        fits = [
            Fit(a, 0.7 * a + rng.normal(size=100) / np.sqrt(weights), weights)
            for _ in range(TRIALS)
        ]
        amplitudes = np.array([fit.amplitude for fit in fits])
        error = np.mean([fit.error for fit in fits])
        self.assertAlmostEqual(amplitudes.std() / error, 1.0, delta=5 / np.sqrt(2 * TRIALS))
        self.assertAlmostEqual(amplitudes.mean(), 0.7, delta=5 * error / np.sqrt(TRIALS))

    def test_error_of_the_ratio(self):
        rows = self.rows(self.bags(field(made.run_info(), (0.64, 0.64), noise=0.1)))
        relative = [
            rows[f'amplitude of phi_P,{axis} / p_{axis} on A / (1 - residual^2)'] for axis in 'xy'
        ]
        ratio = rows['ratio of these amplitudes']
        self.assertAlmostEqual(
            ratio.error / ratio.measured, np.hypot(*(row.error / row.measured for row in relative))
        )

    def test_figure_and_table(self):
        bags = self.bags(field(made.run_info(), (0.64, 0.32)))
        self.assertEqual(list(self.figures(bags)), ['p_mode'])
        header, lines = self.tables(bags)['amplitudes']
        self.assertEqual(dict(zip(header, lines[0]))['amplitude_y'], '0.32')
        self.assertEqual([line[:3] for line in lines], [('150', '0', '0.6'), ('150', '1', '0.7')])

    def test_other_steps_are_no_lp_1_0(self):
        info = made.run_info()
        self.measures_nothing(self.bags(field(info, (0.6, 0.6), nodes=(0, 1))))

    def test_without_fields(self):
        self.measures_nothing(self.bags())


if __name__ == '__main__':
    unittest.main()
