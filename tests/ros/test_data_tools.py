"""hdlyap plot and compare of several bags, what plot exports, and bags that somebody has made to do
harm."""

import json
import os
import sys
import xmlrpc.client
from unittest import mock

import numpy as np
import pandas
import rosbag
import rospy
from matplotlib.figure import Figure
from matplotlib.image import imread

import hdlyap
from hdlyap import topics
from hdlyap.data import fits, frames, reader
from hdlyap.msg import Structure
from hdlyap.plots.figures import Drawn
from std_msgs.msg import String
import made
from bags import process, tool
from made import LP, T
from measured import as_sent
from test_data import Loaded
from test_data_joined import HALF, numbered

CURVED = 'c k + c2 k^2'
ESCAPE = '\x1b]0;gone\x07\x1b[2J\u202e'
TOOLS = dict(plot=1, compare=2, repeat=1)  # and their exit statuses of a fault


def draw_nothing(run, *_):
    """Reads what figures alone ask for."""
    if not run.is_mean:
        run.structure, run.phases, run.fields(), run.cost()
    return Drawn([], [], [], [])


class Tools(Loaded):
    def seed(self, number, shift, error=0.1, **fields):
        name = f'{fields.get("density", "")}seed{number}'
        info = made.run_info(run_id=name, seed=str(number), **fields)
        wave = dict(exponent=1 + shift, std_error=error, multiplicity=1.5 + shift)
        found = [
            made.step(info, T, 1, 0, 36, 37, **wave),
            made.step(info, LP, 1, 0, 32, 35, exponent=1.4 + shift, std_error=error),
        ]
        spectrum = made.spectrum(HALF + shift, 50.0, run_id=name, error=error)
        return self.write([info, spectrum, made.steps(found, run_id=name)], name)

    def plot(self, *arguments):
        """What it prints."""
        return self.succeeds('plot', '--out', self.out, *arguments)

    def check(self, name, *arguments):
        """What it did: one line if the status is the one of a fault, nothing for a terminal."""
        done = tool(name, *arguments)
        self.assertIn(done.status, {'compare': (0, 1, 2)}.get(name, (0, 1)))
        for line in (done.out + done.error).splitlines():
            self.assertTrue(line.isprintable(), line)
            self.assertLess(len(line), 10000)
        if done.error:
            self.assertEqual(done.status, TOOLS[name], done.error)
            self.assertEqual(done.error.count('\n'), 1, done.error)
            self.assertTrue(done.error.startswith(f'hdlyap {name}: '))
        return done

    def all_tools(self, bag):
        with mock.patch('hdlyap.plots.figures.draw_all', draw_nothing):
            plotted = self.check('plot', bag, '--out', self.out)
        return plotted, self.check('compare', bag, bag), self.check('repeat', bag)


class Fits(Tools):
    def test_another_form(self):
        """Of exponents 2 k + 0.3 k^2 at three wave numbers: of all, and of the first two."""
        info = made.run_info()
        found = [made.step(info, T, n, 0, 38 - 2 * n, 39 - 2 * n) for n in (1, 2, 3)]
        for step in found:
            step.exponent = (2 + 0.3 * step.wave_number) * step.wave_number
        path = self.write([info, made.spectrum(HALF, 50.0), made.steps(found)])
        curved = hdlyap.load(path, form=CURVED).results
        np.testing.assert_allclose(curved['value'][['c_T', 'c_T2']], [2, 0.3], rtol=1e-9)
        self.assertNotIn('c_T3', curved.index)
        self.assertNotIn('c_L', curved.index)
        two = hdlyap.load(path, form='c k', k=(0, 2.1 * made.K)).results
        between = [2 + 0.3 * n * made.K for n in (1, 2)]
        self.assertTrue(between[0] < two['value']['c_T'] < between[1])
        self.assertIn('c k over 2 wave numbers 0.9935 .. 1.987', two['basis']['c_T'])
        text = self.plot(path, '--form', 'c k', '--k', '0', '2.1')
        self.assertIn('\n  T steps: c k over 2 wave numbers 0.9935 .. 1.987 (lever', text)
        # the node's is not made again
        own = hdlyap.load(path, form='c k + c2 k^2 + c3 k^3').results
        self.assertTrue(own.equals(hdlyap.load(path).results))
        with self.assertRaisesRegex(hdlyap.data.reader.RecordingError, "form 'k': must be one of"):
            hdlyap.load(path, form='k').results
        self.refuses('k from 2 to 1: must go up', 'plot', path, '--k', '2', '1')
        self.refuses("k from 1 to 2: must be with the form 'c k' or", 'plot', path, '--k', '1', '2')


