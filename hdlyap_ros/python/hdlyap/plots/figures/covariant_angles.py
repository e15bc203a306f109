"""Distributions of the angles between unstable, centre and stable space."""

import numpy as np

from .. import covariant
from . import page
from .style import BLUE, GREEN, VERMILION

COLOURS = (VERMILION, BLUE, GREEN)  # colours of the pairs of spaces
ROOM = 1.4  # height of the axes over that of curves, to leave room for text


@page.figure
def draw(page, run, **look):
    message = run.covariant
    if message is None or not message.angles:
        return
    left, right = page.panels(1, 2, 7.2, 3.4)
    for axes, counts, title in (
        (left, 'smallest_counts', 'smallest angle'),
        (right, 'all_counts', 'all principal angles'),
    ):
        _histograms(axes, message.angles, counts, look)
        axes.set_title(title, loc='left')
        axes.set_xlim(0, covariant.RIGHT_ANGLE)
        axes.set_ylim(0, ROOM * axes.get_ylim()[1])
        axes.set_xticks(covariant.RIGHT_ANGLE * np.linspace(0, 1, 5))
        axes.set_xticklabels(['0', r'$\pi/8$', r'$\pi/4$', r'$3\pi/8$', r'$\pi/2$'])
        axes.set_xlabel('angle  [rad]')
        axes.set_ylabel('probability density  [1/rad]')
    page.outer(np.array([[left, right]]))
    page.title(run.info, left, right, more=f', {message.samples} samples')


def _histograms(axes, angles, name, look):
    """Draws histograms. One whose angles are all in one bin is written, as its peak would hide
    others."""
    for angle in angles:
        counts, colour = getattr(angle, name), COLOURS[angle.spaces]
        at = covariant.only_bin(counts)
        if at:
            axes.plot([], [], linestyle='', label=_said(angle, at))
        elif sum(counts):
            label, height = covariant.SPACES[angle.spaces], np.append(covariant.density(counts), 0)
            style = {'color': colour, 'linewidth': 1, **look, 'label': label}
            axes.step(covariant.edges(counts), height, where='post', **style)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc='upper left', handlelength=1, borderaxespad=0.2, fontsize=7)


def _said(angle, at):
    right = np.isclose(at[1], covariant.RIGHT_ANGLE)
    low, high = np.degrees(at)
    where = f'at right angles, within {high - low:.0f}°' if right else f'{low:.0f} .. {high:.0f}°'
    return f'{covariant.SPACES[angle.spaces]}: {where}'
