"""Rows and claims of the reproduction: verdicts, and what wrong value would have been caught."""
# Second tier: tests/run.sh --all

import math
import unittest

import numpy as np

import made  # noqa: F401, finds the scripts
import reproduced  # noqa: F401, finds the study
from study import row
from study.row import ABOVE, BELOW, Claim, Row, Scatter

TRIALS = 20000
# of a share of so many trials, five standard errors
TREMBLE = 5 * math.sqrt(0.023 * 0.977 / TRIALS)


class Rows(unittest.TestCase):
    def test_beside_a_number(self):
        nan = float('nan')
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
            ((1.0, 0.03), (1.04, nan), 'differs'),
            ((1.0, 0.03), (1.04, float('inf')), 'differs'),
            ((1558, 0), (1558, 0), 'agrees'),
            ((1558, 0), (1557, 0), 'differs'),
            (('a', 0), ('a', 0), 'agrees'),
            (('a', 0), ('b', 0), 'differs'),
            ((1.0, 0), (None, 0), 'not measured'),
            ((1.0, 0), (nan, 0.1), 'not measured'),
            ((None, 0), (1.0, 0.1), ''),
            ((None, 0), (None, 0), 'not measured'),
        ):
            with self.subTest(published=published, measured=measured):
                one = Row('q', published[0], *measured, left_open=published[1])
                self.assertEqual(one.verdict, verdict)
                self.assertEqual((one.cells()[4], one.values()[6]), (verdict, verdict))

    def test_telling(self):
        for error, verdict in ((0.09, 'agrees'), (0.11, 'not decided')):
            self.assertEqual(
                Row('q', 0.0, 0.1, error, left_open=0.05, telling=0.5).verdict, verdict
            )

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
                self.assertEqual(one.verdict, verdict)
                self.assertEqual(one.cells()[1], f'{sense}2')
                self.assertEqual(one.values()[1], f'{sense}2')

    def test_power(self):
        """A truth that is off by the power is seen in 97.7 % of all trials; one half as far beyond
        what is open, in few."""
        rng = np.random.default_rng(1)
        one = Row('q', 10.0, 10.0, 0.1, left_open=0.3)
        self.assertAlmostEqual(one.power, 0.8)
        self.assertEqual(one.caught, '8 %')

        def seen(off):
            trials = (
                Row('q', 10.0, value, 0.1, left_open=0.3)
                for value in rng.normal(10 + off, 0.1, TRIALS)
            )
            return np.mean([trial.verdict == 'differs' for trial in trials])

        self.assertAlmostEqual(seen(0.8), 0.977, delta=0.001 + TREMBLE)
        self.assertLess(seen(0.55), 0.4)

    def test_caught(self):
        for one, said in (
            (Row('q', 0.0, 0.1, 0.2, 'mm', left_open=0.5), '1.5 mm'),
            (Row('q', 4, 4), 'any other'),
            (Row('q', 'a', 'a', caught='5 %'), '5 %'),
            (Row('q', 1.0, 1.1, 0.02, unit='mm', sense=ABOVE), '0.1 mm'),
            (Row('q', 1.0, 1.0, -1.0), 'not known'),
            (Row('q', None, 1.0), ''),
            (Row('q', 1.0, None), ''),
        ):
            self.assertEqual(one.caught, said)

    def test_cells(self):
        self.assertEqual(
            Row('c', 3.285, 3.2316, 0.0043, 'sigma', 'why', left_open=0.09855).cells(),
            ('c', '3.285 +-0.099', '3.2316(43)', 'sigma', 'agrees', '3.7 %', 'why'),
        )
        self.assertEqual(Row('n', 1558, 1557).cells()[1:3], ('1558', '1557'))
        self.assertEqual(Row('k', 1.6, None).cells()[1:3], ('1.6', '-'))
        self.assertEqual(Row('k', None, float('inf'), 1.0).cells()[1:3], ('-', '-'))

    def test_values(self):
        one = Row('c', 3.285, 3.23164567, 0.0043, 'sigma', 'why', left_open=0.0985)
        self.assertEqual(
            dict(zip(row.HEADER[8:], one.values())),
            dict(
                quantity='c',
                published='3.285',
                left_open='0.0985',
                measured='3.231646',
                error='0.0043',
                unit='sigma',
                verdict='agrees',
                caught='3.7 %',
                remark='why',
            ),
        )
        self.assertEqual(Row('n', 'x', float('nan'), -1.0).values()[1:5], ('x', '', '', ''))
        self.assertEqual(Row('n', 4, 0.5, -1.0).values()[1:5], ('4', '', '0.5', ''))