class Several(Tools):
    def test_seeds(self):
        text = self.plot(*(self.seed(k, shift) for k, shift in enumerate((-0.1, 0.0, 0.4))))
        # the scatter is 0.1528, the stated error 0.1 / sqrt(3)
        for row in (
            'seed 0, 1, 2, hdlyap 0.1.0, means over seeds',
            r'\n  lambda_max +3\.10\(15\) +0\.058 +0\.15 +7\.00 +3\n',
            r'\n  T\(1,0\) +1\.10\(15\) +0\.058 +0\.15 +7\.00 +3\n',
            r'\n  c_T +1\.400\(12\) +0\.012 +0\.011 +0\.00 +3  c k',
            r'    37     1\.10\(15\)\n',
            r'T\(1,0\) +36-37 +1\.60 +2 ',
        ):
            self.assertRegex(text, row)
        drawn = {name for name in os.listdir(self.out) if name.endswith('.png')}
        self.assertEqual(drawn, {'spectrum.png', 'steps.png', 'dispersion.png'})

    def test_others(self):
        pair = self.seed(1, 0.0), self.seed(2, 0.0, density=0.6)
        said = r'\Ahdlyap plot: .* do not belong together: density is 0\.5 and 0\.6\n\Z'
        self.refuses(said, 'plot', *pair, '--out', self.out)
        self.assertFalse(os.path.exists(self.out))

    def test_comparison(self):
        """Means agree within the larger one of their errors; single runs of them need not."""
        a = [self.seed(k, shift, error=0.01) for k, shift in enumerate((-0.2, 0.1, 0.1))]
        b = [self.seed(k, shift, error=0.01) for k, shift in enumerate((0.2, 0.0, 0.0), 5)]
        text = self.succeeds('compare', *a, '--with', *b)
        # (0.0667 - 0) / 0.12
        self.assertRegex(text, r'lambda_max +3\.00\(10\) +3\.067\(67\) +0\.07\(12\) +\+0\.55')
        self.assertNotIn('the same seed', text)
        self.succeeds('compare', a[0], b[0], status=1)
        self.assertIn('the same seed', tool('compare', *a, '--with', a[0]).out)
        status, _, error = tool('compare', *a)
        self.assertEqual(status, 2)
        self.assertIn('3 bags: must be two, or bags of both sides with --with between', error)

    def test_short_run(self):
        """Is in no mean, and said to be in none."""
        long, short = self.seed(1, 0.0), self.seed(2, 3.0, error=-1.0)
        said = r'seed2\.bag, seed 2, is left out: averaged over 50, too short to know its errors\n'
        text = self.plot(long, short)
        self.assertRegex(text, r'\n  lambda_max +3\.00\(10\) +0\.1 +- +- +1\n')
        self.assertRegex(text, said)
        text = self.succeeds('compare', long, short, '--with', self.seed(3, 0.0))
        self.assertRegex(text, r'lambda_max +3\.00\(10\) +3\.00\(10\) ')
        self.assertRegex(text, r'\na: .*' + said)


