"""Box of disks -> P / (sqrt(2) rho) along a wave: the velocity that [T13] derives for LP
modes, with walls and in boxes so narrow that disks stay in a row.

A wall has a line tension gamma (scaled particle theory), and beside it there are fewer disks, by
-Gamma a length, so that it is denser inside; centres reach L - sigma of L:

    gamma = rho / (2 (1 - eta)),    Gamma = -d gamma / d mu = -rho gamma' / P',    eta = pi rho / 4
    N = rho Lx Ly + Gamma C,        C the length of all walls
    v_x = (P Ly - 2 gamma) (Lx - 1) / (sqrt(2) N)    between walls at both pairs of ends

rho is the density inside, P the pressure there: Henderson's, times what was measured over it where
it was. kT = 1, sigma = 1."""

from math import pi, sqrt

import numpy as np
from scipy.optimize import brentq

from hdlyap.plots import equation

ROW = sqrt(3) / 2  # beside each other by less, disks cannot pass, and only neighbours meet
STEP = 1e-5  # relative, of derivatives
LEVELS = 60  # places across a row
FULL = 0.99 * 4 / pi  # density of which eta is nearly 1
LARGEST = 1e3  # force of a row


class Equation:
    """Henderson's equation of state, or with points (density, measured over Henderson's pressure,
    its error) what was measured: between them the quotient is a straight line, beyond them
    constant."""

    def __init__(self, points=()):
        self._points = np.array(sorted(points), dtype=float).reshape(-1, 3).T

    def over_henderson(self, density):
        """(measured over Henderson's pressure, its error)"""
        densities, quotients, errors = self._points
        if not len(densities):
            return 1.0, 0.0
        both = (np.interp(density, densities, one) for one in (quotients, errors))
        return tuple(map(float, both))

    def pressure(self, density):
        henderson = density * equation.compressibility(density)
        return float(henderson * self.over_henderson(density)[0])


HENDERSON = Equation()


def velocity(info, nx, ny, state=HENDERSON):
    """Along the wave vector of these nodes [sigma/time unit]."""
    if is_row(info):
        return of_row(info.number / info.box_x, _height(info), _walls(info)[1])
    lengths = [side - wall for side, wall in zip((info.box_x, info.box_y), _walls(info))]
    along = np.array([nx / lengths[0], ny / lengths[1]]) ** 2
    return float(along @ _velocities(info, lengths, state) / along.sum())


def of_fields(density):
    """[T13]: Z / sqrt(2), with Henderson's Z = P / (density kT)."""
    return float(equation.compressibility(density)) / sqrt(2)


def error(info, state=HENDERSON):
    """Of it, relative: that of the pressure; a row is known exactly."""
    if is_row(info):
        return 0.0
    quotient, error = state.over_henderson(inside(info, state))
    return error / quotient


def is_row(info):
    """Disks one after the other along x, that only ever meet their neighbours."""
    beside = _height(info) * (1.0 if _walls(info)[1] else 0.5)
    return info.boundary_x == 'periodic' and beside < ROW


def inside(info, state=HENDERSON):
    """Density away from the walls, of N disks in all; without walls the density."""
    area = info.box_x * info.box_y
    mean = info.number / area
    if not any(_walls(info)):
        return mean

    def excess(density):
        return density * area + adsorbed(density, state) * _length(info) - info.number

    return brentq(excess, mean, FULL)


def tension(density):
    """Of a wall, counted from the wall on: centres stay half a sigma away from it."""
    return density / (2 * (1 - pi * density / 4))


def adsorbed(density, state=HENDERSON):
    """Disks more than density x area, a length of wall."""
    more, less = density * (1 + STEP), density * (1 - STEP)
    of_pressure = state.pressure(more) - state.pressure(less)
    return -density * (tension(more) - tension(less)) / of_pressure


def of_row(number, height, is_reflecting):
    """Of so many disks a length, in a row, exactly: the force F that belongs to this length is
    found from the largest eigenvalue of exp(-F s(y, y')) / F, s the distance along x at which disks
    at the heights y and y' touch. height: of the centres."""
    place = (np.arange(LEVELS) + 0.5) * height / LEVELS
    apart = np.abs(place[:, None] - place)
    if not is_reflecting:
        apart = np.minimum(apart, height - apart)
    contact = np.sqrt(1 - apart**2)
    force = brentq(lambda one: _length_of_row(one, contact) * number - 1, number, LARGEST)
    return float(force / number / sqrt(2))


def _length_of_row(force, contact):
    """A disk: -d ln(eigenvalue) / dF = 1 / F + <s>."""
    weights = np.exp(-force * (contact - contact.min()))
    last = np.linalg.eigh(weights)[1][:, -1]
    shares = last[:, None] * weights * last
    return 1 / force + float((shares * contact).sum() / shares.sum())


def _velocities(info, lengths, state):
    density, (wall_x, wall_y) = inside(info, state), _walls(info)
    p, gamma = state.pressure(density), tension(density)
    forces = p * info.box_y - 2 * gamma * wall_y, p * info.box_x - 2 * gamma * wall_x
    return np.array(forces) * lengths / (sqrt(2) * info.number)


def _walls(info):
    """(across x, across y)"""
    return tuple(int(boundary == 'reflecting') for boundary in (info.boundary_x, info.boundary_y))


def _length(info):
    wall_x, wall_y = _walls(info)
    return 2 * (wall_x * info.box_y + wall_y * info.box_x)


def _height(info):
    return info.box_y - _walls(info)[1]
