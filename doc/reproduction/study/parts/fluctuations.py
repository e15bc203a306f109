"""Part 19: how local exponents fluctuate, against index, number of disks and averaging time, at
density 0.4. The paper says nothing of it: shown, not judged."""

from matplotlib import ticker
import numpy as np

from hdlyap.plots.figures.style import BLUE, GREEN, GREY, VERMILION
from hdlyap.numbers import with_error

from .. import draw, growth, relations
from ..bags import once
from ..row import Row
from . import aspect, smallest

JOINED = (1, 2, 4)  # samples to one
COLOURS = {
    growth.LARGEST: VERMILION,
    growth.MIDDLE: GREY,
    growth.LAST_T: BLUE,
    growth.LAST_LP: GREEN,
}
SHOWN = 3  # boxes in the figure of all indices


def runs():
    wide = [name for name in aspect.runs() if name.endswith('periodic')]
    return [*wide, *(smallest.run_of('periodic', box) for box in smallest.BOXES)]


@once
def _growth(bag):
    return growth.read(bag) if bag.recording.spectrum else None


class Box:
    """One run; None of growth: its samples are too few, or of unknown length."""

    def __init__(self, name, bag):
        recording = bag.recording
        self.name, self.disks, self.aspect = name, recording.info.disks, recording.info.aspect
        self.growth = _growth(bag)
        self.indices = growth.indices(recording) if self.growth else {}
        self.half = recording.positive_end if self.growth else 0

    def spread(self, group, joined=1):
        """(variance times t, its error, mean length of a sample, samples); (None, 0, ..) if not
        known."""
        if not self.indices.get(group):
            return None, 0.0, 0.0, 0
        longer = self.growth.joined(joined)
        return (*longer.of(self.indices[group]), longer.length, longer.samples)


def _boxes(bags):
    return sorted((Box(name, bags[name]) for name in runs()), key=lambda box: box.disks)


def power_of_disks(boxes, group):
    """(p, its error, number of boxes) of variance times t ~ N^-p: relative errors, larger where the
    boxes scatter more. Of steps those of part 10 alone, which have one wave number."""
    if group in (growth.LAST_T, growth.LAST_LP):
        boxes = [box for box in boxes if box.name in aspect.runs()]
    found = [(box.disks, *box.spread(group)[:2]) for box in boxes]
    known = np.array([one for one in found if one[1] and one[2] > 0]).reshape(-1, 3)
    if len(set(known[:, 0])) < 3:
        return None, 0.0, len(known)
    x, y, errors = np.log(known[:, 0]), np.log(known[:, 1]), known[:, 2] / known[:, 1]
    line = relations.Polynomial(np.column_stack([x, 0 * x, y, errors]), 1)
    return float(-line.coefficients[0]), float(line.covariance[0, 0] ** 0.5), len(known)


# ---- rows ----------------------------------------------------------------------------------------


def powers(bags):
    boxes = _boxes(bags)
    return [_power_row(boxes, group) for group in growth.GROUPS]


def times(bags):
    boxes = _boxes(bags)
    return [_time_row(boxes, group) for group in growth.GROUPS]


def _power_row(boxes, group):
    value, error, count = power_of_disks(boxes, group)
    ends = [
        f'{with_error(*box.spread(group)[:2])} with {box.disks} disks'
        for box in (boxes[0], boxes[-1])
        if box.spread(group)[0]
    ]
    return Row(f'p of {group}', None, value, error, remark=', '.join([f'{count} boxes', *ends]))


def _time_row(boxes, group):
    """Over all boxes: samples are independent if it is 1."""
    ratios, memories = [], []
    for box in boxes:
        single, longer = box.spread(group), box.spread(group, JOINED[1])
        if single[0] and longer[0]:
            ratios.append(longer[0] / single[0])
            memories.append(box.growth.memory(box.indices[group])[0])
    quantity = f'{JOINED[1]} samples joined, {group}'
    if len(ratios) < 2:
        return Row(quantity)
    error = np.std(ratios, ddof=1) / np.sqrt(len(ratios))
    remark = f'{len(ratios)} boxes; correlation of neighbouring samples {np.mean(memories):.2f}'
    return Row(quantity, None, float(np.mean(ratios)), float(error), remark=remark)


# ---- figure and table ----------------------------------------------------------------------------


def figures(bags):
    boxes = [box for box in _boxes(bags) if box.growth]
    if boxes:
        yield 'fluctuations', _figure(boxes)


def _figure(boxes):
    figure, (left, middle, right) = draw.panels(1, 3, (9.6, 3.4))
    _of_indices(left, boxes)
    most = max(boxes, key=lambda one: one.growth.samples)
    for group, colour in COLOURS.items():
        of_disks = [(box.disks, *box.spread(group)[:2]) for box in boxes]
        of_time = [most.spread(group, joined) for joined in JOINED]
        of_time = [(length, value, error) for value, error, length, _ in of_time]
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
        value = box.disks * box.growth.spread()[0][: box.half + 1 - box.growth.first_index]
        at = (box.growth.first_index + np.arange(len(value))) / box.half
        axes.plot(at, value, linewidth=0.7, label=f'$N={box.disks}$')


def tables(bags):
    boxes = _boxes(bags)
    header = 'run', 'disks', 'aspect', 'exponents', 'joined', 'time', 'samples', 'var_t', 'error'
    yield 'fluctuations', header, [
        (box.name, box.disks, f'{box.aspect:g}', group, joined, *_numbers(box, group, joined))
        for box in boxes
        for group in growth.GROUPS
        for joined in JOINED
        if box.spread(group, joined)[0]
    ]
    box = boxes[-1]
    if box.growth:
        value, error = box.growth.spread()
        yield 'indices', ('index', 'exponent', 'var_t', 'error'), [
            (box.growth.first_index + i, f'{mean:.6g}', f'{value[i]:.4g}', f'{error[i]:.2g}')
            for i, mean in enumerate(np.average(box.growth.local, 0, box.growth.time))
        ]


def _numbers(box, group, joined):
    value, error, length, samples = box.spread(group, joined)
    return f'{length:.4g}', samples, f'{value:.4g}', f'{error:.2g}'