class WithoutInfo(Tools):
    """A part of a bag, as of rosbag filter."""

    def test_tools(self):
        """Draw and print what needs no parameter, and name the rest."""
        _, *messages = made.small_run()
        text = self.plot(self.write(numbered(messages)))
        for said in (
            '\\Arun one: no run_info in the bag, so its parameters are not known\n',
            r'\nlambda_max      9\.000\(10\)',
            r'\nsum of the 37 exponents carried ',
            r'\n  T\(1,0\) +36-37 +1\.98 +2 ',
            r'\n  c_T +1\.400\(12\)\n',
            r'\nnot here, as it needs run_info: the last exponents\n',
            r'\nnot drawn, as they need run_info: spectrum, convergence, modes, p_mode\n',
        ):
            self.assertRegex(text, said)
        drawn = {name for name in os.listdir(self.out) if name.endswith('.png')}
        wanted = {'steps.png', 'dispersion.png', 'phases.png', 'cost.png'}
        self.assertEqual(drawn, wanted)
        path = self.path()
        for name, more, status in (
            ('compare', [path], 2),
            ('movie', ['--out', self.path('a') + '.mp4'], 1),
            ('repeat', [], 1),
            ('table', [], 1),
        ):
            self.refuses(
                f'hdlyap {name}: {path}: no run_info in it', name, path, *more, status=status
            )

    def test_steps_and_phases_alone(self):
        kept = ('hdlyap/Steps', 'hdlyap/LpPhases')
        messages = [one for one in made.small_run() if one._type in kept]
        text = self.plot(self.write(messages), '--csv', self.path('csv'))
        self.assertRegex(text, r'\n  LP\(1,0\) +1\.59\d+\(\d+\) +1\.600\(16\) +8 of 8\n')
        names = {os.path.splitext(name)[0] for name in os.listdir(self.path('csv'))}
        self.assertLessEqual({'steps', 'lp_phases'}, names)


def topic_of(name):
    """The topic of a table, or of a variable of a Dataset."""
    found = (one for one in topics.RECORDED if f'{name}_'.startswith(one + '_'))
    return max(found, key=len, default='spectrum')


def numbers_of(message):
    """Yields (name of its column, numbers) of the fields of a message and of its lists that have
    some."""
    for slot, kind in zip(message.__slots__, message._slot_types):
        value, name = getattr(message, slot), frames.singular(slot) if '[' in kind else slot
        if '/' in kind and value and '[' in kind:
            each = [dict(numbers_of(one)) for one in value]
            yield from ((key, np.concatenate([one[key] for one in each])) for key in each[0])
        elif '/' not in kind and 'string' not in kind and np.size(value) and slot not in LABELS:
            yield name, np.ravel(value).astype(float)


LABELS = 'sim_time first_index index indices time spaces step set gap gap_error'.split()
LABELS += [*frames.NAMES, 'modulation', *frames.OF_SPHERES, *frames.OF_TURNING]  # words, of others


def ends_with(column, values):
    """Whether the last known numbers are the known ones of these, in their order."""
    column, values = (
        one[~np.isnan(one) & (one != -1)] for one in (np.ravel(column).astype(float), values)
    )
    return len(column) >= len(values) and np.array_equal(
        column[len(column) - len(values) :], values
    )


