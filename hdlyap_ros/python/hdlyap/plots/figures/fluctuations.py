"""How the growth of vectors fluctuates: diffusion against the index and variances against the time;
who changes its order, and what steps have in common."""

import numpy as np

from hdlyap.numbers import known

from .. import covariant
from . import page
from .covariant import near_zero, shade
from .style import BLUE, INK, KIND_COLOURS, MANY, VERMILION, bars, index_axis, instead

ORDER = 11

OFTEN, FEW = 32, 8  # times of which a fraction, a variance can be told


@page.figure
def draw(page, recording, **look):
    message = recording.fluctuations
    if message is None:
        return
    told = recording.growth
    grid = page.panels(2, 3, 8.4, 5.0)
    diffusion, near, variance, order, domination, common = grid.flat
    _diffusions(diffusion, near, recording, look)
    _variances(variance, message, told, look)
    _orders(order, domination, recording, told, look)
    _pairs(common, told, look)
    page.title(recording.info, more=f', {message.averaged_time:.6g} time units')


def _diffusions(whole, near, recording, look):
    message = recording.fluctuations
    indices = np.arange(len(message.diffusions)) + message.first_index
    values, errors = np.array(message.diffusions, dtype=float), bars(message.std_errors)
    first, last = near_zero(recording, indices)
    for axes, (begin, end) in ((whole, (indices[0], indices[-1])), (near, (first, last))):
        inside = np.isfinite(values) & (indices >= begin) & (indices <= end)
        error = None if errors is None else errors[inside]
        style = {'fmt': 'o', 'markersize': 2.4, 'color': BLUE, **MANY, **look}
        axes.errorbar(indices[inside], values[inside], error, **style)
        axes.set_ylim(bottom=0)
        axes.set_ylabel(r'$D_{\ell\ell}$  [1/time unit]')
        index_axis(axes)
    shade([near], recording, first, last)


def _variances(axes, message, told, look):
    """Of the largest exponent, and the mean over the vectors of each step."""
    axes.set_xlabel('time  [time units]')
    axes.set_ylabel('variance of growth / time')
    if told is None:
        return instead(axes, 'published with fields')
    often = told.times['count'].to_numpy() >= FEW
    for name, indices in {'largest': [message.first_index], **told.indices}.items():
        kind = name.partition('(')[0]
        values = told.variances[indices].mean(axis=1)[often]
        style = {'marker': '.', 'color': KIND_COLOURS.get(kind, INK), 'linewidth': 0.8, **look}
        known_already = kind in axes.get_legend_handles_labels()[1]
        axes.plot(values.index, values, **{**style, 'label': '_' + name if known_already else kind})
    axes.set_xscale('log')
    axes.set_yscale('log')
    axes.legend(loc='lower center', bbox_to_anchor=(0.5, 1.0), ncol=3, fontsize=6)


def _orders(order, domination, recording, told, look):
    labels = 'next vector grew more', 'later vector grew more\nthan earlier one'
    for axes, label in zip((order, domination), labels):
        axes.set_ylabel(f'{label}  [fraction]')
        index_axis(axes)
        axes.set_ylim(-0.04, 1.04)
    if told is None:
        return [instead(axes, 'published with fields') for axes in (order, domination)]
    often = np.flatnonzero(told.times['count'] >= OFTEN)
    shown = np.unique(often[np.array([0, len(often) // 2, -1])]) if len(often) else [0]
    first, last = near_zero(recording, told.variances.columns)
    for number, row in enumerate(shown):
        strength = 1 - 0.35 * number
        style = {'linestyle': '', 'marker': '.', 'markersize': 3, 'alpha': strength, **look}
        style['label'] = f'{told.times["time"][row]:.3g} time units'
        one, other = told.violations.iloc[row], told.domination_violations.iloc[row]
        order.plot(one.index + 0.5, one, **{'color': BLUE, **style})
        other = other.loc[first : last - 1]
        other = other[covariant.is_splitting(recording, other.index)]
        domination.plot(other.index + 0.5, other, **{'color': VERMILION, **style})
    order.legend(loc='upper right', fontsize=6, handletextpad=0.1)
    shade([domination], recording, first, last)


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
        found = values.diagonal(aside), known(error.diagonal(aside))
        style['label'] = label
        axes.errorbar(places + 0.5 * aside, *found, **{'marker': marker, 'color': colour, **style})
    axes.set_xticks(range(size))
    axes.set_xticklabels(names, rotation=90, fontsize=6)
    axes.legend(fontsize=6, handletextpad=0.2)
