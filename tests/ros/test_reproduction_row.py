"""Rows and claims of the reproduction: verdicts, and what wrong value would have been caught; the
page has the numbers of its rows, and the plan the runs of its table."""

import os
import sys
import unittest

import pytest
import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
STUDY = os.path.join(HERE, '../../doc/reproduction')
sys.path.append(STUDY)

import tables  # noqa: E402
from study import row, table  # noqa: E402
from study.row import ABOVE, BELOW, Claim, Row, Scatter  # noqa: E402

pytestmark = pytest.mark.second_tier

NAN, INF = float('nan'), float('inf')


class Rows(unittest.TestCase):
    def test_beside_a_number(self):
        """Published and what is left open, measured with its error."""
        for published, measured, verdict in (
            ((1.0, 0.0), (1.05, 0.0196), 'agrees'),
            ((1.0, 0.0), (1.06, 0.0196), 'differs'),
            ((1.0, 0.0), (1.05, 0.0204), 'not decided'),  # 5 errors are more than a tenth
            ((-1.0, 0.0), (-1.05, 0.0204), 'not decided'),
            ((1.0, 0.0), (9.0, 1.0), 'differs'),
            ((1.0, 0.03), (1.06, 0.0131), 'agrees'),
            ((1.0, 0.03), (0.93, 0.0131), 'differs'),
            ((1.0, 0.03), (1.02, 0.0141), 'not decided'),
            ((1.0, 0.11), (1.0, 0.0), 'not decided'),  # open to more than a tenth
            ((0.0, 0.3), (0.1, 0.059), 'agrees'),
            ((0.0, 0.3), (0.1, 0.061), 'not decided'),
            ((0.0, 0.0), (0.1, 9.0), 'not decided'),
            ((1.0, 0.03), (1.02, -1.0), 'not decided'),  # error not known
            ((1.0, 0.03), (1.04, NAN), 'differs'),
            ((1.0, 0.03), (1.04, INF), 'differs'),
            ((1558, 0), (1557, 0), 'differs'),
            (('a', 0), ('a', 0), 'agrees'),
            (('a', 0), ('b', 0), 'differs'),
            ((1.0, 0), (None, 0), 'not measured'),
            ((1.0, 0), (NAN, 0.1), 'not measured'),
            ((None, 0), (1.0, 0.1), ''),
        ):
            one = Row('q', published[0], *measured, left_open=published[1])
            said = one.verdict, one.cells()[4], one.values()[6]
            self.assertEqual(said, 3 * (verdict,), (published, measured))

    def test_beside_a_limit(self):
        for sense, way in ((ABOVE, 1), (BELOW, -1)):
            for off, error, verdict in (
                (0.31, 0.1, 'agrees'),
                (0.29, 0.1, 'not decided'),
                (-0.29, 0.1, 'not decided'),
                (-0.31, 0.1, 'differs'),
                (0.01, 0.0, 'agrees'),
                (0.31, -1.0, 'not decided'),  # error not known
                (-0.01, 0.0, 'differs'),
            ):
                one = Row('q', 2.0, 2.0 + way * off, error, sense=sense)
                said = one.verdict, one.cells()[1], one.values()[1]
                self.assertEqual(said, (verdict, f'{sense}2', f'{sense}2'), off)

    def test_caught(self):
        for one, said in (
            (Row('q', 10.0, 10.0, 0.1, left_open=0.3), '8 %'),
            (Row('q', 0.0, 0.1, 0.2, 'mm', left_open=0.5), '1.5 mm'),
            (Row('q', 4, 4), 'any other'),
            (Row('q', 'a', 'a', caught='5 %'), '5 %'),
            (Row('q', 1.0, 1.1, 0.02, unit='mm', sense=ABOVE), '0.1 mm'),
            (Row('q', 1.0, 1.0, -1.0), 'not known'),
            (Row('q', None, 1.0), ''),
            (Row('q', 1.0, None), ''),
        ):
            self.assertEqual(one.caught, said)

    def test_as_text(self):
        one = Row('c', 3.285, 3.23164567, 0.0043, 'sigma', 'why', left_open=0.09855)
        told = 'sigma', 'agrees', '3.7 %', 'why'
        self.assertEqual(one.cells(), ('c', '3.285 +-0.099', '3.2316(43)', *told))
        self.assertEqual(one.values(), ('c', '3.285', '0.0985', '3.231646', '0.0043', *told))
        self.assertEqual(Row('n', 1558, 1557).cells()[1:3], ('1558', '1557'))
        self.assertEqual(Row('k', 1.6, None).cells()[1:3], ('1.6', '-'))
        self.assertEqual(Row('k', None, INF, 1.0).cells()[1:3], ('-', '-'))
        self.assertEqual(Row('n', 'x', NAN, -1.0).values()[1:5], ('x', '', '', ''))
        self.assertEqual(Row('n', 4, 0.5, -1.0).values()[1:5], ('4', '', '0.5', ''))

    def test_scatter(self):
        for chi2, errors, verdict in (
            (1.0, [0.1] * 4, 'agrees'),
            (17.0, [0.1] * 4, 'differs'),
            (1.0, [0.1, 0.1, 0.1, 0.5], 'not decided'),
            (17.0, [0.5] * 4, 'differs'),
            (None, [], 'not measured'),
        ):
            one = Scatter('q', chi2, 3 if errors else 0, errors, telling=3.0)
            self.assertEqual((one.verdict, one.count), (verdict, len(errors)))
        one = Scatter('q', 43.21, 3, [0.1] * 4, telling=3.0).cells()[1:6]
        self.assertEqual(one, ('below 15.9', '43.2 for 3', 'chi^2', 'differs', '0.67 % of one'))


