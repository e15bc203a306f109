"""What the parts have found -> results: the figures, small CSV files, and one page of text."""

import csv
import os
import traceback

import matplotlib.pyplot as plt
from hdlyap import whole
from hdlyap.plots.figures.style import ours, save

from . import draw, row, table

DPI = 130  # of PNG files small enough to be kept
COLUMNS = ('', 'published', 'measured', 'unit', 'verdict', 'caught', 'remark')
VERDICTS = {
    row.AGREES: 'agree',
    row.DIFFERS: 'differ',
    row.UNDECIDED: 'are not decided',
    row.MISSING: 'are not measured',
}
WHOSE = {table.STATEMENT: 'statements of the paper', table.FINDING: 'statements of ours'}
ABOUT = f"""Eckmann, Forster, Posch, Zabey, Lyapunov modes in hard-disk systems, J. Stat. Phys. 118,
813 (2005): published and measured. In brackets: standard errors of the last digits, from blocks of
time unless a remark says from what; +-: what the criterion leaves open. A value agrees if published
and measured number are apart by no more than that and {row.SIGMAS:g} standard errors. Caught: the
smallest deviation of the truth from what is published that would have made it differ, seen at
{row.SEEN:g} sigma (what is left open and {row.SIGMAS + row.SEEN:g} standard errors). Where that is
more than {row.TELLING:.0%} of the number, or than the value says is enough, it is not decided. A
statement differs if one of its values does, and agrees if all of them do. Beside: shown alone."""


def write(parts, front, bags, results, suffix=''):
    """Draws and writes all that the bags allow; (the text of the page, a line for each part that
    failed). suffix: of the page and the rows of some of the parts alone, so that those of all stay.
    """
    os.makedirs(results, exist_ok=True)
    blocks, claims, left_out, failed = [], [], [], []
    with ours():
        for part in parts:
            absent = [name for name in part.runs if name not in bags]
            if absent:
                left_out.append(f'part {part.number}: not drawn, missing: {" ".join(absent)}')
                continue
            try:
                found = _part(part, {name: bags[name] for name in part.runs}, results)
            except Exception as error:  # the other parts' results are not lost with it
                traceback.print_exc()
                failed.append(f'part {part.number}: {type(error).__name__}: {error}')
                continue
            claims += found
            blocks.append(_block(part, found))
    lines = [line for one in claims for line in one.lines()]
    _write_csv(os.path.join(results, f'rows{suffix}.csv'), [row.HEADER, *lines])
    ends = ['\n'.join(left_out + failed)] if left_out + failed else []
    text = '\n\n'.join([ABOUT, *summary(claims, front), *blocks, *ends]) + '\n'
    path = os.path.join(results, f'results{suffix}.txt')
    with whole.written(path) as unfinished, open(unfinished, 'w') as file:
        file.write(text)
    return text, failed


def _write_csv(path, lines):
    with whole.written(path) as unfinished, open(unfinished, 'w', newline='') as file:
        csv.writer(file, lineterminator='\n').writerows(lines)


def _part(part, bags, results):
    """Its claims; its figures and the numbers that they show are written."""
    for name, figure in part.figures(bags):
        name = f'{part.number:02d}_{name}'
        shown = list(draw.numbers(figure))
        if shown:
            _write_csv(os.path.join(results, f'{name}.csv'), [draw.SHOWN, *shown])
        save(figure, results, name, DPI)
        plt.close(figure)
    return part.claims(bags)


def summary(claims, front):
    """First what holds, then how many statements do, of the paper and of ours, and which."""
    given = {one.name: one.verdict for one in claims}
    yield '\n'.join(sentence(one, given) for one in front)
    for kind, whose in WHOSE.items():
        ones = [one for one in claims if one.kind == kind and one.judged]
        verdicts = [one.verdict for one in ones]
        counts = ', '.join(f'{verdicts.count(one)} {text}' for one, text in VERDICTS.items())
        values = sum(one.values for one in ones)
        said = f'Of {len(ones)} {whose} {counts}; {values} measured values are behind them.'
        lines = [
            f'  part {one.part:>2}  {one.verdict:<12}  {one.values:>3}  {one.name}' for one in ones
        ]
        yield '\n'.join([said, *lines])


def sentence(one, given):
    """`yes` or what is against it."""
    of = [name for name in given if name.startswith(tuple(one['claims']))]
    off = [f'{given[name]}: {name}' for name in of if given[name] not in (row.AGREES, row.SHOWN)]
    missing = [start for start in one['claims'] if not any(name.startswith(start) for name in of)]
    if missing:
        return f'not measured: {one["says"]}'
    return f'yes: {one["says"]}' if not off else f'not all: {one["says"]} ({"; ".join(off)})'


def _block(part, claims):
    """Under each claim its values."""
    cells = [COLUMNS] + [one.cells() for claim in claims for one in claim.rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(COLUMNS) - 1)]

    def line(cells):
        padded = (f'{cell:<{width}}' for cell, width in zip(cells, widths))
        return '      ' + '  '.join([*padded, cells[-1]]).rstrip()

    lines = [line(COLUMNS)]
    for claim in claims:
        lines += ['  ' + claim.heading, *(line(one.cells()) for one in claim.rows)]
    return '\n'.join([f'{part.number}. {part.title}', *lines])
