"""Recording -> figures, as PNG, SVG and pages of a PDF. Each figure, a module here with an ORDER or
one of its FIGURES, has draw(run, ax=None, **look); see page.figure."""

import contextlib
import importlib
import pkgutil
from collections import namedtuple

from matplotlib.backends.backend_pdf import PdfPages

from hdlyap import whole
from hdlyap.data.reader import NoInfo

from .style import ours, save


def _found():
    """{name: figure}, in the order in which hdlyap plot lists them: a module here with an ORDER, or
    the FIGURES of one. draw returns None if the bag has no data for it."""
    here = [one.name for one in pkgutil.iter_modules(__path__)]
    modules = {name: importlib.import_module(f'.{name}', __name__) for name in here}
    found = [(one.ORDER, name) for name, one in modules.items() if hasattr(one, 'ORDER')]
    figures = (
        getattr(modules[name], 'FIGURES', {name: modules[name]}) for _, name in sorted(found)
    )
    return {name: figure for some in figures for name, figure in some.items()}


FIGURES = _found()
globals().update(FIGURES)  # so that each figure is imported by its name
# figures of several seeds; others are of one run
OF_MEANS = tuple(name for name, one in FIGURES.items() if getattr(one, 'IS_OF_MEANS', False))


Drawn = namedtuple('Drawn', 'files lost left_out captions')


def draw_all(recording, folder, progress, names=tuple(FIGURES), pdf=None, paper=None):
    """Draws each figure for which the recording has data. pdf: a file with all figures; paper: see
    page.PAPER. Returns the names of the files, of figures that need run_info, which it lacks, a
    line for each panel without data, and the captions of figures without titles."""
    made, pages, how = Drawn([], [], [], []), [], {'paper': paper} if paper else {}
    with ours(paper), contextlib.ExitStack() as stack:
        for name in progress.over(names, len(names)):
            try:
                why = []
                page = FIGURES[name].draw(recording, left_out=why, **how)
            except NoInfo:
                made.lost.append(name)
                continue
            made.left_out.extend(f'{name} does not show {line}' for line in why)
            if page is None:
                continue
            if pdf and not pages:
                pages = stack.enter_context(PdfPages(stack.enter_context(whole.written(pdf))))
            if pdf:
                pages.savefig(page.figure)
            made.files.extend(save(page.figure, folder, name, **how))
            made.captions.extend([f'{name}: {page.caption}'] if paper else [])
    made.files.extend([pdf] if pdf and made.files else [])
    return made
