"""All messages of a report have one stamp and one sim_time: message_filters bring any two topics
together at every report."""

import itertools

import message_filters

import harness
from harness import OBSERVABLES, OF_OTHERS, REPEATABLE
from hdlyap import topics
from hdlyap.msg import LpPhase

pytestmark = harness.UNDER_A_MASTER

# what is told at other times than reports
ASIDE = 'run_info', 'covariant', 'slow_vectors'
OF_REPORTS = [topic for topic in topics.RECORDED if topic not in (*ASIDE, *OF_OTHERS)]
RUN = dict(REPEATABLE, observables=OBSERVABLES, duration=20.0, wait_for_subscribers=OF_REPORTS)
REPORTS = 40  # of the averaging; all topics are at some of them
FIELDS = 6  # reports with fields
PHASES = ['lp_phases', 't_phases']


class Synchronized(harness.Case):
    @classmethod
    def setUpClass(cls):
        """A whole run; {topics of a pair: stamps at which both were there}, {topic: messages}."""
        cls.heard = {topic: [] for topic in OF_REPORTS}
        heard = {
            topic: message_filters.Subscriber('/hdlyap/' + topic, topics.RECORDED[topic])
            for topic in OF_REPORTS
        }
        for topic, subscriber in heard.items():
            subscriber.registerCallback(cls.heard[topic].append)
        cls.together, cls.held = {}, []
        for pair in itertools.combinations(OF_REPORTS, 2):
            of_pair = cls.together[pair] = []
            both = message_filters.TimeSynchronizer([heard[topic] for topic in pair], 1000)
            both.registerCallback(lambda *messages, of_pair=of_pair: of_pair.append(messages))
            cls.held.append(both)
        node = harness.start(RUN)
        cls.addClassCleanup(node.end)
        assert node.wait() == 0, node.text()
        harness.wait_until(lambda: any(map(harness.is_last, cls.heard['status'])))
        for subscriber in heard.values():
            harness.wait_until(lambda of=subscriber.sub: not of.get_num_connections())
            subscriber.unregister()

    def test_each_two_topics_meet_at_each_report(self):
        times = {topic: {one.sim_time for one in told} for topic, told in self.heard.items()}
        for (a, b), met in self.together.items():
            with self.subTest(topics=(a, b)):
                wanted = sorted(times[a] & times[b])
                self.assertGreaterEqual(len(wanted), FIELDS if 'fields' in (a, b) else REPORTS)
                self.assertEqual([one.sim_time for one, _ in met], wanted)
                self.assertEqual([one.sim_time for _, one in met], wanted)

    def test_stamp_and_time_are_the_same_key(self):
        pairs = {(m.header.stamp, m.sim_time) for told in self.heard.values() for m in told}
        for part in zip(*pairs):
            self.assertEqual(len(set(part)), len(pairs))
        self.assertGreaterEqual(len(pairs), REPORTS)

    def test_phases_say_when_they_were_sampled(self):
        """Before the report, if nothing else needs a sample there; tracked times grow from sample
        to sample."""
        run = dict(RUN, observables=PHASES, wait_for_subscribers=PHASES, report_interval=0.3)
        heard = harness.whole_run(run, PHASES)
        for topic in PHASES:
            late = [m.sim_time - m.sample_time for m in heard[topic]]
            self.assertGreaterEqual(min(late), 0.0)
            self.assertGreater(max(late), 0.0)
            for one, after in zip(heard[topic], heard[topic][1:]):
                gone = after.sample_time - one.sample_time
                for before, phase in zip(one.phases, after.phases):
                    grown = phase.tracked_time - before.tracked_time
                    if phase.state == before.state == LpPhase.TRACKED and grown > 0.0:
                        self.assertAlmostEqual(grown, gone, delta=1e-9)
