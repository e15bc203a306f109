"""One run on a cluster, recorded: what srun or mpirun starts, on each rank.

srun -n 64 hdlyap run large.yaml --out large.bag duration:=200
mpirun -n 4 hdlyap run dense --out dense.bag
mpirun -n 2 hdlyap run ring.yaml --out ring.bag --package my_package --program chain_node

Rank 0 starts a separate ROS master, the recorder and the node, as run.launch does, whose arguments
may follow, none with another value than it has here; the other ranks belong to the node. The bag
has all topics. No other master is needed, and nobody else sees this one.

Exit status: 0 the run went to its end; 1 it did not, as the node refused it, too; 2 an argument is
refused before the start."""

import contextlib
import os
import sys

from hdlyap import signals
from hdlyap.runs import arguments, program, ranks, run, work
from hdlyap.runs.scene import Refused

PROGRAM = 'package', 'program'  # options that are arguments of run.launch


def options(parser):
    parser.usage = '%(prog)s SCENE --out FILE [--package NAME --program NAME] [ARGUMENT:=VALUE]..'
    parser.add_argument('scene', help='name of a scene in launch/scenes, or a YAML file like these')
    parser.add_argument('--out', required=True, metavar='FILE', help='bag to record to')
    program.add_arguments(parser)


def stamp(path):
    """A value that differs for another file of this name; None if there is no file."""
    with contextlib.suppress(OSError):
        found = os.stat(path)
        return found.st_ino, found.st_mtime_ns


def understood(words):
    """Checks the arguments of run.launch. Returns the path of the node's program."""
    given = arguments.check(words, arguments.launch_folder(), os.getcwd())
    if ranks.count() > 1 and given.get('ranks', '1') != '1':
        raise Refused(f'ranks = {given["ranks"]}: must be 1, as there are {ranks.count()} already')
    return program.Program.of(given).path()


def main(args):
    words = [f'scene:={args.scene}', 'record:=true', f'bag:={args.out}', *args.assigned]
    words += [f'{name}:={getattr(args, name)}' for name in PROGRAM if getattr(args, name)]
    try:
        path = understood(words)
    except Refused as refused:
        if ranks.number() == 0:
            print(f'hdlyap run: {refused}', file=sys.stderr)
        return 2
    if ranks.number() > 0:
        ranks.become(path)
    bag = os.path.abspath(args.out if args.out.endswith('.bag') else args.out + '.bag')
    before = stamp(bag)  # a run that is refused leaves the old bag
    with signals.held() as came:
        work.launched([*words, f'bag:={bag}'], came)
    return 0 if stamp(bag) != before and run.complete(bag) else 1
