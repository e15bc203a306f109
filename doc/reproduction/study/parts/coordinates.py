"""Part 3: the dq and the dp half of every vector: the angle between them, and the ratio of their
lengths."""

import numpy as np
from matplotlib import ticker

from hdlyap.data import reader, steps
from hdlyap.plots import paper
from hdlyap.numbers import known
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, ZERO, plt, scene

from .. import averages, draw, zeros
from ..bags import once
from ..files import cells
from ..row import Row, Scatter

RUN = 'halves'
FIRST_ZERO, LAST_ZERO = 1558, 1563  # of the paper's 780 disks
BESIDE = 20  # vectors shown on either side of the zero modes
UNIT = '1/time unit'
ANGLES = 'cos Theta_l + cos Theta_(4N+1-l)'


class Halves:
    """What every report of the averaging said of all 4N vectors. C = |dp| / |dq|; C' = |dq| / |dp|
    of the conjugate vector 4N + 1 - l, as J turns the one into the other. That holds for what the
    first l vectors span once it has settled since the random first frame, as exp(-(lambda_l -
    lambda_l+1) t): soon behind a step, late inside of one.
    """

    def __init__(self, bag):
        messages = [one for one in bag.messages(reader.SPECTRUM) if one.averaged_time > 0]
        self.recording = run = bag.recording
        self.info, self.positive_end = run.info, run.positive_end
        self.zeros = zeros.indices(run.info, run.spectrum) if run.spectrum is not None else []
        self.count = 4 * run.info.disks
        self.is_of_paper = run.info.disks == paper.DISKS
        self.is_known = bool(messages) and len(messages[-1].cos_theta) == self.count
        if self.is_known:
            self._measure(messages)

    def _measure(self, messages):
        """Rows of what follows: reports; columns: vectors of the positive half."""
        self.reports, self.pairing_error = len(messages), messages[-1].pairing_error
        self.exponents, self.errors = (
            np.array(one) for one in (messages[-1].exponents, messages[-1].std_errors)
        )
        self.pairs = (self.exponents + self.exponents[::-1])[: self.positive_end]
        cos = np.array([message.cos_theta for message in messages])
        ratio = np.array([message.dp_dq_ratio for message in messages])
        self.cos, self.cos_error = averages.of_series(cos)
        age = np.array([message.sim_time for message in messages]) - self.info.equilibration
        # constant where the angle falls like the inverse of the age of the frame
        self.angle_by_age = age[:, None] * np.sqrt(2 * (1 - np.abs(cos)))
        half = slice(self.positive_end)
        self.sums = (cos + cos[:, ::-1])[:, half]
        self.ratio, other = ratio[:, half], ratio[:, ::-1][:, half]
        self.c, self.c_error = averages.of_series(self.ratio)
        self.conjugate = 1 / other
        self.c_conjugate = self.conjugate.mean(axis=0)
        # |dq|^2 of the first l vectors less |dp|^2 of their conjugates
        self.excess = np.cumsum(1 / (1 + self.ratio**2) - 1 / (1 + self.conjugate**2), axis=1)

    @property
    def behind_zeros(self):
        """Index of the first negative exponent."""
        return self.count + 1 - self.positive_end

    def number(self, values, index):
        """That of a Lyapunov index."""
        return float(values[index - 1])


@once
def _read(bag):
    return Halves(bag)


def _halves(bags):
    return _read(bags[RUN])


# ---- rows ----------------------------------------------------------------------------------------


def cosines(bags):
    halves = _halves(bags)
    places = ('below', halves.positive_end, 1.0), ('above', halves.behind_zeros, -1.0)
    for where, index, limit in places:
        row = Row(f'cos Theta just {where} the zero modes, index {index}', limit)
        if not halves.is_of_paper:
            row.published = None
        if halves.is_known:
            row.measured = halves.number(halves.cos, index)
            row.error = halves.number(halves.cos_error, index)
            row.remark = f'mean over {halves.reports} reports'
        yield row


