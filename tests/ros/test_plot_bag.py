"""plot_bag against bags that are made here: what it writes, what it refuses, and what it prints
beside its table (test_plot_bag_table.py)."""

import itertools
import os
import re
import tracemalloc
import unittest

import numpy as np
import rosbag
import rospy

from hdlyap.msg import LpPhases, ModeField, Steps
from std_msgs.msg import String

import made
from made import LP, T
from hdlyap.plots import paper, recording, waves
from hdlyap.plots.course import LIMIT, Course
from hdlyap.plots.figures import localization, modes, p_mode, phases, plt
from hdlyap.plots.numbers import with_error
from plotted import Bags, files, plot_bag_process


SPECTRUM_FILES = files('convergence', 'spectrum')
COST_FILES = files('cost')
MODES_FILES = files('dispersion', 'steps', 'modes', 'p_mode', 'phases')


class Exponents(Bags):
    def test_positive_half(self):
        exponents = np.linspace(3, 1, 37)
        self.write(
            [
                made.run_info(),
                made.cost(1),
                *(made.spectrum(exponents, t) for t in range(1, 30)),
                made.cost(2),
            ]
        )
        text = self.succeeds(SPECTRUM_FILES + COST_FILES)
        self.assertIn('the last 37 exponents before the zeros', text)
        self.assertIn('    37   1.00000  0.01000', text)
        self.assertIn('h_KS / N        3.7', text)
        self.assertNotIn('pairing', text)
        self.assertNotIn('steps', text)

    def test_a_bag_of_before(self):
        """Its messages lack what came later."""
        later = (
            r'^(float64|uint8|uint32) (ks_entropy_error|[tlv]_(misfit|prior|k_m|long|box)\w*|'
            r'sharing|set_time|own_part|gap\w*|scatter|omega\w*|c_[tl]3\w*|\w+_sampling_error) .*\n'
        )
        info = made.run_info()
        messages = [
            made.spectrum(np.linspace(3, 1, 37), 50.0),
            made.steps([made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)]),
        ]
        older = [
            made.defined(new, lambda text: re.sub(later, '', text, flags=re.MULTILINE))
            for new in messages
        ]
        for old, new in zip(older, messages):
            self.assertLess(len(old._full_text), len(new._full_text))
        self.write([info, *older])
        text = self.succeeds(SPECTRUM_FILES + files('dispersion', 'steps'))
        self.assertRegex(text, r'h_KS +74\.0000\n')
        self.assertRegex(text, r'c_T +1\.400\(12\)')
        self.assertNotIn('misfit', text)
        self.assertRegex(
            text, r'\n  T steps: form not recorded, over 3 wave numbers 0.9935 .*1\)\n'
        )

    def test_all_exponents(self):
        half = np.linspace(3, 1, 37)
        exponents = [*half, 0, 0, 0, 0, 0, 0, *-half[::-1]]
        self.write(
            [made.run_info(), made.spectrum(exponents, 1.0, pairing_error=2e-5), made.cost(1)]
        )
        text = self.succeeds(SPECTRUM_FILES + COST_FILES)
        self.assertIn('the last 37 exponents before the zeros', text)
        self.assertIn('pairing error   2.00e-05', text)

    def test_one_exponent_without_known_error(self):
        self.write([made.run_info(), made.spectrum([3.5], 1.0, error=-1.0)])
        text = self.succeeds(SPECTRUM_FILES)
        self.assertIn('     1   3.50000        -', text)
        self.assertNotIn('h_KS', text)

    def test_trajectory_only(self):
        self.write([made.run_info(), made.cost(1), made.cost(2)])
        self.assertIn('no averaged spectrum', self.succeeds(COST_FILES))

    def test_gas(self):
        """With exponents or without; the reference where it holds."""
        self.write([made.run_info(), made.cost(1), made.gas(20.0), made.gas(50.0), made.cost(2)])
        text = self.succeeds(COST_FILES)
        self.assertIn('gas, averaged over 50\n', text)
        self.assertIn('collision rate  3.250000 +- 0.020000 per disk and time unit\n', text)
        self.assertIn('pressure        1.250000 +- 0.010000 per sigma^2\n', text)
        self.assertIn('of px, py     1.500000, 1.000000\n', text)
        self.assertIn('Z = p A / N     2.500000 +- 0.020000\n', text)
        self.assertIn(' 2.763657 by Henderson', text)  # (1 + eta^2 / 8) / (1 - eta)^2, eta = pi / 8
        walls = dict(boundary_x='reflecting')
        self.write([made.run_info(**walls), made.gas(error=-1.0), made.cost(1), made.cost(2)])
        text = self.succeeds(COST_FILES)
        self.assertIn('pressure        1.250000 per sigma^2\n', text)
        self.assertNotIn('Henderson', text)

    def test_localization(self):
        spectrum = made.spectrum(np.linspace(3, 1, 37), 50.0)
        widths = np.linspace(0.1, 0.8, 37)
        files_ = SPECTRUM_FILES + files('localization')
        self.write([made.run_info(), spectrum, made.localization(widths)])
        self.succeeds(files_)
        run = recording.read(self.path)
        figure = localization.draw(run)
        (axes,) = figure.axes
        places, drawn = axes.containers[0].lines[0].get_data()
        np.testing.assert_array_equal(places, np.arange(1, 38))
        np.testing.assert_array_equal(drawn, widths)
        bars = np.array([one[:, 1] for one in axes.containers[0].lines[2][0].get_segments()])
        np.testing.assert_allclose(bars, np.transpose([widths - 0.01, widths + 0.01]))
        plt.close(figure)
        many = np.linspace(0.1, 0.8, 80)
        self.write([made.run_info(disks=43), made.localization(many), made.covariant(list(many))])
        figure = localization.draw(recording.read(self.path))
        self.assertEqual(len(figure.axes), 2)
        shown = [len(one.lines[0].get_xdata()) for one in figure.axes[1].containers]
        self.assertEqual(shown, [localization.LARGEST] * 2)
        self.assertEqual(len(figure.axes[1].get_legend().get_texts()), 2)
        plt.close(figure)

    def test_paper_scene_without_steps(self):
        info = made.paper_info()
        exponents = np.linspace(6.8, 1.0, 1557)
        for step in paper.steps(info):
            exponents[step.first - 1 : step.last] = 1.01 * step.fitted
        self.write([info, made.spectrum(exponents, 10.0)])
        text = self.succeeds(SPECTRUM_FILES)
        self.assertRegex(
            text, r'T\(1,0\) +1556-1557 +0\.18736 +0\.62\d+ +0\.01000 +0\.61\d\d ' r'+\+1\.00 %'
        )
        self.assertEqual(text.count('+1.00 %'), 5)

    def test_averages_start_afresh_after_a_reset(self):
        run = self.recorded(
            made.run_info(), *(made.spectrum([3.0, 2.0], t) for t in [1, 2, 3, 1, 2])
        )
        self.assertEqual(list(run.course()['time']), [1, 2])

    def test_last_of_two_runs(self):
        info = made.run_info()
        step = made.step(info, LP, 1, 0, 34, 37)
        run = self.recorded(
            info,
            made.spectrum([9.0], 5.0),
            made.steps([step]),
            made.lp_phases(info, [step], 5.0),
            made.mode_field(info, step),
            made.run_info(run_id='two'),
            made.steps([step]),  # late
            made.spectrum([3.0], 1.0, run_id='two'),
        )
        self.assertEqual((run.info.run_id, run.spectrum.lambda_max), ('two', 3.0))
        self.assertEqual((run.steps, list(run.fields()), run.phases.last), (None, [], None))


