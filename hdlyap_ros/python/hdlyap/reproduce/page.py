"""What the parts have found -> results: the figures, small CSV files, and one page of text."""

import os
import traceback

from hdlyap.plots.figures.style import STYLE, plt, save
from hdlyap.plots.numbers import clock
from hdlyap.plots.progress import Progress

from hdlyap.runs import files
from hdlyap.runs.bag import Bag

from . import parts, row

DPI = 130  # of PNG files small enough to be kept
COLUMNS = ('quantity', 'published', 'measured', 'unit', 'verdict', 'remark')


def contents(chosen, runs):
    """The parts and the runs that they need, as text."""
    lines = []
    for number, part in chosen:
        names = ' '.join(part.runs(runs))
        lines += [f'{number:2d}  {part.TITLE}', f'    {names}']
    return '\n'.join(lines)


def write(chosen, runs, folder, commit, command, failed=None):
    """Draws and writes all that the bags in the folder allow, below folder/results; the text of the
    page. failed: takes a line for each part that could not be drawn though its runs are there."""
    results = os.path.join(folder, 'results')
    os.makedirs(results, exist_ok=True)
    bags = {name: Bag(run.bag(folder)) for name, run in runs.items() if run.done(folder)}
    blocks, rows, missing = [_head(commit, command)], [], []
    with plt.rc_context(STYLE):
        for number, part in Progress('drawing').over(chosen, len(chosen)):
            try:
                found = _part(number, part, runs, bags, results)
            except _Absent as error:
                missing.append(f'part {number}: not drawn, {error}')
                continue
            except (
                Exception
            ) as error:  # whatever it is: the other parts' results are not lost with it
                missing.append(
                    f'part {number}: {type(error).__name__}: {error}; '
                    f'more in {_trace(folder, number)}'
                )
                if failed is not None:
                    failed.append(missing[-1])
                continue
            rows += found
            blocks.append(_block(number, part, found))
    blocks += ['\n'.join(missing)] if missing else []
    blocks.append(_verdicts(rows))
    blocks.append(_times(chosen, runs, folder))
    which = _which(chosen)
    files.write_csv(
        os.path.join(results, f'rows{which}.csv'), row.HEADER, [one.values() for one in rows]
    )
    text = '\n\n'.join(blocks) + '\n'
    files.write(os.path.join(results, f'results{which}.txt'), text)
    return text + f'\nresults are in {results}'


class _Absent(Exception):
    """Runs that are."""


def _which(chosen):
    """Of some of the parts alone, so that the page of all of them stays: _03_08."""
    numbers = [number for number, _ in chosen]
    return (
        '' if len(numbers) >= len(parts.PARTS) else ''.join(f'_{number:02d}' for number in numbers)
    )


def _trace(folder, number):
    path = os.path.join(folder, 'log', f'part_{number:02d}.log')
    os.makedirs(os.path.dirname(path), exist_ok=True)
    files.write(path, traceback.format_exc())
    return path


def _part(number, part, runs, bags, results):
    """Its rows; its figures and tables are written."""
    absent = [name for name in part.runs(runs) if name not in bags]
    if absent:
        raise _Absent(
            f'the runs {", ".join(absent)} are missing'
            if absent[1:]
            else f'the run {absent[0]} is missing'
        )
    for name, figure in part.figures(bags):
        save(figure, results, f'{number:02d}_{name}', DPI)
    for name, header, lines in part.tables(bags):
        files.write_csv(os.path.join(results, f'{number:02d}_{name}.csv'), header, lines)
    found = list(part.rows(bags))
    for one in found:
        one.part = number
    return found


def _head(commit, command):
    made = ' '.join(['launch/reproduce.sh', *command, *(['at commit', commit] if commit else [])])
    return (
        'Eckmann, Forster, Posch, Zabey, Lyapunov modes in hard-disk systems, '
        'J. Stat. Phys. 118, 813 (2005): published and measured.\n'
        f'Made by {made}. In brackets: standard errors of the last digits; +-: what the paper '
        'leaves open.\n'
        f'A row agrees if the numbers are apart by no more than that and {row.SIGMAS:g} standard '
        'errors;\n'
        f'it is known too poorly where so many exceed both what the paper leaves open and '
        f'{row.TELLING:.0%} of the number, or what the row says is enough.'
    )


def _block(number, part, rows):
    cells = [COLUMNS] + [one.cells() for one in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(COLUMNS) - 1)]
    lines = [
        '  '
        + '  '.join([*(f'{cell:<{width}}' for cell, width in zip(line, widths)), line[-1]]).rstrip()
        for line in cells
    ]
    return '\n'.join([f'{number}. {part.TITLE}', *(lines if rows else [])])


def _verdicts(rows):
    given = [one.verdict for one in rows if one.published is not None]
    counts = [
        (given.count(verdict), text)
        for verdict, text in (
            (row.AGREES, 'agree'),
            (row.DIFFERS, 'differ'),
            (row.POOR, row.POOR),
            (row.MISSING, row.MISSING),
        )
    ]
    return 'of the rows with a published number ' + ', '.join(
        f'{count} {text}' for count, text in counts
    )


def _times(chosen, runs, folder):
    """Where the time went."""
    lines, total = [], 0.0
    for name in _needed(chosen, runs):
        noted = runs[name].done(folder)
        if noted:
            total += noted['seconds']
            marks = ['all cores'] * runs[name].is_wide + ['elsewhere'] * noted.get(
                'elsewhere', False
            )
            made = [f'at {noted["commit"]}'] if noted.get('commit') else []
            time = f'  {name:<28} {clock(noted["seconds"]):>9}'
            lines.append('  '.join([time, f'{", ".join(marks):<9}', *made]).rstrip())
    return '\n'.join(['wall time of the runs'] + lines + [f'  {"sum":<28} {clock(total):>9}'])


def _needed(chosen, runs):
    return [name for name in runs if any(name in part.runs(runs) for _, part in chosen)]
