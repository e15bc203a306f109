#!/usr/bin/python3
"""Tables of the studies -> the pictures of doc/findings.md, and the fits that it quotes.

Usage: findings.py TABLE.csv.. of halves, sound, dilute, circle, spheres, dumbbells, soft,
time_steps, mixtures, shear: prints the fits, draws TABLE.png beside it.
"""

import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

import circle  # noqa: E402
import dilute  # noqa: E402
import dumbbells  # noqa: E402
import halves  # noqa: E402
import mixtures  # noqa: E402
import shear  # noqa: E402
import soft  # noqa: E402
import sound  # noqa: E402
import spheres  # noqa: E402
import time_steps  # noqa: E402
from study import PLAIN, rows_of  # noqa: E402

STUDIES = {  # a column that only this one has: fits, picture
    'angle': (halves.lines, halves.draw),
    'sound': (sound.lines, sound.draw),
    'lambda_1 over it': (dilute.lines, dilute.draw),
    'u_theta': (circle.lines, circle.draw),
    'trembling': (dumbbells.lines, dumbbells.draw),
    'climb': (soft.lines, soft.draw),
    'third zero': (time_steps.lines, time_steps.draw),
    'part': (mixtures.lines, mixtures.draw),
    'quantity': (shear.lines, shear.draw),
    'boundaries': (spheres.lines, spheres.draw),
}


def main(arguments):
    if not arguments or not all(path.endswith('.csv') for path in arguments):
        print(
            'findings.py: needs tables of halves, sound, dilute, circle, spheres, dumbbells, soft, '
            'time_steps, mixtures, shear, each a .csv',
            file=sys.stderr,
        )
        return 2
    for path in arguments:
        rows = rows_of(path)
        fits, draw = next(study for column, study in STUDIES.items() if column in rows[0])
        for line in fits(rows):
            print(line)
        with plt.rc_context(PLAIN):
            picture = path[:-4] + '.png'
            draw(rows).savefig(picture, dpi=200, bbox_inches='tight')
            print(picture)
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
