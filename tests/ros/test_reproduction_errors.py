"""An error that the reproduction states covers the truth in as many of all trials as a standard
error should, whatever the estimate."""

import os
import sys
import unittest

import numpy as np
import pytest

import made
from hdlyap.data import waves
from hdlyap.msg import LpPhase

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, '../../doc/reproduction'))

from study import averages, blocks  # noqa: E402
from study.measures import travelling  # noqa: E402
from study.polynomials import Polynomial, crossing  # noqa: E402
from study.rotation import Rotation  # noqa: E402

pytestmark = pytest.mark.second_tier

TRIALS = 400
SAMPLES = 640


def walk(rng, count, memory=0.5):
    """Numbers that remember their neighbours, with the variance 1."""
    noise = rng.normal(size=count + 100)
    for i in range(1, len(noise)):
        noise[i] = memory * noise[i - 1] + np.sqrt(1 - memory**2) * noise[i]
    return noise[100:]


def weighted(rng):
    """Of values with errors that are right."""
    errors = rng.uniform(0.5, 2, 12)
    return averages.weighted(3 + errors * rng.normal(size=12), errors)[:2]


def of_ratio(rng):
    below = 2 + 0.5 * walk(rng, SAMPLES)
    return blocks.quotient(0.7 * below + walk(rng, SAMPLES), below)


def leading(rng, degree):
    """Of a line through points with errors of both, of a parabola through points with one."""
    x, errors, x_errors = np.linspace(1, 4, 9), np.full(9, 0.05), np.full(9, 0.05 * (degree == 1))
    y = 2 + 1.3 * x - 0.4 * (degree - 1) * x**2 + errors * rng.normal(size=9)
    points = np.column_stack([x + x_errors * rng.normal(size=9), x_errors, y, errors])
    return Polynomial(points, degree).leading


def where_it_crosses(rng):
    x, errors = np.arange(8) / 10, np.full(8, 0.004)
    return crossing(x, 0.5 * (x - 0.33) * (1 + x) + errors * rng.normal(size=8), errors)


def of_two(rng, combined):
    return combined((6 + 0.06 * rng.normal(), 0.06), (3 + 0.03 * rng.normal(), 0.03))


def turning(rng):
    """Two vectors of LP(1,0) between L and P at omega = 0.8, with phases that diffuse together."""
    info, time = made.run_info(), 0.5 * np.arange(SAMPLES)
    bits = 2 * list(waves.modulations(info, 1, 0))
    first = [LpPhase(nx=1, ny=0, modulation=one) for one in bits]
    phase = 0.8 * time + 0.1 * np.cumsum(rng.normal(size=SAMPLES))
    phase = phase[:, None] - np.tile([0.0, np.pi / 2], 2)
    ones = np.ones_like(phase)
    parts = np.cos(phase), np.sin(phase), phase, time[:, None] * ones, ones, LpPhase.TRACKED * ones
    return Rotation(info, first, time, np.stack(parts, axis=2))


def front(rng):
    """Of the front over k, at the rate of the phases."""
    found = max(travelling.fronts(turning(rng)), key=lambda one: one.length)
    value, error = found.velocity()
    return value * found.wave_number, error * found.wave_number


ESTIMATES = {  # name: (value and error of one trial, truth)
    'mean of snapshots': (lambda rng: averages.of_snapshots(2 + rng.normal(size=12)), 2.0),
    'mean of a series': (lambda rng: averages.of_series(2 + walk(rng, SAMPLES)), 2.0),
    'mean of blocks': (lambda rng: blocks.mean(2 + walk(rng, SAMPLES)), 2.0),
    'ratio of sums': (of_ratio, 0.7),
    'weighted mean': (weighted, 3.0),
    'difference': (lambda rng: of_two(rng, averages.difference), 3.0),
    'quotient': (lambda rng: of_two(rng, averages.quotient), 2.0),
    'slope': (lambda rng: leading(rng, 1), 1.3),
    'curvature': (lambda rng: leading(rng, 2), -0.4),
    'crossing': (where_it_crosses, 0.33),
    'rate of turning': (lambda rng: turning(rng).omega(), 0.8),
    'rate of a front': (front, 0.8),
}


class Errors(unittest.TestCase):
    def test_cover_the_truth(self):
        """Of as few blocks as these an error is known to a fifth: one of them covers 66 %."""
        for number, (name, (trial, truth)) in enumerate(ESTIMATES.items()):
            rng = np.random.default_rng(number)
            found = np.array([trial(rng) for _ in range(TRIALS)], dtype=float)
            off = (found[:, 0] - truth) / found[:, 1]
            with self.subTest(name, inside=np.mean(abs(off) < 1), bias=off.mean()):
                self.assertAlmostEqual(np.mean(abs(off) < 1), 0.67, delta=0.08)
                self.assertLess(abs(off.mean()), 0.25)
