"""The dq and the dp half of every vector of the run that carries all 4N: the angle between them,
and the ratio of their lengths."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import ticker

from hdlyap.data import reader, steps
from hdlyap.numbers import known
from hdlyap.plots import paper
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, ZERO, scene

from .. import averages, draw, points, zeros
from ..averages import UNKNOWN
from ..bags import once
from ..row import Row, Scatter

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
        self.count = 4 * run.info.number
        self.behind_zeros = self.count + 1 - self.positive_end  # index of the first negative one
        self.is_of_paper = run.info.number == paper.DISKS
        self.is_known = bool(messages) and len(messages[-1].cos_theta) == self.count
        if self.is_known:
            self._measure(messages)

    def _measure(self, messages):
        """Rows of what follows: reports; columns: vectors of the positive half."""
        last, half = messages[-1], slice(self.positive_end)
        self.reports, self.pairing_error = len(messages), last.pairing_error
        self.exponents, self.errors = np.array(last.exponents), np.array(last.std_errors)
        self.pairs = (self.exponents + self.exponents[::-1])[half]
        cos = np.array([message.cos_theta for message in messages])
        ratio = np.array([message.dp_dq_ratio for message in messages])
        self.cos, self.cos_error = averages.of_series(cos)
        age = np.array([message.sim_time for message in messages]) - self.info.equilibration
        # constant where the angle falls like the inverse of the age of the frame
        self.angle_by_age = age[:, None] * np.sqrt(2 * (1 - np.abs(cos)))
        self.sums = (cos + cos[:, ::-1])[:, half]
        self.ratio, self.conjugate = ratio[:, half], 1 / ratio[:, ::-1][:, half]
        # |dq|^2 of the first l vectors less |dp|^2 of their conjugates
        self.excess = np.cumsum(1 / (1 + self.ratio**2) - 1 / (1 + self.conjugate**2), axis=1)

    def of(self, index):
        """(cos Theta, its error) of a Lyapunov index."""
        return float(self.cos[index - 1]), float(self.cos_error[index - 1])


@once
def _read(bag):
    return Halves(bag)


def cosines(bag):
    halves = _read(bag)
    places = ('below', halves.positive_end, 1.0), ('above', halves.behind_zeros, -1.0)
    for where, index, limit in places:
        value = halves.of(index) if halves.is_known else UNKNOWN
        remark = f'mean over {halves.reports} reports' if halves.is_known else ''
        quantity = f'cos Theta just {where} the zero modes, index {index}'
        yield Row(quantity, limit if halves.is_of_paper else None, *value, remark=remark)


def zero_indices(bag):
    """By the size of the exponents of all 4N vectors."""
    halves = _read(bag)
    found = halves.zeros if halves.is_known else []
    ends = (int(found[0]), int(found[-1])) if len(found) else (None, None)
    remark = f'{zeros.span(found)}, by their size' if len(found) else ''
    for name, published, index in zip(('first', 'last'), (FIRST_ZERO, LAST_ZERO), ends):
        published = published if halves.is_of_paper else None
        yield Row(f'{name} zero exponent', published, index, remark=remark)


def zero_cosines(bag):
    """|cos Theta| of each beside the limit, 1."""
    halves = _read(bag)
    if not halves.is_known:
        yield Row('|cos Theta| of the zero modes')
        return
    for index in range(halves.positive_end + 1, halves.behind_zeros):
        (cos, error), angle = halves.of(index), halves.angle_by_age[:, index - 1]
        remark = (
            f'cos Theta {cos:+.5f}; angle to the limit times the age of the frame: '
            f'{angle.min():.2f} to {angle.max():.2f}'
        )
        yield Row(f'|cos Theta| of zero mode {index}', None, abs(cos), error, remark=remark)


def step_cosines(bag):
    """Means over the vectors of each step of the positive half; they fluctuate together."""
    halves = _read(bag)
    if not halves.is_known:
        yield Row('cos Theta of steps')
        return
    found = [(one.name, one.first, one.last) for one in steps.blocks(halves.recording.steps)]
    for name, first, last in [('largest exponent', 1, 1), *found]:
        if last <= halves.positive_end:
            inside, remark = slice(first - 1, last), f'indices {first}-{last}'
            cos, error = float(halves.cos[inside].mean()), float(halves.cos_error[inside].max())
            yield Row(f'cos Theta of {name}', None, cos, error, remark=remark)
    mean = float(halves.cos[: halves.positive_end].mean())
    yield Row('cos Theta of the positive half, mean', None, mean)


def conjugates(bag):
    halves = _read(bag)
    yield _mean(halves, 'ln(C / C\')', lambda: np.log(halves.ratio / halves.conjugate))
    yield _mean(halves, ANGLES, lambda: halves.sums)
    quantity = 'sum of |dq|^2 less |dp|^2 of the conjugates, positive half'
    largest = float(np.abs(halves.excess[:, -1]).max()) if halves.is_known else None
    remark, accuracy = 'largest of all reports: what is apart by a gap is exact', bag.info.accuracy
    yield Row(quantity, 0.0, largest, remark=remark, left_open=accuracy)


def _mean(halves, what, values):
    value = averages.of_series(values().mean(axis=1)) if halves.is_known else UNKNOWN
    return Row(f'{what}, mean over the positive half', 0.0, *value)


def pairing(bag):
    """Of vectors that are carried each by itself; those of a step alone stand apart from others."""
    halves = _read(bag)
    total = abs(float(halves.pairs.sum())) if halves.is_known else None
    quantity, accuracy = 'sum of the exponents of both halves', bag.info.accuracy
    yield Row(quantity, 0.0, total, unit=UNIT, left_open=2 * accuracy)
    quantity = 'lambda_l + lambda_(4N+1-l) of the vectors of steps'
    found = sorted(points.steps_indices(halves.recording))
    inside = [index - 1 for index in found if index <= halves.positive_end]
    if halves.is_known and inside:
        errors = np.hypot(known(halves.errors), known(halves.errors[::-1]))[inside]
        if np.isfinite(errors).all():
            off, largest = halves.pairs[inside] / errors, np.abs(halves.pairs[inside]).max()
            percent, remark = (
                100 * errors / halves.exponents[inside],
                f'largest {largest:.2g} {UNIT}',
            )
            yield Scatter(quantity, float(off @ off), len(off), percent, remark)
            return
    yield Scatter(quantity)


def unsettled(bag):
    halves = _read(bag)
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


# ---- picture -------------------------------------------------------------------------------------


def picture(bag):
    halves = _read(bag)
    if not halves.is_known:
        return None
    figure = plt.figure(figsize=(7.2, 6.0), constrained_layout=True)
    grid = figure.add_gridspec(2, 2)
    whole, near, ratio = (figure.add_subplot(grid[at]) for at in ((0, 0), (0, 1), (1, slice(None))))
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
    return figure


def _near(axes, halves):
    first, last = halves.positive_end + 1 - BESIDE, halves.behind_zeros - 1 + BESIDE
    shown = [(index, *halves.of(index)) for index in range(max(first, 1), last + 1)]
    draw.bars(axes, shown, colour=BLUE, markersize=2.6, elinewidth=0.8, capsize=1.5)
    axes.xaxis.set_major_locator(ticker.MaxNLocator(nbins=6, integer=True))


def _ratio(axes, halves):
    indices = np.arange(1, halves.positive_end + 1)
    of_conjugate = r"$C'_{4N+1-\ell}=|\delta q|/|\delta p|$ of the conjugate"
    wide = {'color': VERMILION, 'linewidth': 3, 'alpha': 0.5}
    axes.semilogy(indices, halves.conjugate.mean(axis=0), label=of_conjugate, **wide)
    own, c = r'$C_\ell=|\delta p|/|\delta q|$', averages.of_series(halves.ratio)[0]
    axes.semilogy(indices, c, color=BLUE, linewidth=0.9, label=own)
    axes.set(xlabel=r'index $\ell$', ylabel=r"$C$, $C'$  [1/time unit]")
    axes.legend()
