"""What the parts have found -> results: the figures, small CSV files, and one page of text."""

import os
import traceback

from hdlyap.plots.figures.style import STYLE, plt, save

from . import files, parts, row

DPI = 130  # of PNG files small enough to be kept
COLUMNS = ('', 'published', 'measured', 'unit', 'verdict', 'caught', 'remark')
VERDICTS = {
    row.AGREES: 'agree',
    row.DIFFERS: 'differ',
    row.UNDECIDED: 'are not decided',
    row.MISSING: 'are not measured',
}


def write(chosen, bags, results):
    """Draws and writes all that the bags allow; (the text of the page, a line for each part that
    failed)."""
    os.makedirs(results, exist_ok=True)
    blocks, claims, left_out, failed = [], [], [], []
    with plt.rc_context(STYLE):
        for number, part in chosen:
            absent = [name for name in part.runs(bags) if name not in bags]
            if absent:
                left_out.append(f'part {number}: not drawn, missing: {" ".join(absent)}')
                continue
            try:
                found = _part(number, part, bags, results)
            except Exception as error:  # the other parts' results are not lost with it
                traceback.print_exc()
                failed.append(f'part {number}: {type(error).__name__}: {error}')
                continue
            claims += found
            blocks.append(_block(number, part, found))
    which = _which(chosen)
    lines = [line for one in claims for line in one.lines()]
    files.write_csv(os.path.join(results, f'rows{which}.csv'), row.HEADER, lines)
    ends = ['\n'.join(left_out + failed)] if left_out + failed else []
    text = '\n\n'.join([_head(), _verdicts(claims), *blocks, *ends]) + '\n'
    files.write(os.path.join(results, f'results{which}.txt'), text)
    return text, failed


def _which(chosen):
    """Of some of the parts alone, so that the page of all of them stays: _03_08."""
    numbers = [number for number, _ in chosen]
    return (
        '' if len(numbers) >= len(parts.PARTS) else ''.join(f'_{number:02d}' for number in numbers)
    )


def _part(number, part, bags, results):
    """Its claims; its figures and tables are written."""
    for name, figure in part.figures(bags):
        save(figure, results, f'{number:02d}_{name}', DPI)
    for name, header, lines in part.tables(bags):
        files.write_csv(os.path.join(results, f'{number:02d}_{name}.csv'), header, lines)
    found = list(part.claims(bags))
    for one in found:
        one.part = number
    return found


def _head():
    return (
        'Eckmann, Forster, Posch, Zabey, Lyapunov modes in hard-disk systems, '
        'J. Stat. Phys. 118, 813 (2005): published and measured.\n'
        'In brackets: standard errors of the last digits, from blocks of time '
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
