#!/usr/bin/env python3
"""~localization: widths against the published vectors themselves; only while somebody listens.
"""


import numpy as np

import harness

CHOSEN = [1, 2, 5, 40, 117]
PARAMS = dict(
    harness.MODES,
    threads=2,
    report_interval=1.0,
    observables=['localization', 'fields', 'spectrum'],
    field_indices=CHOSEN,
    field_interval=0.0,
    wait_for_subscribers='all',
)


def width(field):
    """Of a published vector, by its disks."""
    parts = sum(np.square(getattr(field, name)) for name in ('dqx', 'dqy', 'dpx', 'dpy'))
    parts = parts[parts > 0]
    return np.exp(-(parts * np.log(parts)).sum()) / len(field.x)


class Widths(harness.Case):
    def test_against_the_vectors(self):
        """Fields end a sample at each report, so that both are of the same time."""
        topics = ['run_info', 'status', 'cost', *PARAMS['observables']]
        messages = harness.whole_run(PARAMS, topics)
        told = {message.sim_time: message for message in messages['localization']}
        self.assertGreaterEqual(len(told), 15)
        for field in messages['fields']:
            for name in ('dqx', 'dqy', 'dpx', 'dpy'):
                setattr(field, name, np.array(getattr(field, name)))
            message = told[field.sim_time]
            self.assertAlmostEqual(message.widths_now[field.index - 1], width(field), places=9)
        self.assertEqual({field.index for field in messages['fields']}, set(CHOSEN))
        last = messages['localization'][-1]
        self.assertEqual((last.first_index, len(last.widths)), (1, 117))
        self.assertGreaterEqual(last.samples, 20)
        self.assertTrue(all(1 / 60 <= one <= 1 for one in last.widths))
        self.assertLess(last.widths[0], 0.7 * last.widths[-1])
        self.assertTrue(all(one == -1 or 0 < one < 0.2 for one in last.std_errors))
        self.assertGreater(np.mean(np.array(last.std_errors) > 0), 0.5)
        samples = [message.samples for message in messages['localization']]
        self.assertEqual(samples, sorted(samples))


class Demand(harness.Case):
    def calls(self, topics):
        listeners = [harness.Listener(topic) for topic in topics]
        for listener in listeners:
            self.addCleanup(listener.close)
        params = dict(PARAMS, observables=['localization', 'spectrum'], wait_for_subscribers=topics)
        for name in ('field_indices', 'field_interval'):
            del params[name]
        return harness.calls(self, params)

    def test_nobody(self):
        for topics in ([], ['spectrum']):
            calls = self.calls(topics)
            self.assertEqual((calls['localization_measure'], calls['localization_publish']), (0, 0))

    def test_somebody(self):
        calls = self.calls(['localization'])
        self.assertGreater(calls['localization_publish'], 0)
        self.assertEqual(calls['localization_measure'], calls['spectrum_sample'])
        self.assertEqual(calls['modes_measure'], 0)


if __name__ == '__main__':
    harness.main('localization')
