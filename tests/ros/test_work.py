"""Runs of a second by `hdlyap sweep`: what is done, done again, left over, and said; runs that are
done elsewhere."""

import csv
import glob
import os
import re
import shutil
import signal
import subprocess
import sys
from subprocess import PIPE

import rosbag
import yaml

import hdlyap
import harness
from harness import POLL, SOON, Process, wait_until

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

HERE = os.path.dirname(os.path.abspath(__file__))
SBATCH = os.path.join(HERE, '../../launch/runs.sbatch')
# of less than a second of computation
TINY = dict(
    base='quick', number=20, equilibration=1.0, warmup=1.0, duration=2.0, observables=['spectrum']
)
LONG = dict(TINY, duration=1e6)
REFUSED = dict(TINY, density=2.5)
MODES = dict(harness.MODES, duration=150.0)
LATEST = 240.0  # seconds that some runs of a second take on a busy machine
# `hdlyap sweep` where a node may be silent for a second
IMPATIENT = (
    'import sys; from hdlyap.runs import work; from hdlyap import commands; work.SILENCE = 1.0; '
    'sys.exit(commands.main(["sweep", *sys.argv[1:]]))'
)


class InFolder(harness.Traced, harness.InFolder):
    def setUp(self):
        super().setUp()
        self.out = self.path('o u t')
        self.trace()

    def start(self, *command, **env):
        return Process(command, PWD=self.folder, HDLYAP_MARK=self.mark, **env)

    def write(self, name, **values):
        with open(self.path(name), 'w') as file:
            yaml.safe_dump(values, file, sort_keys=False)

    def begin(self, *options, program=harness.command('sweep'), env=(), **runs):
        """Of a plan of these runs."""
        self.write('plan.yaml', **runs)
        return self.start(
            *program, '--plan', 'plan.yaml', '--folder', self.out, *options, **dict(env)
        )

    def sweep(self, *options, status=0, **runs):
        """What it printed when it had ended."""
        process = self.begin(*options, **runs)
        self.assertEqual(process.wait(LATEST), status, process.text())
        return process.text()

    def files(self):
        found = glob.glob(os.path.join(self.out, '**'), recursive=True)
        return sorted(os.path.relpath(path, self.out) for path in found if not os.path.isdir(path))

    def run_ids(self, folder=None):
        """{name of a bag: run_id}"""
        paths = glob.glob(os.path.join(folder or self.out, '*.bag'))
        return {os.path.basename(path)[:-4]: hdlyap.load(path).info.run_id for path in paths}

    def await_nodes(self, process, *names):
        """They have said which runs they are, and so have a master."""

        def has_said(name):
            path = os.path.join(self.out, 'log', name + '.log')
            return os.path.exists(path) and f'scene {name}: ' in open(path).read()

        wait_until(lambda: all(map(has_said, names)) or not process.running(), LATEST, POLL)
        self.assertTrue(process.running(), process.text())


