"""Structure factors and their lines, of waves that are known."""

import itertools
import unittest

import numpy as np
from matplotlib.figure import Figure

import hdlyap
import made
from bags import Bags
from hdlyap.msg import Structure
from hdlyap.data import factors
from hdlyap.plots import figures

OMEGA = made.VELOCITY  # times k
WAVES = np.array([(1, 0), (0, 1), (1, 1), (2, 0)])


class Lines(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(5)

    def times(self, count=400, uneven=0.0):
        return np.cumsum(1.0 + uneven * self.random.uniform(-1, 1, count))

    def turning(self, times, omega, diffusion=0.0):
        steps = np.sqrt(2 * diffusion * np.gradient(times)) * self.random.normal(size=len(times))
        phase = omega * times + np.cumsum(steps)
        return np.stack([np.cos(phase), np.sin(phase)], axis=1)

    def test_even_rotation(self):
        """At any distance of the times; far below the distance of two frequencies."""
        for omega, uneven in itertools.product((0.2, 0.77, 2.0), (0.0, 0.3)):
            times = self.times(uneven=uneven)
            found = factors.line(times, self.turning(times, omega))
            self.assertAlmostEqual(found.omega, omega, delta=0.3 * 2 * np.pi / np.ptp(times))
            self.assertLess(found.error, 0.05 * omega)

    def test_near_the_largest_frequency(self):
        """Mirror images, which lie evenly about pi, do not count."""
        times = self.times()
        found = factors.line(times, self.turning(times, 3.0))
        self.assertAlmostEqual(found.omega, 3.0, delta=2 * np.pi / np.ptp(times))

    def test_errors_of_diffusing_phases(self):
        """Deviations are as large as stated; 40 of them, each error from 4 pieces."""
        off, stated = [], []
        for _ in range(40):
            times = self.times(200)
            found = factors.line(times, self.turning(times, 0.8, diffusion=0.01))
            off.append(found.omega - 0.8)
            stated.append(found.error)
        ratio = np.sqrt(np.mean(np.square(off)) / np.mean(np.square(stated)))
        self.assertTrue(0.6 < ratio < 1.6, ratio)

    def test_what_stands_still_is_at_zero(self):
        times = self.times()
        found = factors.line(times, self.turning(times, 0.0, diffusion=1e-4))
        self.assertEqual(found, (0.0, 4 * np.pi / np.ptp(times)))
        slow = factors.line(times, self.turning(times, 2 * found.error))
        self.assertAlmostEqual(slow.omega, 2 * found.error, delta=0.2 * found.error)

    def test_power_is_the_mean_square(self):
        times = self.times()
        series = self.turning(times, 0.8) + 0.1 * self.random.normal(size=(400, 2))
        omega = 2 * np.pi / np.ptp(times) * np.arange(-200, 200)
        total = factors.power(times, series, omega).sum()
        self.assertAlmostEqual(total, (series**2).sum(axis=1).mean(), delta=0.03)

    def test_no_line_without_a_course(self):
        times = self.times(factors.REPORTS - 1)
        self.assertIsNone(factors.line(times, self.turning(times, 0.8)))


def message(info, sim_time, found, vectors=37, means=True, omega=(OMEGA, 0.0)):
    """Vectors of these steps have their waves; LP turn by v k, T stand, unless omega says otherwise
    of LP and of T, over k. Others are noise."""
    factors = np.full((2, len(WAVES), vectors), 0.5)
    peak = np.full(vectors, 4)
    now = np.zeros((2, 4, vectors))
    for one in found:
        wave = int(np.flatnonzero((WAVES == (one.nx, one.ny)).all(axis=1))[0])
        direction = 0 if one.kind == made.LP else 1
        turned = 0.3 + omega[direction] * one.wave_number * sim_time
        for index in range(one.first_index, one.last_index + 1):
            phase = turned + 0.5 * np.pi * (index - one.first_index)
            factors[direction, wave, index - 1] = 8.0
            peak[index - 1] = wave + 1
            now[direction, 0, index - 1] = np.cos(phase)
            now[direction, 1, index - 1] = np.sin(phase)
    k = np.hypot(*(2 * np.pi * WAVES / (info.box_x, info.box_y)).T)
    return Structure(
        run_id='one',
        sim_time=sim_time,
        samples=int(sim_time),
        nx=WAVES[:, 0],
        ny=WAVES[:, 1],
        wave_number=k,
        along=factors[0].ravel() if means else [],
        across=factors[1].ravel() if means else [],
        peak=peak,
        amplitude_along=now[0].ravel(),
        amplitude_across=now[1].ravel(),
    )


class Recorded(Bags):
    def setUp(self):
        super().setUp()
        self.info = made.run_info()
        self.found = [
            made.step(self.info, made.T, 1, 0, 36, 37),
            made.step(self.info, made.LP, 1, 0, 32, 35),
        ]
        times = range(60)
        self.messages = [
            message(self.info, 100.0 + t, self.found, means=t % 10 == 9) for t in times
        ]
        steps = made.steps([*self.found, made.zero_modes()], 60.0)
        self.bag = self.write([*self.head(), steps, *self.messages])

    def head(self):
        return self.info, made.spectrum(np.linspace(9, 3, 37), 60.0)

    def test_data(self):
        run = hdlyap.load(self.bag)
        last = self.messages[-1]
        got = run.structure
        self.assertEqual(got.samples, last.samples)
        self.assertEqual(list(zip(got.waves.nx, got.waves.ny)), [tuple(wave) for wave in WAVES])
        self.assertEqual(got.waves.attrs['units']['wave_number'], '1/sigma')
        self.assertEqual(got.along.shape, (37, 4))
        self.assertEqual(got.along.loc[33, (1, 0)], 8.0)
        self.assertEqual(got.across.loc[33, (1, 0)], 0.5)
        self.assertEqual(got.across.loc[37, (1, 0)], 8.0)
        self.assertTrue((got.peaks.loc[32:, ['nx', 'ny']] == (1, 0)).all().all())
        self.assertTrue(np.allclose(got.peaks.wave_number[32:], last.wave_number[0]))
        peaks = [tuple(got.peaks.loc[index, ['along', 'across']]) for index in (33, 37)]
        self.assertEqual(peaks, [(8.0, 0.5), (0.5, 8.0)])

    def test_amplitudes(self):
        self.messages[3].peak = list(self.messages[3].peak)
        self.messages[3].peak[32] = 2
        self.write([*self.head(), *self.messages])
        got = hdlyap.load(self.bag).amplitudes([33, 34], 'along')
        self.assertEqual(list(got.columns[:2]), [(33, 0), (33, 1)])
        self.assertEqual(list(got.index), [one.sim_time for one in self.messages])
        want = [np.array(one.amplitude_along).reshape(4, 37)[1, 32] for one in self.messages]
        want[3] = np.nan
        np.testing.assert_array_equal(got[33, 1], want)

    def test_without_means(self):
        times = range(100, 103)
        self.write([*self.head(), *(message(self.info, t, [], means=False) for t in times)])
        with self.assertRaisesRegex(Exception, 'no message of structure with means in it'):
            hdlyap.load(self.bag).structure
        self.assertIsNone(figures.structure.draw(hdlyap.load(self.bag).summary))

    def test_figure(self):
        """The map has the numbers, the lines are at v k and at 0."""
        figure = figures.structure.draw(hdlyap.load(self.bag)).figure
        along, across, *others = figure.axes
        (lines,) = (one for one in others if one.get_title(loc='left').startswith('(c)'))
        image = along.collections[0].get_array().reshape(-1, 37)
        k = np.unique(np.round(self.messages[-1].wave_number, 9))
        row = int(np.argmin(abs(k - self.messages[-1].wave_number[0])))
        np.testing.assert_allclose(image[row, 31:35], 8.0)
        np.testing.assert_allclose(image[row, 35:], 0.5)
        np.testing.assert_allclose(across.collections[0].get_array().reshape(-1, 37)[row, 35:], 8.0)
        corners = along.collections[0]._coordinates  # of the cells, one round each index and k
        np.testing.assert_allclose(corners[0, :, 0], np.arange(38) + 0.5)
        np.testing.assert_allclose(corners[:-1, 0, 1], 0.5 * (k + np.append(0, k[:-1])))
        for axes, index in ((along, 33.5), (across, 36.5)):
            (ring,) = axes.lines
            np.testing.assert_allclose(ring.get_xydata(), [(index, made.K)])
        phases = '$v k$ of the phases, LP(1,0)'
        found = {line.get_label().split(':')[0]: line for line in lines.lines}
        peak = {
            name: line.get_xdata()[np.argmax(line.get_ydata())]
            for name, line in found.items()
            if '(' in name and 'phases' not in name
        }
        self.assertEqual(set(peak), {'T(1,0)', 'LP(1,0)'})
        self.assertEqual(peak['T(1,0)'], 0.0)
        self.assertAlmostEqual(
            peak['LP(1,0)'], OMEGA * self.found[1].wave_number, delta=2 * np.pi / 59
        )
        self.assertAlmostEqual(found[phases].get_xdata()[0], 1.612 * made.K)  # of made.steps

    def test_reports_that_are_too_rare(self):
        """v k = 1.60 is more than half a turn in 2.4 time units, not in 1."""
        for k, one in enumerate(self.messages):
            one.sim_time = 100.0 + 2.4 * k
        steps = made.steps([*self.found, made.zero_modes()], 60.0)
        self.write([*self.head(), steps, *self.messages], 'rare')
        page = figures.structure.draw(hdlyap.load(self.path('rare')))
        (line,) = page.left_out
        self.assertRegex(line, r'the line of LP\(1,0\): it turns by 1.6 .*; report_interval: 0.98 ')
        (lines,) = (one for one in page.axes if one.get_title(loc='left').startswith('(c)'))
        self.assertEqual([one.get_label()[:2] for one in lines.lines], ['T('])

    def test_no_line_is_known(self):
        """Where no step is found there is no panel, and it is said why; the user's says it."""
        self.write([*self.head(), *self.messages], 'without')
        run = hdlyap.load(self.path('without'))
        page = figures.structure.draw(run)
        titles = [one.get_title(loc='left') for one in page.axes]
        self.assertEqual([title[:3] for title in titles if title], ['(a)', '(b)'])
        (line,) = page.left_out
        self.assertIn('16 reports of its vectors at one wave', line)
        self.assertEqual(figures.structure.draw(hdlyap.load(self.bag)).left_out, [])
        axes = list(Figure().subplots(1, 3))
        self.assertEqual(figures.structure.draw(run, ax=axes).left_out, [])
        self.assertEqual([text.get_text() for text in axes[2].texts], ['no line is known'])

    def test_a_wave_that_changes_begins_the_course_anew(self):
        course = factors.StructureCourse()
        for t, one in enumerate(self.messages):
            one.peak = np.array(one.peak)
            one.peak[32] = 2 if t < 7 else 1
            one.amplitude_along = np.array(one.amplitude_along)
            course.add(one, 37)
        times, series = course.of([32, 33], 'along')
        self.assertEqual((len(times), series.shape), (53, (53, 8)))
        self.assertEqual(len(course.of([36, 37], 'across')[0]), 60)
