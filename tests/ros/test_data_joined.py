"""hdlyap.load of several bags: parts of one run, runs of several seeds, and what does not belong
together."""

import contextlib
import io
import os
import re
import shutil
import warnings
from unittest import mock

import numpy as np
import rosbag
import rospy
from scipy.special import erf
from scipy.stats import chi2 as chi_squared

import hdlyap
import made
from hdlyap.data.joined import UNSEEN
from hdlyap.data.reader import NoInfo
from hdlyap.data.seeds import Seeds, mean
from made import LP, T
from test_data import Loaded, state

HALF = np.linspace(3, 1, 37)
SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..')


def numbered(messages):
    """As a node numbers the messages of each topic."""
    counts = {}
    for message in messages:
        message.header.seq = counts[message._type] = counts.get(message._type, 0) + 1
    return messages


def run(times, run_id='one', **info):
    """Messages of a run that averages since 100, each of them known by its time."""
    messages = [made.run_info(run_id=run_id, resumed_time=-1.0, number=20)]
    for name, value in info.items():
        setattr(messages[0], name, value)
    for time in times:
        messages += [
            made.spectrum(HALF + 0.01 * time, time, run_id=run_id),
            made.cost(100.0 + time, run_id=run_id),
            state(100.0 + time, run_id=run_id),
        ]
    return numbered(messages)


