#!/usr/bin/python3
"""studies.py PROGRAMS: quick runs of the studies of doc/findings/, built there: their numbers are
sound, and the picture shows something."""

import csv
import math
import os
import subprocess
import sys
import unittest

import matplotlib

matplotlib.use('Agg')
import matplotlib.image  # noqa: E402

PROGRAMS = sys.argv[1]
DRAW = os.path.join(os.path.dirname(__file__), '../../doc/findings/findings.py')
SPREAD = 0.05  # of the grey values of a picture that shows something


def run(*command):
    return subprocess.run(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        check=False,
    )


def numbers(study):
    """Rows of a table, which is left beside its program: names without units -> numbers."""
    done = run(os.path.join(PROGRAMS, study), '--quick')
    with open(os.path.join(PROGRAMS, study + '.csv'), 'w', encoding='utf-8') as file:
        file.write(done.stdout)
    comment, *lines = done.stdout.splitlines()
    assert done.returncode == 0 and comment.startswith('# hdlyap ') and len(lines) > 1, done
    return [
        {key.partition(' [')[0]: number(text) for key, text in row.items()}
        for row in csv.DictReader(lines)
    ]


def number(text):
    """Of all columns but one."""
    return text if text in ('periodic', 'reflecting') else float(text)


class Studies(unittest.TestCase):
    def test_halves_of_lp_modes(self):
        """The form of whole vectors vanishes, dp is hardly ahead, the pressure turns the phase."""
        (found,) = numbers('halves')
        self.assertEqual(found['nodes'], 1)
        self.assertLess(abs(found['sum rule']), 1e-6)
        self.assertLess(abs(found['angle']), 0.05)
        self.assertTrue(-0.09 < found['symmetric / mean'] < -0.03, found)
        self.assertAlmostEqual(found['v'] / found['P_xx / (sqrt(2) rho)'], 1, delta=0.06)
        self.assertTrue(0.5 < found['mean C'] / found['lambda'] < 0.8, found)
        drawn = run(sys.executable, DRAW, os.path.join(PROGRAMS, 'halves.csv'))
        self.assertEqual((drawn.returncode, drawn.stderr), (0, ''))
        pixels = matplotlib.image.imread(drawn.stdout.strip())
        self.assertGreater(pixels.shape[1], 500)
        self.assertGreater(pixels[..., :3].std(), SPREAD)

    def test_sound_is_twice_as_fast_in_a_row_of_disks(self):
        (found,) = numbers('sound')
        rods = 1 / (1 - 0.8)  # P / (rho kT) where disks are hardly off a line; some less
        pressure = 2**0.5 * found['P_xx / (sqrt(2) rho)']
        self.assertTrue(0.7 * rods < pressure < rods, found)
        self.assertAlmostEqual(found['sound'] / pressure, 2**0.5, delta=0.07 * 2**0.5)
        self.assertAlmostEqual(found['v'] / pressure, 0.5**0.5, delta=0.07 * 0.5**0.5)

    def test_dilute_gases(self):
        """h_KS / N nu = (B - ln rho) / 2; nu is Enskog's but for 1/N; all of 16 disks."""
        table = numbers('dilute')
        for found in table:
            rho, rate = found['density'], found['collisions of a disk']
            self.assertTrue(0.96 < rate / (2 * math.pi**0.5 * rho) < 1.15, found)
            entropy = found['h_KS / N over it']
            if rho <= 0.01:
                self.assertAlmostEqual(2 * entropy + math.log(rho), 1.3, delta=0.15)
        self.assertGreater(table[-1]['lambda_1 over it'], 13)

    def test_a_bad_argument_gives_one_line_and_status_2(self):
        for name in ('halves', 'sound', 'dilute'):
            done = run(os.path.join(PROGRAMS, name), '--nonsense')
            self.assertEqual((done.returncode, done.stderr.count('\n')), (2, 1), name)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
