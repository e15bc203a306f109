"""How long samples remember, against noise that is known to the last digit, and against what a node
has stated."""

import unittest

import numpy as np
from scipy.signal import lfilter

import bags
import hdlyap
import made
from hdlyap.data import series
from hdlyap.plots.figures import blocks

RUNS = 200  # of a kind: means over them are known to a few %


def remembering(share, length, seed=1):
    """Columns of AR(1) noise: each sample is `share` of the one before, and noise."""
    noise = np.random.default_rng(seed).normal(size=(length + 500, RUNS))
    return lfilter([1], [1, -share], noise, axis=0)[500:]


def error_of_mean(share, length):
    """Exactly, of such noise."""
    lags = np.arange(1, length)
    inside = 1 + 2 * np.sum((1 - lags / length) * share**lags)
    return np.sqrt(inside / length / (1 - share**2))


class Noise(unittest.TestCase):
    def test_autocorrelation(self):
        """The sums, one by one; and as the noise has it."""
        values = np.array([[1.0, 4.0], [2.0, 1.0], [4.0, 0.0], [3.0, 7.0]])
        off = values - values.mean(axis=0)
        direct = [(off[k:] * off[: 4 - k]).sum(axis=0) / (off**2).sum(axis=0) for k in range(4)]
        np.testing.assert_allclose(series.autocorrelation(values), direct, atol=1e-12)
        found = series.autocorrelation(remembering(0.8, 4000))[:6].mean(axis=1)
        np.testing.assert_allclose(found, 0.8 ** np.arange(6), atol=0.01)

    def test_times_and_errors(self):
        for share in (-0.5, 0.0, 0.5, 0.9):
            for length in (100, 1000, 10000):
                if length < 200 and share > 0.8:
                    continue  # five times its memory
                values, time = remembering(share, length), (1 + share) / (1 - share)
                found = series.autocorrelation_time(values)
                accuracy = 0.03 + 12 / length + 0.1 * time / np.sqrt(length)
                self.assertAlmostEqual(np.nanmean(found) / time, 1, delta=accuracy)
                self.assertLess(np.isnan(found).mean(), 0.06)
                np.testing.assert_allclose(series.effective_samples(values), length / found)
                errors = series.standard_error(values)
                stated = np.sqrt(np.nanmean(errors**2)) / error_of_mean(share, length)
                self.assertAlmostEqual(stated, 1, delta=accuracy)

    def test_unknown(self):
        """Of what is constant, and of what is shorter than what it remembers."""
        self.assertTrue(np.isnan(series.autocorrelation(np.full(20, 3.0))).all())
        self.assertTrue(np.isnan(series.autocorrelation_time([1.0] * 20)))
        self.assertTrue(np.isnan(series.standard_error(np.arange(100.0))))
        found = series.autocorrelation_time(remembering(0.9, 40))
        self.assertGreater(np.isnan(found).mean(), 0.8)
        self.assertEqual(np.shape(series.autocorrelation_time([1.0, 2.0, 1.5])), ())

    def test_lengths(self):
        """Samples of a white rate: those of longer times fluctuate less, and count more."""
        random = np.random.default_rng(2)
        lengths = random.uniform(0.5, 4, 400)
        values = random.normal(size=(400, RUNS)) / np.sqrt(lengths)[:, None]
        errors, expected = series.standard_error(values, lengths), 1 / np.sqrt(lengths.sum())
        self.assertAlmostEqual(np.sqrt(np.mean(errors**2)) / expected, 1, delta=0.03)
        same, twice = values[:, 0], np.repeat(values[:, 0], 2)
        np.testing.assert_allclose(
            series.block_errors(same, np.full(400, 2.0)).errors, series.block_errors(same).errors
        )
        np.testing.assert_allclose(
            series.block_errors(twice, np.full(800, 0.5)).errors[1:],
            series.block_errors(same).errors,
        )

    def test_blocks(self):
        values = remembering(0.9, 4096)
        found = series.block_errors(values)
        np.testing.assert_array_equal(found.lengths, 2.0 ** np.arange(10))
        means = values.reshape(64, 64, RUNS).mean(axis=1)
        np.testing.assert_allclose(found.errors[6], means.std(axis=0, ddof=1) / 8)
        np.testing.assert_allclose(found.uncertainties[6], found.errors[6] / np.sqrt(126))
        of_all = np.sqrt((found.errors**2).mean(axis=1)) / error_of_mean(0.9, 4096)
        self.assertAlmostEqual(of_all[0] * np.sqrt(19), 1, delta=0.02)  # as if independent
        np.testing.assert_allclose(of_all[8:], 1, atol=0.06)
        scatter = (found.errors[8] / error_of_mean(0.9, 4096)).std()
        self.assertAlmostEqual(scatter * np.sqrt(30), 1, delta=0.15)  # of 16 blocks
        uneven = series.block_errors(values[:4000, 0])  # what is left over does not count
        self.assertEqual(uneven.lengths[-1], 256)
        left = values[: 15 * 256, 0].reshape(15, 256).mean(axis=1)
        self.assertAlmostEqual(uneven.errors[-1], left.std(ddof=1) / np.sqrt(15))
        self.assertEqual(len(series.block_errors([1.0, 2.0, 3.0]).errors), 0)

    def test_refused(self):
        for values, lengths, said in (
            (3.0, None, r'values of shape \(\): there must be 2 samples'),
            ([3.0], None, r'values of shape \(1,\)'),
            ([1.0, np.nan], None, r'values: nan at \[1\]: must be finite'),
            ([1.0, 2.0], [1.0], 'lengths: must be 2 numbers above 0'),
            ([1.0, 2.0], [1.0, 0.0], 'lengths: must be 2 numbers above 0'),
        ):
            for function in (series.standard_error, series.block_errors):
                with self.assertRaisesRegex(ValueError, said):
                    function(values, lengths)


