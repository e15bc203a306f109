"""Sweeps and plans: which runs they consist of, their table and figure. How runs are done is
test_work.py's."""

import argparse
import contextlib
import csv
import io
import os
import re
import tempfile
import unittest
from unittest import mock
from math import nan

import numpy as np
import rospkg
import yaml

import hdlyap
import harness
import made
from harness import InFolder, Process
from made import LP, T
from hdlyap.commands import sweep
from hdlyap.data import space
from hdlyap.data.reader import RecordingError
from hdlyap.runs import run
from hdlyap.runs.program import HDLYAP, Program
from hdlyap.runs.scene import Refused
from hdlyap.sweep import figure, grid, plan, points, result, table

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
ERRORS = 'both errors of the means over seeds; the table above has the larger:'
CHI2 = 'chi^2/(seeds - 1)'
PLAN = os.path.join(LAUNCH, '../doc/reproduction/runs.yaml')


class Grid(unittest.TestCase):
    def runs(self, **given):
        usual = dict(scene='quick', threads='1', params='', observables='[spectrum]')
        return grid.runs({**usual, **given}, LAUNCH, '/')

    def test_without_errors(self):
        """One line for each scene that ends before, whatever its seeds; none with a target."""
        found = self.runs(numbers='20 24', seeds='1 2', duration='2')
        found += self.runs(numbers='30', duration='5000')
        found += self.runs(numbers='40', duration='0', params='{target: lambda_max 1%}')
        with tempfile.TemporaryDirectory() as folder:
            lines = list(sweep.warnings(found, folder))
        self.assertEqual(
            [line.split(':')[0] for line in lines],
            ['number_20_seed_1 will have no errors', 'number_24_seed_1 will have no errors'],
        )

    def test_refused_by_the_node(self):
        """Said before the first run, once for all seeds."""
        found = self.runs(numbers='20', densities='0.5 1.15', seeds='1 2', duration='5000')
        with tempfile.TemporaryDirectory() as folder:
            (line,) = sweep.warnings(found, folder)
        self.assertRegex(
            line, '^number_20_density_1_15_seed_1 will be refused: density = 1.15.*: must be'
        )

    def test_what_nothing_changes(self):
        """A parameter without effect is said before the runs, which would all be the same."""
        found = self.runs(numbers='20', duration='5000', over=['second_mass 1 2'])
        with tempfile.TemporaryDirectory() as folder:
            (line,) = sweep.warnings(found, folder)
        self.assertRegex(
            line,
            '^second_mass_2_number_20: second_mass = 2 has no effect with the other parameters',
        )

    def test_product(self):
        """Each with a name of its values, the seeds last."""
        runs = self.runs(
            seeds='1 02', boundaries='reflecting,periodic periodic', densities='0.1', numbers='20'
        )
        names = [
            f'number_20_density_0_1_boundary_{walls}_seed_{seed}'
            for walls in ('reflecting_periodic', 'periodic')
            for seed in (1, 2)
        ]
        self.assertEqual([run.name for run in runs], names)
        wanted = dict(number=20, density=0.1, boundary_y='periodic', aspect=1.0, threads=1)
        for one, wall, seed in zip(runs, ('reflecting',) * 2 + ('periodic',) * 2, '1212'):
            found = one.parameters
            self.assertEqual({name: found[name] for name in wanted}, wanted)
            self.assertEqual(
                (found['boundary_x'], found['seed'], found['scene'], found['observables']),
                (wall, seed, one.name[: -len('_seed_1')], ['spectrum']),
            )

    def test_same_in_all(self):
        (run,) = self.runs(aspects='0.5', duration='7', params='{warmup: 3.0, exponents: 10}')
        found = run.parameters
        self.assertEqual(
            [found[name] for name in ('duration', 'warmup', 'exponents', 'aspect', 'number')],
            [7, 3.0, 10, 0.5, 100],
        )
        self.assertEqual(self.runs(seeds='3')[0].parameters['scene'], 'quick')

    def test_walls_that_shear(self):
        """Exponents are left to the node, unless they are given; elsewhere they are the half."""
        for boundaries, params, found in (
            ('', '{}', None),
            ('', '{exponents: 10}', 10),
            ('reflecting periodic,shearing', '{}', None),
            ('reflecting', '{}', 'positive'),
        ):
            how = dict(scene='quick' if boundaries else 'shear', params=params)
            for one in self.runs(**how, boundaries=boundaries, seeds='1'):
                self.assertEqual(one.parameters.get('exponents'), found)

    def test_of_dumbbells(self):
        """Their own parameters are given in params, or have their defaults; disks have none."""
        how = dict(scene='dumbbells', seeds='1', params='{bond: 0.5}')
        (one,) = self.runs(**how)
        self.assertEqual((one.parameters['bond'], one.parameters['inertia']), (0.5, 'disks'))
        self.assertNotIn('bond', self.runs(seeds='1')[0].parameters)
        with self.assertRaisesRegex(
            Refused, 'bond = 0.5: must not be given with particles = disks'
        ):
            self.runs(seeds='1', params='{bond: 0.5}')
        for particles in 'soft_disks', 'soft_spheres':
            (one,) = self.runs(seeds='1', params=f'{{particles: {particles}, energy: 2}}')
            self.assertEqual([one.parameters[name] for name in ('energy', 'potential')], [2, 'wca'])

    def test_what_nothing_needs(self):
        """A value of the scene that nothing needs any more is as if it were not there; that of the
        user is refused by the node."""
        for params, number in (('{}', 0), ('{max_mode_number: 2}', 2)):
            how = dict(scene='dumbbells', seeds='1', observables='[gas]', params=params)
            (one,) = self.runs(**how)
            self.assertEqual(one.parameters['max_mode_number'], number)
        (one,) = self.runs(scene='dumbbells', seeds='1', observables='[steps]')
        self.assertEqual(one.parameters['max_mode_number'], 3)

    def test_large_systems_are_most_of_the_work(self):
        """By which progress and the time that is left are told."""
        small, large = (one.seconds - run.BEGIN for one in self.runs(numbers='100 200'))
        self.assertGreater(small, 0)
        self.assertAlmostEqual(large, 4 * small)

    def test_refused(self):
        for given, what in (
            ({}, 'nothing to sweep over: must be values of at least one of numbers, densities, '),
            (dict(densities='0.1 x'), 'densities = 0.1 x: must be positive numbers, with spaces'),
            (dict(densities='0'), 'densities = 0: must be positive'),
            (dict(aspects='inf'), 'aspects = inf: must be positive'),
            (dict(numbers='1e2'), 'numbers = 1e2: must be whole numbers'),
            (dict(seeds='-1'), 'seeds = -1: must be decimal numbers'),
            (dict(boundaries='open'), 'boundaries = open: must be periodic or reflecting, or two'),
            (dict(boundaries='periodic,periodic,periodic'), 'must be periodic or'),
            (dict(densities='0.1 0.10'), 'densities = 0.1 0.10: must have each value once'),
            (dict(seeds='1', scene='nix'), 'scene = nix: must be one of'),
            (dict(seeds='1', duration='0'), 'duration = 0: must be above 0, or it never ends'),
            (dict(seeds='1', duration='0', params='{target: ""}'), 'never ends without a target'),
            (dict(seeds='1', params='{seed: 2}'), 'must be without seed: it is swept'),
            (dict(seeds='1', over=['densty 1']), 'densty = 1: no such parameter; is density meant'),
            (dict(seeds='1', params='{lyap: 2}'), 'lyap = 2: no such parameter'),
            (dict(seeds='1', params='{checkpoint: a}'), 'checkpoint = a: must be empty'),
        ):
            with self.subTest(given=given), self.assertRaises(Refused) as caught:
                self.runs(**given)
            self.assertIn(what, str(caught.exception))


