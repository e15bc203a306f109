#!/usr/bin/env python3
"""What reproduce is made of, without runs: its options, the plan, bags, rows, the page, the
display. Needs no ROS master."""
# Second tier: tests/run.sh --all

import contextlib
import glob
import io
import os
import signal
import subprocess
import sys
import tempfile
import types
import unittest
from unittest import mock

import yaml

import harness
import made
from terminal import Terminal
from hdlyap.msg import RunStatus
from hdlyap.plots.figures import plt
from hdlyap.reproduce import options, page, parts, plan
from hdlyap.runs.bag import Bag
from hdlyap.reproduce.row import Claim, Row
from hdlyap.runs import display, files, tree, work

ROOT = os.path.realpath(os.path.join(made.SCRIPTS, '../..'))
LAUNCH = os.path.join(ROOT, 'launch')
ENTRY = dict(
    base='quick', duration=7.0, disks=30, full=dict(disks=20), quick=dict(disks=10), seconds=[4, 9]
)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def runs(self, quick=False, **entries):
        with open(self.path('plan.yaml'), 'w') as file:
            yaml.safe_dump(entries, file, sort_keys=False)
        return plan.runs(ROOT, quick, file.name)

    def bag(self, run, stage=RunStatus.FINISHED, progress=1.0, **changed):
        """A made one of the run."""
        info = {
            name: value for name, value in run.parameters.items() if name in made.RunInfo.__slots__
        }
        info.update({'exponents': 'positive', 'interval': 0.0, 'phase_interval': 0.0, **changed})
        last = made.status(150.0, stage=stage, progress=progress)
        made.write(
            run.bag(self.folder),
            [made.run_info(**info), made.status(120.0), made.cost(150.0), last],
        )
        return Bag(run.bag(self.folder))


class Options(unittest.TestCase):
    def refused(self, *arguments):
        """The one line, by the file alone, as reproduce.sh has it looked at."""
        done = subprocess.run(
            [sys.executable, '-S', '-E', options.__file__, *arguments],
            text=True,
            capture_output=True,
        )
        self.assertEqual(
            (done.returncode, done.stdout, done.stderr.count('\n')), (2, '', 1), done.stderr
        )
        return done.stderr

    def test_refused(self):
        here = os.path.abspath(__file__)
        for arguments, what in (
            (['--part', '99'], f"--part: is '99', must be 1 .. {len(parts.PARTS)};"),
            (['--part', '0'], "--part: is '0', must be 1 .. "),
            (['--jobs', '0'], "--jobs: is '0', must be 1 or more;"),
            (['--jobs', '1.5'], "--jobs: is '1.5', must be 1 or more;"),
            (['--out', here], f"--out: is '{here}', but {here} is no folder;"),
            (['--out', here + '/x/y'], f"but {here} is no folder;"),
            (['--out', ''], '--out: is empty, must be a folder;'),
            (['--plan', '/nowhere'], "--plan: is '/nowhere', which is no file;"),
            (['--draw', '--write'], 'not allowed with'),
            (['more'], 'unrecognized arguments: more;'),
            (['--qui'], 'unrecognized arguments: --qui;'),
            (['--out'], 'expected one argument;'),
        ):
            with self.subTest(arguments=arguments):
                said = self.refused(*arguments)
                self.assertIn(what, said)
                self.assertTrue(
                    said.startswith('reproduce: ')
                    and said.endswith('; --help lists the options\n'),
                    said,
                )

    def test_taken(self):
        args = options.parse(['--part', '1', '--part', '1', '--quick'])
        self.assertEqual((args.part, args.out), ([1, 1], os.path.abspath('reproduction_quick')))
        args = options.parse([])
        self.assertEqual((args.part, args.out), (None, os.path.abspath('reproduction')))
        self.assertEqual(args.jobs, len(os.sched_getaffinity(0)))

    def test_every_module_is_a_part(self):
        self.assertEqual(options.PARTS, len(parts.PARTS))


