"""Parameters as ROS hands them on: types of the parameter server, lists of the command line, scenes
that are started. What each may be is tested without nodes, in test_refusals.cpp."""

import os
import re
import socketserver
import subprocess
import tempfile
import threading
import xmlrpc.client
import xmlrpc.server

import rosgraph
import rospy
import yaml

import harness
from harness import SHORT

pytestmark = harness.UNDER_A_MASTER

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../launch/scenes')
HEARD = dict(wait_for_subscribers=['run_info'])
# what a scene file cannot say, or says in another type
REFUSED = [
    ('density', float('nan')),
    ('duration', float('inf')),
    ('warmup', True),
    ('seed', 1.0),
    ('exponents', ['all']),
    ('observables', [[1]]),
    ('field_indices', [True]),
    ('interval', dict(auto=1)),
    ('scene', 'quick'),
]
ARGUMENTS = {
    'argument number=5: must be _parameter:=value': 'number=5',
    'observables = [fields, spectra]: must be a list out of ': '_observables:=[fields,spectra]',
    'seed = 12345678901: must be a string of digits, from "0" to "18446744073709551615"; with '
    'rosrun in two pairs of quotes, _seed:="\'..\'"': '_seed:=12345678901',
    'field_indices = [0]: must be steps or a list of integers from 1 to 37': '_field_indices:=[0]',
}
# by run.launch
HANDED_OVER = {
    'a.yaml: line 1: must be a list of parameters': dict(scene='seed', file='a.yaml'),
    'particles = cubes: must be disks or spheres or ': dict(
        scene='particles: spheres', arguments='particles:=cubes'
    ),
    'params: line 1: seed = 012: must be a number in': dict(params='{seed: 012}'),
    'params: line 1: warmup=5 = : must be a value': dict(params='{warmup=5}'),
    'report_interval = 7: must be 8, which params says': dict(
        params='{report_interval: 8}', arguments='warmup:=\nreport_interval:=7'
    ),
}
TAKEN = dict(
    scene='mine',
    number=30,
    density=0.6,
    aspect=0.5,
    boundary_x='reflecting',
    boundary_y='periodic',
    seed='12345678901234',
    exponents='7',
    equilibration=0.5,
    warmup=0.75,
    duration=2.0,
    target='smallest 1.0e-6',
    interval=0.5,
    accuracy=1.0e-7,
    report_interval=0.25,
    max_mode_number=1,
    observables=['spectrum', 'modes', 'state'],
    threads=1,
    pace=1.0e3,
    checkpoint_interval=5.0,
    wait_for_subscribers=['run_info', 'state'],
)


# in a file and after _name:=
SPELLINGS = dict(
    scene="'on'",
    number='+20',
    density='.7',
    aspect='1.',
    seed="'12345678901'",
    equilibration='1e0',
    warmup='1.0e0',
    duration='2',
    report_interval='2.5e-1',
    pace='1.5e+3',
    accuracy="'1e-7'",
    exponents='08',
    observables="[spectrum, 'state']",
)
# what a file must not have: to YAML 1.1 it is another number, or nothing that XML-RPC carries
MISREAD = [
    ('seed', '010'),
    ('seed', '12345678901'),
    ('duration', '-12345678901'),
    ('number', '0x14'),
    ('number', '0b11'),
    ('number', '1_000'),
    ('warmup', '1:30'),
    ('warmup', '1:30.5'),
    ('pace', '1_0.5'),
    ('pace', '.5_0'),
    ('scene', '2026-01-01'),
    ('scene', 'deg(180)'),
    ('scene', ''),
]


def handed_over(**texts):
    """What run.launch gives the node."""
    return dict(launch=dict(dict(arguments=''), **texts))


class SlowMaster(socketserver.ThreadingMixIn, xmlrpc.server.SimpleXMLRPCServer):
    """Asks the master what it is asked; a node's parameters are written when `may_write` is set."""

    daemon_threads = True  # roscpp keeps its connections

    def __init__(self, may_write):
        super().__init__(('localhost', 0), logRequests=False, allow_none=True)
        self.uri, self.may_write = 'http://localhost:%d' % self.server_address[1], may_write
        self.thread = threading.Thread(target=self.serve_forever)
        self.thread.start()

    def _dispatch(self, method, params):
        if method == 'setParam' and params[0] != '/harness':
            self.may_write.wait()
        with xmlrpc.client.ServerProxy(rosgraph.get_master_uri()) as master:
            return getattr(master, method)(*params)

    def end(self):
        self.may_write.set()
        self.shutdown()
        self.thread.join()
        self.server_close()