class Own(unittest.TestCase):
    """Of a program of one's own, whose particles have no box."""

    NODE = Program('hdlyap', 'hdlyap_own_node')

    def runs(self, **given):
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
            file.write('{number: 8, duration: 9.0}')
            file.flush()
            usual = dict(
                scene=file.name, threads='1', params='', observables='', over=['beta 0.5 2']
            )
            return grid.runs({**usual, **given}, LAUNCH, '/', self.NODE)

    def test_over_its_parameter(self):
        """Nothing of a box, which the node would refuse; its program in the words for roslaunch."""
        found = self.runs(seeds='1 2')
        names = ['beta_0_5_seed_1', 'beta_0_5_seed_2', 'beta_2_seed_1', 'beta_2_seed_2']
        self.assertEqual([one.name for one in found], names)
        asked = found[-1].parameters
        self.assertEqual((asked['beta'], asked['energy'], asked['particles']), (2, 1, 'chain'))
        self.assertEqual((asked['scene'], asked['observables']), ('beta_2', ['spectrum']))
        self.assertFalse(set(asked) & set(space.OF_A_BOX))
        self.assertEqual(
            found[0].program.arguments(), ['package:=hdlyap', 'program:=hdlyap_own_node']
        )
        self.assertEqual(HDLYAP.arguments(), [])

    def test_disks_have_none_of_it(self):
        asked = self.runs(params='{particles: disks}', over=['density 0.5'])[0].parameters
        self.assertFalse({'beta', 'energy', 'bond'} & set(asked))
        self.assertEqual((asked['density'], asked['aspect']), (0.5, 0.867))

    def test_refused(self):
        for said, given in (
            ('over = beta: must be a parameter and its values', dict(over=['beta'])),
            ('over = beta: must be swept once', dict(over=['beta 1', 'beta 2'])),
            ('params = {beta: 3}: must be without beta', dict(params='{beta: 3}')),
            ('betta = 1: no such parameter; is beta meant', dict(over=['betta 1'])),
        ):
            with self.assertRaisesRegex(Refused, said):
                self.runs(**given)
        with self.assertRaisesRegex(Refused, 'program = none: must be a program of the package hd'):
            Program.of(dict(program='none'))
        with self.assertRaisesRegex(Refused, 'package = none: must be a package that ROS finds'):
            Program.of(dict(package='none', program='none'))
        with self.assertRaisesRegex(
            Refused, 'program = hdlyap: must be a node, which hdlyap_node_m'
        ):
            Program('hdlyap', 'hdlyap').usual()


