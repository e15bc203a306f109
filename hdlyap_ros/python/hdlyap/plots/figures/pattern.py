"""Draws a number at every particle as a pattern of colours over the box."""

from .style import INK

SIZE = 9  # size of a dot [square points]


def pattern(axes, x, y, values, limit, size=SIZE, **look):
    """Draws the pattern with a colour bar from -limit to limit."""
    colours = {'c': values, 'cmap': 'RdBu_r', 'vmin': -limit, 'vmax': limit}
    rims = {'edgecolors': INK, 'linewidths': 0.15}
    picture = axes.scatter(x, y, s=size, **{**colours, **rims, **look})
    axes.set_aspect('equal')
    return axes.figure.colorbar(picture, ax=axes, shrink=0.8)
