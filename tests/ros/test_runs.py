"""What many runs are made of: a scene and what is given besides become parameters or are refused,
bags are whole or not and are not overwritten, machines take turns, processes end, progress is
shown. Needs no ROS master."""

import contextlib
import io
import itertools
import os
import re
import signal
import socket
import subprocess
import threading
import time
import types
import unittest
from unittest import mock

import pytest
import roslaunch.config
import rospkg

import harness
import made
from hdlyap.msg import Change, RunStatus
from hdlyap.runs import asked, bags, ranks, run, scene, tree, work
from hdlyap.runs.program import HDLYAP
from hdlyap.runs.run import UNFINISHED

pytestmark = pytest.mark.second_tier

GUIDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../doc/user_guide.md')
LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')


class InFolder(harness.InFolder):
    def write(self, name, text=''):
        with open(self.path(name), 'w') as file:
            file.write(text)


class Parameters(InFolder):
    def of(self, **given):
        return scene.parameters(given, LAUNCH, self.folder)

    def refused(self, what, says, **given):
        with self.assertRaises(scene.Refused) as caught:
            self.of(**given)
        line = str(caught.exception)
        self.assertNotIn('\n', line)
        self.assertTrue(line.startswith(what + ' = '), line)
        self.assertIn('must be', line)
        self.assertIn(says, line)

    def test_scene_and_what_is_given_besides(self):
        """Numbers are numbers, a text is left to the node, which knows what it must be."""
        found = self.of(
            scene='quick',
            number='50',
            density='0.55',
            aspect='1e-1',
            duration='abc',
            seed='18446744073709551615',
            observables='[spectrum, steps]',
            params='{warmup: 20, field_indices: [1, 2]}',
            pace='',
        )
        self.assertEqual(
            found,
            dict(
                scene='quick',
                number=50,
                density=0.55,
                aspect='1e-1',
                duration='abc',
                seed='18446744073709551615',
                observables='[spectrum, steps]',
                warmup=20,
                field_indices=[1, 2],
                equilibration=20.0,
            ),
        )

    def test_long_numbers_become_strings(self):
        """Which the master's integers do not hold."""
        self.write('own.yaml', 'number: 5000000000\n')
        found = self.of(scene='own.yaml', params='{seed: 18446744073709551615}')
        self.assertEqual((found['number'], found['seed']), ('5000000000', '18446744073709551615'))

    def test_a_file_without_a_name_is_named_after_itself(self):
        self.write('own.yaml', 'number: 50\n')
        self.assertEqual(self.of(scene='own.yaml'), dict(scene='own', number=50))
        self.assertEqual(self.of(scene=self.path('own.yaml'))['scene'], 'own')
        self.write('own.yaml', 'scene: other\n')
        self.assertEqual(self.of(scene='own.yaml'), dict(scene='other'))

    def test_refused(self):
        self.write('broken.yaml', 'number: 5\n  aspect: {\n')
        self.write('list.yaml', '[1]\n')
        self.refused('scene', 'covariant, dense,', scene='quik')
        self.refused('scene', 'No such file', scene='quik.yaml')
        self.refused('scene', 'line 2', scene='broken.yaml')
        self.refused('scene', 'YAML file of parameters', scene='list.yaml')
        self.refused('params', 'line 1', scene='quick', params='{warmup: 20')
        self.refused('params', '{parameter: value', scene='quick', params='warmup')
        self.refused('params', 'without number', scene='quick', params='{number: 20}', number='30')


class Scenes(unittest.TestCase):
    def test_table_in_the_guide(self):
        """Has all of them, with their numbers of disks."""
        with open(GUIDE) as file:
            section = file.read().split('### Scenes')[1].split('###')[0]
        stated = dict(re.findall(r'(?m)^\| `(\w+)` \| (\d+) \|', section))
        disks = {}
        for name in os.listdir(os.path.join(LAUNCH, 'scenes')):
            values = scene.scene_file(name[: -len('.yaml')], LAUNCH, '.')
            disks[values['scene']] = str(values.get('number', 780))
        self.assertEqual(stated, disks)


