"""follow: its lines on a terminal, and beside real nodes."""

import os
import sys
import unittest

import harness
import rosgraph
from made import SCRIPTS
from terminal import Terminal

FOLLOW = os.path.join(SCRIPTS, 'hdlyap'), 'follow'
PACED = dict(harness.MODES, equilibration=1.0, warmup=20.0, duration=0.0, pace=100.0)
# a short run does not begin before it is watched
SEEN = dict(wait_for_subscribers=['cost', 'spectrum'])


class OnATerminal(unittest.TestCase):
    def test_one_line_in_several(self):
        """On a terminal that is too narrow for it; each overwrites the one before."""
        program = (
            'from hdlyap.follow.line import Display',
            'display = Display()',
            'display.show(["averaging", "one " * 9 + "end", "two", "last"])',
            'display.show(["averaging", "2 " * 9 + "end", "two", "3 " * 30 + "last"])',
            'display.close()',
            'display.show(["finished", "two"])',
            'display.close()',
            'display.show(["averaging", "4 " * 30 + "end"])',
            'display.say(["a table", "of two lines"])',
            'display.show(["averaging"])',
            'display.close()',
        )
        terminal = Terminal([sys.executable, '-c', '\n'.join(program)], columns=40)
        self.addCleanup(terminal.stop)
        self.assertEqual(terminal.wait(), 0)
        lines = ['averaging  2 2 2 2 2 2 2 2 2 end  two', ' '.join('3' * 20)]
        lines += [' '.join('3' * 10) + ' last', 'finished  two']
        lines += ['a table', 'of two lines', 'averaging']
        harness.wait_until(lambda: terminal.screen()[-1] == 'averaging')
        self.assertEqual([line.strip() for line in terminal.screen() if line], lines)
        shown = terminal.output.replace('\r\n', '\n')
        self.assertIn('averaging\033[K\none one', shown)
        self.assertIn('one end\033[K\ntwo  last\033[J\r\033[2A', shown)


class Running(unittest.TestCase):
    """Beside real nodes, under a master of their own."""

    @classmethod
    def setUpClass(cls):
        cls.port = harness.free_port()
        cls.master = harness.Master(cls.port)
        cls.addClassCleanup(cls.master.stop)
        cls.env = {'ROS_MASTER_URI': cls.master.uri}

    def node(self, **params):
        node = harness.start({**PACED, **params}, **self.env)
        self.addCleanup(node.stop)
        return node

    def follow(self, *arguments, **size):
        terminal = Terminal([sys.executable, *FOLLOW, *arguments], **size, **self.env)
        self.addCleanup(terminal.stop)
        return terminal

    def shows(self, terminal, text):
        self.assertTrue(terminal.wait_for(text), '\n'.join([text, '', *terminal.screen()]))

    def listeners(self):
        """Topics of the node that somebody listens to."""
        _, subscribers, _ = rosgraph.Master('/test', self.master.uri).getSystemState()
        return {
            topic.rpartition('/')[2]
            for topic, names in subscribers
            if topic.startswith('/hdlyap/') and names
        }

    def test_watches_and_is_interrupted(self):
        self.node()
        terminal = self.follow()
        self.shows(terminal, 'computed only while somebody listens')
        self.shows(terminal, 'lambda_max')
        other = self.follow('--node', 'other', '--timeout', '60')  # of a node that is there by now
        self.assertEqual(self.listeners(), {'run_info', 'status', 'cost', 'spectrum'})
        listener = self.follow('--steps')
        self.shows(listener, ' 116-117 ')
        self.assertEqual(self.listeners(), {'run_info', 'status', 'cost', 'spectrum', 'steps'})
        said = 'hdlyap follow: no /other that publishes a run_info; there is /hdlyap; waits'
        self.shows(other, said)
        for one in (listener, terminal, other):
            one.press('\x03')
            self.assertEqual(one.wait(), 130)

    def test_node_and_master_that_die_and_come_back(self):
        first = self.node(seed='17')
        patient, line = self.follow(), self.follow('--line')
        self.shows(patient, 'seed 17')
        self.shows(line, 'averaging')
        first.stop()
        self.assertEqual(line.wait(), 3)
        self.assertNotIn('seed 17', line.output)
        self.shows(line, 'hdlyap follow: /hdlyap went away before the end of its run')
        self.shows(patient, 'GONE: /hdlyap does not answer')
        self.master.stop()
        self.shows(patient, 'no master: connections from before stay')
        self.addClassCleanup(harness.Master(self.port).stop)
        self.node(seed='18', duration=10.0, **SEEN)
        self.shows(patient, 'seed 18')
        self.assertEqual(patient.wait(), 0)
        last = '\n'.join(patient.screen()[-2:])
        self.assertRegex(last, r'^finished  100\.0 %')
        self.assertNotIn('no master', last)

    def test_one_line_until_the_end(self):
        self.node(duration=60.0, **SEEN)
        process = harness.Process([sys.executable, *FOLLOW], **self.env)
        self.addCleanup(process.stop)
        self.assertTrue(
            harness.wait_until(
                lambda: self.listeners() == {'run_info', 'status', 'cost', 'spectrum'}
            )
        )
        self.assertEqual(process.wait(), 0, process.text())
        self.assertRegex(process.text().splitlines()[-1], r'^finished  100\.0 %  t = 81\.0')

    def test_no_node(self):
        terminal = self.follow('--timeout', '5')  # a busy machine needs some to begin
        self.shows(terminal, 'hdlyap follow: no hdlyap_node that publishes a run_info; waits ')
        self.assertEqual(terminal.wait(), 1)
        self.shows(terminal, 'hdlyap follow: no hdlyap_node is running')

    def test_names_that_anybody_gave(self):
        master = rosgraph.Master('/nobody', self.master.uri)
        topic = '/\u202e' + 'n' * 10000 + '/status'
        master.registerPublisher(topic, 'hdlyap/RunStatus', 'http://localhost:1')
        self.addCleanup(master.unregisterPublisher, topic, 'http://localhost:1')
        process = harness.Process(
            [sys.executable, *FOLLOW, '--node', 'other', '--timeout', '3'], **self.env
        )
        self.addCleanup(process.stop)
        self.assertEqual(process.wait(), 1)
        self.assertRegex(process.text(), r'there is /\?n{1990,}\.\.\.; waits')

    def test_says_what_it_waits_for(self):
        """At once, and how to start it; then goes on with what came."""
        port = harness.free_port()
        uri = 'http://localhost:%d' % port
        terminal = Terminal([sys.executable, *FOLLOW], columns=120, ROS_MASTER_URI=uri)
        self.addCleanup(terminal.stop)
        self.shows(terminal, f'hdlyap follow: no master at {uri}; waits ')
        self.shows(terminal, 'To start one: roslaunch hdlyap run.launch')
        self.addCleanup(harness.Master(port).stop)
        self.shows(terminal, 'hdlyap follow: no hdlyap_node that publishes a run_info; waits')
        node = harness.start(PACED, ROS_MASTER_URI=uri)
        self.addCleanup(node.stop)
        self.shows(terminal, 'lambda_max')