class Plan(Folder):
    def test_parameters(self):
        """Those of the scene, then of the entry, then of quick or full."""
        with open(os.path.join(LAUNCH, 'scenes/quick.yaml')) as file:
            scene = {**plan.usual(), **yaml.safe_load(file)}
        for quick, disks, seconds in ((False, 20, 9), (True, 10, 4)):
            run = self.runs(quick, one=ENTRY)['one']
            self.assertEqual(
                run.parameters,
                {**scene, 'threads': 1, 'duration': 7.0, 'disks': disks, 'scene': 'one'},
            )
            self.assertEqual(
                (run.seconds, run.share_of(2), run.is_wide), (seconds, seconds / 2, False)
            )
            run.write(self.folder)
            with open(self.path('one.yaml')) as file:
                self.assertEqual(yaml.safe_load(file), run.parameters)
        wide = self.runs(one=dict(ENTRY, threads=0))['one']
        self.assertEqual((wide.share_of(2), wide.is_wide), (9, True))

    def test_the_papers(self):
        """Every parameter is one of the node, and every part finds its runs, quick and full."""
        for quick in (True, False):
            runs = plan.runs(ROOT, quick)
            with open(os.path.join(LAUNCH, 'scenes/paper_periodic.yaml')) as file:
                known = set(yaml.safe_load(file))
            for run in runs.values():
                self.assertEqual(set(run.parameters), known, run.name)
                self.assertGreater(run.seconds, 0)
            for part in parts.PARTS:
                self.assertLessEqual(set(part.runs(runs)), set(runs), part.TITLE)

    def test_refused(self):
        for entry, what in (
            (dict(ENTRY, base='nowhere'), r'nowhere\.yaml: No such file'),
            ([], 'one: '),
            (dict(ENTRY, duration=0.0), 'one: duration is 0'),
            (dict(ENTRY, quick=3), 'one: '),
            (dict(ENTRY, seconds=['x', 'y']), 'one: seconds is'),
            (dict(ENTRY, seconds=[0, 1]), 'one: seconds is'),
            (dict(ENTRY, seconds=[1]), 'one: '),
            (dict(ENTRY, warmup='x'), 'one: warmup is x, must be a number'),
            ({}, "one: 'seconds' is missing"),
        ):
            with self.subTest(entry=entry), self.assertRaisesRegex(plan.PlanError, what) as caught:
                self.runs(True, one=entry)
            self.assertNotIn('\n', str(caught.exception))
        with self.assertRaisesRegex(plan.PlanError, 'a/b: a name consists of'):
            self.runs(**{'a/b': ENTRY})
        for text in ('- a\n', 'a: [\n', ''):
            files.write(self.path('p.yaml'), text)
            with self.assertRaisesRegex(plan.PlanError, r'p\.yaml: '):
                plan.runs(ROOT, False, self.path('p.yaml'))

    def test_done(self):
        """Noted of these parameters and of this bag."""
        run = self.runs(one=ENTRY)['one']
        self.assertIsNone(run.done(self.folder))
        self.bag(run)
        self.assertIsNone(run.done(self.folder))
        run.note(self.folder, seconds=3.0)
        self.assertEqual(run.done(self.folder)['seconds'], 3.0)
        self.assertIsNone(self.runs(one=dict(ENTRY, duration=8.0))['one'].done(self.folder))
        noted = os.path.getmtime(run.record(self.folder))
        os.utime(run.bag(self.folder), (noted + 1, noted + 1))  # somebody has written another
        self.assertIsNone(run.done(self.folder))
        os.remove(run.bag(self.folder))
        self.assertIsNone(run.done(self.folder))
        files.write(run.record(self.folder), '[]')
        self.assertEqual(run.noted(self.folder), {})