class Export(Tools):
    def setUp(self):
        super().setUp()
        drawn = mock.patch('hdlyap.plots.figures.draw_all', draw_nothing)
        drawn.start()
        self.addCleanup(drawn.stop)
        self.csv = os.path.join(self.folder, 'csv')
        self.npz = os.path.join(self.folder, 'arrays')

    def export(self, *bags):
        """What hdlyap plot writes of them: the names of tables."""
        self.plot(*bags, '--csv', self.csv, '--npz', self.npz)
        return sorted(name[: -len('.csv')] for name in os.listdir(self.csv))

    def test_a_bag_is_not_overwritten(self):
        """By a slip of its name."""
        bag = self.write(made.small_run())
        with open(bag, 'rb') as file:
            before = file.read()
        done = self.check('plot', bag, '--out', self.out, '--npz', bag)
        self.assertEqual(
            done.error,
            f'hdlyap plot: {bag}: must be another file: it is a bag, which is not overwritten\n',
        )
        with open(bag, 'rb') as file:
            self.assertEqual(file.read(), before)

    def table(self, name, index_col=0):
        path = os.path.join(self.csv, name + '.csv')
        return pandas.read_csv(path, comment='#', index_col=index_col, float_precision='round_trip')

    def test_everything(self):
        bag = self.write(numbered(made.small_run()))
        names = self.export(bag)
        run_ = hdlyap.load(bag)
        of_arrays = ['spectrum', 'steps', 'lp_phases', 't_phases', 'fields']
        wanted = [name for one in of_arrays for name in (one, one + '_over_time')]
        wanted += ['results', 'cost', 'status', 'fields_pair', 'fields_pair_particle']
        self.assertEqual(names, sorted(wanted + ['exponents', 'std_errors', 'local_exponents']))
        for name in ('spectrum', 'steps', 'cost'):
            with open(os.path.join(self.csv, name + '.csv')) as file:
                head = [next(file), next(file)]
            self.assertRegex(head[0], r'^# hdlyap 0\.1\.0, scene made, N = 20, .*, seed 1\n')
            frame = getattr(run_, name)
            for column, unit in frame.attrs['units'].items():
                self.assertEqual(f' {column} [{unit}]' in head[1], bool(unit), column)
            pandas.testing.assert_frame_equal(
                self.table(name), frame, check_dtype=False, rtol=1e-14
            )
        exponents = self.table('exponents').reset_index().to_numpy()
        np.testing.assert_allclose(exponents[:, 2:], run_.exponents, rtol=1e-15)
        np.testing.assert_array_equal(exponents[:, 0], run_.times)
        with np.load(self.npz) as arrays:
            for name, values in (
                ('exponents', run_.exponents),
                ('exponents.sim_time', run_.times),
                ('local_exponents', run_.local.exponents),
                ('steps.std_error', run_.steps.std_error),
            ):
                np.testing.assert_array_equal(arrays[name], values)
            self.assertEqual(list(arrays['steps.step']), list(run_.steps.index))
            self.assertEqual(json.loads(str(arrays['info']))['number'], 20)
            units = json.loads(str(arrays['units']))
        self.assertEqual(units['exponents'], '1/time unit')
        self.assertEqual(units['cost.wall_seconds'], 's')

    def test_seeds(self):
        self.export(*(self.seed(k, 0.1 * k) for k in range(3)))
        again = self.table('steps')
        np.testing.assert_allclose(again.exponent, [1.1, 1.5])
        np.testing.assert_allclose(again.scatter, 0.1 / np.sqrt(3))

    def test_without_exponents(self):
        info = made.run_info()
        self.assertEqual(self.export(self.write([info, made.cost(1), made.cost(2)])), ['cost'])
        messages = [info, made.gas(), made.localization([0.25, 0.5]), made.cost(1)]
        messages.append(made.fluctuations([0.5, 0.25]))
        found = ['fluctuations', 'gas', 'localization']
        of_growth = ['fluctuations_growth_time', 'fluctuations_growth_time_index']
        self.assertEqual(
            self.export(self.write(messages)),
            sorted([*(one + '_over_time' for one in found), 'cost', *found, *of_growth]),
        )
        gas = self.table('gas')
        self.assertEqual((gas.value['pressure'], gas.unit['pressure']), (1.25, '1/sigma^2'))
        np.testing.assert_array_equal(self.table('localization').width, [0.25, 0.5])
        with np.load(self.npz) as arrays:
            np.testing.assert_array_equal(arrays['localization.width'], [0.25, 0.5])
            self.assertEqual(arrays['gas.value'][0], 3.25)

    def test_each_field_once(self):
        """Of every topic, as its .msg has it: in one table, and in one variable of the Dataset."""
        from test_strangers import every_kind  # which has imported this module

        messages = every_kind()
        messages = numbered(messages + made.others(messages, messages[0]))
        bag = self.write(messages)
        names = self.export(bag)
        tables = {name: self.table(name, index_col=None) for name in names}
        of_all, seen = hdlyap.load(bag).to_xarray(), 0
        for topic, kind in [one for one in topics.RECORDED.items() if one[0] != 'run_info']:
            found = [one for one in messages if isinstance(one, kind)]
            last = max(found, key=lambda one: getattr(one, 'index', one.sim_time))
            mine = [frame for name, frame in tables.items() if topic_of(name) == topic]
            held = [str(name) for name in of_all if topic_of(name) == topic]
            for name, values in numbers_of(as_sent(last)):
                columns = [frame[name] for frame in mine if name in frame]
                self.assertTrue(any(ends_with(one, values) for one in columns), (topic, name))
                found = [of_all[one] for one in held if one.endswith(('_' + name, name + 's'))]
                self.assertTrue(any(ends_with(one, values) for one in found), (topic, name))
                seen += 1
        self.assertGreater(seen, 150)
        named = {'covariant', 'covariant_step_index', 'covariant_over_time', 'lp_phases'}
        self.assertLessEqual(named, set(names))  # as the guide has them
        self.assertEqual(of_all['covariant_weights_dq'].dims[1:], ('subspace', 'vector'))

    def test_means_with_gas(self):
        """The means over seeds have the gas, and name what they do not have."""
        bags = []
        for seed in (1, 2):
            info = made.run_info(run_id=f'{seed}', seed=f'{seed}')
            gas = made.gas(run_id=info.run_id, pressure=1.0 + 0.1 * seed, error=0.02)
            phases = made.t_phases([made.step(info, T, 1, 0, 2, 3)], 150.0, run_id=info.run_id)
            spectrum = made.spectrum(HALF, 50.0, run_id=info.run_id)
            bags.append(self.write([info, gas, phases, spectrum], f'{seed}'))
        text = self.plot(*bags)
        self.assertRegex(text, r'\ngas, averaged over 100\n')
        self.assertRegex(text, r'\npressure +1\.150\(50\) per sigma\^2\n')
        self.assertIn('\nno means, see the single runs: t_phases\n', text)
        os.remove(bags[1])
        bags[1] = self.write([info, spectrum], 'no')
        self.assertIn('\nno means, see the single runs: gas, t_phases\n', self.plot(*bags))

    def test_gas_of_seeds(self):
        """Weighted with their times."""
        bags = []
        for seed, time in (('1', 50.0), ('2', 50.0), ('3', 100.0)):
            gas = made.gas(time, run_id=seed, pressure=1.0 + 0.25 * int(seed))
            bags.append(self.write([made.run_info(seed=seed, run_id=seed), gas], 'gas' + seed))
        mean = hdlyap.load(*bags).gas
        self.assertAlmostEqual(mean.value['pressure'], 1.5625)
        self.assertAlmostEqual(mean.std_error['pressure'], 0.01 * np.sqrt(6) / 4)
        squares = np.array([0.3125, 0.0625, 0.1875]) ** 2
        self.assertAlmostEqual(mean.scatter['pressure'], np.sqrt(squares @ [1, 1, 2] / (4 * 2)))
        self.assertEqual(mean.unit['pressure'], '1/sigma^2')

    def test_averages_of_seeds(self):
        """As those of a gas; in the text and in the tables."""
        bags = []
        for seed, time in (('1', 50.0), ('2', 150.0)):
            told = made.averages(time, run_id=seed, kinetic=float(seed), stretch=0.5)
            bags.append(self.write([made.run_info(seed=seed, run_id=seed), told], 'told' + seed))
        mean = hdlyap.load(*bags).averages
        self.assertAlmostEqual(mean.value['kinetic'], 1.75)
        self.assertAlmostEqual(mean.std_error['kinetic'], 0.01 * np.sqrt(10) / 4)
        self.assertEqual(mean.unit['kinetic'], 'energy')
        self.assertRegex(self.plot(*bags), r'\naverages, over 200\nkinetic +1\.75\(43\) energy\n')
        self.assertRegex(
            self.plot(bags[1]), r'\naverages, over 150\nkinetic +2\.000\(10\) energy\n'
        )

    def test_sums_of_seeds_that_contract(self):
        """The sum of all exponents and the Kaplan-Yorke dimension are means, too."""
        bags = []
        for seed in (1, 2):
            exponents = np.array([0.5, 0.001, -0.3, -0.451]) - 0.01 * seed
            one = made.spectrum(exponents, 50.0, run_id=f'{seed}', divergence=-0.25)
            one.kaplan_yorke, one.kaplan_yorke_error = 3.4 + 0.01 * seed, 0.02
            info = made.run_info(number=1, zero_exponents=1, run_id=f'{seed}', seed=f'{seed}')
            bags.append(self.write([info, one], f'sum{seed}'))
        mean = hdlyap.load(*bags)
        names = ['exponent_sum', 'kaplan_yorke']
        np.testing.assert_allclose(mean.results.value[names], [-0.31, 3.415])
        np.testing.assert_allclose(mean.results.std_error[names], np.array([0.01, 0.02]) / 2**0.5)
        text = self.plot(*bags)
        self.assertRegex(text, r'\n *kaplan_yorke +3\.415\(14\)')
        one.kaplan_yorke = np.nan  # as of exponents that are too few
        mean = hdlyap.load(bags[0], self.write([info, one], 'few'))
        self.assertEqual(list(mean.results.index), ['lambda_max', 'h_KS', 'exponent_sum'])

    def soft(self, seed, step, temperature):
        own = ['potential=wca', f'time_step={step}']
        info = made.run_info(seed=seed, run_id=seed, own=own)
        warm = made.soft_gas(run_id=seed, temperature=temperature)
        return self.write([info, warm], 'soft' + seed)

    def test_gas_of_soft_seeds(self):
        """Of steps of one length alone: their temperatures and exponents differ by the steps."""
        bags = self.soft('1', 0.01, 0.6), self.soft('2', 0.01, 0.7), self.soft('3', 0.005, 0.7)
        mean = hdlyap.load(*bags[:2]).gas
        self.assertNotIn('collision_rate', mean.index)
        self.assertAlmostEqual(mean.value['temperature'], 0.65)
        self.assertAlmostEqual(mean.scatter['temperature'], 0.05)
        said = r'\Ahdlyap plot: .* do not belong together: time_step is 0\.01 and 0\.005'
        self.refuses(said, 'plot', bags[0], bags[2], '--out', self.out)


