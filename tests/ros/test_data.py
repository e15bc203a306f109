"""hdlyap.load against bags that are made here: each array is read from the messages a second
time."""

import os
import re
import subprocess
import sys
import tempfile
from unittest import mock

import numpy as np
import rosbag

import hdlyap
import made
import made_fields
from bags import Bags
from hdlyap.data import fields
from hdlyap.data.reader import Missing, RecordingError
from hdlyap.msg import Hydro, LpPhase, LpPhases, Mode, Modes, Spectrum, State
from made import T
from test_structure import message as structure

DISKS = 20
DOC = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../doc')


def modes(sim_time):
    kinds = [Mode.T, Mode.LP, Mode.NONE]
    made_modes = [
        Mode(index=k, exponent=4.0 - k + 0.01 * sim_time, kind=kind, weight=0.25 * k)
        for k, kind in enumerate(kinds, start=1)
    ]
    return Modes(run_id='one', sim_time=sim_time, averaged_time=sim_time - 100, modes=made_modes)


def state(sim_time, run_id='one'):
    x, y, px, py = made_fields.disks(made.run_info(), seed=int(sim_time))
    return State(run_id=run_id, sim_time=sim_time, x=x, y=y, px=px, py=py)


class Loaded(Bags):
    def load(self, messages):
        return hdlyap.load(self.write(messages))

    def cannot_load(self, reason, *paths, **which):
        with self.assertRaisesRegex(RecordingError, reason):
            hdlyap.load(*paths, **which)


