"""Points -> a figure of measured quantities against swept parameters."""

import contextlib
import itertools
import textwrap

import numpy as np
from matplotlib.lines import Line2D

from hdlyap import parameters
from hdlyap.data import space
from hdlyap.plots import latex
from hdlyap.plots.figures.page import LETTERS, Page
from hdlyap.plots.figures.style import FEW, GREY, MEMBER_COLOURS, ours

from .points import FITTED, quantities, varied

LABELS = {
    'number': 'number of particles $N$',
    'density': r'density $\rho$  [1/$\sigma^2$]',
    'aspect': 'aspect ratio $L_y/L_x$',
    'aspect_z': 'aspect ratio $L_z/L_x$',
    'boundary': 'boundary',
}
SHORT = {'number': '$N$', 'density': r'$\rho$', 'aspect': '$L_y/L_x$', 'aspect_z': '$L_z/L_x$'}
NAMES = {
    'lambda_max': r'$\lambda_{\max}$  [1/time unit]',
    'h_KS/N': r'$h_{\mathrm{KS}}/N$  [1/time unit]',
    'c_T': r'$c_T$  [$\sigma$/time unit]',
    'c_L': r'$c_L$  [$\sigma$/time unit]',
    'v': r'$v$  [$\sigma$/time unit]',
    'collision_rate': 'collision rate  [1/time unit]',
    'pressure': r'pressure  [1/$\sigma^2$]',
    'temperature': r'temperature  [$\epsilon$]',
    'exponent_sum': r'$\sum \lambda$  [1/time unit]',
    'kaplan_yorke': 'Kaplan-Yorke dimension',
    'shear_stress': r'shear stress  [1/$\sigma^2$]',
    'velocity_low': r'velocity near the low wall  [$\sigma$/time unit]',
    'velocity_high': r'velocity near the high wall  [$\sigma$/time unit]',
}
MARKERS = 'os^Dv<>p'
ERRORS = (
    'error bars: one standard error, of means over seeds the larger of stated error and scatter'
)
LEAST = 4.6  # least width of the figure [inch]
LETTER = 0.056  # width of a letter of the text below [inch]
APART = 0.012  # shift of series over the width of a panel, so that error bars do not hide others


def draw(points, ax=None, title=True, legend=True, paper=None, **look):
    """Draws a panel for each quantity. Returns None for a single point or if nothing was measured.
    The arguments are those of figures.page.figure."""
    page = Page(ax, title, legend, paper)
    with ours(paper) if paper and page.is_own else contextlib.nullcontext():
        return _drawn(page, points, look)


