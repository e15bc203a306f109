"""What a run says of its modes: the topics agree with each other."""

import math

import numpy as np

import harness
import measured
from harness import MODES, OBSERVABLES
from hdlyap.msg import LpPhase, Mode

pytestmark = harness.UNDER_A_MASTER

REPORTS = 20  # of MODES, while averaging
ROUNDING = 1e-9
WAVES = range(1, 9)  # the longest of the long box, numbers of nodes along x


class Errors(harness.Case):
    """Fits and errors, of a run that is long enough for them."""

    @classmethod
    def setUpClass(cls):
        topics = ['spectrum', 'steps', 'lp_phases', 'cost']
        scene = dict(number=200, density=0.7, aspect=0.2, equilibration=20.0, warmup=50.0)
        scene.update(duration=140.0, report_interval=10.0, max_mode_number=3)
        messages = harness.whole_run(dict(scene, wait_for_subscribers=topics), topics)
        cls.spectrum, cls.steps = messages['spectrum'][-1], messages['steps'][-1]
        cls.status = messages['status'][-1]

    def test_fits(self):
        m = self.steps
        self.assertGreater(m.t_points, m.l_points)
        for letter in 'tl':
            error, sampling = (
                getattr(m, f'c_{letter}_{name}') for name in ('error', 'sampling_error')
            )
            self.assertTrue(0.0 < sampling < error < 0.05 * getattr(m, f'c_{letter}'))
        self.assertLess(m.t_prior_share, m.l_prior_share)
        self.assertTrue(0.0 < m.v_error < 0.05 * m.v and m.v_misfit >= 0.0)
        self.assertEqual((m.v_k_min, m.v_k_max), (m.l_k_min, m.l_k_max))

    def test_steps_that_are_alone(self):
        found = [s for s in self.steps.steps if s.resolved]
        self.assertGreater(len(found), 3)
        for s in found:
            self.assertEqual((s.members, s.sharing, s.own_part), (1, s.SHARING_ALONE, 1.0))
            self.assertTrue(math.isnan(s.gap) and s.gap_error == -1.0)
            self.assertTrue(0.0 <= s.set_time <= self.steps.averaged_time)

    def test_entropy(self):
        """Its error is less than that of exponents which all move together, and more than that of
        some which do not at all."""
        errors = np.array(self.spectrum.std_errors)
        self.assertGreater(errors.min(), 0.0)
        self.assertLess(self.spectrum.ks_entropy_error, errors.sum())
        self.assertGreater(self.spectrum.ks_entropy_error, errors.max())
        self.assertEqual(self.status.std_error, errors[-8:].max())  # of the smallest exponents