class Figures(Bags):
    def test_everything(self):
        self.how = plot_bag_process
        self.write(made.small_run())
        text = self.succeeds(SPECTRUM_FILES + COST_FILES + MODES_FILES)
        self.assertRegex(text, r'T\(1,0\) +36-37 +1\.98')
        for name in os.listdir(self.out):
            path = os.path.join(self.out, name)
            self.assertIn(path, text)
            if name.endswith('.png'):
                self.assertGreater(np.std(plt.imread(path)), 0.01, name)
            else:
                with open(path) as file:
                    self.assertIn('</svg>', file.read()[-10:])

    def test_each_topic_may_be_missing(self):
        everything = made.small_run()
        for left_out, gone in (
            (Steps, MODES_FILES),
            (LpPhases, files('phases')),
            (ModeField, files('modes', 'p_mode')),
        ):
            self.out += '_'
            self.write([one for one in everything if not isinstance(one, left_out)])
            self.succeeds(sorted(set(SPECTRUM_FILES + COST_FILES + MODES_FILES) - set(gone)))

    def test_channel(self):
        info = made.run_info(
            disks=20,
            aspect=0.0375,
            box_x=40.0,
            box_y=1.5,
            boundary_y='reflecting',
            zero_exponents=4,
        )
        step = made.step(info, LP, 1, 0, 35, 38)
        self.write(
            [
                info,
                made.spectrum(np.linspace(3, 1, 38), 1.0),
                made.steps([step]),
                made.mode_field(info, step),
            ]
        )
        self.succeeds(SPECTRUM_FILES + files('dispersion', 'steps', 'modes', 'p_mode'))

    def test_steps_without_one_resolved(self):
        info = made.run_info()
        self.write(
            [
                info,
                made.spectrum(np.linspace(3, 1, 37), 1.0),
                made.steps([made.unresolved(info, LP, 1, 0, 4), made.zero_modes()]),
            ]
        )
        self.assertIn('not resolved (1): LP(1,0)', self.succeeds(SPECTRUM_FILES))

    def test_both_halves(self):
        info = made.run_info()
        half = np.linspace(3, 1, 37)
        step = made.step(info, T, 1, 0, 36, 37)
        mirrored = made.step(info, T, 1, 0, 44, 45, conjugate=True, exponent=-step.exponent)
        self.write(
            [
                info,
                made.spectrum([*half, *[0.0] * 6, *-half[::-1]], 1.0),
                made.steps([step, mirrored, made.zero_modes(38)]),
            ]
        )
        self.succeeds(SPECTRUM_FILES + files('dispersion', 'steps'))

    def test_panels_are_the_last_fields_of_the_steps(self):
        info = made.run_info()
        low, high = made.step(info, T, 1, 0, 36, 37), made.step(info, LP, 1, 0, 32, 35)
        run = self.recorded(
            info,
            made.steps([high, low]),
            made.mode_field(info, low, 149.0, index=37),
            made.mode_field(info, low, 150.0, index=36),
            made.mode_field(info, high, 150.0, index=35),
            made.mode_field(info, high, 90.0, index=12),
        )
        panels = modes.chosen(run)
        self.assertEqual(
            [(panel.name, panel.field.index) for panel in panels], [('T(1,0)', 36), ('LP(1,0)', 35)]
        )
        run.info.field_indices = '36 35 12'
        self.assertEqual(
            [panel.name for panel in modes.chosen(run)], ['T(1,0)', 'LP(1,0)', 'no step']
        )

    def test_p_mode_is_what_the_field_says(self):
        info = made.run_info()
        along = made.step(info, LP, 0, 1, 28, 31)
        diagonal = made.step(info, LP, 1, 1, 30, 37, exponent=1.0)
        run = self.recorded(
            info,
            made.steps([diagonal, along]),
            made.mode_field(info, diagonal, modulations=(0, 1, 2, 3)),
            made.mode_field(info, along, modulations=(0, 2)),
        )
        field = p_mode.chosen(run)
        self.assertEqual((field.nx, field.ny, field.pairs), (0, 1, 2))
        mode = p_mode.PMode(field, 1, info)
        self.assertEqual((mode.along, mode.formula), ('y', r'$\sin k_y y$'))
        a = np.sin(2 * np.pi * np.array(field.y) / info.box_y)
        for part in mode.divided:
            self.assertGreater(np.corrcoef(part, a)[0, 1], 0.9)

    def test_p_mode_of_a_diagonal_wave(self):
        info = made.run_info()
        step = made.step(info, LP, 1, 1, 30, 37)
        self.write(
            [
                info,
                made.spectrum(np.linspace(3, 1, 37), 1.0),
                made.steps([step]),
                made.mode_field(info, step, modulations=(0, 1, 2, 3)),
            ]
        )
        self.succeeds(SPECTRUM_FILES + files('dispersion', 'steps', 'modes', 'p_mode'))


