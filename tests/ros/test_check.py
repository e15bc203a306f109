"""hdlyap_node --check: what it says of a scene file is what the node makes of it, in the same words
where it is refused."""

import os
import re
import subprocess
import tempfile

import rosbag
import yaml

import golden
import harness
from hdlyap.data import fields
from harness import MODES, OBSERVABLES
from hdlyap.runs.program import HDLYAP

pytestmark = harness.UNDER_A_MASTER

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../launch/scenes')
COVARIANT = dict(
    number=24,
    density=0.7,
    aspect=0.15,
    exponents='all',
    equilibration=5.0,
    warmup=20.0,
    duration=60.0,
    covariant_window=10.0,
    covariant_transient=20.0,
    covariant_sampling=0.5,
    observables=['covariant'],
)
LARGE_WINDOW = dict(
    number=4,
    exponents=2,
    observables=['covariant'],
    covariant_window=10000.0,
    covariant_transient=10000.0,
    covariant_sampling=1.0,
    covariant_memory=0.005,
    duration=0.0,
)
GOLDEN = 'spectrum modes steps lp_phases t_phases fields hydro structure covariant localization '
GOLDEN += 'fluctuations state'
EVERY_LINE = dict(
    COVARIANT,
    scene='golden',
    number=60,
    density=0.8,
    aspect=0.06,
    boundary_y='reflecting',
    duration=2000.0,
    fluctuation_time=1.0,  # auto depends on the interval, so on the machine
    report_interval=5.0,  # so that computing takes longer than recording, everywhere
    threads=1,
    observables=GOLDEN.split(),
)
NO_MASTER = dict(os.environ, ROS_MASTER_URI='http://localhost:1')


def checked(path, *replaced):
    return subprocess.run(
        [harness.executable(), '--check', path, *replaced],
        env=NO_MASTER,
        text=True,
        capture_output=True,
        timeout=harness.PATIENCE,
    )


def said_of(case, scene):
    """Of these parameters, in a file of a harness.Case."""
    path = os.path.join(case.new_folder(), 'scene.yaml')
    with open(path, 'w') as file:
        yaml.safe_dump(scene, file)
    return checked(path).stdout


def check_scenes(case, particles, count, number, *lines):
    """So many scenes are of such particles. Each is valid, says nothing that it need not, and
    --check of it has the lines."""
    usual, found = HDLYAP.completed({'particles': particles}), 0
    for name in sorted(os.listdir(SCENES)):
        path = os.path.join(SCENES, name)
        with open(path) as file:
            scene = yaml.safe_load(file)
        if scene.pop('particles', 'disks') != particles:
            continue
        case.assertEqual(scene.pop('scene') + '.yaml', name)
        case.assertEqual({key for key in scene if scene[key] == usual[key]}, set())
        said = checked(path, f'number:={number}').stdout
        case.assertIn(f'is valid: {number} {particles} in ', said)
        for line in lines:
            case.assertRegex(said, line)
        found += 1
    case.assertEqual(found, count)


def said_by_node(node):
    return re.sub(r'^.*?\]: ', '', re.sub(r'\x1b\[\d*m', '', node.text().strip()))


def in_bag(topic, messages):
    """Bytes that they take in a bag, beside those of any bag."""
    sizes = []
    with tempfile.TemporaryDirectory() as folder:
        for times in (1, 2):
            path = os.path.join(folder, '%d.bag' % times)
            with rosbag.Bag(path, 'w') as bag:
                for message in messages * times:
                    bag.write('/hdlyap/' + topic, message, message.header.stamp)
            sizes.append(os.path.getsize(path))
    return sizes[1] - sizes[0]


def shares(said):
    """Bytes of each topic that come with reports, with fields and with windows."""
    found = [{}, {}, {}]
    for unit, every, text in re.findall(r'(kB|MB) (a report|every .* units): (.*)', said):
        of = found[0 if unit == 'kB' else 2 if 'covariant' in text else 1]
        for topic, size in (share.split() for share in text.split(', ')):
            of[topic] = float(size) * dict(kB=1e3, MB=1e6)[unit]
    return found


