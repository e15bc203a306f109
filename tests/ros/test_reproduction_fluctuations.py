"""Part 19 of the reproduction: local exponents that fluctuate as is known."""
# Second tier: tests/run.sh --all

import unittest

import numpy as np

import made
import recorded
from made import LP, T
import reproduced
from study import growth
from study.parts import fluctuations, smallest

SHAPES = {
    'aspect_025_periodic': (99, 0.25),
    'aspect_050_periodic': (197, 0.5),
    'aspect_075_periodic': (296, 0.75),
    'aspect_100_periodic': (395, 1.0),
    **{smallest.run_of('periodic', box): shape for box, shape in recorded.BOXES.items()},
}
SAMPLES = 120


def white(time, spread, rng, columns=30):
    """Independent: variance times t is the spread."""
    return 2 + np.sqrt(np.asarray(spread) / np.asarray(time)[:, None]) * rng.normal(
        size=(len(time), columns)
    )


def lengths(rng, count=SAMPLES):
    return np.repeat([5.0, 10.0], [count // 2, count - count // 2]) * rng.uniform(0.9, 1.1, count)


class Growth(unittest.TestCase):
    def test_spread(self):
        """Of samples of different lengths, each index by itself."""
        rng = np.random.default_rng(1)
        time, spread = lengths(rng, 4000), np.array([0.3, 0.02, 1e-4])
        found, error = growth.Growth(time, white(time, spread, rng, 3), 1).spread()
        self.assertLess(np.abs(found / spread - 1).max(), 4 * 0.0224)
        np.testing.assert_allclose(error / found, 0.0224, atol=1e-4)  # sqrt(2 / 4000)

    def test_means_and_their_errors(self):
        """Neither is too small with few samples."""
        rng = np.random.default_rng(2)
        trials = []
        for _ in range(300):
            time = lengths(rng, 16)
            trials.append(growth.Growth(time, white(time, 0.5, rng, 4), 7).of([7, 8, 9, 10]))
        values, errors = np.array(trials).T
        self.assertAlmostEqual(values.mean(), 0.5, delta=0.02)
        self.assertAlmostEqual(np.sqrt(np.mean(errors**2)) / values.std(), 1, delta=0.12)

    def test_only_the_indices_asked_for(self):
        rng = np.random.default_rng(3)
        time, spread = lengths(rng), np.where(np.arange(30) < 3, 1.0, 1e-6)
        found = growth.Growth(time, white(time, spread, rng), 11)
        self.assertGreater(found.of([11, 12, 13])[0], 0.5)
        self.assertLess(found.of([14, 15])[0], 1e-5)

    def test_joined(self):
        """The growth over both is their mean by time."""
        time, local = [1.0, 3.0, 2.0, 2.0, 2.0], [[4.0], [0.0], [1.0], [3.0], [9.0]]
        found = growth.Growth(time, local, 1).joined(2)
        np.testing.assert_allclose(found.time, [4, 4])
        np.testing.assert_allclose(found.local[:, 0], [1, 2])

    def test_memory(self):
        rng = np.random.default_rng(4)
        noise = rng.normal(size=(6001, 2))
        for share, correlation, twice in ((0.0, 0.0, 1.0), (1.0, 0.5, 1.5), (-1.0, -0.5, 0.5)):
            found = growth.Growth(np.ones(6000), noise[1:] + share * noise[:-1], 1)
            memory, error = found.memory([1, 2])
            self.assertAlmostEqual(memory, correlation, delta=5 * 0.01)
            self.assertAlmostEqual(error, 0.01, delta=0.006)
            ratio = found.joined(2).of([1, 2])[0] / found.of([1, 2])[0]
            self.assertAlmostEqual(ratio, twice, delta=0.1)

    def test_short_samples_are_left_out(self):
        found = growth.Growth([10.0, 10.0, 10.0, 1.0], [[1.0], [1.0], [1.0], [50.0]], 1)
        self.assertEqual(found.samples, 3)

    def test_messages_that_do_not_tell(self):
        spectra = [made.spectrum([2.0, 1.0], t) for t in range(1, 41)]
        bag = recorded.Bag(None, spectra)
        self.assertEqual(growth.read(bag).samples, 40)
        for message in spectra[::2]:
            message.local_time = 0.0  # nothing new in it
        self.assertEqual(growth.read(bag).samples, 20)
        for message in spectra[::4]:
            message.local_time = 1.0
        self.assertEqual(growth.read(recorded.Bag(None, spectra[:10])), None)
        for message in spectra:
            message.local_time = 0.0
        self.assertEqual(growth.read(bag), None)


def run(name, rng, spread, samples=SAMPLES, mixed=False):
    """spread: {group: variance times t} for a hundred disks, falling as 1 / N."""
    disks, aspect = SHAPES[name]
    info = recorded.info(disks, 0.4, aspect)
    half = (4 * disks - 6) // 2
    square = [made.step(info, T, 0, 1, half - 3, half - 2)] if aspect == 1 else []
    found = [
        made.step(info, T, 1, 0, half - 1, half),
        *square,
        made.step(info, LP, 1, 0, half - 9, half - 6),
        made.step(info, T, 1, 1, half - 19, half - 16),
    ]
    if mixed:
        found[-2].set = found[0].set
    values = np.full(half, spread[growth.MIDDLE])
    values[0] = spread[growth.LARGEST]
    for step, group in ((found[0], growth.LAST_T), (found[-2], growth.LAST_LP)):
        values[step.first_index - 1 : step.last_index] = spread[group]
    for step in square:
        values[step.first_index - 1 : step.last_index] = spread[growth.LAST_T]
    time = lengths(rng, samples)
    local = white(time, values * 100 / disks, rng, half)
    spectra = [made.spectrum(list(one), end) for one, end in zip(local, np.cumsum(time))]
    for message, length in zip(spectra, time):
        message.local_time = length
    recording = recorded.Recorded(info, made.steps(found), spectra[-1] if spectra else None)
    return recorded.Bag(recording, spectra)


SPREAD = {growth.LARGEST: 0.2, growth.MIDDLE: 0.01, growth.LAST_T: 4e-4, growth.LAST_LP: 3e-3}


def bags(**options):
    rng = np.random.default_rng(5)
    return {name: run(name, rng, SPREAD, **options) for name in SHAPES}


class Fluctuations(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bags = bags()
        cls.rows = recorded.by_quantity(fluctuations, cls.bags)

    def test_the_runs_are_those_of_the_plan(self):
        self.assertEqual(sorted(SHAPES), sorted(reproduced.part_of(fluctuations).runs))

    def test_against_the_number_of_disks(self):
        for group in growth.GROUPS:
            row = self.rows[f'p of {group}']
            self.assertAlmostEqual(row.measured, 1, delta=4 * row.error)
            self.assertEqual(row.verdict, '')
            boxes = 4 if 'smallest' in group else 10
            self.assertTrue(row.remark.startswith(f'{boxes} boxes, '))
        self.assertLess(self.rows['p of bulk'].error, 0.02)

    def test_whose_they_are(self):
        """Nothing of other indices, in a square box x and y together."""
        for name in ('aspect_025_periodic', 'aspect_100_periodic'):
            box = fluctuations.Box(name, self.bags[name])
            for group, spread in SPREAD.items():
                value, error, length, samples = box.spread(group)
                expected = spread * 100 / box.disks
                self.assertAlmostEqual(value, expected, delta=5 * error)
                self.assertEqual(samples, SAMPLES)
                self.assertAlmostEqual(length, 7.5, delta=0.3)
            count = 4 if box.aspect == 1 else 2
            self.assertEqual(len(box.indices[growth.LAST_T]), count)
            self.assertEqual(len(box.indices[growth.LAST_LP]), 4)

    def test_independent_samples(self):
        row = self.rows['2 samples joined, bulk']
        self.assertAlmostEqual(row.measured, 1, delta=4 * row.error)
        self.assertLess(row.error, 0.02)
        self.assertRegex(row.remark, r'^10 boxes; correlation of neighbouring samples -?0\.0')

    def test_steps_that_share_vectors_are_none(self):
        rows = recorded.by_quantity(fluctuations, bags(mixed=True))
        self.assertEqual(rows['p of smallest T'].measured, None)
        self.assertEqual(rows['p of smallest LP'].measured, None)
        self.assertIsNotNone(rows['p of bulk'].measured)

    def test_too_few_samples(self):
        found = bags(samples=12)
        self.assertEqual({row.measured for row in recorded.rows(fluctuations, found)}, {None})
        self.assertEqual(recorded.pictures(self, fluctuations, found), [])
        ((_, _, lines),) = fluctuations.tables(found)
        self.assertEqual(lines, [])

    def test_nothing_measured(self):
        found = {
            name: recorded.Bag(recorded.Recorded(bag.recording.info))
            for name, bag in self.bags.items()
        }
        self.assertEqual(
            {row.verdict for row in recorded.rows(fluctuations, found)}, {'not measured'}
        )
        self.assertEqual(recorded.pictures(self, fluctuations, found), [])

    def test_figure_and_tables(self):
        self.assertEqual(recorded.pictures(self, fluctuations, self.bags), ['fluctuations'])
        (_, header, lines), (_, columns, indices) = fluctuations.tables(self.bags)
        line = dict(zip(header, lines[4]))
        self.assertEqual(
            (line['run'], line['exponents'], line['joined'], line['samples']),
            ('aspect_025_periodic', 'bulk', 2, SAMPLES // 2),
        )
        self.assertAlmostEqual(float(line['var_t']), 0.01 * 100 / 99, delta=0.001)
        self.assertEqual(len(indices), (4 * 780 - 6) // 2)
        first = dict(zip(columns, indices[0]))
        self.assertEqual(first['index'], 1)
        value, error = float(first['var_t']), float(first['error'])
        self.assertAlmostEqual(value, 0.2 * 100 / 780, delta=4 * error)


if __name__ == '__main__':
    unittest.main()
