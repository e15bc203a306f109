"""~slow_vectors and the pictures that the viewer makes of topics: what is drawn is what is
published, only while somebody looks, as often as asked; live and from what was recorded."""

import re
import signal
import subprocess
import time

import numpy as np
import rosgraph
import rospy
from hdlyap.msg import Parameter, RunInfo, SlowVectors
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker

import harness
from harness import MODES, Listener
from pictured import Pictures, are_alike, lines, modes, places, text

pytestmark = harness.UNDER_A_MASTER

ENDLESS = dict(MODES, duration=0.0)
SPHERES = dict(particles='spheres', number=128, density=0.5, aspect=0.25, aspect_z=0.3)
SPHERES.update(equilibration=10.0, warmup=20.0, duration=0.0)
# of a bag, with status last
REPLAYED = ('run_info', 'state', 'steps', 'lp_phases', 'fields', 'status')
STAND_INS = 'state', 'lp_phases', 'fields'


def found(steps):
    return [(s.kind, s.nx, s.ny, s.first_index) for s in steps.steps if s.resolved]


def drawn_as_reported(pictures, listeners):
    """(time, picture) where both modes and the phases are drawn at a time of all messages. Topics
    do not keep step: a picture may be of the steps before, which are then the same."""
    drawn = {
        tuple(places(p).flat): p for p in list(pictures.all) if len(lines(p)) > len(modes(p)) == 2
    }
    heard = {topic: list(listener.messages) for topic, listener in listeners.items()}
    times = [{m.sim_time for m in heard[topic]} for topic in REPLAYED[1:]]
    steady = {
        after.sim_time
        for before, after in zip(heard['steps'], heard['steps'][1:])
        if found(before) == found(after)
    }
    return [
        (state.sim_time, drawn[place])
        for state in heard['state']
        for place in [tuple(np.c_[state.x, state.y].flat)]
        if place in drawn and state.sim_time in steady.intersection(*times)
    ]