def _drawn(page, points, look):
    names, fixed = varied(points)
    shown = [name for name in quantities(points) if any(name in point.values for point in points)]
    if not names or not shown:
        return None
    x = max(names, key=lambda name: (not _are_words(points, name), _count(points, name)))
    series = _series(points, [name for name in names if name != x])
    columns = 1 if page.is_narrow else 2 if len(shown) in (2, 4) else min(3, len(shown))
    rows = -(-len(shown) // columns)
    size = max(3.1 * columns, LEAST), 2.7 * rows + 0.9
    how = {'constrained_layout': bool(page.paper), 'squeeze': False}
    panels = page.panels(rows, columns, *size, **how)
    for name, axes in zip(shown, panels.flat):
        _panel(axes, name, x, series, look)
    for axes in panels.flat[len(shown) :]:
        axes.remove()
    if page.is_own:
        info = points[0].data.info
        page.caption = ', '.join(_said(name, value, info) for name, value in fixed.items())
        _letters(panels.flat[: len(shown)])
        _finish(page, series, points)
    return page.drawn()


def _letters(panels):
    for axes, letter in zip(panels, LETTERS if len(panels) > 1 else ''):
        axes.set_title(f'({letter})', loc='left')


def _finish(page, series, points):
    """Writes title and legend; for a journal the legend alone, into the first panel."""
    if page.paper:
        handles = _handles(series)
        if handles:
            page.axes[0].legend(handles=handles)
        return
    wide = int(page.figure.get_figwidth() / (LETTER * 9 / 7))
    if page.has_title:
        page.figure.suptitle(textwrap.fill(page.caption, wide), fontsize=9)
    bottom = _explain(page, series, points)
    page.figure.tight_layout(rect=(0, bottom, 1, 1))


def _count(points, name):
    return len({point.system[name] for point in points})


def _are_words(points, name):
    return any(isinstance(point.system[name], str) for point in points)


def _said(name, value, info=None):
    """A parameter with its value and, if info is given, its unit."""
    if name == 'boundary':
        return value
    unit = rf'$\,\sigma^{{-{len(space.axes(info))}}}$' if info and name == 'density' else ''
    number = value if isinstance(value, str) else format(value, 'g')
    return f'{SHORT.get(name, name.replace("_", " "))} = {number}{unit}'


def _series(points, names):
    """{label: points} for each combination of the parameters other than that of the x axis."""
    found = {}
    for point in points:
        of_it = {name: point.system[name] for name in names if point.system[name] != ''}
        label = ', '.join(_said(name, value) for name, value in of_it.items())
        found.setdefault(label, []).append(point)
    return found


def _places(points, x):
    """The places of values on an axis, and the words if they are words, which are side by side."""
    if _are_words(points, x):
        words = sorted({str(point.system[x]) for point in points})
        return {word: place for place, word in enumerate(words)}, words
    values = sorted({point.system[x] for point in points})
    return {value: value for value in values}, None


def _panel(axes, name, x, series, look):
    every = list(itertools.chain(*series.values()))
    places, words = _places(every, x)
    width = max(places.values()) - min(places.values())
    for number, (label, points) in enumerate(series.items()):
        shift = APART * width * (number - (len(series) - 1) / 2)
        for point in points:
            if name in point.values:
                value = point.values[name]
                place = places[str(point.system[x]) if words else point.system[x]] + shift
                _point(axes, place, value, number, {'label': label, **look})
                label = ''  # once
    axes.margins(y=0.12)
    axes.set_xlim(*_limits(list(places.values()), words))
    if words:
        axes.set_xticks(range(len(words)))
        # three words in a line would overlap
        axes.set_xticklabels(
            [word.replace(',', ',\n') if word.count(',') > 1 else word for word in words]
        )
    axes.set_xlabel(_label(x, every[0].data.info))
    unit = quantities(every)[name]
    told = f'{name.replace("_", " ")}  [{unit}]' if unit else name.replace('_', ' ')
    is_average = any(p.data.has('averages') and name in p.data.averages.index for p in every)
    known = told if is_average else NAMES[name]
    axes.set_ylabel(known.replace('^2', f'^{len(space.axes(every[0].data.info))}'))


def _label(x, info):
    """The name of a parameter with its unit."""
    known = parameters.named(info, x)
    if x not in LABELS and known and known.unit:
        return f'{x.replace("_", " ")}  [{latex.unit(known.unit)}]'
    label = LABELS.get(x, x.replace('_', ' ')).replace('particles', space.particle(info) + 's')
    return label.replace('^2', f'^{len(space.axes(info))}')


def _limits(places, words):
    margin = 0.5 if words else 0.15 * (max(places) - min(places))
    return min(places) - margin, max(places) + margin


def _point(axes, place, value, number, look):
    """Draws a point. It is open if the fit is c k or c k + c2 k^2, which have the rest of the
    curvature in c; it is a cross if its error is not known."""
    colour, marker = _look(number)
    marker, error = (marker, value.error) if np.isfinite(value.error) else ('x', None)
    face = 'white' if _is_open(value) else colour
    style = {'fmt': marker, 'color': colour, 'markerfacecolor': face, **FEW, **look}
    axes.errorbar(place, value.value, error, **style)


def _is_open(value):
    return value.fit is not None and value.fit.symbol != 'v' and value.fit.terms < 3


def _look(number):
    return MEMBER_COLOURS[number % len(MEMBER_COLOURS)], MARKERS[number % len(MARKERS)]


def _handles(series):
    handles = []
    for number, label in enumerate(series if len(series) > 1 else ()):
        look = dict(zip(('color', 'marker'), _look(number)))
        handles.append(Line2D([], [], linestyle='', label=label, **look))
    return handles


def _explain(page, series, points):
    """Writes the legend below the panels, and what the looks of points mean. Returns its height."""
    figure = page.figure
    is_known = [np.isfinite(v.error) for point in points for v in point.values.values()]
    lines = [ERRORS] if any(is_known) else []
    if len(series) > 1:
        lines.append(
            'points of each series are shifted along x, so that error bars do not hide each other'
        )
    values = [point.values[name] for point in points for name in FITTED if name in point.values]
    if not all(is_known):
        lines.append('cross: the error is not known, the run was too short')
    if any(map(_is_open, values)):
        lines.append('open: fitted without c3, or without c2 and c3; sweep.txt has the form')
    wide = int(figure.get_figwidth() / LETTER)
    lines = [part for line in lines for part in textwrap.wrap(line, wide)]
    handles = _handles(series) if page.has_legend else []
    columns = min(4, len(handles))
    rows = -(-len(handles) // columns) if handles else 0
    height = figure.get_figheight()
    text = 0.16 * len(lines) / height
    if handles:
        figure.legend(handles=handles, loc='lower center', ncol=columns, bbox_to_anchor=(0.5, text))
    figure.text(0.01, 0.04 / height, '\n'.join(lines), fontsize=7, color=GREY, va='bottom')
    return text + (0.05 + 0.2 * rows) / height