class Bags(InFolder):
    def files(self):
        return sorted(os.listdir(self.folder))

    def kept(self):
        return list(bags.keep(self.path('run.bag')))

    def test_none_in_the_way(self):
        self.write('run.bag.old')
        self.write('run_again.bag')
        self.assertEqual(self.kept(), [])
        self.assertEqual(self.files(), ['run.bag.old', 'run_again.bag'])

    def test_old_ones_are_kept(self):
        for number in '12':
            self.write('run.bag', number)
            self.assertEqual(len(self.kept()), 1)
        self.assertEqual(self.files(), ['run.bag.old', 'run.bag.old2'])
        for name, text in (('run.bag.old', '1'), ('run.bag.old2', '2')):
            with open(self.path(name)) as file:
                self.assertEqual(file.read(), text)

    def test_parts_and_what_was_cut_short(self):
        """All of a run get the same ending."""
        for name in (
            'run_0.bag',
            'run_1.bag',
            'run_2.bag.active',
            'run.bag.active',
            'run_1.bag.old',
        ):
            self.write(name)
        self.assertEqual(len(self.kept()), 4)
        self.assertEqual(
            self.files(),
            [
                'run.bag.active.old2',
                'run_0.bag.old2',
                'run_1.bag.old',
                'run_1.bag.old2',
                'run_2.bag.active.old2',
            ],
        )

    def test_one_that_is_written(self):
        path = self.path('run.bag.active')
        with open(path, 'w') as file:
            writer = subprocess.Popen(['sleep', '60'], stdout=file)
        self.addCleanup(writer.wait)
        self.addCleanup(writer.kill)
        patience, bags.PATIENCE = bags.PATIENCE, 0.0
        self.addCleanup(setattr, bags, 'PATIENCE', patience)
        with self.assertRaisesRegex(bags.InUse, f'process {writer.pid} writes {path}'):
            self.kept()
        self.assertEqual(self.files(), ['run.bag.active'])


class Made(InFolder):
    """A run whose bag is made."""

    def of(self, **changed):
        given = {'scene': 'one', 'duration': 7.0, **changed}
        return run.Planned('one', HDLYAP.completed(given))

    def lacks(self, stage=RunStatus.FINISHED, progress=1.0, of=None, given=(), **said):
        """Of a made bag. given: what it was asked for, if it was something else; said: what else
        run_info says."""
        of = of or self.of()
        texts = {name: asked.text(value) for name, value in of.parameters.items()}
        info = dict(given=['='.join(one) for one in {**texts, **dict(given)}.items()], **said)
        last = made.status(150.0, stage=stage, progress=progress)
        made.write(
            of.bag(self.folder), [made.run_info(**info), made.status(120.0), made.cost(150.0), last]
        )
        return of.lacks(self.folder)


class Done(Made):
    """Whether the bag is all of a run."""

    def test_whole(self):
        cut = 'the run has not reached its end'
        self.assertEqual(self.of().lacks(self.folder), cut)
        self.assertEqual(self.lacks(), '')
        for said in (dict(progress=0.99), dict(stage=RunStatus.AVERAGING)):
            self.assertEqual(self.lacks(**said), cut)
        with open(self.of().bag(self.folder), 'r+b') as file:
            file.truncate(6000)
        self.assertEqual(self.of().lacks(self.folder), cut)

    def test_parameters(self):
        """As they were given; how the run was computed makes no difference."""
        of = self.of(observables=['steps', 'spectrum'], duration=7, interval=0.5, seed='1')
        same = dict(threads='64', wait_for_subscribers='all', resume='kept', duration='7.0')
        self.assertEqual(self.lacks(of=of, given=same), '')
        for name, value in dict(
            duration='7.5',
            number='21',
            seed='2',
            scene='two',
            interval='auto',
            warmup='40',
            observables='[steps]',
            boundary_x='reflecting',
            density='0.71',
        ).items():
            said = self.lacks(of=of, given={**same, name: value})
            self.assertIn(f'it was run with {name} = {value}, not ', said)

    def test_chosen_by_the_node(self):
        """Makes no difference: what auto and 0 got, the order of topics, the time of a change."""
        of = self.of(
            particles='soft_disks',
            **HDLYAP.own()['soft_disks'],
            observables=['steps', 'spectrum'],
            changes=['5 report_interval=2.0'],
        )
        made_ones = [Change(sim_time=5.02, name='report_interval', before='1', value='2')]
        self.assertEqual(
            self.lacks(
                of=of,
                particles='soft_disks',
                warmup=40.0,
                own=['time_step=0.0026', 'potential=wca'],
                observables=['spectrum', 'steps'],
                changes=made_ones,
            ),
            '',
        )
        made_ones.append(Change(sim_time=6.0, name='duration', before='7', value='3'))
        self.assertEqual(
            self.lacks(of=of, particles='soft_disks', changes=made_ones),
            'duration was set to 3 while it went on',
        )

    def test_not_given(self):
        """Elsewhere it may have been left out."""
        of = self.of(number=20)
        texts = [f'{name}={of.parameters[name]}' for name in ('scene', 'number', 'duration')]
        for left_out in range(2):
            made.write(
                of.bag(self.folder),
                [
                    made.run_info(given=texts[: 3 - left_out]),
                    made.cost(150.0),
                    made.status(150.0, stage=RunStatus.FINISHED, progress=1.0),
                ],
            )
            self.assertEqual(
                of.lacks(self.folder), left_out * 'it was run with duration = 0, not 7'
            )

    def test_texts(self):
        """As those of the node."""
        for value, text in (
            (400, '400'),
            (400.0, '400'),
            (0.1 + 0.2, '0.30000000000000004'),
            (1e-8, '1e-08'),
            ('1e-8', '1e-8'),
            (['a', 'b'], '[a, b]'),
            ('[a,b]', '[a, b]'),
            ('[]', '[]'),
            ('"5"', '5'),
            ('', ''),
            ('[', '['),
            ([3, 14.0], '[3, 14]'),
        ):
            self.assertEqual(asked.text(value), text)


