#!/usr/bin/python3
"""Predicts a run on more ranks than there are here: calls and bytes of each orthonormalisation,
counted as the program makes them, with latency and bandwidth of a network, and flops at a measured
rate -> seconds per time unit and efficiency, as a table, CSV and a picture.

ranks_model.py [--flops PER RANK] [--latency SECONDS] [--bandwidth BYTES/S] [--interval TIME UNITS]
               [--replay SECONDS] [--check DISKS RANKS] [--out FOLDER]"""

import argparse
import math
import os

SIZES = 780, 3000, 10_000, 30_000, 100_000
RANKS = [2**k for k in range(11)]
WORD = 8
# the constants of panel.h and ortho.c
PANELS, PANEL_MIN, PANEL_MAX, LEAF_MAX, LATER_MAX = 8, 8, 160, 48, 704


def vectors_of(disks):
    """Vectors of the positive half of the spectrum in a periodic box."""
    return 2 * disks - 3


def share(vectors, ranks):
    """Columns of a rank's part of the frame, with the padding of its rows (frame.c)."""
    own = -(-vectors // ranks)
    own += 3 if own >= 64 else 0
    width = 1
    while width < own and width < 8:
        width *= 2
    return -(-own // width) * width


def panel_width(vectors):
    even = (vectors // PANELS + 7) // 8 * 8
    return min(max(PANEL_MIN, min(PANEL_MAX, even)), vectors)


def sums_of_panel(width):
    """Calls of a sum, and how many numbers they add, for a panel alone."""
    if width <= LEAF_MAX:
        return 1, width * width
    half = (width // 2 + 7) // 8 * 8
    calls, numbers = 1, half * (width - half)
    for part in (half, width - half):
        more, their = sums_of_panel(part)
        calls, numbers = calls + more, numbers + their
    return calls, numbers


def sums(vectors):
    """Calls of a sum, and how many numbers they add, for an orthonormalisation on any ranks."""
    width, calls, numbers = panel_width(vectors), 0, 0
    for first in range(0, vectors, width):
        panel = min(width, vectors - first)
        own, their = sums_of_panel(panel)
        later = vectors - first - panel
        pieces = -(-later // LATER_MAX)
        most = (-(-later // pieces) + 7) // 8 * 8 if pieces > 1 else later
        calls += own + (-(-later // most) if later else 0)
        numbers += their + later * panel
    return calls, numbers


def exchanged(disks, vectors, ranks):
    """Bytes that a rank sends in the two exchanges of an orthonormalisation."""
    rows = 4 * -(-disks // ranks)
    return 2 * (ranks - 1) * rows * share(vectors, ranks) * WORD


class Machine:
    def __init__(self, flops, latency, bandwidth, replay):
        self.flops, self.latency, self.bandwidth, self.replay = flops, latency, bandwidth, replay

    def parts(self, disks, ranks):
        """Seconds of an orthonormalisation: flops, work that all ranks repeat, sums, exchanges."""
        n, m = vectors_of(disks), 4 * disks
        rows, width = 4 * -(-disks // ranks), panel_width(n)
        work = 1.75 * rows * n * n / self.flops  # between the norm of dq and the full norm
        alike = n * width * width / self.flops
        replay = self.replay * (m * share(n, ranks)) / (3120 * 1557)
        if ranks == 1:
            return work + replay, alike, 0.0, 0.0
        calls, numbers = sums(n)
        steps = math.ceil(math.log2(ranks))
        summed = 2 * WORD * numbers * (ranks - 1) / ranks / self.bandwidth
        given = exchanged(disks, n, ranks) / self.bandwidth
        return (
            work + replay,
            alike,
            summed + 2 * calls * steps * self.latency,
            given + 2 * (ranks - 1) * self.latency,
        )

    def seconds(self, disks, ranks):
        return sum(self.parts(disks, ranks))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split('\n\n')[0])
    parser.add_argument('--flops', type=float, default=45e9, help='of dgemm, of each rank')
    parser.add_argument('--latency', type=float, default=2e-6, help='of a message [s]')
    parser.add_argument('--bandwidth', type=float, default=10e9, help='of a rank [bytes/s]')
    parser.add_argument('--interval', type=float, default=2.2, help='[time units]')
    parser.add_argument(
        '--replay', type=float, default=0.032, help='of 780 disks for an interval, one rank [s]'
    )
    parser.add_argument('--check', type=int, nargs=2, metavar=('DISKS', 'RANKS'))
    parser.add_argument('--out', default='.', help='folder of ranks_model.csv and ranks_model.png')
    return parser.parse_args()


def rows(machine, interval):
    for disks in SIZES:
        one = machine.seconds(disks, 1)
        for ranks in RANKS:
            if 4 * disks < 8 * ranks:
                continue
            now = machine.seconds(disks, ranks)
            memory = 16 * 4 * -(-disks // ranks) * ranks * share(vectors_of(disks), ranks)
            yield disks, ranks, now / interval, one / now / ranks, memory / 1e9


def draw(table, folder):
    import matplotlib

    matplotlib.use('Agg')
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(8.5, 3.6))
    for disks in SIZES:
        mine = [row for row in table if row[0] == disks]
        label = f'N = {disks:,}'.replace(',', ' ')
        axes[0].plot([r[1] for r in mine], [r[2] for r in mine], 'o-', ms=3)
        axes[1].plot([r[1] for r in mine], [r[3] for r in mine], 'o-', ms=3, label=label)
    axes[0].set(xscale='log', yscale='log', xlabel='ranks', ylabel='seconds per time unit')
    axes[1].set(xscale='log', ylim=(0, 1.05), xlabel='ranks', ylabel='efficiency')
    for one in axes:
        one.set_xscale('log', base=2)
    axes[1].legend(loc='lower left')
    figure.tight_layout()
    figure.savefig(os.path.join(folder, 'ranks_model.png'), dpi=150)


def main():
    args = arguments()
    machine = Machine(args.flops, args.latency, args.bandwidth, args.replay)
    if args.check:
        disks, ranks = args.check
        calls, numbers = sums(vectors_of(disks))
        work, alike, summed, given = machine.parts(disks, ranks)
        print(
            f'{disks} disks, {ranks} ranks, an orthonormalisation: sums {calls} calls, '
            f'{WORD * numbers / 1e6:.4g} MB; exchanges 2 calls, '
            f'{exchanged(disks, vectors_of(disks), ranks) / 1e6:.4g} MB\n'
            f'seconds: flops and replay {work:.4g}, alike {alike:.4g}, sums {summed:.4g}, '
            f'exchanges {given:.4g}'
        )
        return
    table = list(rows(machine, args.interval))
    print('disks   ranks  seconds per time unit  efficiency  GB of the frame on each')
    for row in table:
        print('{:6d} {:6d} {:22.4g} {:11.2f} {:13.3g}'.format(*row))
    with open(os.path.join(args.out, 'ranks_model.csv'), 'w') as file:
        file.write(f'# flops {args.flops:g}, latency {args.latency:g} s, bandwidth ')
        file.write(f'{args.bandwidth:g} bytes/s, interval {args.interval:g}\n')
        file.write('disks,ranks,seconds per time unit,efficiency,frame on each [GB]\n')
        file.writelines(','.join(f'{x:g}' for x in row) + '\n' for row in table)
    draw(table, args.out)


if __name__ == '__main__':
    main()
