"""hdlyap plot --live: what it gathers is what a bag holds, and its window shows it until it is
closed."""

import io
import os
import signal
import time
from unittest import mock

import numpy as np
import rospy
from matplotlib.colors import to_rgb

from hdlyap.follow import live
from hdlyap.follow.gathered import MOST, Gathered
from hdlyap.follow.watch import lazy
from hdlyap.plots.figures.style import BLUE, VERMILION
from hdlyap.plots.window import Window
import harness
import hdlyap
import made
from screen import Screen

pytestmark = harness.UNDER_A_MASTER

PLOT = [*harness.command('plot'), '--live']
HEARD = 'spectrum', 'steps', 'lp_phases', 'status'
GAP = 0.02  # seconds between two messages of a topic: none is replaced by the next
SCENE = dict(harness.MODES, wait_for_subscribers=list(HEARD))  # it runs for moments only
PLACES = 40  # pixels of a colour, if something is drawn with it


class Node:
    """Publishes messages as a node of that name does."""

    def __init__(self, messages, name='/made'):
        self.messages = messages
        kinds = {made.TOPICS[message._type]: type(message) for message in messages}
        self._publishers = {
            topic: rospy.Publisher(f'{name}/{topic}', kind, queue_size=100, latch=True)
            for topic, kind in kinds.items()
        }

    def is_heard(self):
        return all(self._publishers[topic].get_num_connections() for topic in HEARD)

    def publish(self):
        for message in self.messages:
            topic = made.TOPICS[message._type]
            self._publishers[topic].publish(message)
            time.sleep(GAP * (topic == 'spectrum'))

    def close(self):
        for publisher in self._publishers.values():
            publisher.unregister()


def arrays(run):
    """All that the window draws."""
    yield from run.course().values()
    for number in range(len(run.phases.last.phases)):
        for curve in run.phases.curves(number):
            yield from curve
    yield [step.exponent for step in run.steps.steps]
    yield run.spectrum.exponents


class Heard(harness.Case):
    def gathered(self, messages):
        node = Node([made.as_sent(message) for message in messages])
        self.addCleanup(node.close)
        heard = Gathered('/made')
        self.sees(node.is_heard)
        node.publish()
        last = max(m.sim_time for m in messages if made.TOPICS[m._type] == 'lp_phases')
        self.sees(lambda: heard.view().phases and heard.view().phases.sim_time == last)
        return heard

    def test_as_of_a_bag(self):
        """Every array of every figure."""
        messages = made.small_run()
        heard = self.gathered(messages)
        bag = os.path.join(self.new_folder(), 'run.bag')
        made.write(bag, messages)
        live_run, bag_run = heard.run(heard.view().info).summary, hdlyap.load(bag).summary
        ours, theirs = list(arrays(live_run)), list(arrays(bag_run))
        self.assertEqual(len(ours), len(theirs))
        for one, other in zip(ours, theirs):
            np.testing.assert_array_equal(one, other)
        self.assertGreater(len(live_run.course()['time']), 15)

    def test_heard_again(self):
        """A latched message comes once more when rospy has subscribed anew."""
        heard, packed = Gathered('/made'), io.BytesIO()
        made.run_info().serialize(packed)
        message = lazy(type(made.run_info()))().deserialize(packed.getvalue())
        for _ in range(2):
            heard._hear(message, '/made/run_info')
            self.assertIsNotNone(message.unpacked())

    def test_long_run_and_the_next(self):
        """Its reports are thinned out, from the first to the last; another run begins anew."""
        heard = Gathered('/long')  # rospy may still have the last message of '/made'

        def hear(run_id, time):
            packed = io.BytesIO()
            made.spectrum(np.linspace(3, 1, 37), time, run_id=run_id).serialize(packed)
            heard._hear(mock.Mock(data=packed.getvalue()), '/made/spectrum')

        for number in range(1, 3 * MOST + 1):
            hear('one', number)
        times = heard.run(made.run_info()).summary.course()['time']
        self.assertLessEqual(len(times), MOST)
        self.assertGreater(len(times), MOST // 2)
        self.assertEqual((times[0], times[-1]), (1, 3 * MOST))
        hear('two', 5.0)
        self.assertIsNone(heard.run(made.run_info()).summary.spectrum)
        after = heard.run(made.run_info(run_id='two')).summary.course()['time']
        self.assertEqual(list(after), [5.0])


class OnAScreen(harness.Case):
    def setUp(self):
        self.screen = Screen()
        self.addCleanup(self.screen.close)

    def has(self, *colours):
        """Whether something is drawn with each of them."""
        shot = self.screen.shot()
        wanted = np.rint(255 * np.array([to_rgb(colour) for colour in colours]))
        return all((abs(shot - colour).max(axis=2) <= 2).sum() > PLACES for colour in wanted)

    def test_run_is_drawn_and_stays(self):
        """Steps of both kinds, until it is interrupted."""
        node = self.start(SCENE, name='other')  # nobody of this process listens to it
        plot = self.process([*PLOT, 'other'], **self.screen.env)
        self.sees(lambda: self.has(BLUE, VERMILION), plot)
        self.ends(node)
        self.assertTrue(self.has(BLUE, VERMILION))
        self.assertTrue(plot.running())
        self.interrupt(plot, 130)
        self.assertNotIn('Traceback', plot.text())

    def followed(self, deeds):
        """Exit status of a window that does each of these as soon as it says the word to it."""

        class Doing(Window):
            def say(self, words):
                super().say(words)
                if deeds and deeds[0][0] in words:
                    deeds.pop(0)[1](self)

        with mock.patch.dict(os.environ, self.screen.env):
            return live.follow('/hdlyap', Doing('test'))

    def test_closed(self):
        node = self.start(dict(SCENE, duration=0.0))
        self.assertEqual(self.followed([('t = ', Window.close)]), 0)
        deeds = [('t = ', lambda _: node.send(signal.SIGKILL)), (' gone ', Window.close)]
        self.assertEqual(self.followed(deeds), live.WENT_AWAY)


class Refused(harness.Case):
    def test_what_is_missing(self):
        """A screen, tkinter; and bags, which it does not take."""
        folder = self.new_folder()
        with open(os.path.join(folder, 'tkinter.py'), 'w') as file:
            file.write('raise ImportError("not installed")')
        path = os.pathsep.join([folder, os.environ['PYTHONPATH']])
        cases = (
            ([], {'DISPLAY': ''}, 'hdlyap plot: --live needs a screen: '),
            ([], {'PYTHONPATH': path}, 'hdlyap plot: --live needs tkinter (python3-tk): not '),
            (['/hdlyap', '--out', 'a'], {}, 'error: --live takes no bag and no options'),
        )
        started = [self.process([*PLOT, *words], **env) for words, env, _ in cases]
        for plot, (*_, said) in zip(started, cases):
            self.assertEqual(plot.wait(), 2)
            self.assertIn(said, plot.text().splitlines()[-1])
            self.assertNotIn('Traceback', plot.text())
