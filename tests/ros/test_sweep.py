#!/usr/bin/env python3
"""Sweeps: which runs they consist of, what is left when they are interrupted or fail, their table
and figure; and what launch files say of themselves."""

import csv
import glob
import os
import signal
import tempfile
import unittest
from math import nan
from xml.etree import ElementTree

import numpy as np
import rosbag
from roslaunch import arg_dump
import rospkg
import yaml

import hdlyap
import harness
import made
from harness import SOON, Process, wait_until
from made import LP, T
from hdlyap.runs.scene import Refused
from hdlyap.plots.figures.style import plt
from hdlyap.sweep import figure, grid, points, table

LAUNCH = os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')
MODES = dict(harness.MODES, duration=150.0)
LATEST = 240.0  # seconds that some runs of a second take on a busy machine


class Grid(unittest.TestCase):
    def runs(self, **given):
        usual = dict(scene='quick', threads='1', params='', observables='[spectrum]')
        return grid.runs({**usual, **given}, LAUNCH, '/')

    def test_product(self):
        """Each with a name of its values, the seeds last."""
        runs = self.runs(
            seeds='1 02', boundaries='reflecting,periodic periodic', densities='0.1', disks='20'
        )
        names = [
            f'disks_20_density_0_1_boundary_{walls}_seed_{seed}'
            for walls in ('reflecting_periodic', 'periodic')
            for seed in (1, 2)
        ]
        self.assertEqual([run.name for run in runs], names)
        wanted = dict(disks=20, density=0.1, boundary_y='periodic', aspect=1.0, threads=1)
        for run, wall, seed in zip(runs, ('reflecting',) * 2 + ('periodic',) * 2, '1212'):
            found = run.parameters
            self.assertEqual({name: found[name] for name in wanted}, wanted)
            self.assertEqual(
                (found['boundary_x'], found['seed'], found['scene'], found['observables']),
                (wall, seed, run.name[: -len('_seed_1')], ['spectrum']),
            )

    def test_same_in_all(self):
        (run,) = self.runs(aspects='0.5', duration='7', params='{warmup: 3.0, exponents: 10}')
        found = run.parameters
        self.assertEqual(
            [found[name] for name in ('duration', 'warmup', 'exponents', 'aspect', 'disks')],
            [7, 3.0, 10, 0.5, 100],
        )
        self.assertEqual(self.runs(seeds='3')[0].parameters['scene'], 'quick')

    def test_large_systems_are_most_of_the_work(self):
        """By which progress and the time that is left are told."""
        small, large = (run.seconds - grid.BEGIN for run in self.runs(disks='100 200'))
        self.assertAlmostEqual(large, 4 * small)

    def test_refused(self):
        for given, what in (
            ({}, 'nothing to sweep over: must be values of at least one of disks, densities, '),
            (dict(densities='0.1 x'), 'densities = 0.1 x: must be positive numbers, with spaces'),
            (dict(densities='0'), 'densities = 0: must be positive'),
            (dict(aspects='inf'), 'aspects = inf: must be positive'),
            (dict(disks='1e2'), 'disks = 1e2: must be whole numbers'),
            (dict(seeds='-1'), 'seeds = -1: must be decimal numbers'),
            (dict(boundaries='open'), 'boundaries = open: must be periodic or reflecting, or two'),
            (dict(boundaries='periodic,periodic,periodic'), 'must be periodic or'),
            (dict(densities='0.1 0.10'), 'densities = 0.1 0.10: must be each once'),
            (dict(seeds='1', scene='nix'), 'scene = nix: must be one of'),
            (dict(seeds='1', duration='0'), 'duration is 0: it would never end'),
            (dict(seeds='1', params='{seed: 2}'), 'must be without seed: it is swept'),
            (dict(seeds='1', params='{lyap: 2}'), 'lyap = 2: must be a parameter of hdlyap_node'),
            (dict(seeds='1', params='{checkpoint: a}'), 'checkpoint = a: must be empty'),
        ):
            with self.subTest(given=given), self.assertRaises(Refused) as caught:
                self.runs(**given)
            self.assertIn(what, str(caught.exception))


class InFolder(harness.Traced):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)


