"""How many exponents each step has, by the boundaries; how many vanish, and how small those are."""

import numpy as np

from hdlyap.data import steps
from hdlyap.data.reader import SPECTRUM
from hdlyap.plots.figures.style import GREY, INK, bars, kind_colour

from .. import draw, zeros
from ..row import Row
from ..stairs import stairs

BOXES = (
    *('periodic', 'reflecting', 'mixed', 'periodic square', 'narrow periodic'),
    'narrow, walls along x',
)
ZEROS = {
    2: 'both directions periodic',
    1: 'one direction periodic',
    0: 'both directions reflecting',
}
NARROW = 2.0  # diameters: disks cannot pass each other
SHOWN = 36  # exponents in a panel of the figure


# ---- the paper's rule ----------------------------------------------------------------------------


def prescribed(info, kind, nx, ny):
    """Multiplicity of a step: the number of modulations A that the boundaries allow; twice that for
    LP pairs."""
    count = 2 if kind == steps.LP else 1
    boxes = (nx, info.box_x, info.boundary_x), (ny, info.box_y, info.boundary_y)
    for nodes, box, boundary in boxes:
        count *= 0 if nodes and box < NARROW else _functions(nodes, boundary, kind)
    return count


def _functions(nodes, boundary, kind):
    """Cosine and sine along a periodic direction; along a reflecting one the cosine for L and P,
    the sine for T."""
    if boundary == 'periodic':
        return 2 if nodes else 1
    return 1 if kind == steps.LP or nodes else 0


# ---- steps ---------------------------------------------------------------------------------------


class Level:
    """Resolved steps that have stairs of exponents in common: mostly one step on one stair."""

    def __init__(self, pieces, blocks):
        self.pieces, self.blocks = pieces, blocks
        self.name = ' + '.join(block.name.replace('+', ' + ') for block in blocks)
        self.steps = [step for block in blocks for step in block.steps]
        self.trace = sum(block.multiplicity for block in blocks)
        # whether no vectors that no step was found for go on without a jump
        self.stands_apart = all(stair.count == self._of(stair) for stair in pieces)

    def prescribed(self, info):
        return sum(prescribed(info, step.kind, step.nx, step.ny) for step in self.steps)

    @property
    def measured(self):
        """How many exponents there are: the number; as text those of the pieces, smallest exponents
        first, if it breaks; None where vectors that no step was found for go on without a jump, or
        where it may be whole, as errors are not known."""
        counts = [stair.count for stair in self.pieces]
        if not counts or not self.stands_apart:
            return None
        if len(counts) == 1:
            return counts[0]
        is_known = all(stair.is_known for stair in self.pieces)
        return ' + '.join(map(str, counts)) if is_known else None

    @property
    def remark(self):
        """The node takes as many vectors as the rule has: what is counted are the exponents alone
        where they stand apart from all others. Between unknown neighbours nothing can be."""
        trace = f'trace {self.trace:.2f}'
        if not self.pieces:
            return f'{trace}; exponents not known'
        indices = f'{self.pieces[-1].first}-{self.pieces[0].last}'
        if not self.stands_apart:
            return f'{trace}; goes on without a jump in the other exponents of {indices}'
        if len(self.pieces) == 1:
            return trace
        more = '' if self.measured else ', with errors that are not known'
        return f'{trace}; the exponents {indices} are no stair{more}'

    def _of(self, stair):
        """How many of a stair's vectors belong to the steps."""
        return sum(
            max(0, min(stair.last, block.last) - max(stair.first, block.first) + 1)
            for block in self.blocks
        )


def levels(recording):
    """Of all resolved steps, smallest exponent first."""
    flights = stairs(recording) if recording.spectrum is not None else []
    found = []
    for block in steps.blocks(recording.steps):
        pieces = [one for one in flights if one.first <= block.last and block.first <= one.last]
        joined = [level for level in found if set(level.pieces) & set(pieces)]
        blocks = [one for level in joined for one in level.blocks] + [block]
        every = {stair for level in joined for stair in level.pieces} | set(pieces)
        place = found.index(joined[0]) if joined else len(found)
        found = [level for level in found if level not in joined]
        found.insert(place, Level([one for one in flights if one in every], blocks))
    return found


def counted(bags):
    boxes, _ = bags
    for box, bag in zip(BOXES, boxes):
        found = levels(bag.recording)
        for one in found:
            count = one.prescribed(bag.info), one.measured
            yield Row(f'{box}: {one.name}', *count, remark=one.remark)
        if not found:
            yield Row(f'{box}: multiplicities', 'by the rule')


def none(bag):
    """T(1,0) and T(0,1) would have the smallest exponents of all: there are none below LP(1,0)."""
    row = Row(f'{bag.info.boundary_x}: exponents smaller than those of LP(1,0)', 0)
    first = next((one for one in levels(bag.recording) if one.name == 'LP(1,0)'), None)
    if first is not None and first.pieces:
        row.measured = bag.recording.positive_end - first.pieces[0].last
    yield row


def steps_found(bags):
    boxes, _ = bags
    for box, bag in zip(BOXES, boxes):
        found = levels(bag.recording)
        missed = steps.unresolved(bag.recording.steps) if found else []
        count = sum(len(level.steps) for level in found) if found else None
        remark = f'not resolved: {" ".join(map(steps.name, missed))}' if missed else ''
        yield Row(f'{box}: steps found', None, count, remark=remark)