def stop(_, came):
    """Instead of Job.do: a signal comes."""
    os.kill(os.getpid(), signal.SIGINT)
    harness.wait_until(lambda: came)


class Kept(Made):
    """What becomes of the bag of a run that has ended."""

    def ended(self, **said):
        """A Job whose bag is made."""
        job = work.Job(self.of(), self.folder)
        os.makedirs(self.path('under_way'))
        with mock.patch.object(self, 'folder', self.path('under_way')):
            self.lacks(**said)
        os.rename(self.path('under_way', 'one.bag'), job._new)
        return job

    def bags(self):
        found = (name for _, _, names in os.walk(self.folder) for name in names)
        return sorted(name for name in found if '.bag' in name)

    def test_in_its_place(self):
        job = self.ended()
        self.assertEqual(job.placed(), '')
        self.assertEqual(os.listdir(self.path('under_way')), [])
        self.assertEqual(job.run.lacks(self.folder), '')

    def test_of_another_run(self):
        """It is complete, and kept; so is what was in its place."""
        self.write('one.bag', 'of a year')
        job = self.ended(given=dict(density='0.6'))
        self.assertIn('it was run with density = 0.6, not 0', job.placed())
        self.assertEqual(self.bags(), ['one.bag', 'one.bag.old'])
        self.assertIn('density', job.run.lacks(self.folder))

    def test_while_its_place_is_taken(self):
        job = self.ended()
        with mock.patch.object(bags, 'keep', side_effect=bags.InUse('process 7 writes it')):
            self.assertRegex(job.placed(), 'is still in .*one.*: process 7 writes')
        self.assertEqual(self.bags(), [os.path.basename(job._new)])

    def test_not_whole(self):
        """It goes if it says so; what cannot be read stays, as it may be whole."""
        job = self.ended(progress=0.99)
        self.assertEqual(job.placed(), UNFINISHED)
        self.assertEqual(self.bags(), [])
        self.write(job._new, 'of a year')
        self.assertEqual(job.placed(), f'{UNFINISHED}; its bag is still in {job._new}')
        self.assertEqual(self.bags(), [os.path.basename(job._new)])

    def test_cut_by_a_kill(self):
        """Whoever ends the sweep hears of it, too."""
        job = self.ended()
        os.rename(job._new, job._new + '.active')
        left = f'its bag is still in {job._new}.active'
        self.assertEqual(job.placed(), f'{UNFINISHED}; {left}')
        job.do, said = stop, io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
            with self.assertRaises(SystemExit):
                work._work([job], work.Tally([job], 0, 1), 1, '1G')
        self.assertEqual(said.getvalue(), f'hdlyap sweep: one: {left}\n')

    def test_when_all_are_stopped(self):
        """It had just reached its end; another one has not begun. None has failed."""
        jobs = [self.ended(given=dict(density='0.6')), work.Job(self.of(), '/nowhere')]
        show = work.Tally(jobs, 0, 1)
        jobs[0].do, jobs[0].log = stop, os.devnull
        with contextlib.redirect_stdout(io.StringIO()), self.assertRaises(SystemExit):
            work._work(jobs, show, 1, '1G')
        self.assertEqual(self.bags(), ['one.bag'])
        self.assertEqual(show.failed, [])


