#!/usr/bin/python3
"""rows.csv -> the two tables of doc/reproduction.md and what stands first there, between marks:
tables.py writes them into the page."""

import csv
import os
import re

from study import page, row, table

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE, ROWS = os.path.join(HERE, '../reproduction.md'), os.path.join(HERE, 'rows.csv')
NUMBER = re.compile(r'-?[\d.]+(e[-+]?\d+)?')
MANY = 6  # values that are listed; of more, the smallest and the largest
FROM_PAPER = ' from the paper'  # is not repeated for what is inferred
HEADS = {
    table.STATEMENT: '| part | the paper says (where) | criterion | measured | caught |',
    table.FINDING: '| part | we say | criterion | measured | caught |',
}


def claims(path=ROWS):
    """[lines of each statement], in their order; those that are only shown are none."""
    found = {}
    with open(path) as file:
        for line in csv.DictReader(file):
            if line['claim_verdict']:
                found.setdefault((line['part'], line['claim']), []).append(line)
    return list(found.values())


def written(text, found, front):
    """The page with its tables."""
    parts = {'front': _front(found, front)}
    for name, kind in (('paper', table.STATEMENT), ('ours', table.FINDING)):
        ones = [one for one in found if one[0]['kind'] == kind]
        head = HEADS[kind]
        rule = '|' + '---|' * (head.count('|') - 1)
        parts[name] = '\n'.join([_counts(ones), '', head, rule, *map(_line, ones)])
    for name, inside in parts.items():
        mark = re.compile(f'(<!-- {name} -->\n).*?(<!-- end -->)', re.DOTALL)
        text, count = mark.subn(
            lambda match, inside=inside: f'{match[1]}{inside}\n{match[2]}', text
        )
        assert count == 1, name
    return text


def _front(found, front):
    given = {one[0]['claim']: one[0]['claim_verdict'] for one in found}
    return '\n'.join(f'- {page.sentence(one, given)}' for one in front)


def _counts(ones):
    given = [one[0]['claim_verdict'] for one in ones]
    counts = [_count(given.count(one), one) for one in page.VERDICTS if one in given]
    return f'**Of {len(ones)} statements {", ".join(counts)}.**'


def _count(count, verdict):
    if count > 1:
        return f'{count} {page.VERDICTS[verdict]}'
    return f'1 is {verdict}' if verdict.startswith('not') else f'1 {verdict}'


def _line(lines):
    one = lines[0]
    judged = [line for line in lines if line['published'] and line['verdict'] != row.MISSING]
    says = f'{one["words"]} ({one["where"]})' if one['kind'] == table.STATEMENT else one['claim']
    criterion, of = one['criterion'], one['criterion_of']
    criterion += '' if of == 'ours' else f' ({of.replace(FROM_PAPER, "")})'
    verdict = one['claim_verdict']
    part = one['part'] if verdict == row.AGREES else f'{one["part"]} **{verdict}**'
    caught = _span([line['caught'] for line in judged])
    cells = [part, says, criterion, _measured(judged), caught]
    return '| ' + ' | '.join(cell.replace('|', r'\|') for cell in cells) + ' |'


def _measured(lines):
    if lines and all(line['measured'] == line['published'] for line in lines):
        return 'the same'
    # a value beside a published 0 is a mean over the others, so it is shown only if it is alone
    lines = [line for line in lines if line['published'] != '0'] or lines
    numbers = [_number(line) for line in lines]
    if len(numbers) <= MANY:
        return ', '.join(dict.fromkeys(numbers))
    order = sorted(range(len(lines)), key=lambda at: _off(lines[at]))
    ends = [numbers[at] for at in (order[0], order[-1])]
    if lines[0]['unit'] != 'chi^2' and len({line['published'] for line in lines}) > 1:
        ends = [f'{numbers[at]} of {lines[at]["published"]}' for at in (order[0], order[-1])]
    return f'{len(lines)} values, {ends[0]} to {ends[1]}'


def _off(line):
    """From what is published, as a part of it."""
    try:
        measured, published = float(line['measured']), float(line['published'].split()[-1])
    except ValueError:
        return 0.0
    return measured / published - 1 if published else measured


def _number(line):
    if line['unit'] == 'chi^2':
        return f'{float(line["measured"]):.1f} for {line["published"]}'
    try:
        value, error = float(line['measured']), float(line['error'] or 0)
    except ValueError:
        return line['measured']
    if not line['error']:
        return line['measured']
    unit = ' %' if line['unit'] == '%' else ''
    return (f'{value:.2g}' if not error else row.with_error(value, error)) + unit


def _span(texts):
    """The smallest and the largest of what would have been caught."""
    texts = sorted(set(texts), key=lambda text: float((NUMBER.match(text) or '0')[0]))
    if len(texts) < 2:
        return ''.join(texts)
    first, last = texts[0], texts[-1]
    if NUMBER.sub('', first, 1) == NUMBER.sub('', last, 1):
        first = NUMBER.match(first)[0]
    return f'{first} to {last}'


def main():
    with open(PAGE) as file:
        text = file.read()
    with open(PAGE, 'w') as file:
        file.write(written(text, claims(), table.read()[1]))


if __name__ == '__main__':
    main()
