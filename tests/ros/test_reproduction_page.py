"""The page of the reproduction: counts, figures and tables, what is missing, parts that fail."""
# Second tier: tests/run.sh --all

import contextlib
import io
import os
import tempfile
import unittest
from unittest import mock

import made
import reproduced  # noqa: F401, finds the study
from hdlyap.msg import RunStatus
from hdlyap.plots.figures import plt
from study import bags, files, page, parts
from study.row import Claim, Row


class Part:
    TITLE = 'a part'

    def __init__(self, name):
        self.name = name

    def runs(self, plan):
        return [self.name]

    def claims(self, bags):
        rows = [Row('disks', 20, bags[self.name].info.disks), Row('seed', None, None)]
        yield Claim('it is small', rows, 'the same')
        yield Claim('more', [Row('seed', None, 1)])

    def figures(self, bags):
        yield self.name, plt.figure(figsize=(1, 1))

    def tables(self, bags):
        yield self.name, ('a', 'b'), [(1, 'x,y')]


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, progress in (('one', 1.0), ('two', 1.0), ('three', 0.9)):
            last = made.status(150.0, stage=RunStatus.FINISHED, progress=progress)
            made.write(self.path(name + '.bag'), [made.run_info(), made.status(120.0), last])
        self.parts = [
            (number, Part(name)) for number, name in enumerate(('one', 'two', 'three'), 1)
        ]

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, chosen):
        found = bags.found(self.folder, ['one', 'two', 'three', 'four'])
        with mock.patch.object(parts, 'PARTS', [part for _, part in self.parts]):
            return page.write(chosen, found, self.path('results'))

    def listed(self):
        return sorted(os.listdir(self.path('results')))

    def read(self, name):
        with open(self.path('results', name)) as file:
            return file.read()

    def test_all(self):
        text, failed = self.write(self.parts)
        self.assertEqual(failed, [])
        self.assertIn(
            '\n1. a part\n'
            '             published  measured  unit  verdict       caught     remark\n'
            '  agrees: it is small (1 value; criterion, ours: the same)\n'
            '      disks  20         20              agrees        any other\n'
            '      seed   -          -               not measured\n'
            '  beside: more\n'
            '      seed   -          1\n',
            text,
        )
        self.assertIn('\npart 3: not drawn, missing: three\n', text)  # its bag has no end
        self.assertIn('\nOf 2 claims 2 agree, 0 differ, 0 are not decided, ', text)
        names = [
            f'{number}.{kind}' for number in ('01_one', '02_two') for kind in ('csv', 'png', 'svg')
        ]
        self.assertEqual(self.listed(), [*names, 'results.txt', 'rows.csv'])
        self.assertEqual(self.read('results.txt'), text)
        self.assertEqual(self.read('01_one.csv'), 'a,b\n1,"x,y"\n')
        self.assertEqual(
            self.read('rows.csv').splitlines()[1:4:2],
            [
                '1,it is small,the same,ours,agrees,disks,20,,20,,,agrees,any other,',
                '1,more,,,,seed,,,1,,,,,',
            ],
        )

    def test_some(self):
        """The page of all parts stays."""
        self.write(self.parts)
        before = self.read('results.txt')
        self.write(self.parts[1:])
        self.assertIn('results_02_03.txt', self.listed())
        self.assertEqual(self.read('results.txt'), before)

    def test_failure(self):
        """Of a part: the others are there; what was there stays."""
        self.write(self.parts)
        before, said = self.read('01_one.csv'), io.StringIO()
        with mock.patch.object(self.parts[0][1], 'tables', side_effect=KeyError('x')):
            with contextlib.redirect_stderr(said):
                text, failed = self.write(self.parts)
        self.assertEqual(failed, ["part 1: KeyError: 'x'"])
        self.assertIn(failed[0], text)
        self.assertIn('\n2. a part\n', text)
        self.assertIn('Traceback', said.getvalue())
        self.assertEqual(self.read('01_one.csv'), before)

    def test_files_are_whole(self):
        path = self.path('x.txt')
        files.write(path, 'good')
        with mock.patch('os.replace', side_effect=OSError), self.assertRaises(OSError):
            files.write(path, 'bad')
        with open(path) as file:
            self.assertEqual(file.read(), 'good')


if __name__ == '__main__':
    unittest.main()
