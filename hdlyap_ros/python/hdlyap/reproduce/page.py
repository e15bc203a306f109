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
COLUMNS = ('', 'published', 'measured', 'unit', 'verdict', 'caught', 'remark')
VERDICTS = {
    row.AGREES: 'agree',
    row.DIFFERS: 'differ',
    row.UNDECIDED: 'are not decided',
    row.MISSING: 'are not measured',
}


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
    blocks, claims, missing = [], [], []
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
            claims += found
            blocks.append(_block(number, part, found))
    blocks += ['\n'.join(missing)] if missing else []
    blocks.append(_times(chosen, runs, folder))
    which = _which(chosen)
    lines = [line for one in claims for line in one.lines()]
    files.write_csv(os.path.join(results, f'rows{which}.csv'), row.HEADER, lines)
    text = '\n\n'.join([_head(commit, command), _verdicts(claims), *blocks]) + '\n'
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
    """Its claims; its figures and tables are written."""
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
    found = list(part.claims(bags))
    for one in found:
        one.part = number
    return found


def _head(commit, command):
    made = ' '.join(['launch/reproduce.sh', *command, *(['at commit', commit] if commit else [])])
    return (
        'Eckmann, Forster, Posch, Zabey, Lyapunov modes in hard-disk systems, '
        'J. Stat. Phys. 118, 813 (2005): published and measured.\n'
        f'Made by {made}. In brackets: standard errors of the last digits, from blocks of time '
        'unless a remark says from what; +-: what the criterion leaves open.\n'
        'A value agrees if published and measured number are apart by no more than that and '
        f'{row.SIGMAS:g} standard errors. Caught: the smallest\n'
        'deviation of the truth from what is published that would have made it differ, seen at '
        f'{row.SEEN:g} sigma (what is left open and {row.SIGMAS + row.SEEN:g}\n'
        f'standard errors). Where that is more than {row.TELLING:.0%} of the number, or than the '
        'value says is enough, it is not decided.\n'
        'A claim differs if one of its values does, and agrees if all of them do. Beside: without '
        'a claim.'
    )


def _block(number, part, claims):
    """Under each claim its values."""
    cells = [COLUMNS] + [one.cells() for claim in claims for one in claim.rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(COLUMNS) - 1)]

    def line(cells):
        padded = (f'{cell:<{width}}' for cell, width in zip(cells, widths))
        return '      ' + '  '.join([*padded, cells[-1]]).rstrip()

    lines = [line(COLUMNS)] if claims else []
    for claim in claims:
        lines += ['  ' + claim.heading, *(line(one.cells()) for one in claim.rows)]
    return '\n'.join([f'{number}. {part.TITLE}', *lines])


def _verdicts(claims):
    """How many of them, and which."""
    judged = [one for one in claims if one.judged]
    given = [one.verdict for one in judged]
    counts = ', '.join(f'{given.count(verdict)} {text}' for verdict, text in VERDICTS.items())
    values = sum(one.values for one in judged)
    lines = [
        f'  part {one.part:>2}  {one.verdict:<12}  {one.values:>3}  {one.name}' for one in judged
    ]
    said = f'Of {len(judged)} claims {counts}; {values} measured values are behind them.'
    sources = [one.criterion_of for one in judged]
    whose = ', '.join(f'{source}: {sources.count(source)}' for source in row.SOURCES)
    return '\n'.join([said, f'Where their criteria come from: {whose}.', *lines])


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
