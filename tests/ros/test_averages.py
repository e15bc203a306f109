"""~gas, ~localization and fields of single vectors: against the other topics of the run, against
kinetic theory, and against the vectors themselves."""

import math

import numpy as np

import harness
from hdlyap.msg import Mode
from hdlyap.plots import equation

pytestmark = harness.UNDER_A_MASTER

BOX = dict(
    number=60, density=0.4, aspect=0.5, equilibration=20.0, threads=1, wait_for_subscribers='all'
)
CHOSEN = [117, 1, 2, 5, 40]
HALVES = 'dqx', 'dqy', 'dpx', 'dpy'


def run_of(**params):
    topics = ['run_info', 'status', 'cost', *params['observables']]
    return harness.whole_run(dict(BOX, **params), topics)


def exact_impact(disks, free):
    """Mean |p.n| of a collision: of `free` momenta that are uniform on a sphere."""
    gammas = math.exp(math.lgamma((free + 1) / 2) - math.lgamma(free / 2))
    return math.sqrt(4 * math.pi * disks) / free * gammas


class Gas(harness.Case):
    def check_gas(self, messages, free, area):
        """What each of them says fits together; the last one has errors."""
        disks = BOX['number']
        for message in messages:
            self.assertAlmostEqual(
                message.pressure, (message.pressure_x + message.pressure_y) / 2, places=12
            )
            self.assertAlmostEqual(message.compressibility, message.pressure * area / disks)
        last = messages[-1]
        for name in ('collision_rate', 'pressure', 'pressure_x', 'pressure_y'):
            error = getattr(last, name + '_error')
            self.assertTrue(0 < error < 0.05 * getattr(last, name), name)
        self.assertEqual(messages[0].pressure_error, -1)
        virial = 4 * (last.compressibility - 1)  # 2 W / (N t), as compressibility - 1 is W / 2 N t
        ratio = virial / (exact_impact(disks, free) * last.collision_rate)
        error = last.pressure_error / (last.pressure - disks / area)
        self.assertAlmostEqual(ratio, 1, delta=3 * error)
        return last


class BetweenWalls(Gas):
    def test_pressure(self):
        """Whose pressure differs from that of the others; without exponents."""
        messages = run_of(
            boundary_y='reflecting',
            exponents='none',
            observables=['gas', 'state'],
            warmup=0.0,
            duration=1500.0,
            report_interval=50.0,
        )
        info = messages['run_info'][-1]
        last = self.check_gas(messages['gas'], 2 * 60 - 1, info.box_x * (info.box_y - 1))
        self.assertGreater(last.pressure, 0.4 * equation.compressibility(0.4))
        reports = [message.sim_time for message in messages['state']][-30:]
        self.assertEqual([message.sim_time for message in messages['gas']], reports)
        for message in messages['gas']:
            self.assertAlmostEqual(message.averaged_time, message.sim_time - 20, places=9)


def width(field):
    """Of a published vector, by its disks."""
    parts = sum(np.square(getattr(field, name)) for name in HALVES)
    parts = parts[parts > 0]
    return np.exp(-(parts * np.log(parts)).sum()) / len(field.x)


