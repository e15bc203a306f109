"""hdlyap plot of bags that are made here: which files it writes, what it prints beside its table
(test_plot_bag_table.py), what it refuses; and what is kept of a bag."""

import errno
import itertools
import os
import tempfile
import tracemalloc
import unittest
from unittest import mock

import numpy as np
from matplotlib.figure import Figure
from matplotlib.image import imread

from hdlyap.msg import LpPhases, ModeField, Steps

import hdlyap
import made
import made_fields
from bags import Bags, files, process, tool
from made import LP, T
from hdlyap.data.reader import RecordingError
from hdlyap.data import waves
from hdlyap.data.course import LIMIT, Course
from hdlyap.data.phases import PhaseCourse
from hdlyap import whole
from hdlyap.plots import paper, report, window
from hdlyap.plots.figures import phases
from hdlyap.numbers import with_error

INFO = made.run_info()
HALF = np.linspace(3, 1, 37)
WHOLE = [*HALF, *[0.0] * 6, *-HALF[::-1]]
LP_STEP = made.step(INFO, LP, 1, 0, 32, 35)

SPECTRUM = files('convergence', 'spectrum')
COST = files('cost')
STEPS = files('dispersion', 'steps')
MODES = files('dispersion', 'steps', 'modes', 'p_mode', 'phases')


def paper_spectrum(info):
    exponents = np.linspace(6.8, 1.0, 1557)
    for step in paper.steps(info):
        exponents[step.first - 1 : step.last] = 1.01 * step.fitted
    return made.spectrum(exponents, 10.0)


def cases():
    """Messages, files that are written, what is printed, what is not."""
    costs = [made.cost(1), made.cost(2)]
    spectra = [made.spectrum(HALF, t) for t in range(1, 30)]
    yield [INFO, *spectra, *costs], SPECTRUM + COST, ('averaged time   29\n',), 'pairing|steps'
    wave = made.step(INFO, T, 1, 0, 36, 37)
    yield [INFO, made.spectrum([3.5], 1.0, error=-1.0)], SPECTRUM, (
        r'     1      3\.50000\n',
        r'lambda_max      3\.50000\n',
    ), 'h_KS|sum'
    yield [INFO, made.spectrum([3.5, 1.0], 1.0)], SPECTRUM, (
        r'sum of the 2 exponents carried 4\.500\(20\)\n',
    ), 'h_KS'
    yield [INFO, *costs], COST, ('no averaged spectrum',), 'gas,'
    walls = made.run_info(boundary_x='reflecting')
    yield [walls, made.gas(error=-1.0), *costs], COST, (
        r'pressure        1\.25000 per sigma\^2\n',
    ), 'Henderson'
    yield [INFO, made.soft_gas(), *costs], COST, (
        r'gas, averaged over 50\npressure        1\.250\(10\) per sigma\^2\n',
        r'Z = p A / N kT  5\.000\(20\)\n',
        r'temperature     0\.625\(10\) epsilon\n',
        r'potential / N   0\.500\(10\) epsilon\n',
    ), 'collision|nan'
    widths = made.localization(np.linspace(0.1, 0.8, 37))
    yield [INFO, made.spectrum(HALF, 50.0), widths], SPECTRUM + files('localization'), (), None
    spread = made.fluctuations(list(np.linspace(0.5, 0.1, 37)))
    yield [INFO, made.spectrum(HALF, 50.0), spread], SPECTRUM + files('fluctuations'), (), None
    info = made.paper_info()
    deviations = r'(?s)' + 5 * r'.* \+1\.00 %' + r'(?!.*\+1\.00 %)'
    yield [info, paper_spectrum(info)], SPECTRUM, (
        r'T\(1,0\) +1556-1557 +0\.18736 +0\.62\d+ +0\.01000 +0\.61\d\d +\+1\.00 %',
        deviations,
    ), None
    unresolved = [made.unresolved(INFO, LP, 1, 0, 4), made.zero_modes()]
    yield [INFO, made.spectrum(HALF, 1.0), made.steps(unresolved)], SPECTRUM, (
        r'not resolved \(1\): LP\(1,0\)',
    ), None
    both = made.steps([wave, made.zero_modes(38)])
    yield [INFO, made.spectrum(WHOLE, 1.0), both], SPECTRUM + STEPS, (), None
    channel = dict(aspect=0.0375, box_x=40.0, box_y=1.5, boundary_y='reflecting')
    for info, nx, ny, bits in (
        (made.run_info(zero_exponents=4, **channel), 1, 0, (0, 1)),
        (INFO, 1, 1, (0, 1, 2, 3)),
    ):
        step = made.step(info, LP, nx, ny, 30, 37)
        field = made_fields.mode_field(info, step, modulations=bits)
        messages = [info, made.spectrum(np.linspace(3, 1, 38), 1.0), made.steps([step]), field]
        yield messages, SPECTRUM + STEPS + files('modes', 'p_mode'), (rf'LP\({nx},{ny}\)',), None
    everything = made.small_run()
    yield everything, SPECTRUM + COST + MODES, (r'T\(1,0\) +36-37 +1\.98',), None
    for left_out, gone in (
        (Steps, MODES),
        (LpPhases, files('phases')),
        (ModeField, files('modes', 'p_mode')),
    ):
        names = set(SPECTRUM + COST + MODES) - set(gone)
        yield [one for one in everything if not isinstance(one, left_out)], names, (), None


