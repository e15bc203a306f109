"""Wave number and direction of vectors from structure factors; no field is fitted."""

from collections import namedtuple

import numpy as np

from hdlyap.data import factors, steps
from hdlyap.plots.figures import structure as figure_of_structure
from hdlyap.plots.figures.structure import OF_KIND

from ..bags import once
from ..row import Row

# vectors, where they have their peaks, S there and the largest elsewhere
Seen = namedtuple('Seen', 'name own peaks factor elsewhere')


@once
def _read(bag):
    """Seen, of each step that has its vectors for itself."""
    run, found = bag.recording, []
    for block in steps.blocks(run.steps) if run.structure.means is not None else ():
        if len(block.steps) == 1 and run.structure.has((block.first, block.last)):
            one, direction = block.steps[0], OF_KIND[block.kind]
            name, own = f'{block.name}, {bag.info.boundary_x}', f'({one.nx},{one.ny}) {direction}'
            found.append(Seen(name, own, *_peaks(run.structure.means, block)))
    return found


def _peaks(means, block):
    """(of each vector its wave and direction, mean S there, largest mean S at another wave)"""
    both = np.stack([getattr(means, direction) for direction in factors.DIRECTIONS])
    both = both[:, :, block.first - 1 : block.last]
    vectors = range(both.shape[2])
    places = [np.unravel_index(np.argmax(both[..., one]), both.shape[:2]) for one in vectors]
    peaks = [
        f'({means.nx[wave]},{means.ny[wave]}) {factors.DIRECTIONS[direction]}'
        for direction, wave in places
    ]
    mean = both.mean(axis=2)
    at = np.unravel_index(np.argmax(mean), mean.shape)
    return peaks, float(mean[at]), float(np.delete(mean, at[1], axis=1).max())


def peaks(bags):
    found = [_peak(one) for bag in bags for one in _read(bag)]
    return found or [Row('peak of T and LP steps', 'the same')]


def _peak(one):
    measured = ', '.join(sorted(set(one.peaks)))
    remark = f'{len(one.peaks)} vectors; S {one.factor:.1f}, elsewhere at most {one.elsewhere:.1f}'
    return Row(f'peak of {one.name}', one.own, measured, remark=remark)


def picture(bags, number):
    page = figure_of_structure.draw(bags[number].recording)
    return page and page.figure
