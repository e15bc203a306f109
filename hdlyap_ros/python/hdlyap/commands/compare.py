"""Whether two recorded runs agree within their errors.

hdlyap compare a.bag b.bag
hdlyap compare seed1.bag seed2.bag --with other1.bag other2.bag

Several bags on a side are parts of one run (split, or resumed from a checkpoint), or runs of
several seeds, whose means are compared.

Exit status: 0 they agree or are identical, 1 they differ, 2 they cannot be compared."""

from hdlyap.data import seeds
from hdlyap.plots import comparison, verdict

FAULT = 2


def options(parser):
    parser.add_argument('a', metavar='BAG', nargs='+', help='bag of the first side')
    parser.add_argument(
        '--with',
        dest='b',
        metavar='BAG',
        nargs='+',
        help='bags of the second side, if a side has several',
    )
    parser.add_argument('--node', metavar='NAME', help='which node, if several are in a bag')


def main(args):
    sides = (args.a, args.b) if args.b else (args.a[:1], args.a[1:])
    if not args.b and len(args.a) != 2:
        args.error(
            f'{len(args.a)} bags: must be two, or bags of both sides with --with between the sides'
        )
    runs = [seeds.load(*paths, node=args.node).summary for paths in sides]
    compared = comparison.Comparison(*runs)
    text, status = verdict.verdict(compared)
    print(verdict.report(compared), text, sep='\n\n', flush=True)
    return status
