"""Recording -> figures, as PNG, SVG and pages of a PDF. Each figure, a module here or a row of
covariant.FIGURES, has draw(run, ax=None, **look); see page.figure."""

import contextlib
import importlib

from matplotlib.backends.backend_pdf import PdfPages

from hdlyap import whole
from hdlyap.data.reader import NoInfo

from . import covariant
from .style import ours, save

# in the order in which hdlyap plot lists them; draw returns None if the bag has no data for one
NAMES = 'spectrum convergence steps dispersion modes p_mode phases localization structure '
NAMES += 'covariant_exponents covariant_weights covariant_angles covariant_domination '
NAMES += 'covariant_vectors fluctuations cost'
FIGURES = {
    name: covariant.FIGURES.get(name) or importlib.import_module(f'.{name}', __name__)
    for name in NAMES.split()
}
globals().update(covariant.FIGURES)  # so that each figure is imported by its name
OF_MEANS = 'spectrum', 'steps', 'dispersion'  # figures of several seeds; others are of one run


def draw_all(recording, folder, progress, names=tuple(FIGURES), pdf=None):
    """Draws each figure for which the recording has data. Returns the names of the files, and of
    figures that need run_info, which it lacks. pdf: a file with all figures."""
    files, pages, lost = [], None, []
    with ours(), contextlib.ExitStack() as stack:
        for name in progress.over(names, len(names)):
            try:
                page = FIGURES[name].draw(recording)
            except NoInfo:
                lost.append(name)
                continue
            if page is None:
                continue
            if pdf and not pages:
                pages = stack.enter_context(PdfPages(stack.enter_context(whole.written(pdf))))
            if pdf:
                pages.savefig(page.figure)
            files += save(page.figure, folder, name)
    return files + ([pdf] if pdf and files else []), lost
