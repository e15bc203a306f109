"""A run seen from outside: topics, services, diagnostics, faults, and what is not computed."""

import re

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
import rospy
from std_srvs.srv import SetBool, Trigger

from hdlyap.numbers import with_error

import harness
import measured
from harness import SHORT, is_last

pytestmark = harness.UNDER_A_MASTER

# at least two waves of each kind
TWO_WAVES = dict(
    number=120, density=0.7, aspect=0.1, equilibration=20.0, warmup=50.0, duration=400.0
)
ENDLESS = dict(SHORT, duration=0.0, pace=20.0, report_interval=0.5)


def averaged(message):
    """Time or samples."""
    return getattr(message, 'averaged_time', None) or getattr(message, 'samples', 0)


class Run(harness.Case):
    def test_messages_agree(self):
        topics = ['run_info', 'spectrum', 'state', 'cost', 'status']
        listeners = {topic: self.listen(topic) for topic in topics}
        node = self.start(dict(SHORT, wait_for_subscribers=topics, exponents='all'))
        heard = {topic: listener.all_of(node) for topic, listener in listeners.items()}
        self.ends(node)
        # roscpp may send a latched one twice to whom connects while it is published
        counts = {topic: len({m.header.seq for m in messages}) for topic, messages in heard.items()}
        self.assertEqual(counts, dict(zip(topics, (1, 2, 4, 4, 4))), node.text())
        info, spectrum, state, cost, status = (heard[topic][-1] for topic in topics)
        self.assertRegex(info.run_id, r'^\d{8}T\d{6}\.\d{6}Z-%d-1$' % node.process.pid)
        for message in (spectrum, state, cost, status):
            self.assertEqual(message.run_id, info.run_id)
            self.assertEqual(message.sim_time, 4.0)
            self.assertEqual(message.header.frame_id, 'box')
            self.assertLess(abs(message.header.stamp - rospy.Time.now()), rospy.Duration(60))
        self.check_spectrum(spectrum, info)
        self.check_state(state, info)
        self.assertEqual(status.progress, 1.0)
        self.assertEqual(status.remaining_seconds, 0.0)

    def check_spectrum(self, spectrum, info):
        self.assertEqual(info.vectors, 80)
        for array in (
            spectrum.exponents,
            spectrum.std_errors,
            spectrum.local_exponents,
            spectrum.cos_theta,
            spectrum.dp_dq_ratio,
        ):
            self.assertEqual(len(array), info.vectors)
        self.assertEqual(spectrum.first_index, 1)
        self.assertEqual(spectrum.lambda_max, spectrum.exponents[0])
        positive = sum(spectrum.exponents[: (80 - info.zero_exponents) // 2])
        self.assertAlmostEqual(spectrum.ks_entropy, positive, delta=1e-12 * positive)
        pairs = zip(spectrum.exponents, reversed(spectrum.exponents))
        self.assertAlmostEqual(
            spectrum.pairing_error, max(abs(a + b) for a, b in pairs), delta=1e-12
        )
        self.assertEqual(spectrum.averaged_time, 2.0)
        self.assertGreater(spectrum.collisions, 100)

    def check_state(self, state, info):
        for array, edge in ((state.x, info.box_x), (state.y, info.box_y)):
            self.assertEqual(len(array), 20)
            self.assertGreaterEqual(min(array), 0.0)
            self.assertLessEqual(max(array), edge)
        kinetic = sum(p * p for p in state.px + state.py) / 2
        self.assertAlmostEqual(kinetic, state.kinetic_energy, delta=1e-12 * kinetic)
        self.assertAlmostEqual(kinetic, 20.0, delta=1e-9)
        self.assertAlmostEqual(sum(state.px), 0.0, delta=1e-9)
        self.assertAlmostEqual(sum(state.py), 0.0, delta=1e-9)

    def test_local_exponents(self):
        """Each sample is in one message, with its time: together they are the mean."""
        for report_interval, parts in ((0.0625, False), (8.0, True)):
            with self.subTest(report_interval=report_interval):
                topics = ['spectrum', 'cost', 'status']
                params = dict(SHORT, warmup=6.0, duration=40.0, report_interval=report_interval)
                heard = harness.whole_run(dict(params, wait_for_subscribers=topics), topics)
                for messages in heard.values():
                    measured.check(self, messages)
                self.check_local(heard['spectrum'], parts)

    def check_local(self, messages, parts):
        times = [message.local_time for message in messages]
        self.assertEqual(min(times) > 0, parts, 'a report without a sample')
        self.assertLessEqual(sum(times), messages[-1].averaged_time + 1e-9)
        told = total = 0.0
        sums = 0
        for message in messages:
            if message.local_time > 0:
                told += message.local_time
                total += message.local_time * message.local_exponents[0]
                if abs(told - message.averaged_time) < 1e-9:
                    mean = message.averaged_time * message.exponents[0]
                    self.assertAlmostEqual(total, mean, delta=1e-9 * abs(mean))
                    sums += 1
        self.assertGreater(sums, 3)

    def test_pause(self):
        cost = self.listen('cost')
        node = self.start(ENDLESS)
        pause = harness.service('pause', SetBool)
        self.assertTrue(cost.wait_for(lambda message: True))
        self.assertTrue(pause(True).success)
        self.sees(lambda: self.diagnostic().message == 'paused')
        before = len(cost.messages)
        later = self.diagnostic()  # of a second later: at this pace forty messages
        self.assertEqual(len(cost.messages), before)
        self.assertIn(('collisions per second', '0'), [(p.key, p.value) for p in later.values])
        self.assertTrue(pause(False).success)
        time = cost.messages[-1].sim_time
        self.assertTrue(cost.wait_for(lambda message: message.sim_time > time + 1))
        self.assertTrue(node.running())

    def test_reset_average(self):
        """Each mean begins anew: of all that says over what its means are."""
        topics = 'spectrum', 'modes', 'steps', 'structure', 'localization', 'gas'
        listeners = [self.listen(topic) for topic in topics]
        self.start(dict(ENDLESS, observables=list(topics)))
        for listener in listeners:
            self.assertTrue(listener.wait_for(lambda message: averaged(message) >= 8))
        self.assertTrue(harness.service('reset_average', Trigger)().success)
        for topic, listener in zip(topics, listeners):
            with self.subTest(topic=topic):
                before = averaged(listener.messages[-1])
                self.assertTrue(listener.wait_for(lambda message: averaged(message) >= before + 2))
                found = [averaged(message) for message in listener.messages]
                self.assertTrue(any(now < last for last, now in zip(found, found[1:])), found)

    def test_disks_that_keep_their_places(self):
        """In a crystal, once errors are stated; in the log, too."""
        said = 'disks have kept their places since the averaging began'
        for density, caged in ((0.5, False), (1.0, True)):
            with self.subTest(density=density):
                box = dict(SHORT, number=36, aspect=0.867, density=density)
                params = dict(box, exponents=1, duration=60.0, table=1.0)
                status = self.listen('status')
                node = self.start(dict(params, wait_for_subscribers=['status']))
                messages = status.all_of(node)
                self.ends(node)
                self.assertEqual([messages[0].caged, messages[-1].caged], [False, caged])
                self.assertEqual(any(said in line for line in node.lines('WARN')), caged)

    def test_one_wave_number(self):
        """Is one, and leaves the curvature to be assumed."""
        square = dict(number=100, density=0.7, aspect=1.0, equilibration=20.0, warmup=20.0)
        node = self.start(dict(square, duration=40.0, table=0.001, observables=['steps']))
        self.ends(node)
        said = node.text().split('result: ')[1]
        self.assertRegex(
            said, r'c_T  \S+, misfit \S+ over 1 wave number, k = 0\.5257, curvature as'
        )

    def test_table(self):
        """What the log says at the end are the numbers of the last messages."""
        topics = ['spectrum', 'steps']
        params = dict(TWO_WAVES, table=0.001, exponents='all', wait_for_subscribers=topics)
        listeners = {topic: self.listen(topic) for topic in topics}
        node = self.start(params)
        spectrum, last = (listeners[topic].all_of(node)[-1] for topic in topics)
        self.ends(node)
        so_far = node.lines('so far: averaged')
        self.assertGreater(len(so_far), 1)
        self.assertIn(', too short for standard errors', so_far[0])
        said = node.text().split('result: ')[1]
        self.assertEqual(spectrum.lambda_max_error, spectrum.std_errors[0])
        largest = self.number(spectrum.lambda_max, spectrum.std_errors[0])
        self.assertTrue(
            said.startswith(f'averaged 400 of 400 time units, lambda_max {largest}\x1b'), said
        )
        fits = [
            ('c_T', last.c_t, last.c_t_error, last.t_misfit, last.t_points, 'wave number'),
            ('c_L', last.c_l, last.c_l_error, last.l_misfit, last.l_points, 'wave number'),
            ('v', last.v, last.v_error, last.v_misfit, last.v_phases, 'LP phase'),
        ]
        waves = (last.t_k_min, last.t_k_max), (last.l_k_min, last.l_k_max)
        for (name, value, error, misfit, count, of), ends in zip(
            fits, [*waves, (last.v_k_min, last.v_k_max)]
        ):
            self.assertGreater(ends[1], ends[0])
            of += 's' * (count > 1)
            self.assertGreaterEqual(misfit, 0.0)
            number = f'{self.number(value, error)}, misfit {misfit:.1f}'
            line = f'  {name:<4} {number} over {count} {of}, k from %.4g to %.4g' % ends
            self.assertEqual(re.search(re.escape(line) + '(.*?)\x1b', said).group(1), '')
        self.check_rows(said, last)

    @staticmethod
    def number(value, error):
        return with_error(value, error, decimals=4)

    def check_rows(self, said, last):
        """One for each resolved step, smallest exponent first."""
        rows = re.findall(
            r' (T|LP)\((\d+),(\d+)\) +(\d+)-(\d+) +([0-9.]+) +(\d+)'
            r' +([0-9.]+) +([0-9.]+(?:\([0-9.]+\))?)(?:  (\w+))?\x1b',
            said,
        )
        steps = [step for step in last.steps if step.kind != step.ZERO and not step.conjugate]
        found = [step for step in steps if step.resolved]
        found.sort(key=lambda step: -step.first_index)
        words = ['', 'shared', 'mixing', 'blended', 'coincide']
        self.assertEqual(
            rows,
            [
                (
                    {step.T: 'T', step.LP: 'LP'}[step.kind],
                    *map(str, (step.nx, step.ny, step.first_index, step.last_index)),
                    f'{step.multiplicity:.2f}',
                    str(step.expected),
                    f'{step.wave_number:.5f}',
                    self.number(step.exponent, step.std_error),
                    words[step.sharing],
                )
                for step in found
            ],
        )
        self.assertIn(f' {len(steps) - len(found)} steps are not resolved', said)

    def test_reset_average_without_averages(self):
        self.start(dict(ENDLESS, equilibration=1e6))
        self.assertFalse(harness.service('reset_average', Trigger)().success)

    def diagnostic(self):
        return rospy.wait_for_message('/diagnostics', DiagnosticArray, harness.PATIENCE).status[0]

    def test_diagnostics(self):
        info = self.listen('run_info')
        self.start(ENDLESS)
        self.assertTrue(info.wait_for(lambda message: True))
        status = self.diagnostic()
        self.assertEqual(status.level, DiagnosticStatus.OK)
        self.assertEqual(status.name, '/hdlyap')
        self.assertEqual(status.hardware_id, info.messages[0].run_id)
        values = {pair.key: pair.value for pair in status.values}
        self.assertEqual(values['blas kernel'], info.messages[0].blas_kernel)
        self.assertEqual(values['repairs'], '0')
        for key in ('stage', 'progress', 'interval', 'condition', 'collisions per second'):
            self.assertIn(key, values)
        self.assertNotIn('resolved steps', values)  # nobody listens to them

    def test_computed_for_subscribers(self):
        self.listen('state')
        calls = harness.calls(self, dict(SHORT, wait_for_subscribers=['state']))
        self.assertGreater(calls.pop('spectrum_sample'), 0)
        self.assertEqual(calls.pop('run_info_publish'), 1)
        self.assertEqual(calls.pop('run_status_publish'), 4)
        self.assertEqual(calls.pop('state_publish'), 4)
        # at the start of the averaging, and at two reports, whether they keep their places
        self.assertEqual(calls.pop('trajectory_state'), 4 + 1 + 2)
        self.assertEqual(set(calls.values()), {0}, calls)

    def fault(self, **probe):
        self.listen('state')
        self.listen('cost')
        status = self.listen('status')
        node = self.start(
            dict(SHORT, wait_for_subscribers='all', observables=['state']), probe=probe
        )
        self.listen('run_info')
        self.ends(node, 3)
        fatal = node.lines('FATAL')
        self.assertEqual(len(fatal), 1, node.text())
        self.assertFalse(any(map(is_last, status.messages)))
        return fatal[0]

    def test_no_nan_is_published(self):
        state = self.listen('state')
        self.assertIn('not finite', self.fault(PROBE_NAN='1'))
        self.assertEqual(state.messages, [])

    def test_fault_in_diagnostics(self):
        errors = self.hear('/diagnostics', DiagnosticArray)
        node = self.start(dict(ENDLESS), probe={'PROBE_FAULT_AFTER': '30'})
        self.ends(node, 3)
        self.assertEqual(len(node.lines('FATAL')), 1, node.text())
        self.assertIn('too ill-conditioned', node.lines('FATAL')[0])
        self.sees(lambda: errors and errors[-1].status[0].level == DiagnosticStatus.ERROR)
        self.assertTrue(re.search('ill-conditioned', errors[-1].status[0].message))