class Command(Bags):
    def plot(self, names, *arguments, how=tool):
        text = self.succeeds('plot', self.path(), '--out', self.out, *arguments, how=how)
        self.assertEqual(sorted(os.listdir(self.out)), sorted(names))
        return text

    def test_cases(self):
        for number, (messages, names, said, not_said) in enumerate(cases()):
            with self.subTest(number, said=said, names=names):
                self.out += '_'
                self.write(messages)
                text = self.plot(names)
                for words in said:
                    self.assertRegex(text, words)
                if not_said:
                    self.assertNotRegex(text, not_said)

    def test_chosen_figures_on_pages(self):
        self.write(made.small_run())
        pdf = os.path.join(self.folder, 'talk.pdf')
        text = self.plot(files('phases', 'steps'), '--only', 'steps', 'phases', '--pdf', pdf)
        self.assertTrue(text.endswith(pdf + '\n'))
        with open(pdf, 'rb') as file:
            self.assertEqual(file.read().count(b'/Type /Page '), 2)
        self.assertEqual(sorted(os.listdir(self.folder)), ['out', 'run.bag', 'talk.pdf'])
        for more in ((), ('--csv', self.out)):
            text = self.succeeds(
                'plot', self.path(), '--only', 'localization', '--out', self.out, *more
            )
            self.assertIn('\nnothing to draw in this bag: localization', text)
        done = tool('plot', self.path(), '--only', 'picture')
        self.assertEqual(done.status, 2)
        # Python 3.12 has no quotes there
        self.assertRegex(done.error, r"'picture' \(choose from '?spectrum'?, ")

    def test_process(self):
        self.write([INFO, made.spectrum(HALF, 50.0), made.steps([LP_STEP])])
        text = self.plot(SPECTRUM + STEPS, how=process)
        for name in os.listdir(self.out):
            path = os.path.join(self.out, name)
            self.assertIn(path, text)
            if name.endswith('.png'):
                self.assertGreater(np.std(imread(path)), 0.01, name)
            else:
                with open(path) as file:
                    self.assertIn('</svg>', file.read()[-10:])