class Refused(Tools):
    """Each tool says in one line what is wrong with a bag."""

    def refused(self, reason):
        for done in self.all_tools(self.path('a')):
            self.assertRegex(done.error, reason)
        self.assertFalse(os.path.exists(self.out))

    def content(self, data):
        with open(self.path('a'), 'wb') as file:
            file.write(data)

    def test_no_bag_of_a_run(self):
        self.refused('No such file')
        for content in b'', b'something else entirely\n' * 10:
            self.content(content)
            self.refused('a.bag: not a readable bag')
        with rosbag.Bag(self.path('a'), 'w') as bag:
            bag.write('/chatter', String('hello'), rospy.Time(1))
        self.refused('nothing in it was published by hdlyap_node')

    def test_several_nodes(self):
        """Until it is said which one."""
        for node, value, mode in (('/hdlyap', 3.0, 'w'), ('/far/away', 4.0, 'a')):
            self.write([made.run_info(), made.spectrum([value], 1.0)], 'a', node=node, mode=mode)
        self.refused('choose one with --node: /far/away, /hdlyap')
        self.refuses('no node other in it', 'plot', self.path('a'), '--node', 'other')
        self.assertIn('lambda_max      4.0', self.plot(self.path('a'), '--node', 'far/away'))

    def test_unfinished(self):
        bag = rosbag.Bag(self.path('a'), 'w')
        bag.write('/hdlyap/run_info', made.run_info(), rospy.Time(1))
        bag.flush()
        with open(self.path('a'), 'rb') as file:
            content = file.read()
        bag.close()
        self.content(content)
        self.refused('rosbag reindex')
        os.rename(self.path('a'), self.path('a') + '.active')
        self.refused(r'a\.bag\.active is there: .* rosbag reindex .*\.active$')
        self.write([made.run_info(), made.spectrum(HALF, 5.0)], 'a')
        with open(self.path('a'), 'rb') as file:
            content = file.read()
        for length in (1, 100, len(content) // 2, len(content) - 1):
            self.content(content[:length])
            self.refused('rosbag reindex|not a readable bag')
        self.content(content.replace(b'\3\0\0\0one', b'\3\0\0\0\xff\xff\xff'))  # is no text
        self.refused('a.bag: damaged')


class Hostile(Tools):
    def test_more_than_the_memory(self):
        path = self.write(made.small_run(), 'a')
        with mock.patch('rosbag.Bag._read_message', side_effect=MemoryError):
            for _, _, error in self.all_tools(path):
                self.assertIn('a.bag: needs more memory than there is', error)

    def test_escapes_in_names(self):
        texts = dict.fromkeys(('scene', 'version', 'run_id', 'blas_kernel', 'exponents'), ESCAPE)
        info = made.run_info(**texts, observables=[ESCAPE])
        spectrum = made.spectrum(HALF, 50.0, run_id=ESCAPE)
        for status, _, error in self.all_tools(self.write([info, spectrum], 'a')):
            self.assertEqual((status, error), (0, ''))
        self.write([info], 'a', node='/' + ESCAPE, mode='a')
        for status, _, error in self.all_tools(self.path('a')):
            self.assertIn('several nodes, choose one with --node: ', error)

    def test_what_does_not_fit_together(self):
        info = made.run_info()
        short, empty = made.spectrum(HALF, 50.0), made.spectrum(HALF, 50.0)
        short.std_errors = short.std_errors[:-1]
        for name in ('exponents', 'std_errors', 'local_exponents', 'cos_theta', 'dp_dq_ratio'):
            setattr(empty, name, [])
        unlike = Structure(run_id=info.run_id, peak=[0, 0], amplitude_along=[0.0] * 8)
        good = made.spectrum(HALF, 50.0)
        for said, count, messages in (
            ('std_errors has 36 elements: must be 37', 2, [info, short]),
            ('no exponents', 2, [info, empty]),
            ('number = 0: must be from 1 to 1000000', 2, [made.run_info(number=0), good]),
            ('nan', 2, [made.run_info(box_x=float('nan')), good]),
            (
                'hdlyap/Structure: amplitude_across has 0 elements: must be 8',
                1,
                [info, good, unlike],
            ),
        ):
            done = self.all_tools(self.write(messages, 'a'))[:count]
            self.assertEqual([one.status for one in done], [1, 2][:count])
            for one in done:
                self.assertIn('a.bag: damaged: ', one.error)
                self.assertIn(said, one.error)

    def test_who_is_to_blame(self):
        """Of compare 1 says that runs differ; a mistake in it is no difference. A bag is blamed for
        what a bag can do alone."""
        bag = self.write([made.run_info(), made.spectrum(HALF, 50.0)])

        def missing_attribute(_):
            return None.verdict

        def draughtsman(_):
            Figure(figsize=(-1, 1))

        def in_a_folder_http(_):
            exec(compile('[][0]', '/home/me/http/own.py', 'exec'), {'__name__': 'own'})

        def nobody(_):
            xmlrpc.client.ServerProxy('http://localhost:1').getPid()

        def too_large(_):
            raise MemoryError('of a test')

        for fault, said in (
            (lambda _: [][0], r'unexpected contents in a bag \(.*\): IndexError: '),
            (in_a_folder_http, r'unexpected contents in a bag \(.*\): IndexError: '),
            (missing_attribute, 'a fault of hdlyap, not of what it reads: AttributeError: '),
            (draughtsman, 'cannot be drawn: ValueError: figure size must be positive'),
            (
                nobody,
                r'a node or the ROS master has not answered: \[Errno 111\] Connection refused',
            ),
            (too_large, 'needs more memory than there is: MemoryError'),
        ):
            with mock.patch('hdlyap.plots.verdict.report', fault):
                done = self.check('compare', bag, bag)
            self.assertEqual(done.status, 2)
            self.assertRegex(done.error, r'\Ahdlyap compare: ' + said)

    def test_fit_can_disagree(self):
        """Of steps on its curve the misfit is 0; of one that is five errors off it is not."""
        info = made.run_info()
        nodes = ((1, 0, 36, 37), (1, 1, 32, 35), (2, 0, 30, 31), (2, 1, 26, 29))
        found = [made.step(info, T, *one) for one in nodes]
        self.assertAlmostEqual(fits.chosen(made.steps(found), form=CURVED).t_misfit, 0.0)
        found[1].exponent += 5 * found[1].std_error
        self.assertGreater(fits.chosen(made.steps(found), form=CURVED).t_misfit, 2.5)

    def test_of_a_bag_that_is_open(self):
        """While somebody talks to a master: what is not the bag's stays as it is."""
        bag, master = self.write(made.small_run()), xmlrpc.client.ServerProxy('http://localhost:1')
        with self.assertRaises(ConnectionRefusedError), reader.opened(bag):
            master.getPid()
        with mock.patch('hdlyap.data.possible.space', None), self.assertRaises(AttributeError):
            hdlyap.load(bag)
        for odd in (KeyError('op'), PermissionError(13, 'Permission denied'), AttributeError('x')):
            with self.assertRaisesRegex(reader.RecordingError, '^' + bag), reader.opened(bag):
                raise odd

    def test_matplotlibrc_of_the_user(self):
        """Figures are as without it, whatever latex or backend there is not."""
        bag = self.write(made.small_run())
        with open(self.path('matplotlibrc'), 'w') as file:
            file.write('text.usetex: True\nbackend: pgf\nfigure.facecolor: 0.2\nfont.size: 30\n')
        rc = dict(os.environ, PATH='/nowhere', MATPLOTLIBRC=self.path('matplotlibrc'))
        plain, odd = self.path('plain'), self.path('odd')
        for out, more in ((plain, os.environ), (odd, dict(rc, MPLBACKEND='nonsense'))):
            done = process('plot', bag, '--out', out, '--pdf', out + '.pdf', env=more)
            self.assertEqual((done.status, done.error), (0, ''))
        for name in filter(lambda name: name.endswith('.png'), os.listdir(plain)):
            ours, other = (imread(os.path.join(folder, name)) for folder in (plain, odd))
            np.testing.assert_array_equal(ours, other, name)
        with open(self.path('matplotlibrc'), 'wb') as file:
            file.write(b'font.family: \xff\n')
        done = process('plot', bag, env=rc)
        self.assertEqual((done.status, done.error.count('Traceback')), (1, 0), done)
        self.assertIn("hdlyap plot: cannot start: 'utf-8' codec", done.error)

    def test_another_python(self):
        """Without numpy: which one it was, and which one to take."""
        loaded = hdlyap.data
        self.addCleanup(setattr, hdlyap, 'data', loaded)
        self.addCleanup(sys.modules.update, {'hdlyap.data': loaded})
        del sys.modules['hdlyap.data'], hdlyap.data
        with mock.patch.dict(sys.modules, {'numpy': None, 'hdlyap.data.seeds': None}):
            with self.assertRaisesRegex(ImportError, f'in {sys.executable}: .* /usr/bin/python3'):
                hdlyap.load('a.bag')

    def test_bytes(self):
        """Single bytes of a bag, and pieces of it, are others."""
        rng = np.random.default_rng(4)
        path = self.write(made.small_run()[:12], 'a')
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