class Plan(InFolder):
    ENTRY = '''{base: quick, duration: 7.0, number: 30, full: {number: 20}, quick: {number: 10},
                seconds: [4, 9]}'''

    def runs(self, text, quick=False):
        """{name: Run} of this plan, in their order."""
        with open(self.path('plan.yaml'), 'w') as file:
            file.write(text)
        return {run.name: run for run in plan.runs(file.name, quick, LAUNCH)}

    def test_what_nothing_needs(self):
        """In an entry, as in a sweep."""
        one = self.runs('one: {base: dumbbells, observables: [gas], duration: 5}')['one']
        self.assertEqual(one.parameters['max_mode_number'], 0)

    def test_parameters(self):
        """Those of the scene, then of the entry, then of quick or full."""
        with open(os.path.join(LAUNCH, 'scenes/quick.yaml')) as file:
            scene = {**HDLYAP.usual(), **yaml.safe_load(file)}
        for quick, disks, seconds in ((False, 20, 9), (True, 10, 4)):
            one = self.runs('one: ' + self.ENTRY, quick)['one']
            self.assertEqual(
                one.parameters,
                {**scene, 'threads': 1, 'duration': 7.0, 'number': disks, 'scene': 'one'},
            )
            self.assertEqual(
                (one.seconds, one.share_of(2), one.is_wide), (seconds, seconds / 2, False)
            )
            one.write(self.folder)
            with open(self.path('one.yaml')) as file:
                self.assertEqual(yaml.safe_load(file), one.parameters)

    def test_one_like_another(self):
        """By YAML's own anchors; scenes lie beside the plan, too."""
        with open(self.path('own.yaml'), 'w') as file:
            file.write('{number: 40, duration: 1.0}')
        found = self.runs(
            'a: &a {base: own.yaml, density: 0.3}\n'
            'b: {<<: *a, number: 50, threads: 0, seed: 18446744073709551615}\n'
        )
        names = 'number', 'density', 'threads', 'seed', 'scene'
        self.assertEqual(
            [[one.parameters[name] for name in names] for one in found.values()],
            [[40, 0.3, 1, '1', 'a'], [50, 0.3, 0, '18446744073709551615', 'b']],
        )
        self.assertEqual((found['b'].share_of(2), found['b'].is_wide), (found['b'].seconds, True))

    def test_of_the_paper(self):
        """Each run has all parameters and ends, quick and full."""
        for quick in (True, False):
            found = plan.runs(PLAN, quick, LAUNCH)
            self.assertEqual(len(found), 63)
            for one in found:
                self.assertEqual(set(one.parameters), set(HDLYAP.usual()), one.name)

    def test_refused(self):
        for text, what in (
            ('one: {base: nowhere}', 'one: scene = nowhere: must be one of'),
            ('one: {base: nowhere.yaml}', 'one: scene = nowhere.yaml: must be a YAML file'),
            ('one: {duration: 1.0}', 'one: must be {base: scene, parameter: value, ..}'),
            ('one: []', 'one: must be {base: '),
            ('one: {base: quick, full: 3}', 'one: must be {base: '),
            ('one: {base: quick, duration: 0.0}', 'one: duration = 0.0: must be above 0'),
            ('one: {base: quick, duration: 1, warmup: x}', 'one: warmup = x: must be a number'),
            ('one: {base: quick, duration: 1, lyap: 2}', 'one: lyap = 2: no such parameter'),
            ('one: {base: quick, duration: 1, seconds: [x, y]}', "one: seconds = ['x', 'y']: must"),
            ('one: {base: quick, duration: 1, seconds: [0, 1]}', 'one: seconds = [0, 1]: must be'),
            ('one: {base: quick, duration: 1, seconds: 1}', 'one: seconds = 1: must be two'),
            ('a/b: {base: quick, duration: 1}', 'a/b: must be named with letters'),
            ('1: {base: quick, duration: 1}', '1: must be named with letters'),
            ('one: {base: quick}\none: {base: quick}', 'must have one once'),
            ('one: {base: quick, number: 9, number: 8}', 'must have number once'),
            ('- a\n', 'must be a YAML file of runs, {name: {base: scene, parameter: value, ..}'),
            ('a: [\n', 'must be a YAML file of runs'),
            ('', 'must have runs'),
        ):
            with self.subTest(text=text), self.assertRaises(Refused) as caught:
                self.runs(text)
            said = str(caught.exception)
            self.assertTrue(said.startswith(f'plan = {self.path("plan.yaml")}: '), said)
            self.assertIn(what, said)
            self.assertNotIn('\n', said)