class Kept(Bags):
    """Of a bag."""

    def test_averages_start_afresh_after_a_reset(self):
        spectra = [made.spectrum([3.0, 2.0], t) for t in [1, 2, 3, 1, 2]]
        for time, message in enumerate(spectra, 101):
            message.sim_time = time
        run = self.recorded([INFO, *spectra])
        self.assertEqual(list(run.course()['time']), [1, 2])

    def test_last_of_two_runs(self):
        run = self.recorded(
            [
                INFO,
                made.spectrum([9.0], 5.0),
                made.steps([LP_STEP]),
                made.lp_phases(INFO, [LP_STEP], 5.0),
                made_fields.mode_field(INFO, LP_STEP),
                made.run_info(run_id='two'),
                made.steps([LP_STEP]),  # late
                made.spectrum([3.0], 1.0, run_id='two'),
            ]
        )
        self.assertEqual((run.info.run_id, run.spectrum.lambda_max), ('two', 3.0))
        self.assertEqual((run.steps, list(run.fields()), run.phases.last), (None, [], None))

    def test_the_last_run_or_the_chosen_one(self):
        """The first goes on being repeated; what came before any run_info belongs to it."""
        messages = [
            made.cost(1.0),
            INFO,
            made.spectrum([3.0], 1.0),
            made.run_info(run_id='two'),
            made.spectrum([4.0], 2.0, run_id='two'),
            INFO,
            made.spectrum([5.0], 2.0),
        ]
        for number, chosen in ((None, ('two', 4.0)), (1, ('one', 5.0)), (2, ('two', 4.0))):
            run = self.recorded(messages, run=number)
            self.assertEqual((run.info.run_id, run.spectrum.lambda_max), chosen)
            self.assertIn('one of 2 runs in the bag; --run 1 .. 2 chooses', report.report(run))
        self.assertEqual(list(self.recorded(messages, run=1).cost()['time']), [1.0])
        for number in (0, 3, -1):
            with self.assertRaisesRegex(RecordingError, f'no run {number} .* 1 .. 2'):
                self.recorded(messages, run=number)
        self.assertNotIn('runs in the bag', report.report(self.recorded(messages[:3])))

    def test_phases(self):
        """Turn by v k = 1.5895 rad per time unit; curves without what was told twice or lost."""
        time = [float(t) for t in range(101, 108)]
        for times, began, lost, curves in (
            (time, {}, (), [time]),
            ([101, 102, 102, 103, 103, 103, 104], {}, (), [[101, 102, 103, 104]]),
            (time, {}, (104,), [[101, 102, 103], [105, 106, 107]]),
            (
                time[:6],
                {104: 103.5, 105: 103.5, 106: 103.5},
                (),
                [[101, 102, 103], [104, 105, 106]],
            ),
            (time[:3], {}, (101, 102, 103), []),
        ):
            told = [made.lp_phases(INFO, [LP_STEP], t, began=began.get(t, 100.0)) for t in times]
            for phase in (one for each in told if each.sim_time in lost for one in each.phases):
                phase.state, phase.phase = phase.WEAK, 0.0
            for number, each in enumerate(told):
                each.sim_time += 0.1 * number  # of its report
            run = self.recorded([INFO, made.steps([LP_STEP]), *told])
            self.assertEqual([list(time) for time, _ in run.phases.curves(0)], curves)
            # another vector and another pair
            self.assertEqual(phases.chosen(run), [(0, [0, 3])] if curves else [])
            for _, phase in run.phases.curves(0):
                np.testing.assert_allclose(np.diff(phase), -made.VELOCITY * made.K)

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
        step, course = made.step(INFO, LP, 1, 0, 37, 37), PhaseCourse()
        for t in range(3 * LIMIT):
            began = 0.0 if t < LIMIT else LIMIT - 0.5
            course.add(made.lp_phases(INFO, [step], float(t), modulations=(0,), began=began))
        self.assertEqual([time[0] for time, _ in course.curves(0)], [0, LIMIT])

    def test_memory(self):
        info = made.run_info(number=2000, box_x=63.2, box_y=63.2)
        step = made.step(info, LP, 1, 0, 3994, 3997)
        one = 8 * 20 * info.number  # bytes: vectors and two pairs
        fields = itertools.repeat(made_fields.mode_field(info, step), 100)
        self.write(itertools.chain([info], fields, itertools.repeat(made.steps([step]), 1000)))
        self.assertGreater(os.path.getsize(self.path()), 100 * one)
        tracemalloc.start()
        try:
            run = hdlyap.load(self.path()).summary
            self.assertEqual(len(list(run.fields())), 1)
            self.assertEqual(len(run.steps.steps), 1)
            _, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        self.assertLess(peak, 20 * one)


class Small(unittest.TestCase):
    def test_window_without_room(self):
        """Has no figure until it is larger."""
        for size, count in (((120, 60), 1), ((40, 20), 0)):
            canvas = mock.Mock()
            widget, root = canvas.get_tk_widget.return_value, mock.Mock()
            widget.winfo_width.return_value, widget.winfo_height.return_value = size
            root._root.winfo_height.return_value = 60
            window.Window._show(root, canvas, Figure())
            self.assertEqual(canvas.draw.call_count, count)

    def test_full_disk(self):
        """Is said with the name of the file that was asked for."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'a.csv')
            with self.assertRaisesRegex(OSError, f"No space left on device: '{path}'"):
                with whole.written(path) as unfinished, open(unfinished, 'w'):
                    raise OSError(errno.ENOSPC, 'No space left on device')
            self.assertEqual(os.listdir(folder), [])


class Numbers(unittest.TestCase):
    def test_with_error(self):
        for value, error, text in (
            (0.612524, 0.00067, '0.61252(67)'),
            (0.9, 0.0996, '0.90(10)'),
            (1.0, 0.00996, '1.000(10)'),
            (-2.34567, 0.5, '-2.35(50)'),
            (-1e-5, 0.014, '0.000(14)'),
            (-1e-9, -1.0, '0.00000'),
            (12.345, 1.46, '12.3(1.5)'),
            (1234.5, 23.4, '1234(23)'),
            (12345.6, 234.0, '12350(230)'),
            (3.76e-16, 2.1e-17, '3.8e-16'),
            (0.5, -1.0, '0.50000'),
            (0.5, float('nan'), '0.50000'),
            (1e308, float('nan'), '1e+308'),
            (1e100, 1e99, '1.0e+100'),
            (0.5, 0.0, '0.50000'),
            (float('nan'), 0.1, '-'),
        ):
            self.assertEqual(with_error(value, error), text)

    def test_modulation(self):
        info = made.run_info(box_x=10.0, box_y=6.0, boundary_y='reflecting')
        a = waves.modulation(info, 1, 2, waves.SIN_X, 1.0, 2.0)
        self.assertAlmostEqual(a, np.sin(2 * np.pi / 10) * np.cos(2 * np.pi / 5 * 1.5))
        self.assertEqual(waves.formula(1, 2, waves.SIN_X), r'$\sin k_x x\,\cos k_y y$')
