"""The reproduction over a made world: numbers are those of the world; what is said of each
statement, and drawn, stays as in reproduction_made.txt (test_reproduction.py --write writes it
anew)."""
# Second tier: tests/run.sh --all

import os
import re
import sys
import unittest
import zlib
from math import isfinite, sqrt
from numbers import Real

import matplotlib.pyplot as plt
import numpy as np

import damaged
import made
import reproduced
from drawn import digest
from hdlyap.plots import paper
from hdlyap.plots.figures.style import STYLE
from reproduced import PARTS, Bag, of_part, plan, world

GOLDEN = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'reproduction_made.txt')
NUMBER = re.compile(r'[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?')
LETTERS = str.maketrans('0123456789', 'ghijklmnop')  # of a sum, which is no number
DRIFT = 2.01  # last digits of a number, on another machine
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


# ---- all that is said and drawn ------------------------------------------------------------------


def summary(bags):
    """A line for each statement: verdict, measured values, means of its numbers and of those in its
    remarks, a sum of its texts; and for each figure."""
    with plt.rc_context(STYLE):
        for part in PARTS:
            of_it = of_part(part, bags)
            for one in part.claims(of_it):
                numbers = [(row.measured, row.error, row.left_open) for row in one.rows]
                known = [value for row in numbers for value in row if isinstance(value, Real)]
                texts = [(row.quantity, row.measured, row.remark, row.caught) for row in one.rows]
                texts = [text for some in texts for text in some if isinstance(text, str)]
                verdict = f'{one.verdict or "shown"} ({one.values})'
                about = ' '.join([verdict, mean(known, 6), *of_texts(texts)])
                yield f'{part.number}. {one.name}: {about}'
            for name, figure in part.figures(of_it):
                yield f'{part.number}. figure {name}: {" ".join(of_texts(digest(figure)))}'
                plt.close(figure)


def of_texts(texts):
    """(mean of the numbers in them, sum of the rest)"""
    text = '\n'.join(map(str, texts))
    numbers, rest = map(float, NUMBER.findall(text)), NUMBER.sub('#', text)
    return mean(numbers, 4), f'{zlib.crc32(rest.encode()):08x}'.translate(LETTERS)


def mean(values, digits):
    """In which small numbers count as much as large ones, and their order does."""
    values = np.arcsinh(1e6 * np.array([one for one in values if isfinite(one)], dtype=float))
    order = 1 + 0.1 * np.sin(np.arange(len(values)))
    return f'{np.sum(order * values) / max(1, len(values)):.{digits}f}'


def written():
    worlds = world(), {name: Bag(damaged.messages(name), name) for name in plan()}
    return [line for bags in worlds for line in summary(bags)]


def is_alike(one, other):
    """But for the last digits of means."""
    if NUMBER.sub('#', one) != NUMBER.sub('#', other):
        return False
    pairs = zip(NUMBER.findall(one), NUMBER.findall(other))
    return all(abs(float(a) - float(b)) <= _drift(a) for a, b in pairs)


def _drift(text):
    _, point, decimals = text.partition('.')
    return DRIFT * 10.0 ** -len(decimals) if point else 0.0


class Everything(unittest.TestCase):
    def test_is_as_it_was(self):
        with open(GOLDEN) as file:
            before = file.read().splitlines()
        now = written()
        off = [f'{one}\n  now: {two}' for one, two in zip(before, now) if not is_alike(one, two)]
        self.assertEqual(off, [], '--write makes it anew, once each of these is understood')
        self.assertEqual(len(before), len(now))

    def test_what_is_alike(self):
        one = f'agrees (2) {mean([1.0, 1e-3], 6)} {" ".join(of_texts(["v 1.5 at k"]))}'
        for values, text, count, expected in (
            ([1.0 + 1e-6, 1e-3], 'v 1.5 at k', 2, True),
            ([1.0, 1.001e-3], 'v 1.5 at k', 2, False),
            ([1e-3, 1.0], 'v 1.5 at k', 2, False),
            ([1.0, 1e-3], 'v 1.6 at k', 2, False),
            ([1.0, 1e-3], 'v 1.5 of k', 2, False),
            ([1.0, 1e-3], 'v 1.5 at k', 3, False),
        ):
            other = f'agrees ({count}) {mean(values, 6)} {" ".join(of_texts([text]))}'
            self.assertEqual(is_alike(one, other), expected, other)


if __name__ == '__main__':
    if '--write' in sys.argv:
        with open(GOLDEN, 'w') as file:
            file.writelines(line + '\n' for line in written())
    else:
        unittest.main()
