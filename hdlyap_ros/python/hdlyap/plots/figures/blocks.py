"""Successive samples -> the error of their mean from blocks, against the length of blocks. hdlyap
plot does not draw it: it takes arrays."""

import numpy as np
from matplotlib import ticker
from matplotlib.cbook import normalize_kwargs
from matplotlib.lines import Line2D

from hdlyap.data import series

from .page import Page
from .style import FEW, GREY, INK


def draw(values, lengths=None, stated=None, ax=None, **look):
    """Draws the errors. values, lengths: see data.series; stated: an error to compare with. Returns
    a Page."""
    page = Page(ax)
    axes, found = page.panels(1, 1, 5.2, 3.4), series.block_errors(values, lengths)
    style = {'fmt': 'o', 'color': INK, **FEW, **normalize_kwargs(look, Line2D)}
    axes.errorbar(found.lengths, found.errors, found.uncertainties, **style)
    known = series.standard_error(values, lengths)
    if np.isfinite(known):
        label = 'by the autocorrelation time'
        axes.axhline(known, color=style['color'], linewidth=0.8, linestyle='--', label=label)
    if stated is not None:
        axes.axhline(stated, color=GREY, linewidth=0.8, label='stated')
    axes.set_xscale('log')
    axes.set_xticks(found.lengths)
    axes.xaxis.set_major_formatter(ticker.FormatStrFormatter('%.3g'))
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    axes.set_ylim(bottom=0)
    axes.set_xlabel('samples in a block' if lengths is None else 'length of a block  [time units]')
    axes.set_ylabel('error of the mean')
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc='lower right')
    return page.drawn()
