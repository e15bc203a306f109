"""How local exponents fluctuate, against index, number of disks and averaging time. Bags: boxes
with one wave number, and others."""

import numpy as np
from matplotlib import ticker

from hdlyap.numbers import with_error
from hdlyap.plots.figures.style import BLUE, GREEN, GREY, VERMILION

from .. import draw, growth
from ..averages import UNKNOWN
from ..bags import once
from ..polynomials import Polynomial
from ..row import Row

JOINED = (1, 2, 4)  # samples to one
COLOURS = dict(zip(growth.GROUPS, (VERMILION, GREY, BLUE, GREEN)))
SHOWN = 3  # boxes in the figure of all indices


class Box:
    """One run; None of growth: its samples are too few, or of unknown length."""

    def __init__(self, bag):
        recording = bag.recording
        self.disks, self.half = recording.info.number, recording.positive_end
        self.growth = growth.read(bag) if recording.spectrum else None
        self.indices = growth.indices(recording) if self.growth else {}

    def spread(self, group, joined=1):
        """(variance times t, its error); (None, 0) if not known."""
        indices = self.indices.get(group)
        return self.growth.joined(joined).of(indices) if indices else UNKNOWN


@once
def _box(bag):
    return Box(bag)


def _by_disks(bags):
    return sorted((_box(bag) for some in bags for bag in some), key=lambda box: box.disks)


def powers(bags):
    """Of variance times t ~ N^-p: relative errors, larger where the boxes scatter more. Of steps
    those boxes alone which have one wave number."""
    every = _by_disks(bags)
    for group in growth.GROUPS:
        boxes = _by_disks(bags[:1]) if group in growth.STEPS else every
        known = [(box.disks, *box.spread(group)) for box in boxes]
        known = np.array([one for one in known if one[1] and one[2] > 0]).reshape(-1, 3)
        value = _power(known) if len(set(known[:, 0])) >= 3 else UNKNOWN
        ends = [
            f'{with_error(*box.spread(group))} with {box.disks} disks'
            for box in (every[0], every[-1])
            if box.spread(group)[0]
        ]
        yield Row(f'p of {group}', None, *value, remark=', '.join([f'{len(known)} boxes', *ends]))


def _power(known):
    x, y, errors = np.log(known[:, 0]), np.log(known[:, 1]), known[:, 2] / known[:, 1]
    slope, error = Polynomial(np.column_stack([x, 0 * x, y, errors]), 1).leading
    return -slope, error


def times(bags):
    """Over all boxes: samples are independent if it is 1."""
    for group in growth.GROUPS:
        ratios, memories = [], []
        for box in _by_disks(bags):
            (single, _), (longer, _) = box.spread(group), box.spread(group, JOINED[1])
            if single and longer:
                ratios.append(longer / single)
                memories.append(box.growth.memory(box.indices[group])[0])
        value, remark = UNKNOWN, ''
        if len(ratios) > 1:
            value = np.mean(ratios), np.std(ratios, ddof=1) / np.sqrt(len(ratios))
            neighbours = f'correlation of neighbouring samples {np.mean(memories):.2f}'
            remark = f'{len(ratios)} boxes; {neighbours}'
        yield Row(f'{JOINED[1]} samples joined, {group}', None, *value, remark=remark)


def picture(bags):
    boxes = [box for box in _by_disks(bags) if box.growth]
    if not boxes:
        return None
    figure, (left, middle, right) = draw.panels(1, 3, (9.6, 3.4))
    _of_indices(left, boxes)
    most = max(boxes, key=lambda one: one.growth.samples)
    longer = [(most.growth.joined(joined).length, joined) for joined in JOINED]
    for group, colour in COLOURS.items():
        of_disks = [(box.disks, *box.spread(group)) for box in boxes]
        of_time = [(length, *most.spread(group, joined)) for length, joined in longer]
        for axes, found in ((middle, of_disks), (right, of_time)):
            known = [one for one in found if one[1]]
            draw.bars(axes, known, 'o', colour, group, markersize=3.5)
    right.set_title(f'$N={most.disks}$', fontsize=9)
    for axes in (left, middle, right):
        axes.set_yscale('log')
    for axes in (middle, right):
        axes.set_xscale('log')
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(ticker.FormatStrFormatter('%g'))
        axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    left.set_xlabel(r'index over number of positive exponents')
    left.set_ylabel(r'$N\,t\;\mathrm{var}\,\lambda$  [1/time unit]')
    middle.set(xlabel=r'disks $N$', ylabel=r'$t\;\mathrm{var}\,\lambda$  [1/time unit]')
    right.set_xlabel(r'averaging time $t$  [time units]')
    for axes in (left, middle, right):
        draw.legend(axes, loc='lower left')
    return figure


def _of_indices(axes, boxes):
    for place in np.unique(np.linspace(0, len(boxes) - 1, SHOWN).astype(int)):
        box = boxes[place]
        value = box.disks * box.growth.squares().mean(axis=0)
        value = value[: box.half + 1 - box.growth.first_index]
        at = (box.growth.first_index + np.arange(len(value))) / box.half
        axes.plot(at, value, linewidth=0.7, label=f'$N={box.disks}$')