class Command(InFolder):
    """What is asked for, by its words."""

    def understood(self, *words, assigned=()):
        parser = argparse.ArgumentParser()
        sweep.options(parser)
        args = parser.parse_args(words)
        args.assigned = assigned
        found, folder, jobs = sweep.understood(args, LAUNCH, self.folder)
        return [run.name for run in found], folder, jobs

    def test_asked(self):
        with open(self.path('p.yaml'), 'w') as file:
            file.write('a: &a {base: quick, duration: 1}\nb: *a\nc: *a\n')
        self.assertEqual(
            self.understood('--plan', 'p.yaml', '--only', 'c a', '--jobs', '3'),
            (['a', 'c'], self.path('sweep'), 3),
        )
        self.assertEqual(
            self.understood('--seeds', '1 2', '--only', 'seed_2', '--folder', '/nowhere'),
            (['seed_2'], '/nowhere', len(os.sched_getaffinity(0))),
        )
        for words, what in (
            ('--seeds 1 --jobs 0', 'jobs = 0: must be 1 or more'),
            ('--seeds 1 --folder p.yaml', 'folder = p.yaml: must be a folder'),
            ('--seeds 1 --only b', 'only = b: must be names of the runs, but no run is called b'),
            ('--seeds 1 --quick', 'quick: must be given with --plan'),
            ('--plan p.yaml --seeds 1', 'seeds = 1: must not be given with a plan'),
            ('--plan p.yaml --scene dense', 'scene = dense: must not be given with a plan'),
            ('--plan p.yaml --k 0 1', 'k = [0.0, 1.0]: must not be given with a plan'),
            ('--plan none.yaml', 'none.yaml: must be a YAML file of runs, {name: '),
        ):
            with self.subTest(words=words), self.assertRaises(Refused) as caught:
                self.understood(*words.split())
            self.assertIn(what, str(caught.exception))
        with self.assertRaisesRegex(RecordingError, 'must be with the form'):
            self.understood('--seeds', '1', '--k', '0', '1')
        with self.assertRaisesRegex(Refused, 'scene = shear: must be given as an option'):
            self.understood('--seeds', '1', assigned=['__name:=a', 'scene:=shear'])

    def test_wrong_after_the_runs(self):
        """Is no refusal."""
        parser, said = argparse.ArgumentParser(), io.StringIO()
        sweep.options(parser)
        with mock.patch.object(result, 'write', side_effect=RecordingError('x.bag: damaged')):
            with contextlib.redirect_stderr(said):
                status = sweep.sweep([], self.folder, 1, parser.parse_args([]))
        self.assertEqual((status, said.getvalue()), (1, 'hdlyap sweep: x.bag: damaged\n'))


