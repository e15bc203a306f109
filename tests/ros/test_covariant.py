"""What a run says of its covariant vectors: window by window, right, and only to those who
listen."""

import math
import os

import harness
from harness import is_last
from hdlyap.msg import CovariantAngle, Mode
from std_srvs.srv import Trigger

pytestmark = harness.UNDER_A_MASTER

START, WINDOW, TRANSIENT, SAMPLING, DURATION = 30.0, 5.0, 20.0, 1.0, 200.0
SCENE = dict(
    number=16,
    density=0.7,
    aspect=0.866,
    exponents='all',
    equilibration=10.0,
    warmup=20.0,
    duration=DURATION,
    interval=0.5,
    covariant_window=WINDOW,
    covariant_transient=TRANSIENT,
    covariant_sampling=SAMPLING,
    observables=['spectrum', 'covariant'],
    wait_for_subscribers=['covariant'],
)
WINDOWS = round((DURATION - TRANSIENT) / WINDOW)  # the last one is complete when the run ends
LOOKS = round(WINDOW / SAMPLING)
N, VECTORS, POSITIVE, CENTRE = 16, 64, 29, 6
OF_VECTORS = ('exponents', 'std_errors', 'local_exponents', 'start_mismatch', 'widths', 'cos_theta')
OF_NEIGHBOURS = (
    'neighbour_angles',
    'least_neighbour_angles',
    'violations',
    'domination_violations',
)
RIGHT = math.pi / 2
CONVERGED = 1e-8  # beyond what a transient of 20 leaves of the least rate, 2.2
ROUNDING = 1e-9


class Case(harness.Case):
    def run_of(self, **params):
        """Messages of covariant vectors of a run that ends by itself."""
        params = dict(SCENE, **params)
        return harness.whole_run(params, ['covariant'])['covariant']


