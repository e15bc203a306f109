"""Running means and their standard errors against the averaged time."""

import numpy as np

from . import page
from .style import BLUE, GREY, INK, ORANGE, SKY, VERMILION, instead, plain_log, thinned

ORDER = 2

SETTLED = 0.1  # part of the averaged time before which the course may leave the panel
MARGIN = 0.15  # around the later course, over its height
UNKNOWN = (
    'none is known yet; average longer (rosrun hdlyap hdlyap_node --check SCENE says how long)'
)


@page.figure
def draw(page, recording, **look):
    if recording.spectrum is None:
        return
    course = recording.course()
    is_known = np.isfinite(course['error']).any()
    rows = 3 if is_known or not page.leave_out('standard errors', UNKNOWN) else 2
    grid = page.panels(rows, 1, 5.2, 0.6 + 2 * rows, squeeze=False)
    top, middle, *others = grid.flat
    for axes in grid.flat:
        axes.set_xscale('log')
    kept = thinned(len(course['time']))
    time = course['time'][kept]
    of_largest = course['lambda_max'][kept], course['lambda_max_error'][kept]
    _with_error(top, time, *of_largest, **{'color': INK, **look})
    _settled(top, time, *of_largest)
    top.set_ylabel(r'$\lambda_{\max}$  [1/time unit]')
    means, errors = course['small'][kept].T, course['small_errors'][kept].T
    colours = SKY, BLUE, ORANGE, VERMILION
    for index, mean, error, colour in zip(recording.smallest, means, errors, colours):
        named = {'color': colour, **look, 'label': rf'$\ell={index}$'}
        _with_error(middle, time, mean, error, **named)
    _settled(middle, time, means.T, errors.T)
    middle.set_ylabel(r'$\lambda_\ell$  [1/time unit]')
    above = {'loc': 'lower right', 'bbox_to_anchor': (1, 1), 'borderpad': 0}
    columns = len(means) // (1 + page.is_narrow) or 1
    middle.legend(ncol=columns, handlelength=1, columnspacing=0.8, **above)
    for axes in others:
        _error(axes, time, course['error'][kept], **look)
        axes.set_ylabel('standard error  [1/time unit]')
        axes.set_title('standard errors', loc='left')
    for axes in grid.flat:
        axes.set_xlabel('averaged time  [time units]')
    errors = ', bands: standard errors' if is_known else ''
    top.set_title('largest exponent' + errors, loc='left')
    middle.set_title('smallest exponents', loc='left')
    page.outer(grid[:2])
    page.title(recording.info, *grid.flat)


def _settled(axes, time, mean, error):
    """Sets limits so that all of the later course is inside, whatever came before."""
    late = time >= SETTLED * time[-1]
    around = np.nan_to_num(error[late])
    low, high = np.min(mean[late] - around), np.max(mean[late] + around)
    if high > low:
        axes.set_ylim(low - MARGIN * (high - low), high + MARGIN * (high - low))


def _with_error(axes, time, mean, error, color, **look):
    if np.isfinite(error).any():
        axes.fill_between(time, mean - error, mean + error, color=color, alpha=0.25, linewidth=0)
    axes.plot(time, mean, _mark(time), color=color, **look)


def _mark(time):
    """The marker: a single report is drawn as a point."""
    return 'o' if len(time) == 1 else '-'


def _error(axes, time, error, **look):
    measured = np.isfinite(error)
    if not measured.any():
        instead(axes, 'not yet known')
        return
    last, time, error = time[-1], time[measured], error[measured]
    label = 'of all exponents, root mean square'
    axes.loglog(time, error, _mark(time), **{'color': INK, 'label': label, **look})
    slope = error[-1] * np.sqrt(last / time)
    axes.loglog(time, slope, '--', color=GREY, label=r'$\propto 1/\sqrt{t}$')
    for axis in (axes.xaxis, axes.yaxis):
        plain_log(axis)
    axes.legend()
