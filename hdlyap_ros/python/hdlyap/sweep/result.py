"""Bags -> a printed table and the files sweep.txt, sweep.csv, sweep.png and sweep.svg."""

import os

from hdlyap import whole
from hdlyap.plots.figures.style import ours, save

from . import figure, points, table

NAME = 'sweep'


def write(paths, folder=None, choice=(None, None)):
    """Prints the table of these bags; writes files if a folder is given. choice: of fits, see
    data.fits.chosen. Returns a line for each bag that cannot be used."""
    found, wrong = points.read(paths, choice)
    if not found:
        return wrong
    lines = '\n'.join(table.text(found))
    print('\n' + lines, flush=True)
    if not folder:
        return wrong
    made = [os.path.join(folder, f'{NAME}.{ending}') for ending in ('txt', 'csv')]
    whole.write(made[0], lines + '\n')
    table.csv(found, made[1])
    with ours():
        page = figure.draw(found)
        made += save(page.figure, folder, NAME) if page else []
    print('written: ' + ', '.join(made), flush=True)
    return wrong
