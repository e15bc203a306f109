"""The table of a sweep, of any bags.

It has lambda_max, h_KS/N, c_T, c_L and v of each system, as means over its seeds; of walls that
shear the sum of all exponents, the Kaplan-Yorke dimension and the flow. For runs of
runs.launch it waits until all have ended."""

import os
import sys
import time

from roslaunch import netapi
import rospy

from hdlyap.data import fits
from hdlyap.follow import nodes
from hdlyap.plots import latex
from hdlyap.plots.figures.page import PAPER
from hdlyap.sweep import result

FAULT = 1
POLL = 0.5  # seconds between two looks at the processes
COMING = 60.0  # seconds for a node on another machine to come up
SURE = 3  # if a node has not answered this many questions in a row, it has gone


def options(parser):
    text = 'a bag; or the namespace of a running hdlyap, whose bag is DIR/GROUP.bag'
    parser.add_argument('runs', nargs='+', metavar='BAG|GROUP', help=text)
    parser.add_argument(
        '--folder',
        metavar='DIR',
        default='.',
        help='folder of GROUP.bag (default: the current one)',
    )
    parser.add_argument(
        '--out', metavar='DIR', help='writes the table, also as CSV, and a figure there'
    )
    text = (
        'prints it for LaTeX: numbers as math, or for the package siunitx; of one system with all '
    )
    text += 'results and steps'
    parser.add_argument('--latex', nargs='?', const='plain', choices=latex.STYLES, help=text)
    text = 'the figure for a journal, as wide as one of its columns or as both, as PDF'
    parser.add_argument('--paper', choices=list(PAPER), help=text)
    fits.add_arguments(parser)


class Nodes:
    """Knows which nodes have ended. roslaunch tells so of nodes on its machine; nodes on others
    have ended if they do not answer."""

    def __init__(self):
        self._deadline = time.monotonic() + COMING
        self._alive, self._dead, self._unanswered = set(), set(), {}

    def look(self):
        """Asks roslaunch; has to be called before each round of questions."""
        found = {True: set(), False: set()}
        for process in netapi.list_processes():
            found[process.is_alive].add('/' + process.name.rpartition('-')[0])
        self._alive, self._dead = found[True], found[False] - found[True]

    def has_ended(self, node):
        if node in self._alive:  # also if its address is wrong, so that nobody reaches it
            return False
        return node in self._dead or self._is_silent(node)

    def _is_silent(self, node):
        """Whether a node was there and is no more, or has not come in time."""
        if nodes.is_alive(node):
            self._unanswered[node] = 0
            return False
        if node not in self._unanswered:
            return self._has_not_come(node)
        self._unanswered[node] += 1
        return self._unanswered[node] >= SURE

    def _has_not_come(self, node):
        """Whether it is too late for a node; says so once if the master knows it."""
        if time.monotonic() <= self._deadline:
            return False
        self._unanswered[node] = SURE
        wrong = nodes.unheard(node)
        if wrong:
            print(f'hdlyap table: {wrong}', file=sys.stderr, flush=True)
        return True


def has_ended(group, nodes_now):
    """Whether the node of a group has ended and, as this asks it to after that, its recorder."""
    node, recorder = (rospy.resolve_name(f'{group}/{name}') for name in ('hdlyap', 'record'))
    if not nodes_now.has_ended(node):
        return False
    if not nodes_now.has_ended(recorder):
        nodes.stop(recorder, 'the run has ended')
        return False
    return True


def wait_for(groups):
    if groups:
        rospy.init_node('table')
    nodes_now = Nodes()
    while groups and not rospy.is_shutdown():
        time.sleep(POLL)
        nodes_now.look()
        groups = [group for group in groups if not has_ended(group, nodes_now)]


def main(args):
    groups = [name for name in args.runs if '.' not in name]  # no name of ROS has a dot
    try:
        wait_for(groups)
    except rospy.ROSInitException:  # interrupted while there was no master
        return 130
    bags = [
        os.path.join(args.folder, name + '.bag') if name in groups else name for name in args.runs
    ]
    if args.out:
        os.makedirs(args.out, exist_ok=True)
    wrong = result.write(bags, args.out, fits.choice(args), args.latex, args.paper)
    for line in wrong:
        print(f'hdlyap table: {line}', file=sys.stderr, flush=True)
    return 1 if wrong else 0
