"""Recording -> figures, as PNG, SVG and pages of a PDF: one file here for each."""

import contextlib

from matplotlib.backends.backend_pdf import PdfPages

from hdlyap import whole

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


def name(kind):
    return kind.__name__.rpartition('.')[2]


def draw_all(recording, folder, progress, kinds=FIGURES, pdf=None):
    """Every figure that the recording has data for; the names of the files written. pdf: one more
    file, that has them all."""
    files, pages = [], None
    with plt.rc_context(STYLE), contextlib.ExitStack() as stack:
        for kind in progress.over(kinds, len(kinds)):
            figure = kind.draw(recording)
            if figure is None:
                continue
            if pdf and not pages:
                pages = stack.enter_context(PdfPages(stack.enter_context(whole.written(pdf))))
            if pdf:
                pages.savefig(figure)
            files += save(figure, folder, name(kind))
    return files + ([pdf] if pdf and files else [])