class Arrays(Loaded):
    """Beside what rosbag reads."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        path = os.path.join(folder.name, 'run.bag')
        rng = np.random.default_rng(1)
        messages = made.small_run()
        for message in messages:
            if isinstance(message, Spectrum):
                shape = len(message.exponents)
                message.exponents, message.local_exponents = rng.normal(size=(2, shape))
                message.std_errors = rng.choice([-1.0, 0.5, 0.25], shape)
        messages += [each(t) for t in (101.0, 102.5, 104.0) for each in (modes, state)]
        made.write(path, messages)
        cls.run_, cls.messages = hdlyap.load(path), {}
        with rosbag.Bag(path) as bag:
            for topic, message, _ in bag.read_messages():
                cls.messages.setdefault(topic.split('/')[-1], []).append(message)

    def column(self, topic, name):
        return np.array([getattr(message, name) for message in self.messages[topic]])

    def equal(self, ours, messages):
        np.testing.assert_array_equal(np.array(ours, dtype=float), np.array(messages, dtype=float))

    def test_running_means(self):
        run = self.run_
        self.assertEqual(run.info.number, DISKS)
        self.equal(run.times, self.column('spectrum', 'sim_time'))
        self.equal(run.averaged_times, self.column('spectrum', 'averaged_time'))
        self.equal(run.exponents, self.column('spectrum', 'exponents'))
        errors = self.column('spectrum', 'std_errors')
        self.assertTrue((errors == -1).any())
        self.equal(run.std_errors, np.where(errors == -1, np.nan, errors))
        self.equal(run.local.exponents, self.column('spectrum', 'local_exponents'))
        self.assertEqual(run.units['exponents'], '1/time unit')
        self.assertEqual(run.units['times'], 'time units')

    def test_last_message_of_any_topic(self):
        for topic in 'modes', 'state', 'gas', 'cost':
            self.assertEqual(self.run_.has(topic), topic in self.messages)
        self.equal(self.run_.last('state').x, self.messages['state'][-1].x)
        self.assertEqual(self.run_.last('modes').sim_time, 104.0)
        with self.assertRaisesRegex(Missing, 'no message of gas'):
            self.run_.last('gas')

    def test_spectrum(self):
        last, frame = self.messages['spectrum'][-1], self.run_.spectrum
        self.equal(frame.index, np.arange(1, 38))
        self.equal(frame.exponent, last.exponents)
        self.equal(frame.std_error, self.run_.std_errors[-1])
        self.equal(frame.cos_theta, last.cos_theta)
        units = {'exponent': '1/time unit', 'std_error': '1/time unit', 'cos_theta': ''}
        units.update(dp_dq_ratio='1/time unit', local_exponent='1/time unit')
        self.assertEqual(frame.attrs['units'], units)

    def test_tables_of_elements(self):
        for frame, elements in (
            (self.run_.steps, self.messages['steps'][-1].steps),
            (self.run_.phases, self.messages['lp_phases'][-1].phases),
            (self.run_.t_phases, self.messages['t_phases'][-1].phases),
            (self.run_.modes, self.messages['modes'][-1].modes),
        ):
            self.assertEqual(len(frame), len(elements))
            names = set(frame.columns) & set(elements[0].__slots__)
            names -= {'kind', 'sharing', 'state', 'modulation', 'step'}
            self.assertGreater(len(names), 5)
            for name in names:
                there = ~np.isnan(frame[name].astype(float))
                values = np.array([getattr(one, name) for one in elements], dtype=float)
                self.equal(frame[name][there], values[there.to_numpy()])
                self.assertEqual(frame.attrs['units'][name], fields.of(elements[0])[name].unit)
        steps = self.run_.steps
        self.assertEqual(list(steps.index), ['T(1,0)', 'LP(1,0)', 'T(0,1)', 'LP(0,1)', 'zero'])
        self.assertEqual(list(steps.kind), ['T', 'LP', 'T', 'LP', 'zero'])
        self.assertTrue(steps.exponent[:4].notna().all())
        self.assertTrue(steps.loc['zero', ['exponent', 'std_error', 'gap']].isna().all())
        self.assertEqual(list(self.run_.modes.kind), ['T', 'LP', 'none'])
        phases = self.run_.phases
        self.assertEqual(set(phases.step), {'LP(1,0)', 'LP(0,1)'})
        self.assertEqual(set(phases.modulation), {'cos kx x', 'sin kx x', 'cos ky y'})
        self.assertEqual(set(phases.state), {'tracked'})
        still = self.run_.t_phases
        self.assertEqual(list(still.step), ['T(1,0)'] * 2 + ['T(0,1)'] * 2)
        self.assertEqual(list(still.modulation), ['cos kx x'] * 2 + ['cos ky y'] * 2)
        self.assertEqual(list(still.diffusion_error.isna()), [True] * 2 + [False] * 2)
        self.assertEqual(still.attrs['units']['diffusion'], 'rad^2/time unit')

    def test_course(self):
        turned = self.run_.course('lp_phases')['phase'].unstack()
        messages = self.messages['lp_phases']
        self.equal(turned.index, [message.sample_time for message in messages])
        self.equal(turned, [[one.phase for one in message.phases] for message in messages])
        self.assertTrue(self.run_.course('cost').equals(self.run_.cost))
        with self.assertRaisesRegex(
            RecordingError, "course of 'x': must be one of averages, covariant, "
        ):
            self.run_.course('x')
        weights = self.run_.course('modes')['weight'].unstack()
        self.equal(
            weights,
            [
                [np.nan if one.kind == Mode.NONE else one.weight for one in each.modes]
                for each in self.messages['modes']
            ],
        )

    def test_over_time(self):
        self.equal(self.run_.cost.index, self.column('cost', 'sim_time'))
        self.equal(self.run_.cost.ortho_seconds, self.column('cost', 'ortho_seconds'))
        self.assertEqual(self.run_.cost.attrs['units']['wall_seconds'], 's')
        self.assertEqual(set(self.run_.status.stage), {'averaging'})

    def test_disks_at_any_time(self):
        disks = self.run_.state
        self.equal(disks.times, [101.0, 102.5, 104.0])
        for time, number in ((0.0, 0), (102.4, 1), (102.5, 1), (1e9, 2)):
            message = self.messages['state'][number]
            self.equal(disks.positions(time), np.transpose([message.x, message.y]))
            self.equal(disks.momenta(time), np.transpose([message.px, message.py]))
        for (time, positions, momenta), message in zip(disks, self.messages['state']):
            self.assertEqual(time, message.sim_time)
            self.equal(
                np.hstack([positions, momenta]).T, [message.x, message.y, message.px, message.py]
            )

    def test_fields(self):
        self.assertEqual(list(self.run_.fields), [29, 31, 35, 37])
        for message in self.messages['fields']:
            self.equal(self.run_.fields[message.index].p_over_px, message.p_over_px)

    def test_results(self):
        last, found = self.messages['steps'][-1], self.run_.results
        self.equal(found.value[['c_T', 'c_L2', 'v']], [last.c_t, last.c_l2, last.v])
        self.equal(
            found.std_error[['c_T', 'c_L2', 'v']], [last.c_t_error, last.c_l2_error, last.v_error]
        )
        spectrum = self.messages['spectrum'][-1]
        self.equal(found.value[['lambda_max', 'h_KS']], [spectrum.lambda_max, spectrum.ks_entropy])
        self.assertEqual(found.unit['c_T2'], 'sigma^2/time unit')

    def test_gas_of_soft_particles(self):
        soft = self.load([made.run_info(), made.soft_gas()]).gas
        names = ['pressure', 'pressure_x', 'pressure_y', 'compressibility', 'temperature']
        self.assertEqual(list(soft.index), [*names, 'potential_energy'])
        self.equal(soft.value, [1.25, 1.5, 1.0, 5.0, 0.625, 0.5])
        self.assertEqual(list(soft.unit[3:]), ['', 'epsilon', 'epsilon'])

    def test_shearing_walls(self):
        """What there is only where phase space contracts, in frames and in printed results."""
        found = made.spectrum([0.5, 0.001, -0.3, -0.451], 50.0, divergence=-0.2501)
        found.kaplan_yorke, found.kaplan_yorke_error = 3.4457, 0.02
        run = self.load([made.run_info(number=1, zero_exponents=3), found, made.shear_gas()])
        flow = ['shear_stress', 'velocity_low', 'velocity_high', 'divergence']
        self.equal(run.gas.value[flow], [0.0625, -0.25, 0.375, -0.125])
        self.equal(run.gas.std_error[flow], 4 * [0.01])
        self.assertEqual(list(run.gas.unit[flow[:2]]), ['1/sigma^2', 'sigma/time unit'])
        self.equal(run.results.value[['exponent_sum', 'kaplan_yorke']], [-0.25, 3.4457])
        self.equal(run.results.std_error[['exponent_sum', 'kaplan_yorke']], [0.01, 0.02])
        printed = run.table()
        self.assertEqual(printed.value['kaplan_yorke'], '3.446(20)')
        self.assertEqual(printed.value['shear_stress'], '0.062(10)')
        paired = self.load([made.run_info(), made.spectrum([0.5, 0.001, -0.001, -0.5], 50.0)])
        self.assertNotIn('exponent_sum', paired.results.index)

    def test_zeros_between_walls_that_shear(self):
        """Those that are smallest together, with what may be one of them at this age: at 150 an
        exponent below ln(151) / 150 = .0335."""
        for fourth, zeros in ((-0.04, [2, 3, 4]), (-0.03, [2, 3, 4, 5])):
            values = [0.5, 0.001, 0.0, -0.001, fourth, -0.4, -0.5, -0.6]
            found = made.spectrum(values, 50.0, divergence=-0.1)
            view = self.load([made.run_info(number=2, zero_exponents=3), found]).summary
            self.assertEqual((view.positive_end, list(view.zeros)), (1, zeros))

    def test_gas_and_widths(self):
        widths = [0.2, 0.5, 0.7]
        gas, shape = made.gas(60.0), made.localization(widths, error=-1.0)
        run = self.load([made.run_info(), made.gas(50.0, error=-1.0), gas, shape])
        self.assertEqual(
            list(run.gas.index),
            ['collision_rate', 'pressure', 'pressure_x', 'pressure_y', 'compressibility'],
        )
        self.equal(run.gas.value, [3.25, 1.25, 1.5, 1.0, 2.5])
        np.testing.assert_allclose(run.gas.std_error, [0.02, 0.01, 0.01, 0.01, 0.02])
        self.assertEqual(run.gas.unit['pressure_x'], '1/sigma^2')
        course = run.course('gas')
        self.equal(course.index, [150, 160])
        self.equal(course['collision_rate'], [3.25, 3.25])
        np.testing.assert_array_equal(course['pressure_error'], [np.nan, 0.01])
        self.assertEqual(course.attrs['units']['pressure'], '1/sigma^2')
        others = {'temperature', 'pressure_z', 'expected_rate_11'}
        self.assertFalse(others & set(course))  # disks of one kind have none
        self.assertIn('expected_compressibility', course)
        self.equal(run.localization.index, [1, 2, 3])
        self.equal(run.localization.width, widths)
        self.equal(run.localization.widths_now, np.multiply(widths, 0.9))
        self.assertTrue(run.localization.std_error.isna().all())

    def test_averages(self):
        """Of a program's own particles: names, units, errors, and a column for each over time."""
        early, late = made.averages(40.0, error=-1.0), made.averages(60.0, kinetic=1.5, stretch=0.5)
        run = self.load([made.run_info(), early, late])
        found = run.averages
        self.assertEqual(list(found.index), ['kinetic', 'stretch'])
        self.equal(found.value, [1.5, 0.5])
        np.testing.assert_allclose(found.std_error, [0.01, 0.01])
        self.assertEqual(list(found.unit), ['energy', 'energy'])
        course = run.course('averages')
        self.equal(course.index, [140, 160])
        self.equal(course['averaged_time'], [40, 60])
        self.equal(course['kinetic'], [1.25, 1.5])
        np.testing.assert_array_equal(course['kinetic_error'], [np.nan, 0.01])
        self.assertEqual(course.attrs['units']['kinetic_error'], 'energy')
        self.assertEqual(
            list(run.table().value[['kinetic', 'stretch']]), ['1.500(10)', '0.500(10)']
        )

    def test_averages_that_do_not_fit(self):
        for name in ('kinetic', 'a b', ''):
            message = made.averages()
            message.averages[1].name = name
            with self.assertRaisesRegex(RecordingError, 'Averages: name = .*: must be a word'):
                self.load([made.run_info(), message]).averages

    def test_state_without_a_box(self):
        """All coordinates, as rows of particles."""
        info = made.run_info(particles='chain', dimension=0, coordinates=2, number=3)
        numbers = list(np.arange(6.0))
        state = hdlyap.msg.State(run_id='one', sim_time=110.0, q=numbers, p=numbers[::-1])
        run = self.load([info, state])
        self.equal(run.state.positions(110), [[0, 1], [2, 3], [4, 5]])
        ((time, q, p),) = run.state
        self.equal(p, [[5, 4], [3, 2], [1, 0]])
        state.q = numbers[:4]
        with self.assertRaisesRegex(RecordingError, 'State: [qp] has [46] elements: must be [46]'):
            list(self.load([info, state]).state)

    def test_fluctuations(self):
        """D by index; growth over finite times of vectors and of pairs of steps."""
        diffusions = [0.5, 0.25, 0.25, 0.04, 0.04]
        pairs = [(made.LP, 1, 0, [2, 3]), (made.T, 1, 0, [4, 5])]
        told = made.fluctuations(diffusions, pairs)
        later = made.fluctuations([1.0, *diffusions[1:]], times=(), error=-1.0, sim_time=160.0)
        run = self.load([made.run_info(), told, later])
        self.equal(run.fluctuations.index, [1, 2, 3, 4, 5])
        self.equal(run.fluctuations.diffusion, [1.0, *diffusions[1:]])
        self.assertTrue(run.fluctuations.std_error.isna().all())
        self.assertEqual(run.fluctuations.attrs['units']['diffusion'], '1/time unit')
        growth = run.growth
        self.equal(growth.times['time'], [2.0, 4.0])
        self.equal(growth.times['count'], [500, 250])
        self.equal(growth.variances.loc[4.0], np.multiply(diffusions, 4.0))
        self.equal(growth.violations.loc[2.0], [0.2] * 4)
        self.equal(growth.domination_violations.loc[4.0], [0.2] * 4)
        self.assertEqual(growth.indices, {'LP(1,0)': [2, 3], 'T(1,0)': [4, 5]})
        np.testing.assert_allclose(growth.covariances, [[0.02, 0.05], [0.05, 0.08]])
        np.testing.assert_allclose(growth.correlations, [[0.08, 0.5], [0.5, 2.0]])
        self.assertEqual(growth.std_errors.loc['T(1,0)', 'LP(1,0)'], 0.01)
        np.testing.assert_allclose(growth.reversals[1].loc['T(1,0)'], [0.0125, 0.02])
        unclear = self.load(
            [made.run_info(), made.fluctuations([0.5, 0.25, 0.25, -0.04, 0.02], pairs)]
        )
        self.assertEqual(list(unclear.growth.correlations.isna().sum()), [1, 2])
        covariant = made.covariant([2.0, 1.0])
        order = dict(violations=[0.5], domination_violations=[0.75])
        covariant.orders = [made.GrowthOrder(time=5.0, count=7, **order)]
        of_covariant = self.load([made.run_info(), covariant]).covariant_orders
        self.equal(of_covariant.domination_violations.loc[5.0], [0.75])
        covariant.orders[0].violations = [0.5, 0.5]
        with self.assertRaisesRegex(RecordingError, 'violations has 2 elements: must be 1'):
            self.load([made.run_info(), covariant]).covariant_orders
        covariant.orders = []
        nothing = self.load([made.run_info(), covariant]).covariant_orders
        self.assertEqual((len(nothing.times), nothing.violations.size), (0, 0))
        with self.assertRaisesRegex(RecordingError, 'no message of fluctuations with orders in it'):
            self.load([made.run_info(), later]).growth

    def test_fluctuations_that_do_not_fit(self):
        step = [(made.T, 1, 0, [4, 5])]
        for change in (
            lambda message: message.variances.pop(),
            lambda message: message.orders[1].violations.pop(),
            lambda message: message.steps.clear(),
            lambda message: message.steps[0].indices.append(6),
            lambda message: message.std_errors.pop(),
        ):
            message = made.fluctuations([0.5, 0.25, 0.25, 0.04, 0.04], step)
            change(message)
            with self.assertRaisesRegex(
                RecordingError, 'damaged: hdlyap/(Fluctuations|GrowthOrder): '
            ):
                self.load([made.run_info(), message]).fluctuations

    def test_what_was_not_recorded(self):
        with self.assertRaisesRegex(RecordingError, 'run.bag: no message of covariant in it'):
            self.run_.covariant
        with self.assertRaisesRegex(RecordingError, 'no averaged spectrum'):
            self.load([made.run_info()]).exponents

    def test_resets(self):
        messages = [made.spectrum([3.0], t) for t in (0, 5, 6, 1, 2)]
        for time, message in zip((100, 105, 106, 108, 109), messages):
            message.sim_time, message.local_time = time, 0.5
        run = self.load([made.run_info(), *messages])
        self.equal(run.averaged_times, [1, 2])
        self.equal(run.local.times, [108, 109])

    def test_resets_of_all_topics(self):
        """What was published before the last reset counts nowhere; what the run is about does."""
        info, old, new = made.run_info(), (105.0, 106.0), (108.5, 109.0)
        step = made.step(info, T, 1, 0, 2, 3)
        kinds = dict(
            spectrum=lambda t, a: made.spectrum([3.0, 2.0, 1.0], a),
            modes=lambda t, a: Modes(averaged_time=a, samples=5),
            steps=lambda t, a: made.steps([step], a),
            lp_phases=lambda t, a: LpPhases(),
            t_phases=lambda t, a: made.t_phases([step], t),
            hydro=lambda t, a: Hydro(),
            structure=lambda t, a: structure(info, t, [], vectors=3),
            covariant=lambda t, a: made.covariant([3.0, 2.0], averaged_time=a),
            localization=lambda t, a: made.localization([0.5]),
            fluctuations=lambda t, a: made.fluctuations([0.5], averaged_time=a),
            gas=lambda t, a: made.gas(a),
            fields=lambda t, a: made_fields.mode_field(info, step),
        )
        of_the_run = {'cost': lambda t, a: made.cost(t), 'status': lambda t, a: made.status(t)}

        def times(names, without=None):
            """{topic: the times of its messages}; without: has no report after the reset."""
            messages = [info]
            for t, begun in [(t, 100) for t in old] + [(t, 108) for t in new]:
                for name in names if t in old else set(names) - {without}:
                    message = {**kinds, **of_the_run}[name](t, t - begun)
                    message.sim_time, message.run_id = t, 'one'
                    if name in ('structure', 'localization'):
                        message.samples = int(10 * (t - begun))
                    messages.append(message)
            run = self.load(messages)
            found = {name: tuple(one.sim_time for one in run.messages(name)) for name in names}
            self.assertEqual(
                [name for name in names if run.has(name)], [k for k in found if found[k]]
            )
            return found

        every = [*kinds, *of_the_run]
        counted = {**dict.fromkeys(kinds, new), **dict.fromkeys(of_the_run, old + new)}
        self.assertEqual(times(every), counted)
        for name in set(kinds) - {'spectrum'}:
            self.assertEqual(times(every, name), {**counted, name: ()})
        for name in set(kinds) - {'lp_phases', 't_phases', 'hydro', 'fields'}:  # without means
            self.assertEqual(times([name]), {name: new})

    def test_reset_between_reports(self):
        """A covariant window that ended before the reset is of before, also after the last
        report; one that ended after it is not."""
        spectra = [made.spectrum([3.0], a) for a in (6, 1)]
        spectra[0].sim_time, spectra[1].sim_time = 106, 110
        for time, is_there in ((108.9, False), (109.1, True)):
            window = made.covariant([3.0], sim_time=time)
            run = self.load([made.run_info(), spectra[0], window, spectra[1]])
            self.assertEqual(run.has('covariant'), is_there)

    def test_no_bag(self):
        """What never ends, or never begins, is not read; nor is a file without an end of line."""
        self.cannot_load('^no bag: name one or several$')
        fifo = self.path('fifo')
        os.mkfifo(fifo)
        with open(self.path('endless'), 'wb') as file:
            file.truncate(1 << 40)
        with mock.patch('rosbag.Bag', side_effect=AssertionError):
            for path in ('/dev/zero', '/dev/random', fifo, self.folder):
                self.cannot_load(f'^{path}: not a readable bag: no regular file$', path)
            self.cannot_load('endless.bag: not a readable bag: its first line is', file.name)


