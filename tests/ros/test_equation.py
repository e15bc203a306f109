"""Equation of state: what is said of it elsewhere, slopes by small differences, errors by trials.
"""

import unittest

import numpy as np

from hdlyap.plots import equation

DENSITIES = np.array([0.01, 0.1, 0.3, 0.5, 0.7])
ETA = np.pi * DENSITIES / 4


class Reference(unittest.TestCase):
    def test_virial_coefficients(self):
        """Of Z: 1, pi / 2, and 0.782 of its square; Henderson's third one is 25 / 8 eta^2."""
        rho = 1e-3
        z = equation.compressibility(rho)
        self.assertAlmostEqual((z - 1) / rho, np.pi / 2, delta=3e-3)
        third = (z - 1 - np.pi / 2 * rho) / (np.pi / 2 * rho) ** 2
        self.assertAlmostEqual(third, 0.782004, delta=2e-3)

    def test_contact_value_and_rate(self):
        """Those of the core's estimate: g = (1 - 7 eta / 16) / (1 - eta)^2, 2 sqrt(pi) rho g."""
        z = equation.compressibility(DENSITIES)
        g = (1 - 7 * ETA / 16) / (1 - ETA) ** 2
        np.testing.assert_allclose(equation.contact_value(z, DENSITIES), g, rtol=1e-9)
        rate = 2 * np.sqrt(np.pi) * DENSITIES * g
        np.testing.assert_allclose(equation.collision_rate(z), rate, rtol=1e-9)

    def test_mean_free_path(self):
        """Of a thin gas 1 / (2 sqrt(2) rho): mean speed over relative speed is 1 / sqrt(2), the
        cross-section 2."""
        rho = 1e-4
        rate = equation.collision_rate(equation.compressibility(rho))
        path = equation.mean_free_path(rate)
        self.assertAlmostEqual(path * 2 * np.sqrt(2) * rho, 1, delta=1e-3)

    def test_sound(self):
        """Of a thin gas sqrt(2); else by small differences along an adiabat: of a disk with two
        degrees of freedom d ln T = Z d ln rho."""
        self.assertAlmostEqual(equation.sound_velocity(1e-9), np.sqrt(2), places=7)
        h = 1e-5

        def pressure(rho, of):
            temperature = np.exp(equation.compressibility(of) * np.log(rho / of))
            return rho * temperature * equation.compressibility(rho)

        square = (pressure(DENSITIES + h, DENSITIES) - pressure(DENSITIES - h, DENSITIES)) / 2 / h
        np.testing.assert_allclose(equation.sound_velocity(DENSITIES) ** 2, square, rtol=1e-6)


class Measured(unittest.TestCase):
    def test_sound(self):
        """Of Z at some densities, as of the function; a wrong Z is seen."""
        rho = np.linspace(0.1, 0.7, 13)
        z = equation.compressibility(rho)
        velocity, error = equation.sound_velocities(rho, z)
        np.testing.assert_allclose(velocity[1:-1], equation.sound_velocity(rho)[1:-1], rtol=3e-3)
        self.assertTrue(np.isnan(error).all())
        self.assertGreater(equation.sound_velocities(rho, 1.05 * z)[0][5] / velocity[5], 1.03)

    def test_of_a_quadratic(self):
        """Exact, whatever the distances and the order."""
        rho = np.array([0.5, 0.1, 0.25, 0.4])
        velocity, _ = equation.sound_velocities(rho, 1 + rho + 3 * rho**2)
        slope = 1 + 6 * rho
        z = 1 + rho + 3 * rho**2
        np.testing.assert_allclose(velocity**2, z + rho * slope + z**2, rtol=1e-12)

    def test_errors(self):
        """As of many trials."""
        rng = np.random.default_rng(1)
        rho = np.array([0.2, 0.3, 0.4, 0.5])
        z, errors = equation.compressibility(rho), np.array([1e-3, 3e-3, 2e-3, 4e-3])
        _, stated = equation.sound_velocities(rho, z, errors)
        trials = [
            equation.sound_velocities(rho, z + errors * rng.normal(size=4))[0] for _ in range(4000)
        ]
        np.testing.assert_allclose(np.std(trials, axis=0), stated, rtol=0.05)  # 4 * 1.1 %

    def test_too_few(self):
        for rho in ([0.1, 0.2], [0.1, 0.2, 0.2]):
            with self.assertRaisesRegex(ValueError, '2 different densities: must be at least 3'):
                equation.sound_velocities(rho, np.ones(len(rho)))