class Claims(unittest.TestCase):
    def test_verdicts(self):
        given = {
            'agrees': Row('a', 1, 1),
            'differs': Row('d', 1, 2),
            'not decided': Row('u', 1.0, 1.0, 1.0),
            'not measured': Row('m', 1),
            '': Row('s', None, 1),
        }
        for verdicts, together, any_of, values in (
            ('agrees', 'agrees', 'agrees', 1),
            ('agrees,not measured,', 'agrees', 'agrees', 1),
            ('agrees,not decided', 'not decided', 'agrees', 2),
            ('agrees,not decided,differs', 'differs', 'agrees', 3),
            ('differs,not decided', 'differs', 'not decided', 2),
            ('differs,not measured', 'differs', 'differs', 1),
            ('not measured', 'not measured', 'not measured', 0),
            ('', '', '', 0),
        ):
            rows = [given[verdict] for verdict in verdicts.split(',')]
            found = claim(rows).verdict, claim(rows, any=True).verdict, claim(rows).values
            self.assertEqual(found, (together, any_of, values), verdicts)
        rows = Row('q', 1, 1, count=0), Scatter('q', 1.0, 3, [0.1] * 4)
        self.assertEqual(claim(rows).values, 4)

    def test_text(self):
        one = claim([Row('q', 4, 4, remark='why')], part=3)
        said = 'agrees: so (1 value; criterion, inferred from the paper: the same)'
        self.assertEqual(one.heading, said)
        about = 3, 'the paper', 'a table', 'is so', 'so', 'the same', 'inferred from the paper'
        ((*line,),) = one.lines()
        self.assertEqual(line[:12], [*about, 'agrees', 'q', '4', '', 4])
        self.assertEqual(len(row.HEADER), len(line))
        self.assertEqual(claim([Row('q', None, 1)], claim='more').heading, 'beside: more')

    def test_judged_by_the_table(self):
        """What a row says itself goes first."""
        for entry, more, (left_open, telling) in (
            ({}, {}, (0.0, 0.2)),
            ({'open': 0.5, 'telling': 3.0}, {}, (0.5, 3.0)),
            ({'open': '3 %', 'telling': '100 %'}, {}, (0.06, 2.0)),
            ({'open': '3 %', 'telling': 3.0}, {'left_open': 0.1, 'telling': 4.0}, (0.1, 4.0)),
        ):
            one = Row('q', -2.0, -2.0, **more).judge(entry)
            self.assertAlmostEqual(one.left_open, left_open)
            self.assertAlmostEqual(one.telling, telling)
        for entry, verdict in (({'above': 0.0}, 'agrees'), ({'below': 0.0}, 'differs')):
            self.assertEqual(Row('q', None, 1.0, 0.1).judge(entry).verdict, verdict)


class Page(unittest.TestCase):
    """doc/reproduction.md, of what claims.yaml and runs.yaml say."""

    def test_has_the_numbers_of_its_rows(self):
        with open(tables.PAGE) as file:
            text = file.read()
        self.assertEqual(text, tables.written(text, tables.claims(), table.read()[1]))

    def test_a_line(self):
        usual = dict.fromkeys(row.HEADER, '')
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

    def test_every_run_is_planned_and_needed(self):
        with open(os.path.join(STUDY, 'runs.yaml')) as file:
            self.assertEqual(set(table.runs_of(table.read()[0])), set(yaml.safe_load(file)))


def claim(rows, part=None, **entry):
    usual = {'kind': 'the paper', 'where': 'a table', 'words': 'is so', 'claim': 'so'}
    criterion = {'criterion': 'the same', 'of': 'inferred from the paper'}
    return Claim(part, {**usual, **criterion, **entry}, rows)