class OneRun(Loaded):
    def check(self, loaded, times):
        """Each message once, in its order; the averages are those of the last message."""
        self.assertEqual(list(loaded.averaged_times), list(times))
        np.testing.assert_array_equal(loaded.exponents[:, 0], 3 + 0.01 * np.array(times))
        self.assertEqual(list(loaded.cost.index), [100 + time for time in times])
        self.assertEqual(loaded.spectrum.exponent[1], 3 + 0.01 * times[-1])
        self.assertEqual(list(loaded.state.times), [100 + time for time in times])
        for time, positions, _ in loaded.state:
            np.testing.assert_array_equal(loaded.state.positions(time), positions)

    def test_split_by_rosbag(self):
        """run_info is in each file, whatever their order; a copy of one adds nothing."""
        messages = run(range(1, 9))
        a = self.write(messages[:10], 'a')
        self.write([messages[0], *messages[10:]], 'b', start=60)
        for paths in ((a, self.path('b')), (self.path('b'), a)):
            self.check(hdlyap.load(*paths), range(1, 9))
        self.write(messages[:10], 'a', start=3600)  # the clock was set back after it
        self.check(hdlyap.load(a, self.path('b')), range(1, 9))
        shutil.copy(a, self.path('copy'))
        self.check(hdlyap.load(a, self.path('copy'), self.path('b'), a), range(1, 9))

    def test_parts_without_run_info(self):
        """Split without --repeat-latched: run_info is in the first file; the second one alone has
        numbers, and says what it lacks."""
        messages = run(range(1, 9))
        a = self.write(messages[:10], 'a')
        b = self.write(messages[10:], 'b', start=60)
        for paths in ((a, b), (b, a), ([b, a],)):
            loaded = hdlyap.load(*paths)
            self.check(loaded, range(1, 9))
            self.assertEqual(loaded.info.number, 20)
        alone = hdlyap.load(b)
        self.check(alone, range(4, 9))
        self.assertEqual(
            repr(alone), '<hdlyap run one: no run_info, so its parameters are not known>'
        )
        self.assertEqual(list(alone.results.index), ['lambda_max', 'sum of exponents'])
        with self.assertRaisesRegex(NoInfo, '^.*b.bag: no run_info in it, so number is not known$'):
            alone.info.number
        c = self.write(messages[16:], 'c', start=90)
        self.check(hdlyap.load(c, self.write(messages[10:16], 'b', start=60)), range(4, 9))
        other = self.write(run(range(1, 9), 'two')[1:], 'other')
        said = 'no run_info in it, so nothing says whether it belongs to .*$'
        self.cannot_load(said, b, other)
        self.cannot_load(said, a, other)
        self.cannot_load("^bag 7: must be the name of a file$", 7)

    def test_directions_without_run_info(self):
        """Steps and phases alone: of spheres their names have three numbers."""
        info = made.spheres()
        found = [made.step(info, T, 1, 0, 30, 33, nz=nz) for nz in (0, 1)]
        loaded = hdlyap.load(self.write([made.steps(found), made.t_phases(found, 150.0)]))
        self.assertEqual(list(loaded.steps.index), ['T(1,0,0)', 'T(1,0,1)'])
        self.assertEqual(set(loaded.t_phases.step), {'T(1,0,0)'})
        flat = hdlyap.load(self.write([made.steps(found[:1]), state(150.0)]))
        self.assertEqual(list(flat.steps.index), ['T(1,0)'])

    def test_clock_set_back(self):
        """In a recorder's file, which has the messages as they come, but their times in order."""
        a = self.write(run(range(1, 9)), 'a')
        with rosbag.Bag(a) as whole, rosbag.Bag(self.path('b'), 'w') as bag:
            for topic, message, time in whole.read_messages():
                bag.write(topic, message, rospy.Time((time.secs - 15) % 3600 + 1))
            for index in bag._curr_chunk_connection_indexes.values():
                index.sort(key=lambda entry: entry.time)
        self.check(hdlyap.load(self.path('b')), range(1, 9))

    def test_resumed(self):
        """The first went on beyond its last checkpoint."""
        a = self.write(run(range(1, 7)), 'a')
        b = self.write(run(range(5, 9), 'two', resumed_time=104.0), 'b')
        c = self.write(run(range(9, 12), 'three', resumed_time=108.5), 'c')
        for paths in ((a, b, c), (c, a, b)):
            loaded = hdlyap.load(*paths)
            self.assertEqual(loaded.info.run_id, 'three')
            self.check(loaded, range(1, 12))
        self.check(hdlyap.load(b), range(5, 9))

    def test_the_same_trajectory_twice(self):
        a = self.write(run(range(1, 7)), 'a')
        b = self.write(run(range(1, 7), 'two'), 'b')
        self.cannot_load(
            'a.bag and .*b.bag both begin with seed 1: the same trajectory twice is', a, b
        )
        c = self.write(run([5], 'three', resumed_time=104.0), 'c')
        d = self.write(run([5], 'four', resumed_time=104.0), 'd')
        self.cannot_load('c.bag and .*d.bag were both resumed at time 104: leave one out', a, c, d)

    def test_parts_of_two_runs(self):
        """What a resumed run has as before is of one value in all parts."""
        a = self.write(run(range(1, 7), observables=['spectrum', 'modes']), 'a')
        for name, value, said in (
            ('warmup', 20.0, r'warmup is 0\.0 and 20\.0'),
            ('exponents', 'all', 'exponents is positive and all'),
            ('interval', 0.5, r'interval is auto and 0\.5'),
            ('observables', ['spectrum'], r"observables is \['modes'\] and \[\]"),
        ):
            of_b = {'observables': ['modes', 'state'], name: value}
            b = self.write(run(range(5, 9), 'two', resumed_time=104.0, **of_b), 'b')
            self.cannot_load(f'a.bag and .*b.bag are no parts of one run: {said}$', a, b)
        of_b = {'observables': ['modes', 'state'], 'duration': 9.0, 'threads': 7}
        b = self.write(run(range(5, 9), 'two', resumed_time=104.0, **of_b), 'b')
        self.check(hdlyap.load(a, b), range(1, 9))

    def test_what_parts_have_in_common(self):
        """Is what the node says."""
        with open(os.path.join(SOURCES, 'hdlyap_ros/src/topics/rows.inc')) as file:
            unseen = set(re.findall(r'TOPIC\((\w+), \w+, 0, TOPIC_OBSERVABLE', file.read()))
        self.assertEqual(unseen, set(UNSEEN))

    def test_averages_that_do_not_follow(self):
        """Of two runs of one seed one was reset, before or after the checkpoint of the other."""

        def part(name, times, begun, **info):
            messages = run([], name, **info)
            for time in times:
                messages.append(made.spectrum(HALF, max(time - begun, 0.0), run_id=name))
                messages[-1].sim_time = time
            return self.write(numbered(messages), name)

        late = {'resumed_time': 150.0}
        for begun, first, again, averaged in (
            (100.0, range(101, 151), 100.0, None),
            (100.0, range(101, 141), 100.0, None),  # a tail was lost
            (100.0, range(101, 141), 145.0, None),  # and a reset with it
            (100.0, range(90, 101), 100.0, None),
            (130.0, range(131, 151), 100.0, '20 at time 150 and over 51 at 151'),
            (100.0, range(101, 151), 130.0, '50 at time 150 and over 21 at 151'),
        ):
            a = part('a', first, begun)
            b = part('b', range(151, 161), again, **late)
            if averaged is None:
                self.assertEqual(hdlyap.load(a, b).averaged_times[-1], 160 - again)
                continue
            with self.assertRaisesRegex(
                hdlyap.data.reader.RecordingError,
                f'a.bag and .*b.bag are no parts of one run: averaged over {averaged}$',
            ):
                hdlyap.load(a, b).averaged_times

    def test_others(self):
        a = self.write(run([1, 2]), 'a')
        for name, value, said in (
            ('density', 0.6, 'density is 0.5 and 0.6'),
            ('number', 30, 'number is 20 and 30'),
            ('boundary_y', 'reflecting', 'boundary_y is periodic and reflecting'),
            ('wave_nx', [1, 2], r'wave_nx is \(\) and \(1, 2\)'),
        ):
            more = {'wave_ny': value, 'wave_nz': value} if name == 'wave_nx' else {}
            b = self.write(run([1, 2], 'two', seed='2', **{name: value}, **more), 'b')
            self.cannot_load(f'a.bag and .*b.bag do not belong together: {said}', a, b)
        b = self.write(run([1, 2], 'two', seed='2', density=0.5 * (1 + 1e-12)), 'b')
        self.assertEqual(len(hdlyap.load(a, b).runs), 2)
        b = self.write(
            run([1, 2], 'two', seed='2', shear_b=2.0), 'b'
        )  # of walls that are not there
        self.assertEqual(len(hdlyap.load(a, b).runs), 2)
        sheared = dict(boundary_y='shearing')
        a = self.write(run([1, 2], **sheared), 'a')
        b = self.write(run([1, 2], 'two', seed='2', shear_b=2.0, **sheared), 'b')
        self.cannot_load('do not belong together: shear_b is 10.0 and 2.0', a, b)

    def test_several_runs_in_a_bag(self):
        path = self.write([*run([1, 2]), *run([1, 2, 3], 'two', seed='2')], 'a')
        self.assertEqual(hdlyap.load(path).info.run_id, 'two')
        self.assertEqual(hdlyap.load(path, run=1).info.run_id, 'one')
        self.cannot_load('no run 3 in it', path, run=3)