class BesideExponents(Gas):
    """One run, with all of it."""

    @classmethod
    def setUpClass(cls):
        cls.messages = run_of(
            observables=['spectrum', 'gas', 'localization', 'fluctuations', 'fields'],
            fluctuation_time=1.0,
            field_indices=CHOSEN,
            field_interval=0.0,
            warmup=20.0,
            duration=150.0,
            report_interval=1.0,
        )
        cls.info = cls.messages['run_info'][-1]

    def test_gas(self):
        """Over the same time as these; its collisions are those that they are told with."""
        gas, spectra = self.messages['gas'], self.messages['spectrum']
        self.assertGreater(len(gas), 100)
        self.assertEqual(
            [(m.sim_time, m.averaged_time) for m in gas],
            [(m.sim_time, m.averaged_time) for m in spectra],
        )
        counted = [m.collision_rate * m.averaged_time * 60 / 2 for m in gas]
        for number, spectrum in zip(counted, spectra):
            self.assertAlmostEqual(
                number - counted[0], spectrum.collisions - spectra[0].collisions, places=6
            )
        last = self.check_gas(gas, 2 * 60 - 2, self.info.box_x * self.info.box_y)
        z, error = last.compressibility, last.pressure_error / last.pressure * last.compressibility
        allowed = 0.01 + (z - 1) / 60  # of Henderson's equation, and of so few disks
        self.assertAlmostEqual(z, equation.compressibility(0.4), delta=3 * error + allowed)

    def test_fields_of_single_vectors(self):
        """In the order in which they are asked for, with every report."""
        fields, spectra = self.messages['fields'], self.messages['spectrum']
        self.assertEqual(self.info.field_indices, str(CHOSEN))
        self.assertEqual([field.index for field in fields], len(spectra) * CHOSEN)
        exponents = {message.sim_time: message.exponents for message in spectra}
        for field in fields:
            self.assertEqual(field.exponent, exponents[field.sim_time][field.index - 1])
            norm = sum(np.square(getattr(field, name)).sum() for name in HALVES)
            self.assertAlmostEqual(norm, 1.0, delta=1e-5)
            if field.index == 1:
                self.assertEqual((field.kind, field.pairs), (Mode.NONE, 0))

    def test_widths_are_those_of_the_vectors(self):
        """Fields end a sample at each report, so that both are of the same time."""
        told = {message.sim_time: message for message in self.messages['localization']}
        self.assertEqual(len(told), len(self.messages['spectrum']))
        for field in self.messages['fields']:
            message = told[field.sim_time]
            self.assertAlmostEqual(message.widths_now[field.index - 1], width(field), places=9)
        last = self.messages['localization'][-1]
        self.assertEqual((last.first_index, len(last.widths)), (1, 117))
        self.assertTrue(all(1 / 60 <= one <= 1 for one in last.widths))
        self.assertLess(last.widths[0], 0.7 * last.widths[-1])
        self.assertTrue(all(one == -1 or 0 < one < 0.2 for one in last.std_errors))
        self.assertGreater(np.mean(np.array(last.std_errors) > 0), 0.5)

    def test_growth_is_that_of_the_exponents(self):
        """A sample ends with each report, once in a time unit: here times are reports."""
        spectra = self.messages['spectrum']
        dt = np.array([message.local_time for message in spectra])
        growth = np.array([message.local_exponents for message in spectra]) * dt[:, np.newaxis]
        message, count = self.messages['fluctuations'][-1], len(growth)
        self.assertEqual((message.sim_time, message.first_index), (spectra[-1].sim_time, 1))
        self.assertEqual(message.averaged_time, spectra[-1].averaged_time)
        variances = np.reshape(message.variances, (len(message.orders), -1))
        for number, order in enumerate(message.orders):
            self.assertEqual(order.count, len(growth))
            self.assertAlmostEqual(order.time, dt.mean(), places=9)
            rates = growth.sum(axis=0) / dt.sum()
            off = (growth - np.outer(dt, rates)) ** 2 / dt[:, np.newaxis]
            expected = off.sum(axis=0) / (len(growth) - 1)
            np.testing.assert_allclose(variances[number], expected, rtol=1e-6, atol=1e-9)
            violated = np.mean(growth[:, :-1] < growth[:, 1:], axis=0)
            np.testing.assert_allclose(order.violations, violated, atol=1e-12)
            before = np.minimum.accumulate(growth, axis=1)[:, :-1]
            behind = np.maximum.accumulate(growth[:, ::-1], axis=1)[:, ::-1][:, 1:]
            entangled = np.mean(before < behind, axis=0)
            np.testing.assert_allclose(order.domination_violations, entangled, atol=1e-12)
            even = len(growth) // 2 * 2
            growth, dt = growth[:even:2] + growth[1:even:2], dt[:even:2] + dt[1:even:2]
        self.assertEqual((count, len(message.orders)), (150, 7))
        unknown = np.isnan(message.diffusions)
        np.testing.assert_array_equal(np.array(message.std_errors) == -1, unknown)
        self.assertEqual((len(message.steps), len(message.covariances)), (0, 0))

    def test_widths_are_means_of_samples(self):
        """Of their logarithms."""
        checked = 0
        messages = self.messages['localization']
        for before, now in zip(messages, messages[1:]):
            if now.samples == before.samples + 1:
                added = np.log(now.widths) * now.samples
                added -= np.log(before.widths) * before.samples
                np.testing.assert_allclose(added, np.log(now.widths_now), atol=1e-9 * now.samples)
                checked += 1
        self.assertGreater(checked, 20)