# ---- zero modes ----------------------------------------------------------------------------------


def _zeros(bags):
    """(bag, how many should vanish, the boundaries, their Lyapunov indices) of each."""
    for bag in bags[1]:
        run = bag.recording
        periodic = (bag.info.boundary_x, bag.info.boundary_y).count('periodic')
        found = zeros.indices(bag.info, run.spectrum) if run.spectrum is not None else None
        yield bag, 2 + 2 * periodic, ZEROS[periodic], found


def vanishing(bags):
    """How many do."""
    for bag, count, boundaries, found in _zeros(bags):
        row, spectrum = Row(f'zero exponents, {boundaries}', count), bag.recording.spectrum
        if found is not None:
            vanish = np.isin(spectrum.first_index + np.arange(len(spectrum.exponents)), found)
            others, row.measured = np.abs(spectrum.exponents)[~vanish], len(found)
            largest = zeros.threshold(bag.info, spectrum)
            row.remark = f'indices {zeros.span(found)}, smaller than {largest:.2g}'
            row.remark += f'; the next is {others.min():.2g}' if len(others) else ''
        yield row


def zero_modes(bags):
    """The trace is of vectors that the scene's number chooses, so not beside the paper's."""
    for bag, _, boundaries, found in _zeros(bags):
        run = bag.recording
        zero = run.steps and steps.zero_modes(run.steps)
        trace, remark = None, ''
        if zero is not None and zero.resolved:
            trace, remark = zero.multiplicity, f'vectors {zero.first_index}-{zero.last_index}'
        quantity = f'trace of the zero modes in the exact null space, {boundaries}'
        yield Row(quantity, None, trace, remark=remark)
        largest = Row(f'largest zero exponent over ln(1 + t/w)/t, {boundaries}')
        if found is not None and len(found):
            spectrum = run.spectrum
            size = np.abs(np.array(spectrum.exponents)[found - spectrum.first_index]).max()
            scale = zeros.linear_growth(bag.info, spectrum.averaged_time)
            largest.measured, largest.remark = float(size) / scale, _course(bag, len(found))
        yield largest


def _course(bag, count):
    """The largest of the so many smallest |exponents|, at earlier times: constant if they fall
    so."""
    course = [
        (message.averaged_time, float(np.sort(np.abs(message.exponents))[count - 1]))
        for message in bag.messages(SPECTRUM)
        if message.averaged_time > 1 and count <= len(message.exponents)
    ]
    if not course:
        return ''
    said, end = [f'w = {bag.info.warmup:g}, the warm-up; '], course[-1][0]
    for part in (0.1, 0.3, 1.0):
        time, size = min(course, key=lambda point: abs(point[0] - part * end))
        said.append(f'{size / zeros.linear_growth(bag.info, time):.2g} at t = {time:.0f}')
    return said[0] + ', '.join(said[1:])


# ---- picture -------------------------------------------------------------------------------------


def picture(bags):
    known = [one for one in zip(BOXES, bags[0]) if one[1].recording.spectrum is not None]
    if not known:
        return None
    rows = -(-len(known) // 2)
    figure, grid = draw.panels(rows, 2, (7.6, 2.6 * rows), squeeze=False)
    draw.letters(grid.flat, [box for box, _ in known])
    for axes, (_, bag) in zip(grid.flat, known):
        _panel(axes, bag.recording)
    for axes in grid.flat[len(known) :]:
        axes.set_visible(False)
    return figure


def _panel(axes, recording):
    """The smallest positive exponents, each step in its colour with its name."""
    spectrum = recording.spectrum
    last = min(recording.positive_end, recording.last_index)
    first = max(spectrum.first_index, last - SHOWN + 1)
    inside = slice(first - spectrum.first_index, last + 1 - spectrum.first_index)
    exponents = np.array(spectrum.exponents[inside])
    grey = {'color': GREY, 'ecolor': GREY, 'markersize': 3, 'elinewidth': 0.7}
    errors = bars(spectrum.std_errors[inside])
    axes.errorbar(np.arange(first, last + 1), exponents, errors, fmt='.', **grey)
    for block in steps.blocks(recording.steps):
        if first <= block.first:
            _step(axes, block, exponents[block.first - first : block.last + 1 - first])
    axes.set(xlim=(first - 1, last + 1), ylim=(0, 1.4 * exponents.max()))
    axes.set(xlabel=r'index $\ell$', ylabel=r'$\lambda_\ell$  [1/time unit]')
    axes.ticklabel_format(axis='x', useOffset=False)


def _step(axes, block, exponents):
    colour, indices = kind_colour(block.kind), np.arange(block.first, block.last + 1)
    axes.plot(indices, exponents, '.', color=colour, markersize=4, zorder=3)
    name = f'{block.name} {block.last - block.first + 1}'.replace('+', '\n+')
    place, ink = (indices.mean(), exponents.max()), colour if block.kind else INK
    how = {'rotation': 90, 'ha': 'center', 'va': 'bottom', 'fontsize': 6, 'color': ink}
    axes.annotate(name, place, xytext=(0, 4), textcoords='offset points', **how)
