#!/usr/bin/python3
"""check_ranks_model.py MODEL_FOLDER PROGRAM MPIRUN...: calls and bytes that ranks_model.py counts
for an orthonormalisation are those that hdlyap_ranks counts as it makes them."""

import re
import subprocess
import sys
import unittest

FOLDER, PROGRAM, *MPIRUN = sys.argv[1:]
sys.path.insert(0, FOLDER)
sys.dont_write_bytecode = True
import ranks_model  # noqa: E402

DISKS = 150
TELLS = re.compile(r'^ *(sums|exchanges) +([0-9.]+) calls +([0-9.e+-]+) MB', re.MULTILINE)


class Model(unittest.TestCase):
    def counted(self, ranks):
        """{kind: (calls, MB)} for each orthonormalisation."""
        options = f'--disks {DISKS} --threads 1 --rounds 1 --duration 20 --settling 20'.split()
        said = subprocess.run(
            [*MPIRUN, str(ranks), PROGRAM, *options], check=True, stdout=subprocess.PIPE, text=True
        ).stdout
        return {kind: (float(calls), float(mb)) for kind, calls, mb in TELLS.findall(said)}

    def test_counts(self):
        vectors = ranks_model.vectors_of(DISKS)
        for ranks in (2, 3):
            with self.subTest(ranks=ranks):
                found = self.counted(ranks)
                calls, numbers = ranks_model.sums(vectors)
                given = ranks_model.exchanged(DISKS, vectors, ranks)
                # now and then an orthonormalisation is made twice, or taken back
                self.assertAlmostEqual(found['exchanges'][0] / 2, 1, delta=0.05)
                self.assertAlmostEqual(
                    1e6 * found['exchanges'][1] / given, found['exchanges'][0] / 2, delta=2e-3
                )
                self.assertAlmostEqual(1e6 * found['sums'][1] / 8 / numbers, 1, delta=0.1)
                # beside them the agreements, of one number each
                self.assertGreaterEqual(found['sums'][0], calls)
                self.assertLess(found['sums'][0], calls + 30)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
