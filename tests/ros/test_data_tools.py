"""plot_bag and compare of several bags, what plot_bag exports, and bags that somebody has made to
do harm."""

import json
import os
import runpy
import sys
import unittest
from contextlib import ExitStack, redirect_stderr, redirect_stdout
from io import StringIO
from unittest import mock

import numpy as np
import pandas

import hdlyap
from hdlyap.data.reader import RecordingError
from hdlyap.msg import Structure
import made
from made import LP, SCRIPTS, T
from plotted import plot_bag
from test_data import Bags
from test_data_joined import HALF, numbered, run

ESCAPE = '\x1b]0;gone\x07\x1b[2J\u202e'


def tool(name, *arguments):
    """(status, stdout, stderr), as if it had been a process."""
    out, error = StringIO(), StringIO()
    with ExitStack() as changed:
        changed.enter_context(mock.patch.object(sys, 'argv', [name, *arguments]))
        changed.enter_context(redirect_stdout(out))
        changed.enter_context(redirect_stderr(error))
        try:
            runpy.run_path(os.path.join(SCRIPTS, name), run_name='__main__')
        except SystemExit as end:
            return end.code or 0, out.getvalue(), error.getvalue()
    raise AssertionError(f'{name} did not end')


class Tools(Bags):
    def write(self, name, messages):
        made.write(self.path(name), messages)
        return self.path(name)

    def seed(self, number, shift, error=0.1, **fields):
        name = f'{fields.get("density", "")}seed{number}'
        info = made.run_info(run_id=name, seed=str(number), **fields)
        found = [
            made.step(info, T, 1, 0, 36, 37, exponent=1 + shift, std_error=error),
            made.step(info, LP, 1, 0, 32, 35, exponent=1.4 + shift, std_error=error),
        ]
        spectrum = made.spectrum(HALF + shift, 50.0, run_id=name, error=error)
        return self.write(name, [info, spectrum, made.steps(found, run_id=name)])

    def plot(self, *arguments):
        return plot_bag('--out', os.path.join(self.folder, 'out'), *arguments)

    def check(self, name, *arguments, fault):
        """The status, with one line if it is the one of a fault, and nothing for a terminal."""
        status, out, error = tool(name, *arguments)
        self.assertIn(status, {'compare': (0, 1, 2)}.get(name, (0, 1)))
        for line in (out + error).splitlines():
            self.assertTrue(line.isprintable(), line)
            self.assertLess(len(line), 10000)
        if error:
            self.assertEqual(status, fault, error)
            self.assertEqual(error.count('\n'), 1, error)
            self.assertTrue(error.startswith(name + ': '))
        return status, out, error

    def all_tools(self, bag):
        out = os.path.join(self.folder, 'out')
        with mock.patch('hdlyap.plots.figures.draw_all', lambda *_: []):
            return (
                self.check('plot_bag', bag, '--out', out, fault=1),
                self.check('compare', bag, bag, fault=2),
                self.check('repeat', bag, fault=1),
            )


class Fits(Tools):
    def test_another_form(self):
        """Of exponents 2 k + 0.3 k^2 at three wave numbers: of all, and of the first two."""
        info = made.run_info()
        found = [made.step(info, T, n, 0, 38 - 2 * n, 39 - 2 * n) for n in (1, 2, 3)]
        for step in found:
            step.exponent = (2 + 0.3 * step.wave_number) * step.wave_number
        path = self.path('curved.bag')
        made.write(path, [info, made.spectrum(np.linspace(3, 1, 37), 50.0), made.steps(found)])
        curved = hdlyap.load(path, form='c k + c2 k^2').results
        np.testing.assert_allclose(curved['value'][['c_T', 'c_T2']], [2, 0.3], rtol=1e-9)
        self.assertNotIn('c_T3', curved.index)
        self.assertNotIn('c_L', curved.index)
        two = hdlyap.load(path, form='c k', k=(0, 2.1 * made.K)).results
        between = [2 + 0.3 * n * made.K for n in (1, 2)]
        self.assertTrue(between[0] < two['value']['c_T'] < between[1])
        self.assertIn('c k over 2 wave numbers 0.9935 .. 1.987', two['basis']['c_T'])
        done = self.plot(path, '--form', 'c k', '--k', '0', '2.1')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn('\n  T steps: c k over 2 wave numbers 0.9935 .. 1.987 (lever', done.stdout)
        with self.assertRaisesRegex(RecordingError, "form 'k': must be one of"):
            hdlyap.load(path, form='k').results
        done = self.plot(path, '--k', '2', '1')
        self.assertEqual(done.returncode, 1)
        self.assertIn('k from 2 to 1: must go up', done.stderr)