class Results(InFolder):
    """Of bags made up."""

    def bag(
        self,
        name,
        density=0.5,
        seed='1',
        boundary='periodic',
        value=9.0,
        size=2,
        own=(),
        most=0.0,
        **changes,
    ):
        info = made.run_info(
            **dict(density=density, seed=seed, run_id=name, boundary_x=boundary, own=list(own)),
            **dict(boundary_y=boundary, container='lens' if boundary == 'curved' else 'rectangle'),
        )
        message = made.steps([made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)])
        message.run_id = name
        for key, changed in changes.items():
            setattr(message, key, changed)
        said = [info, made.spectrum(np.linspace(value, 1.0, size), 50.0, run_id=name), message]
        said += [made.status(50.0, run_id=name, energy_error_most=most, energy_error_wanted=5e-4)]
        made.write(self.path(name + '.bag'), said)
        return self.path(name + '.bag')

    def read(self, *paths):
        found, wrong = points.read(paths)
        self.assertEqual(wrong, [])
        return found

    def test_another_time_step_is_another_row(self):
        steps = ('1', 0.01), ('2', 0.005), ('3', 0.01)
        bags = [
            self.bag(seed, seed=seed, own=['potential=wca', f'time_step={step}'])
            for seed, step in steps
        ]
        found = self.read(*bags)
        self.assertEqual(
            [(point.system['time_step'], len(point.runs)) for point in found],
            [(0.005, 1), (0.01, 2)],
        )
        self.assertRegex('\n'.join(table.text(found)), r'(?s)time_step.*\n.*0\.005 .*\n.*0\.01 ')

    def test_an_energy_that_was_off(self):
        """By the name of its run."""
        found = self.read(self.bag('1', seed='1'), self.bag('2', seed='2', most=0.0016))
        head, line = [line for line in table.text(found) if 'energy' in line]
        self.assertRegex(head, '  energy error  seeds  averaged time$')
        self.assertRegex(line, '2.*: the energy was off by 0.0016, asked was 0.0005')

    def test_two_runs_in_a_bag(self):
        """Of which the table has the last, and says so."""
        path = self.bag('a')
        self.assertNotIn('runs', '\n'.join(table.text(self.read(path))))
        info = made.run_info(run_id='second', seed='2')
        spectrum = made.spectrum([8.0, 1.0], 50.0, run_id='second')
        made.write(path, [info, spectrum], mode='a', start=100)
        self.assertIn(f'{path}: the last of its 2 runs', list(table.text(self.read(path))))

    def test_seeds_that_differ_by_more_than_they_state(self):
        """Four largest exponents, each 9 +- 0.01; then one that is ten errors off."""
        same = [self.bag(f's{n}', 0.4, str(n)) for n in range(1, 5)]
        other = [self.bag(f'o{n}', 0.5, str(n), value=9.0 + 0.1 * (n == 4)) for n in range(1, 5)]
        lines = [
            line for line in table.text(self.read(*same, *other)) if 'the seeds differ' in line
        ]
        self.assertEqual(len(lines), 1, lines)
        said = 'lambda_max (density 0.5): the seeds differ by 5.0 times their errors, which'
        self.assertTrue(lines[0].startswith(said), lines)

    def test_seeds_that_agree_are_seldom_said_to_differ(self):
        """Errors of eight blocks, five seeds, ten values of each table: one in fifty at most, and
        of seeds that are three errors further apart than they say nearly all."""
        random, fewer, more = np.random.default_rng(3), 0, 0
        for _ in range(400):
            blocks = random.normal(size=(10, 5, 8))
            stated = np.sqrt((blocks.std(axis=-1, ddof=1) ** 2 / 8).sum(axis=-1)) / 5
            scatter = blocks.mean(axis=-1).std(axis=-1, ddof=1) / np.sqrt(5)
            fewer += self.says(stated, scatter)
            more += self.says(stated, 3 * scatter)
        self.assertLessEqual(fewer, 16)
        self.assertGreater(more, 380)

    def says(self, stated, scatter):
        """Whether any of these values is said to differ."""
        values = {
            str(n): points.Value(9.0, *errors, nan, 5, nan, None)
            for n, errors in enumerate(zip(stated, scatter))
        }
        return any(table._scattered([mock.Mock(values=values, system={})], []))

    def test_fits_on_different_bases_are_marked(self):
        """Of one form over the same wave numbers they share their number; a line explains each."""
        one_wave = dict(t_points=1, t_k_max=made.K, t_prior_share=1.0, l_points=0, v_phases=0)
        one_wave.update(c_t2=nan, c_t3=nan)
        found = self.read(self.bag('b', 0.5), self.bag('a', 0.4), self.bag('c', 0.6, **one_wave))
        lines = list(table.text(found))
        self.assertEqual(lines[0], 'the same in all: number 20, aspect 1, boundary periodic')
        of_t = '1.400(12), misfit 1.2'
        fits = f'{of_t} [1] 1.500(20) [2] 1.612(23), misfit 2.5 [3]'
        relation, long = 'c k + c2 k^2 + c3 k^3', '% of the curvature from long boxes'
        self.assertEqual(
            [line.split() for line in lines[2:5]],
            [
                f'{density} {packing} 9.000(10) {fitted} 1 50'.split()
                for density, packing, fitted in (
                    ('0.4', '0.3142', fits),
                    ('0.5', '0.3927', fits),
                    ('0.6', '0.4712', of_t + ' [4]'),
                )
            ],
        )
        self.assertEqual(
            lines[6:],
            [
                f'  [1] {relation} over 3 wave numbers 0.9935 .. 1.987 (lever arm 2), 25 {long}',
                f'  [2] {relation} over 2 wave numbers 0.9935 .. 1.405 (lever arm 1.41), 50 {long}',
                '  [3] |omega| / k of the LP phases at 0.9935 .. 1.405',
                f'  [4] c k over 1 wave number 0.9935, 100 {long}',
            ],
        )
        self.assert_drawn(found, {'c_T': 3, 'c_L': 2, 'v': 2, 'lambda_max': 3})

    def assert_drawn(self, found, wanted):
        """So many points of each quantity, those of c k alone open."""
        drawn = figure.draw(found)
        panels = {axes.get_ylabel(): axes for axes in drawn.axes}
        self.assertEqual(len(panels), len(wanted))
        for name, count in wanted.items():
            axes = panels[figure.NAMES[name]]
            self.assertEqual(len(axes.containers), count, name)
            is_open = [bars.lines[0].get_markerfacecolor() == 'white' for bars in axes.containers]
            self.assertEqual(sum(is_open), 1 if name == 'c_T' and count == 3 else 0, name)
            errors = [point.values[name].error for point in found if name in point.values]
            ends = [bars.lines[2][0].get_segments()[0][:, 1] for bars in axes.containers]
            np.testing.assert_allclose(sorted(np.ptp(ends, axis=1)), 2 * np.sort(errors))

    def test_no_error(self):
        """Is drawn as a cross; a container that is not a box has its name in the table."""
        bags = [self.bag(f'c{n}', n, boundary='curved', c_t_error=-1.0) for n in (0.4, 0.5)]
        found = self.read(*bags)
        self.assertIn('boundary lens', next(iter(table.text(found))))
        drawn = figure.draw(found)
        markers = {
            axes.get_ylabel(): [line.get_marker() for line in axes.lines] for axes in drawn.axes
        }
        self.assertIn('x', markers[figure.NAMES['c_T']])
        self.assertNotIn('x', markers[figure.NAMES['c_L']])

    def test_particles_of_several_kinds(self):
        """A table and a figure of each kind."""
        ball = made.spheres(run_id='ball')
        made.write(self.path('ball.bag'), [ball, made.spectrum([9.0], 50.0, run_id='ball')])
        disks = [self.bag('a', 0.4), self.bag('b', 0.5)]
        with contextlib.redirect_stdout(io.StringIO()) as said:
            wrong = result.write_all([*disks, self.path('ball.bag')], self.folder)
        self.assertEqual((wrong, said.getvalue().count('the same in all')), ([], 2))
        names = set(os.listdir(self.folder))
        self.assertLess({'sweep_disks.txt', 'sweep_disks.png', 'sweep_spheres.csv'}, names)
        with contextlib.redirect_stdout(io.StringIO()):
            result.write_all(disks, self.folder)
        self.assertIn('sweep.png', os.listdir(self.folder))

    def test_runs_of_a_plan_that_have_no_mean(self):
        """Two of one seed and system: each has a row, by its name."""
        with contextlib.redirect_stdout(io.StringIO()) as said:
            wrong = result.write_all([self.bag('a', 0.4), self.bag('b', 0.4)], self.folder)
        rows = re.findall(r'(?m)^(\w+) +9\.000\(10\)', said.getvalue())
        self.assertEqual((wrong, rows), ([], ['a', 'b']))

    def test_walls_of_some_shear(self):
        """A point for each shear_b, beside walls that have none; what contracts has columns."""
        paths = [self.bag('plain', 0.4)]
        for b in (1.0, 10.0):
            name = f'b{b:g}'
            info = made.run_info(run_id=name, boundary_y='shearing', shear_b=b, zero_exponents=1)
            found = made.spectrum([0.5, 0.0, -0.5 - 1 / b], 50.0, run_id=name, divergence=-1 / b)
            found.kaplan_yorke, found.kaplan_yorke_error = 2 + b / 100, 0.01
            made.write(self.path(name), [info, found, made.shear_gas(run_id=name)])
            paths.append(self.path(name))
        found = self.read(*paths)
        self.assertEqual([point.system['shear_b'] for point in found], ['', 1.0, 10.0])
        lines = list(table.text(found[1:]))
        self.assertRegex(
            lines[1], '^shear_b .*exponent_sum +kaplan_yorke +shear_stress +velocity_l'
        )
        self.assertRegex(lines[2], r'^1 .* -1.000\(10\) +2.010\(10\) +0.062\(10\) +-0.250\(10\)')
        table.csv(found, self.path('all.csv'))
        with open(self.path('all.csv')) as file:
            head, plain, *_ = csv.reader(file)
        self.assertEqual(plain[head.index('shear_b')], '')
        self.assertEqual(len(head), len(plain))
        self.assertIn('kaplan_yorke', head)
        figure.draw(found[1:])

    def test_a_circle_has_no_aspect(self):
        """Beside boxes its place is empty; of circles alone nothing is said."""
        paths = [self.bag('box', 0.4)]
        for density in 0.4, 0.5:
            curved = dict(container='circle', boundary_x='curved', boundary_y='curved')
            info = made.run_info(run_id=f'c{density}', density=density, **curved)
            path = self.path(info.run_id)
            made.write(path, [info, made.spectrum([9.0, 1.0], 50.0, run_id=info.run_id)])
            paths.append(path)
        found = self.read(*paths)
        self.assertEqual(sorted(str(point.system['aspect']) for point in found), ['', '', '1.0'])
        circles = [one for one in found if one.system['boundary'] == 'circle']
        said = next(table.text(circles))
        self.assertEqual(said, 'the same in all: number 20, boundary circle')
        labels = figure._series(found, ['aspect'])
        self.assertEqual(set(labels), {'', '$L_y/L_x$ = 1'})

    def test_errors_that_are_not_known(self):
        """Have no rows, and are crosses, of which the figure says so and nothing of bars."""
        found = self.read(*(self.bag(f's{n}', seed=str(n)) for n in (1, 2)), self.bag('a', 0.6))
        self.assertIn(ERRORS, list(table.text(found)))
        for point in found:
            known = {'std_error': nan, 'scatter': nan}
            point.values = {name: one._replace(**known) for name, one in point.values.items()}
        self.assertNotIn(ERRORS, list(table.text(found)))
        *_, said = figure.draw(found).figure.texts
        self.assertTrue(said.get_text().startswith('cross: the error is not known'))

    def test_one_panel(self):
        """Its title and the text below are inside of it."""
        found = self.read(self.bag('a', 0.4), self.bag('b', 0.5))
        for point in found:
            point.values = {'lambda_max': point.values['lambda_max']}
        drawn = figure.draw(found).figure
        drawn.canvas.draw()
        for text in (drawn._suptitle, *drawn.texts):
            box = text.get_window_extent()
            self.assertGreaterEqual(box.x0, 0, text)
            self.assertLessEqual(box.x1, drawn.bbox.x1, text)
        page = figure.draw(found, paper='one-column')
        self.assertEqual((page.figure.get_figwidth(), page.figure.texts), (3.375, []))

    def test_over_seeds(self):
        """One point of each system; both errors and chi^2 as hdlyap.load has them; a fit that is
        not of one form in all is none."""
        paths = [self.bag(f'p{k}', seed=str(k), value=9 + 0.1 * k, size=37) for k in (1, 2, 3)]
        walls = [self.bag('r1', boundary='reflecting', seed='1')]
        walls += [self.bag('r2', boundary='reflecting', seed='2', c_t2=nan, c_t3=nan)]
        found = self.read(*walls, *paths)
        self.assertEqual([len(point.runs) for point in found], [3, 2])
        lines = list(table.text(found))
        self.assertRegex(lines[1], '^boundary +lambda_max +h_KS/N +c_T +c_L +v +seeds +averaged')
        self.assertRegex(lines[2], r'^periodic +9\.200\(58\) .* 3 +150$')
        self.assertRegex(lines[3], r'^reflecting +9\.0000\(71\) +unlike +1\.500')
        self.assertIn(
            'unlike: no mean, as the fits of the seeds differ in form or wave numbers', lines
        )
        head, *rows = (re.split('  +', line) for line in lines[lines.index(ERRORS) + 1 :])
        self.assertEqual(
            head, ['boundary', 'quantity', 'from those stated', 'from the scatter', CHI2]
        )
        self.assertIn(['periodic', 'lambda_max', '0.0058', '0.058', '1e+02'], rows)
        self.assertIn(['reflecting', 'c_L', '0.019', '0.017', '0'], rows)
        self.assertNotIn('c_T', [row[1] for row in rows if row[0] == 'reflecting'])
        results = hdlyap.load(*paths).results
        for name, shown, factor in (('lambda_max', 'lambda_max', 1), ('h_KS', 'h_KS/N', 1 / 20)):
            value, expected = found[0].values[shown], results.loc[name]
            self.assertAlmostEqual(value.chi2, expected.chi2, 12)
            for part in ('value', 'std_error', 'scatter'):
                self.assertAlmostEqual(getattr(value, part), factor * expected[part], 12)
        self.assert_drawn(found, {'c_T': 1, 'c_L': 2, 'v': 2, 'lambda_max': 2, 'h_KS/N': 1})

    def test_bags_that_are_none(self):
        """A line for each; the others are shown."""
        with open(self.path('broken.bag'), 'wb') as file:
            file.write(b'#ROSBAG V2.0\n' + bytes(500))
        program = Process(
            [*harness.command('table'), self.bag('a'), self.path('broken.bag'), 'x.bag.active'],
            PWD=self.folder,
        )
        self.assertEqual(program.wait(), 1, program.text())
        self.assertEqual(len(program.lines('hdlyap table: ')), 2, program.text())
        self.assertEqual(len(program.lines('hdlyap table: x.bag.active: ')), 1, program.text())
        self.assertEqual(len(program.lines('9.000(10)')), 1, program.text())
        self.assertIsNone(figure.draw(self.read(self.bag('a'))))
