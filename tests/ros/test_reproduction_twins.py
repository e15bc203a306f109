"""What the reproduction computes by itself, against limits that are known: the velocity that the
pressure of a box gives, and how many exponents a step has."""
# Second tier: tests/run.sh --all

import itertools
import unittest

import numpy as np

from hdlyap.plots import equation
from made import LP, T
from reproduced import box
from study import pressure
from study.measures import counts

PERIODIC = 'periodic'
WALLS = ('reflecting', 'reflecting')


def velocity(info, nx=1, ny=0, *state):
    """Over that of an ideal gas."""
    return pressure.velocity(info, nx, ny, *state) * 2**0.5


class Pressure(unittest.TestCase):
    def test_without_walls(self):
        info = box(780, 0.4, 0.867)
        for nodes in ((1, 0), (0, 1), (2, 1)):
            expected = float(equation.compressibility(0.4))
            self.assertAlmostEqual(velocity(info, *nodes), expected, 12)
        self.assertEqual(pressure.inside(info), 780 / (info.box_x * info.box_y))

    def test_walls_do_nothing_to_an_ideal_gas(self):
        """But that it is denser where centres can be."""
        for boundaries in (WALLS, (PERIODIC, 'reflecting'), ('reflecting', PERIODIC)):
            info = box(40, 1e-4, 0.5, boundaries)
            for nodes in ((1, 0), (1, 1), (0, 1)):
                self.assertAlmostEqual(velocity(info, *nodes), 1, 3)
        self.assertAlmostEqual(pressure.adsorbed(1e-4) / -0.5e-4, 1, 3)

    def test_all_disks_are_somewhere(self):
        for density in (0.1, 0.4, 0.8):
            info = box(100, density, 0.5, WALLS)
            inside, length = pressure.inside(info), 2 * (info.box_x + info.box_y)
            self.assertGreater(inside, density)
            total = inside * info.box_x * info.box_y + pressure.adsorbed(inside) * length
            self.assertAlmostEqual(total, 100, 6)

    def test_forces(self):
        """By hand, and the wave vector's direction between them."""
        info = box(100, 0.5, 0.5, (PERIODIC, 'reflecting'))
        rho, lx, ly = pressure.inside(info), info.box_x, info.box_y
        p, gamma = pressure.HENDERSON.pressure(rho), pressure.tension(rho)
        along, across = (p * ly - 2 * gamma) * lx / 100, p * lx * (ly - 1) / 100
        x, y = (1 / lx) ** 2, (1 / (ly - 1)) ** 2
        for nodes, expected in (
            ((1, 0), along),
            ((0, 1), across),
            ((1, 1), (x * along + y * across) / (x + y)),
        ):
            self.assertAlmostEqual(velocity(info, *nodes), expected, 12)

    def test_large_boxes_have_no_walls(self):
        off = [
            velocity(box(disks, 0.6, 1.0, WALLS)) / velocity(box(disks, 0.6, 1.0)) - 1
            for disks in (100, 10**4, 10**6)
        ]
        self.assertAlmostEqual(off[1] / off[2], 10, delta=0.5)  # as circumference over area
        self.assertGreater(off[0], off[1])

    def test_rods(self):
        """On a line, Tonks: P = rho / (1 - rho)."""
        for number, is_reflecting in itertools.product((0.1, 0.5, 0.9), (True, False)):
            v = pressure.of_row(number, 1e-6, is_reflecting)
            self.assertAlmostEqual(v * 2**0.5 * (1 - number), 1, 6)

    def test_row(self):
        """Against the largest eigenvalue itself, at other places across."""
        number, height = 0.75, 0.5
        force = pressure.of_row(number, height, True) * number * 2**0.5
        place = (np.arange(150) + 0.5) * height / 150
        contact = np.sqrt(1 - (place[:, None] - place) ** 2)

        def logarithm(force):
            return np.log(np.linalg.eigvalsh(np.exp(-force * contact))[-1] / force)

        length = (logarithm(force * 0.999) - logarithm(force * 1.001)) / (0.002 * force)
        self.assertAlmostEqual(length * number, 1, 4)

    def test_row_round_a_cylinder(self):
        """No place across is preferred: 1 / rho = 1 / F + the mean of s."""
        number, height = 0.75, 1.5
        force = pressure.of_row(number, height, False) * number * 2**0.5
        contact = np.sqrt(1 - np.linspace(-0.75, 0.75, 20001) ** 2)
        mean = np.average(contact, weights=np.exp(-force * contact))
        self.assertAlmostEqual((1 / force + mean) * number, 1, 3)

    def test_what_is_a_row(self):
        ends = ('reflecting', 1.5, True), ('reflecting', 1.9, False)
        for boundary, height, expected in (*ends, (PERIODIC, 1.5, True), (PERIODIC, 1.8, False)):
            info = box(150, 150 / 200 / height, height / 200, (PERIODIC, boundary))
            self.assertEqual(pressure.is_row(info), expected)
        narrow = box(150, 0.5, 0.0075, (PERIODIC, 'reflecting'))
        self.assertAlmostEqual(pressure.velocity(narrow, 1, 0), pressure.of_row(0.75, 0.5, True), 9)

    def test_measured(self):
        """Over Henderson's; straight between densities, with its error."""
        state = pressure.Equation([(0.8, 0.97, 0.002), (0.4, 1.01, 0.001)])
        for density, *quotient in ((0.1, 1.01, 0.001), (0.6, 0.99, 0.0015), (0.9, 0.97, 0.002)):
            np.testing.assert_allclose(state.over_henderson(density), quotient, rtol=1e-7)
            over = state.pressure(density) / pressure.HENDERSON.pressure(density)
            self.assertAlmostEqual(over, quotient[0])
        dense, row = box(780, 0.8, 0.867), box(150, 0.5, 0.0075)
        for info, factor, error in ((dense, 0.97, 0.002 / 0.97), (row, 1.0, 0.0)):
            self.assertAlmostEqual(velocity(info, 1, 0, state) / velocity(info), factor)
            self.assertAlmostEqual(pressure.error(info, state), error)


