"""The measured steps: the part of each that was found, and how degenerate its exponents are."""

import numpy as np
from scipy.special import fdtrc

from hdlyap.data import steps

from ..deviation import FREEDOM
from . import page
from .style import GREY, INK, SMALL, bars, beside, kind_colour

ORDER = 3
IS_OF_MEANS = True  # drawn of several seeds, too

MOST = 24  # most steps that are shown; the names of more would not fit
CHANCE = 1e-3  # probability that equal exponents of a set scatter as much as those called apart
APART = 'apart beyond errors however long the run'
SET, AROUND = 0.42, 1.9  # width of a set, and of what is beside all of them [inch]
LEAST = 4.6  # least width of the figure, for its title [inch]


@page.figure
def draw(page, recording, **look):
    blocks = steps.blocks(recording.steps, recording.info)[:MOST]
    if not blocks or recording.spectrum is None:
        return
    width = max(LEAST, min(AROUND + SET * len(blocks), 5.6))
    top, bottom = page.panels(2, 1, width, 5.2, sharex=True)
    for place, block in enumerate(blocks):
        _found(top, place, block, look)
        _degeneracy(bottom, place, block, recording.spectrum, look)
    top.axhline(100, color=GREY, linewidth=0.6)
    label = 'least that counts'
    least = 100 * recording.steps.threshold
    top.axhline(least, color=INK, linewidth=0.8, linestyle=':', label=label)
    top.set_ylim(0, 108)
    top.set_ylabel('multiplicity  [% of expected]')
    top.legend(loc='lower right', bbox_to_anchor=(1, 1), borderpad=0)
    bottom.axhline(0, color=GREY, linewidth=0.6)
    bottom.set_ylabel('exponent from mean  [%]')
    for axes in (top, bottom):
        axes.set_xticks(range(len(blocks)))
        axes.set_xticklabels([block.name.replace('+', '\n+') for block in blocks], rotation=90)
        axes.set_xlim(-0.7, len(blocks) - 0.3)
        axes.tick_params(axis='x', length=0)
    apart = [block.name for block in blocks if is_apart(block, recording.spectrum)]
    if apart:
        bottom.set_title(f'{APART}: {", ".join(apart)}', loc='left')
    averaged = f'\naveraged over {recording.steps.averaged_time:g} time units'
    page.title(recording.info, top, bottom, more=averaged)


def _found(axes, place, block, look):
    """Draws the multiplicity that was found; for steps that share a set, that of all together."""
    share = 100 * block.multiplicity / block.expected
    axes.bar(place, share, **{'width': 0.7, 'color': kind_colour(block.kind), **look})
    text = f'{block.multiplicity:.1f}/{block.expected}'
    words = {'ha': 'center', 'va': 'top', 'fontsize': 6, 'color': 'white'}
    beside(axes, text, (place, share), (0, -3), **words)


def _degeneracy(axes, place, block, spectrum, look):
    """Draws the deviation of each vector's exponent, from the first index to the last."""
    inside = slice(block.first - spectrum.first_index, block.last + 1 - spectrum.first_index)
    exponents = np.array(spectrum.exponents[inside])
    errors = bars(spectrum.std_errors[inside])
    mean = exponents.mean()
    spread = np.linspace(-0.3, 0.3, len(exponents)) if len(exponents) > 1 else [0.0]
    errors = None if errors is None else 100 * errors / abs(mean)
    off, colour = 100 * (exponents / mean - 1), kind_colour(block.kind)
    axes.errorbar(np.add(place, spread), off, errors, **{'color': colour, **SMALL, **look})


def is_apart(block, spectrum):
    """Whether the exponents of a step differ by more than their errors, each of which is known by
    FREEDOM degrees of freedom."""
    inside = slice(block.first - spectrum.first_index, block.last + 1 - spectrum.first_index)
    exponents, errors = np.array(spectrum.exponents[inside]), np.array(spectrum.std_errors[inside])
    if len(block.steps) > 1 or len(exponents) < 2 or not (errors > 0).all():
        return False
    mean, freedom = np.average(exponents, weights=errors**-2.0), len(exponents) - 1
    ratio = np.sum(((exponents - mean) / errors) ** 2) / freedom
    return bool(fdtrc(freedom, FREEDOM * len(exponents), ratio) < CHANCE)