class Bags(Folder):
    def test_complete(self):
        run = self.runs(one=ENTRY)['one']
        self.assertFalse(Bag(run.bag(self.folder)).is_complete())
        for phase, progress, complete in (
            (RunStatus.FINISHED, 1.0, True),
            (RunStatus.FINISHED, 0.99, False),
            (RunStatus.AVERAGING, 1.0, False),
        ):
            self.assertEqual(self.bag(run, phase, progress).is_complete(), complete)
        with open(run.bag(self.folder), 'r+b') as file:
            file.truncate(6000)
        self.assertFalse(Bag(run.bag(self.folder)).is_complete())

    def test_parameters(self):
        """As they are in run_info; how the run was computed makes no difference."""
        run = self.runs(
            one=dict(ENTRY, observables=['spectrum', 'steps'], duration=7, interval=0.5)
        )['one']
        same = dict(interval=0.5, threads=64, wait_for_subscribers=['spectrum'], resume='kept')
        self.assertTrue(self.bag(run, **same).was_run_with(run.parameters))
        for name, value in dict(
            duration=7.5,
            disks=21,
            seed='2',
            scene='two',
            interval=0.0,
            observables=['steps'],
            boundary_x='reflecting',
            density=0.71,
        ).items():
            self.assertFalse(
                self.bag(run, **{**same, name: value}).was_run_with(run.parameters), name
            )


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


class Page(Folder):
    def setUp(self):
        super().setUp()
        self.plan = self.runs(one=ENTRY, two=dict(ENTRY, threads=0), three=ENTRY)
        for name in ('one', 'two'):
            self.bag(self.plan[name])
            self.plan[name].note(self.folder, seconds=62.0, commit='abc', elsewhere=name == 'two')
        self.parts = [(number, Part(name)) for number, name in enumerate(self.plan, start=1)]

    def write(self, chosen, failed=None):
        with mock.patch.object(parts, 'PARTS', [part for _, part in self.parts]):
            return page.write(chosen, self.plan, self.folder, 'def', ['--quick'], failed)

    def listed(self):
        return sorted(os.listdir(self.path('results')))

    def test_all(self):
        text = self.write(self.parts)
        self.assertIn('Made by launch/reproduce.sh --quick at commit def. ', text)
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
        self.assertIn('\npart 3: not drawn, the run three is missing\n', text)
        self.assertIn(
            '\nOf 2 claims 2 agree, 0 differ, 0 are not decided, 0 are not measured; '
            '2 measured values are behind them.\n'
            'Where their criteria come from: the paper: 0, inferred from the paper: 0, ours: 2.\n'
            '  part  1  agrees          1  it is small\n'
            '  part  2  agrees          1  it is small\n',
            text,
        )
        self.assertRegex(
            text, r'\n  one +1:02 +at abc\n  two +1:02  all cores, elsewhere  at abc\n  sum +2:04\n'
        )
        self.assertEqual(
            self.listed(),
            [
                '01_one.csv',
                '01_one.png',
                '01_one.svg',
                '02_two.csv',
                '02_two.png',
                '02_two.svg',
                'results.txt',
                'rows.csv',
            ],
        )
        self.assertTrue(text.startswith(files.read(self.path('results', 'results.txt'))))
        self.assertEqual(files.read(self.path('results', '01_one.csv')), 'a,b\n1,"x,y"\n')
        self.assertEqual(
            files.read(self.path('results', 'rows.csv')).splitlines()[1:4:2],
            [
                '1,it is small,the same,ours,agrees,disks,20,,20,,,agrees,any other,',
                '1,more,,,,seed,,,1,,,,,',
            ],
        )

    def test_some(self):
        """The page of all parts stays."""
        self.write(self.parts)
        before = files.read(self.path('results', 'results.txt'))
        self.write(self.parts[1:])
        self.assertIn('results_02_03.txt', self.listed())
        self.assertEqual(files.read(self.path('results', 'results.txt')), before)

    def test_failure(self):
        """Of a part: the others are there, and it is said where more is; what was there stays."""
        self.write(self.parts)
        before = files.read(self.path('results', '01_one.csv'))
        failed = []
        with mock.patch.object(self.parts[0][1], 'tables', side_effect=KeyError('x')):
            text = self.write(self.parts, failed)
        self.assertEqual(
            failed, [f"part 1: KeyError: 'x'; more in {self.path('log', 'part_01.log')}"]
        )
        self.assertIn(failed[0], text)
        self.assertIn('\n2. a part\n', text)
        self.assertIn('Traceback', files.read(self.path('log', 'part_01.log')))
        self.assertEqual(files.read(self.path('results', '01_one.csv')), before)

    def test_files_are_whole(self):
        path = self.path('x.txt')
        files.write(path, 'good')
        with mock.patch('os.replace', side_effect=OSError), self.assertRaises(OSError):
            files.write(path, 'bad')
        self.assertEqual(files.read(path), 'good')
        self.assertEqual(glob.glob(path + '*'), [path])


