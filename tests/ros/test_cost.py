"""~cost and ~status against the clock, against each other and against the other topics: seconds of
each stage, rates, progress, and the time that is left."""

from statistics import median

import harness
from harness import SHORT
from hdlyap.msg import Cost

pytestmark = harness.UNDER_A_MASTER

STAGES = ['events', 'replay', 'ortho', 'spectrum', 'modes', 'covariant', 'publish', 'waiting']
BOX = dict(SHORT, number=100, threads=1)
WINDOW = dict(
    number=16,
    exponents='all',
    observables=['covariant'],
    warmup=20.0,
    covariant_window=5.0,
    covariant_transient=20.0,
    covariant_sampling=0.2,
)
NO_EXPONENTS = dict(exponents='none', observables=['state'])
# runs of which so large a share is the stage's, so that a stage told twice or half as long shows
SHARES = dict(
    events=(0.6, dict(NO_EXPONENTS, number=400, duration=200.0, report_interval=20.0)),
    replay=(
        0.08,
        dict(exponents=100, observables=['spectrum'], duration=400.0, report_interval=50.0),
    ),
    ortho=(0.6, dict(interval=0.02, observables=['spectrum'], duration=4.0)),
    modes=(0.1, dict(max_mode_number=4, observables=['modes'], duration=45.0, report_interval=0.1)),
    covariant=(0.4, dict(WINDOW, duration=240.0)),
    publish=(0.6, dict(NO_EXPONENTS, number=2000, density=0.1, report_interval=0.002)),
)
WHOLE = 0.93  # of the wall time, at least, in all stages together
ROUNDING = 1e-9


class Costs(harness.Case):
    def run_of(self, **params):
        observed = params['observables']
        params = {**BOX, 'wait_for_subscribers': 'all', **params}
        return harness.whole_run(params, ['run_info', 'cost', *observed])

    def test_seconds_of_each_stage(self):
        """They add up to those of the clock."""
        for stage, (least, params) in SHARES.items():
            with self.subTest(stage=stage):
                messages = self.run_of(**params)['cost']
                first, last = messages[0], messages[-1]
                wall = last.wall_seconds - first.wall_seconds
                spent = {
                    name: getattr(last, name + '_seconds') - getattr(first, name + '_seconds')
                    for name in STAGES
                }
                busy = wall - spent['waiting']
                self.assertGreater(spent[stage], least * busy, spent)
                # the first report was under way when it was told
                under_way = messages[1].publish_seconds - first.publish_seconds
                self.assertLessEqual(sum(spent.values()) - under_way, wall, spent)
                self.assertGreater(sum(spent.values()), WHOLE * wall, spent)
                # a busy machine may put 30 ms between a stamp and its report, but not between each
                late = [m.header.stamp.to_sec() - m.wall_seconds for m in messages]
                half = len(late) // 2
                self.assertAlmostEqual(max(late[half:]), max(late[:half]), delta=0.01 * wall)

    def test_counts(self):
        """Of a run whose intervals are all the same, so short that nothing shortens them."""
        messages = self.run_of(interval=0.25, observables=['spectrum'], report_interval=0.5)
        collisions = {m.sim_time: m.collisions for m in messages['spectrum']}
        self.assertGreater(len(collisions), 2)
        for cost in messages['cost']:
            if cost.sim_time in collisions:
                counted = cost.events_per_second * cost.events_seconds
                self.assertAlmostEqual(counted, collisions[cost.sim_time], places=6)
            carried = max(cost.sim_time - BOX['equilibration'], 0.0)
            self.assertGreaterEqual(cost.orthonormalisations, carried / 0.25 - ROUNDING)
            self.assertLessEqual(cost.orthonormalisations, 1.5 * carried / 0.25 + 3)
        self.assertLessEqual(cost.interval, 0.25)
        self.assertEqual(cost.interval_limit, Cost.LIMIT_SCENE)
        self.assertEqual((cost.repairs, cost.communication_bytes), (0, 0))

    def test_progress_and_what_is_left(self):
        """As the pace says, which is waited for from the averaging on."""
        params = dict(observables=['state'], duration=40.0, pace=20.0, report_interval=0.5)
        messages = self.run_of(equilibration=3.0, warmup=2.0, **params)
        total, begin, end = 45.0, 3.0, messages['status'][-1]
        ratios = []
        for m in messages['status'][:-1]:
            self.assertAlmostEqual(m.progress, m.sim_time / total, delta=ROUNDING)
            if m.sim_time <= begin:
                self.assertEqual(m.remaining_seconds, -1.0)
                continue
            self.assertGreaterEqual(m.remaining_seconds, (total - m.sim_time) / 20.0 - ROUNDING)
            if 7.0 < m.sim_time < 35.0:
                ratios.append(m.remaining_seconds / (end.header.stamp - m.header.stamp).to_sec())
        self.assertGreater(len(ratios), 40)
        self.assertTrue(0.85 < median(ratios) < 1.3, ratios)
        self.assertEqual((end.progress, end.remaining_seconds), (1.0, 0.0))

    def test_of_a_run_without_an_end(self):
        status = self.listen('status')
        self.start(dict(BOX, duration=0.0, pace=20.0))
        self.assertTrue(status.wait_for(lambda m: m.sim_time > 3.0))
        for message in status.messages:
            self.assertEqual((message.progress, message.remaining_seconds), (-1.0, -1.0))
