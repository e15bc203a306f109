"""What a running node does, on a screen or in a line.

On a terminal it fills the screen until q is pressed; elsewhere it prints a line now and then until
the run has finished.

Exit status: 0 the run has finished, or q; 1 no node, or none that answers; 3 the node went away
before the end of its run; 130 interrupted."""

import sys

from hdlyap.follow import dashboard, line, nodes, screen


def options(parser):
    parser.add_argument('--node', metavar='NAME', help='node to follow (default: the only one)')
    text = 'longest wait for the master and the node (default: %(default)g)'
    parser.add_argument('--timeout', type=float, default=30.0, metavar='SECONDS', help=text)
    text = 'one line instead of a screen; ends when the run ends'
    parser.add_argument('--line', action='store_true', help=text)
    parser.add_argument('--plain', action='store_true', help='a screen of ASCII without colours')


def main(args):
    try:
        return follow(args)
    except KeyboardInterrupt:
        return 130


def follow(args):
    node = nodes.chosen('follow', args.node, args.timeout)
    in_a_line = args.line or not screen.is_usable()
    status = line.follow(node) if in_a_line else dashboard.follow(node, args.plain)
    if status == 3:
        print(f'hdlyap follow: {node} went away before the end of its run', file=sys.stderr)
    return status