class Agreement(harness.Case):
    """Of all topics of one run, with all 4N vectors."""

    @classmethod
    def setUpClass(cls):
        cls.messages = harness.whole_run(
            dict(
                MODES,
                exponents='all',
                observables=OBSERVABLES,
                field_interval=0.0,
                wait_for_subscribers='all',
            ),
            harness.TYPES,
        )
        cls.info = cls.messages['run_info'][0]

    def last(self, topic):
        return self.messages[topic][-1]

    def test_one_run(self):
        counts = {topic: len(messages) for topic, messages in self.messages.items()}
        for topic in harness.AVERAGES:
            self.assertEqual(counts[topic], REPORTS, topic)
        times = [message.sim_time for message in self.messages['spectrum']]
        for topic in harness.AVERAGES:
            self.assertEqual([message.sim_time for message in self.messages[topic]], times, topic)
        for topic, messages in self.messages.items():
            self.assertEqual({message.run_id for message in messages}, {self.info.run_id}, topic)
        self.assertGreater(self.last('cost').modes_seconds, 0.0)

    def test_wave_vectors(self):
        self.assertEqual(list(zip(self.info.wave_nx, self.info.wave_ny)), [(n, 0) for n in WAVES])
        self.assertEqual((self.info.max_mode_number, self.info.max_wave_number), (0, 0.0))
        half = [of for n in WAVES for of in ((Mode.T, n, 2), (Mode.LP, n, 4))]
        self.assertEqual(
            [(s.kind, s.nx, s.expected, s.conjugate) for s in self.last('steps').steps],
            [(*of, False) for of in half]
            + [(Mode.ZERO, 0, 6, False)]
            + [(*of, True) for of in half],
        )
        for step in self.last('steps').steps:
            self.assertAlmostEqual(step.wave_number, 2 * math.pi * step.nx / self.info.box_x)

    def test_steps(self):
        """At least the longest waves of either kind are found."""
        message = self.last('steps')
        found = {(s.kind, s.nx, s.conjugate): s for s in message.steps if s.resolved}
        for key in (
            (Mode.T, 1, False),
            (Mode.LP, 1, False),
            (Mode.T, 1, True),
            (Mode.ZERO, 0, False),
        ):
            self.assertIn(key, found)
        zero = found[Mode.ZERO, 0, False]
        self.assertEqual((zero.first_index, zero.last_index), (118, 123))
        self.assertAlmostEqual(zero.multiplicity, 6.0, delta=0.01)
        for (_, _, conjugate), step in found.items():
            self.assertEqual(
                step.last_index - step.first_index + 1, step.expected
            )  # no step shares
            self.assertEqual(step.members, 1)
            self.assertGreaterEqual(step.multiplicity, message.threshold * step.expected)
            self.assertLessEqual(step.multiplicity, step.expected + ROUNDING)
            self.assertEqual(step.exponent < -0.1, conjugate)
        self.assertEqual(len({s.set for s in found.values()}), len(found))
        t, conjugate = found[Mode.T, 1, False], found[Mode.T, 1, True]
        self.assertEqual(t.first_index + conjugate.last_index, 241)
        self.assertAlmostEqual(t.exponent, -conjugate.exponent, delta=1e-3)
        self.assertGreaterEqual(message.t_points, 1)
        self.assertAlmostEqual(
            message.c_t * t.wave_number + message.c_t2 * t.wave_number**2, t.exponent, delta=0.1
        )

    def test_what_is_not_measured(self):
        """It is NaN, nothing else is, and some of it is there."""
        for messages in self.messages.values():
            measured.check(self, messages)
        for topic in ('modes', 'steps', 'lp_phases', 'hydro'):
            self.assertTrue(any(map(measured.nans, self.messages[topic])), topic)

    def test_steps_that_fluctuate(self):
        """They are those found, with vectors of their own."""
        steps, seen = {one.sim_time: one.steps for one in self.messages['steps']}, 0
        for message in self.messages['fluctuations']:
            found = {
                (step.kind, step.nx, step.ny): range(step.first_index, step.last_index + 1)
                for step in steps[message.sim_time]
                if step.resolved and not step.conjugate and step.kind != Mode.ZERO
            }
            every = [index for step in message.steps for index in step.indices]
            self.assertEqual(len(every), len(set(every)))
            for step in message.steps:
                self.assertLessEqual(set(step.indices), set(found[step.kind, step.nx, step.ny]))
            seen += len(message.steps)
        self.assertGreater(seen, 0)

    def test_unresolved_steps_are_empty(self):
        for message in self.messages['steps']:
            for step in message.steps:
                if not step.resolved:
                    self.assertEqual(
                        (step.set, step.first_index, step.last_index, step.std_error),
                        (-1, 0, 0, -1.0),
                    )

    def test_modes(self):
        topics = (self.messages[topic] for topic in ('modes', 'steps', 'spectrum'))
        for modes, steps, spectrum in zip(*topics):
            self.assertEqual([mode.index for mode in modes.modes], list(range(1, 241)))
            self.assertEqual([mode.exponent for mode in modes.modes], list(spectrum.exponents))
            self.assertEqual(modes.averaged_time, spectrum.averaged_time)
            self.assertEqual(steps.averaged_time, spectrum.averaged_time)
            self.assertGreaterEqual(modes.samples, 1)
            for mode in modes.modes:
                self.check_mode(mode, steps.steps)

    def check_mode(self, mode, steps):
        """Of the step that it says it belongs to."""
        of_kind = [mode.weight_l, mode.weight_p] if mode.kind == Mode.LP else []
        of_step = [mode.weight, mode.weight_now] if mode.step >= 0 else []
        weights = [mode.null_x, mode.null_y, mode.null_p, *of_step, *of_kind]
        self.assertTrue(0.0 <= min(weights) and max(weights) <= 1.0 + ROUNDING, weights)
        if mode.step < 0:
            self.assertEqual((mode.kind, mode.nx, mode.ny), (Mode.NONE, 0, 0))
            return
        step = steps[mode.step]
        self.assertTrue(step.resolved)
        for name in ('kind', 'nx', 'ny', 'wave_number'):
            self.assertEqual(getattr(mode, name), getattr(step, name))
        self.assertTrue(step.first_index <= mode.index <= step.last_index)
        for weight in (mode.weight_l, mode.weight_p):
            self.assertEqual(weight > 0.0, mode.kind == Mode.LP)
        if mode.kind == Mode.ZERO:
            self.assertAlmostEqual(mode.weight_now, 1.0, delta=0.05)

    def test_modes_add_up_to_steps(self):
        modes = self.last('modes').modes
        for s, step in enumerate(self.last('steps').steps):
            if not step.resolved:
                continue
            own = modes[step.first_index - 1 : step.last_index]
            self.assertEqual({mode.step for mode in own}, {s})
            self.assertAlmostEqual(sum(mode.weight for mode in own), step.multiplicity, delta=1e-6)
            self.assertAlmostEqual(
                sum(mode.exponent for mode in own) / len(own),
                step.exponent,
                delta=0.01 * abs(step.exponent) + 1e-6,
            )

    def test_lp_phases(self):
        for message, steps in zip(self.messages['lp_phases'], self.messages['steps']):
            self.assertEqual(message.sim_time, steps.sim_time)
            self.assertLessEqual(message.sample_time, steps.sim_time)
            for phase in message.phases:
                self.check_phase(phase, steps.steps[phase.step])
        tracked = [p for p in self.last('lp_phases').phases if p.state == LpPhase.TRACKED]
        velocities = [p.velocity for p in tracked]
        steps = self.last('steps')
        self.assertGreater(len(tracked), 0)
        self.assertGreater(steps.v_phases, 0)
        self.assertLessEqual(min(velocities), steps.v)
        self.assertLessEqual(steps.v, max(velocities))

    def test_velocity_is_that_of_the_steps(self):
        """Their mean, each with its error, to rounding."""
        counts = set()
        for m in self.messages['steps']:
            known = [(s.omega, s.omega_error, s.wave_number) for s in m.steps if s.omega_error > 0]
            counts.add(len(known))
            if m.v_phases:
                omega, error, k = np.array(known).T
                v = np.average(abs(omega) / k, weights=(k / error) ** 2)
                self.assertAlmostEqual(m.v, v, delta=1e-12 * v)
        self.assertGreater(max(counts), 1)

    def check_phase(self, phase, step):
        self.assertEqual((step.kind, step.nx, step.ny), (Mode.LP, phase.nx, phase.ny))
        self.assertIn(phase.modulation, (LpPhase.COS_COS, LpPhase.SIN_COS))
        if phase.state == LpPhase.UNRESOLVED:
            self.assertEqual((phase.index, phase.tracked_time, phase.omega_error), (0, 0.0, -1.0))
            return
        self.assertTrue(step.resolved)
        self.assertLessEqual(step.first_index, phase.index)
        self.assertLessEqual(phase.index, step.last_index)
        if phase.tracked_time > 0:
            self.assertEqual(phase.wave_number, step.wave_number)
            self.assertAlmostEqual(phase.velocity, abs(phase.omega) / step.wave_number)
        if phase.state == LpPhase.TRACKED:
            turn = (phase.phase - math.atan2(phase.b, phase.a)) / (2 * math.pi)
            self.assertAlmostEqual(turn, round(turn))

    def test_t_phases(self):
        """Of the vectors of the T steps; they do not turn within 5 of their errors, which are known
        here of none: beside what an LP phase turns by."""
        steps = self.last('steps').steps
        rate = min(p.omega for p in self.last('lp_phases').phases if p.state == LpPhase.TRACKED)
        tracked = 0
        for message in self.messages['t_phases']:
            for phase in message.phases:
                step = steps[phase.step]
                self.assertEqual((step.kind, step.nx, step.ny), (Mode.T, phase.nx, phase.ny))
                self.assertEqual(phase.modulation, LpPhase.COS_COS)
                if phase.state == LpPhase.TRACKED:
                    turn = (phase.phase - math.atan2(phase.b, phase.a)) / (2 * math.pi)
                    self.assertAlmostEqual(turn, round(turn))
                    self.assertGreater(math.hypot(phase.a, phase.b), 0.2)
        for phase in self.last('t_phases').phases:
            if phase.tracked_time > 10:
                tracked += 1
                self.assertLess(abs(phase.omega), max(5 * phase.omega_error, 0.5 * rate))
        self.assertGreater(tracked, 1)

    def test_fields_follow_the_steps(self):
        got = [(field.sim_time, field.index) for field in self.messages['fields']]
        want = [
            (steps.sim_time, example(modes.modes, number, steps.steps[number]))
            for modes, steps in zip(self.messages['modes'], self.messages['steps'])
            for number in harness.examples(steps.steps)
        ]
        self.assertEqual(got, want)
        self.assertGreaterEqual(len(got), 2 * REPORTS)

    def test_fields(self):
        states = {state.sim_time: state for state in self.messages['state']}
        modes = {message.sim_time: message.modes for message in self.messages['modes']}
        for field in self.messages['fields']:
            state, mode = states[field.sim_time], modes[field.sim_time][field.index - 1]
            for name in ('x', 'y', 'px', 'py'):
                self.assertEqual(getattr(field, name), getattr(state, name))
            for name in ('exponent', 'kind', 'nx', 'ny', 'wave_number'):
                self.assertEqual(getattr(field, name), getattr(mode, name))
            vector = [*field.dqx, *field.dqy, *field.dpx, *field.dpy]
            self.assertAlmostEqual(np.linalg.norm(vector), 1.0, delta=5e-6)
            self.check_pairs(field)

    def check_pairs(self, field):
        pairs = 2 if field.kind == Mode.LP else 0
        self.assertEqual((field.pairs, list(field.modulation)), (pairs, list(range(pairs))))
        for name in ('residual_l', 'residual_p'):
            self.assertEqual(len(getattr(field, name)), pairs)
        for name in ('l_x', 'l_y', 'p_x', 'p_y', 'p_over_px', 'p_over_py'):
            self.assertEqual(len(getattr(field, name)), pairs * 60, name)
        for c in range(pairs):
            self.check_modulation(field, c)

    def check_modulation(self, field, c):
        """The P field divided by the momenta is the pair's own modulation, as far as it spans
        it."""
        wave = math.sin if field.modulation[c] & 1 else math.cos
        a = [wave(field.wave_number * x) for x in field.x]
        for ratio in (field.p_over_px, field.p_over_py):
            part = ratio[60 * c : 60 * (c + 1)]
            cosine = np.dot(a, part) / (np.linalg.norm(a) * np.linalg.norm(part))
            self.assertGreater(cosine, 0.3)

    def test_hydro(self):
        """Of each vector of each step that is found."""
        for message, steps in zip(self.messages['hydro'], self.messages['steps']):
            for response in message.responses:
                step = steps.steps[response.step]
                of_wave = (response.kind, response.nx, response.ny)
                self.assertEqual(of_wave, (step.kind, step.nx, step.ny))
                if response.index:
                    self.assertTrue(step.first_index <= response.index <= step.last_index)
            found = [s for s in steps.steps if s.resolved and s.kind != Mode.ZERO]
            indices = {k for s in found for k in range(s.first_index, s.last_index + 1)}
            self.assertEqual({response.index for response in message.responses} - {0}, indices)

    def test_hydro_is_that_of_the_fields(self):
        responses = {
            (message.sim_time, r.index, r.modulation): r
            for message in self.messages['hydro']
            for r in message.responses
        }
        for field in self.messages['fields']:
            for modulation in (LpPhase.COS_COS, LpPhase.SIN_COS):
                got = responses[field.sim_time, field.index, modulation]
                np.testing.assert_allclose(
                    (got.density, got.along, got.across, got.energy),
                    responses_of(field, modulation),
                    atol=1e-7,
                )

    def test_structure_is_that_of_the_fields(self):
        """Amplitudes along and across, of vectors whose fields there are; of waves along x."""
        now = {message.sim_time: message for message in self.messages['structure']}
        checked = 0
        for field in self.messages['fields']:
            message = now[field.sim_time]
            n, peak = len(message.peak), message.peak[field.index - 1]
            if peak == 0:
                continue
            k = message.wave_number[peak - 1]
            self.assertAlmostEqual(k, 2 * math.pi * message.nx[peak - 1] / self.info.box_x)
            self.assertEqual(message.ny[peak - 1], 0)
            norm = np.linalg.norm([*field.dqx, *field.dqy])
            phase = k * np.array(field.x)
            for bits, wave in enumerate((-np.sin(phase), np.cos(phase))):
                along, across = np.dot(wave, field.dqx) / norm, -np.dot(wave, field.dqy) / norm
                at = bits * n + field.index - 1
                self.assertAlmostEqual(message.amplitude_along[at], along)
                self.assertAlmostEqual(message.amplitude_across[at], across)
                checked += abs(along) + abs(across) > 0.5
        self.assertGreater(checked, 2 * REPORTS)

    def test_structure_finds_the_steps(self):
        """Largest at the wave of the step of which a vector is most."""
        message, steps = self.last('structure'), self.last('steps').steps
        n, waves = len(message.peak), len(message.nx)
        self.assertEqual((n, len(message.along)), (240, 240 * waves))
        self.assertGreater(waves, len(self.info.wave_nx))
        self.assertEqual(message.samples, self.last('modes').samples)
        found = 0
        for step in steps:
            if not step.resolved or step.kind == Mode.ZERO or step.members > 1:
                continue
            factors = message.along if step.kind == Mode.LP else message.across
            for index in range(step.first_index, step.last_index + 1):
                own = [factors[wave * n + index - 1] for wave in range(waves)]
                largest = own.index(max(own))
                self.assertEqual((message.nx[largest], message.ny[largest]), (step.nx, step.ny))
                found += 1
        self.assertGreater(found, 5)


def example(modes, number, step):
    """Index of the first vector of its set that belongs to a step, else of the first."""
    own = [
        mode.index for mode in modes[step.first_index - 1 : step.last_index] if mode.step == number
    ]
    return own[0] if own else step.first_index


def responses_of(field, modulation):
    """At a wave vector along x over sqrt(N/2): of density, p along k and p across it, over k, and
    of energy."""
    k = field.wave_number
    names = 'x', 'px', 'py', 'dqx', 'dpx', 'dpy'
    x, px, py, dqx, dpx, dpy = (np.array(getattr(field, name)) for name in names)
    cosine, sine = np.cos(k * x), np.sin(k * x)
    a, slope = (sine, k * cosine) if modulation & 1 else (cosine, -k * sine)
    parts = (
        dqx * slope / k,
        dpx * slope / k - px * dqx * k * a,
        -dpy * slope / k + py * dqx * k * a,
        2 * (px * dpx + py * dpy) * a + (px**2 + py**2) * dqx * slope,
    )
    return np.sum(parts, axis=1) / math.sqrt(len(x) / 2)
