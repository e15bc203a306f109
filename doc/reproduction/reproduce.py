#!/usr/bin/python3
"""The figures and tables of the paper (Eckmann, Forster, Posch, Zabey 2005), measured again: from a
folder of bags, NAME.bag for each run of runs.yaml, to FOLDER/results: a page of published beside
measured numbers, rows.csv with the same, figures, and the numbers that they show.

Exit status: 0 nothing has failed; 1 a part has failed; 2 a wrong option."""

import argparse
import os
import sys

import matplotlib

from study import bags, page, table


def main():
    matplotlib.use('Agg')
    parts, front = table.read()
    args = parser(len(parts)).parse_args()
    chosen = [part for part in parts if part.number in (args.part or range(1, len(parts) + 1))]
    which = '' if len(chosen) == len(parts) else ''.join(f'_{part.number:02d}' for part in chosen)
    found = bags.found(args.folder, table.runs_of(chosen))
    results = os.path.join(args.folder, 'results')
    text, failed = page.write(chosen, front, found, results, which)
    print(f'{text}\nresults are in {results}', flush=True)
    for line in failed:
        print(f'reproduce: {line}', file=sys.stderr)
    return 1 if failed else 0


def parser(count):
    made = argparse.ArgumentParser(prog='reproduce.py', description=__doc__.split('\n\n')[0])
    made.add_argument('--folder', required=True, type=_folder, help='of the bags')
    every, help_text = range(1, count + 1), 'only this part; may be given several times'
    made.add_argument(
        '--part', type=int, action='append', choices=every, metavar='N', help=help_text
    )
    return made


def _folder(text):
    if not os.path.isdir(text):
        raise argparse.ArgumentTypeError(f"is '{text}', which is no folder")
    return text


if __name__ == '__main__':
    sys.exit(main())
