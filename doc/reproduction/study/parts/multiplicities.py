"""Part 11: how many exponents each step has, by the boundaries; how many vanish, and how small
those are."""

import numpy as np

from hdlyap.data import steps
from hdlyap.plots.figures.style import GREY, INK, bars, kind_colour

from .. import draw, zeros
from ..files import cells
from ..row import Row
from ..stairs import stairs

BOXES = {
    'periodic': 'periodic',
    'reflecting': 'reflecting',
    'mixed': 'mixed',
    'square': 'periodic square',
    'narrow_periodic': 'narrow periodic',
    'narrow_reflecting': 'narrow, walls along x',
}
ZEROS = {
    'zeros_periodic': (6, 'both directions periodic'),
    'zeros_mixed': (4, 'one direction periodic'),
    'zeros_reflecting': (2, 'both directions reflecting'),
}
NARROW = 2.0  # diameters: disks cannot pass each other
SHOWN = 36  # exponents in a panel of the figure
SPECTRUM = 'hdlyap/Spectrum'
WALLED = 'reflecting'


# ---- the paper's rule ----------------------------------------------------------------------------


def prescribed(info, kind, nx, ny):
    """Multiplicity of a step: the number of modulations A that the boundaries allow; twice that for
    LP pairs."""
    count = 1
    for nodes, box, boundary in (
        (nx, info.box_x, info.boundary_x),
        (ny, info.box_y, info.boundary_y),
    ):
        if nodes and box < NARROW:
            return 0
        count *= _functions(nodes, boundary, kind)
    return count * (2 if kind == steps.LP else 1)


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

    @property
    def name(self):
        return ' + '.join(block.name.replace('+', ' + ') for block in self.blocks)

    @property
    def steps(self):
        return [step for block in self.blocks for step in block.steps]

    @property
    def trace(self):
        return sum(block.multiplicity for block in self.blocks)

    def prescribed(self, info):
        return sum(prescribed(info, step.kind, step.nx, step.ny) for step in self.steps)

    @property
    def stands_apart(self):
        """Whether no vectors that no step was found for go on without a jump."""
        return all(stair.count == self._of(stair) for stair in self.pieces)

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


def steps_found(bags):
    for name, box in BOXES.items():
        recording, found = bags[name].recording, levels(bags[name].recording)
        missed = [steps.name(step) for step in steps.unresolved(recording.steps)] if found else []
        count = sum(len(level.steps) for level in found) if found else None
        remark = 'not resolved: ' + ' '.join(missed) if missed else ''
        yield Row(f'{box}: steps found', None, count, remark=remark)


def counted(bags):
    for name, box in BOXES.items():
        recording = bags[name].recording
        found = levels(recording)
        yield from (_level_row(recording, box, level) for level in found)
        if not found:
            yield Row(f'{box}: multiplicities', 'by the rule')


def none(bags):
    """T(1,0) and T(0,1) would have the smallest exponents of all: there are none below LP(1,0)."""
    row = Row(f'{WALLED}: exponents smaller than those of LP(1,0)', 0)
    recording = bags[WALLED].recording
    first = next((one for one in levels(recording) if one.name == 'LP(1,0)'), None)
    if first is not None and first.pieces:
        row.measured = recording.positive_end - first.pieces[0].last
    yield row


def _level_row(recording, box, level):
    """Counted by the exponents alone where they stand apart from all others: the node takes as many
    vectors as the rule has. Between unknown neighbours nothing can be counted."""
    remark = f'trace {level.trace:.2f}'
    indices = f'{level.pieces[-1].first}-{level.pieces[0].last}' if level.pieces else ''
    if not level.pieces:
        remark += '; exponents not known'
    elif not level.stands_apart:
        remark += f'; goes on without a jump in the other exponents of {indices}'
    elif len(level.pieces) > 1:
        remark += f'; the exponents {indices} are no stair'
        remark += '' if level.measured else ', with errors that are not known'
    return Row(
        f'{box}: {level.name}', level.prescribed(recording.info), level.measured, remark=remark
    )


# ---- zero modes ----------------------------------------------------------------------------------


def vanishing(bags):
    """How many do."""
    for name, (count, boundaries) in ZEROS.items():
        recording = bags[name].recording
        spectrum, row = recording.spectrum, Row(f'zero exponents, {boundaries}', count)
        if spectrum is not None:
            found, others = _vanishing(recording)
            largest = zeros.threshold(recording.info, spectrum)
            row.measured = len(found)
            row.remark = f'indices {zeros.span(found)}, smaller than {largest:.2g}'
            row.remark += f'; the next is {others.min():.2g}' if len(others) else ''
        yield row


def zero_modes(bags):
    for name, (_, boundaries) in ZEROS.items():
        yield from _zero_rows(bags[name], boundaries)


