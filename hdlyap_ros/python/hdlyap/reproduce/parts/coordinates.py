"""Part 3: the dq and the dp half of every vector: the angle between them, and the ratio of their
lengths."""

import numpy as np
from matplotlib import ticker

from hdlyap.data import reader
from hdlyap.plots import paper, steps
from hdlyap.plots.figures.style import BLUE, GREY, VERMILION, ZERO, plt, scene

from .. import averages, zeros
from ..row import BELOW, INFERRED, PAPER, Claim, Row

TITLE = 'Angle and ratio of the dq and dp halves, all 4N vectors'
READ_OFF = 0.02  # of cos Theta, which the paper says as seen in a plot
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
        messages = [
            message for message in bag.messages(reader.SPECTRUM) if message.averaged_time > 0
        ]
        run = bag.recording
        self.info, self.positive_end = run.info, run.positive_end
        self.zeros = zeros.indices(run.info, run.spectrum) if run.spectrum is not None else []
        self.count = 4 * run.info.disks
        self.is_known = bool(messages) and len(messages[-1].cos_theta) == self.count
        if self.is_known:
            self._measure(messages)

    def _measure(self, messages):
        """Rows of what follows: reports; columns: vectors of the positive half."""
        self.reports, self.pairing_error = len(messages), messages[-1].pairing_error
        exponents = np.array(messages[-1].exponents)
        self.all_pairs = abs(float(np.sum((exponents + exponents[::-1])[: self.positive_end])))
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


def runs(plan):
    return ['halves']


def claims(bags):
    halves = Halves(bags['halves'])
    of_paper = halves.info.disks == paper.DISKS
    yield Claim(
        'cos Theta is 1 just below the zero modes and -1 just above them',
        [
            _cos(halves, 'below', halves.positive_end, 1.0 if of_paper else None),
            _cos(halves, 'above', halves.behind_zeros, -1.0 if of_paper else None),
        ],
        f'within {READ_OFF:g}, as read off a plot',
    )
    yield Claim('the zero exponents are 1558-1563', _ends(halves, of_paper), 'the same', PAPER)
    yield Claim(
        'cos Theta of the zero modes lies between these limits',
        _zero_rows(halves),
        'farther from 1 and -1 than the modes beside them',
        INFERRED,
    )
    yield Claim('cos Theta of steps', list(_step_rows(bags['halves'].recording, halves)))
    yield Claim(
        'C\' of the negative half is C of the positive half',
        [
            _mean(halves, 'ln(C / C\')', 0.0, lambda: np.log(halves.ratio / halves.conjugate)),
            _mean(halves, ANGLES, 0.0, lambda: halves.sums),
            Row(
                'sum of |dq|^2 less |dp|^2 of the conjugates, positive half',
                0.0,
                float(np.abs(halves.excess[:, -1]).max()) if halves.is_known else None,
                left_open=halves.info.accuracy,
                remark='largest of all reports: what is apart by a gap is exact',
            ),
        ],
        f'within {READ_OFF:g}; what a gap sets apart within the accuracy asked for',
    )
    yield Claim('vectors of close exponents, which have not settled', _unsettled(halves))


def _unsettled(halves):
    yield _largest(halves, '|C / C\' - 1|', lambda: halves.ratio / halves.conjugate - 1)
    yield _largest(halves, f'|{ANGLES}|', lambda: halves.sums)
    yield Row(
        'pairing error, max |lambda_l + lambda_(4N+1-l)|',
        None,
        halves.pairing_error if halves.is_known else None,
        unit=UNIT,
        remark=f'all of the half: {halves.all_pairs:.1e}' if halves.is_known else '',
    )


def _ends(halves, of_paper):
    """By the size of the exponents of all 4N vectors."""
    found = halves.zeros if halves.is_known else []
    ends = (int(found[0]), int(found[-1])) if len(found) else (None, None)
    for name, published, index in zip(('first', 'last'), (FIRST_ZERO, LAST_ZERO), ends):
        yield Row(
            f'{name} zero exponent',
            published if of_paper else None,
            index,
            remark=f'{zeros.span(found)}, by their size' if len(found) else '',
        )


def _zero_rows(halves):
    """|cos Theta| of each beside the smaller one of the neighbours."""
    indices = range(halves.positive_end + 1, halves.behind_zeros)
    if not halves.is_known:
        yield Row('|cos Theta| of the zero modes', 1.0, sense=BELOW)
        return
    limit = float(np.abs(halves.cos[[halves.positive_end - 1, halves.behind_zeros - 1]]).min())
    for index in indices:
        cos = float(halves.cos[index - 1])
        angle = halves.angle_by_age[:, index - 1]
        remark = (
            f'cos Theta {cos:+.5f}; angle to the limit times the age of the frame: '
            f'{angle.min():.2f} to {angle.max():.2f}'
        )
        yield _of_index(halves, f'|cos Theta| of zero mode {index}', index, limit, remark)


def _of_index(halves, quantity, index, limit, remark):
    at = index - 1
    error = float(halves.cos_error[at])
    return Row(quantity, limit, float(abs(halves.cos[at])), error, remark=remark, sense=BELOW)


