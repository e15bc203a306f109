"""What a running node does: a line of its progress and, whenever more is known, the table of its
steps.

On a terminal it waits for a node that has gone to come back, unless --line is given.
Exit status: 0 the run has finished; 1 no node, or none that answers; 3 the node went away before
the end of its run; 130 interrupted."""

import sys

from hdlyap.follow import line, nodes


def options(parser):
    parser.add_argument('--node', metavar='NAME', help='node to follow (default: the only one)')
    text = 'longest wait for the master and the node (default: %(default)g)'
    parser.add_argument('--timeout', type=float, default=30.0, metavar='SECONDS', help=text)
    text = 'only the line; ends when the node ends'
    either = parser.add_mutually_exclusive_group()
    either.add_argument('--line', action='store_true', help=text)
    text = 'have the node compute steps although nobody else listens to them'
    either.add_argument('--steps', action='store_true', help=text)


def main(args):
    try:
        return follow(args)
    except KeyboardInterrupt:
        return 130


def follow(args):
    node = nodes.chosen('follow', args.node, args.timeout)
    stays = sys.stdout.isatty() and not args.line
    status = line.follow(node, args.line, args.steps, stays)
    if status == 3:
        print(f'hdlyap follow: {node} went away before the end of its run', file=sys.stderr)
    return status
