"""What tools do beside their work: the time that is left, and how Ctrl-C ends them."""

import os
import signal
import sys
import unittest

from bags import Bags, process
from terminal import Terminal

PROGRESS = '''
import itertools, time
from hdlyap.progress import Progress
ticks = itertools.count()
time.monotonic = lambda: 0.1 * next(ticks)
for number in Progress('reading').over(range(1000), 1000):
    pass
'''


class Long(unittest.TestCase):
    def test_time_left_on_a_terminal(self):
        """Every step of a thousand takes a tenth of a second of a clock that is made up."""
        terminal = Terminal([sys.executable, '-c', PROGRESS])
        self.addCleanup(terminal.stop)
        self.assertEqual(terminal.wait(), 0)
        self.assertTrue(terminal.wait_for(''))
        # at number 500: 50.1 s are over
        self.assertRegex(terminal.output, 'reading  █{15}░{15}  50 %  0:50 left')
        self.assertEqual(terminal.output[-4:], '\r\033[K')


class Interrupted(Bags):
    def test_while_something_is_imported(self):
        """No traceback of it: ended by the signal."""
        for name in ('rosbag', 'rospy', 'rospkg', 'roslaunch', 'roslib'):
            with open(os.path.join(self.folder, name + '.py'), 'w') as file:
                file.write('import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\n')
                file.write('time.sleep(60)\n')
        path = os.pathsep.join([self.folder, os.environ['PYTHONPATH']])
        words = [['record']]
        words += [['hdlyap', name] for name in ('follow', 'plot', 'replay', 'sweep', 'view')]
        for script, *name in words:
            done = process(*name, script=script, env=dict(os.environ, PYTHONPATH=path))
            self.assertEqual(done, (-signal.SIGINT, '', ''), (script, *name))
