"""follow: its screen on a terminal, and beside real nodes."""

import os
import signal
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
SCREEN = 'from hdlyap.follow.screen import Screen\nwith Screen() as screen:'
HERE = 'screen.show([[("here", "")]], (80, 24))'


class OnATerminal(unittest.TestCase):
    """Of the terminal alone, without ROS."""

    def program(self, *lines, **size):
        terminal = Terminal([sys.executable, '-c', '\n'.join(lines)], **size)
        self.addCleanup(terminal.stop)
        return terminal

    def screen(self, *lines):
        return self.program(SCREEN, *('    ' + line for line in lines))

    def ends(self, terminal):
        """By its key."""
        terminal.press('q')
        self.assertEqual(terminal.wait(), 0)

    def test_exception(self):
        terminal = self.screen(HERE, 'wrong')
        self.assertEqual(terminal.wait(), 1)
        self.assertTrue(terminal.wait_for("name 'wrong' is not defined"))
        self.assertNotIn('here', '\n'.join(terminal.screen()))
        self.assertTrue(harness.wait_until(terminal.is_as_before))

    def test_suspended_and_continued(self):
        terminal = self.screen('while screen.key(0.1) != "q":', '    ' + HERE)
        self.assertTrue(terminal.wait_for('here'))
        self.assertFalse(terminal.is_as_before())
        terminal.press('\x1a')
        os.waitid(os.P_PID, terminal.process.pid, os.WSTOPPED | os.WNOWAIT)
        self.assertTrue(harness.wait_until(terminal.is_as_before))
        os.kill(terminal.process.pid, signal.SIGCONT)
        self.assertTrue(terminal.wait_for('here'))
        self.ends(terminal)
        self.assertTrue(harness.wait_until(terminal.is_as_before))

    def test_lines_as_wide_as_the_screen(self):
        """Keep their last characters, also on its last line."""
        terminal = self.screen(
            'screen.show([[("wide" * 20, "")]] * 24, screen.size)',
            'screen.key(60)',
            'screen.show([[("less", "")]] * 2, screen.size)',
            'screen.key(60)',
        )
        self.assertTrue(harness.wait_until(lambda: terminal.screen() == ['wide' * 20] * 24))
        terminal.press('q')
        self.assertTrue(harness.wait_until(lambda: terminal.screen()[:2] == ['less'] * 2))
        self.assertEqual(''.join(terminal.screen()[2:]), '')
        self.ends(terminal)

    def test_one_line_in_several(self):
        """On a terminal that is too narrow for it; each overwrites the one before."""
        terminal = self.program(
            'from hdlyap.follow.line import Display',
            'display = Display()',
            'display.show(["averaging", "one " * 9 + "end", "two", "last"])',
            'display.show(["averaging", "2 " * 9 + "end", "two", "3 " * 30 + "last"])',
            'display.close()',
            'display.show(["finished", "two"])',
            'display.close()',
            columns=40,
        )
        self.assertEqual(terminal.wait(), 0)
        self.assertTrue(terminal.wait_for('finished  two'))
        lines = ['averaging  2 2 2 2 2 2 2 2 2 end  two', ' '.join('3' * 20)]
        lines += [' '.join('3' * 10) + ' last', 'finished  two']
        self.assertEqual([line.strip() for line in terminal.screen() if line], lines)
        shown = terminal.output.replace('\r\n', '\n')
        self.assertIn('averaging\033[K\none one', shown)
        self.assertIn('one end\033[K\ntwo  last\033[J\r\033[2A', shown)

    def test_complaints_do_not_reach_the_screen(self):
        terminal = self.screen('import os; os.write(2, b"a complaint")', HERE, 'screen.key(60)')
        self.assertTrue(terminal.wait_for('here'))
        self.assertEqual(terminal.screen(), ['here'])
        self.ends(terminal)
        self.assertTrue(terminal.wait_for('a complaint'))


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
        terminal.press('m')
        self.shows(terminal, ' 116-117 ')
        self.shows(terminal, 'no more steps and phases')
        terminal.press('m')
        self.shows(terminal, 'computed only while somebody listens')
        self.assertEqual(self.listeners(), {'run_info', 'status', 'cost', 'spectrum'})
        said = 'hdlyap follow: no /other that publishes a run_info; there is /hdlyap; waits'
        self.shows(other, said)
        other.press('\x03')
        self.assertEqual(other.wait(), 130)
        terminal.resize(50, 10)
        self.assertTrue(harness.wait_until(lambda: len(terminal.screen()) <= 10))
        terminal.press('\x03')
        self.assertEqual(terminal.wait(), 130)
        self.assertTrue(harness.wait_until(terminal.is_as_before))
        self.shows(terminal, 'lambda_max')

    def test_node_and_master_that_die_and_come_back(self):
        first = self.node(seed='17')
        patient, leaving, line = self.follow(), self.follow(), self.follow('--line')
        for terminal in (patient, leaving):
            self.shows(terminal, 'seed 17')
        self.shows(line, 'averaging')
        first.stop()
        self.assertEqual(line.wait(), 3)
        self.assertNotIn('\033[?', line.output)
        self.shows(leaving, 'GONE  /hdlyap does not answer')
        leaving.press('q')
        self.assertEqual(leaving.wait(), 3)
        self.shows(leaving, 'hdlyap follow: /hdlyap went away before the end of its run')
        self.master.stop()
        self.shows(patient, 'no master  connections from before stay')
        self.addClassCleanup(harness.Master(self.port).stop)
        self.node(seed='18', duration=10.0, **SEEN)
        self.shows(patient, 'seed 18')
        self.shows(patient, 'the run has finished')
        self.assertNotIn('no master', '\n'.join(patient.screen()))
        patient.press('q')
        self.assertEqual(patient.wait(), 0)
        self.assertTrue(harness.wait_until(patient.is_as_before))

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


if __name__ == '__main__':
    unittest.main()