class Results(InFolder):
    """Of bags made up."""

    def bag(self, name, density=0.5, seed='1', boundary='periodic', value=9.0, size=2, **changes):
        info = made.run_info(
            density=density, seed=seed, run_id=name, boundary_x=boundary, boundary_y=boundary
        )
        message = made.steps([made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)])
        message.run_id = name
        for key, changed in changes.items():
            setattr(message, key, changed)
        said = [info, made.spectrum(np.linspace(value, 1.0, size), 50.0, run_id=name), message]
        made.write(self.path(name + '.bag'), said)
        return self.path(name + '.bag')

    def read(self, *paths):
        found, wrong = points.read(paths)
        self.assertEqual(wrong, [])
        return found

    def test_fits_on_different_bases_are_marked(self):
        """Of one form over the same wave numbers they share their number; a line explains each."""
        one_wave = dict(t_points=1, t_k_max=made.K, t_prior_share=nan, l_points=0, v_phases=0)
        one_wave.update(c_t2=nan, c_t3=nan)
        found = self.read(self.bag('b', 0.5), self.bag('a', 0.4), self.bag('c', 0.6, **one_wave))
        lines = list(table.text(found))
        self.assertEqual(lines[0], 'the same in all: disks 20, aspect 1, boundary periodic')
        fits = '1.400(12) [1] 1.500(20) [2] 1.612(23) [3]'
        relation, long = 'c k + c2 k^2 + c3 k^3', '% of the curvature from long boxes'
        self.assertEqual(
            [line.split() for line in lines[2:5]],
            [
                f'{density} 9.000(10) {fitted} 1 50'.split()
                for density, fitted in (('0.4', fits), ('0.5', fits), ('0.6', '1.400(12) [4]'))
            ],
        )
        self.assertEqual(
            lines[6:],
            [
                f'  [1] {relation} over 3 wave numbers 0.9935 .. 1.987 (lever arm 2), 25 {long}',
                f'  [2] {relation} over 2 wave numbers 0.9935 .. 1.405 (lever arm 1.41), 50 {long}',
                '  [3] |omega| / k of the LP phases at 0.9935 .. 1.405',
                '  [4] c k over 1 wave number 0.9935',
            ],
        )
        self.assert_drawn(found, {'c_T': 3, 'c_L': 2, 'v': 2, 'lambda_max': 3})

    def assert_drawn(self, found, wanted):
        """So many points of each quantity, those of c k alone open."""
        drawn = figure.draw(found)
        self.addCleanup(plt.close, drawn)
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
        self.assertIn('unlike: fits of the seeds have not the same form or wave numbers', lines)
        self.assertRegex(lines[-2], r'^periodic +0\.0058 0\.058 1e\+02 ')
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
            [*harness.command('table'), self.bag('a'), self.path('broken.bag'), 'none.bag'],
            PWD=self.folder,
        )
        self.assertEqual(program.wait(), 1, program.text())
        self.assertEqual(len(program.lines('hdlyap table: ')), 2, program.text())
        self.assertEqual(len(program.lines('9.000(10)')), 1, program.text())
        self.assertIsNone(figure.draw(self.read(self.bag('a'))))


