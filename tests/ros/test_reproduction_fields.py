"""Part 4 of the reproduction: weights of vectors in known fields, and what is drawn of them."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import made_fields
from made import LP, T
from hdlyap.plots import waves
from hdlyap.plots.figures.modes import ARROW
from reproduced import Part
from study import averages, pairs, projection
from study.parts import fields

BOUNDARIES = ('periodic', 'reflecting')
# least squares in 2N = 40 dimensions, all of order 1
ROUNDING = 1e3 * np.finfo(float).eps


def boxes():
    for x in BOUNDARIES:
        for y in BOUNDARIES:
            yield made.run_info(box_x=7.0, box_y=5.0, boundary_x=x, boundary_y=y)


class Waves(unittest.TestCase):
    def test_gradient_is_the_slope_of_the_modulation(self):
        x, y, h = np.linspace(0, 7, 9), np.linspace(0, 5, 9), 1e-5
        for info in boxes():
            for bits in range(4):
                where = info, 2, 1, bits
                ends = [
                    [waves.modulation(*where, x + sign * dx, y + sign * dy) for sign in (1, -1)]
                    for dx, dy in ((h, 0), (0, h))
                ]
                slopes = [(after - before) / (2 * h) for after, before in ends]
                # of the differences: k^3 h^2 / 6, and rounding / h
                self.assertLess(
                    np.abs(np.subtract(waves.gradient(*where, x, y), slopes)).max(), 1e-9
                )

    def test_as_many_as_the_boundaries_allow(self):
        """Dimensions of T are the number of modulations, of LP twice that."""
        expected = {  # T(1,0) T(0,1) T(1,1), pairs of LP
            ('periodic', 'periodic'): ([2, 2, 4], [2, 2, 4]),
            ('reflecting', 'reflecting'): ([0, 0, 1], [1, 1, 1]),
            ('periodic', 'reflecting'): ([0, 1, 2], [2, 1, 2]),
            ('reflecting', 'periodic'): ([1, 0, 2], [1, 2, 2]),
        }
        for info in boxes():
            nodes = (1, 0), (0, 1), (1, 1)
            found = tuple(
                [len(waves.modulations(info, *n, transverse=t)) for n in nodes]
                for t in (True, False)
            )
            self.assertEqual(found, expected[info.boundary_x, info.boundary_y])

    def test_sine_between_walls_for_t_alone(self):
        walls = made.run_info(boundary_x='reflecting', boundary_y='reflecting')
        self.assertEqual(
            waves.modulations(walls, 1, 1, transverse=True), [waves.SIN_X | waves.SIN_Y]
        )
        self.assertEqual(waves.modulations(walls, 1, 1), [0])


class Averages(unittest.TestCase):
    def test_snapshots(self):
        self.assertEqual(averages.of_snapshots([1.0, 3.0]), (2.0, 1.0))
        self.assertEqual(averages.of_snapshots([5.0]), (5.0, -1.0))

    def test_values_with_errors(self):
        """Weights 1 and 4; chi^2 of 1, 3 with the errors 1, 1/2 about 2.6 is 2.56 + 0.64."""
        mean, error, chi2 = averages.weighted([1.0, 3.0], [1.0, 0.5])
        self.assertAlmostEqual(mean, 2.6)
        self.assertAlmostEqual(chi2, 3.2)
        self.assertAlmostEqual(error, np.sqrt(3.2 / 5))
        self.assertAlmostEqual(averages.weighted([1.0, 1.0], [1.0, 0.5])[1], np.sqrt(1 / 5))

    def test_quotient(self):
        value, error = averages.quotient((6.0, 0.3), (2.0, 0.04))
        self.assertAlmostEqual(value, 3.0)
        self.assertAlmostEqual(error, 3 * np.hypot(0.05, 0.02))
        for unknown in (-1.0, np.nan):
            self.assertEqual(averages.quotient((6.0, 0.3), (2.0, unknown)), (3.0, -1.0))
            self.assertEqual(averages.quotient((6.0, unknown), (2.0, 0.04)), (3.0, -1.0))

    def test_series_of_fours_is_as_long_as_its_fours(self):
        values = np.random.default_rng(1).normal(size=(10, 3))
        mean, error = averages.of_series(np.repeat(values, 4, axis=0))
        np.testing.assert_allclose(mean, values.mean(axis=0), rtol=0, atol=1e-15)
        np.testing.assert_allclose(error, values.std(axis=0, ddof=1) / np.sqrt(10), rtol=1e-12)

    def test_too_short_for_an_error(self):
        self.assertEqual(averages.of_series([1.0, 2.0, 3.0]), (2.0, -1.0))


def by_hand(info, letter, x, y, momenta):
    """T, L and P fields of the wave vector (1,0)."""
    k = 2 * np.pi / info.box_x
    if letter == 'P':
        return [
            np.concatenate([f(k * x) * momenta[0], f(k * x) * momenta[1]]) for f in (np.cos, np.sin)
        ]
    along = [-np.sin(k * x), np.cos(k * x)]
    zero = np.zeros_like(x)
    return [np.concatenate([zero, a] if letter == 'T' else [a, zero]) for a in along]


def field(info, one, share, letter, others, sim_time=150.0):
    """A vector of (1,0), so much of it in its last field by hand; the rest knows nothing of any
    field of `others`."""
    made_field = made_fields.mode_field(info, one, sim_time=sim_time)
    x, y, *momenta = made_fields.disks(info)
    inside = by_hand(info, letter, x, y, momenta)[-1]
    basis = np.array([column for each in others for column in by_hand(info, each, x, y, momenta)]).T
    rest = np.random.default_rng(7).normal(size=2 * info.disks)
    rest -= basis @ np.linalg.lstsq(basis, rest, rcond=None)[0]
    inside, rest = (part / np.linalg.norm(part) for part in (inside, rest))
    vector = np.sqrt(share) * inside + np.sqrt(1 - share) * rest
    made_field.dqx, made_field.dqy = 0.6 * np.split(vector, 2)[0], 0.6 * np.split(vector, 2)[1]
    return made_field


class Fields(Part):
    of = fields

    def found(self, info):
        return [
            made.step(info, T, 1, 0, 36, 37),
            made.step(info, LP, 1, 0, 32, 35),
            made.step(info, T, 0, 1, 30, 31),
            made.step(info, LP, 0, 1, 26, 29),
            made.step(info, T, 1, 1, 22, 25),
            made.step(info, LP, 1, 1, 14, 21),
        ]

    def full(self):
        info = made.run_info()
        found = self.found(info)
        messages = [info, made.cost(1), made.steps(found)]
        for share, sim_time in ((0.9, 150.0), (0.8, 170.0)):
            messages += [
                field(info, found[0], share, 'T', 'TL', sim_time),
                field(info, found[1], share - 0.2, 'P', 'LP', sim_time),
            ]
        messages += [
            made_fields.mode_field(info, one, modulations=(0, 1) if one.nx else (0, 2))
            for one in found[2:]
        ]
        return {'periodic': self.bag('periodic', messages)}

    def test_weights(self):
        rows = self.rows(self.full())
        for name, expected in (('T(1,0) in its T', 0.85), ('LP(1,0) in its LP', 0.65)):
            row = rows[f'weight of {name} fields']
            self.assertAlmostEqual(row.measured, expected, delta=ROUNDING)
            self.assertAlmostEqual(row.error, 0.05, delta=ROUNDING)
            self.assertEqual((row.published, row.sense), (0.5, 'above '))
        self.assertEqual(
            rows['weight of T(1,0) in its T fields'].remark, '2 snapshots; by chance 0.0500'
        )
        self.assertEqual(
            rows['weight of LP(1,0) in its LP fields'].remark, '2 snapshots; by chance 0.1000'
        )

    def test_curl_free_part(self):
        """What a pure gradient has in the L fields is all of it."""
        info = made.run_info()
        one = made.step(info, T, 1, 0, 36, 37)
        rows = self.rows(
            {'periodic': self.bag('periodic', [info, field(info, one, 1.0, 'L', 'TL')])}
        )
        self.assertAlmostEqual(
            rows['weight of T(1,0) in the L fields'].measured, 1.0, delta=ROUNDING
        )
        self.assertLess(rows['weight of T(1,0) in its T fields'].measured, 0.5)

    def test_curl_of_a_diagonal_wave(self):
        """Made by small differences, which are right to h^2."""
        info = made.run_info()
        one = made_fields.mode_field(
            info, made.step(info, T, 1, 1, 22, 25), modulations=(0, 3), noise=0.0
        )
        self.assertAlmostEqual(projection.weight(info, one, 'T'), 1.0, delta=1e-6)
        self.assertLess(projection.weight(info, one, 'L'), 0.5)

    def test_continued_between_the_disks(self):
        info = made.run_info()
        one = field(info, made.step(info, T, 1, 0, 36, 37), 1.0, 'T', 'TL')
        size = one.dqy[0] / np.cos(2 * np.pi * one.x[0] / info.box_x) / 0.6
        x, y = np.meshgrid(np.linspace(0, info.box_x, 5), np.linspace(0, info.box_y, 4))
        along_x, along_y = projection.continued(info, one, 'T', x, y)
        np.testing.assert_allclose(along_x, 0, atol=ROUNDING)
        np.testing.assert_allclose(
            along_y, size * np.cos(2 * np.pi * x / info.box_x), atol=ROUNDING
        )

    def test_table(self):
        header, lines = self.tables(self.full())['weights']
        self.assertEqual(
            header, ('step', 'time', 'index', 'in_T_fields', 'in_L_fields', 'in_P_fields')
        )
        self.assertEqual(
            [line[:4] for line in lines if line[0] == 'T(1,0)'],
            [('T(1,0)', '150', '37', '0.90000'), ('T(1,0)', '170', '37', '0.80000')],
        )

    def reconstructed(self, name, share, letter, distance=0.1):
        """A run with one field of LP(1,0), so much of whose L modes, each, is in its last `letter`
        field and none in others."""
        info = made.run_info()
        one = made.step(info, LP, 1, 0, 32, 35)
        shown = field(info, one, share, letter, 'TL')
        shown.l_x, shown.l_y = (2 * list(part) for part in (shown.dqx, shown.dqy))
        later = field(info, one, share, letter, 'TL', 170.0)
        later.l_x, later.l_y = shown.l_x, shown.l_y
        shown.rotation_distance, later.rotation_distance = distance - 0.01, distance + 0.01
        rows = self.rows({'periodic': self.bag(name, [info, shown, later])})
        return (
            rows['weight of the L modes of LP(1,0) in the T fields'],
            rows['largest deviation of a singular value of Q from 1, LP(1,0)'],
        )

    def test_curls_in_l_modes(self):
        """By chance a vector of 20 disks has 0.05 of it in two fields."""
        for letter, share, curl, verdict in (
            ('L', 0.9, 0.0, 'agrees'),
            ('T', 0.04, 0.04, 'agrees'),
            ('T', 0.06, 0.06, 'differs'),
            ('T', 0.9, 0.9, 'differs'),
        ):
            row, _ = self.reconstructed(f'{letter}{share}', share, letter)
            self.assertAlmostEqual(row.measured, curl, delta=ROUNDING)
            self.assertEqual((row.published, round(row.left_open, 9)), (0.0, 0.05))
            self.assertEqual(row.verdict, verdict)

    def test_every_pair_counts(self):
        """The first pair is a gradient, the second one a curl."""
        info = made.run_info()
        one = made.step(info, LP, 1, 0, 32, 35)
        gradient, curl = (field(info, one, 1.0, letter, 'TL') for letter in 'LT')
        gradient.l_x, gradient.l_y = (
            [*first, *second]
            for first, second in ((gradient.dqx, curl.dqx), (gradient.dqy, curl.dqy))
        )
        weights = [
            projection.weight(info, mode, letter)
            for mode in pairs.modes(gradient, 'L')
            for letter in 'LT'
        ]
        self.assertAlmostEqual(weights[0], 1.0, delta=ROUNDING)
        self.assertAlmostEqual(weights[3], 1.0, delta=ROUNDING)
        rows = self.rows({'periodic': self.bag('periodic', [info, gradient])})
        self.assertAlmostEqual(
            rows['weight of the L modes of LP(1,0) in the T fields'].measured,
            np.mean(weights[1::2]),
            delta=ROUNDING,
        )

    def test_rotated(self):
        for distance, verdict in ((0.1, 'agrees'), (0.47, 'not decided'), (0.9, 'differs')):
            _, row = self.reconstructed(f'q{distance}', 0.9, 'L', distance)
            self.assertAlmostEqual(row.measured, distance)
            self.assertAlmostEqual(row.error, 0.01)
            self.assertEqual((row.published, row.verdict), (0.5, verdict))
            self.assertIn('L 0.100, P 0.100', row.remark)

    def test_nine_panels_and_two_patterns(self):
        figures = self.figures(self.full())
        panels = figures['fields'].axes
        self.assertEqual(
            [axes.get_title()[:6] for axes in panels],
            [f'{letter}({nodes})' for nodes in ('1,0', '0,1', '1,1') for letter in 'TLP'],
        )
        shown = made_fields.mode_field(made.run_info(), self.found(made.run_info())[5])
        for axes, halves in zip(panels[-2:], ((shown.l_x, shown.l_y), (shown.p_x, shown.p_y))):
            (arrows,) = [one for one in axes.collections if hasattr(one, 'U')]
            values = np.array(halves)[:, : len(shown.x)]  # of the first pair
            size = np.sqrt(np.mean(np.sum(values**2, axis=0)))
            np.testing.assert_allclose([arrows.U, arrows.V], values * ARROW / size)
        wanted = made_fields.mode_field(
            made.run_info(), self.found(made.run_info())[4], modulations=(0, 1)
        )
        rms = np.sqrt(np.mean(np.square([wanted.dqx, wanted.dqy])))
        for axes, component in zip(figures['patterns'].axes, (wanted.dqx, wanted.dqy)):
            colours = axes.collections[0].get_array()
            np.testing.assert_allclose(colours, np.array(component) / rms)

    def test_without_fields(self):
        info = made.run_info()
        self.measures_nothing(
            {'periodic': self.bag('periodic', [info, made.steps(self.found(info))])}
        )

    def test_vectors_outside_of_every_step_are_left_out(self):
        info = made.run_info()
        other = made_fields.mode_field(info, made.step(info, T, 1, 0, 36, 37), kind=0)
        self.measures_nothing({'periodic': self.bag('periodic', [info, other])})


if __name__ == '__main__':
    unittest.main()
