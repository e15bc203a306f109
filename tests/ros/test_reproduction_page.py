"""The page of the reproduction: counts, figures and tables, what is missing, parts that fail."""
# Second tier: tests/run.sh --all

import contextlib
import io
import os
import re
import tempfile
import unittest
from unittest import mock

import matplotlib.pyplot as plt

import made
from hdlyap.msg import RunStatus
from reproduced import FRONT as FRONT_PAGE, PARTS, info_of, plan
import tables
from study import bags, page, table
from study.row import HEADER, Claim, Row

FRONT = [
    {'says': 'all are small', 'claims': ['it is small']},
    {'says': 'all are large', 'claims': ['it is large']},
    {'says': 'none is wide', 'claims': ['it is wide']},
]
SHOWN = [
    'panel,curve,x,y,error',
    '1,"x,y",1,3,0.5',
    '1,"x,y",2,4,',
    '1,curve 2,0,1.5,',
    '2,b,1,2,0.25',
]


class Part:
    """Of a table."""

    def __init__(self, number, name):
        self.number, self.title, self.runs = number, 'a part', [name]

    def claims(self, bags):
        (name,) = self.runs
        rows = [Row('number', 20, bags[name].info.number), Row('seed', None, None)]
        usual = {'criterion': 'the same', 'of': 'ours', 'kind': 'the paper'}
        own = {'kind': 'ours', 'claim': f'it is large, {name}'}
        return [
            Claim(self.number, {**usual, 'claim': f'it is small, {name}'}, rows),
            Claim(self.number, {**usual, **own}, [Row('vectors', 5, 4)]),
            Claim(self.number, {'claim': 'more', 'kind': 'beside'}, [Row('seed', None, 1)]),
        ]

    def figures(self, bags):
        figure, (left, right) = plt.subplots(1, 2, figsize=(1, 1))
        left.errorbar([1, 2], [3, 4], [0.5, 0], fmt='o', label='x,y')
        left.plot([0], [1.5])
        right.bar([1], [2], yerr=[0.25], label='b')
        yield self.runs[0], figure


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, progress in (('one', 1.0), ('two', 1.0), ('three', 0.9)):
            last = made.status(150.0, stage=RunStatus.FINISHED, progress=progress)
            made.write(self.path(name + '.bag'), [made.run_info(), made.status(120.0), last])
        self.parts = [Part(number, name) for number, name in enumerate(('one', 'two', 'three'), 1)]

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, chosen, suffix=''):
        found = bags.found(self.folder, ['one', 'two', 'three', 'four'])
        return page.write(chosen, FRONT, found, self.path('results'), suffix)

    def read(self, name):
        with open(self.path('results', name)) as file:
            return file.read()

    def test_all(self):
        text, failed = self.write(self.parts)
        self.assertEqual(failed, [])
        self.assertIn(
            '\n1. a part\n'
            '               published  measured  unit  verdict       caught     remark\n'
            '  agrees: it is small, one (1 value; criterion, ours: the same)\n'
            '      number   20         20              agrees        any other\n'
            '      seed     -          -               not measured\n'
            '  differs: it is large, one (1 value; criterion, ours: the same)\n'
            '      vectors  5          4               differs       any other\n'
            '  beside: more\n'
            '      seed     -          1\n',
            text,
        )
        self.assertIn('\npart 3: not drawn, missing: three\n', text)  # its bag has no end
        names = [
            f'{name}.{kind}' for name in ('01_one', '02_two') for kind in ('csv', 'png', 'svg')
        ]
        listed = sorted(os.listdir(self.path('results')))
        self.assertEqual(listed, [*names, 'results.txt', 'rows.csv'])
        self.assertEqual(self.read('results.txt'), text)
        self.assertEqual(self.read('01_one.csv').splitlines(), SHOWN)
        lines = self.read('rows.csv').splitlines()
        self.assertEqual(lines[0], ','.join(HEADER))
        words = '1,the paper,,,"it is small, one",the same,ours,agrees,'
        first = words + 'number,20,,20,,,agrees,any other,'
        self.assertEqual([lines[1], lines[4]], [first, '1,beside,,,more,,,,seed,,,1,,,,,'])

    def test_two_counts_and_what_holds(self):
        text, _ = self.write(self.parts)
        for line in (
            'Of 2 statements of the paper 2 agree, 0 differ, 0 are not decided, '
            '0 are not measured; 2 measured values are behind them.',
            '  part  1  differs         1  it is large, one',
            'yes: all are small',
            'not all: all are large (differs: it is large, one; differs: it is large, two)',
            'not measured: none is wide',
        ):
            self.assertIn(f'\n{line}\n', text)

    def test_some(self):
        """The page of all parts stays."""
        self.write(self.parts)
        before = self.read('results.txt')
        self.write(self.parts[1:], '_02_03')
        self.assertIn('2. a part', self.read('results_02_03.txt'))
        self.assertEqual(self.read('results.txt'), before)

    def test_failure(self):
        """Of a part: the others are there; what was there stays."""
        self.write(self.parts)
        before, said = self.read('01_one.csv'), io.StringIO()
        with mock.patch.object(self.parts[0], 'claims', side_effect=KeyError('x')):
            with contextlib.redirect_stderr(said):
                text, failed = self.write(self.parts)
        self.assertEqual(failed, ["part 1: KeyError: 'x'"])
        self.assertIn(failed[0], text)
        self.assertIn('\n2. a part\n', text)
        self.assertIn('Traceback', said.getvalue())
        self.assertEqual(self.read('01_one.csv'), before)


