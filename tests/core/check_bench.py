#!/usr/bin/python3
"""check_bench.py RUN_SH PROGRAMS FOLDER: the benchmark's quick run leaves sound tables and pictures
there."""

import csv
import math
import os
import subprocess
import sys
import unittest

import matplotlib

matplotlib.use('Agg')
import matplotlib.image  # noqa: E402

COLUMNS = {  # the first ones of each table, without units
    'precision': ['method', 'interval', 'accuracy asked', 'status', 'deviation of the largest'],
    'scaling': ['sweep', 'disks', 'vectors', 'threads', 'interval'],
    'scaling_fits': ['sweep', 'part', 'fitted power', 'theory'],
    'whole': ['quantity', 'disks', 'minimum', 'median', 'maximum', 'rounds'],
    'whole_small': ['quantity', 'disks', 'minimum', 'median', 'maximum', 'rounds'],
}
PICTURES = ('precision', 'scaling')
ACCURACY = 1e-8  # asked for, and so the largest deviation allowed
SPREAD = 0.05  # of the grey values of a picture that shows something
RUN_SH, PROGRAMS, FOLDER = sys.argv[1:4]


def table(name):
    with open(os.path.join(FOLDER, name + '.csv'), encoding='utf-8') as file:
        comment = file.readline()
        return comment, list(csv.DictReader(file))


def numbers(name):
    """Rows of a table: names without units -> numbers."""
    return [
        {key.partition(' [')[0]: float(text) for key, text in row.items() if is_number(text)}
        for row in table(name)[1]
    ]


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


class Bench(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([RUN_SH, '--quick', '--out', FOLDER, '--programs', PROGRAMS], check=True)

    def test_comments_name_machine_and_command(self):
        for name in COLUMNS:
            comment, _ = table(name)
            for part in ('# ', 'kernels', 'threads', 'dgemm', 'GF/s', 'command: '):
                self.assertIn(part, comment, name)

    def test_columns(self):
        for name, wanted in COLUMNS.items():
            _, rows = table(name)
            self.assertTrue(rows, name)
            names = [column.partition(' [')[0] for column in rows[0]]
            self.assertEqual(names[: len(wanted)], wanted, name)

    def test_numbers_are_finite(self):
        for name in COLUMNS:
            for row in table(name)[1]:
                self.assertNotIn(None, row, name)
                for column, text in row.items():
                    self.assertFalse(text is None or text == '', f'{name}: {column}')
                    if is_number(text):
                        self.assertTrue(math.isfinite(float(text)), f'{name}: {column} = {text}')

    def test_interval_that_hdlyap_chooses_is_as_accurate_as_asked(self):
        chosen = [
            row
            for row in table('precision')[1]
            if row['method'] == 'auto' and float(row['accuracy asked [1/time unit]']) == ACCURACY
        ]
        self.assertEqual(len(chosen), 1)
        self.assertEqual(chosen[0]['status'], 'ok')
        deviation = float(chosen[0]['deviation of any [1/time unit]'])
        self.assertTrue(0 <= deviation < ACCURACY, deviation)

    def test_too_long_an_interval_is_seen_to_be_wrong(self):
        longest = [row for row in table('precision')[1] if row['method'] == 'householder'][-1]
        self.assertEqual(longest['status'], 'ok')
        self.assertGreater(float(longest['deviation of any [1/time unit]']), 1e-3)

    def test_pictures_show_something(self):
        for name in PICTURES:
            pixels = matplotlib.image.imread(os.path.join(FOLDER, name + '.png'))
            self.assertGreater(pixels.shape[1], 500, name)
            self.assertGreater(pixels[..., :3].std(), SPREAD, name)

    def test_nothing_unfinished_is_left(self):
        self.assertEqual([name for name in os.listdir(FOLDER) if '.part' in name], [])

    def test_bad_arguments_give_one_line_and_status_2(self):
        for command in ('bench', 'precision', 'scaling', 'effects'):
            for given in (['--nonsense'], ['--out', '/nowhere']):
                run = subprocess.run(
                    [os.path.join(PROGRAMS, 'hdlyap_' + command), *given],
                    stderr=subprocess.PIPE,
                    universal_newlines=True,
                    check=False,
                )
                self.assertEqual((run.returncode, run.stderr.count('\n')), (2, 1), command)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