class Windows(harness.Case):
    """Of one run with all 4N vectors."""

    @classmethod
    def setUpClass(cls):
        topics = ('run_info', 'spectrum', 'covariant', 'cost')
        messages = harness.whole_run(dict(SCENE, wait_for_subscribers=list(topics)), topics)
        cls.info = messages['run_info'][0]
        cls.spectrum = messages['spectrum'][-1]
        cls.cost, cls.status = messages['cost'][-1], messages['status'][-1]
        cls.messages = messages['covariant']
        cls.last = cls.messages[-1]

    def test_one_for_each_window(self):
        self.assertEqual([m.windows for m in self.messages], list(range(1, WINDOWS + 1)))
        for message in self.messages:
            self.assertEqual(message.run_id, self.info.run_id)
            self.assertAlmostEqual(
                message.sim_time, START + message.windows * WINDOW, delta=ROUNDING
            )
            self.assertAlmostEqual(message.averaged_time, message.windows * WINDOW, delta=ROUNDING)
            self.assertEqual(message.samples, message.windows * LOOKS)
            self.assertEqual(message.lost_windows, 0)

    def test_last_one_comes_before_the_last_cost(self):
        self.assertTrue(is_last(self.status))
        self.assertLess(self.last.header.stamp, self.cost.header.stamp)
        self.assertEqual(self.last.sim_time + TRANSIENT, self.cost.sim_time)
        self.assertGreater(self.last.seconds, 0.0)
        self.assertLessEqual(self.last.seconds, self.cost.covariant_seconds)
        self.assertLess(self.cost.covariant_seconds, self.cost.wall_seconds)

    def test_lengths(self):
        for message in self.messages:
            self.assertEqual(message.first_index, 1)
            self.assertEqual({len(getattr(message, name)) for name in OF_VECTORS}, {VECTORS})
            self.assertEqual({len(getattr(message, name)) for name in OF_NEIGHBOURS}, {VECTORS - 1})

    def test_exponents_are_those_of_the_way_there(self):
        """Averages over nearly the same time of nearly the same fluctuations: five errors are
        beyond chance. Vanishing ones fall like ln(t) / t, which is no matter of chance."""
        last = self.last
        for k, (back, there) in enumerate(zip(last.exponents, self.spectrum.exponents)):
            if POSITIVE <= k < POSITIVE + CENTRE:
                self.assertLess(abs(back - there), 2 * math.log(DURATION) / DURATION, k + 1)
                continue
            errors = last.std_errors[k], self.spectrum.std_errors[k]
            self.assertGreater(min(errors), 0.0)
            self.assertLess(abs(back - there), 5 * math.hypot(*errors), k + 1)
        self.assertGreater(last.exponents[0], 4.5)

    def test_errors_are_known_with_sixteen_looks(self):
        """But for those that vanish: they are no means of a series."""
        for message in self.messages:
            judged = message.std_errors[:POSITIVE] + message.std_errors[POSITIVE + CENTRE :]
            self.assertEqual(min(judged) >= 0.0, message.samples >= 16)
            self.assertTrue(message.samples >= 16 or set(message.std_errors) == {-1.0})

    def test_local_exponents_fluctuate(self):
        mean = sum(m.local_exponents[0] for m in self.messages) / WINDOWS
        self.assertGreater(len({m.local_exponents[0] for m in self.messages}), WINDOWS - 2)
        self.assertLess(abs(mean - self.last.exponents[0]), 1.0)
        self.assertTrue(all(m.local_exponents[0] != m.exponents[0] for m in self.messages))

    def test_two_starts_have_met(self):
        """Spaces do; single vectors only where exponents are apart."""
        for message in self.messages:
            self.assertLess(
                max(message.centre_start_mismatch, message.stable_start_mismatch), CONVERGED
            )
            self.assertGreaterEqual(
                min(message.centre_start_mismatch, message.stable_start_mismatch), 0.0
            )
            self.assertLess(message.start_mismatch[0], CONVERGED)
            self.assertLessEqual(max(message.start_mismatch), 1.0 + ROUNDING)

    def test_centre_is_the_null_space(self):
        for message in self.messages:
            self.assertGreater(message.null_angle, 0.0)
            self.assertLess(message.largest_null_angle, CONVERGED)
            self.assertLessEqual(message.null_angle, message.largest_null_angle)
        largest = [message.largest_null_angle for message in self.messages]
        self.assertEqual(largest, sorted(largest))

    def test_angles(self):
        pairs = {
            CovariantAngle.UNSTABLE_STABLE: POSITIVE,
            CovariantAngle.UNSTABLE_CENTRE: CENTRE,
            CovariantAngle.CENTRE_STABLE: CENTRE,
        }
        for message in self.messages:
            self.assertEqual([angle.spaces for angle in message.angles], sorted(pairs))
            for angle in message.angles:
                self.assertEqual(
                    (sum(angle.smallest_counts), sum(angle.all_counts)),
                    (message.samples, message.samples * pairs[angle.spaces]),
                )
                self.assertEqual((len(angle.smallest_counts), len(angle.all_counts)), (90, 90))
                self.check_angle(angle)
        unstable_stable, *of_centre = self.last.angles
        self.assertLess(unstable_stable.mean, 1.0)
        self.assertLess(
            unstable_stable.mean, 0.9 * unstable_stable.mean_of_all
        )  # one of 29, and the smallest
        last = [message.angles[0].last for message in self.messages]
        self.assertEqual(
            [
                m.angles[0].smallest_counts[int(90 * a / RIGHT)] > 0
                for m, a in zip(self.messages, last)
            ],
            [True] * WINDOWS,
        )
        self.assertFalse(set(last) & {message.angles[0].mean for message in self.messages})
        for angle in of_centre:
            self.assertAlmostEqual(angle.least, RIGHT, delta=1e-6)

    def check_angle(self, angle):
        self.assertLess(0.0, angle.least)
        self.assertLessEqual(angle.least, min(angle.mean, angle.last) + ROUNDING)
        self.assertLessEqual(max(angle.mean, angle.last), angle.mean_of_all + RIGHT)
        self.assertLessEqual(angle.mean, angle.mean_of_all + ROUNDING)
        self.assertLessEqual(angle.mean_of_all, RIGHT + ROUNDING)
        first = next(k for k, count in enumerate(angle.smallest_counts) if count)
        self.assertEqual(first, min(89, int(90 * angle.least / RIGHT)))

    def test_neighbours(self):
        last = self.last
        for least, mean in zip(last.least_neighbour_angles, last.neighbour_angles):
            self.assertLess(0.0, least)
            self.assertLessEqual(least, mean + ROUNDING)
            self.assertLessEqual(mean, RIGHT + ROUNDING)
        for violated, of_any in zip(last.violations, last.domination_violations):
            self.assertLessEqual(0.0, violated)
            self.assertLessEqual(violated, of_any)
            self.assertLessEqual(of_any, 1.0 + ROUNDING)
        self.assertNotEqual(last.violations, last.domination_violations)
        self.assertNotEqual(last.least_neighbour_angles, last.neighbour_angles)

    def test_shapes(self):
        for width, cosine in zip(self.last.widths, self.last.cos_theta):
            self.assertTrue(
                1 / N <= width <= 1.0 and 0.0 <= cosine <= 1.0 + ROUNDING, (width, cosine)
            )
        # localised ones at the ends, extended ones between
        self.assertLess(self.last.widths[0], self.last.widths[POSITIVE - 1])

    def test_weights(self):
        waves = sorted(zip(self.info.wave_nx, self.info.wave_ny))
        for message in self.messages:
            for kind in (Mode.T, Mode.LP):
                self.assertEqual(
                    sorted((w.nx, w.ny) for w in message.weights if w.kind == kind), waves
                )
            order = [(weight.wave_number, weight.kind) for weight in message.weights]
            self.assertEqual(order, sorted(order))
            for weight in message.weights:
                for weights in (weight.dq, weight.dp, weight.gram_schmidt):
                    self.assertEqual(len(weights), VECTORS)
                    self.assertGreaterEqual(min(weights), 0.0)
                    self.assertLessEqual(max(weights), 1.0 + ROUNDING)
                # the first covariant vector is the first of the frame
                self.assertAlmostEqual(weight.dq[0], weight.gram_schmidt[0], delta=ROUNDING)
        for weight in self.last.weights:
            both = weight.nx > 0 and weight.ny > 0
            self.assertEqual(
                weight.dimension, (4 if both else 2) * (1 if weight.kind == Mode.T else 2)
            )
            k = 2 * math.pi * math.hypot(weight.nx / self.info.box_x, weight.ny / self.info.box_y)
            self.assertAlmostEqual(weight.wave_number, k, delta=ROUNDING)
            self.assertNotEqual(weight.dq, weight.dp)  # dp = C dq does not hold