class Parameters(harness.Case):
    def test_refused(self):
        """In one line, before anything happens."""
        nodes = {
            name
            + ' = ': self.start(
                {name: value} if name == 'scene' else dict(SHORT, **{name: value}),
                name='refused_' + name,
            )
            for name, value in REFUSED
        }
        for k, (line, argument) in enumerate(ARGUMENTS.items()):
            nodes[line] = self.start(SHORT, name='refused_%d' % k, args=[argument])
        for k, (line, texts) in enumerate(HANDED_OVER.items()):
            nodes[line] = self.start(handed_over(**texts), name='refused_text_%d' % k)
        for line, node in nodes.items():
            with self.subTest(line=line):
                self.ends(node, 2)
                self.assertEqual(len(node.text().splitlines()), 1, node.text())
                self.assertRegex(
                    node.text(), r'\[FATAL\] \[[0-9.]+\]: %s.*must be ' % re.escape(line[:16])
                )
                self.assertIn(line, node.text())
        # the master remembers the type of every topic that was ever advertised
        types = dict(rosgraph.Master('/test').getTopicTypes())
        self.assertEqual([topic for topic in types if topic.startswith('/refused')], [])

    def test_too_many_disks(self):
        """Known before the first block is asked for: how much, how much there is, what fits."""
        for disks in (40000, 1000000):
            with self.subTest(disks=disks):
                node = self.start(dict(number=disks))
                self.ends(node, 3)
                self.assertEqual(len(node.text().splitlines()), 1, node.text())
                self.assertRegex(
                    node.text(),
                    rf'out of memory: number = {disks} with {2 * disks - 3} exponents need \S+ GB, '
                    r'there are \S+ GB \(\w+\); exponents = \d+ would fit, or number = \d+',
                )

    def told(self, node, info):
        """run_info, and that the node ends well."""
        self.assertTrue(info.wait_for(lambda message: True), node.text())
        if node.running():
            self.interrupt(node)
        info.close()
        return info.messages[0]

    def test_taken(self):
        """And what is below the node's name on the parameter server stays what was set there."""
        info, _ = self.listen('run_info'), self.listen('state')
        node = self.runs(TAKEN)
        self.assertEqual(rospy.get_param('/hdlyap'), TAKEN)
        message = self.told(node, info)
        for name, value in TAKEN.items():
            self.assertEqual(getattr(message, name), value, name)

    def test_what_differs_is_named(self):
        """With where it came from: from the server what was left there; numbers and lists that are
        written otherwise do not differ."""
        left = dict(SHORT, duration=2, report_interval=3, observables='[gas,spectrum]', seed=7)
        scene = 'number: 20\nwarmup: 2\naspect: 1\nobservables: [gas, spectrum]\n'
        launch = handed_over(scene=scene, file='a.yaml', params='{pace: 100}')
        server = 'number = 20, density = 0.7, aspect = 1, seed = 7, equilibration = 1, warmup = 1'
        server += ', duration = 2, report_interval = 3, observables = [gas, spectrum]'
        arguments = ['_seed:=7', '_density:=0.6', 'particles:=spheres', 'energy:=high']
        for launched, args, said in (
            ({}, [], [f'the parameter server, unlike the defaults: {server}']),
            (
                launch,
                arguments,
                [
                    'the arguments, unlike a.yaml: density = 0.6, seed = 7, pace = 100',
                    'the parameter server, unlike a.yaml: equilibration = 1, warmup = 1, '
                    'duration = 2, report_interval = 3',
                ],
            ),
        ):
            node = self.runs(dict(left, **launched), args=args)
            found = [line.split('from ', 1)[1] for line in node.lines('unlike ')]
            self.assertEqual([line.replace('\x1b[0m', '') for line in found], said)
        for argument in arguments[2:]:
            said = (
                f'argument {argument} renames a topic and sets no parameter: is _{argument} meant'
            )
            self.assertEqual(len(node.lines(said)), 1, node.text())

    def test_written_by_a_run_that_ends_at_once(self):
        """Also if the master takes longer than the run; if it does not answer, a line says so."""
        for answers in (True, False):
            may_write = threading.Event()
            master = SlowMaster(may_write)
            self.addCleanup(master.end)
            text = '\n'.join('%s:=%s' % one for one in SHORT.items())
            node = self.start(handed_over(arguments=text), ROS_MASTER_URI=master.uri)
            self.sees(lambda: node.lines('finished at simulated time'), node)
            if answers:
                may_write.set()
            self.ends(node)
            said = node.lines('are not written to the parameter server')
            self.assertEqual(len(said), int(not answers), node.text())
            if answers:
                self.assertEqual(rospy.get_param('/hdlyap'), dict(SHORT))
            else:
                self.assertIn(f'{len(SHORT)} parameters', said[0])

    def test_lists_on_the_command_line(self):
        info = self.listen('run_info')
        args = ['_observables:=[fields, state]', '_field_indices:=[1, 7]']
        message = self.told(self.start(dict(SHORT, **HEARD), args=args), info)
        self.assertEqual(
            (message.observables, message.field_indices), (['fields', 'state'], '[1, 7]')
        )

    def checked(self, text, *arguments):
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
            file.write(text)
            file.flush()
            return subprocess.run(
                [harness.executable(), '--check', file.name, *arguments],
                text=True,
                capture_output=True,
                timeout=harness.PATIENCE,
            )

    def test_one_reading(self):
        """Of a file by --check and by a run, and of _name:=value."""
        text = ''.join(f'{name}: {value}\n' for name, value in SPELLINGS.items())
        done = self.checked(text)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn(
            'scene     on is valid: 20 disks in 5.34522 x 5.34522, packing fraction 0.55, 8 vect',
            done.stdout,
        )
        soft = 'particles: soft_disks\nnumber: 36\ndensity: 0.5\naspect: 1\ntime_step: '
        for step, said in (('0.003', '0.003'), ('0', r'0\.00\d+')):
            self.assertRegex(
                self.checked(soft + step).stdout,
                'is valid: 36 soft_disks in 8.48528 x 8.48528, potential wca, energy 1, '
                f'time_step {said}, integrator verlet, 69 vectors',
            )
        given = [f'_{name}:={value}' for name, value in SPELLINGS.items()]
        said = [
            self.told(self.start(dict(params, **HEARD), args=args), self.listen('run_info'))
            for params, args in ((handed_over(scene=text), []), ({}, given))
        ]
        for name in SPELLINGS:
            self.assertEqual(getattr(said[0], name), getattr(said[1], name), name)
        self.assertEqual((said[0].seed, said[0].duration), ('12345678901', 2.0))

    def test_misread(self):
        """Refused by name."""
        for name, value in MISREAD:
            with self.subTest(name=name, value=value):
                done = self.checked(f'aspect: 1.0\n{name}: {value}\n')
                self.assertEqual((done.returncode, done.stdout), (2, ''))
                self.assertRegex(
                    done.stderr, re.escape(f': line 2: {name} = {value}: must be ') + '.+$'
                )

    def test_arguments_of_check(self):
        """Are no YAML, as those of rosrun and roslaunch are not."""
        done = self.checked('aspect: 1.0', 'number:=010', 'seed:=12345678901')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn('10 disks', done.stdout)

    def test_name_of_a_scene(self):
        """Is gone once its system is changed, but not a name that the user gives."""
        text = 'scene: mine\nnumber: 20\naspect: 1.0\ndensity: 0.5\nexponents: none\npace: 1.0\n'
        text += 'equilibration: 0.0\nobservables: [state]\n'
        for arguments, name in (
            ('number:=20\nduration:=5', 'mine'),
            ('number:=30', 'unnamed'),
            ('number:=30\nscene:=other', 'other'),
        ):
            given = handed_over(scene=text, file='/no/mine.yaml', arguments=arguments)
            node = self.start({**given, **HEARD})
            self.assertEqual(self.told(node, self.listen('run_info')).scene, name)
            node.stop()

    def test_what_no_observable_needs(self):
        """Of a scene's file is left out if the user asks for other observables, not otherwise."""
        text = 'number: 20\naspect: 1.0\ndensity: 0.5\nmax_mode_number: 2\npace: 1.0\n'
        for observables, asked, status in (('modes', '[spectrum]', 0), ('spectrum', '', 2)):
            given = handed_over(
                scene=text + f'observables: [{observables}]\n',
                file='/no/mine.yaml',
                arguments=f'observables:={asked}',
            )
            node = self.start({**given, **HEARD})
            if status:
                self.assertEqual(node.wait(), status)
                self.assertIn('max_mode_number = 2: must be 0 without', node.text())
                continue
            self.assertEqual(self.told(node, self.listen('run_info')).max_mode_number, 0)
            self.assertTrue(node.lines('max_mode_number of the scene is left out'))
            (rest,) = node.lines('the rest is of /no/mine.yaml: ')
            self.assertNotIn('max_mode_number', rest)
            node.stop()

    def test_scenes(self):
        """Some of them start as they are written; without parameters it is paper_periodic."""
        for scene, vectors in dict(quick=197, trajectory_only=0, paper_periodic=1557).items():
            with self.subTest(scene=scene):
                params = {}
                if scene != 'paper_periodic':
                    with open(os.path.join(SCENES, scene + '.yaml')) as file:
                        params = yaml.safe_load(file)
                message = self.told(self.start(dict(params, **HEARD)), self.listen('run_info'))
                self.assertEqual((message.scene, message.vectors), (scene, vectors))
                for name, value in params.items():
                    self.assertEqual(str(getattr(message, name)), str(value), name)
                self.assertAlmostEqual(
                    message.box_x * message.box_y * message.density, message.number
                )

    def test_without_a_master(self):
        env = dict(os.environ, ROS_MASTER_URI='http://localhost:1')
        for argument, said in (
            ('--help', 'Exit status: 0 finished or stopped, 2 refused'),
            ('--version', r'^hdlyap \d+\.\d+\.\d+$'),
            ('--parameters', '(?m)^number: 780$'),
        ):
            done = subprocess.run(
                [harness.executable(), argument],
                env=env,
                timeout=harness.PATIENCE,
                text=True,
                capture_output=True,
            )
            self.assertEqual((done.returncode, done.stderr), (0, ''))
            self.assertRegex(done.stdout.strip(), said)