def zero_indices(bags):
    """By the size of the exponents of all 4N vectors."""
    halves = _halves(bags)
    found = halves.zeros if halves.is_known else []
    ends = (int(found[0]), int(found[-1])) if len(found) else (None, None)
    remark = f'{zeros.span(found)}, by their size' if len(found) else ''
    for name, published, index in zip(('first', 'last'), (FIRST_ZERO, LAST_ZERO), ends):
        published = published if halves.is_of_paper else None
        yield Row(f'{name} zero exponent', published, index, remark=remark)


def zero_cosines(bags):
    """|cos Theta| of each beside the limit, 1."""
    halves = _halves(bags)
    if not halves.is_known:
        yield Row('|cos Theta| of the zero modes')
        return
    for index in range(halves.positive_end + 1, halves.behind_zeros):
        cos, angle = halves.number(halves.cos, index), halves.angle_by_age[:, index - 1]
        remark = (
            f'cos Theta {cos:+.5f}; angle to the limit times the age of the frame: '
            f'{angle.min():.2f} to {angle.max():.2f}'
        )
        error = halves.number(halves.cos_error, index)
        yield Row(f'|cos Theta| of zero mode {index}', None, abs(cos), error, remark=remark)


def step_cosines(bags):
    """Means over the vectors of each step of the positive half; they fluctuate together."""
    halves = _halves(bags)
    if not halves.is_known:
        yield Row('cos Theta of steps')
        return
    found = [
        (block.name, block.first, block.last)
        for block in steps.blocks(halves.recording.steps)
        if block.last <= halves.positive_end
    ]
    for name, first, last in [('largest exponent', 1, 1), *found]:
        inside = slice(first - 1, last)
        cos, error = float(halves.cos[inside].mean()), float(halves.cos_error[inside].max())
        yield Row(f'cos Theta of {name}', None, cos, error, remark=f'indices {first}-{last}')
    mean = float(halves.cos[: halves.positive_end].mean())
    yield Row('cos Theta of the positive half, mean', None, mean)


def conjugates(bags):
    halves = _halves(bags)
    yield _mean(halves, 'ln(C / C\')', lambda: np.log(halves.ratio / halves.conjugate))
    yield _mean(halves, ANGLES, lambda: halves.sums)
    yield Row(
        'sum of |dq|^2 less |dp|^2 of the conjugates, positive half',
        0.0,
        float(np.abs(halves.excess[:, -1]).max()) if halves.is_known else None,
        remark='largest of all reports: what is apart by a gap is exact',
        left_open=halves.info.accuracy,
    )


def _mean(halves, what, values):
    row = Row(f'{what}, mean over the positive half', 0.0)
    if halves.is_known:
        row.measured, row.error = map(float, averages.of_series(values().mean(axis=1)))
    return row


def pairing(bags):
    """Of vectors that are carried each by itself; those of a step alone stand apart from others."""
    halves = _halves(bags)
    total = Row('sum of the exponents of both halves', 0.0, unit=UNIT)
    total.left_open = 2 * halves.info.accuracy
    found = steps.blocks(halves.recording.steps)
    inside = [index - 1 for one in found for index in range(one.first, one.last + 1)]
    inside = [index for index in inside if index < halves.positive_end]
    scatter = Scatter('lambda_l + lambda_(4N+1-l) of the vectors of steps')
    if halves.is_known:
        total.measured = abs(float(halves.pairs.sum()))
        errors = np.hypot(known(halves.errors), known(halves.errors[::-1]))[inside]
        if len(inside) and np.isfinite(errors).all():
            off, largest = halves.pairs[inside] / errors, np.abs(halves.pairs[inside]).max()
            percent = 100 * errors / halves.exponents[inside]
            remark = f'largest {largest:.2g} {UNIT}'
            scatter = Scatter(scatter.quantity, float(off @ off), len(off), percent, remark)
    return [total, scatter]