class Choices(Case):
    def test_positive_ones(self):
        for exponents, vectors in (('positive', POSITIVE), (POSITIVE + CENTRE,) * 2):
            message = self.run_of(exponents=exponents, duration=40.0)[-1]
            self.assertEqual(message.windows, 4)
            self.assertEqual({len(getattr(message, name)) for name in OF_VECTORS}, {vectors})
            self.assertEqual({len(getattr(message, name)) for name in OF_NEIGHBOURS}, {vectors - 1})
            self.assertEqual({len(weight.dq) for weight in message.weights}, {vectors})
            self.assertEqual((message.angles, message.stable_start_mismatch), ([], -1.0))
            self.assertEqual(message.null_angle < 0.0, vectors <= POSITIVE)
            self.assertEqual(message.centre_start_mismatch < 0.0, vectors <= POSITIVE)
            self.assertLess(message.largest_null_angle, CONVERGED)

    def test_with_modes(self):
        """Both kinds of vectors of one run."""
        topics = ['run_info', 'modes', 'steps', 'hydro', 'covariant']
        params = dict(SCENE, duration=40.0, observables=topics[1:], wait_for_subscribers=topics)
        heard = harness.whole_run(params, topics)
        message = heard['covariant'][-1]
        self.assertEqual((message.windows, len(message.angles)), (4, 3))
        self.assertEqual(heard['run_info'][0].observables, topics[1:])
        found = heard['steps'][-1].steps
        self.assertEqual(
            [(s.kind, s.nx, s.ny) for s in found if s.kind != Mode.ZERO and not s.conjugate],
            [(weight.kind, weight.nx, weight.ny) for weight in message.weights],
        )

    def test_goes_on_from_a_checkpoint(self):
        """With the averages of its windows, what was observed and the parameters; windows may have
        another memory."""
        path = os.path.join(self.new_folder(), 'run.checkpoint')
        first = self.run_of(duration=60.0, checkpoint=path)
        topics = ['covariant', 'run_info']
        params = dict(resume=path, duration=100.0, covariant_memory=1.0)
        heard = harness.whole_run(dict(params, wait_for_subscribers=topics), topics)
        second, info = heard['covariant'], heard['run_info'][0]
        self.assertEqual([message.windows for message in first + second], list(range(1, 13)))
        self.assertAlmostEqual(second[0].sim_time, START + 60.0 + WINDOW, delta=ROUNDING)
        self.assertEqual(second[0].samples, 9 * LOOKS)
        self.assertEqual(
            (info.observables, info.covariant_window, info.covariant_memory),
            (['spectrum', 'covariant', 'state'], WINDOW, 1.0),
        )