def _step_rows(recording, halves):
    """Means over the vectors of each step of the positive half; they fluctuate together."""
    if not halves.is_known:
        yield Row('cos Theta of steps')
        return
    named = [('largest exponent', 1, 1)] + [
        (block.name, block.first, block.last)
        for block in steps.blocks(recording.steps)
        if block.last <= halves.positive_end
    ]
    for name, first, last in named:
        inside = slice(first - 1, last)
        cos, error = float(halves.cos[inside].mean()), float(halves.cos_error[inside].max())
        yield Row(f'cos Theta of {name}', None, cos, error, remark=f'indices {first}-{last}')
    yield Row(
        'cos Theta of the positive half, mean',
        None,
        float(halves.cos[: halves.positive_end].mean()),
    )


def _mean(halves, what, published, values):
    quantity = f'{what}, mean over the positive half'
    if not halves.is_known:
        return Row(quantity, published, left_open=READ_OFF)
    mean, error = averages.of_series(values().mean(axis=1))
    return Row(quantity, published, float(mean), float(error), READ_OFF)


def _largest(halves, what, values):
    """Of the means of all vectors of the positive half."""
    quantity = f'largest mean {what}'
    if not halves.is_known:
        return Row(quantity)
    mean, error = averages.of_series(values())
    index = int(np.abs(mean).argmax())
    return Row(
        quantity,
        None,
        float(abs(mean[index])),
        float(error[index]),
        remark=f'index {1 + index}; median of one report {np.median(np.abs(values())):.1e}',
    )


def _cos(halves, where, index, published):
    quantity = f'cos Theta just {where} the zero modes, index {index}'
    if not halves.is_known:
        return Row(quantity, published, left_open=READ_OFF)
    return Row(
        quantity,
        published,
        float(halves.cos[index - 1]),
        float(halves.cos_error[index - 1]),
        READ_OFF,
        remark=f'mean over {halves.reports} reports',
    )


def figures(bags):
    halves = Halves(bags['halves'])
    if not halves.is_known:
        return
    figure = plt.figure(figsize=(7.2, 6.0), constrained_layout=True)
    grid = figure.add_gridspec(2, 2)
    whole, near, ratio = (
        figure.add_subplot(place) for place in (grid[0, 0], grid[0, 1], grid[1, :])
    )
    _whole(whole, halves)
    _near(near, halves)
    _ratio(ratio, halves)
    shaded = f'(b) shaded: zero modes {halves.positive_end + 1}-{halves.behind_zeros - 1}'
    for axes, title in ((whole, '(a)'), (near, shaded), (ratio, '(c)')):
        axes.set_title(title, loc='left')
    figure.suptitle(f'{scene(halves.info)}, mean over {halves.reports} reports', fontsize=9)
    yield 'coordinates', figure


def _whole(axes, halves):
    indices = np.arange(1, halves.count + 1)
    axes.plot(indices, halves.cos, '.', color=BLUE, markersize=2, rasterized=True)
    axes.axvspan(
        halves.positive_end + 0.5, halves.behind_zeros - 0.5, color=ZERO, alpha=0.3, linewidth=0
    )
    _cos_axes(axes)


def _near(axes, halves):
    first, last = halves.positive_end + 1 - BESIDE, halves.behind_zeros - 1 + BESIDE
    first, last = max(first, 1), min(last, halves.count)
    indices = np.arange(first, last + 1)
    inside = slice(first - 1, last)
    axes.errorbar(
        indices,
        halves.cos[inside],
        halves.cos_error[inside],
        fmt='o',
        color=BLUE,
        markersize=2.6,
        elinewidth=0.8,
        capsize=1.5,
    )
    axes.axvspan(
        halves.positive_end + 0.5, halves.behind_zeros - 0.5, color=ZERO, alpha=0.2, linewidth=0
    )
    axes.xaxis.set_major_locator(ticker.MaxNLocator(nbins=6, integer=True))
    _cos_axes(axes)


def _cos_axes(axes):
    axes.axhline(0, color=GREY, linewidth=0.5)
    axes.set_ylim(-1.08, 1.08)
    axes.set_xlabel(r'index $\ell$')
    axes.set_ylabel(r'$\cos\Theta_\ell$')


def _ratio(axes, halves):
    indices = np.arange(1, halves.positive_end + 1)
    axes.semilogy(
        indices,
        halves.c_conjugate,
        color=VERMILION,
        linewidth=3,
        alpha=0.5,
        label=r"$C'_{4N+1-\ell}=|\delta q|/|\delta p|$ of the conjugate",
    )
    axes.semilogy(
        indices, halves.c, color=BLUE, linewidth=0.9, label=r'$C_\ell=|\delta p|/|\delta q|$'
    )
    axes.set_xlabel(r'index $\ell$')
    axes.set_ylabel(r"$C$, $C'$  [1/time unit]")
    axes.legend()


def tables(bags):
    halves = Halves(bags['halves'])
    if not halves.is_known:
        return
    yield 'cos_theta', ('index', 'cos_theta', 'std_error'), [
        (index, f'{cos:.5f}', f'{error:.1e}')
        for index, (cos, error) in enumerate(zip(halves.cos, halves.cos_error), start=1)
    ]
    columns = zip(halves.c, halves.c_error, halves.c_conjugate, np.abs(halves.excess).max(axis=0))
    yield 'ratios', ('index', 'C', 'std_error', 'C_of_conjugate', 'largest_excess_up_to_here'), [
        (index, f'{c:.5g}', f'{error:.1e}', f'{other:.5g}', f'{off:.1e}')
        for index, (c, error, other, off) in enumerate(columns, start=1)
    ]