class Several(Tools):
    def test_seeds(self):
        done = self.plot(*(self.seed(k, shift) for k, shift in enumerate((-0.1, 0.0, 0.4))))
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn('seed 0, 1, 2, hdlyap 0.1.0, means over seeds', done.stdout)
        # the scatter is 0.1528, the stated error 0.1 / sqrt(3)
        self.assertRegex(done.stdout, r'\n  lambda_max +3\.10\(15\) +0\.058 +0\.15 +7\.00 +3\n')
        self.assertRegex(done.stdout, r'\n  T\(1,0\) +1\.10\(15\) +0\.058 +0\.15 +7\.00 +3\n')
        self.assertRegex(done.stdout, r'\n  c_T +1\.400\(12\) +0\.012 +0\.011 +0\.00 +3  c k')
        self.assertRegex(done.stdout, r'    37   1\.10000  0\.15275\n')
        names = {'spectrum.png', 'steps.png', 'dispersion.png'}
        self.assertEqual(
            set(
                filter(
                    lambda name: name.endswith('.png'), os.listdir(os.path.join(self.folder, 'out'))
                )
            ),
            names,
        )

    def test_resumed(self):
        """The averages of the last, the course of all."""
        a = self.write('a', run(range(1, 7)))
        b = self.write('b', run(range(5, 9), 'two', resumed_time=104.0))
        done = self.plot(a, b)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertRegex(done.stdout, r'averaged time +8\n')
        self.assertIn('lambda_max      3.080000 +- 0.010000', done.stdout)

    def test_others(self):
        done = self.plot(self.seed(1, 0.0), self.seed(2, 0.0, density=0.6))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(
            done.stderr, r'\Aplot_bag: .* do not belong together: density is ' r'0\.5 and 0\.6\n\Z'
        )
        self.assertFalse(os.path.exists(os.path.join(self.folder, 'out')))

    def test_comparison(self):
        """Means agree within the larger one of their errors; single runs of them need not."""
        a = [self.seed(k, shift, error=0.01) for k, shift in enumerate((-0.2, 0.1, 0.1))]
        b = [self.seed(k, shift, error=0.01) for k, shift in enumerate((0.2, 0.0, 0.0), 5)]
        status, text, error = tool('compare', *a, '--with', *b)
        self.assertEqual((status, error), (0, ''))
        # (0.0667 - 0) / 0.12
        self.assertRegex(text, r'lambda_max +3\.00\(10\) +3\.067\(67\) +0\.07\(12\) +\+0\.55')
        self.assertNotIn('the same seed', text)
        self.assertEqual(tool('compare', a[0], b[0])[0], 1)
        status, text, _ = tool('compare', *a, '--with', a[0])
        self.assertIn('the same seed', text)
        status, text, error = tool('compare', *a)
        self.assertEqual(status, 2)
        self.assertIn('3 bags: two, or --with between those of both sides', error)

    def test_short_run(self):
        """Is in no mean, and said to be in none."""
        long, short = self.seed(1, 0.0), self.seed(2, 3.0, error=-1.0)
        said = r'seed2\.bag, seed 2, is left out: averaged over 50, too short to know its errors\n'
        done = self.plot(long, short)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertRegex(done.stdout, r'\n  lambda_max +3\.00\(10\) +0\.1 +- +- +1\n')
        self.assertRegex(done.stdout, said)
        status, text, error = tool('compare', long, short, '--with', self.seed(3, 0.0))
        self.assertEqual((status, error), (0, ''))
        self.assertRegex(text, r'lambda_max +3\.00\(10\) +3\.00\(10\) ')
        self.assertRegex(text, r'\na: .*' + said)


