#!/usr/bin/python3
"""check_endurance.py PROGRAM COLLISIONS FOLDER: after so many collisions rounding has done what a
random walk of rounding errors does, and no more."""

import csv
import math
import os
import subprocess
import sys
import unittest

PROGRAM, COLLISIONS, FOLDER = sys.argv[1], float(sys.argv[2]), sys.argv[3]
EPSILON = sys.float_info.epsilon
DISKS, DENSITY = 100, 0.7
BOX = math.sqrt(DISKS / DENSITY)
Z = 5.0  # standard deviations of a walk that its largest excursion does not reach

# Of one collision, energy: its four momenta are rounded, each to eps p / sqrt(12) rms, and <p^4> =
# 3, together below 1 eps; what is exchanged is wrong by some eps of b^2, and <b^4> = 32: 3.5 eps.
# Seen: 2 to 3 eps. A drift of the 3e-16 that r.r rounded near 1 would give exceeds the bound after
# some 1e4 collisions.
ENERGY_STEP = 4.0 * EPSILON
# One component: two momenta are rounded, each to eps p / sqrt(12) rms, and <p^2> = 1.
MOMENTUM_STEP = 0.5 * EPSILON
MOMENTUM_START = 4.0 * EPSILON  # per disk, when the mean is taken out and all are scaled
# Two coordinates of size L, each with four roundings of eps L / 2 (test_trajectory_conservation.c);
# times of size 4 and r^2 of size 9 in the prediction of a contact. It does not grow.
OVERLAP = (4.0 * BOX + 16.0) * EPSILON


class Endurance(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(FOLDER, exist_ok=True)
        command = [
            PROGRAM,
            '--collisions',
            repr(COLLISIONS),
            '--disks',
            str(DISKS),
            '--density',
            str(DENSITY),
        ]
        cls.printed = subprocess.run(
            command + ['--out', FOLDER], stdout=subprocess.PIPE, check=True, universal_newlines=True
        ).stdout.splitlines()
        with open(os.path.join(FOLDER, 'endurance.csv'), encoding='utf-8') as file:
            cls.comment = file.readline()
            rows = [[float(number) for number in row] for row in list(csv.reader(file))[1:]]
        cls.collisions, cls.time, cls.energy, cls.momentum, cls.overlap = zip(*rows)

    def check_below(self, seen, allowed):
        for k, value in enumerate(seen):
            self.assertTrue(
                0.0 <= value <= allowed[k],
                f'{value:.3g} > {allowed[k]:.3g} after {self.collisions[k]:.0f} collisions',
            )

    def walk(self, step):
        return [Z * step / DISKS * math.sqrt(count) for count in self.collisions]

    def test_the_table_goes_to_the_end(self):
        self.assertGreaterEqual(self.collisions[-1], COLLISIONS)
        self.assertLess(self.collisions[-1], 1.2 * COLLISIONS)
        self.assertEqual(list(self.collisions), sorted(self.collisions))
        self.assertEqual(len(self.printed), 2 + len(self.collisions))
        self.assertIn('command: ', self.comment)

    def test_energy_walks(self):
        self.check_below(self.energy, self.walk(ENERGY_STEP))

    def test_momentum_walks(self):
        self.check_below(
            self.momentum, [MOMENTUM_START + bound for bound in self.walk(MOMENTUM_STEP)]
        )

    def test_overlap_stays(self):
        self.check_below(self.overlap, [OVERLAP] * len(self.overlap))
        self.assertGreater(self.overlap[-1], 0.0)

    def test_time_is_counted(self):
        """Enskog's collision rate with Henderson's contact value is right to a percent."""
        eta = math.pi * DENSITY / 4.0
        contact = (1.0 - 7.0 * eta / 16.0) / (1.0 - eta) ** 2
        rate = math.sqrt(math.pi) * DENSITY * contact * DISKS
        self.assertAlmostEqual(self.collisions[-1] / (rate * self.time[-1]), 1.0, delta=0.02)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
