"""Equation of state of hard disks, and what follows from a pressure and a collision rate. Units are
reduced: the kinetic energy of a disk is 1, so that kT = 1.

The reference is Henderson, Mol. Phys. 30, 971 (1975): Z = (1 + eta^2 / 8) / (1 - eta)^2 with
eta = pi rho / 4, exact to a percent up to MOST. For spheres, whose kT is 2/3, it is Carnahan and
Starling, J. Chem. Phys. 51, 635 (1969), with eta = pi rho / 6. All functions take numbers and
arrays."""

from collections import namedtuple
from math import pi, sqrt

import numpy as np

from hdlyap.data import space

MOST = 0.7  # highest density of the reference; disks freeze near 0.88


def compressibility(density):
    """Z = p / rho."""
    eta = pi * np.asarray(density) / 4
    return (1 + eta**2 / 8) / (1 - eta) ** 2


def compressibility_of_spheres(density):
    """Z = p / (rho kT)."""
    eta = pi * np.asarray(density) / 6
    return (1 + eta + eta**2 - eta**3) / (1 - eta) ** 3


Reference = namedtuple('Reference', 'compressibility most by')
REFERENCES = {
    'disks': Reference(compressibility, MOST, 'Henderson (1975)'),
    'spheres': Reference(compressibility_of_spheres, 0.9, 'Carnahan and Starling (1969)'),
}


def of(info):
    """The Reference of a run's particles; None if there is none, or if they have other sizes or
    masses than the units."""
    return REFERENCES.get(info.particles) if space.are_units(info) else None


def contact_value(z, density):
    """g(sigma) of disks with this Z: Z - 1 = (pi / 2) rho g."""
    return 2 * (np.asarray(z) - 1) / (pi * np.asarray(density))


def collision_rate(z):
    """The collision rate of a disk with this Z: 2 sqrt(pi) rho g."""
    return 4 * (np.asarray(z) - 1) / sqrt(pi)


def mean_free_path(rate):
    """The mean free path of disks: mean speed over the collision rate of a disk [sigma]."""
    return sqrt(pi / 2) / np.asarray(rate)


def sound_velocity(density):
    """The velocity of sound of the reference: c^2 = d(rho Z)/d rho + Z^2, as a disk has two degrees
    of freedom [sigma/time unit]."""
    eta = pi * np.asarray(density) / 4
    z = compressibility(density)
    slope = (eta / 4 + 2 * z * (1 - eta)) / (1 - eta) ** 2  # dZ / d eta
    return np.sqrt(z + eta * slope + z**2)


def sound_velocities(densities, z, errors=None):
    """(velocities of sound, errors) of disks with measured Z at three or more densities. The slope
    is that of the quadratic through the three densities nearest to each one. errors: independent
    ones of Z, which are propagated linearly."""
    densities, z = np.asarray(densities, dtype=float), np.asarray(z, dtype=float)
    errors = np.full(len(z), np.nan) if errors is None else np.asarray(errors, dtype=float)
    if len(z) < 3 or len(set(densities)) < len(densities):
        raise ValueError(f'{len(set(densities))} different densities: must be at least 3')
    slopes = np.array([_slope(densities, one) for one in range(len(z))])
    square = z + densities * (slopes @ z) + z**2
    # derivatives of c^2 with respect to all Z
    share = densities[:, None] * slopes + np.diag(1 + 2 * z)
    variance = ((share * np.where(share == 0, 0.0, errors)) ** 2).sum(axis=1)
    velocities = np.sqrt(square)
    return velocities, np.sqrt(variance) / (2 * velocities)


def _slope(densities, one):
    """The weights of all Z in dZ / d rho at one density, from Lagrange's quadratic."""
    near = np.argsort(np.abs(densities - densities[one]), kind='stable')[:3]
    weights, at = np.zeros(len(densities)), densities[one]
    for k in near:
        others = [densities[other] for other in near if other != k]
        below = np.prod([densities[k] - other for other in others])
        weights[k] = sum(at - other for other in others) / below
    return weights
