"""Part 11: how many exponents each step has, by the boundaries; how many vanish, and how small
those are."""

import numpy as np

from hdlyap.plots import steps
from hdlyap.plots.figures.style import GREY, INK, bars, kind_colour, plt

from .. import zeros
from ..row import PAPER, Claim, Row
from ..stairs import stairs

TITLE = 'Multiplicities of the steps and number of zero exponents, by the boundaries'
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


def runs(plan):
    return [*BOXES, *ZEROS]


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


def claims(bags):
    found = {name: levels(bags[name].recording) for name in BOXES}
    yield Claim(
        'every step has as many exponents as the boundaries allow modulations',
        [
            row
            for name in BOXES
            for row in _step_rows(bags[name].recording, BOXES[name], found[name])
        ],
        'the same, of the steps that were resolved',
        PAPER,
    )
    zero = [_zero_rows(bags[name], *about) for name, about in ZEROS.items()]
    yield Claim(
        '6, 4 or 2 exponents vanish, by the boundaries',
        [rows[0] for rows in zero],
        'the same',
        PAPER,
    )
    yield Claim('zero modes', [row for rows in zero for row in rows[1:]])
    yield Claim(
        'steps found',
        [_found_row(bags[name].recording, BOXES[name], found[name]) for name in BOXES],
    )


def _step_rows(recording, box, found):
    if not found:
        return [Row(f'{box}: multiplicities', 'by the rule')]
    return [_level_row(recording, box, level) for level in found]


def _found_row(recording, box, found):
    missed = [steps.name(step) for step in steps.unresolved(recording.steps)] if found else []
    return Row(
        f'{box}: steps found',
        None,
        len(steps_of(found)) if found else None,
        remark='not resolved: ' + ' '.join(missed) if missed else '',
    )


def steps_of(found):
    return [step for level in found for step in level.steps]


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


def _zero_rows(bag, count, boundaries):
    """How many vanish; then what is shown of them."""
    recording = bag.recording
    spectrum, zero = recording.spectrum, recording.steps and steps.zero_modes(recording.steps)
    if spectrum is None:
        return [Row(f'zero exponents, {boundaries}', count)]
    size, found = np.abs(spectrum.exponents), zeros.indices(recording.info, spectrum)
    vanish = np.isin(spectrum.first_index + np.arange(len(size)), found)
    remark = (
        f'indices {zeros.span(found)}, smaller than {zeros.threshold(recording.info, spectrum):.2g}'
    )
    if not vanish.all():
        remark += f'; the next is {size[~vanish].min():.2g}'
    scale = zeros.linear_growth(recording.info, spectrum.averaged_time)
    largest = Row(
        f'largest zero exponent over ln(1 + t/w)/t, {boundaries}',
        None,
        float(size[vanish].max()) / scale if vanish.any() else None,
        remark=_course_remark(bag, len(found)),
    )
    number = Row(f'zero exponents, {boundaries}', count, len(found), remark=remark)
    return [number, _trace_row(zero, boundaries), largest]


def _trace_row(zero, boundaries):
    """Of vectors that the scene's number chooses, so not beside the paper's."""
    quantity = f'trace of the zero modes in the exact null space, {boundaries}'
    if zero is None or not zero.resolved:
        return Row(quantity)
    return Row(
        quantity, None, zero.multiplicity, remark=f'vectors {zero.first_index}-{zero.last_index}'
    )


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
    rows_count = -(-len(recordings) // 2)
    figure, grid = plt.subplots(
        rows_count, 2, figsize=(7.6, 2.6 * rows_count), squeeze=False, constrained_layout=True
    )
    for axes, letter, (box, recording) in zip(grid.flat, 'abcdef', recordings):
        _panel(axes, recording)
        axes.set_title(f'({letter}) {box}', loc='left')
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
    axes.errorbar(
        np.arange(first, last + 1),
        exponents,
        bars(spectrum.std_errors[inside]),
        fmt='.',
        color=GREY,
        ecolor=GREY,
        markersize=3,
        elinewidth=0.7,
    )
    for block in steps.blocks(recording.steps):
        if first <= block.first:
            _step(axes, block, exponents[block.first - first : block.last + 1 - first])
    axes.set_xlim(first - 1, last + 1)
    axes.set_ylim(0, 1.4 * exponents.max())
    axes.set_xlabel(r'index $\ell$')
    axes.set_ylabel(r'$\lambda_\ell$  [1/time unit]')
    axes.ticklabel_format(axis='x', useOffset=False)


def _step(axes, block, exponents):
    colour = kind_colour(block.kind)
    indices = np.arange(block.first, block.last + 1)
    axes.plot(indices, exponents, '.', color=colour, markersize=4, zorder=3)
    axes.annotate(
        f'{block.name} {block.last - block.first + 1}'.replace('+', '\n+'),
        (indices.mean(), exponents.max()),
        xytext=(0, 4),
        textcoords='offset points',
        rotation=90,
        ha='center',
        va='bottom',
        fontsize=6,
        color=colour if block.kind else INK,
    )


def tables(bags):
    header = (
        'box',
        'step',
        'wave_number',
        'prescribed',
        'resolved',
        'first_index',
        'last_index',
        'members',
        'trace',
        'exponent',
        'std_error',
    )
    yield 'multiplicities', header, [
        line for name, box in BOXES.items() for line in _lines(bags[name].recording, box)
    ]
    yield 'zero_exponents', (
        'boundaries',
        'averaged_time',
        'largest_zero_exponent',
        'linear_growth',
    ), [
        (
            boundaries,
            f'{time:g}',
            f'{size:.4g}',
            f'{zeros.linear_growth(bags[name].recording.info, time):.4g}',
        )
        for name, (count, boundaries) in ZEROS.items()
        for time, size in _thinned(bags[name], count)
    ]


def _lines(recording, box):
    info = recording.info
    for step in recording.steps.steps if recording.steps else ():
        if step.kind == steps.ZERO or step.conjugate:
            continue
        found = (
            (
                step.first_index,
                step.last_index,
                step.members,
                f'{step.multiplicity:.3f}',
                f'{step.exponent:.6g}',
                f'{step.std_error:.2g}',
            )
            if step.resolved
            else ('',) * 6
        )
        yield (
            box,
            steps.name(step),
            f'{step.wave_number:.6g}',
            prescribed(info, step.kind, step.nx, step.ny),
            'yes' if step.resolved else 'no',
            *found,
        )


def _thinned(bag, count, most=60):
    course = list(zero_course(bag, count))
    return course[:: max(1, len(course) // most)]