class SeveralSeeds(Loaded):
    def seeds(self, *runs):
        paths = []
        for number, messages in enumerate(runs, start=1):
            messages[0].seed = str(number)
            paths.append(self.write(messages, str(number)))
        return hdlyap.load(*paths)

    def messages(self, number, shift, time=50.0, error=0.1, **steps):
        info = made.run_info(run_id=str(number))
        of_run = {'run_id': str(number)}
        found = [
            made.step(info, T, 1, 0, 36, 37, exponent=1 + shift, std_error=0.2),
            made.step(info, LP, 1, 0, 32, 35, exponent=2 + shift, std_error=0.1, **steps),
        ]
        return [
            info,
            made.spectrum(HALF + shift, time, error=error, **of_run),
            made.steps(found, time, **of_run),
        ]

    def test_means(self):
        """Twice the time counts twice."""
        seeds = self.seeds(
            self.messages(1, 0.0), self.messages(2, 0.3), self.messages(3, 0.6, time=100.0)
        )
        self.assertIsInstance(seeds, Seeds)
        self.assertEqual((seeds.seeds, seeds.averaged_time), (['1', '2', '3'], 200.0))
        found = seeds.spectrum.loc[37]
        self.assertAlmostEqual(found.exponent, 1 + (0.3 + 2 * 0.6) / 4)
        self.assertAlmostEqual(found.std_error, 0.1 * np.sqrt(1 + 1 + 4) / 4)
        squares = np.array([0.375, 0.075, 0.225]) ** 2
        self.assertAlmostEqual(found.scatter, np.sqrt(squares @ [1, 1, 2] / (4 * 2)))
        self.assertAlmostEqual(found.chi2, squares.sum() / 0.1**2)
        self.assertEqual(found.runs, 3)
        self.assertAlmostEqual(seeds.steps.exponent['LP(1,0)'], 2.375)
        self.assertAlmostEqual(seeds.steps.std_error['T(1,0)'], 0.2 * np.sqrt(6) / 4)
        self.assertAlmostEqual(seeds.results.value['lambda_max'], 3.375)
        self.assertAlmostEqual(seeds.results.value['c_T'], 1.4)
        sampled = seeds.results.sampling_error['c_T']
        self.assertAlmostEqual(sampled, 0.004 * np.sqrt(6) / 4)
        self.assertEqual(seeds.results.unit['c_T'], 'sigma/time unit')
        self.assertEqual(seeds.spectrum.attrs['units']['exponent'], '1/time unit')
        with self.assertRaisesRegex(
            AttributeError, r'^times belongs to one run, but these are 3: use runs\[0\]'
        ):
            seeds.times
        with self.assertRaisesRegex(AttributeError, '^time$'):
            seeds.time

    def test_a_step_that_one_run_lacks(self):
        """Its mean is over the others, and the fits are of different steps."""
        seeds = self.seeds(
            self.messages(1, 0.0), self.messages(2, 0.4), self.messages(3, 0.8, resolved=False)
        )
        self.assertEqual(list(seeds.steps.runs), [3, 2])
        self.assertTrue(seeds.steps.resolved.all())
        self.assertAlmostEqual(seeds.steps.exponent['LP(1,0)'], 2.2)
        self.assertIn('c_T', seeds.results.index)
        self.assertNotIn('c_L', seeds.results.index)

    def test_steps_have_the_columns_of_one_run(self):
        """README's ten lines do with several seeds what they do with one; a step that no run has is
        there, and not resolved."""
        seeds = self.seeds(*(self.messages(k, 0.2 * k, resolved=False) for k in (1, 2)))
        one = seeds.runs[0].steps
        self.assertLessEqual(set(one), set(seeds.steps))
        self.assertEqual(list(seeds.steps.index), list(one.index))
        self.assertEqual(seeds.steps.attrs['units']['wave_number'], '1/sigma')
        self.assertEqual(list(seeds.steps.resolved), [True, False])
        self.assertEqual(list(seeds.steps.runs), [2, 0])
        self.assertTrue(np.isnan(seeds.steps.exponent['LP(1,0)']))
        step = seeds.steps[seeds.steps.resolved].loc['T(1,0)']
        self.assertEqual((step.first_index, step.last_index, step.expected), (36, 37, 2))
        self.assertAlmostEqual(step.exponent, 1.3)
        with open(os.path.join(SOURCES, 'README.md')) as file:
            program = file.read().split('## Ten lines of Python')[1].split('```python\n')[1]
        load, printed = mock.Mock(return_value=seeds), io.StringIO()
        with mock.patch('hdlyap.load', load), contextlib.redirect_stdout(printed):
            exec(program.split('```')[0], {})
        self.assertIn('T(1,0)   k = 0.993  lambda = 1.3000 +- 0.14', printed.getvalue())

    def test_misfits(self):
        """Of all runs together; what they share beyond sampling is not averaged away."""
        runs = [self.messages(k, 0.0) for k in (1, 2)]
        for messages, misfit in zip(runs, (1.0, 7.0)):
            messages[2].v_misfit = misfit
        seeds = self.seeds(*runs)
        self.assertAlmostEqual(seeds.results.misfit['v'], 5.0)
        self.assertTrue(np.isnan(seeds.results.misfit['c_L']))
        of_form = np.hypot(0.0092 / np.sqrt(2), np.sqrt(0.023**2 - 0.0092**2))
        self.assertAlmostEqual(seeds.results.std_error['v'], of_form)
        self.assertAlmostEqual(seeds.results.sampling_error['v'], 0.0092 / np.sqrt(2))
        message = seeds.last('steps')
        self.assertAlmostEqual(message.v_misfit, 5.0)
        self.assertEqual(message.l_misfit, -1.0)

    def test_errors_are_not_known(self):
        """Of one of two runs: it is left out. Of all: they are too few to tell it."""
        for errors, expected in (
            ([0.1, np.nan], [1.0, 0.1, np.nan, 0.0, 1]),
            ([0.1, np.inf], [1.0, 0.1, np.nan, 0.0, 1]),
            ([np.nan, np.nan], [1.5, np.nan, np.nan, np.nan, 2]),
        ):
            found = mean(np.array([[1.0], [2.0]]), np.array(errors)[:, None], [1, 1])
            np.testing.assert_allclose(np.ravel(found), expected, rtol=1e-15)

    def test_what_is_no_number(self):
        """Makes the mean none, whatever its error; what is not there does not."""
        errors = np.array([[0.1, 0.1, 0.1], [0.1, np.nan, np.nan]])
        values = np.array([[1.0, 1.0, 1.0], [np.nan, np.inf, np.nan]])
        found = mean(values, errors, [1, 3])[0]
        self.assertFalse(np.isfinite(found).any(), found)
        there = np.array([[True], [False]])
        np.testing.assert_array_equal(mean(values, errors, [1, 3], there)[0], [1.0] * 3)

    def test_short_run(self):
        """As the long one alone; its name is told. Without the long one nothing knows an error."""
        long = self.messages(1, 0.0, time=200.0)
        short = self.messages(2, 3.0, time=0.001, error=-1.0)
        with self.assertWarnsRegex(
            UserWarning, r'/2\.bag, seed 2, is left out: .* over 0\.001, too'
        ):
            seeds = self.seeds(long, short)
            self.assertEqual((seeds.seeds, seeds.averaged_time), (['1'], 200.0))
        self.assertEqual(len(seeds.left_out), 1)
        for frame in (seeds.spectrum, seeds.results):
            self.assertEqual(frame.iloc[0, 0], 3.0)
            self.assertAlmostEqual(frame.std_error.iloc[0], 0.1)
            self.assertTrue(frame.scatter.isna().all())
            self.assertEqual(set(frame.runs), {1})
        with warnings.catch_warnings():
            warnings.simplefilter('error')
            seeds = self.seeds(self.messages(1, 0.0, error=-1.0), short)
            self.assertEqual((seeds.seeds, seeds.left_out), (['1', '2'], []))
            lambda_max = seeds.results.loc['lambda_max']
        self.assertTrue(lambda_max[['std_error', 'scatter']].isna().all())

    def test_coverage_of_unequal_runs(self):
        """How often a mean is within one, two and five of its errors, the larger one of both.
        Blocks are of length 1; below 16 of them an error is not known, below one a value is as far
        off as that of one."""
        rng, trials = np.random.default_rng(7), 20000
        for lengths, runs, is_stated in (
            ((200, 10), 1, True),
            ((200, 0.001), 1, True),
            ((200, 200), 2, True),
            ((200, 50, 20, 5, 0.01), 3, True),
            ((40,) * 5, 5, True),
            ((10,) * 8, 8, False),
            ((5, 10) * 4, 8, False),
        ):
            size, freedom = (len(lengths), trials), np.array(lengths)[:, None] - 1
            sigma = np.maximum(freedom + 1, 1) ** -0.5
            spread = np.sqrt(rng.chisquare(np.maximum(freedom, 1), size) / np.maximum(freedom, 1))
            errors = np.where(freedom >= 15, sigma * spread, np.nan)
            of_all, stated, scatter, chi2, count = mean(rng.normal(0, sigma, size), errors, lengths)
            self.assertEqual(set(count), {runs}, lengths)
            larger = np.fmax(stated, scatter)
            # of the scatter in true errors, at evenly spaced chances: 0 of one run
            places = (np.arange(2000) + 0.5) / 2000
            ratio = np.sqrt(chi_squared.ppf(places, runs - 1) / (runs - 1)) if runs > 1 else 0
            for width in (1, 2, 5):
                share = np.mean(erf(width * np.maximum(is_stated, ratio) / np.sqrt(2)))
                deviation = np.mean(abs(of_all) < width * larger) - share
                allowed = 4 * np.sqrt(max(share * (1 - share), 1 / trials) / trials)
                self.assertLess(abs(deviation), allowed, (lengths, width))
            if is_stated:  # squared errors of L blocks divide by (L - 3) / (L - 1)
                allowed = 4 * np.sqrt(2 * runs / trials)
                self.assertGreaterEqual(chi2.mean(), (runs - 1) - allowed)
                self.assertLessEqual(chi2.mean(), (runs - 1) * 19 / 17 + allowed)

    def test_too_few_or_unlike_runs_of_unknown_error(self):
        for lengths, is_known in (
            ((10,) * 7, False),
            ((10,) * 8, True),
            ((10,) * 8 + (4,), False),
            ((10,) * 8 + (5,), True),
        ):
            values = np.arange(len(lengths), dtype=float)[:, None]
            _, stated, scatter, _, _ = mean(values, np.full_like(values, np.nan), lengths)
            self.assertEqual((np.isnan(stated[0]), np.isnan(scatter[0])), (True, not is_known))
