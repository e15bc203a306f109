"""Recording -> figures, as PNG and SVG: one file here for each."""

from . import (
    convergence,
    cost,
    covariant_angles,
    covariant_domination,
    covariant_exponents,
    covariant_vectors,
    covariant_weights,
    dispersion,
    localization,
    modes,
    p_mode,
    phases,
    spectrum,
    steps,
    structure,
)
from .style import STYLE, plt, save

# in the order in which hdlyap plot names them; each gives None where the bag has nothing for it
FIGURES = (
    spectrum,
    convergence,
    steps,
    dispersion,
    modes,
    p_mode,
    phases,
    localization,
    structure,
    covariant_exponents,
    covariant_weights,
    covariant_angles,
    covariant_domination,
    covariant_vectors,
    cost,
)
OF_MEANS = (spectrum, steps, dispersion)  # the others are of one run


def draw_all(recording, folder, progress, kinds=FIGURES):
    """Every figure that the recording has data for; the names of the files written."""
    files = []
    with plt.rc_context(STYLE):
        for kind in progress.over(kinds, len(kinds)):
            figure = kind.draw(recording)
            if figure is not None:
                files += save(figure, folder, kind.__name__.rpartition('.')[2])
    return files