class NotMeasured(Loaded):
    def test_phases_whose_sample_is_of_before(self):
        info = made.run_info()
        step = made.step(info, made.LP, 1, 0, 3, 6)
        told = [made.lp_phases(info, [step], time) for time in (101.0, 102.0, 102.0)]
        for message, time in zip(told, (101.5, 102.5, 103.5)):
            message.sim_time = time
        turned = self.load([info, made.steps([step]), *told]).course('lp_phases')['phase']
        self.assertEqual(list(turned.unstack().index), [101.0, 102.0])

    def test_unresolved(self):
        info = made.run_info()
        step = made.unresolved(info, T, 1, 0, 2)
        phase = LpPhase(state=LpPhase.WEAK, a=0.1, phase=2.0, omega=1.0, tracked_time=4.0)
        lost = LpPhase(state=LpPhase.UNRESOLVED)
        phases = made.LpPhases(run_id='one', phases=[phase, lost])
        run = self.load([info, made.steps([step]), phases])
        unknown = run.steps.loc['T(1,0)', ['exponent', 'std_error', 'multiplicity']]
        self.assertTrue(unknown.isna().all())
        self.assertEqual(run.steps.wave_number['T(1,0)'], step.wave_number)
        self.assertEqual(list(run.phases.a.isna()), [False, True])
        self.assertEqual(list(run.phases.omega.isna()), [True, True])

    def test_fits_without_points(self):
        steps = made.steps([])
        steps.t_points, steps.l_points, steps.v_phases = 1, 0, 0
        run = self.load([made.run_info(), made.spectrum([3.0], 5.0), steps])
        names = ['lambda_max', 'sum of exponents', 'c_T', 'c_T2', 'c_T3']
        self.assertEqual(list(run.results.index), names)

    def test_fields_that_are_minus_one_while_unknown(self):
        kinds = 'Spectrum', 'Step', 'LpPhase', 'TPhase', 'RunStatus'
        told = [fields.of(getattr(hdlyap.msg, kind)) for kind in kinds]
        unknown = {name for each in told for name, field in each.items() if field.unknown}
        self.assertLessEqual(
            {'remaining_seconds', 'std_error', 'omega_error', 'diffusion_error'}, unknown
        )
        self.assertFalse(unknown & {'cos_theta', 'a', 'exponents', 'averaged_time'})

    def test_units_of_fields_that_share_a_comment(self):
        steps, gas = fields.of(hdlyap.msg.Steps), fields.of(hdlyap.msg.Gas)
        self.assertEqual([steps[name].unit for name in ('t_k_min', 't_k_max')], 2 * ['1/sigma'])
        self.assertEqual(gas['temperature_error'].unit, 'epsilon')
        self.assertEqual(gas['compressibility'].unit, '')
        kinds = [kind for kind in vars(hdlyap.msg).values() if isinstance(kind, type)]
        units = {field.unit for kind in kinds for field in fields.of(kind).values()}
        self.assertIn('1/time unit', units)
        self.assertEqual([unit for unit in units if unit and not re.search('[a-zA-Z]', unit)], [])

    def test_names_of_constants(self):
        """Of a field its own, where a message has several kinds of them."""
        for kind, field, words in (
            ('RunStatus', 'stage', 'equilibrating, warming up, averaging, finished'),
            ('Step', 'sharing', 'alone, shared, mixing, blended, coincide'),
            ('LpPhase', 'state', 'unresolved, weak, coarse, tracked'),
            ('Mode', 'kind', 'none, zero, T, LP'),
            ('CovariantAngle', 'spaces', 'unstable-stable, unstable-centre, centre-stable'),
            (
                'Cost',
                'interval_limit',
                'report interval, conditioning, doubling, overflow, parameter interval, '
                'memory of the events, vectors needed early, repair, end of the stage, '
                'samples for errors, none yet',
            ),
        ):
            with self.subTest(kind=kind, field=field):
                found = fields.words(getattr(hdlyap.msg, kind), field)
                self.assertEqual(found, dict(enumerate(words.split(', '))))
        self.assertEqual(fields.words(hdlyap.msg.Step, 'kind'), {1: 'zero', 2: 'T', 3: 'LP'})


