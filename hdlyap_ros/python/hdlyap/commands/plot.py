"""Tables and figures from recorded bags: exponents, steps, modes, phases, cost.

Several bags are parts of one run (split, or resumed from a checkpoint), or runs of several seeds,
whose means are drawn.

With --live it shows spectrum, steps, dispersion, phases and convergence of a running node in a
window instead, until that is closed.

Exit status: 0; 1 if a bag cannot be used, a file cannot be written, or no node is there that
answers; 2 for a wrong option, or no display for the window; 3 if the node had gone before the end
of its run when the window was closed."""

import os
import sys

from hdlyap.data import export, fits, seeds
from hdlyap.plots import figures, report
from hdlyap.plots.figures.page import PAPER
from hdlyap.progress import Progress

FAULT = 1
FOLDER = '.'  # folder of the figures
PATIENCE = 30.0  # seconds for a master and a node to appear


def options(parser):
    parser.add_argument('bags', nargs='*', metavar='BAG', help='file recorded by rosbag')
    text = 'figures of this running node in a window (default: the only node)'
    parser.add_argument('--live', nargs='?', const='', metavar='NODE', help=text)
    text = 'folder of the figures (default: the current one)'
    parser.add_argument('--out', default=FOLDER, metavar='DIR', help=text)
    parser.add_argument('--node', metavar='NAME', help='which node, if several are in the bag')
    text = 'which run, if several are in the bag, from 1 (default: the last)'
    parser.add_argument('--run', type=int, metavar='NUMBER', help=text)
    fits.add_arguments(parser)
    names = list(figures.FIGURES)
    parser.add_argument(
        '--only', nargs='+', choices=names, metavar='FIGURE', help='out of ' + ', '.join(names)
    )
    parser.add_argument('--pdf', metavar='FILE', help='one file of all figures, a page for each')
    parser.add_argument(
        '--paper',
        choices=list(PAPER),
        help='figures for a journal: as wide as one of its columns or as both, without title and '
        'misfits, as PDF; titles are printed, as captions for LaTeX',
    )
    parser.add_argument('--csv', metavar='DIR', help='folder for all tables as CSV')
    parser.add_argument('--npz', metavar='FILE', help='file for all arrays, for numpy.load')


def exported(run, args):
    """Writes CSV and npz files. Returns their names."""
    files = export.csv(run, args.csv) if args.csv else []
    return files + ([export.npz(run, args.npz)] if args.npz else [])


def live(args, form, k):
    """Shows the window. Returns the exit status. tkinter is imported here, because bags do not need
    it."""
    if args.bags or any(
        (
            args.node,
            args.run,
            args.only,
            args.pdf,
            args.csv,
            args.npz,
            args.paper,
            args.out != FOLDER,
        )
    ):
        args.error('--live takes no bag and no options except --form and --k')
    try:
        import tkinter
        from hdlyap.plots.window import Window
    except ImportError as error:
        return refused(f'--live needs tkinter (python3-tk): {error}')
    try:
        window = Window('hdlyap plot')
    except tkinter.TclError as error:
        return refused(f'--live needs a screen: {error}')
    from hdlyap.follow import live as following, nodes

    return following.follow(nodes.chosen('plot', args.live, PATIENCE), window, form=form, k=k)


def refused(why):
    print(f'hdlyap plot: {why}', file=sys.stderr)
    return 2


def main(args):
    form, k = fits.choice(args)
    if args.live is not None:
        return live(args, form, k)
    if not args.bags:
        args.error('the following arguments are required: BAG')
    run = seeds.load(*args.bags, node=args.node, run=args.run, form=form, k=k).summary
    print(report.report(run), flush=True)
    if run.spectrum is None:
        print('\nno averaged spectrum in this bag')
    os.makedirs(args.out, exist_ok=True)
    names = figures.OF_MEANS if run.is_mean else figures.FIGURES
    names = [name for name in names if not args.only or name in args.only]
    made = figures.draw_all(run, args.out, Progress('drawing'), names, args.pdf, args.paper)
    files = made.files + (exported(run.data, args) if args.csv or args.npz else [])
    print('\n' + '\n'.join(files))
    for line in (*made.captions, *made.left_out):
        print(line)
    if made.lost:
        print('not drawn, as they need run_info: ' + ', '.join(made.lost))
    drawn = {os.path.basename(file).partition('.')[0] for file in made.files}
    nothing = [name for name in args.only or () if name not in drawn and name not in made.lost]
    if nothing:
        print('nothing to draw in this bag: ' + ', '.join(nothing))
    return 0