class Markers(harness.Case):
    def look(self, modes='lowest', node='/hdlyap', **how):
        """Pictures of a viewer that has just been started."""
        pictures = Pictures(node)
        self.addCleanup(pictures.close)
        pictures.viewer = harness.start_viewer(dict(modes=modes, node=node), **how)
        self.addCleanup(pictures.viewer.end)
        return pictures

    def test_slow_vectors_are_those_of_the_fields(self):
        self.check_slow_vectors(ENDLESS, 'xy', 110.0, 117)

    def test_slow_vectors_of_spheres(self):
        self.check_slow_vectors(SPHERES, 'xyz', 80.0, 380)

    def check_slow_vectors(self, scene, axes, until, last):
        """And their coefficients those of the phases, wherever all three are of the same time.
        last: index of the last positive exponent."""
        slow, fields, phases = map(self.listen, ('slow_vectors', 'fields', 'lp_phases'))
        asked = dict(slow_vectors_rate=100.0, slow_vectors_count=12, field_interval=0.0, pace=10.0)
        node = self.start({**scene, **asked})
        self.assertTrue(slow.wait_for(lambda m: m.sim_time > until), node.text())
        node.stop()
        by_time = {m.sim_time: m for m in slow.messages if m.dqx}
        compared = coefficients = 0
        for field in fields.messages:
            m = by_time.get(field.sim_time)
            k = field.index - m.first_index if m else -1
            if k < 0:
                continue
            self.assertEqual((m.vectors, m.first_index + m.vectors - 1), (12, last))
            disks = slice(k * len(m.x), (k + 1) * len(m.x))
            for axis in axes:
                dq, field_dq = (getattr(of, 'dq' + axis) for of in (m, field))
                np.testing.assert_array_equal(dq[disks], field_dq)
                self.assertEqual(getattr(m, 'n' + axis)[k], getattr(field, 'n' + axis))
            np.testing.assert_array_equal((m.x, m.py), (field.x, field.py))
            self.assertEqual((m.z, m.pz), (field.z, field.pz))
            lengths = (len(m.x), 12) if 'z' in axes else (0, 0)
            self.assertEqual((len(m.z), len(m.nz)), lengths)
            self.assertEqual((m.exponents[k], m.kind[k]), (field.exponent, field.kind))
            compared += 1
        for message in phases.messages:
            m = by_time.get(message.sim_time)
            for phase in message.phases if m else ():
                k = phase.index - m.first_index
                if phase.index == 0 or k < 0 or m.pairs[k] == 0:
                    continue
                pairs = slice(2 ** len(axes) * k, 2 ** len(axes) * k + m.pairs[k])
                self.assertIn(phase.a, m.a[pairs])
                self.assertIn(phase.b, m.b[pairs])
                coefficients += 1
        self.assertGreater(compared, 20)
        self.assertGreater(coefficients, 20)

    def test_the_same_from_messages(self):
        """What the viewer makes of a recorded run is what it drew of it live, at the times of
        fields."""
        listeners = {topic: Listener(topic) for topic in REPLAYED}
        live = self.look()
        node = self.start(dict(ENDLESS, slow_vectors_rate=100.0, field_interval=0.0, pace=10.0))
        self.sees(lambda: len(drawn_as_reported(live, listeners)) >= 5, node, every=0.1)
        node.send(signal.SIGINT)
        node.wait()
        live.viewer.stop()
        for listener in (*listeners.values(), live):
            listener.close()  # what is said again is not heard again
        again = self.look()
        say = self.replay(listeners)
        for time_, original in drawn_as_reported(live, listeners)[:5]:
            with self.subTest(sim_time=time_):
                self.assertTrue(self.comes_to_draw(original, again, say, time_))

    def replay(self, listeners):
        """What says messages of a topic and a time again; run_info is of all times."""
        publishers = {
            topic: rospy.Publisher(
                '/hdlyap/' + topic, harness.TYPES[topic], latch=topic == 'run_info', queue_size=1000
            )
            for topic in listeners
        }
        publishers['run_info'].publish(listeners['run_info'].messages[-1])
        for publisher in publishers.values():
            self.addCleanup(publisher.unregister)
        self.sees(lambda: all(p.get_num_connections() for p in publishers.values()))

        def say(topic, time_):
            for message in listeners[topic].messages:
                if getattr(message, 'sim_time', time_) == time_:
                    publishers[topic].publish(message)

        return say

    def comes_to_draw(self, original, again, say, time_):
        """Topics do not keep step: the first pictures of a time may lack what is said before."""

        def drawn():
            of_time = [p for p in again.all if np.array_equal(places(p), places(original))]
            return of_time and are_alike(of_time[-1], original)

        def said():
            for topic in REPLAYED:
                say(topic, time_)
            return harness.wait_until(drawn, 0.5)

        return harness.wait_until(said)

    def test_what_is_refused(self):
        nine = 'T(1,0) ' * 9
        for name, values in dict(
            modes=('', 'T(1,0', 'T(1,0)x', 'P(1,0)', 'T(1,0),T(2,0)', nine, 3, ['T(1,0)']),
            node=('', 3),
            number=(10,),
        ).items():
            for value in values:
                viewer = harness.start_viewer({name: value})
                self.addCleanup(viewer.end)
                self.ends(viewer, 2)
                self.assertEqual(len(viewer.lines(name + ' = ')), 1, viewer.text())

    def test_named_modes_in_their_order(self):
        pictures = self.look('LP(1,0) T(2,0) T(1,0)')
        self.start(dict(ENDLESS, slow_vectors_count=16))
        self.sees(lambda: pictures.all and len(modes(pictures.all[-1])) == 3)
        self.assertEqual(modes(pictures.all[-1]), ['mode/LP(1,0)', 'mode/T(2,0)', 'mode/T(1,0)'])

    def test_a_mode_that_is_not_looked_for(self):
        """What the viewer advises are parameters of the node."""
        pictures = self.look('T(1,0) LP(9,8)')
        self.start(dict(ENDLESS, max_mode_number=1))
        self.sees(lambda: pictures.viewer.lines('does not look for wave'))
        (line,) = pictures.viewer.lines('does not look for wave (9,8)')
        advised = re.findall(r'[a-z]+(?:_[a-z]+)+|observables', line)
        self.assertEqual(advised, ['max_mode_number', 'max_wave_number', 'observables'])
        asked = [harness.executable(), '--parameters']
        known = subprocess.run(asked, stdout=subprocess.PIPE, text=True, check=True).stdout
        for name in advised:
            self.assertRegex(known, '(?m)^%s:' % name)

    def listeners_of(self, topic):
        state = rosgraph.Master('/test').getSystemState()[1]
        return [name for name in dict(state).get('/hdlyap/' + topic, ()) if name == '/viewer']

    def test_stand_ins_only_without_slow_vectors(self):
        """Topics that a bag has instead are not heard for a moment either: a node would compute
        what is in them."""
        came = []

        class Visitors(rospy.SubscribeListener):
            def peer_subscribe(self, topic, publish, peer_publish):
                came.append(topic.split('/')[-1])

        def publisher(topic, kind, **how):
            made = rospy.Publisher(
                '/hdlyap/' + topic, kind, queue_size=1, subscriber_listener=Visitors(), **how
            )
            self.addCleanup(made.unregister)
            return made

        slow = publisher('slow_vectors', SlowVectors)
        for topic in STAND_INS:
            publisher(topic, harness.TYPES[topic])
        info = publisher('run_info', harness.TYPES['run_info'], latch=True)
        one = Parameter(name='number', value='1', effect='1')
        info.publish(RunInfo(run_id='made up', parameters=[one], box_x=2.0, box_y=2.0))
        pictures = self.look()
        self.sees(lambda: 'slow_vectors' in came and pictures.empty)
        time.sleep(1.5)  # the viewer asks ten times in a second
        self.assertFalse(set(came).intersection(STAND_INS), came)
        slow.unregister()
        self.assertTrue(harness.wait_until(lambda: set(came).issuperset(STAND_INS)), came)

    @harness.SECOND_TIER
    def test_the_node_works_for_who_looks(self):
        """A live node has no fields to make for the viewer, and nothing at all soon after nobody
        looks any more."""
        pictures = self.look()
        self.start(dict(ENDLESS, pace=10.0))
        self.sees(lambda: pictures.all)
        self.sees(lambda: not self.listeners_of('fields'))
        self.assertTrue(self.listeners_of('slow_vectors') and self.listeners_of('steps'))
        pictures.close()
        self.sees(lambda: not self.listeners_of('slow_vectors'))
        self.assertFalse(self.listeners_of('steps') or self.listeners_of('fields'))
        late = Pictures()
        self.addCleanup(late.close)
        self.sees(lambda: len(late.all) > 5)

    def test_watching_the_disks_changes_no_bit(self):
        run = dict(harness.SHORT, duration=4.0, observables=['spectrum', 'state'], pace=4.0)
        alone = harness.whole_run(run, ('spectrum', 'cost'))
        watched = harness.whole_run(run, ('spectrum', 'cost', 'slow_vectors'))
        self.assertGreater(len(watched['slow_vectors']), 3)
        one, other = (
            {m.sim_time: m.exponents for m in each['spectrum']} for each in (alone, watched)
        )
        both = one.keys() & other.keys()  # the first message of a run may be missed
        self.assertGreater(len(both), 1)
        self.assertEqual([one[time] for time in both], [other[time] for time in both])

    @harness.SECOND_TIER
    def test_as_often_as_asked(self):
        """Pictures of the averaging, beside the wall time that they took; before it steps are as
        long as they like."""
        pictures = self.look()
        self.start(dict(ENDLESS, pace=2.0, slow_vectors_rate=10.0))

        def averaging():
            return [p for p in pictures.all if 'averaging' in text(p)]

        self.sees(lambda: len(averaging()) >= 5)
        begin, count = time.monotonic(), len(averaging())
        self.sees(lambda: len(averaging()) >= count + 20)
        self.assertGreater(time.monotonic() - begin, 0.8 * 20 / 10.0)
        times = [float(re.search(r't = ([0-9.]+)', text(p)).group(1)) for p in averaging()[3:]]
        self.assertLess(max(np.diff(times)), 0.9)  # 0.2 apart, but for a busy machine

    @harness.SECOND_TIER
    def test_late_to_a_run_that_rests(self):
        self.start(ENDLESS)
        self.assertTrue(harness.service('pause', SetBool)(True).success)
        time.sleep(0.5)
        pictures = self.look()
        self.sees(lambda: pictures.all, seconds=10)
        # one, or on a busy machine one more for what was heard after it: of one time
        self.assertLessEqual(len(pictures.all), 3)
        for picture in pictures.all[1:]:
            np.testing.assert_array_equal(places(picture), places(pictures.all[0]))

    @harness.SECOND_TIER
    def test_late_to_modes_that_rest(self):
        """Nobody looked when the run was paused: its modes are found, their vectors not known."""
        before = self.look()
        self.start(ENDLESS)
        self.sees(lambda: before.all and len(modes(before.all[-1])) == 2)
        before.viewer.stop()
        before.close()
        time.sleep(1.2)  # a message of less than a second ago is not sent anew
        self.assertTrue(harness.service('pause', SetBool)(True).success)
        late = self.look()
        self.sees(lambda: late.all and not modes(late.all[-1]), seconds=30)
        titles = [
            m.text
            for m in late.all[-1].markers
            if m.ns.startswith('mode/') and m.action == Marker.ADD
        ]
        self.assertEqual(len(titles), 2)
        for title in titles:
            self.assertRegex(title, r'vector \d+ not received')

    @harness.SECOND_TIER
    def test_what_comes_no_more_is_not_shown_as_live(self):
        """Of a node that rests, and of one that was killed; the picture is repeated for who
        looks."""
        pictures = self.look()
        node = self.start(dict(ENDLESS, pace=10.0))

        def stands():
            return re.search(r'nothing new since \d\d:\d\d:\d\d', text(pictures.all[-1]))

        self.sees(lambda: pictures.all)
        self.assertFalse(stands())
        self.assertTrue(harness.service('pause', SetBool)(True).success)
        self.sees(stands)
        count = len(pictures.all)
        self.sees(lambda: len(pictures.all) > count)
        self.assertTrue(harness.service('pause', SetBool)(False).success)
        self.sees(lambda: not stands())
        node.stop()
        self.sees(stands)

    @harness.SECOND_TIER
    def test_no_memory(self):
        """Said again and again, while the program goes on: of the viewer, and of the node."""
        many = dict(ENDLESS, number=20000, aspect=1.0, exponents='none', warmup=0.0, pace=1.0)
        pictures = self.look(probe={'PROBE_GROWTH': '300000'})
        self.start(dict(many, equilibration=0.1))
        params = dict(ENDLESS, slow_vectors_count=117, pace=10.0)
        node = self.start(params, name='short', probe={'PROBE_GROWTH': '100000'})
        self.hear('/short/slow_vectors', SlowVectors)
        for process, said in ((pictures.viewer, 'not drawn'), (node, 'slow_vectors not sent')):
            self.sees(lambda: len(process.lines(said + ': out of memory')) > 1, process)
            self.assertTrue(process.running())
        self.assertEqual(pictures.all, [])

    def test_the_frame_of_the_box_is_known(self):
        frames = self.hear('/tf_static', TFMessage)
        self.look()
        self.sees(lambda: frames)
        transform = frames[0].transforms[0]
        self.assertEqual((transform.header.frame_id, transform.child_frame_id), ('world', 'box'))
        self.assertEqual(transform.transform.rotation.w, 1.0)
        translation = transform.transform.translation
        self.assertEqual((translation.x, translation.y, translation.z), (0, 0, 0))