class Phases(Bags):
    """Phases turn by v k = 1.5895 rad per time unit."""

    def course(self, *times_and_beginnings, lost=()):
        info = made.run_info()
        step = made.step(info, LP, 1, 0, 32, 35)
        messages = [
            made.lp_phases(info, [step], time, began=began) for time, began in times_and_beginnings
        ]
        for message in messages:
            if message.sim_time in lost:
                for phase in message.phases:
                    phase.state, phase.phase = phase.WEAK, 0.0
        return self.recorded(info, made.steps([step]), *messages)

    def curves(self, run, number=0):
        return [list(time) for time, _ in run.phases.curves(number)]

    def test_one_curve(self):
        run = self.course(*((float(t), 100.0) for t in range(101, 106)))
        ((time, phase),) = run.phases.curves(0)
        self.assertEqual(list(time), [101, 102, 103, 104, 105])
        self.assertTrue(np.allclose(np.diff(phase), -made.VELOCITY * 0.993459))
        # another vector and another pair
        self.assertEqual(phases.chosen(run), [(0, [0, 3])])

    def test_told_twice(self):
        """Of one state there can be several reports."""
        run = self.course(*((float(t), 100.0) for t in (101, 102, 102, 103, 103, 103, 104)))
        self.assertEqual(self.curves(run), [[101, 102, 103, 104]])

    def test_lost_for_a_while(self):
        run = self.course(*((float(t), 100.0) for t in range(101, 108)), lost=(104.0,))
        self.assertEqual(self.curves(run), [[101, 102, 103], [105, 106, 107]])

    def test_begun_anew(self):
        run = self.course(
            *((float(t), 100.0) for t in range(101, 104)),
            *((float(t), 103.5) for t in range(104, 107)),
        )
        self.assertEqual(self.curves(run), [[101, 102, 103], [104, 105, 106]])

    def test_never_tracked(self):
        run = self.course(*((float(t), 100.0) for t in range(101, 104)), lost=(101, 102, 103))
        self.assertEqual((self.curves(run), phases.chosen(run)), ([], []))


