"""A number at every disk as a pattern of colours over the box."""

from .style import INK

SIZE = 9  # of a dot [square points]


def pattern(axes, x, y, values, limit, size=SIZE):
    """With a bar of colours from -limit to limit."""
    colours = {'c': values, 'cmap': 'RdBu_r', 'vmin': -limit, 'vmax': limit}
    picture = axes.scatter(x, y, s=size, edgecolors=INK, linewidths=0.15, **colours)
    axes.set_aspect('equal')
    return axes.figure.colorbar(picture, ax=axes, shrink=0.8)
