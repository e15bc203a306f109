"""A number at every disk as a pattern of colours over the box."""

from .style import INK

SIZE = 9  # of a dot [square points]


def pattern(axes, x, y, values, limit, size=SIZE, **look):
    """With a bar of colours from -limit to limit."""
    colours = {'c': values, 'cmap': 'RdBu_r', 'vmin': -limit, 'vmax': limit}
    rims = {'edgecolors': INK, 'linewidths': 0.15}
    picture = axes.scatter(x, y, s=size, **{**colours, **rims, **look})
    axes.set_aspect('equal')
    return axes.figure.colorbar(picture, ax=axes, shrink=0.8)
