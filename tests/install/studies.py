#!/usr/bin/python3
"""studies.py PROGRAMS: quick runs of the studies of doc/findings/, built there: their numbers are
sound, the fits are those of least squares, and the pictures show something."""

import csv
import math
import os
import re
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


def drawn(test, *studies):
    """Lines that are said of the tables of the studies; their pictures show something."""
    done = run(sys.executable, DRAW, *(os.path.join(PROGRAMS, name + '.csv') for name in studies))
    test.assertEqual((done.returncode, done.stderr), (0, ''))
    pictures = [line for line in done.stdout.splitlines() if line.endswith('.png')]
    test.assertEqual(len(pictures), len(studies))
    for picture in pictures:
        pixels = matplotlib.image.imread(picture)
        test.assertGreater(pixels.shape[1], 500)
        test.assertGreater(pixels[..., :3].std(), SPREAD)
    return [line for line in done.stdout.splitlines() if not line.endswith('.png')]


WORDS = {'periodic', 'reflecting', 'none', 'disks', 'points', 'pp', 'exponent', 'T', 'LP'} | {
    'glass',
    'pure',
    'mass',
    'modes',
    'power',
    'wca',
    'lennard_jones',
    'verlet',
}


def number(text):
    return text if text in WORDS else float(text)


class Studies(unittest.TestCase):
    def test_halves_of_lp_modes(self):
        """The form of whole vectors vanishes, dp is hardly ahead, the pressure turns the phase."""
        (found,) = numbers('halves')
        self.assertEqual((found['nodes'], found['seeds']), (1, 2))
        self.assertLess(abs(found['sum rule']), 1e-6)
        self.assertLess(abs(found['angle']), 0.05)
        self.assertTrue(-0.09 < found['symmetric / mean'] < -0.03, found)
        self.assertAlmostEqual(found['v'] / found['P_xx / (sqrt(2) rho)'], 1, delta=0.06)
        self.assertTrue(0.5 < found['mean C'] / found['lambda'] < 0.8, found)
        self.assertEqual(drawn(self, 'halves'), [])  # one wave is no line

    def test_h_and_g_slow_the_rotation(self):
        """omega^2 = x^2 - h^2 - g^2 of the columns, but for the difference of two seeds."""
        (found,) = numbers('halves')
        x = found['P_xx / (sqrt(2) rho)'] * found['k'] / found['mean C']
        square = found['difference / mean'] ** 2 + found['symmetric / mean'] ** 2
        expected = found['sqrt(1 - (h^2 + g^2) / x^2)']
        self.assertAlmostEqual(expected, math.sqrt(1 - square / x**2), delta=1e-4)
        self.assertTrue(0.9985 < expected < 0.9997, found)
        self.assertAlmostEqual(
            found['v over that of pressure and C'],
            found['v'] / (found['P_xx / (sqrt(2) rho)'] * expected),
            delta=1e-3,
        )

    def test_sound_is_twice_as_fast_in_a_row_of_disks(self):
        (found,) = numbers('sound')
        rods = 1 / (1 - 0.8)  # P / (rho kT) where disks are hardly off a line; some less
        pressure = 2**0.5 * found['P_xx / (sqrt(2) rho)']
        self.assertTrue(0.7 * rods < pressure < rods, found)
        self.assertAlmostEqual(found['sound'] / pressure, 2**0.5, delta=0.07 * 2**0.5)
        self.assertAlmostEqual(found['v'] / pressure, 0.5**0.5, delta=0.07 * 0.5**0.5)
        self.assertAlmostEqual(found['k'], 2 * math.pi * 0.8 / 50, delta=1e-5)
        by_pressure = found['sound of the pressure'] / pressure
        self.assertAlmostEqual(by_pressure, 2**0.5, delta=0.07 * 2**0.5)
        (line,) = drawn(self, 'sound')
        self.assertIn(f"{found['sound'] / found['v']:.4f} +-", line)

    def test_dilute_gases(self):
        """h_KS / N nu = (B - ln rho) / 2; nu is Enskog's but for 1/N; all of 16 disks. Both
        fluctuate together: of 4000 collisions apiece h_KS is known to 0.5 %, the ratio better."""
        table = numbers('dilute')
        for found in table:
            rho, rate = found['density'], found['collisions of a disk']
            self.assertTrue(0.96 < rate / (2 * math.pi**0.5 * rho) < 1.15, found)
            entropy = found['h_KS / N over it']
            self.assertTrue(0.0003 < found['h_KS error'] / entropy < 0.002, found)
            if rho <= 0.01:
                self.assertAlmostEqual(2 * entropy + math.log(rho), 1.3, delta=0.02)
        self.assertGreater(table[-1]['lambda_1 over it'], 13)
        self.assertEqual(drawn(self, 'dilute'), [])  # one size is no line in 1 / N

    def test_dumbbells(self):
        """Exponents of a step part as their ln R trembles, a sixth of an LP vector turns, and v is
        that of the pressure with three coordinates; of disks nothing turns."""
        table = numbers('dumbbells')
        exponents = [row for row in table if row['kind'] == 'exponent']
        ours = [row for row in exponents if row['bond']]
        self.assertEqual((len(ours), len(exponents) - len(ours)), (3 * 36 - 3, 2 * 36 - 3))
        self.assertEqual(sum(row['rotation'] for row in exponents if not row['bond']), 0)
        error = math.hypot(0.004, ours[0]['lambda error'])
        self.assertAlmostEqual(ours[0]['lambda'], 5.238, delta=4 * error)
        (t,), (lp,) = (
            [row for row in table if row['bond'] and (row['kind'], row['nx']) == (kind, 1)]
            for kind in ('T', 'LP')
        )
        self.assertAlmostEqual(t['rotation'], 0.018, delta=0.004)
        self.assertAlmostEqual(lp['rotation'], 0.184, delta=0.01)
        four = [row['lambda'] for row in ours if lp['index'] <= row['index'] < lp['index'] + 4]
        self.assertAlmostEqual(lp['apart'], (four[0] - four[3]) / 3, 5)
        error = math.hypot(lp['apart error'], lp['trembling error'])
        self.assertAlmostEqual(lp['apart'], lp['trembling'], delta=4 * error)
        velocity = lp['omega'] / lp['k'] * 0.6 * math.sqrt(3 * lp['kT'])
        self.assertAlmostEqual(velocity / lp['P_xx'], 0.986, delta=0.02)
        kicks = lp['rate'] * 0.25 * math.sqrt(lp['kT'] / math.pi) / (0.25**2 / 4 + 0.125)
        rotor = math.sqrt(kicks) - math.pi * kicks / (16 * lp['rate'])
        said = '\n'.join(drawn(self, 'dumbbells'))
        self.assertIn(f'of free rotors {rotor:.4f}', said)
        self.assertIn(
            f'LP of dumbbells: distance over trembling {lp["apart"] / lp["trembling"]:.3f}', said
        )
        self.assertIn(f'over that of the pressure {velocity / lp["P_xx"]:.4f}', said)

    def test_soft_disks(self):
        """At density 0.2 six vectors hold most of T and LP, most of the flow lies in the span of
        the unstable vectors and none of the gradient, and the pressure is above that of a gas."""
        table = numbers('soft')
        self.assertEqual(len(table), 2 * 64 - 3)
        first = table[0]
        self.assertAlmostEqual(first['k'], 2 * math.pi * 0.2 * 5.2 / 64, delta=1e-5)
        self.assertAlmostEqual(first['kinetic'], 0.973, delta=0.004)
        gas = 0.2 * first['kinetic'] * 64 / 63  # rho kT; of disks by Henderson 1.39 times that
        self.assertAlmostEqual(first['P_xx'] / gas, 1.2, delta=0.1)
        self.assertLess(first['climb'], 0.1)
        flow = sum(row['flow'] for row in table)
        self.assertAlmostEqual(flow, 0.77, delta=0.12)
        cosine = sum(row['cos Theta'] for row in table[-6:]) / 6
        self.assertAlmostEqual(cosine, 0.52, delta=0.12)
        both = sorted(row['T'] + row['L'] + row['P'] for row in table)
        self.assertAlmostEqual(sum(both), 6, delta=1)  # of fields that all but zero modes hold
        held = sum(both[-6:]) / 6
        self.assertTrue(0.4 < held < 0.9, held)
        covariant = sorted(sum(row['covariant ' + name] for name in 'TLP') for row in table)
        self.assertTrue(0.4 < sum(covariant[-6:]) / 6 < 0.95, covariant[-6:])
        said = '\n'.join(drawn(self, 'soft'))
        self.assertIn(f'flow {flow:.3f}', said)
        self.assertIn(f'both held {held:.2f}', said)

    def test_time_steps(self):
        """Verlet's error of the energy is of second order; a step that is too long is said to be
        one; the third zero of wca stands out."""
        table = numbers('time_steps')
        power, wca, pulling = (table[first : first + 2] for first in (0, 2, 4))
        self.assertEqual([row['step'] for row in power], [0.008, 0.004])
        ratio = power[0]['energy error'] / power[1]['energy error']
        self.assertTrue(2.5 < ratio < 5, ratio)
        for rows, known in ((power, 2.718), (wca, 3.02), (pulling[1:], 4.71)):
            for row in rows:
                error = math.hypot(0.01, row['lambda_1 error'])
                self.assertAlmostEqual(row['lambda_1'], known, delta=4 * error)
        self.assertGreater(wca[0]['third zero'], 2 * power[0]['third zero'])
        self.assertTrue(math.isnan(pulling[0]['lambda_1']))
        said = '\n'.join(drawn(self, 'time_steps'))
        self.assertIn('lennard_jones, verlet, step 0.008: the energy is lost', said)
        self.assertIn(f'power, verlet, step 0.008: energy {power[0]["energy error"]:.1e}', said)

    def test_fits_are_those_of_least_squares(self):
        """Made-up tables: B = 1.4 - 1 / N with errors of 0.01, one value of eight off by three."""
        path = os.path.join(PROGRAMS, 'made_up.csv')
        names = 'density,disks,h_KS / N over it,h_KS error,lambda_1 over it,lambda_1 error'
        with open(path, 'w', encoding='utf-8') as file:
            file.write(names + '\n')
            for density in (0.01, 0.001):
                for disks, off in ((10, 0), (20, 0.03 * (density < 0.01)), (50, 0), (100, 0)):
                    b = 1.4 - 1 / disks + off
                    file.write(f'{density},{disks},{(b - math.log(density)) / 2},0.005,9,0.1\n')
        (line,) = drawn(self, 'made_up')
        found = [float(one) for one in re.findall(r'-?\d+\.?\d*', line.replace('^2', ''))]
        matrix = [[1, 1 / disks] for disks in (10, 20, 50, 100)] * 2
        ones, ends, squares = (sum(row[1] ** power for row in matrix) for power in (0, 1, 2))
        self.assertAlmostEqual(
            found[1], 0.01 * math.sqrt(squares / (ones * squares - ends**2)), 4
        )
        self.assertAlmostEqual(found[3], 0.01 * math.sqrt(ones / (ones * squares - ends**2)), 4)
        self.assertAlmostEqual(found[0] + found[2] * ends / ones, 1.4 - ends / ones + 0.03 / 8, 3)
        self.assertEqual(found[-1], 6)  # of eight values
        leverage = 1 / 8 + (0.05 - ends / 8) ** 2 / (squares - ends**2 / 8)
        self.assertAlmostEqual(found[-2], 9 * (1 - leverage), 1)

    def test_mixtures(self):
        """Vectors of half of heavy disks live on the light ones, T has its part of the mass on the
        second kind, and the pressure is that of theory."""
        table = numbers('mixtures')
        heavy = [row for row in table if row['part'] == 'mass']
        self.assertEqual({row['mass'] for row in heavy}, {10})
        self.assertAlmostEqual(heavy[0]['second kind of vector 1'], 0.12, delta=0.06)
        former = [row for row in table if row['part'] == 'glass' and row['packing'] == 0.4]
        self.assertAlmostEqual(former[0]['Z'], 2.81, delta=0.15)
        (t,) = (row for row in former if (row['kind'], row['nx'], row['ny']) == ('T', 1, 0))
        self.assertAlmostEqual(t['second kind of step'], 34 / 96, delta=0.05)
        said = '\n'.join(drawn(self, 'mixtures'))
        self.assertIn(f'mass 10: lambda_1 {heavy[0]["lambda_1"]:.4f}', said)

    def test_a_bad_argument_gives_one_line_and_status_2(self):
        for name in ('halves', 'sound', 'dilute', 'dumbbells', 'soft', 'time_steps', 'mixtures'):
            done = run(os.path.join(PROGRAMS, name), '--nonsense')
            self.assertEqual((done.returncode, done.stderr.count('\n')), (2, 1), name)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