def sampled_rank(info, kind, nx, ny):
    """Dimension of the fields of a step at many disks: derivatives of A by hand, and p A."""
    rng = np.random.default_rng(1)
    x, y = rng.uniform(0, 1, (2, 300))
    p = rng.normal(size=(2, 300))
    fields = []
    for (a, da), (b, db) in itertools.product(
        _functions(nx, info.boundary_x, kind, x), _functions(ny, info.boundary_y, kind, y)
    ):
        gradient = np.array([da * b, a * db])
        fields += [[gradient[1], -gradient[0]]] if kind == T else [gradient, p * (a * b)]
    if not fields:
        return 0
    return np.linalg.matrix_rank(np.reshape(fields, (len(fields), -1)), tol=1e-9)


def _functions(n, boundary, kind, q):
    """(A, dA/dq) of one coordinate in 0 .. 1."""
    k = (2 if boundary == PERIODIC else 1) * np.pi * n
    cosine = np.cos(k * q) + 0 * q, -k * np.sin(k * q)
    sine = np.sin(k * q), k * np.cos(k * q)
    if boundary == PERIODIC:
        return [cosine, sine]
    return [sine] if kind == T else [cosine]


class Rule(unittest.TestCase):
    def test_against_the_rank_of_sampled_fields(self):
        for boundaries in itertools.product((PERIODIC, 'reflecting'), repeat=2):
            info = box(400, 0.4, 0.867, boundaries)
            for kind, nx, ny in itertools.product((T, LP), range(3), range(3)):
                if nx or ny:
                    self.assertEqual(
                        counts.prescribed(info, kind, nx, ny),
                        sampled_rank(info, kind, nx, ny),
                        (boundaries, kind, nx, ny),
                    )

    def test_narrow(self):
        info = box(150, 0.5, 0.0075)
        found = [counts.prescribed(info, *one) for one in ((LP, 3, 0), (LP, 0, 1), (T, 1, 1))]
        self.assertEqual(found, [4, 0, 0])


if __name__ == '__main__':
    unittest.main()