def unsettled(bags):
    halves = _halves(bags)
    yield _largest(halves, '|C / C\' - 1|', lambda: halves.ratio / halves.conjugate - 1)
    yield _largest(halves, f'|{ANGLES}|', lambda: halves.sums)
    error = halves.pairing_error if halves.is_known else None
    yield Row('pairing error, max |lambda_l + lambda_(4N+1-l)|', None, error, unit=UNIT)


def _largest(halves, what, values):
    """Of the means of all vectors of the positive half."""
    row = Row(f'largest mean {what}')
    if halves.is_known:
        mean, error = averages.of_series(values())
        index = int(np.abs(mean).argmax())
        row.measured, row.error = float(abs(mean[index])), float(error[index])
        row.remark = f'index {1 + index}; median of one report {np.median(np.abs(values())):.1e}'
    return row


# ---- figure and tables ---------------------------------------------------------------------------


def figures(bags):
    halves = _halves(bags)
    if not halves.is_known:
        return
    figure = plt.figure(figsize=(7.2, 6.0), constrained_layout=True)
    grid = figure.add_gridspec(2, 2)
    whole, near, ratio = (
        figure.add_subplot(place) for place in (grid[0, 0], grid[0, 1], grid[1, :])
    )
    indices = np.arange(1, halves.count + 1)
    whole.plot(indices, halves.cos, '.', color=BLUE, markersize=2, rasterized=True)
    _near(near, halves)
    for axes in (whole, near):
        ends = halves.positive_end + 0.5, halves.behind_zeros - 0.5
        axes.axvspan(*ends, color=ZERO, alpha=0.25, linewidth=0)
        axes.axhline(0, color=GREY, linewidth=0.5)
        axes.set(ylim=(-1.08, 1.08), xlabel=r'index $\ell$', ylabel=r'$\cos\Theta_\ell$')
    _ratio(ratio, halves)
    shaded = f'shaded: zero modes {halves.positive_end + 1}-{halves.behind_zeros - 1}'
    draw.letters((whole, near, ratio), ('', shaded))
    figure.suptitle(f'{scene(halves.info)}, mean over {halves.reports} reports', fontsize=9)
    yield 'coordinates', figure


def _near(axes, halves):
    first, last = halves.positive_end + 1 - BESIDE, halves.behind_zeros - 1 + BESIDE
    inside = slice(max(first, 1) - 1, min(last, halves.count))
    indices = 1 + np.arange(halves.count)[inside]
    points = list(zip(indices, halves.cos[inside], halves.cos_error[inside]))
    draw.bars(axes, points, colour=BLUE, markersize=2.6, elinewidth=0.8, capsize=1.5)
    axes.xaxis.set_major_locator(ticker.MaxNLocator(nbins=6, integer=True))


def _ratio(axes, halves):
    indices = np.arange(1, halves.positive_end + 1)
    of_conjugate = r"$C'_{4N+1-\ell}=|\delta q|/|\delta p|$ of the conjugate"
    wide = {'color': VERMILION, 'linewidth': 3, 'alpha': 0.5}
    axes.semilogy(indices, halves.c_conjugate, label=of_conjugate, **wide)
    own = r'$C_\ell=|\delta p|/|\delta q|$'
    axes.semilogy(indices, halves.c, color=BLUE, linewidth=0.9, label=own)
    axes.set(xlabel=r'index $\ell$', ylabel=r"$C$, $C'$  [1/time unit]")
    axes.legend()


def tables(bags):
    halves = _halves(bags)
    if not halves.is_known:
        return
    yield 'cos_theta', ('index', 'cos_theta', 'std_error'), [
        cells('s .5f .1e', index, *one)
        for index, one in enumerate(zip(halves.cos, halves.cos_error), 1)
    ]
    columns = zip(halves.c, halves.c_error, halves.c_conjugate, np.abs(halves.excess).max(axis=0))
    header = 'index', 'C', 'std_error', 'C_of_conjugate', 'largest_excess_up_to_here'
    yield 'ratios', header, [
        cells('s .5g .1e .5g .1e', index, *one) for index, one in enumerate(columns, 1)
    ]
