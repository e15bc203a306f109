"""How the growth of vectors fluctuates: diffusion against the index and variances against the time;
who changes its order, and what steps have in common."""

import functools

import numpy as np
from matplotlib import ticker

from hdlyap.numbers import known

from .. import covariant
from . import page
from .covariant import near_zero, shade
from .style import (
    BLUE,
    GREY,
    INK,
    KIND_COLOURS,
    MANY,
    VERMILION,
    bars,
    index_axis,
    instead,
    plain_log,
)

ORDER = 11

OFTEN, FEW = 32, 8  # times of which a fraction, a variance can be told
COLUMNS = 3  # most panels in a row
TICKS = 5  # most times on an axis
BARS = {'ecolor': GREY, 'elinewidth': 0.6}
CROWD = 400  # more dots than this are small, with thin bars, as they would hide each other
ABOVE = {'loc': 'lower right', 'bbox_to_anchor': (1, 1), 'fontsize': 6, 'borderpad': 0}
CLOSE = {'handletextpad': 0.1, 'columnspacing': 0.6}
NO_DIFFUSION = (
    'diffusion',
    'it takes 128 stretches of time beyond the memory of growth; average longer',
)
NO_TIMES = 'growth over finite times', 'a bag has it when fields are due; see field_interval'
NO_STEPS = 'correlations', 'no steps are resolved; smaller exponents, or a longer box, have them'
NO_PAIRS = 'correlations', NO_DIFFUSION[1]