class Demand(Case):
    def test_nobody(self):
        cost = self.listen('cost')
        calls = harness.counts(self, dict(SCENE, wait_for_subscribers=['cost']))
        self.assertEqual({message.covariant_seconds for message in cost.messages}, {0.0})
        self.assertEqual((calls['covariant_publish'], calls['modes_measure']), (0, 0))

    def test_somebody(self):
        self.listen('covariant')
        calls = harness.counts(self, SCENE)
        self.assertEqual(
            (calls['covariant_publish'], calls['modes_measure']), (WINDOWS, 3 * WINDOWS * LOOKS)
        )

    @harness.SECOND_TIER
    def test_who_comes_late_and_goes(self):
        """Is told of windows that began when he was there, and paid for until he goes."""
        cost = self.listen('cost')
        self.start(dict(SCENE, duration=0.0, pace=200.0, wait_for_subscribers=['cost']))
        self.assertTrue(cost.wait_for(lambda message: message.sim_time >= 60))
        came = cost.messages[-1].sim_time
        covariant = self.listen('covariant')
        self.assertTrue(covariant.wait_for(lambda message: message.windows == 3))
        covariant.close()
        self.assertEqual([message.windows for message in covariant.messages[:3]], [1, 2, 3])
        self.assertGreaterEqual(covariant.messages[0].sim_time, came + WINDOW - SAMPLING)
        now = cost.messages[-1].sim_time
        self.assertTrue(cost.wait_for(lambda message: message.sim_time > now + 20))
        spent = cost.messages[-1].covariant_seconds
        self.assertGreater(spent, 0.0)
        self.assertTrue(cost.wait_for(lambda message: message.sim_time > now + 60))
        self.assertEqual(cost.messages[-1].covariant_seconds, spent)


class Faults(Case):
    def test_no_room_beforehand(self):
        """Of orthonormalisations at each report, or as often as fields are due, which the core does
        not know."""
        params = dict(SCENE, interval='auto', covariant_memory=0.002, report_interval=0.05)
        said = (
            'covariant_window = 5 ',
            ' triangles and ',
            'must be at most covariant_memory = 0.002',
        )
        for name, how in (('hydro', {}), ('fields', dict(field_interval=0.0))):
            asked = dict(params, observables=['covariant', name], wait_for_subscribers=[], **how)
            node = self.start(asked)
            self.ends(node, 2, *said, 'at most 0.05 time units apart')
            self.assertEqual(len(node.text().splitlines()), 1, node.text())

    def test_no_room(self):
        """Triangles of every interval need more than there is: windows are left out, as is said,
        and the run goes on; also after a reset, and when it is resumed."""
        kept = os.path.join(self.new_folder(), 'kept')
        params = dict(SCENE, exponents='all_independent', interval='auto', accuracy=1e-12)
        params.update(covariant_window=50.0, covariant_memory=0.01, checkpoint=kept)
        for resume in ({}, dict(resume=kept)):
            self.listen('covariant')
            node = self.start(dict(params, duration=0.0, pace=100.0, **resume))
            said = 'covariant_memory = 0.01: too small for orthonormalisations as frequent as these'
            self.sees(lambda: node.lines(said), node)
            harness.service('reset_average', Trigger)()
            self.sees(lambda: len(node.lines('1 windows are left out')) > 1, node)
            self.interrupt(node)
            self.assertFalse(node.lines('FATAL'), node.text())

    def test_too_short_a_transient_is_warned_of(self):
        """Once; a long one is not."""
        for transient, lines in ((0.5, 1), (TRANSIENT, 0)):
            self.listen('covariant')
            node = self.runs(
                dict(SCENE, covariant_transient=transient, wait_for_subscribers=['covariant'])
            )
            self.assertEqual(
                len(node.lines('covariant_transient = %g: too short' % transient)),
                lines,
                node.text(),
            )

    def test_not_a_number(self):
        covariant = self.listen('covariant')
        self.ends(self.start(SCENE, probe={'PROBE_NAN_ANGLE': '1'}), 3, 'not finite')
        self.assertEqual(covariant.messages, [])
