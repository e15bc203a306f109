"""Launch files: launching records whole runs."""

import os
import re
import signal
import tempfile
from xml.etree import ElementTree

import rosbag
import roslaunch.config
import rospkg
import rospy

import harness
from hdlyap import parameters
from hdlyap.msg import RunStatus

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')


class Launch(harness.Case):
    def roslaunch(self, folder, *args):
        return self.process(['roslaunch', 'hdlyap', *args], PWD=folder)

    def test_record_and_replay(self):
        """A bag of the same name is kept; the launch ends by itself, with the result of the run."""
        seed = '18446744073709551615'
        with tempfile.TemporaryDirectory(prefix="o'brien's runs ") as folder:
            with open(os.path.join(folder, 'q.bag'), 'w') as file:
                file.write('of a year')
            kept = os.path.join(folder, 'kept')
            args = ['scene:=quick', 'duration:=30', 'seed:=' + seed, 'checkpoint:=' + kept]
            run = self.roslaunch(folder, 'run.launch', *args, 'record:=true', 'bag:=q.bag')
            self.ends(run)
            bag = os.path.join(folder, 'q.bag')
            with rosbag.Bag(bag) as file:
                (info,) = (message for _, message, _ in file.read_messages('/hdlyap/run_info'))
                self.assertEqual(file.get_message_count('/hdlyap/state'), 70)
            wanted = dict(seed=seed, duration=30.0, number=100)
            self.assertLessEqual(wanted.items(), parameters.all_of(info).items())
            self.check_result(run, 30, 'the bag is ' + bag, 'the checkpoint is ' + kept)
            self.assertIn("Recording to '" + bag, run.text())
            self.assertNotIn('Subscribing to', run.text())
            self.assertEqual(sorted(os.listdir(folder)), ['kept', 'q.bag', 'q.bag.old'])
            self.assertEqual(len(run.lines('q.bag was there already')), 1, run.text())
            with open(bag + '.old') as file:
                self.assertEqual(file.read(), 'of a year')
            status = self.listen('status')
            replay = self.roslaunch(folder, 'replay.launch', 'bag:=' + bag, 'pace:=20')
            self.assertTrue(status.wait_for(harness.is_last))
            self.ends(replay)

    def test_no_folder_for_a_bag(self):
        run = self.roslaunch('.', 'run.launch', 'record:=true', 'bag:=nowhere/q.bag')
        run.wait()
        self.assertEqual(len(run.lines('must be in a folder that is there')), 1, run.text())
        self.assertEqual(run.lines('Recording to'), [])
        self.assertNotIn('the bag is', run.text())

    def check_result(self, run, averaged, *words):
        """Is printed last."""
        result = run.text().split('result: ')[-1]
        self.assertRegex(result, r'averaged %s.* time units, lambda_max [0-9.]+' % averaged)
        self.assertRegex(result, r' T\(1,0\) .* [0-9.]+')
        self.assertRegex(result, r' c_T  [0-9.()]+(, misfit [0-9.]+)? over \d+ wave number')
        for word in words:
            self.assertIn(word, result)

    def test_resumed_alone(self):
        """With the scene of the checkpoint; in a namespace node and recorder meet."""
        args = ['__ns:=grp', 'checkpoint:=q.checkpoint', 'name:=kept', 'table:=0']
        recorded = ['resume:=q.checkpoint', 'duration:=10', 'record:=true', 'bag:=q.bag']
        with tempfile.TemporaryDirectory() as folder:
            first = self.roslaunch(folder, 'run.launch', 'scene:=quick', 'duration:=5', *args)
            self.ends(first)
            self.assertEqual(len(first.lines('finished at simulated time 45')), 1, first.text())
            more = self.roslaunch(folder, 'run.launch', *recorded, *args[:-1])  # the table, too
            self.ends(more)
            self.assertEqual(len(more.lines('scene quick: 100 disks')), 1, more.text())
            self.assertEqual(len(more.lines('finished at simulated time 50')), 1, more.text())
            self.assertEqual(more.lines('averaged'), [])
            with rosbag.Bag(os.path.join(folder, 'q.bag')) as bag:
                self.assertIn('/grp/kept/steps', bag.get_type_and_topic_info()[1])

    def test_refused_before_anything_starts(self):
        """In one line: what roslaunch ignores, or dies of in many lines."""
        refused = {
            'densty:=0.5': 'densty = 0.5: no such argument; is density meant?',
            'boundary:=reflecting': 'boundary = reflecting: no such argument; is boundary_x meant?',
            'warmup:=5': 'warmup = 5: must be in params:="{warmup: ..}", as run.launch has no',
            'density=0.5': 'density=0.5: must be density:=0.5\n',
            'density': 'density: must be density:=..\n',
            'xyz:=5': 'xyz = 5: no such argument\n',
            'bond:=0.5': 'bond = 0.5: must be in params:="{bond: ..}", as run.launch has no',
            'file:=5': 'file = 5: no such argument',
            'scene:=quikc': 'scene = quikc: must be one of circle, circle_quick, covariant, ',
            'scene:=no.yaml': 'scene = no.yaml: must be a YAML file of parameters: ',
            'package:=nowhere': 'package = nowhere: must be a package that ROS finds\n',
            'program:=nothing': 'program = nothing: must be a program of the package hdlyap\n',
            'seed:=7\ndensity:=0.5': 'seed = 7 density:=0.5: must be one line without :=\n',
        }
        for word, said in refused.items():
            for begin in (['launch'], ['run', 'quick', '--out', 'no.bag']):
                if begin[0] == 'run' and (word.startswith('scene') or ':=' not in word):
                    continue
                with self.subTest(word=word, begin=begin):
                    done = self.process([*harness.command(begin[0]), *begin[1:], word])
                    self.assertEqual(done.wait(), 2, done.text())
                    self.assertTrue(done.text().startswith(f'hdlyap {begin[0]}: {said}'))
                    self.assertEqual(len(done.text().splitlines()), 1, done.text())

    def test_launch(self):
        """What is right is handed on, as remappings are; relative paths too."""
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'mine.yaml'), 'w') as file:
                file.write('number: 20\naspect: 1.0\nduration: 2\nequilibration: 1\nwarmup: 1\n')
            words = ['scene:=mine.yaml', 'density:=0.5', 'params:={accuracy: 1e-7}', '__ns:=grp']
            run = self.process([*harness.command('launch'), *words], PWD=folder)
            self.ends(run, 0, 'scene unnamed: 20 disks in 6.32456 x 6.32456')
            differs = f'unlike {folder}/mine.yaml: density = 0.5, accuracy = 1e-7'
            self.assertIn('from the arguments, ' + differs, run.text())
            rest = 'number = 20, aspect = 1, equilibration = 1, warmup = 1, duration = 2'
            self.assertIn(f'the rest is of {folder}/mine.yaml: {rest}', run.text())
        given = dict(scene='mine', number=20, aspect=1.0, duration=2, equilibration=1, warmup=1)
        given.update(density=0.5, accuracy='1e-7', table=3)
        self.assertEqual(rospy.get_param('/grp/hdlyap'), given)

    def both_ways(self, text, *words):
        """(process, path of the bag) of roslaunch, and of `hdlyap run`, once it has ended, with a
        scene file of this text."""
        for command in (
            'roslaunch hdlyap run.launch record:=true scene:=%s bag:=%s',
            'hdlyap run %s --out %s',
        ):
            folder = self.new_folder()
            scene, bag = os.path.join(folder, 'mine.yaml'), os.path.join(folder, 'q.bag')
            with open(scene, 'w') as file:
                file.write('number: 20\naspect: 1.0\nequilibration: 1\nwarmup: 1\nduration: 2\n')
                file.write(text)
            run = self.process([*(command % (scene, bag)).split(), *words])
            run.wait()
            yield run, bag

    def test_the_node_reads_the_scene(self):
        """And what is given on top of it: what --check refuses is refused, and two values of a
        parameter. No bag is begun."""
        for text, words, said in (
            (
                'seed: 012\n',
                (),
                'mine.yaml: line 6: seed = 012: must be a number in decimal digits',
            ),
            ('', ('number:=5', 'params:={number: 6}'), 'number = 5: must be 6, which params says'),
        ):
            for run, bag in self.both_ways(text, *words):
                with self.subTest(said=said, command=run.process.args):
                    self.assertEqual(len(run.lines('FATAL')), 1, run.text())
                    self.assertEqual(len(run.lines(said)), 1, run.text())
                    self.assertFalse(os.path.exists(bag))
                    self.assertFalse(rospy.has_param('/hdlyap/launch'))

    def test_scenes_that_say_little_or_what_nothing_carries(self):
        path = os.path.join(self.new_folder(), 'mine.yaml')
        for text, status, said in (
            ('exponents: none\nduration: 1\nequilibration: 1\n', 0, 'scene mine: 780 disks in '),
            ('number: 20\x01\n', 2, f'hdlyap launch: scene = {path}: must be a YAML file of '),
        ):
            with self.subTest(text=text):
                with open(path, 'w') as file:
                    file.write(text)
                run = self.process([*harness.command('launch'), 'scene:=' + path])
                self.assertEqual(run.wait(), status, run.text())
                self.assertEqual(len(run.lines(said)), 1, run.text())

    def test_what_a_scene_says_holds(self):
        for run, path in self.both_ways('table: 0.0\n'):
            with self.subTest(command=run.process.args):
                with rosbag.Bag(path) as bag:
                    ((_, info, _),) = bag.read_messages('/hdlyap/run_info')
                self.assertIn('table=0', info.given)
                self.assertEqual(run.lines('result: '), [])

    def test_arguments_that_are_parameters(self):
        """All of them are handed over."""
        named = ElementTree.parse(os.path.join(LAUNCH, 'run.launch')).getroot().findall('arg')
        named = [one.get('name') for one in named if 'parameter of this name' in one.get('doc')]
        words = [f'{name}:=/{name}' for name in named]
        config = roslaunch.config.load_config_default(
            [(os.path.join(LAUNCH, 'run.launch'), ['scene:=quick', *words])], 0
        )
        lines = config.params['/hdlyap/launch/arguments'].value.split('\n')
        self.assertEqual(sorted(lines), sorted(words))
        self.assertLessEqual(set(named), set(harness.defaults()))

    def test_contradictions(self):
        """What is given twice, with two meanings, is refused before anything starts."""
        run = ['run', 'quick', '--out', 'o.bag']
        refused = {
            (*run, 'scene:=dense'): 'scene = dense: must be quick, which is given too',
            (*run, 'bag:=o2.bag'): 'bag = o2.bag: must be o.bag, which is given too',
            (*run, 'record:=false'): 'record = false: must be true, which is given too',
            ('launch', 'number:=5', 'number:=6'): 'number = 6: must be 5, which is given too',
        }
        with tempfile.TemporaryDirectory() as folder:
            for words, said in refused.items():
                with self.subTest(words=words):
                    done = self.process([*harness.command(words[0]), *words[1:]], PWD=folder)
                    self.assertEqual(done.wait(), 2, done.text())
                    self.assertEqual(done.text(), f'hdlyap {words[0]}: {said}\n')
            self.assertEqual(os.listdir(folder), [])
        of_two = self.process([*harness.command('run'), *run[1:], 'ranks:=3'], PMI_SIZE='2')
        self.ends(of_two, 2, 'hdlyap run: ranks = 3: must be 1, as there are 2 already')

    def test_all_ranks_start_the_same_program(self):
        """Those above 0 too, whose node is not hdlyap's."""
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'package.xml'), 'w') as file:
                file.write('<package><name>mine</name></package>')
            path = os.path.join(folder, 'chain')
            with open(path, 'w') as file:
                file.write('#!/bin/sh\necho it is mine\n')
            os.chmod(path, 0o755)
            words = ['quick', '--out', os.path.join(folder, 'o.bag')]
            words += ['package:=mine', 'program:=chain']
            packages = {'ROS_PACKAGE_PATH': f'{folder}:{os.environ["ROS_PACKAGE_PATH"]}'}
            one = self.process([*harness.command('run'), *words], PMIX_RANK='1', **packages)
            self.ends(one)
            self.assertEqual(one.text(), 'it is mine\n')

    def test_more_ranks_than_cores(self):
        """One core is what mpirun takes this machine to have."""
        run = self.launch(
            'ranks:=2',
            'duration:=2',
            'threads:=1',
            name='slow',
            OMPI_MCA_orte_set_default_slots='1',
        )
        self.ends(run, 0, 'finished at simulated time 4')

    def launch(self, *words, name, **env):
        """`hdlyap launch` of a small scene, with a node of this name."""
        params = '{equilibration: 1, warmup: 1}'
        words = [f'name:={name}', f'params:={params}', 'number:=20', 'aspect:=1.0', *words]
        return self.process([*harness.command('launch'), *words], **env)

    def test_status(self):
        """Is that of the node, or of the recorder if that ends the launch."""
        for k, (words, status) in enumerate(
            (
                (['duration:=2'], 0),
                (['density:=2.5'], 2),
                (['resume:=nowhere'], 4),
                (['record:=true', 'bag:=nowhere/q.bag'], 2),
                (['required:=maybe'], 1),
            )
        ):
            with self.subTest(words=words):
                self.ends(self.launch(*words, name=f'status_{k}'), status)

    def test_status_after_a_signal(self):
        """130 after Ctrl-C, once the node has ended in order; 137 if the node was killed."""
        for k, (whom, number, status, said) in enumerate(
            (
                ('launch', signal.SIGINT, 130, 'stopped at simulated time'),
                ('launch', signal.SIGTERM, 143, 'stopped at simulated time'),
                ('node', signal.SIGKILL, 137, 'exit code -9'),
            )
        ):
            name = f'signal_{k}'
            launch = self.launch('duration:=1e6', name=name)
            rospy.wait_for_message(f'/{name}/status', RunStatus, harness.PATIENCE)
            (pid,) = re.findall(rf'process\[{name}-1\]: started with pid \[(\d+)\]', launch.text())
            pid = launch.process.pid if whom == 'launch' else int(pid)
            os.kill(pid, number)
            self.ends(launch, status, said)

    def replayed(self, *args):
        """Type of a node of replay.launch, or its command -> its arguments."""
        config = roslaunch.config.load_config_default(
            [(os.path.join(LAUNCH, 'replay.launch'), ['bag:=q.bag', *args])], 0
        )
        of_ours = {
            node.args.split()[0]: node.args for node in config.nodes if node.type == 'hdlyap'
        }
        return {**of_ours, **{node.type: node.args for node in config.nodes}}

    def test_replay_in_rviz_stays(self):
        self.assertNotIn('--keep-alive', self.replayed()['replay'])
        looked_at = self.replayed('rviz:=true', 'node:=/other')
        self.assertIn('--keep-alive', looked_at['replay'])
        self.assertIn('--lead=10', looked_at['replay'])
        self.assertEqual(looked_at['view'], 'view --node /other')
        self.assertIn('viewer', looked_at)
        self.assertNotIn('viewer', self.replayed('rviz:=true', 'viewer:=false'))
        self.assertNotIn('view', self.replayed('viewer:=true'))
        self.assertIn('--pace=1.0', self.replayed()['replay'])
        self.assertIn('--pace=2.5', self.replayed('pace:=2.5')['replay'])

    def test_what_is_refused_ends_the_launch(self):
        """With one line of what is wrong; no bag is touched."""
        refused = {
            'duration:=-1': 'duration = -1: must be from 0',
            'min_space:=99999999G': 'less than min_space = 99999999G is free in '
            + tempfile.gettempdir(),
            'params:={disk: 50}': 'disk = 50: no such parameter',
        }
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'q.bag'), 'w') as file:
                file.write('of a year')
            record = ['record:=true', 'bag:=q.bag']
            runs = {
                argument: self.roslaunch(folder, 'run.launch', argument, 'name:=no_%d' % k, *record)
                for k, argument in enumerate(refused)
            }
            for argument, run in runs.items():
                with self.subTest(argument=argument):
                    run.wait()
                    self.assertEqual(len(run.lines('FATAL')), 1, run.text())
                    self.assertEqual(len(run.lines(refused[argument])), 1, run.text())
                    self.assertEqual(len(run.lines('exit code 2')), 1, run.text())
                    self.assertNotIn('<param', run.text())
            self.assertEqual(os.listdir(folder), ['q.bag'])