class Shown(unittest.TestCase):
    def job(self, name, share):
        return types.SimpleNamespace(run=types.SimpleNamespace(name=name), share=share)

    def test_lines(self):
        """5 of 8 and so on; the time left by what has passed, and by the plan at first. A line
        every ten seconds."""
        now = [1000.0]
        out, err = io.StringIO(), io.StringIO()
        with mock.patch('time.monotonic', lambda: now[0]), contextlib.redirect_stdout(
            out
        ), contextlib.redirect_stderr(err):
            show = display.Display("reproduce", 8, before=4)
            for seconds, under_way, done in (
                (0, [('a', 0), ('b', 0)], 0),
                (5, [('a', 0.5)], 100),
                (60, [('b', 0.25)], 140),
                (60, [], 200),
            ):
                now[0] += seconds
                show([self.job(*job) for job in under_way], done, 1000.0)
            show.say('c: no')
            now[0] += 3600
            show.end()
        self.assertEqual(
            out.getvalue().splitlines(),
            [
                '4 of 12 runs done  a 0 %  b 0 %  all 0 %, about 16:40 left',  # as planned
                # 860 * (65 + 60) / (140 + 60)
                '5 of 12 runs done  b 25 %  all 14 %, about 8:58 left',
                '6 of 12 runs done  all 20 %, about 9:29 left',  # 800 * (125 + 60) / (200 + 60)
                '5 of 12 runs done, 1 failed in 1:02:05',
            ],
        )
        self.assertEqual(err.getvalue(), 'reproduce: c: no\n')

    def test_terminal(self):
        """One line, as wide as the terminal: the time left stays on it."""
        terminal = Terminal(
            [
                sys.executable,
                '-c',
                '''
from types import SimpleNamespace as Made
from hdlyap.runs import display
show = display.Display("reproduce", 3)
show([Made(run=Made(name=name), share=0.5) for name in ('first', 'second', 'third')], 30.0, 60.0)
''',
            ],
            columns=64,
        )
        self.addCleanup(terminal.stop)
        self.assertEqual(terminal.wait(), 0)
        self.assertTrue(terminal.wait_for('left'))
        self.assertRegex(
            terminal.screen()[0],
            r'^0 of 3 runs done  first 50 %  2 more  all 50 %, about 0:\d\d left$',
        )
        self.assertLess(len(terminal.screen()[0]), 64)


class Trees(unittest.TestCase):
    def test_end(self):
        """Of a command that hears, of one that does not, and of what outlives a command, in a
        session of its own."""
        deaf = 'trap "" INT; sleep 1000 & setsid sleep 1000 & echo; wait'
        trees = [
            tree.Tree(['sleep', '1000']),
            tree.Tree(['sh', '-c', deaf]),
            tree.Tree(['sh', '-c', deaf]),
        ]
        self.assertTrue(
            harness.wait_until(lambda: [len(one._members()) for one in trees] == [1, 3, 3])
        )
        trees[2]._process.kill()
        self.assertTrue(harness.wait_until(trees[2].has_ended))
        self.assertFalse(trees[2].is_gone())
        tree.end(trees, 0.5)
        self.assertTrue(harness.wait_until(lambda: all(one.is_gone() for one in trees)))
        self.assertEqual(
            [one._process.returncode for one in trees],
            [-signal.SIGINT, -signal.SIGKILL, -signal.SIGKILL],
        )


class Log(Folder):
    def test_last_words(self):
        for lines, said in (
            (['[ INFO] a', '[FATAL] [1.5]: b', '\033[31m[ERROR] c\033[0m', 'd'], '[ERROR] c; '),
            (
                ['[x/hdlyap-1] process has died [pid 7, exit code -9, cmd /a b].'],
                'process has died [pid 7, exit code -9]; ',
            ),
            (['process has finished cleanly'], ''),
        ):
            files.write(self.path('log'), '\n'.join(lines))
            self.assertEqual(work.last_words(self.path('log')), said)


if __name__ == '__main__':
    unittest.main()