class Work(InFolder):
    def test_done_once(self):
        """Elsewhere with the files of --write, by a launch and as tasks of a queue; then what has
        changed, was cut or has failed, and that alone. What is replaced is kept."""
        runs = dict(one=TINY, two=dict(TINY, seed='2'), wide=dict(TINY, threads=0), refused=REFUSED)
        self.assertEqual(self.sweep('--write', **runs), 'one\ntwo\nwide\nrefused\n')
        self.assertEqual(self.files(), ['one.yaml', 'refused.yaml', 'two.yaml', 'wide.yaml'])
        self.do_elsewhere()
        self.assertEqual(self.sweep('--write', **runs), 'refused\n')
        elsewhere = self.run_ids()
        runs['two'] = dict(TINY, seed='2', duration=3.0)
        one, two = (os.path.join(self.out, name + '.bag') for name in ('one', 'two'))
        os.truncate(one, os.path.getsize(one) // 2)
        said = self.sweep('--jobs', '2', status=1, **runs)
        self.check_kept(said, one, two)
        self.check_failure(said)
        here = self.run_ids()
        self.assertEqual(
            [here[name] == elsewhere[name] for name in ('one', 'two', 'wide')], [False, False, True]
        )
        self.assertEqual(hdlyap.load(two).info.duration, 3.0)
        runs['refused'] = TINY
        said = self.sweep('--only', 'refused wide', **runs)
        self.assertRegex(said, r'(?m)^2 of 2 runs done in \d+:\d\d$')
        self.assertIn(f'2 of 2 runs are in {self.out}\n', said)
        said = self.sweep(**runs)  # nothing but the table
        self.assertTrue(
            said.startswith(f'4 of 4 runs are in {self.out}\n\nthe same in all: '), said
        )
        self.assertNotIn('runs done', said)
        for name in ('one', 'two', 'wide', 'refused'):
            self.assertRegex(said, rf'(?m)^{name} +\d')
        self.assertEqual({**self.run_ids(), **here}, self.run_ids())
        self.assert_none_left()

    def do_elsewhere(self):
        names = self.path('names.txt')
        with open(names, 'w') as file:
            file.write('one\ntwo\nwide\nrefused\n')
        launch = self.start(
            'roslaunch', 'hdlyap', 'runs.launch', 'runs:=one two', f'folder:={self.out}'
        )
        self.assertEqual(launch.wait(LATEST), 0, launch.text())
        self.assertEqual(len(launch.lines('the same in all: number 20')), 1, launch.text())
        # a task that is refused has failed, whatever is there already
        shutil.copy(os.path.join(self.out, 'one.bag'), os.path.join(self.out, 'refused.bag'))
        tasks = [
            self.start('bash', SBATCH, self.out, names, SLURM_ARRAY_TASK_ID=number)
            for number in '34'
        ]
        for task, status in zip(tasks, (0, 1)):
            self.assertEqual(task.wait(LATEST), status, task.text())
        self.assertEqual(len(tasks[1].lines('FATAL')), 1, tasks[1].text())
        self.assert_none_left()

    def check_kept(self, said, one, two):
        for path, why in (
            (one, 'the run has not reached its end'),
            (two, 'it was run with duration = 2, not 3'),
        ):
            line = f'hdlyap sweep: {path} was there already: it is now {path}.old, as {why}\n'
            self.assertIn(line, said)
        self.assertEqual(hdlyap.load(two + '.old').info.duration, 2.0)

    def check_failure(self, said):
        """It is told before all runs, when it failed, and at the end; the others go on."""
        before, *lines = [line for line in said.splitlines() if 'sweep: refused' in line]
        self.assertRegex(before, r'^hdlyap sweep: refused will be refused: density = 2\.5: ')
        self.assertEqual(len(lines), 2, said)
        for line in lines:
            self.assertRegex(
                line,
                r'^hdlyap sweep: refused: the run has not reached its end; .*FATAL.*'
                rf'density = 2\.5: .*; all its output is in {self.out}/log/refused\.log$',
            )
        self.assertRegex(said, r'(?m)^3 of 4 runs done, 1 failed in \d+:\d\d$')
        self.assertIn(f'3 of 4 runs are in {self.out}\n', said)

    def test_chosen_by_the_node(self):
        """Is no difference from what was asked for: auto and 0, the order of topics, the time of a
        change."""
        runs = dict(
            soft=dict(TINY, particles='soft_disks', number=16),
            turned=dict(TINY, observables=['state', 'spectrum']),
            changed=dict(TINY, duration=20.0, changes=['5 report_interval=2']),
        )
        self.sweep(**runs)
        done = self.run_ids()
        self.assertEqual(sorted(done), sorted(runs))
        said = self.sweep(**runs)
        self.assertTrue(
            said.startswith(f'3 of 3 runs are in {self.out}\n\nthe same in all: '), said
        )
        self.assertNotIn('runs done', said)
        self.assertEqual(self.run_ids(), done)

    def test_stopped(self):
        """It has ended, but it is not the run that was asked for: its bag is kept, and the run done
        again."""
        process = self.begin(one=LONG)
        self.await_nodes(process, 'one')
        with open(os.path.join(self.out, 'log', 'one.log')) as log:
            uri = re.search(r'ROS_MASTER_URI=([\w:/]+)', log.read())[1]
        stop = ['rosservice', 'call', '/one/hdlyap/stop']
        how = dict(stdout=PIPE, env={**os.environ, 'ROS_MASTER_URI': uri})
        self.assertTrue(wait_until(lambda: b'success: True' in subprocess.run(stop, **how).stdout))
        self.assertEqual(process.wait(LATEST), 1, process.text())
        self.assertRegex(process.text(), 'sweep: one: duration was set to .* while it went on; all')
        (stopped,) = self.run_ids().values()
        said = self.sweep(one=TINY)
        self.assertIn(
            f'{self.out}/one.bag was there already: it is now {self.out}/one.bag.old', said
        )
        self.assertEqual(hdlyap.load(os.path.join(self.out, 'one.bag.old')).info.run_id, stopped)

    # ---- ends ------------------------------------------------------------------------------------

    def test_interrupted(self):
        """Nothing is left of it, nor of a bag that was not whole; the run that was done stays
        done. Started in the background, where Ctrl-C is ignored."""
        ignoring = [
            'perl',
            '-e',
            '$SIG{INT} = "IGNORE"; exec @ARGV',
            '--',
            *harness.command('sweep'),
        ]
        process = self.begin('--jobs', '2', program=ignoring, first=TINY, long=LONG)
        wait_until(lambda: 'first.bag' in self.files() or not process.running(), LATEST, POLL)
        self.await_nodes(process, 'long')
        process.send(signal.SIGINT)
        self.assertEqual(process.wait(SOON), 130, process.text())
        self.assertRegex(process.text(), r'(?m)^1 of 2 runs done in \d+:\d\d$')
        self.assertIn('interrupted; the same command goes on with the runs', process.text())
        self.assert_none_left()
        self.assertEqual(
            self.files(), ['first.bag', 'first.yaml', 'log/first.log', 'log/long.log', 'long.yaml']
        )

    def test_terminated(self):
        """Meanwhile the folder is its own."""
        process = self.begin(long=LONG)
        self.await_nodes(process, 'long')
        said = self.sweep(status=1, long=LONG)
        self.assertEqual(said, f'hdlyap sweep: another sweep does the runs of {self.out}\n')
        process.send(signal.SIGTERM)
        self.assertEqual(process.wait(SOON), 143, process.text())
        self.assert_none_left()

    def test_killed(self):
        """Its nodes do not go on without it, nor do their masters."""
        process = self.begin(long=LONG)
        self.await_nodes(process, 'long')
        process.send(signal.SIGKILL)
        process.wait()
        self.assert_none_left()

    def test_master_dies(self):
        """Its run has failed."""
        process = self.begin(long=LONG)
        self.await_nodes(process, 'long')
        (master,) = self.ours('rosmaster')
        os.kill(master, signal.SIGKILL)
        self.assertEqual(process.wait(SOON), 1, process.text())
        self.assertRegex(
            process.text(), r'(?m)^hdlyap sweep: long: the run has not reached its end; '
        )
        self.assert_none_left()

    def test_node_and_roslaunch_are_killed(self):
        """Two runs that fail, each in its way; no node is left of the second."""
        process = self.begin('--jobs', '2', node=LONG, launch=LONG)
        self.await_nodes(process, 'node', 'launch')
        for word in ('__ns:=launch', '/hdlyap_node'):
            (pid,) = self.ours(word, '' if '=' in word else 'ROS_NAMESPACE=/node')
            os.kill(pid, signal.SIGKILL)
        self.assertEqual(process.wait(LATEST), 1, process.text())
        ended = 'the run has not reached its end;'
        self.assertRegex(
            process.text(),
            rf'hdlyap sweep: node: {ended} process has died \[pid \d+, exit code -9\]; all its',
        )
        self.assertIn(f'hdlyap sweep: launch: {ended} all its output is in', process.text())
        self.assertRegex(process.text(), r'(?m)^0 of 2 runs done, 2 failed')
        self.assert_none_left()

    def test_node_does_not_come(self):
        """A roslaunch that does nothing."""
        with open(self.path('roslaunch'), 'w') as file:
            file.write('#!/bin/sh\nexec sleep 1000\n')
        os.chmod(file.name, 0o755)
        path = {'PATH': self.folder + ':' + os.environ['PATH']}
        process = self.begin(program=[sys.executable, '-c', IMPATIENT], env=path, one=TINY)
        self.assertEqual(process.wait(LATEST), 1, process.text())
        self.assertIn('hdlyap sweep: one: no message of its node within 1 s', process.text())
        self.assert_none_left()


class Grid(InFolder):
    def test_table(self):
        """In a namespace; one density is refused, of the others there are a table and a figure."""
        self.write('tiny.yaml', **MODES)
        process = self.start(*self.of('0.6 0.8 2.5'), ROS_NAMESPACE='/lab')
        self.assertEqual(process.wait(LATEST), 1, process.text())
        # each when it failed and at the end; one of them before all runs
        self.assertEqual(len(process.lines('hdlyap sweep: density_2_5_seed_')), 5, process.text())
        self.assertRegex(process.text(), r'(?m)^4 of 6 runs done, 2 failed in')
        self.assert_none_left()
        done = self.run_ids(self.path('of mine'))
        self.assertEqual(
            sorted(done),
            [f'density_{density}_seed_{k}' for density in ('0_6', '0_8') for k in '12'],
        )
        self.check_bag(self.path('of mine', 'density_0_8_seed_1.bag'))
        self.check_results()
        table = process.text()[process.text().index('the same in all') :].split('\nwritten')[0]
        self.check_again(table)
        self.assertEqual(self.run_ids(self.path('of mine')), done)

    @staticmethod
    def of(densities):
        words = ['--densities', densities, '--seeds', '1 2', '--folder', 'of mine']
        words += ['--scene', 'tiny.yaml', '--observables', '[spectrum, steps, state]']
        return [*harness.command('sweep'), *words]

    def check_bag(self, path):
        with rosbag.Bag(path) as bag:
            topics = {topic.rpartition('/')[2] for topic in bag.get_type_and_topic_info()[1]}
        self.assertLessEqual({'run_info', 'status', 'cost', 'state', 'spectrum'}, topics)
        self.assertNotIn('modes', topics)

    def check_results(self):
        """The files, and their numbers."""
        for ending in ('txt', 'png', 'svg'):
            self.assertGreater(os.path.getsize(self.path('of mine', 'sweep.' + ending)), 500)
        with open(self.path('of mine', 'sweep.csv')) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row['density [1/sigma^2]'] for row in rows], ['0.6', '0.8'])
        for row, name in zip(rows, ('density_0_6', 'density_0_8')):
            self.assertEqual((row['seeds'], row['averaged time [time units]']), ('1 2', '300'))
            paths = [self.path('of mine', f'{name}_seed_{k}.bag') for k in '12']
            self.check_row(row, hdlyap.load(*paths).results)

    def check_row(self, row, results):
        self.assertIn('c_T', results.index)
        units = {'lambda_max': '1/time unit', 'c_T': 'sigma/time unit'}
        for name, factor in (('lambda_max', 1), ('c_T', 1), ('h_KS', MODES['number'])):
            shown = name if name in units else 'h_KS/N'
            columns = [f'{shown} [{units.get(name, "1/time unit")}]']
            columns += [f'{shown} {error}' for error in ('std_error', 'scatter')]
            for column, known in zip(columns, ('value', 'std_error', 'scatter')):
                self.assertAlmostEqual(float(row[column]) * factor, results[known][name], 9)
            self.assertAlmostEqual(float(row[f'{shown} chi2']), results['chi2'][name], 9)
        self.assertEqual(row['c_T basis'], results['basis']['c_T'])

    def check_again(self, table):
        """Nothing is run; the table is the same, or one of other fits."""
        for more, wanted in (((), table), (('--form', 'c k'), '\n  [1] c k over ')):
            process = self.start(*self.of('0.6 0.8'), *more)
            self.assertEqual(process.wait(LATEST), 0, process.text())
            self.assertIn(wanted, process.text())
            self.assertNotIn('runs done', process.text())
