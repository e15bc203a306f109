"""Bags -> a printed table and the files sweep.txt, sweep.csv, sweep.png and sweep.svg."""

import os

from hdlyap import whole
from hdlyap.plots.figures.style import ours, save

from . import figure, points, table

NAME = 'sweep'


def write(paths, folder=None, choice=(None, None), latex=None):
    """Prints the table of these bags, as text or for LaTeX (a style of plots.latex); writes files
    if a folder is given. choice: of fits, see data.fits.chosen. Returns a line for each bag that
    cannot be used."""
    found, wrong = points.read(paths, choice)
    if not found:
        return wrong
    lines = '\n'.join(table.latex(found, latex) if latex else table.text(found))
    print(lines if latex else '\n' + lines, flush=True)
    if not folder:
        return wrong
    endings = ('tex' if latex else 'txt'), 'csv'
    made = [os.path.join(folder, f'{NAME}.{ending}') for ending in endings]
    whole.write(made[0], lines + '\n')
    table.csv(found, made[1])
    with ours():
        page = figure.draw(found)
        made += save(page.figure, folder, NAME) if page else []
    print('written: ' + ', '.join(made), flush=True)
    return wrong
