"""The options of `reproduce`. Needs no ROS: launch/reproduce.sh has this file look at them before
it builds."""

import argparse
import os
import sys

PARTS = len(
    [
        name
        for name in os.listdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'parts'))
        if name.endswith('.py') and not name.startswith('_')
    ]
)
ABOUT = """The figures and tables of the paper (Eckmann, Forster, Posch, Zabey 2005), measured
again: does the runs that are missing, then draws the figures and writes published beside measured
numbers. What has been done is not done again."""


class Parser(argparse.ArgumentParser):
    """One line for what is wrong."""

    def error(self, message):
        self.exit(2, f'{self.prog}: {message}; --help lists the options\n')


def parser():
    made = Parser(prog='reproduce', description=ABOUT, allow_abbrev=False)
    made.add_argument(
        '--quick',
        action='store_true',
        help='shorter runs, larger errors: about a quarter of an hour, not forty minutes',
    )
    made.add_argument(
        '--part',
        type=_part,
        action='append',
        metavar='N',
        help=f'only this part, 1 .. {PARTS}; may be given several times',
    )
    made.add_argument(
        '--out',
        type=_folder,
        metavar='DIR',
        help='folder of bags and results (default: reproduction, or reproduction_quick)',
    )
    made.add_argument(
        '--jobs',
        type=_jobs,
        default=len(os.sched_getaffinity(0)),
        metavar='J',
        help='runs of one core each at a time (default: all cores, %(default)s)',
    )
    made.add_argument(
        '--plan', type=_file, metavar='FILE', help='other runs than those of launch/reproduce.yaml'
    )
    what = made.add_mutually_exclusive_group()
    what.add_argument(
        '--list', action='store_true', help='only say what the parts are and which runs they need'
    )
    what.add_argument(
        '--write',
        action='store_true',
        help='only write the scene files, for reproduce.launch, and print which runs are missing',
    )
    what.add_argument('--draw', action='store_true', help='only draw from the bags that are there')
    return made


def parse(arguments):
    args = parser().parse_args(arguments)
    args.out = args.out or os.path.abspath('reproduction_quick' if args.quick else 'reproduction')
    return args


def _number(text, largest=None):
    wanted = f'1 .. {largest}' if largest else '1 or more'
    if not text.isdecimal() or not 1 <= int(text) <= (largest or int(text)):
        raise argparse.ArgumentTypeError(f"is '{text}', must be {wanted}")
    return int(text)


def _part(text):
    return _number(text, PARTS)


def _jobs(text):
    return _number(text)


def _folder(text):
    """Its absolute path: there, or to be made."""
    if not text.strip():
        raise argparse.ArgumentTypeError('is empty, must be a folder')
    above = path = os.path.abspath(text)
    while not os.path.lexists(above):
        above = os.path.dirname(above)
    if not os.path.isdir(above):
        raise argparse.ArgumentTypeError(f"is '{text}', but {above} is no folder")
    if not os.access(above, os.W_OK | os.X_OK):
        raise argparse.ArgumentTypeError(f"is '{text}', but nothing can be written in {above}")
    return path


def _file(text):
    if not os.path.isfile(text):
        raise argparse.ArgumentTypeError(f"is '{text}', which is no file")
    return os.path.abspath(text)


if __name__ == '__main__':
    parse(sys.argv[1:])