class Export(Tools):
    def setUp(self):
        super().setUp()
        drawn = mock.patch('hdlyap.plots.figures.draw_all', lambda *_: [])
        drawn.start()
        self.addCleanup(drawn.stop)
        self.bag = self.write('run', numbered(made.small_run()))
        self.csv = os.path.join(self.folder, 'csv')
        self.npz = os.path.join(self.folder, 'arrays')

    def test_csv(self):
        done = self.plot(self.bag, '--csv', self.csv)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        run_ = hdlyap.load(self.bag)
        names = ('results', 'spectrum', 'steps', 'phases', 't_phases', 'cost', 'status')
        names += ('exponents', 'std_errors', 'local_exponents')
        self.assertEqual(sorted(os.listdir(self.csv)), sorted(name + '.csv' for name in names))
        for name in ('spectrum', 'steps', 'phases', 'cost'):
            with open(os.path.join(self.csv, name + '.csv')) as file:
                head = [next(file), next(file)]
            self.assertRegex(head[0], r'^# hdlyap 0\.1\.0, scene made, N = 20, .*, seed 1\n')
            frame = getattr(run_, name)
            for column, unit in frame.attrs['units'].items():
                self.assertEqual(f' {column} [{unit}]' in head[1], bool(unit), column)
            again = pandas.read_csv(os.path.join(self.csv, name + '.csv'), comment='#', index_col=0)
            pandas.testing.assert_frame_equal(again, frame, check_dtype=False, rtol=1e-14)
        table = np.genfromtxt(
            os.path.join(self.csv, 'exponents.csv'), delimiter=',', comments='#', skip_header=3
        )
        np.testing.assert_allclose(table[:, 2:], run_.exponents, rtol=1e-15)
        np.testing.assert_array_equal(table[:, 0], run_.times)

    def test_npz(self):
        done = self.plot(self.bag, '--npz', self.npz)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        run_ = hdlyap.load(self.bag)
        with np.load(self.npz) as arrays:
            np.testing.assert_array_equal(arrays['exponents'], run_.exponents)
            np.testing.assert_array_equal(arrays['exponents.sim_time'], run_.times)
            np.testing.assert_array_equal(arrays['local_exponents'], run_.local.exponents)
            np.testing.assert_array_equal(arrays['steps.std_error'], run_.steps.std_error)
            self.assertEqual(list(arrays['steps.step']), list(run_.steps.index))
            self.assertEqual(json.loads(str(arrays['info']))['disks'], 20)
            units = json.loads(str(arrays['units']))
        self.assertEqual(units['exponents'], '1/time unit')
        self.assertEqual(units['cost.wall_seconds'], 's')

    def test_seeds(self):
        seeds = [self.seed(k, 0.1 * k) for k in range(3)]
        done = self.plot(*seeds, '--csv', self.csv)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        again = pandas.read_csv(os.path.join(self.csv, 'steps.csv'), comment='#', index_col=0)
        np.testing.assert_allclose(again.exponent, [1.1, 1.5])
        np.testing.assert_allclose(again.scatter, 0.1 / np.sqrt(3))

    def test_trajectory_only(self):
        bag = self.write('bare', [made.run_info(), made.cost(1), made.cost(2)])
        done = self.plot(bag, '--csv', self.csv)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(os.listdir(self.csv), ['cost.csv'])

    def test_gas_and_widths(self):
        bag = self.write(
            'gas', [made.run_info(), made.gas(), made.localization([0.25, 0.5]), made.cost(1)]
        )
        done = self.plot(bag, '--csv', self.csv, '--npz', self.npz)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(sorted(os.listdir(self.csv)), ['cost.csv', 'gas.csv', 'localization.csv'])
        gas = pandas.read_csv(os.path.join(self.csv, 'gas.csv'), comment='#', index_col=0)
        self.assertEqual(gas.value['pressure'], 1.25)
        self.assertEqual(gas.unit['pressure'], '1/sigma^2')
        widths = os.path.join(self.csv, 'localization.csv')
        widths = pandas.read_csv(widths, comment='#', index_col=0)
        np.testing.assert_array_equal(widths.width, [0.25, 0.5])
        with np.load(self.npz) as arrays:
            np.testing.assert_array_equal(arrays['localization.width'], [0.25, 0.5])
            self.assertEqual(arrays['gas.value'][0], 3.25)

    def test_gas_of_seeds(self):
        bags = [
            self.write(
                f'gas{seed}',
                [
                    made.run_info(seed=str(seed), run_id=str(seed)),
                    made.gas(50.0, run_id=str(seed), pressure=1.0 + 0.25 * seed),
                ],
            )
            for seed in (1, 2, 3)
        ]
        mean = hdlyap.load(*bags).gas
        self.assertAlmostEqual(mean.value['pressure'], 1.5)
        self.assertAlmostEqual(mean.std_error['pressure'], 0.01 / np.sqrt(3))
        self.assertAlmostEqual(mean.scatter['pressure'], 0.25 / np.sqrt(3))
        self.assertEqual(mean.unit['pressure'], '1/sigma^2')


