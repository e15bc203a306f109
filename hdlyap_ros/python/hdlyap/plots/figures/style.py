"""How the figures look, and how they get into their files."""

import os

import matplotlib.style
import numpy as np
from matplotlib import ticker

from hdlyap import whole
from hdlyap.data import space, steps
from hdlyap.data.containers import is_curved
from hdlyap.numbers import known

POINTS = 2000  # of a curve; more cannot be seen
TITLE = 60  # characters of what is in a line with the name of the scene
# Okabe and Ito's palette, safe for colour-blind readers
BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY = (
    '#0072B2',
    '#E69F00',
    '#009E73',
    '#D55E00',
    '#CC79A7',
    '#56B4E9',
)
GREY, LIGHT, INK = '#8C8C8C', '#C8C8C8', '#1A1A1A'
MIXED, ZERO = PURPLE, GREEN  # vectors that T and LP steps share, those of the zero modes
KIND_COLOURS = {'T': BLUE, 'LP': VERMILION, 'zero': ZERO}
MEMBER_COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY)
STYLE = {
    'font.size': 9,
    'axes.titlesize': 9,
    'axes.labelsize': 9,
    'legend.fontsize': 8,
    'xtick.labelsize': 8,
    'ytick.labelsize': 8,
    'xtick.direction': 'in',
    'ytick.direction': 'in',
    'xtick.top': True,
    'ytick.right': True,
    'axes.linewidth': 0.7,
    'lines.linewidth': 1.2,
    'legend.frameon': False,
    'mathtext.fontset': 'dejavusans',
    'svg.hashsalt': 'hdlyap',
}
# error bars of points: of a few, of many small ones, of a great many
FEW = {'markersize': 4.5, 'elinewidth': 0.9, 'capsize': 2}
SMALL = {'fmt': 'o', 'markersize': 2.6, 'elinewidth': 0.8, 'capsize': 1.5}
MANY = {'ecolor': GREY, 'elinewidth': 0.7, 'rasterized': True}
UPRIGHT = {'rotation': 90, 'ha': 'center', 'va': 'bottom'}  # text above a place


def ours():
    """In it figures look as these, whatever a matplotlibrc says."""
    return matplotlib.style.context(['default', STYLE])


def beside(axes, text, place, aside, **look):
    """Text so many points to the right and above a place."""
    axes.annotate(text, place, xytext=aside, textcoords='offset points', **look)


def instead(axes, text):
    """Of what cannot be drawn."""
    axes.annotate(text, (0.5, 0.5), xycoords='axes fraction', ha='center')


def save(figure, folder, name, dpi=250):
    """Their names. dpi: of the PNG file."""
    files = []
    for suffix, options in (
        ('png', {'dpi': dpi}),
        ('svg', {'dpi': 200, 'metadata': {'Date': None}}),
    ):
        path = os.path.join(folder, f'{name}.{suffix}')
        with whole.written(path) as unfinished:
            figure.savefig(unfinished, **options)
        files.append(path)
    return files


def scene(info):
    name = info.scene.replace('$', r'\$')  # which would begin a formula
    if space.without_box(info):
        return f'{name}: {info.particles}, $N={info.number}$'
    if is_curved(info):
        size = f'{info.container}, ${info.box_x:.4g}\\times{info.box_y:.4g}$'
        return f'{name}: $N={info.number}$, $\\rho={info.density:g}$, {size}'
    walls = space.along(info, 'boundary_')
    walls = walls[:1] if len(set(walls)) == 1 else map(' '.join, zip('xyz', walls))
    box = f'$\\rho={info.density:g}$, ' + (
        _edges(info) if space.is_solid(info) else f'$L_y/L_x={info.aspect:g}$'
    )
    what = space.named(info) + '\n' if info.own else ', '  # too long for one line
    if len(what) > TITLE:
        what = what.replace(', ', '\n', 1)
    return f'{name}: $N={info.number}${what}{box}, ' + ', '.join(walls)


def _edges(info):
    edges = r'\times '.join(f'{edge:.2f}' for edge in space.along(info, 'box_'))
    return rf'${edges}\,\sigma^3$'


def index_axis(axes, nbins=6):
    """Of Lyapunov indices."""
    axes.xaxis.set_major_locator(ticker.MaxNLocator(nbins, integer=True, steps=[1, 2, 5, 10]))
    axes.set_xlabel(r'index $\ell$')


def bars(std_errors):
    """Lengths of error bars; None if not one is known."""
    errors = known(std_errors)
    return errors if np.isfinite(errors).any() else None


def thinned(count):
    return np.unique(np.linspace(0, count - 1, min(count, POINTS)).astype(int))


def kind_colour(kind):
    """Of a step's kind, or of None for a set with both kinds."""
    return KIND_COLOURS.get(steps.NAMES.get(kind), MIXED)