class Scatters(unittest.TestCase):
    def test_critical(self):
        """Of two degrees of freedom chi^2 is exponential; Wilson and Hilferty are right to 3 %."""
        self.assertAlmostEqual(row.critical(2) / (-2 * math.log(0.00135)), 1.0, delta=0.03)
        rng = np.random.default_rng(2)
        for freedom in (1, 4, 10):
            beyond = np.mean(rng.chisquare(freedom, 10 * TRIALS) > row.critical(freedom))
            self.assertAlmostEqual(beyond, 0.00135, delta=0.0005)

    def test_verdicts(self):
        for chi2, errors, verdict in (
            (1.0, [0.1] * 4, 'agrees'),
            (17.0, [0.1] * 4, 'differs'),
            (1.0, [0.1, 0.1, 0.1, 0.5], 'not decided'),
            (17.0, [0.5] * 4, 'differs'),
            (None, [], 'not measured'),
        ):
            one = Scatter('q', chi2, 3 if errors else 0, errors, telling=3.0)
            self.assertEqual((one.verdict, one.count), (verdict, len(errors)))
        self.assertEqual(
            Scatter('q', 43.21, 3, [0.1] * 4, telling=3.0).cells()[:6],
            ('q', 'below 15.9', '43.2 for 3', 'chi^2', 'differs', '0.67 % of one'),
        )

    def test_power(self):
        """One of four values that is off by it is seen in 97.7 % of all trials."""
        one = Scatter('q', 1.0, 3, [0.2] * 4, telling=3.0)
        values = np.random.default_rng(3).normal(0, 0.2, (TRIALS, 4))
        values[:, 0] += one.power
        chi2 = np.sum((values - values.mean(axis=1, keepdims=True)) ** 2, axis=1) / 0.2**2
        self.assertAlmostEqual(np.mean(chi2 > row.critical(3)), 0.977, delta=0.005 + TREMBLE)


class Claims(unittest.TestCase):
    GIVEN = {
        'agrees': Row('a', 1, 1),
        'differs': Row('d', 1, 2),
        'not decided': Row('u', 1.0, 1.0, 1.0),
        'not measured': Row('m', 1),
        '': Row('s', None, 1),
    }

    def test_verdicts(self):
        for verdicts, together, any_of in (
            ('agrees', 'agrees', 'agrees'),
            ('agrees,not measured,', 'agrees', 'agrees'),
            ('agrees,not decided', 'not decided', 'agrees'),
            ('agrees,not decided,differs', 'differs', 'agrees'),
            ('differs,not decided', 'differs', 'not decided'),
            ('differs,not measured', 'differs', 'differs'),
            ('not measured', 'not measured', 'not measured'),
            ('', '', ''),
        ):
            rows = [self.GIVEN[verdict] for verdict in verdicts.split(',')]
            self.assertEqual(claim(rows).verdict, together)
            self.assertEqual(claim(rows, any=True).verdict, any_of)

    def test_values(self):
        """Of what was measured and is judged; of a chi^2 all that are in it."""
        rows = [*self.GIVEN.values(), Scatter('q', 1.0, 3, [0.1] * 4, telling=3.0)]
        self.assertEqual(claim(rows).values, 3 + 4)
        self.assertEqual(claim([Row('q', 1, 1, count=0), Row('q', 1, 1, count=5)]).values, 5)

    def test_text(self):
        one = claim([Row('q', 4, 4, remark='why')], part=3)
        said = 'agrees: so (1 value; criterion, inferred from the paper: the same)'
        self.assertEqual(one.heading, said)
        (line,) = one.lines()
        about = dict(zip(row.HEADER, line))
        self.assertEqual(
            [about[name] for name in ('part', 'kind', 'where', 'words', 'claim', 'criterion')],
            [3, 'the paper', 'a table', 'is so', 'so', 'the same'],
        )
        self.assertEqual(
            line[6:], ('inferred from the paper', 'agrees', 'q', '4', '', 4, *line[12:])
        )
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
        for entry, sense in (({'above': 0.0}, ABOVE), ({'below': 0.0}, BELOW)):
            one = Row('q', None, 1.0, 0.1).judge(entry)
            self.assertEqual((one.published, one.sense), (0.0, sense))
            self.assertEqual(one.verdict, 'agrees' if sense == ABOVE else 'differs')


def claim(rows, part=None, **entry):
    usual = {'kind': 'the paper', 'where': 'a table', 'words': 'is so', 'claim': 'so'}
    criterion = {'criterion': 'the same', 'of': 'inferred from the paper'}
    return Claim(part, {**usual, **criterion, **entry}, rows)


if __name__ == '__main__':
    unittest.main()
