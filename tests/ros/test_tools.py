"""plot_bag and compare: bags of several, unfinished, long and short runs."""

import os
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import made
from made import LP, T
from terminal import Terminal
from hdlyap.plots import recording, report, verdict
from hdlyap.plots.comparison import Comparison
from hdlyap.plots.figures import plt, spectrum as figure_of_spectrum, steps as figure_of_steps

EXPONENTS = np.linspace(9, 3, 37)


class Bag(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.path = os.path.join(folder.name, 'run.bag')

    def recorded(self, messages, **which):
        made.write(self.path, messages)
        return recording.read(self.path, **which)


class SeveralRuns(Bag):
    def messages(self):
        return [
            made.cost(1.0),
            made.run_info(),
            made.spectrum([3.0], 1.0),
            made.run_info(run_id='two'),
            made.spectrum([4.0], 2.0, run_id='two'),
            made.run_info(),
            made.spectrum([5.0], 2.0),
        ]  # the first goes on being repeated

    def test_the_last_or_the_chosen_one(self):
        for number, (run_id, largest) in (
            (None, ('two', 4.0)),
            (1, ('one', 5.0)),
            (2, ('two', 4.0)),
        ):
            run = self.recorded(self.messages(), number=number)
            self.assertEqual((run.info.run_id, run.spectrum.lambda_max), (run_id, largest))
            self.assertIn('one of 2 runs in the bag; --run 1 .. 2 chooses', report.report(run))
        self.assertNotIn('runs in the bag', report.report(self.recorded(self.messages()[:3])))

    def test_a_number_that_is_none(self):
        for number in (0, 3, -1):
            with self.assertRaisesRegex(
                recording.RecordingError, f'no run {number} in it, only 1 .. 2'
            ):
                self.recorded(self.messages(), number=number)

    def test_what_was_recorded_before_run_info_counts(self):
        self.assertEqual(list(self.recorded(self.messages(), number=1).cost()['time']), [1.0])


class Unfinished(Bag):
    def test_name_of_a_bag_that_is_still_recorded(self):
        open(self.path + '.active', 'w').close()
        with self.assertRaisesRegex(
            recording.RecordingError, r'run\.bag\.active is there: .* rosbag reindex .*\.active$'
        ):
            recording.read(self.path)


class Long(Bag):
    def test_time_left_on_a_terminal(self):
        """Every step of a thousand takes a tenth of a second of a clock that is made up."""
        terminal = Terminal(
            [
                sys.executable,
                '-c',
                '''
import itertools, time
from hdlyap.plots.progress import Progress
ticks = itertools.count()
time.monotonic = lambda: 0.1 * next(ticks)
for number in Progress('reading').over(range(1000), 1000):
    pass
''',
            ]
        )
        self.addCleanup(terminal.stop)
        self.assertEqual(terminal.wait(), 0)
        self.assertTrue(terminal.wait_for(''))
        # at number 500: 50.1 s are over
        self.assertRegex(terminal.output, 'reading  █{15}░{15}  50 %  0:50 left')
        self.assertEqual(terminal.output[-4:], '\r\033[K')


class Steps(Bag):
    def test_figure(self):
        info = made.run_info()
        shared = {'set': 7, 'members': 2}
        both = [
            made.step(info, T, 1, 1, 26, 33, expected=4, multiplicity=3.9, **shared),
            made.step(info, LP, 0, 1, 26, 33, expected=4, multiplicity=3.5, **shared),
        ]
        exponents = EXPONENTS.copy()
        exponents[35:] = 1.01, 0.99
        run = self.recorded(
            [
                info,
                made.spectrum(exponents, 50.0),
                made.steps([made.step(info, T, 1, 0, 36, 37), *both]),
            ]
        )
        figure = figure_of_steps.draw(run)
        self.addCleanup(plt.close, figure)
        top, bottom = figure.axes
        self.assertEqual(
            [text.get_text() for text in bottom.get_xticklabels()], ['T(1,0)', 'LP(0,1)\n+T(1,1)']
        )
        heights = [bar.get_height() for bar in top.patches]
        self.assertTrue(np.allclose(heights, [99.0, 92.5]), heights)
        off = bottom.containers[0][0].get_ydata()
        self.assertTrue(np.allclose(off, [1.0, -1.0]), off)


class Far(Bag):
    def test_indices_that_are_not_drawn(self):
        """A step of 4 10^9 vectors must not take a while."""
        info = made.run_info()
        far = made.step(info, T, 1, 0, 30, 2**32 - 1)
        run = self.recorded([info, made.spectrum(EXPONENTS, 50.0), made.steps([far])])
        colours = figure_of_spectrum._colours(run, 20, 37)
        self.assertEqual(list(colours), list(range(30, 38)))


class Interrupted(Bag):
    def test_while_something_is_imported(self):
        """No traceback of it: ended by the signal."""
        for name in ('rosbag', 'rospy', 'rospkg', 'roslaunch', 'roslib'):
            with open(os.path.join(self.folder, name + '.py'), 'w') as file:
                file.write('import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\n')
                file.write('time.sleep(60)\n')
        scripts = 'compare fit_dispersion follow hdlyap_run plot_bag record redraw repeat replay'
        scripts += ' reproduce sweep sweep_table view'
        path = os.pathsep.join([self.folder, os.environ['PYTHONPATH']])
        for name in scripts.split():
            ended = subprocess.run(
                [sys.executable, os.path.join(made.SCRIPTS, name)],
                env=dict(os.environ, PYTHONPATH=path),
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
            )
            self.assertEqual((ended.returncode, ended.stdout), (-signal.SIGINT, ''), name)


class Short(Bag):
    def verdict(self, lengths, smallest=0.25):
        runs = [
            self.recorded(
                [
                    made.run_info(run_id=name),
                    made.spectrum(
                        [3.0 + shift, *[smallest] * 36, *[1e-9] * 6], length, run_id=name
                    ),
                ]
            )
            for name, length, shift in zip(('one', 'two'), lengths, (0.0, 0.001))
        ]
        return verdict.verdict(Comparison(*runs))[0]

    def test_warning(self):
        """The slowest takes 4 time units: 100 of them are 25 of those."""
        self.assertNotIn('is short', self.verdict((121.0, 121.0)))
        text = self.verdict((121.0, 100.0))
        self.assertIn('b is short: 25 times 1 / its smallest positive exponent', text)
        self.assertNotIn('a is short', text)
        self.assertTrue(text.splitlines()[-1].startswith('agree'))


if __name__ == '__main__':
    unittest.main()