@harness.more
class Sweep(InFolder):
    """Of runs of a second."""

    def setUp(self):
        super().setUp()
        self.trace()
        self.scene(**MODES)

    def scene(self, **parameters):
        with open(self.path('tiny.yaml'), 'w') as file:
            yaml.safe_dump(parameters, file)

    def start(self, *command, **env):
        return Process(command, PWD=self.folder, HDLYAP_MARK=self.mark, **env)

    def launch(self, *args, **env):
        env.setdefault('ROS_MASTER_URI', 'http://localhost:%d' % harness.free_port())
        return self.start('roslaunch', 'hdlyap', 'sweep.launch', 'scene:=tiny.yaml', *args, **env)

    def sweep(self, *options, status=0):
        """What it printed."""
        process = self.start(*harness.command('sweep'), '--scene', 'tiny.yaml', *options)
        self.assertEqual(process.wait(LATEST), status, process.text())
        return process.text()

    def run_ids(self):
        """{name of a bag: run_id}"""
        paths = glob.glob(self.path('sweep', '*.bag'))
        return {os.path.basename(path)[:-4]: hdlyap.load(path).info.run_id for path in paths}

    def test_interrupted(self):
        """By Ctrl-C: what is whole stays and is not run again; what was cut is, and kept aside;
        other parameters are refused."""
        launch = self.launch('densities:=0.6 0.8', 'seeds:=1 2', 'jobs:=1')
        self.assertTrue(wait_until(self.run_ids, LATEST), launch.text())
        wait_until(lambda: self.ours('hdlyap_node'), SOON, harness.LOOK)
        launch.send(signal.SIGINT)
        self.assertEqual(launch.wait(SOON), 0, launch.text())
        self.assert_none_left()
        done = self.run_ids()
        self.assertIn('density_0_6_seed_1', done)
        self.assertLess(len(done), 4)
        self.assertFalse(os.path.exists(self.path('sweep', 'under_way')))
        given = '--densities', '0.6 0.8', '--seeds', '1 2'
        self.assertRegex(self.sweep(*given), r'(?m)^4 of 4 runs done in')
        every = self.run_ids()
        self.assertEqual(len(every), 4)
        self.assertEqual({**every, **done}, every)
        self.check_results()
        self.check_refused(*given)
        self.check_cut(*given)
        del every['density_0_8_seed_2']
        self.assertEqual({**self.run_ids(), **every}, self.run_ids())

    def check_results(self):
        """The files, and their numbers."""
        for ending in ('txt', 'png', 'svg'):
            self.assertGreater(os.path.getsize(self.path('sweep', 'sweep.' + ending)), 500)
        with open(self.path('sweep', 'sweep.csv')) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row['density [1/sigma^2]'] for row in rows], ['0.6', '0.8'])
        for row in rows:
            name = 'density_' + row['density [1/sigma^2]'].replace('.', '_')
            loaded = hdlyap.load(*(self.path('sweep', f'{name}_seed_{k}.bag') for k in '12'))
            self.assertEqual((row['seeds'], row['averaged time [time units]']), ('1 2', '300'))
            self.check_row(row, loaded.results)

    def check_row(self, row, results):
        self.assertIn('c_T', results.index)
        disks = MODES['disks']
        units = {'lambda_max': '1/time unit', 'c_T': 'sigma/time unit'}
        for name, factor in (('lambda_max', 1), ('c_T', 1), ('h_KS', disks)):
            shown = name if name in units else 'h_KS/N'
            columns = [f'{shown} [{units.get(name, "1/time unit")}]']
            columns += [f'{shown} {error}' for error in ('std_error', 'scatter')]
            for column, known in zip(columns, ('value', 'std_error', 'scatter')):
                self.assertAlmostEqual(float(row[column]) * factor, results[known][name], 9)
            self.assertAlmostEqual(float(row[f'{shown} chi2']), results['chi2'][name], 9)
        self.assertEqual(row['c_T basis'], results['basis']['c_T'])

    def check_refused(self, *given):
        said = self.sweep(*given, '--duration', '151', status=2)
        self.assertEqual(
            said,
            f'hdlyap sweep: {self.path("sweep", "density_0_6_seed_1.bag")}: it was run with '
            'duration = 150.0, not 151; must be swept with that, or in another folder\n',
        )

    def check_cut(self, *given):
        path = self.path('sweep', 'density_0_8_seed_2.bag')
        os.truncate(path, os.path.getsize(path) // 2)
        said = self.sweep(*given)
        self.assertIn(f'hdlyap sweep: {path} was there already: it is now {path}.old\n', said)
        self.assertRegex(said, r'(?m)^4 of 4 runs done in')
        again = self.sweep(*given)
        self.assertNotIn('runs done', again)
        self.assertEqual(said[said.index('the same') :], again[again.index('the same') :])
        self.assertRegex(self.sweep(*given, '--form', 'c k'), r'\n  \[1\] c k over \d wave')

    def test_one_fails(self):
        """It is named, the others go on; in a namespace, all topics are in the bags; then it is
        mended."""
        self.scene(**dict(harness.SHORT, warmup='auto'))
        given = 'densities:=2.5 0.3', 'aspects:=1', 'folder:=of mine', 'threads:=1'
        launch = self.launch(*given, 'observables:=[spectrum, state]', ROS_NAMESPACE='/lab')
        launch.wait(LATEST)
        said = launch.lines('sweep: ')
        self.assertEqual(len(said), 2, launch.text())
        for line in said:
            self.assertRegex(
                line,
                r'sweep: density_2_5_aspect_1_0: the run has not come to its end; .*FATAL.*'
                r'density = 2\.5: .*; all that it said is in .*of mine/log/density_2_5_aspect_1_0',
            )
        self.assertIn('exit code 1', launch.text())
        self.assertRegex(launch.text(), r'(?m)^1 of 2 runs done, 1 failed in')
        self.assertRegex(launch.text(), r'(?m)^the same in all: .*density 0.3')
        self.check_bag(self.path('of mine', 'density_0_3_aspect_1_0.bag'))
        self.assert_none_left()
        said = self.sweep('--densities', '2.5', '--folder', 'of mine', status=1)
        self.assertEqual(said.count('sweep: density_2_5: the run has not come'), 2)
        self.assertEqual(len(glob.glob(self.path('of mine', '*.bag'))), 1)

    def check_bag(self, path):
        with rosbag.Bag(path) as bag:
            topics = {topic.rpartition('/')[2] for topic in bag.get_type_and_topic_info()[1]}
        self.assertLessEqual({'run_info', 'status', 'cost', 'state', 'spectrum'}, topics)
        self.assertNotIn('modes', topics)


class Files(unittest.TestCase):
    def test_arguments_are_documented(self):
        """As `roslaunch --ros-args` lists them."""
        files = glob.glob(os.path.join(LAUNCH, '*.launch'))
        self.assertGreaterEqual(len(files), 5)
        for path in files:
            listed = arg_dump.get_args([path])
            for arg in ElementTree.parse(path).getroot().findall('arg'):
                name, doc = arg.get('name'), arg.get('doc')
                self.assertTrue(doc, '%s in %s' % (name, path))
                if arg.get('value') is None:
                    self.assertEqual(listed[name][0], doc, path)


if __name__ == '__main__':
    harness.main('sweep')
