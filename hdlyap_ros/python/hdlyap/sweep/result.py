"""Bags -> a printed table and the files sweep.txt, sweep.csv, sweep.png and sweep.svg."""

import os

from hdlyap import whole
from hdlyap.data import reader
from hdlyap.plots.figures.style import ours, save

from . import figure, points, table

NAME = 'sweep'


def write_all(paths, folder):
    """As write(), of bags with particles of several kinds: a table and a figure of each kind."""
    kinds, wrong = {}, []
    for path in paths:
        try:
            infos = list(reader.run_infos(path).values())
            kinds.setdefault(infos[-1].particles, []).append(path)
        except reader.RecordingError as error:
            wrong.append(str(error))
    for kind, of_kind in kinds.items():
        name = NAME if len(kinds) == 1 else f'{NAME}_{kind}'
        wrong += write(of_kind, folder, name=name, is_plan=True)
    return wrong


def write(
    paths, folder=None, choice=(None, None), latex=None, paper=None, name=NAME, is_plan=False
):
    """Prints the table of these bags, as text or for LaTeX (a style of plots.latex); writes files
    if a folder is given. choice: of fits, see data.fits.chosen; paper: see figures.page.PAPER.
    Returns a line for each bag that cannot be used."""
    found, wrong = points.read(paths, choice, is_plan)
    if not found:
        return wrong
    lines = '\n'.join(table.latex(found, latex) if latex else table.text(found))
    print(lines if latex else '\n' + lines, flush=True)
    if not folder:
        return wrong
    endings = ('tex' if latex else 'txt'), 'csv'
    made = [os.path.join(folder, f'{name}.{ending}') for ending in endings]
    whole.write(made[0], lines + '\n')
    table.csv(found, made[1])
    how = {'paper': paper} if paper else {}
    with ours(paper):
        page = figure.draw(found, **how)
        made += save(page.figure, folder, name, **how) if page else []
    print('written: ' + ', '.join(made), flush=True)
    return wrong