class Samples(Loaded):
    """Each once, with its length."""

    def test_samples(self):
        """One that equals the one before is a sample; one of no length is none."""
        local = [(0.0, 0.0), (1.0, 2.0), (1.0, 2.0), (3.0, 4.0), (3.0, 4.0)]
        messages = [made.spectrum([3.0, 1.0], t) for t in range(1, 6)]
        for message, one, length in zip(messages, local, (0.0, 0.5, 0.75, 0.0, 0.5)):
            message.local_exponents, message.local_time = one, length
        samples = self.load([made.run_info(), *messages]).local
        np.testing.assert_array_equal(samples.times, [102, 103, 105])
        np.testing.assert_array_equal(samples.exponents, [(1.0, 2.0), (1.0, 2.0), (3.0, 4.0)])
        np.testing.assert_array_equal(samples.lengths, [0.5, 0.75, 0.5])
        none = self.load([made.run_info(), messages[0]]).local
        self.assertEqual((len(none.times), none.exponents.shape), (0, (0, 2)))


class Example(Loaded):
    """The page of the guide, doc/own_analysis.py, on samples whose error is as stated."""

    def test_page(self):
        info, *more = made.small_run()
        samples = np.random.default_rng(5).normal(9, 0.3, size=(300, 37))
        spectra = [
            made.spectrum(one, t, error=0.3 / 300**0.5) for t, one in enumerate(samples, 1)
        ]
        for one, sample in zip(spectra, samples):
            one.local_time, one.local_exponents = 1.0, sample
        bag = self.write([info, *(one for one in more if not isinstance(one, Spectrum)), *spectra])
        figure = os.path.join(self.folder, 'own.png')
        program = os.path.join(DOC, 'own_analysis.py')
        said = subprocess.run(
            [sys.executable, '-W', 'ignore', program, figure, bag],
            env={**os.environ, 'MPLBACKEND': 'Agg'},
            check=True,
            text=True,
            stdout=subprocess.PIPE,
        ).stdout
        self.assertGreater(os.path.getsize(figure), 20000)
        self.assertGreater(os.path.getsize(figure[:-4] + '.nc'), 100000)
        (by_samples,) = re.findall(
            r'lambda_max \+- (\S+) by the samples, \+- 0.017 by the node', said
        )
        self.assertAlmostEqual(float(by_samples) / 0.0173, 1, delta=0.15)
        (independent,) = re.findall('300 samples, as good as (.*) independent ones', said)
        self.assertAlmostEqual(float(independent) / 300, 1, delta=0.3)

    def test_is_what_the_guide_shows(self):
        with open(os.path.join(DOC, 'own_analysis.py')) as file:
            text = file.read()
        with open(os.path.join(DOC, 'user_guide.md')) as guide:
            (shown,) = re.findall('(?s)```python\n(.*?)```', guide.read())
        self.assertIn(shown, text)
        self.assertEqual(shown.count('\n'), 3)
        self.assertLessEqual(text.count('\n'), 50)