class LongBags(Bags):
    def test_course_is_thinned_evenly_and_ends_with_the_last_row(self):
        course = Course()
        self.assertIsNone(course.table())
        for count in (1, 2, LIMIT, LIMIT + 1, 3 * LIMIT + 2, 10 * LIMIT):
            course.clear()
            for row in range(count):
                course.add((row, -row))
            kept = course.table()[:, 0]
            self.assertEqual((kept[0], kept[-1]), (0, count - 1))
            self.assertLessEqual(len(kept), LIMIT + 1)
            self.assertGreaterEqual(len(kept), min(count, LIMIT // 2))
            self.assertEqual(len(set(np.diff(kept[:-1]))), 0 if len(kept) < 3 else 1)

    def test_restart_is_seen_in_a_thinned_course(self):
        info = made.run_info()
        step = made.step(info, LP, 1, 0, 37, 37)
        run = recording.Recording(info)
        for t in range(3 * LIMIT):
            run.phases.add(
                made.lp_phases(
                    info,
                    [step],
                    float(t),
                    modulations=(0,),
                    began=0.0 if t < LIMIT else LIMIT - 0.5,
                )
            )
        begins = [time[0] for time, _ in run.phases.curves(0)]
        self.assertEqual(begins, [0, LIMIT])

    def test_memory(self):
        info = made.run_info(disks=2000, box_x=63.2, box_y=63.2)
        step = made.step(info, LP, 1, 0, 3994, 3997)
        field = made.mode_field(info, step)
        one = 8 * 20 * info.disks  # bytes: vectors and two pairs
        self.write(
            itertools.chain(
                [info], itertools.repeat(field, 100), itertools.repeat(made.steps([step]), 1000)
            )
        )
        self.assertGreater(os.path.getsize(self.path), 100 * one)
        tracemalloc.start()
        try:
            run = recording.read(self.path)
            _, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        self.assertEqual(len(list(run.fields())), 1)
        self.assertLess(peak, 20 * one)


class Numbers(unittest.TestCase):
    def test_with_error(self):
        for value, error, text in (
            (0.612524, 0.00067, '0.61252(67)'),
            (0.9, 0.0996, '0.90(10)'),
            (1.0, 0.00996, '1.000(10)'),
            (-2.34567, 0.5, '-2.35(50)'),
            (12.345, 1.46, '12.3(1.5)'),
            (1234.5, 23.4, '1234(23)'),
            (12345.6, 234.0, '12350(230)'),
            (3.76e-16, 2.1e-17, '3.8e-16'),
            (0.5, -1.0, '0.50000'),
            (0.5, float('nan'), '0.50000'),
            (0.5, 0.0, '0.50000'),
        ):
            self.assertEqual(with_error(value, error), text)

    def test_modulation(self):
        info = made.run_info(box_x=10.0, box_y=6.0, boundary_y='reflecting')
        a = waves.modulation(info, 1, 2, waves.SIN_X, 1.0, 2.0)
        self.assertAlmostEqual(a, np.sin(2 * np.pi / 10) * np.cos(2 * np.pi / 5 * 1.5))
        self.assertEqual(waves.formula(1, 2, waves.SIN_X), r'$\sin k_x x\,\cos k_y y$')


class Refusals(Bags):
    def test_several_nodes(self):
        self.write([made.run_info(), made.spectrum([3.0], 1.0)], node='/hdlyap')
        self.write([made.run_info(), made.spectrum([4.0], 1.0)], node='/far/away', mode='a')
        self.refuses('choose one with --node: /far/away, /hdlyap')
        self.refuses('no node other in it', '--node', 'other')
        self.assertIn('lambda_max      4.0', self.succeeds(SPECTRUM_FILES, '--node', 'far/away'))

    def test_bag_without_run_info(self):
        self.write([made.spectrum([3.0], 1.0), made.steps([])])
        self.refuses('no run_info')

    def test_foreign_bag(self):
        with rosbag.Bag(self.path, 'w') as bag:
            bag.write('/chatter', String('hello'), rospy.Time(1))
        self.refuses('nothing in it was published by hdlyap_node')

    def test_missing_file(self):
        self.how = plot_bag_process
        self.refuses('No such file')

    def test_not_a_bag(self):
        for content in b'', b'something else entirely\n' * 10:
            with open(self.path, 'wb') as file:
                file.write(content)
            self.refuses('not a readable bag')

    def test_unindexed_bag(self):
        bag = rosbag.Bag(self.path, 'w')
        bag.write('/hdlyap/run_info', made.run_info(), rospy.Time(1))
        bag.flush()
        with open(self.path, 'rb') as file:
            content = file.read()
        bag.close()
        with open(self.path, 'wb') as file:
            file.write(content)
        self.refuses('rosbag reindex')


if __name__ == '__main__':
    unittest.main()