class Bag(bags.Bags):
    def recorded_run(self):
        """lambda_max of 400 reports that remember 3 of them, and the error that a node would
        state."""
        samples = 9 + 0.1 * remembering(0.5, 400)[:, 0]
        error = 0.1 * error_of_mean(0.5, 400)
        spectra = [made.spectrum([x], t, error=error) for t, x in enumerate(samples, start=1)]
        for one in spectra:
            one.local_time, one.local_exponents = 1.0, one.exponents
        return hdlyap.load(self.write([made.run_info(), *spectra])), samples

    def test_three_lines(self):
        run, samples = self.recorded_run()
        x, lengths = run.local.exponents[:, 0], run.local.lengths
        np.testing.assert_array_equal(x, samples)
        error, stated = series.standard_error(x, lengths), run.std_errors[-1, 0]
        self.assertAlmostEqual(error / stated, 1, delta=0.25)

    def test_figure(self):
        """Errors by blocks, both lines; in axes of the user's, in their colour."""
        run, samples = self.recorded_run()
        page = blocks.draw(samples, run.local.lengths, stated=0.0123, c='#123456')
        (axes,) = page.axes
        found = series.block_errors(samples)
        points, caps = axes.containers[0].lines[0], axes.containers[0].lines[2][0]
        np.testing.assert_allclose(points.get_xydata(), np.transpose(found[:2]))
        self.assertEqual(points.get_color(), '#123456')
        ends = np.array([segment[:, 1] for segment in caps.get_segments()])
        np.testing.assert_allclose(ends[:, 1] - ends[:, 0], 2 * found.uncertainties)
        lines = {line.get_label(): line.get_ydata()[0] for line in axes.lines}
        self.assertEqual(lines['stated'], 0.0123)
        self.assertEqual(lines['by the autocorrelation time'], series.standard_error(samples))
        self.assertIn('[time units]', axes.get_xlabel())
        again = blocks.draw(samples, ax=axes)
        self.assertIs(again.figure, page.figure)
        self.assertEqual(axes.get_xlabel(), 'samples in a block')
