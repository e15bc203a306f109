"""What the parts of the reproduction read, without a bag: a run that is known exactly, and the
tables of the last full run."""

import csv
import itertools
import os
from math import sqrt

import numpy as np

import made
from reproduced import claims
from hdlyap.plots.phases import PhaseCourse
from hdlyap.plots.run import Run

COUNTS = {made.T: 2, made.LP: 4}
# of part 9: disks, aspect ratio
BOXES = {
    '400_05': (400, 0.5),
    '400_1': (400, 1.0),
    '600_075': (600, 0.75),
    '780_05': (780, 0.5),
    '780_0867': (780, 0.867),
    '780_1': (780, 1.0),
}

RESULTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../doc/reproduction')


class Recorded(Run):
    """In place of plots.recorded.Recorded."""

    def __init__(self, info, steps=None, spectrum=None, phases=None):
        self.info, self.steps, self.spectrum = info, steps, spectrum
        self.phases = PhaseCourse()
        if phases is not None:
            self.phases.add(phases)


class Bag:
    """In place of hdlyap.runs.bag.Bag."""

    def __init__(self, recording, spectra=()):
        self.recording, self._spectra = recording, spectra

    def messages(self, kind):
        return iter(self._spectra if kind == 'hdlyap/Spectrum' else ())


def info(disks, density, aspect, boundaries=('periodic', 'periodic'), **fields):
    box_x = sqrt(disks / (density * aspect))
    zeros = 2 + 2 * boundaries.count('periodic')
    return made.run_info(
        disks=disks,
        density=density,
        aspect=aspect,
        box_x=box_x,
        box_y=aspect * box_x,
        boundary_x=boundaries[0],
        boundary_y=boundaries[1],
        zero_exponents=zeros,
        **fields,
    )


def stairs(info, levels, size=40, error=1e-3):
    """Spectrum of positive exponents whose last ones are stairs: (exponent, count), smallest
    first."""
    small = list(itertools.chain(*([exponent] * count for exponent, count in levels)))[::-1]
    end = (4 * info.disks - info.zero_exponents) // 2
    large = np.linspace(small[0] + 0.1 * size, small[0] + 0.1, size - len(small))
    made_spectrum = made.spectrum([*large, *small], 100.0, error=error)
    made_spectrum.first_index = end - size + 1
    return made_spectrum


def pictures(test, part, bags):
    """Draws all figures of a part; their names."""
    names = []
    for name, figure in part.figures(bags):
        figure.canvas.draw()
        pixels = np.asarray(figure.canvas.buffer_rgba())[..., :3]
        test.assertGreater((pixels < 128).any(axis=2).sum(), 500, name)
        names.append(name)
    return names


def rows(part, bags):
    return [row for claim in claims(part, bags).values() for row in claim.rows]


def by_quantity(part, bags):
    return {row.quantity: row for row in rows(part, bags)}


def verdicts(part, bags):
    """{name of claim: its verdict} of those that are judged."""
    return {name: one.verdict for name, one in claims(part, bags).items() if one.judged}


def table(name):
    """Of doc/reproduction: {column: text} of each line."""
    with open(os.path.join(RESULTS, name + '.csv')) as file:
        return list(csv.DictReader(file))