class Hostile(Tools):
    def test_more_than_the_memory(self):
        path = self.write('a', made.small_run())
        with mock.patch('rosbag.Bag._read_message', side_effect=MemoryError):
            for _, _, error in self.all_tools(path):
                self.assertIn('a.bag: needs more memory than there is', error)

    def test_escapes_in_names(self):
        texts = dict.fromkeys(('scene', 'version', 'run_id', 'blas_kernel', 'exponents'), ESCAPE)
        info = made.run_info(**texts, observables=[ESCAPE])
        spectrum = made.spectrum(HALF, 50.0, run_id=ESCAPE)
        for status, _, error in self.all_tools(self.write('a', [info, spectrum])):
            self.assertEqual((status, error), (0, ''))
        made.write(self.path('a'), [info], node='/' + ESCAPE, mode='a')
        for status, _, error in self.all_tools(self.path('a')):
            self.assertIn('several nodes, choose one with --node: ', error)

    def test_long_names(self):
        """100,000 letters in a name took minutes."""
        long = 'x ' * 50000
        info = made.run_info(scene=long, version=long, boundary_x=long, observables=[long] * 99)
        bag = self.write('a', [info, made.spectrum(HALF, 50.0)])
        for status, out, _ in self.all_tools(bag):
            self.assertEqual(status, 0)
            self.assertLess(len(out), 50000)

    def test_formula_in_a_name(self):
        info = made.run_info(scene=r'a $\frac{ b $ $')
        bag = self.write('a', [info, made.spectrum(HALF, 50.0)])
        done = self.plot(bag)
        self.assertEqual((done.returncode, done.stderr), (0, ''))

    def test_numbers_that_do_not_fit_together(self):
        info = made.run_info()
        short, empty = made.spectrum(HALF, 50.0), made.spectrum(HALF, 50.0)
        short.std_errors = short.std_errors[:-1]
        for name in ('exponents', 'std_errors', 'local_exponents', 'cos_theta', 'dp_dq_ratio'):
            setattr(empty, name, [])
        for said, messages in (
            ('its arrays have [36, 37] elements', [info, short]),
            ('no exponents', [info, empty]),
            ('0 disks', [made.run_info(disks=0), made.spectrum(HALF, 50.0)]),
            ('nan', [made.run_info(box_x=float('nan')), made.spectrum(HALF, 50.0)]),
        ):
            bag = self.write('a', messages)
            for (status, _, error), fault in list(zip(self.all_tools(bag), (1, 2, 1)))[:2]:
                self.assertEqual(status, fault)
                self.assertIn('a.bag: damaged: ', error)
                self.assertIn(said, error)

    def test_structure_that_does_not_fit_together(self):
        info = made.run_info()
        unlike = Structure(run_id=info.run_id, peak=[0, 0], amplitude_along=[0.0] * 8)
        bag = self.write('a', [info, made.spectrum(HALF, 50.0), unlike])
        status, _, error = next(iter(self.all_tools(bag)))
        self.assertEqual(status, 1)
        self.assertIn('a.bag: damaged: hdlyap/Structure: [0, 8] elements of 2 vectors', error)

    def test_what_nobody_has_foreseen(self):
        """Of compare 1 says that runs differ; a mistake in it is no difference."""
        bag = self.write('a', [made.run_info(), made.spectrum(HALF, 50.0)])
        with mock.patch('hdlyap.plots.verdict.report', lambda _: [][0]):
            status, _, error = self.check('compare', bag, bag, fault=2)
        self.assertEqual(status, 2)
        self.assertIn('makes no sense here: IndexError: list index out of range (', error)

    def test_bytes(self):
        """Single bytes of a bag, and pieces of it, are others."""
        rng = np.random.default_rng(4)
        path = self.write('a', made.small_run()[:12])
        with open(path, 'rb') as file:
            whole = np.frombuffer(file.read(), dtype=np.uint8)
        outcomes = set()
        for trial in range(40):
            content = whole.copy()
            if trial % 2:
                place = rng.integers(len(content), size=3)
                content[place] = rng.integers(256, size=3)
            else:
                first = rng.integers(len(content) - 64)
                content[first : first + 64] = rng.integers(256, size=64)
            content.tofile(self.path('b'))
            outcomes |= {status for status, *_ in self.all_tools(self.path('b'))}
        self.assertLessEqual({0, 1, 2}, outcomes)


if __name__ == '__main__':
    unittest.main()