def _vanishing(recording):
    """(Lyapunov indices of the exponents that vanish, sizes of the others)"""
    spectrum, found = recording.spectrum, zeros.indices(recording.info, recording.spectrum)
    vanish = np.isin(spectrum.first_index + np.arange(len(spectrum.exponents)), found)
    return found, np.abs(spectrum.exponents)[~vanish]


def _zero_rows(bag, boundaries):
    """The trace is of vectors that the scene's number chooses, so not beside the paper's."""
    recording = bag.recording
    spectrum, zero = recording.spectrum, recording.steps and steps.zero_modes(recording.steps)
    trace = Row(f'trace of the zero modes in the exact null space, {boundaries}')
    if zero is not None and zero.resolved:
        trace.measured = zero.multiplicity
        trace.remark = f'vectors {zero.first_index}-{zero.last_index}'
    largest = Row(f'largest zero exponent over ln(1 + t/w)/t, {boundaries}')
    found = zeros.indices(recording.info, spectrum) if spectrum is not None else []
    if len(found):
        size = np.abs(np.array(spectrum.exponents)[found - spectrum.first_index]).max()
        scale = zeros.linear_growth(recording.info, spectrum.averaged_time)
        largest.measured = float(size) / scale
        largest.remark = _course_remark(bag, len(found))
    return [trace, largest]


def zero_course(bag, count):
    """(averaged time, largest of the so many smallest |exponents|) at every report."""
    for message in bag.messages(SPECTRUM):
        if message.averaged_time > 1 and 0 < count <= len(message.exponents):
            yield message.averaged_time, float(np.sort(np.abs(message.exponents))[count - 1])


def _course_remark(bag, count):
    """The same at earlier times: constant if zero exponents fall so."""
    course = list(zero_course(bag, count))
    if not course:
        return ''
    info, end, said = bag.recording.info, course[-1][0], []
    for part in (0.1, 0.3, 1.0):
        time, size = min(course, key=lambda point: abs(point[0] - part * end))
        said.append(f'{size / zeros.linear_growth(info, time):.2g} at t = {time:.0f}')
    return f'w = {info.warmup:g}, the warm-up; ' + ', '.join(said)


# ---- figure and tables ---------------------------------------------------------------------------


def figures(bags):
    boxes = [name for name in BOXES if bags[name].recording.spectrum is not None]
    if boxes:
        yield 'stairs', _stairs_figure([(BOXES[name], bags[name].recording) for name in boxes])


def _stairs_figure(recordings):
    rows = -(-len(recordings) // 2)
    figure, grid = draw.panels(rows, 2, (7.6, 2.6 * rows), squeeze=False)
    draw.letters(grid.flat, [box for box, _ in recordings])
    for axes, (_, recording) in zip(grid.flat, recordings):
        _panel(axes, recording)
    for axes in grid.flat[len(recordings) :]:
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
    colour = kind_colour(block.kind)
    indices = np.arange(block.first, block.last + 1)
    axes.plot(indices, exponents, '.', color=colour, markersize=4, zorder=3)
    name = f'{block.name} {block.last - block.first + 1}'.replace('+', '\n+')
    place, ink = (indices.mean(), exponents.max()), colour if block.kind else INK
    how = {'rotation': 90, 'ha': 'center', 'va': 'bottom', 'fontsize': 6, 'color': ink}
    axes.annotate(name, place, xytext=(0, 4), textcoords='offset points', **how)


def tables(bags):
    about = 'box', 'step', 'wave_number', 'prescribed', 'resolved'
    found = 'first_index', 'last_index', 'members', 'trace', 'exponent', 'std_error'
    yield 'multiplicities', (*about, *found), [
        line for name, box in BOXES.items() for line in _lines(bags[name].recording, box)
    ]
    header = 'boundaries', 'averaged_time', 'largest_zero_exponent', 'linear_growth'
    yield 'zero_exponents', header, [
        cells('s g .4g .4g', boundaries, time, size, zeros.linear_growth(info, time))
        for name, (count, boundaries) in ZEROS.items()
        for info in [bags[name].recording.info]
        for time, size in _thinned(bags[name], count)
    ]


def _lines(recording, box):
    for one in recording.steps.steps if recording.steps else ():
        if one.kind == steps.ZERO or one.conjugate:
            continue
        count = prescribed(recording.info, one.kind, one.nx, one.ny)
        found = one.first_index, one.last_index, one.members, one.multiplicity
        found = (*found, one.exponent, one.std_error) if one.resolved else 6 * (None,)
        about = box, steps.name(one), one.wave_number, count, 'yes' if one.resolved else 'no'
        yield cells('s s .6g s s s s s .3f .6g .2g', *about, *found)


def _thinned(bag, count, most=60):
    course = list(zero_course(bag, count))
    return course[:: max(1, len(course) // most)]
