#!/usr/bin/env python3
"""reproduce and reproduce.launch with runs of a second: what is done, done again, left over, and
said."""

import glob
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

import rospy
import rostest
import yaml

import harness
from harness import LOOK, SOON, Process, wait_until

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, '../..'))
# of less than a second of computation
TINY = dict(
    base='quick',
    disks=20,
    equilibration=1.0,
    warmup=1.0,
    full=dict(duration=2.0),
    quick=dict(duration=1.0),
    observables=['spectrum'],
    seconds=[1, 1],
)
LONG = dict(TINY, full=dict(duration=1e6))
LATEST = 240.0  # that some runs of a second take there


def entries(**runs):
    return {name: dict(TINY, **changed) for name, changed in runs.items()}


class Reproduce(harness.Traced):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = os.path.join(folder.name, 'o u t')
        self.plan = os.path.join(folder.name, 'plan.yaml')
        self.trace()

    def start(self, runs, *options, **env):
        """All parts of the plan of these runs, under the master of this test unless env names
        another."""
        with open(self.plan, 'w') as file:
            yaml.safe_dump(runs, file, sort_keys=False)
        return Process(
            [*self.command(runs).split(), '--plan', self.plan, '--out', self.out, *options],
            HDLYAP_MARK=self.mark,
            **env,
        )

    @staticmethod
    def command(runs):
        return ' '.join([sys.executable, os.path.join(HERE, 'parts_of.py'), ','.join(runs)])

    def stand_in(self, name, script):
        """A PATH on which a shell script of that name comes first."""
        folder = os.path.dirname(self.plan)
        with open(os.path.join(folder, name), 'w') as file:
            file.write('#!/bin/sh\n' + script + '\n')
        os.chmod(file.name, 0o755)
        return folder + ':' + os.environ['PATH']

    def reproduce(self, runs, *options, status=0, **env):
        """What it printed."""
        process = self.start(runs, *options, **env)
        self.assertEqual(process.wait(LATEST), status, process.text())
        return process.text()

    def path(self, *names):
        return os.path.join(self.out, *names)

    def files(self):
        return sorted(
            os.path.relpath(path, self.out)
            for path in glob.glob(self.path('**'), recursive=True)
            if not os.path.isdir(path)
        )

    def times(self, *names):
        return [os.path.getmtime(self.path(name + '.bag')) for name in names]

    def begun(self):
        """How many nodes have said what they run; that a node is there says little: the plan asks
        one for its parameters before any master is."""
        logs = glob.glob(self.path('log', '*.log'))
        return sum(': scene ' in Path(log).read_text(errors='replace') for log in logs)

    def await_averaging(self, process, count=1):
        """So many nodes have said something of their runs."""
        wait_until(lambda: self.begun() >= count or not process.running(), every=LOOK)
        self.assertTrue(process.running() and self.begun() >= count, process.text())
        time.sleep(1.5)

    # ---- runs ------------------------------------------------------------------------------------

    def test_done_once(self):
        """A run that fails stops no other, nor does a part; what is there and the same is not run
        again, what has changed is, and a bag that was cut off."""
        runs = entries(wide=dict(threads=0), first={}, second={}, refused=dict(density=2.5))
        os.makedirs(self.out)
        with open(self.path('first.bag'), 'wb') as file:
            file.write(b'#ROSBAG V2.0\n' + bytes(5000))
        self.check_failure(
            self.reproduce(runs, '--jobs', '2', status=1, HDLYAP_TEST_BROKEN='first')
        )
        self.check_results(['first', 'second', 'wide'], broken=['first'])
        before = self.times('first', 'second', 'wide')
        runs['refused']['density'] = 0.5
        runs['second']['full'] = dict(duration=3.0)
        said = self.reproduce(runs, '--jobs', '2')
        self.assertRegex(said, r'(?m)^4 of 4 runs done in \d+:\d\d$')
        after = self.times('first', 'second', 'wide')
        self.assertEqual([a == b for a, b in zip(before, after)], [True, False, True])
        self.check_results(['first', 'refused', 'second', 'wide'])
        with open(self.path('results', 'rows.csv')) as file:
            self.assertIn(
                '\n3,so long,the same,ours,differs,averaged time,2,0,3,0,,differs,any other,\n',
                file.read(),
            )
        said = self.reproduce(runs)
        self.assertNotIn('runs done', said)
        self.assertEqual(self.times('first', 'second', 'wide'), after)
        self.assert_none_left()

    def check_failure(self, said):
        log = self.path('log', 'refused.log')
        lines = [line for line in said.splitlines() if line.startswith('reproduce: ')]
        self.assertEqual(len(lines), 3, said)  # when it failed, and at the end
        self.assertEqual(
            lines.pop(),
            'reproduce: part 2: ValueError: no such column; more in '
            + self.path('log', 'part_02.log'),
        )
        for line in lines:
            self.assertRegex(
                line,
                r"^reproduce: refused: the run has not come to its end; .*FATAL.*"
                r"density = 2\.5: .*; "
                f'all that it said is in {log}$',
            )
        self.assertRegex(said, r'(?m)^3 of 4 runs done, 1 failed in \d+:\d\d$')
        self.assertIn('part 4: not drawn, the run refused is missing', said)

    def check_results(self, names, broken=()):
        wanted = [f'{name}.{ending}' for name in names for ending in ('bag', 'json', 'yaml')]
        self.assertLessEqual(set(wanted), set(self.files()))
        self.assertEqual(
            [name for name in self.files() if name.endswith('.bag')],
            [name + '.bag' for name in names],
        )
        with open(self.path('results', 'results.txt')) as file:
            text = file.read()
        for name in names:
            self.assertEqual(f'all about {name}\n' in text, name not in broken)
            self.assertRegex(text, rf'(?m)^  {name} +\d+:\d\d')
            self.assertEqual(
                len(glob.glob(self.path('results', f'*_{name}.*'))), 3
            )  # png, svg, csv

    def test_queue(self):
        """Runs made elsewhere with the files of --write: by one launch, and as tasks of a queue,
        one of which fails."""
        runs = entries(one={}, two={}, wide=dict(threads=0), refused=dict(density=2.5))
        names = self.reproduce(runs, '--write')
        self.assertEqual(names, 'one\ntwo\nwide\nrefused\n')
        self.assertEqual(self.files(), ['one.yaml', 'refused.yaml', 'two.yaml', 'wide.yaml'])
        launch = Process(
            ['roslaunch', 'hdlyap', 'reproduce.launch', 'runs:=one two', 'folder:=' + self.out],
            HDLYAP_MARK=self.mark,
        )
        tasks = [self.task(runs, names, number) for number in (3, 4)]
        self.assertEqual(launch.wait(LATEST), 0, launch.text())
        for task, status in zip(tasks, (0, 1)):
            self.assertEqual(task.wait(LATEST), status, task.text())
        self.assertEqual(len(tasks[1].lines('FATAL')), 1, tasks[1].text())
        self.assert_none_left()
        self.assertEqual(self.reproduce(runs, '--draw').count('elsewhere'), 3)

    def task(self, runs, names, number):
        """Of launch/reproduce.sbatch, as Slurm would start it; with our parts instead of the
        installed ones."""
        with open(self.plan + '.names', 'w') as file:
            file.write(names)
        path = self.stand_in('rosrun', f'shift 2; exec {self.command(runs)} "$@"')
        return Process(
            [
                'bash',
                os.path.join(ROOT, 'launch/reproduce.sbatch'),
                self.out,
                file.name,
                '--plan',
                self.plan,
            ],
            HDLYAP_MARK=self.mark,
            SLURM_ARRAY_TASK_ID=str(number),
            PATH=path,
        )

    # ---- ends ------------------------------------------------------------------------------------

    def test_interrupted(self):
        """Nothing is left of it, nor of a bag that was not whole; the run that was done stays
        done."""
        process = self.start(
            dict(entries(first={}), long=LONG), '--jobs', '2', ROS_MASTER_URI=self.nobodys_master()
        )
        wait_until(lambda: os.path.exists(self.path('first.json')) or not process.running())
        self.await_averaging(process, 2)
        process.send(signal.SIGINT)
        self.assertEqual(process.wait(SOON), 130, process.text())
        self.assertRegex(process.text(), r'(?m)^1 of 2 runs done in \d+:\d\d$')
        self.assert_none_left()
        self.assertEqual(
            self.files(),
            ['first.bag', 'first.json', 'first.yaml', 'log/first.log', 'log/long.log', 'long.yaml'],
        )

    def test_terminated(self):
        process = self.start(dict(long=LONG))
        self.await_averaging(process)
        process.send(signal.SIGTERM)
        self.assertEqual(process.wait(SOON), 143, process.text())
        self.assert_none_left()

    def nobodys_master(self):
        return 'http://localhost:%d' % harness.free_port()

    def test_killed(self):
        """Its nodes do not go on without it; and meanwhile the folder is its own."""
        process = self.start(dict(long=LONG), ROS_MASTER_URI=self.nobodys_master())
        self.await_averaging(process)
        said = self.reproduce(dict(long=LONG), status=1)
        self.assertEqual(said, f'reproduce: another reproduce does the runs of {self.out}\n')
        process.send(signal.SIGKILL)
        process.wait()
        self.assert_none_left()

    def test_node_and_roslaunch_are_killed(self):
        """Two runs that fail, each in its way; no node is left of the second."""
        process = self.start(dict(node=LONG, launch=LONG, **entries(good={})), '--jobs', '3')
        self.await_averaging(process, 2)
        names = ('node', 'launch')
        self.assertTrue(
            wait_until(
                lambda: all(self.ours('hdlyap_node', 'ROS_NAMESPACE=/' + name) for name in names),
                every=LOOK,
            )
        )
        time.sleep(1.5)
        os.kill(self.ours('hdlyap_node', 'ROS_NAMESPACE=/node')[0], signal.SIGKILL)
        os.kill(self.ours('runs:=launch')[0], signal.SIGKILL)
        self.assertEqual(process.wait(LATEST), 1, process.text())
        said = process.text()
        self.assertRegex(
            said,
            r'reproduce: node: the run has not come to its end; '
            r'process has died \[pid \d+, exit code -9\]; all that it said',
        )
        self.assertRegex(
            said, r'reproduce: launch: the run has not come to its end; all that it said is in'
        )
        self.assertRegex(said, r'(?m)^1 of 3 runs done, 2 failed')
        self.assert_none_left()
        self.check_results(['good'])

    def test_master_dies(self):
        process = self.start(dict(long=LONG), ROS_MASTER_URI=self.nobodys_master())
        self.await_averaging(process)
        os.kill(self.ours('rosmaster')[0], signal.SIGKILL)
        self.assertEqual(process.wait(SOON), 1, process.text())
        self.assertRegex(
            process.text(), r'(?m)^reproduce: the ROS master at http://localhost:\d+ has gone'
        )
        self.assert_none_left()

    def test_node_does_not_come(self):
        """A roslaunch that does nothing."""
        path = self.stand_in('roslaunch', 'exec sleep 1000')
        said = self.reproduce(entries(one={}), status=1, PATH=path, HDLYAP_TEST_SILENCE='1')
        self.assertIn('reproduce: one: no word of its node within 1 s', said)
        self.assert_none_left()


if __name__ == '__main__':
    rospy.init_node('test_reproduce')
    rostest.rosrun('hdlyap', 'reproduce', Reproduce)