class Document(unittest.TestCase):
    """doc/reproduction.md has the numbers of rows.csv."""

    def test_tables_of_the_page(self):
        with open(tables.PAGE) as file:
            text = file.read()
        self.assertEqual(text, tables.written(text, tables.claims(), FRONT_PAGE))

    def test_a_line(self):
        usual = dict.fromkeys(HEADER, '')
        usual.update(part='3', kind='ours', claim='so', criterion='3 %', criterion_of='ours')
        names = 'published', 'measured', 'error', 'claim_verdict', 'caught'
        paper = dict(usual, claim_verdict='agrees', criterion_of='the paper')
        self.assertEqual(tables._line([paper])[:28], '| 3 | so | 3 % (the paper) |')
        seven = [('2', f'{2 + off}', '0.01', 'agrees', f'{9 + off} %') for off in range(7)]
        apart = [('4', '8', '0.01', 'agrees', '9 %'), *seven]
        rough = [('1', '2', '', 'agrees', caught) for caught in ('9 %', 'any other')]
        ends = '2.000(10) of 2 to 8.000(10) of 2 | 9 to 15 %'
        for values, part, cells in (
            ([('1.0', '1.01', '0.002', 'agrees', '3 %')], '3', '1.0100(20) | 3 %'),
            ([('1', '2', '', 'differs', 'any other')], '3 **differs**', '2 | any other'),
            ([('a', 'a', '', 'agrees', 'any other')] * 2, '3', 'the same | any other'),
            (seven, '3', '7 values, 2.000(10) to 8.000(10) | 9 to 15 %'),
            (apart, '3', f'8 values, {ends}'),
            (rough, '3', '2 | any other to 9 %'),
        ):
            said = tables._line([dict(usual, **dict(zip(names, one))) for one in values])
            self.assertEqual(said, f'| {part} | so | 3 % | {cells} |')

    def test_counts(self):
        given = ['agrees', 'agrees', 'differs', 'not decided']
        said = tables._counts([[{'claim_verdict': verdict}] for verdict in given])
        self.assertEqual(said, '**Of 4 statements 2 agree, 1 differs, 1 is not decided.**')


class Table(unittest.TestCase):
    def test_every_statement_says_what_it_is_judged_by(self):
        for part in PARTS:
            for one in part.entries:
                self.assertTrue(callable(table.function(table.flat(one['measure'])[0])))
                if one['kind'] != table.BESIDE:
                    self.assertIn(one['of'], ('the paper', 'inferred from the paper', 'ours'))
                if one['kind'] == table.STATEMENT:
                    self.assertTrue(one['where'] and one['words'], one['claim'])
        names = [one['claim'] for part in PARTS for one in part.entries]
        self.assertEqual(len(names), len(set(names)))

    def test_the_front_is_about_statements_of_the_paper(self):
        entries = [one for part in PARTS for one in part.entries if one['kind'] == table.STATEMENT]
        for sentence in FRONT_PAGE:
            for start in sentence['claims']:
                self.assertTrue(any(one['claim'].startswith(start) for one in entries), start)

    def test_the_front_says_how_exactly_a_statement_holds(self):
        """What its criteria leave open is in the sentence."""
        entries = [one for part in PARTS for one in part.entries]
        for sentence in FRONT_PAGE:
            of = [one for one in entries if one['claim'].startswith(tuple(sentence['claims']))]
            criteria = ' '.join(one.get('criterion', '') for one in of)
            for bound in re.findall(r'within [\d.]+ %|within our errors', criteria):
                self.assertIn(bound, sentence['says'])

    def test_every_run_is_planned_and_needed(self):
        self.assertEqual(set(table.runs_of(PARTS)), set(plan()))

    def test_wave_numbers_of_the_aspect_ratios(self):
        """All 0.2, within what the rounding of N moves: k falls as N^-1/2."""
        for name in plan():
            if name.startswith('aspect_'):
                info, nodes = info_of(name), (1, int(name.endswith('walls_t')))
                k = made.wave_number(info, *nodes)
                self.assertAlmostEqual(k / 0.2, 1, delta=0.5 / info.number)


if __name__ == '__main__':
    unittest.main()