@page.figure
def draw(page, recording, **look):
    message = recording.fluctuations
    if message is None:
        return
    shown = [
        panel for panel, lacks in _panels(recording, look) if not (lacks and _out(page, lacks))
    ]
    if not shown:
        return
    columns = min(COLUMNS, len(shown)) if len(shown) != 4 else 2
    rows = -(-len(shown) // columns)
    size = 2.8 * columns if columns > 1 else 4.6, 2.8 * rows
    grid = page.panels(rows, columns, *size, squeeze=False)
    for axes, panel in zip(grid.flat, shown):
        panel(axes)
    for axes in grid.flat[len(shown) :]:
        axes.set_axis_off()
    more = f', {message.averaged_time:.6g} time units'
    page.title(recording.info, *grid.flat[: len(shown)], more=more)


def _panels(recording, look):
    """Yields what draws into axes, and what it lacks and why if it has no data."""
    message, told = recording.fluctuations, recording.growth
    lacks = None if np.isfinite(message.diffusions).any() else NO_DIFFUSION
    indices = np.arange(len(message.diffusions)) + message.first_index
    near = near_zero(recording, indices)
    whole = indices[0], indices[-1]
    yield functools.partial(_diffusions, recording=recording, ends=whole, look=look), lacks
    if near != whole:
        yield functools.partial(_diffusions, recording=recording, ends=near, look=look), lacks
    lacks = NO_TIMES if told is None else None
    yield functools.partial(_variances, message=message, told=told, look=look), lacks
    yield functools.partial(_order, told=told, look=look), lacks
    yield functools.partial(_domination, recording=recording, told=told, look=look), lacks
    if told is not None and not told.indices:
        lacks = NO_STEPS
    elif told is not None and not np.isfinite(told.correlations.to_numpy()).any():
        lacks = NO_PAIRS
    yield functools.partial(_pairs, told=told, look=look), lacks


def _out(page, lacks):
    """Whether panels are left out, which is said once."""
    said = f'{lacks[0]}: {lacks[1]}'
    return said in page.left_out or page.leave_out(*lacks)


def _diffusions(axes, recording, ends, look):
    message, (begin, end) = recording.fluctuations, ends
    indices = np.arange(len(message.diffusions)) + message.first_index
    values, errors = np.array(message.diffusions, dtype=float), bars(message.std_errors)
    inside = np.isfinite(values) & (indices >= begin) & (indices <= end)
    error = None if errors is None else errors[inside]
    style = {'fmt': 'o', 'markersize': 2.4, 'color': BLUE, **MANY, **look}
    axes.errorbar(indices[inside], values[inside], error, **style)
    axes.set_ylim(bottom=0)
    axes.set_ylabel(r'$D_{\ell\ell}$  [1/time unit]')
    index_axis(axes, 5)
    if ends == near_zero(recording, indices):
        shade([axes], recording, *ends)
    if not inside.any():
        instead(axes, 'not yet known')


def _variances(axes, message, told, look):
    """Of the largest exponent, and the mean over the vectors of each step, with the errors of
    variances over so many times as if of independent vectors."""
    axes.set_xlabel('time  [time units]')
    axes.set_ylabel('variance / time  [1/time unit]')
    if told is None:
        return instead(axes, 'published with fields')
    count = told.times['count'].to_numpy()
    often = count >= FEW
    for name, indices in {'largest': [message.first_index], **told.indices}.items():
        kind = name.partition('(')[0]
        values = told.variances[indices].mean(axis=1)[often]
        error = values.abs() * np.sqrt(2 / (count[often] - 1) / max(1, len(indices)))
        style = {'fmt': '.-', 'color': KIND_COLOURS.get(kind, INK), 'linewidth': 0.8, **BARS}
        known_already = kind in axes.get_legend_handles_labels()[1]
        style = {**style, **look, 'label': '_' + name if known_already else kind}
        axes.errorbar(values.index, values.to_numpy(), bars(error), **style)
    _log_axes(axes, told.times['time'].to_numpy()[often])
    axes.legend(loc='lower center', bbox_to_anchor=(0.5, 1.0), ncol=3, fontsize=6)


def _log_axes(axes, times):
    """Logarithmic axes with plain numbers, the finite times along x."""
    axes.set_xscale('log')
    axes.set_yscale('log')
    axes.set_xticks(times[:: -(-len(times) // TICKS)])
    plain_log(axes.yaxis)
    axes.xaxis.set_major_formatter(ticker.FormatStrFormatter('%.3g'))
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    axes.tick_params(axis='x', which='minor', length=0)


def _fractions(axes, label):
    axes.set_ylabel(label)
    index_axis(axes, 5)
    axes.set_ylim(-0.04, 1.04)


def _shown_times(told):
    """Numbers of the times that are drawn: the shortest, the middle and the longest of which
    fractions can be told."""
    often = np.flatnonzero(told.times['count'] >= OFTEN)
    return np.unique(often[np.array([0, len(often) // 2, -1])]) if len(often) else [0]


def _dots(axes, told, number, row, fractions, look):
    """Draws fractions of times, with the errors of counts of independent times."""
    fractions = fractions.dropna()
    counted = np.maximum(0, fractions * (1 - fractions))
    error = np.sqrt(counted / max(1, told.times['count'][row]))
    size, width = (1.2, 0.1) if len(fractions) > CROWD else (3, 0.3)
    style = {'fmt': '.', 'markersize': size, 'alpha': 1 - 0.35 * number, **BARS}
    style = {**style, 'elinewidth': width, **look, 'label': f'{told.times["time"][row]:.3g}'}
    axes.errorbar(fractions.index + 0.5, fractions.to_numpy(), bars(error), **style)


def _order(axes, told, look):
    _fractions(axes, 'next vector grew more\n[fraction of times]')
    if told is None:
        return instead(axes, 'published with fields')
    for number, row in enumerate(_shown_times(told)):
        _dots(axes, told, number, row, told.violations.iloc[row], {'color': BLUE, **look})
    _name_times(axes, **ABOVE)


def _domination(axes, recording, told, look):
    _fractions(axes, 'later vector grew more\n[fraction of times]')
    if told is None:
        return instead(axes, 'published with fields')
    first, last = near_zero(recording, told.variances.columns)
    for number, row in enumerate(_shown_times(told)):
        found = told.domination_violations.iloc[row].loc[first : last - 1]
        found = found[covariant.is_splitting(recording, found.index)]
        _dots(axes, told, number, row, found, {'color': VERMILION, **look})
    shade([axes], recording, first, last)
    axes.set_ylim(-0.04, 1.16)  # names of steps are above the axes, so that times are inside
    axes.set_yticks(np.linspace(0, 1, 6))
    _name_times(axes, loc='upper left', fontsize=6, borderpad=0.3)


def _name_times(axes, **place):
    """The legend of times, in a line, with their unit behind the last."""
    handles, labels = axes.get_legend_handles_labels()
    labels[-1] += ' time unit' + 's' * (labels != ['1'])
    axes.legend(handles, labels, ncol=len(labels), **CLOSE, **place)


def _pairs(axes, told, look):
    """Correlations of the growth over long times, within steps and from one to the next."""
    axes.set_xlabel('step')
    axes.set_ylabel('correlation of growth')
    if told is None or not told.indices:
        return instead(axes, 'no steps' if told is not None else 'published with fields')
    names, size = list(told.indices), len(told.indices)
    error = told.std_errors.to_numpy() / told.covariances.abs().to_numpy()
    values, error = told.correlations.to_numpy(), np.abs(error * told.correlations.to_numpy())
    style = {'markersize': 3.5, 'elinewidth': 0.7, 'linestyle': '', **look}
    for aside, marker, colour, label in (
        (0, 'o', BLUE, 'of its vectors'),
        (1, 'x', INK, 'to the next step'),
    ):
        places = np.arange(size - aside)
        if not len(places):
            continue
        found = values.diagonal(aside), known(error.diagonal(aside))
        style['label'] = label
        axes.errorbar(places + 0.5 * aside, *found, **{'marker': marker, 'color': colour, **style})
    axes.set_xlim(-0.5, size - 0.5)
    axes.set_xticks(range(size))
    axes.set_xticklabels(names, rotation=90, fontsize=6)
    close = {'fontsize': 6, 'handletextpad': 0.2, 'columnspacing': 0.8, 'borderpad': 0}
    axes.legend(loc='lower right', bbox_to_anchor=(1, 1), ncol=2, **close)