class Wrong(Made):
    """What becomes of the other runs if something goes wrong here."""

    def setUp(self):
        super().setUp()
        for name in ('log', 'under_way'):
            os.makedirs(self.path(name))
        self.begun, self.heard = set(), []

    def launched(self, words, came, output, is_lost):
        """Instead of roslaunch: the bag is whole at once; one goes on until it has to end."""
        given = dict(word.split(':=') for word in words)
        name = given['__ns']
        planned = run.Planned(name, self.of().parameters)
        self.lacks(of=planned)
        os.rename(planned.bag(self.folder), given['bag'])
        self.begun.add(name)
        if name == 'long':
            self.heard.append(harness.wait_until(is_lost, 5.0))
        harness.wait_until(lambda: 'long' in self.begun, 5.0)

    def work(self, *names):
        """Returns Tally.failed."""
        jobs = [work.Job(run.Planned(name, self.of().parameters), self.folder) for name in names]
        show = work.Tally(jobs, 0, 2)
        with mock.patch.object(work, 'launched', self.launched):
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(
                io.StringIO()
            ):
                work._work(jobs, show, 2, '1G')
        return show.failed

    def test_nobody_reads_what_it_says(self):
        """They end, and their bags come to their places."""
        with mock.patch.object(work.Tally, 'ended', side_effect=BrokenPipeError):
            with self.assertRaises(BrokenPipeError):
                self.work('one', 'long')
        self.assertEqual(self.heard, [True])
        self.assertEqual(os.listdir(self.path('under_way')), [])
        self.assertTrue(all(os.path.exists(self.path(name)) for name in ('one.bag', 'long.bag')))

    def test_no_file_can_be_written(self):
        """That run has failed; the others go on."""
        self.begun.add('long')
        for name in ('a.yaml', 'log/b.log'):
            os.makedirs(self.path(name))
        failed = sorted(self.work('a', 'b', 'c', 'd'))
        self.assertEqual(len(failed), 2, failed)
        for line, name, path in zip(failed, 'ab', ('a.yaml', 'log/b.log')):
            self.assertRegex(line, f'^{name}: .*Is a directory: .*{self.path(path)}')
        self.assertEqual(self.begun, {'c', 'd', 'long'})
        self.assertTrue(all(os.path.exists(self.path(name)) for name in ('c.bag', 'd.bag')))


class Machines(InFolder):
    """Which machine each run of runs.launch goes to: those of the user's file by turns; the
    recorder runs where its node does."""

    def loaded(self, names, machines):
        self.write(
            'machines.launch',
            '<launch>%s</launch>'
            % ''.join(
                f'<machine name="{name}" address="localhost" env-loader="/opt/{name}/env.sh"/>'
                for name in ('m1', 'm2')
            ),
        )
        for name in names:
            self.write(name + '.yaml', f'scene: {name}\n')
        with mock.patch.dict(os.environ, PWD=self.folder):
            return roslaunch.config.load_config_default(
                [
                    (
                        os.path.join(LAUNCH, 'runs.launch'),
                        [
                            'runs:=' + ' '.join(names),
                            'machines:=' + machines,
                            'machine_file:=machines.launch',
                        ],
                    )
                ],
                0,
            )

    def placed(self, config):
        return {
            node.namespace + node.name: config.machines[node.machine_name].env_loader
            if node.machine_name
            else None
            for node in config.nodes
        }

    def test_by_turns(self):
        config = self.loaded(['a', 'b', 'c'], 'm1 m2')
        one, two = '/opt/m1/env.sh', '/opt/m2/env.sh'
        self.assertEqual(
            self.placed(config),
            {
                '/a/hdlyap': one,
                '/a/record': one,
                '/b/hdlyap': two,
                '/b/record': two,
                '/c/hdlyap': one,
                '/c/record': one,
                '/table': None,
            },
        )
        params = {key: value.value for key, value in config.params.items()}
        for name in 'abc':
            self.assertEqual(params[f'/{name}/hdlyap/launch/scene'], f'scene: {name}\n')
            self.assertEqual(params[f'/{name}/hdlyap/wait_for_subscribers'], 'all')
            self.assertEqual(params[f'/{name}/record/node'], 'hdlyap')
            self.assertEqual(params[f'/{name}/record/bag'], f'{self.folder}/./{name}.bag')
        self.assertFalse(any(node.required for node in config.nodes if node.name != 'table'))

    def test_one_and_here(self):
        config = self.loaded(['a'], '')
        self.assertEqual(
            self.placed(config), {'/a/hdlyap': None, '/a/record': None, '/table': None}
        )


