"""What of the modes is computed, by who listens; and fields of single vectors."""

import os

from diagnostic_msgs.msg import DiagnosticArray
import rospy
import yaml

import harness
from harness import MODES, OBSERVABLES
from hdlyap.runs.program import HDLYAP

pytestmark = harness.UNDER_A_MASTER

REPORTS = 20  # of MODES, while averaging
MESSAGE = {'fields': 'mode_field'}  # of topics that are named otherwise


class Demand(harness.Case):
    """Calls of the core by the end of a run, and messages made, by who listens."""

    def calls(self, topics=(), **params):
        listeners = [self.listen(topic) for topic in topics]
        calls = harness.calls(self, dict(MODES, wait_for_subscribers=list(topics), **params))
        made = {
            name[: -len('_publish')]
            for name, count in calls.items()
            if name.endswith('_publish') and count
        }
        for listener in listeners:
            listener.close()
        self.assertEqual(
            made, {'run_info', 'run_status'} | {MESSAGE.get(topic, topic) for topic in topics}
        )
        return calls

    def test_by_who_listens(self):
        """How often vectors are measured, and what of the rest is done at all: phases, fields of P
        modes, responses, widths."""
        every = dict(observables=OBSERVABLES)
        rest = ('phases_add', 'pmode_reconstruct', 'hydro_measure', 'localization_measure')
        for topics, params, count, done in (
            ([], every, 'none', []),
            (['spectrum', 'gas'], every, 'none', []),
            (['modes'], every, 'spectrum_sample', []),
            (['steps'], every, 'phases_add', ['phases_add']),
            (['steps'], {}, 'spectrum_sample', []),
            (['lp_phases'], {}, 'phases_add', ['phases_add']),
            (['t_phases'], {}, 'phases_add', ['phases_add']),
            (['fields'], dict(every, field_interval=0.0), 'spectrum_sample', ['pmode_reconstruct']),
            (['structure'], dict(field_interval=5.0), 'spectrum_sample', []),
            (['hydro'], {}, 'spectrum_sample', ['hydro_measure']),
            (['localization'], {}, 'none', ['localization_measure']),
        ):
            with self.subTest(topics=topics, params=params):
                calls = dict(self.calls(topics, **{'observables': topics, **params}), none=0)
                self.assertEqual(calls['modes_measure'], calls[count])
                self.assertEqual([name for name in rest if calls[name]], done)
                if 'localization_measure' in done:
                    self.assertEqual(calls['localization_measure'], calls['spectrum_sample'])
                if 'hydro_measure' in done:
                    self.assertEqual(calls['hydro_measure'], REPORTS)
                of_reports = {'fields', 'structure', 'hydro'} & set(topics)
                least = REPORTS if of_reports else REPORTS // 4
                self.assertGreaterEqual(calls['spectrum_sample'], least)

    def test_who_comes_late(self):
        """Is told of what is measured from then on."""
        cost = self.listen('cost')
        self.start(dict(MODES, warmup=0.0, duration=0.0, pace=50.0))
        self.assertTrue(cost.wait_for(lambda message: message.sim_time >= 15))
        modes = self.listen('modes')
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
        topics = ['fields', 'modes', 'run_info']
        return harness.whole_run(dict(MODES, wait_for_subscribers=topics, **params), topics)

    def test_now_and_then(self):
        """The first report, the first at or after each multiple of the interval, and the last."""
        messages = self.fields(duration=25.0, field_indices=[5], field_interval=2.5)
        self.assertEqual(messages['run_info'][0].field_interval, 2.5)
        begin = MODES['equilibration'] + MODES['warmup']
        self.assertEqual(
            [field.sim_time - begin for field in messages['fields']],
            [1, 3, 5, 8, 10, 13, 15, 18, 20, 23, 25],
        )

    def test_target_reached(self):
        """The last report has fields also where nobody knew that it would be the last."""
        messages = self.fields(
            duration=0.0, field_indices=[5], field_interval=1.0e3, target="smallest 0.05"
        )
        times = [field.sim_time for field in messages['fields']]
        self.assertEqual(times, [messages['modes'][0].sim_time, messages['modes'][-1].sim_time])
        self.assertGreater(len(messages['modes']), 2)

    def test_target_not_reached(self):
        """Because the duration was over before: the log says so, and when errors would be stated as
        --errors does."""
        scene = dict(MODES, target='lambda_max 1e-9', table=3600.0)
        path = os.path.join(self.new_folder(), 'a.yaml')
        with open(path, 'w') as file:
            yaml.safe_dump(scene, file)
        when = '{:.6g} time units of averaging, and the duration is 20'
        when = when.format(HDLYAP.errors_after(path)[0])
        node = self.start(scene)
        self.ends(node)
        said = node.lines('result: averaged ')
        self.assertEqual(len(said), 1, node.text())
        self.assertRegex(said[0], 'target not reached: error of lambda_max not yet known')
        said = f'there will be no standard errors: they are first stated after {when}'
        self.assertEqual(len(node.lines(said)), 1, node.text())

    def test_no_nan_is_published(self):
        """Not as what is not yet known, either."""
        for name, probe in (
            ('fields', 'PROBE_NAN'),
            ('lp_phases', 'PROBE_NAN_PHASE'),
            ('steps', 'PROBE_NAN_RATE'),
        ):
            heard = self.listen(name)
            node = self.start(dict(MODES, wait_for_subscribers=[name]), probe={probe: '1'})
            self.ends(node, 3)
            self.assertEqual(len(node.lines('not finite')), 1, node.text())
            self.assertTrue(name != 'fields' or heard.messages == [])
