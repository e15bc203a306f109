"""What the parts have found -> results: the figures, small CSV files, and one page of text."""

import csv
import os

from hdlyap_plots.figures.style import STYLE, plt, save
from hdlyap_plots.numbers import clock
from hdlyap_plots.progress import Progress
from hdlyap_plots.recording import RecordingError

from . import row
from .bag import Bag

COLUMNS = ('quantity', 'published', 'measured', 'unit', 'verdict', 'remark')


def contents(chosen, runs):
    """The parts and the runs that they need, as text."""
    lines = []
    for number, part in chosen:
        names = ' '.join(part.runs(runs))
        lines += [f'{number:2d}  {part.TITLE}', f'    {names}']
    return '\n'.join(lines)


def write(chosen, runs, folder, commit, command):
    """Draws and writes all that the bags in the folder allow, below folder/results; the text of the page."""
    results = os.path.join(folder, 'results')
    os.makedirs(results, exist_ok=True)
    bags = {name: Bag(run.bag(folder)) for name, run in runs.items() if run.done(folder)}
    blocks, rows, missing = [_head(commit, command)], [], []
    with plt.rc_context(STYLE):
        for number, part in Progress('drawing').over(chosen, len(chosen)):
            absent = [name for name in part.runs(runs) if name not in bags]
            if absent:
                missing.append(f'part {number}: not drawn, the runs {", ".join(absent)} are missing')
                continue
            found = _part(number, part, bags, results)
            rows += found
            blocks.append(_block(number, part, found))
    blocks += ['\n'.join(missing)] if missing else []
    blocks.append(_times(chosen, runs, folder))
    _table(os.path.join(results, 'rows.csv'), row.HEADER, [one.values() for one in rows])
    text = '\n\n'.join(blocks) + '\n'
    _replace(os.path.join(results, 'results.txt'), text)
    return text + f'\nresults are in {results}'


def _part(number, part, bags, results):
    """Its rows; its figures and tables are written."""
    for name, figure in part.figures(bags):
        save(figure, results, f'{number:02d}_{name}')
    for name, header, lines in part.tables(bags):
        _table(os.path.join(results, f'{number:02d}_{name}.csv'), header, lines)
    found = list(part.rows(bags))
    for one in found:
        one.part = number
    return found


def _head(commit, command):
    made = f' at commit {commit}' if commit else ''
    return ('Eckmann, Forster, Posch, Zabey, Lyapunov modes in hard-disk systems, J. Stat. Phys. 118, 813 (2005): '
            f'published and measured.\nMade by launch/reproduce.sh {" ".join(command)}{made}. In brackets: standard '
            'errors of the last digits; +-: what the paper leaves open.\nA row agrees if the numbers are apart by no more '
            f'than that and {row.SIGMAS:g} standard errors.')


def _block(number, part, rows):
    cells = [COLUMNS] + [one.cells() for one in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(COLUMNS) - 1)]
    lines = ['  ' + '  '.join([*(f'{cell:<{width}}' for cell, width in zip(line, widths)), line[-1]]).rstrip()
             for line in cells]
    return '\n'.join([f'{number}. {part.TITLE}', *(lines if rows else [])])


def _times(chosen, runs, folder):
    """Where the time went."""
    lines, total = [], 0.0
    for name in _needed(chosen, runs):
        noted = runs[name].done(folder)
        if noted:
            seconds = noted.get('seconds')
            total += seconds or 0.0
            made = f'  at {noted["commit"]}' if noted.get('commit') else ''
            lines.append(f'  {name:<28} {clock(seconds) if seconds else "elsewhere":>9}'
                         f'{"  all cores" if runs[name].is_wide else "":<11}{made}'.rstrip())
    return '\n'.join(['wall time of the runs'] + lines + [f'  {"sum":<28} {clock(total):>9}'])


def _needed(chosen, runs):
    return [name for name in runs if any(name in part.runs(runs) for _, part in chosen)]


def _table(path, header, lines):
    temporary = path + '.new'
    with open(temporary, 'w', newline='') as file:
        csv.writer(file).writerows([header, *lines])
    os.replace(temporary, path)


def _replace(path, text):
    with open(path + '.new', 'w') as file:
        file.write(text)
    os.replace(path + '.new', path)