class Shown(InFolder):
    def job(self, name, seconds):
        self.write(name + '.log', '[FATAL] x')
        one = types.SimpleNamespace(name=name, share_of=lambda at_once: seconds / at_once)
        return types.SimpleNamespace(run=one, log=self.path(name + '.log'))

    def test_lines(self):
        """5 of 8 and so on; the time left by what has passed, and by the estimate at first."""
        now = [1000.0]
        out, err = io.StringIO(), io.StringIO()
        jobs = [self.job(name, 400.0) for name in 'abcd']
        with mock.patch('time.monotonic', lambda: now[0]), contextlib.redirect_stdout(
            out
        ), contextlib.redirect_stderr(err):
            show = work.Tally(jobs, 4, 2)
            for job, seconds, why in zip(jobs, (40, 400, 0, 3600), ('', '', 'no', '')):
                now[0] += seconds
                show.ended(job, why)
            show.end()
        self.assertEqual(
            out.getvalue().splitlines(),
            [
                '5 of 8 runs done, about 3:51 left',  # 600 * (40 + 60) / (200 + 60)
                '6 of 8 runs done, about 7:15 left',  # 400 * (440 + 60) / (400 + 60)
                '6 of 8 runs done, 1 failed, about 2:32 left',  # 200 * (440 + 60) / (600 + 60)
                '7 of 8 runs done, 1 failed, about 0:00 left',
                '7 of 8 runs done, 1 failed in 1:07:20',
            ],
        )
        said = f'c: no; [FATAL] x; all its output is in {self.path("c.log")}'
        self.assertEqual(err.getvalue(), f'hdlyap sweep: {said}\n')
        self.assertEqual(show.failed, [said])


class Side(unittest.TestCase):
    """Which runs are done at a time."""

    def test_by_side(self):
        """As many as asked; those that use all cores alone, after the others."""
        running, seen, all_three = set(), [], threading.Barrier(3)

        def job(name):
            def do(*_):
                running.add(name)
                if name in 'bce':
                    all_three.wait(harness.PATIENCE)
                else:
                    time.sleep(0.3)
                seen.append(set(running))
                running.discard(name)

            one = types.SimpleNamespace(name=name, is_wide=name in 'ad')
            return types.SimpleNamespace(run=one, do=do)

        found = [one.run.name for one in work._side_by_side(list(map(job, 'abcde')), 3, '1G', [])]
        self.assertEqual((sorted(found[:3]), sorted(found[3:])), (list('bce'), list('ad')))
        self.assertEqual((seen[0], seen[3:]), ({'b', 'c', 'e'}, [{'a'}, {'d'}]))


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
        for one in trees:
            one.end(0.5)
        self.assertTrue(harness.wait_until(lambda: all(one.is_gone() for one in trees)))
        self.assertEqual(
            [one._process.returncode for one in trees],
            [-signal.SIGINT, -signal.SIGKILL, -signal.SIGKILL],
        )

    def test_another_signal(self):
        """Kills at once what has not ended by the first."""
        one, came = tree.Tree(['sh', '-c', 'trap "" INT; echo; sleep 1000 & wait']), [signal.SIGINT]
        self.assertTrue(harness.wait_until(lambda: len(one._members()) == 2))
        threading.Timer(0.5, came.append, [signal.SIGINT]).start()
        one.end(1000.0, came)
        self.assertEqual(one._process.returncode, -signal.SIGKILL)


class Ports(unittest.TestCase):
    def test_one_each(self):
        """Free ones, and not those of other programs."""
        with open('/proc/sys/net/ipv4/ip_local_port_range') as file:
            low, high = map(int, file.read().split())
        ports = [ranks.free_port() for _ in range(100)]
        self.assertEqual(len(set(ports)), 100)
        self.assertFalse([port for port in ports if low <= port <= high])
        with socket.socket() as taken:
            ahead = next(ranks.PORTS)
            taken.bind(('', ahead))
            with mock.patch.object(ranks, 'PORTS', itertools.chain([ahead], ranks.PORTS)):
                self.assertNotEqual(ranks.free_port(), ahead)


class Log(InFolder):
    def test_last_words(self):
        for lines, said in (
            (['[ INFO] a', '[FATAL] [1.5]: b', '\033[31m[ERROR] c\033[0m', 'd'], '[ERROR] c; '),
            (
                ['[x/hdlyap-1] process has died [pid 7, exit code -9, cmd /a b].'],
                'process has died [pid 7, exit code -9]; ',
            ),
            (['process has finished cleanly'], ''),
        ):
            self.write('log', '\n'.join(lines))
            self.assertEqual(work.last_words(self.path('log')), said)
