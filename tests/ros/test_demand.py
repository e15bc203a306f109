#!/usr/bin/env python3
"""What of the modes is computed, by who listens; and fields of single vectors."""


from diagnostic_msgs.msg import DiagnosticArray
import rospy

import harness
from harness import MODES, OBSERVABLES, is_last
from hdlyap.msg import Mode

REPORTS = 20  # of MODES, while averaging
MESSAGE = {'fields': 'mode_field'}  # of topics that are named otherwise


class Demand(harness.Case):
    """Calls of the core by the end of a run, and messages made, by who listens."""

    def calls(self, topics=(), **params):
        listeners = [harness.Listener(topic) for topic in topics]
        for listener in listeners:
            self.addCleanup(listener.close)
        calls = harness.calls(self, dict(MODES, wait_for_subscribers=list(topics), **params))
        made = {
            name[: -len('_publish')]
            for name, count in calls.items()
            if name.endswith('_publish') and count
        }
        self.assertEqual(
            made, {'run_info', 'run_status'} | {MESSAGE.get(topic, topic) for topic in topics}
        )
        return calls

    def check(self, calls, measures, phases=0, pmodes=0, hydros=0):
        """How many times a state is measured, and what of the rest is done at all."""
        self.assertEqual(calls['modes_measure'], measures)
        self.assertEqual(
            (calls['phases_add'] > 0, calls['pmode_reconstruct'] > 0, calls['hydro_measure'] > 0),
            (bool(phases), bool(pmodes), bool(hydros)),
        )

    def test_nobody(self):
        self.check(self.calls(observables=OBSERVABLES), 0)

    def test_spectrum(self):
        self.check(self.calls(['spectrum'], observables=OBSERVABLES), 0)

    def test_modes(self):
        calls = self.calls(['modes'], observables=OBSERVABLES)
        self.check(calls, calls['spectrum_sample'])
        self.assertGreater(calls['spectrum_sample'], REPORTS // 4)

    def test_steps_with_their_velocity(self):
        calls = self.calls(['steps'], observables=OBSERVABLES)
        self.check(calls, calls['phases_add'], phases=True)

    def test_steps_alone(self):
        calls = self.calls(['steps'], observables=['steps'])
        self.check(calls, calls['spectrum_sample'])

    def test_lp_phases(self):
        calls = self.calls(['lp_phases'], observables=['lp_phases'])
        self.check(calls, calls['phases_add'], phases=True)

    def test_t_phases(self):
        calls = self.calls(['t_phases'], observables=['t_phases'])
        self.check(calls, calls['phases_add'], phases=True)

    def test_fields(self):
        calls = self.calls(['fields'], observables=OBSERVABLES, field_interval=0.0)
        self.check(calls, calls['spectrum_sample'], pmodes=True)
        self.assertGreaterEqual(calls['spectrum_sample'], REPORTS)

    def test_structure(self):
        calls = self.calls(['structure'], observables=['structure'], field_interval=5.0)
        self.check(calls, calls['spectrum_sample'])
        self.assertGreaterEqual(calls['spectrum_sample'], REPORTS)

    def test_hydro(self):
        calls = self.calls(['hydro'], observables=['hydro'])
        self.check(calls, calls['spectrum_sample'], hydros=True)
        self.assertGreaterEqual(calls['spectrum_sample'], REPORTS)
        self.assertEqual(calls['hydro_measure'], REPORTS)

    def test_who_comes_late(self):
        """Is told of what is measured from then on."""
        cost = harness.Listener('cost')
        self.addCleanup(cost.close)
        node = harness.start(dict(MODES, warmup=0.0, duration=0.0, pace=50.0))
        self.addCleanup(node.stop)
        self.assertTrue(cost.wait_for(lambda message: message.sim_time >= 15))
        modes = harness.Listener('modes')
        self.addCleanup(modes.close)
        self.assertTrue(modes.wait_for(lambda message: True))
        first = modes.messages[0]
        self.assertEqual(first.samples, 1)
        self.assertGreater(first.averaged_time, 5.0)
        keys = [
            pair.key
            for pair in rospy.wait_for_message('/diagnostics', DiagnosticArray).status[0].values
        ]
        self.assertIn('resolved steps', keys)


class Fields(harness.Case):
    def fields(self, **params):
        listeners = {
            topic: harness.Listener(topic) for topic in ('fields', 'modes', 'status', 'run_info')
        }
        for listener in listeners.values():
            self.addCleanup(listener.close)
        node = harness.start(
            {**MODES, 'duration': 2.0, 'wait_for_subscribers': list(listeners), **params}
        )
        self.addCleanup(node.stop)
        self.assertEqual(node.wait(), 0, node.text())
        self.assertTrue(listeners['status'].wait_for(is_last))
        return {topic: listener.messages for topic, listener in listeners.items()}

    def test_of_single_vectors(self):
        messages = self.fields(field_indices=[117, 1, 113], field_interval=0.0)
        self.assertEqual(messages['run_info'][0].field_indices, '[117, 1, 113]')
        self.assertEqual([field.index for field in messages['fields']], 2 * [117, 1, 113])
        modes = messages['modes'][-1].modes
        for field in messages['fields'][-3:]:
            mode = modes[field.index - 1]
            self.assertEqual(
                (field.kind, field.nx, field.exponent), (mode.kind, mode.nx, mode.exponent)
            )
        self.assertEqual(messages['fields'][1].kind, Mode.NONE)
        self.assertEqual(messages['fields'][1].pairs, 0)

    def test_now_and_then(self):
        """The first report, the first at or after each multiple of the interval, and the last."""
        for interval, times in (
            (10.0, [1, 10, 20, 25]),
            (2.5, [1, 3, 5, 8, 10, 13, 15, 18, 20, 23, 25]),
            (100.0, [1, 25]),
        ):
            with self.subTest(interval=interval):
                messages = self.fields(duration=25.0, field_indices=[5], field_interval=interval)
                self.assertEqual(messages['run_info'][0].field_interval, interval)
                begin = MODES['equilibration'] + MODES['warmup']
                self.assertEqual([field.sim_time - begin for field in messages['fields']], times)
                for field in messages['fields']:
                    norm = sum(
                        sum(v * v for v in part)
                        for part in (field.dqx, field.dqy, field.dpx, field.dpy)
                    )
                    self.assertAlmostEqual(norm, 1.0, delta=1e-5)

    def test_target_reached(self):
        """The last report has fields also where nobody knew that it would be the last."""
        messages = self.fields(
            duration=0.0, field_indices=[5], field_interval=1.0e3, target_std_error=0.05
        )
        times = [field.sim_time for field in messages['fields']]
        self.assertEqual(times, [messages['modes'][0].sim_time, messages['modes'][-1].sim_time])
        self.assertGreater(len(messages['modes']), 2)

    def test_no_nan_is_published(self):
        fields = harness.Listener('fields')
        self.addCleanup(fields.close)
        node = harness.start(dict(MODES, wait_for_subscribers=['fields']), probe={'PROBE_NAN': '1'})
        self.addCleanup(node.stop)
        self.assertEqual(node.wait(), 3, node.text())
        self.assertEqual(len(node.lines('not finite')), 1, node.text())
        self.assertEqual(fields.messages, [])


if __name__ == '__main__':
    harness.main('demand')
