"""What is drawn in a figure, as lines of text: titles, labels; of points their number and means."""

import numpy as np


def digest(figure):
    figure.canvas.draw()
    title = figure._suptitle.get_text() if figure._suptitle else ''
    return [f'  {title}', *(line for axes in figure.axes for line in _axes(axes))]


def _axes(axes):
    places = 'left', 'center', 'right'
    titles = ' '.join(filter(None, (axes.get_title(loc=place) for place in places)))
    scales = f'{axes.get_xscale()} {axes.get_yscale()}'
    yield f'  | {titles} | {axes.get_xlabel()} | {axes.get_ylabel()} | {scales}'
    legend = axes.get_legend()
    if legend:
        yield '    ' + '; '.join(text.get_text() for text in legend.get_texts())
    texts = [text.get_text() for text in axes.texts]
    if texts:
        yield '    ' + ' '.join(texts)
    for one in axes.lines:
        yield f'    line {_means(*one.get_data())}'
    for one in axes.collections:
        yield f'    {type(one).__name__} {_of_collection(one)}'
    heights = [one.get_height() for one in axes.patches if hasattr(one, 'get_height')]
    if heights:
        yield f'    bars {_means(heights)}'


def _of_collection(one):
    if hasattr(one, 'U'):
        return _means(one.X, one.Y, one.U, one.V)
    parts = [] if one.get_array() is None else [one.get_array()]
    paths = [path.vertices for path in one.get_paths()]
    if paths and not parts:
        parts = [np.concatenate(paths)]
    return _means(*parts, np.asarray(one.get_offsets()))


def _means(*values):
    """Of each: how many numbers, their mean, and that of neighbours' products."""
    numbers = (np.ma.filled(np.ma.asarray(one, dtype=float), np.nan).ravel() for one in values)
    return ' '.join(f'{len(one)} {means(one[np.isfinite(one)])}' for one in numbers)


def means(values):
    """Of them, and of neighbours' products, which see their order."""
    if not len(values):
        return '-'
    products = np.mean(values[1:] * values[:-1]) if len(values) > 1 else 0.0
    return f'{values.mean():.4e} {products:.4e}'
