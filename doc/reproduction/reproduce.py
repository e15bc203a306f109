#!/usr/bin/python3
"""The figures and tables of the paper (Eckmann, Forster, Posch, Zabey 2005), measured again, from a
folder of bags: draws the figures and writes published beside measured numbers below
FOLDER/results.

Exit status: 0 nothing has failed; 1 a part has failed; 2 a wrong option."""

import argparse
import os
import sys

from study import bags, page, parts


def main():
    args = parser().parse_args()
    chosen = parts.chosen(args.part)
    found = bags.found(args.folder, parts.runs_of(chosen))
    text, failed = page.write(chosen, found, os.path.join(args.folder, 'results'))
    print(text, flush=True)
    for line in failed:
        print(f'reproduce: {line}', file=sys.stderr)
    return 1 if failed else 0


def parser():
    made = argparse.ArgumentParser(prog='reproduce.py', description=__doc__.split('\n\n')[0])
    made.add_argument('--folder', required=True, help='of the bags, NAME.bag for each run')
    made.add_argument(
        '--part',
        type=int,
        action='append',
        choices=range(1, len(parts.PARTS) + 1),
        metavar='N',
        help='only this part; may be given several times',
    )
    return made


if __name__ == '__main__':
    sys.exit(main())
