"""A film of modes and moving particles, from a recorded bag.

Needs neither a master nor rviz.

Exit status: 0; 1 if the bag cannot be used or the film cannot be written; 2 for a wrong option."""

import argparse
import os
import re

from hdlyap.data import seeds, space
from hdlyap.numbers import positive
from hdlyap.plots import frames, movie

FAULT = 1
FPS = 10.0
NAME = re.compile(r'(T|LP)\(\d+,\d+(,\d+)?\)')


def film_file(path):
    if os.path.splitext(path)[1] not in movie.CODECS:
        raise argparse.ArgumentTypeError('%s: must end with .mp4 or .gif' % path)
    return path


def width(text):
    number = int(text)
    if not 64 <= number <= 4096:
        raise argparse.ArgumentTypeError('%s: must be 64 .. 4096' % text)
    return number


def modes(text):
    """Reads names of modes with spaces between; None stands for the lowest modes."""
    names = text.split()
    if text != 'lowest' and not all(map(NAME.fullmatch, names)):
        raise argparse.ArgumentTypeError(
            '%s: must be lowest or names such as "T(1,0) LP(1,1)", with spaces between' % text
        )
    return None if text == 'lowest' else names


def options(parser):
    parser.add_argument('bags', nargs='+', metavar='bag', help='bag, or several bags of one run')
    parser.add_argument(
        '--out', type=film_file, default='modes.mp4', metavar='FILE', help='.mp4 or .gif'
    )
    parser.add_argument(
        '--modes',
        type=modes,
        metavar='NAMES',
        help='steps to draw, as "T(1,0) LP(1,1)"; default: lowest',
    )
    text = 'simulated time units per second (default: a report in each frame)'
    parser.add_argument('--pace', type=positive, metavar='TIME', help=text)
    parser.add_argument(
        '--fps', type=positive, default=FPS, metavar='NUMBER', help='frames per second'
    )
    parser.add_argument(
        '--begin', type=float, metavar='TIME', help='simulated time of the first frame'
    )
    parser.add_argument(
        '--end', type=float, metavar='TIME', help='simulated time of the last frame'
    )
    text = 'default: ' + ', '.join('%d of %s' % (movie.WIDTH[kind], kind) for kind in movie.WIDTH)
    parser.add_argument('--width', type=width, metavar='PIXELS', help=text)
    parser.add_argument('--node', metavar='NAME', help='which node, if several are in the bag')
    parser.add_argument(
        '--run', type=int, metavar='NUMBER', help='which run, from 1 (default: the last)'
    )


def main(args):
    run = seeds.one(*args.bags, node=args.node, run=args.run)
    film = frames.Film(run, args.modes, (args.begin, args.end))
    pace = args.pace or args.fps * (film.report or 1.0)
    if film.field_interval > 2 * film.report > 0:
        print(
            'hdlyap movie: vectors are %g time units apart, %ss %g: record with '
            'field_interval: 0 for vectors that move as smoothly'
            % (film.field_interval, space.particle(film.info), film.report)
        )
    count = movie.write(film, args.out, pace, args.fps, args.width)
    print(
        '%s: %s from t = %g to %g in %.1f s, %d frames'
        % (args.out, ' and '.join(film.names), film.begin, film.end, count / args.fps, count)
    )
    return 0
