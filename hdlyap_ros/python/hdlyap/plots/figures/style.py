"""The look of figures, and how they are written to files."""

import os

import matplotlib.style
import numpy as np
from matplotlib import ticker

from hdlyap import whole
from hdlyap.data import space, steps
from hdlyap.data.containers import is_curved, radius
from hdlyap.data.reader import is_known
from hdlyap.numbers import known

from .look import BLUE, GREEN, GREY, INK, LIGHT, ORANGE, PAPER, PURPLE, SKY, STYLE  # noqa: F401
from .look import VERMILION  # noqa: F401

POINTS = 2000  # most points of a curve; more cannot be seen
TITLE = 60  # most characters in a line with the name of the scene
MIXED, ZERO = PURPLE, GREEN  # colours of vectors that T and LP steps share, and of zero modes
KIND_COLOURS = {'T': BLUE, 'LP': VERMILION, 'zero': ZERO}
MEMBER_COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY)
# looks of points with error bars: few points, many small ones, very many
FEW = {'markersize': 4.5, 'elinewidth': 0.9, 'capsize': 2}
SMALL = {'fmt': 'o', 'markersize': 2.6, 'elinewidth': 0.8, 'capsize': 1.5}
MANY = {'ecolor': GREY, 'elinewidth': 0.7, 'rasterized': True}
SVG = 'svg', {'dpi': 200, 'metadata': {'Date': None}}
# vectors, with maps as pixels of a journal's resolution
FILES_OF_PAPER = (('pdf', {'dpi': 600, 'metadata': {'CreationDate': None}}),)
LEAST_BELOW = 0.3  # least part of a panel that is left for what is below a legend
LOWER = 1.3  # height of a panel over that which it has beside labels, whose places come later
UPRIGHT = {'rotation': 90, 'ha': 'center', 'va': 'bottom'}  # look of a text above a place


def ours(paper=None):
    """A context in which figures have this look, or that of a journal, whatever a matplotlibrc
    says."""
    return matplotlib.style.context(['default', STYLE, *([PAPER] if paper else [])])


def beside(axes, text, place, aside, **look):
    """Writes a text beside a place; aside: points to the right and upwards."""
    axes.annotate(text, place, xytext=aside, textcoords='offset points', **look)


def instead(axes, text):
    """Writes a text in place of something that cannot be drawn."""
    axes.annotate(text, (0.5, 0.5), xycoords='axes fraction', ha='center')


def below(axes, legend):
    """Raises the upper end of a linear axis until curves and points are below a legend."""
    box = legend.get_window_extent(axes.figure.canvas.get_renderer())
    (left, low), (right, _) = axes.transAxes.inverted().transform(box)
    low = 1 - LOWER * (1 - low)
    under = [
        axes.transAxes.inverted().transform(axes.transData.transform(line.get_xydata()))
        for line in axes.get_lines()
    ]
    y = np.concatenate([at[(at[:, 0] > left) & (at[:, 0] < right), 1] for at in under])
    bottom, top = axes.get_ylim()
    higher = np.max(y[np.isfinite(y)], initial=0) / max(low - 0.03, LEAST_BELOW)
    axes.set_ylim(bottom, bottom + (top - bottom) * max(1, higher))


def save(figure, folder, name, dpi=250, paper=None):
    """Writes a figure to files, for a journal to one. Returns their names. dpi: resolution of the
    PNG file."""
    files = []
    for suffix, options in FILES_OF_PAPER if paper else (('png', {'dpi': dpi}), SVG):
        path = os.path.join(folder, f'{name}.{suffix}')
        with whole.written(path) as unfinished:
            figure.savefig(unfinished, **options)
        files.append(path)
    return files


def scene(info):
    if not is_known(info):
        return f'run {info.run_id}: no run_info'
    name = info.scene.replace('$', r'\$')  # $ would begin a formula
    if space.without_box(info):
        return f'{name}: {info.particles}, $N={info.number}$'
    if is_curved(info):
        size = f'{info.container}, ${info.box_x:.4g}\\times{info.box_y:.4g}$'
        size = f'circle, $R={radius(info):.4g}$' if radius(info) else size
        return f'{name}: $N={info.number}${space.named(info)}, $\\rho={info.density:g}$, {size}'
    walls = space.along(info, 'boundary_')
    walls = walls[:1] if len(set(walls)) == 1 else map(' '.join, zip('xyz', walls))
    box = f'$\\rho={info.density:g}$, ' + (
        _edges(info) if space.is_solid(info) else f'$L_y/L_x={info.aspect:g}$'
    )
    what = space.named(info) + '\n' if space.own(info) else ', '  # it is too long for one line
    what = what.replace(', ', '\n', 1) if len(what) > TITLE else what
    what += box + ', ' + ', '.join(walls) + space.shear(info, '$b={:g}$')
    return f'{name}: $N={info.number}${what}'


def _edges(info):
    edges = r'\times '.join(f'{edge:.2f}' for edge in space.along(info, 'box_'))
    return rf'${edges}\,\sigma^3$'


def index_axis(axes, nbins=6):
    """Makes the x axis one of Lyapunov indices."""
    axes.xaxis.set_major_locator(ticker.MaxNLocator(nbins, integer=True, steps=[1, 2, 5, 10]))
    axes.set_xlabel(r'index $\ell$')


def plain_log(axis):
    """Gives a logarithmic axis plain numbers that do not overlap: 1, 2, 5, or if it is shorter than
    a decade evenly spaced ones."""
    low, high = axis.get_view_interval()
    if high < 10 * low:
        axis.set_major_locator(ticker.MaxNLocator(5, steps=[1, 2, 5, 10]))
    else:
        subs = (1, 2, 5) if high < 100 * low else (1,)
        axis.set_major_locator(ticker.LogLocator(subs=subs))
    axis.set_major_formatter(ticker.FormatStrFormatter('%.4g'))
    axis.set_minor_formatter(ticker.NullFormatter())


def bars(std_errors):
    """The lengths of error bars; None if no error is known."""
    errors = known(std_errors)
    return errors if np.isfinite(errors).any() else None


def thinned(count):
    return np.unique(np.linspace(0, count - 1, min(count, POINTS)).astype(int))


def kind_colour(kind):
    """The colour of a step's kind; kind = None stands for a set with both kinds."""
    return KIND_COLOURS.get(steps.NAMES.get(kind), MIXED)