def means_of(message):
    """What comes where fields are due."""
    described = fields.of(message).items()
    return [getattr(message, name) for name, field in described if '@fields' in field.only]


class Check(harness.Case):
    def file_of(self, params):
        with tempfile.NamedTemporaryFile('w', suffix='.yaml', delete=False) as file:
            self.addCleanup(os.unlink, file.name)
            file.write(params if isinstance(params, str) else yaml.safe_dump(params))
        return file.name

    def test_whole(self):
        """But for what a machine is and does in a second."""
        done = checked(self.file_of(EVERY_LINE))
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        memory = float(re.search(r'memory +(\S+) GB', done.stdout).group(1))
        self.assertAlmostEqual(memory, 0.0101, delta=0.0005)  # of one compiler and another
        said = re.sub(r'(memory +)\S+', r'\1#', done.stdout)
        said = re.sub(r'(there are) \S+ GB \(\w+\)', r'\1 # GB', said)
        said = re.sub(r'interval \S+;', 'interval #;', said)
        said = re.sub(r'\S+ GB an hour', '# GB an hour', said)
        golden.check(self, 'check.txt', re.sub(r'[\d.e+-]+ (s|min|h)\b', '# s', said))

    def test_target(self):
        """Four times as late if it is to be half as large; beyond the duration it says so."""
        after = []
        for target in ('lambda_max 0.2%', 'lambda_max 0.1%'):
            said = checked(self.file_of(dict(MODES, target=target))).stdout
            pattern = (
                rf'(?m)^target    {target}\n +reached after some (\S+) time units .*\n +The dur'
            )
            self.assertRegex(said, pattern)
            after.append(float(re.search(pattern, said).group(1)))
        self.assertAlmostEqual(after[1] / after[0], 4.0, delta=2.0)  # two trials of a second

    def test_what_averaging_does_not_take_away(self):
        """Walls 8.66 apart, k = 0.41: 2.89 % of both, 1.73 % of a step, 0.45 % of curvature."""
        params = dict(number=150, density=0.6, aspect=0.3, boundary_y='reflecting')
        file = self.file_of(params)
        done = checked(file)
        self.assertIn('\n          c_T has another error of about 3.4 %, due to', done.stdout)
        self.assertIn(f'scene     {os.path.basename(file)[:-5]} is valid: ', done.stdout)
        done = checked(self.file_of(dict(number=160, density=0.7, container='circle')))
        self.assertIn('\n          of c_T about 1 % from finite averaging after ', done.stdout)
        self.assertNotIn('c_L', done.stdout)

    def test_exponents_that_reach_no_step(self):
        """780 disks: 222 fields of waves up to 1.75 times (3,0) among the last of 1557."""
        said = (
            'warning   exponents = %d: none of them belongs to a step, which modes, steps, '
            'lp_phases need; at least 1336 exponents include a step, positive (1557) includes all\n'
        )
        scene = dict(observables=['spectrum', 'modes', 'steps', 'lp_phases'], duration=1.0)
        for exponents in (120, 1335, 1336):
            done = checked(self.file_of(dict(scene, exponents=exponents)))
            self.assertEqual(said % exponents in done.stdout, exponents < 1336)
            self.assertEqual('c_T' in done.stdout, exponents == 1336)
            self.assertEqual('waves  ' in done.stdout, exponents == 1336)
        sheared = dict(number=100, density=0.3, boundary_y='shearing', exponents=3)
        done = checked(self.file_of(dict(sheared, observables=['spectrum', 'steps'])))
        self.assertIn(' exponents include a step, all (400) includes all\n', done.stdout)
        for observables in (['spectrum'], ['structure', 'localization']):
            done = checked(self.file_of(dict(exponents=120, observables=observables)))
            self.assertNotIn('warning', done.stdout)
            self.assertNotIn('c_T', done.stdout)

    def test_parameters_without_effect(self):
        """A mass that no particle has."""
        said = 'warning   second_mass = 10 has no effect with the other parameters\n'
        alone = dict(number=16, density=0.5, observables=['spectrum'])
        for fraction, warned in ((0.0, True), (0.5, False)):
            file = self.file_of(dict(alone, second_fraction=fraction))
            self.assertEqual(said in checked(file, 'second_mass:=10').stdout, warned)
        both = checked(self.file_of(alone), 'second_mass:=10', 'second_diameter:=2').stdout
        self.assertRegex(both, 'warning   second_diameter = 2 has no .*; second_mass = 10 has no ')

    def test_places_that_are_kept(self):
        for density, said in ((0.87, False), (1.0, True)):
            done = checked(self.file_of(dict(number=16, density=density)))
            self.assertEqual('disks may keep their places at this density' in done.stdout, said)
        for density, said in ((0.74, False), (0.76, True)):
            done = checked(self.file_of(dict(number=16, density=density, particles='dumbbells')))
            self.assertEqual('dumbbells may keep their places' in done.stdout, said)

    def test_scenes(self):
        """With all kinds of stages; those that are large are made small."""
        for name in ('covariant', 'narrow', 'quick', 'trajectory_only'):
            with self.subTest(scene=name):
                done = checked(
                    os.path.join(SCENES, name + '.yaml'),
                    *(['number:=40'] if name != 'narrow' else []),
                )
                self.assertEqual((done.returncode, done.stderr), (0, ''))
                self.assertIn(f'scene     {name} is valid: ', done.stdout)
                for word in ('memory', 'speed', 'bag'):
                    self.assertRegex(done.stdout, rf'(?m)^{word} ')
                of_exponents = name != 'trajectory_only'
                self.assertEqual('errors ' in done.stdout, of_exponents)
                self.assertEqual('waves ' in done.stdout, of_exponents)

    @harness.SECOND_TIER
    def test_large(self):
        """An interval of the scene itself would take minutes."""
        done = checked(os.path.join(SCENES, 'quick.yaml'), 'number:=4000', 'max_wave_number:=0.12')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn('4000 disks', done.stdout)
        self.assertIn('by a trial of a second with 800 disks', done.stdout)
        self.assertRegex(done.stdout, r'(?m)^waves +T,LP\(1,0\) T,LP\(0,1\) T,LP\(1,1\)$')

    def run_of(self, params):
        """Its messages, and what is said of it before."""
        topics = [*params['observables'], 'cost']
        params = dict(params, wait_for_subscribers=['status', *topics])
        got = harness.whole_run(params, topics)
        return got, checked(self.file_of(params)).stdout

    def assert_near(self, said, true, delta=0.02):
        self.assertAlmostEqual(said / true, 1.0, delta=delta)

    def test_bag(self):
        """Of each topic, and of all, what a bag takes; every step that is found has a field."""
        params = dict(MODES, observables=OBSERVABLES, duration=40.0)
        got, said = self.run_of(params)
        steps = got['steps'][-1].steps
        report, fields, window = shares(said)
        self.assertEqual(set(report), set(got) - {'fields'})
        for topic in report:
            with self.subTest(topic=topic):
                of = [m for m in got[topic] if not any(map(len, means_of(m)))]
                self.assert_near(report[topic], in_bag(topic, of) / len(of))
        last = got['structure'][-1]
        self.assert_near(fields['structure'], 16 * len(last.along), delta=0.01)
        by_pairs = {field.pairs: in_bag('fields', [field]) for field in got['fields']}
        of_steps = [s.expected // 2 * (s.kind == s.LP) for s in steps if s.nx + s.ny > 0]
        self.assert_near(fields['fields'], sum(by_pairs[pairs] for pairs in of_steps))
        self.assertEqual(window, {})
        waves = re.search(r'(?m)^waves (.*)$', said).group(1).split()
        self.assertEqual(
            {tuple(map(int, re.search(r'\((\d+),(\d+)\)', wave).groups())) for wave in waves},
            {(s.nx, s.ny) for s in steps if s.nx + s.ny > 0},
        )

    def test_bag_of_covariant_vectors(self):
        got, said = self.run_of(COVARIANT)
        report, fields, window = shares(said)
        self.assertEqual((set(report), fields), ({'status', 'cost'}, {}))
        self.assert_near(
            window['covariant'], in_bag('covariant', got['covariant']) / len(got['covariant'])
        )

    def test_bag_in_all(self):
        """With what comes before the averaging."""
        observables = [topic for topic in OBSERVABLES if topic not in ('fields', 'structure')]
        got, said = self.run_of(dict(MODES, observables=observables))
        whole = sum(in_bag(topic, messages) for topic, messages in got.items())
        self.assert_near(1e6 * float(re.search(r'(\S+) MB in all', said).group(1)), whole)

    def test_speed(self):
        """Of the same order as a run's: the machine may be busy with one of the two."""
        params = dict(MODES, observables=['spectrum'], warmup=100.0, duration=100.0)
        said = checked(self.file_of(params), 'duration:=5e5').stdout  # of minutes
        seconds = float(re.search(r'(\S+) s per time unit', said).group(1))
        number, unit = re.search(r'(\S+) (s|min|h) of averaging', said).groups()
        whole = float(number) * dict(s=1, min=60, h=3600)[unit]
        self.assertAlmostEqual(whole / (5e5 * seconds), 1.0, delta=0.02)
        cost = harness.whole_run(dict(params, wait_for_subscribers=['cost']), ['cost'])['cost'][-1]
        taken = cost.wall_seconds / cost.sim_time
        self.assertTrue(0.1 < seconds / taken < 10.0, (seconds, taken))
        interval = (cost.sim_time - params['equilibration']) / cost.orthonormalisations
        self.assert_near(float(re.search(r'interval (\S+)\n', said).group(1)), interval, 0.3)

    def test_time_of_a_recorder(self):
        """It takes 960 reports a second: 200 time units of ten thousand each."""
        params = dict(MODES, observables=['gas'], exponents='none', duration=190.0, warmup=0.0)
        said = checked(self.file_of(dict(params, report_interval=1e-4))).stdout
        self.assertIn('; if recorded, in all at least 34.7 min', said)
        rare = dict(params, report_interval=100.0)
        self.assertNotIn('if recorded', checked(self.file_of(rare)).stdout)

    def test_refused_as_by_the_node(self):
        some = (
            dict(number=-1),
            dict(density=2.0, aspect='x'),
            dict(no_such=1),
            dict(observables=['spectrum', 'x']),
            dict(seed=1.5),
            dict(number=1000000),
            LARGE_WINDOW,
        )
        nodes = [self.start(params, name='refused_%d' % k) for k, params in enumerate(some)]
        numbers = re.compile(r'there are .*')  # memory goes up and down
        for node, params in zip(nodes, some):
            with self.subTest(params=params):
                done = checked(self.file_of(params))
                self.assertEqual((done.returncode, done.stdout), (node.wait(), ''))
                self.assertEqual(
                    numbers.sub('', done.stderr.strip()), numbers.sub('', said_by_node(node))
                )

    def test_refused_files(self):
        for text, said in (
            ('number: [1, {a: 2}]', 'line 1: a parameter must be a number, a word or a list'),
            ('- disks', 'must be a list of parameters, name: value'),
            ('number: 4\nseed: [1', 'line 2'),
        ):
            done = checked(self.file_of(text))
            self.assertEqual((done.returncode, done.stdout), (2, ''))
            self.assertIn(said, done.stderr)
        self.assertIn('there is no such file', checked('/no/such.yaml').stderr)
        done = checked(self.file_of(''), 'number=40')
        self.assertEqual(done.returncode, 2)
        self.assertIn('number=40: must be parameter:=value', done.stderr)
