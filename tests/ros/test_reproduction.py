"""The reproduction over a made world: numbers are those of the world; every number and figure
stays what it is in reproduction_made.txt
(test_reproduction.py --write writes it anew)."""
# Second tier: tests/run.sh --all

import os
import re
import sys
import unittest
from math import sqrt

import numpy as np

import damaged
import made
import reproduced
from drawn import digest
from hdlyap.plots import paper
from hdlyap.plots.figures.style import STYLE, plt
from reproduced import PARTS, Bag, of_part, plan, world

GOLDEN = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'reproduction_made.txt')
NUMBER = re.compile(r'[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?')
DRIFT = 1e-5  # relative: of numbers on another machine
NOISE = 1e-11  # what is zero but for rounding
SIGMAS = 4.5


# ---- numbers -------------------------------------------------------------------------------------

K = made.wave_number(reproduced.info_of('periodic'), 1, 0)
V = reproduced.velocity(reproduced.info_of('periodic'), (1, 0))
OF_WALLS = reproduced.info_of('reflecting')
RATE = made.wave_number(OF_WALLS, 1, 0) * reproduced.velocity(OF_WALLS, (1, 0))
ETA = 0.2 * np.pi / 4
HENDERSON = (1 + ETA**2 / 8) / (1 - ETA) ** 2
TRUTH = {
    'exponent of LP(1,0)': 1.015 * paper.slope_l(0.8) * K,
    'c_T of lambda = c k + c2 k^2': paper.slope_t(0.8),
    'c_T2 of lambda = c k + c2 k^2': 0.0,
    'ratio of the amplitudes on A': 1.0,
    'quarter period of LP(1,0)': np.pi / 2 / RATE,
    'omega of LP(1,0), reflecting': RATE,
    'a^2 + b^2 of LP(1,0), mean': reproduced.STRENGTH * (1 + reproduced.SWAY**2 / 2),
    'omega / k of LP(1,0)': V,
    'v, common': V,
    'c_T at density 0.5': paper.slope_t(0.5),
    'c_L at density 0.1': paper.slope_l(0.1),
    'v - c_L at density 0.5': reproduced.velocity(reproduced.info_of('density_05'), (1, 0))
    - paper.slope_l(0.5),
    'c_T - c_L at density 0.2': paper.slope_t(0.2) - paper.slope_l(0.2),
    'c of lambda_T': 1.412,
    'c2 of lambda_T': 0.086,
    'c of lambda_L': 1.422,
    'c2 of lambda_L': 0.55,
    'c2 of lambda_L less c2 of lambda_T': 0.55 - 0.086,
    'C on L over C on P, of dp = C dq': 0.51 / 0.8 / (1.45 / 0.8 / sqrt(8)),
    'the same at L less that mean': 2 * reproduced.SYMMETRIC / (0.51 / 0.8 + 1.45 / 0.8 / sqrt(8)),
    'angle of dp ahead of dq, mean of a turn': 0.0,
    'front velocity / (omega / k), same times': 1.0,
    'omega / k of LP(1,0), same run': V,
    'omega / v k of LP(1,0), periodic': 1.0,
    'width of T(1,0), as a wave': 2 / np.e + 0.001,
    'mean free path at density 0.2': ETA / (sqrt(2) * 0.2 * (HENDERSON - 1)),
    'v over P / (sqrt 2 rho) at k = 0, periodic, density 0.4': reproduced.START,
    'v over P / (sqrt 2 rho) at k = 0, between walls, density 0.4': reproduced.START,
    'v: walls over periodic at equal k, less 1, density 0.4': 0.0,
    'p of bulk': 1.0,
    'p of lambda_1': 1.0,
    '2 samples joined, bulk': 1.0,
}


class Numbers(unittest.TestCase):
    def test_of_the_world(self):
        """Within the errors that they state."""
        found = {}
        for part in PARTS:
            rows = [row for one in part.claims(of_part(part, world())) for row in one.rows]
            names = [row.quantity for row in rows]
            self.assertEqual(len(names), len(set(names)), part.title)
            found.update(zip(names, rows))
        for name, truth in TRUTH.items():
            row = found[name]
            with self.subTest(name):
                self.assertTrue(row.error > 0)
                self.assertLessEqual(abs(row.measured - truth), SIGMAS * row.error)

    def test_of_a_bag_without_its_topics(self):
        """Nothing is measured, drawn or judged."""
        known = {'width of a random vector'}
        bags = {name: Bag([bag.info, made.cost(1.0)], name) for name, bag in world().items()}
        for part in PARTS:
            of_it = of_part(part, bags)
            rows = [row for one in part.claims(of_it) for row in one.rows]
            names = {row.quantity for row in rows if row.verdict != 'not measured'}
            self.assertLessEqual(names, known, part.title)
            self.assertEqual(list(part.figures(of_it)), [])


# ---- all that is said, written and drawn ---------------------------------------------------------


def summary(bags):
    """Lines of text."""
    with plt.rc_context(STYLE):
        for part in PARTS:
            of_it = of_part(part, bags)
            yield f'{part.number}. {part.title}'
            for claim in part.claims(of_it):
                yield f'{claim.verdict}: {claim.name} ({claim.values})'
                yield from ('  ' + ' | '.join(map(str, row.values())) for row in claim.rows)
            for name, figure in part.figures(of_it):
                yield f'figure {name}'
                yield from digest(figure)
                plt.close(figure)


def written():
    worlds = world(), {name: Bag(damaged.messages(name), name) for name in plan()}
    for bags in worlds:
        yield from (line.rstrip().replace('\n', '; ') for line in summary(bags))


def is_alike(one, other):
    """But for the last digit of a number, and for what is only rounding."""
    if NUMBER.sub('#', one) != NUMBER.sub('#', other):
        return False
    return all(map(_are_alike, NUMBER.findall(one), NUMBER.findall(other)))


def _are_alike(one, other):
    a, b = float(one), float(other)
    mantissa, _, power = max(one, other, key=len).partition('e')
    decimals = len(mantissa.partition('.')[2]) or int(bool(power))
    last = 10.0 ** (int(power or 0) - decimals)
    exact = not set('.e') & set(one + other)
    return one == other if exact else abs(a - b) <= 1.01 * last + DRIFT * abs(a) + NOISE


class Everything(unittest.TestCase):
    def test_is_as_it_was(self):
        with open(GOLDEN) as file:
            before = file.read().splitlines()
        now = list(written())
        off = [f'{one}\n  now: {two}' for one, two in zip(before, now) if not is_alike(one, two)]
        self.assertEqual(off, [], '--write makes it anew, once each of these is understood')
        self.assertEqual(len(before), len(now))

    def test_what_is_alike(self):
        for one, other, expected in (
            ('v 1.2345 of 3', 'v 1.2346 of 3', True),
            ('v 1.2345 of 3', 'v 1.2349 of 3', False),
            ('indices 5-6', 'indices 5-7', False),
            ('a 1.0', 'b 1.0', False),
            ('7.1e-03', '7.2e-03', True),
            ('7.1e-03', '7.4e-03', False),
            ('2e-08', '1e-08', False),
            ('3.1e-17', '2e-15', True),
        ):
            self.assertEqual(is_alike(one, other), expected)


if __name__ == '__main__':
    if '--write' in sys.argv:
        with open(GOLDEN, 'w') as file:
            file.writelines(line + '\n' for line in written())
    else:
        unittest.main()
