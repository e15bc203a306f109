#!/usr/bin/env python3
"""Whatever its parameters and its callers say, the node runs no program, writes no file, opens none that is not
the system's, calls nobody but its master, and prints what it was given as a part of one line. Watched by
strace."""

import os
import re
import socket
import tempfile
import unittest

import rosgraph
import rospy
import rostest
from roscpp.srv import SetLoggerLevel
from std_srvs.srv import SetBool, Trigger

import harness
import links
from harness import SHORT

CALLS = ('open,openat,openat2,creat,execve,execveat,fork,vfork,clone,clone3,unlink,unlinkat,rename,renameat,'
         'renameat2,mkdir,mkdirat,rmdir,symlink,symlinkat,link,linkat,chmod,fchmodat,chown,truncate,connect,'
         'ptrace,kill,mknod,mknodat')
WRITING = re.compile(r'O_WRONLY|O_RDWR|O_CREAT|O_TRUNC|O_APPEND')
# libraries, processors, names of hosts and time zones
SYSTEM = ('/etc/ld.so', '/etc/host', '/etc/nsswitch.conf', '/etc/resolv.conf', '/etc/gai.conf',
          '/etc/localtime', '/etc/ssl/openssl.cnf', '/usr/share/zoneinfo', '/lib', '/usr/lib', '/opt/ros',
          '/sys/devices/system', '/sys/fs/cgroup', '/proc/self', '/proc/cpuinfo', '/proc/meminfo')
FORGED = 'a\n[FATAL] [1.000]: forged'
NASTY = ['$(touch nasty)', '`touch nasty`', '; touch nasty', '| touch nasty', '../../../etc/passwd',
         '/etc/passwd', '%s%s%n%n%x', FORGED, '\r\x1b[2J\x1b]0;title\x07\x7f', '{{}}[]<&>"\'\\',
         'x' * 100000, 'Lyapunov \u03bb \U0001f600', 'file:///etc/passwd', '[a, b', ' ']
PARAMETERS = ['disks', 'density', 'aspect', 'boundary_x', 'boundary_y', 'seed', 'exponents', 'equilibration',
              'warmup', 'duration', 'target_std_error', 'interval', 'accuracy', 'report_interval',
              'max_wave_number', 'max_node', 'field_indices', 'observables', 'threads',
              'wait_for_subscribers', 'pace']


class Security(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.trace = os.path.join(folder.name, 'trace')
        self.before = ['strace', '-f', '-qq', '-s', '200', '-e', 'trace=' + CALLS, '-e', 'signal=none', '-o', self.trace]

    def start(self, params, **kw):
        node = harness.start(params, before=self.before, **kw)
        self.addCleanup(node.stop)
        return node

    def calls(self):
        """(name, arguments, what it returned) of the program, from its first instruction on."""
        with open(self.trace, errors='replace') as file:
            text = re.sub(r' <unfinished \.\.\.>', ') = ?', file.read())
        lines = re.findall(r'^\d+ +(\w+)\((.*)\) += (\S+)', text, re.MULTILINE)
        self.assertGreater(len(lines), 50)
        self.assertEqual(lines[0][0], 'execve')
        return lines[1:]

    def check_calls(self):
        ours = os.path.dirname(os.path.dirname(os.path.dirname(harness.executable())))
        master = rosgraph.get_master_uri().rstrip('/').rsplit(':', 1)[1]
        restarts = 0
        for name, arguments, returned in self.calls():
            with self.subTest(name=name, arguments=arguments):
                if name in ('clone', 'clone3'):
                    self.assertIn('CLONE_THREAD', arguments)
                elif name == 'connect':
                    self.assertRegex(arguments, r'htons\(%s\)|AF_UNIX.*nscd' % master)
                elif name in ('open', 'openat', 'openat2'):
                    self.check_open(arguments, returned, ours)
                else:
                    self.assertEqual((name, '"/proc/self/exe"' in arguments), ('execve', True))
                    restarts += 1
        self.assertLessEqual(restarts, 1)   # hd_blas_restart_if_slow

    def check_open(self, arguments, returned, ours):
        self.assertIsNone(WRITING.search(arguments))
        path = re.search(r'"([^"]*)"', arguments).group(1)
        if returned != '-1':
            self.assertTrue(path.startswith(SYSTEM + (ours,)))

    def check_lines(self, node, count):
        lines = [line for line in node.text().split('\n') if line]
        self.assertEqual(len(lines), count, node.text())
        for line in lines:
            self.assertRegex(line, r'^(\x1b\[\d*m)?\[(FATAL|ERROR| WARN| INFO)\] \[[0-9.]{12,}\]: '
                                   r'[^\x00-\x1f\x7f]*(\x1b\[0m)?$')

    def test_scene(self):
        """The one text that may be anything."""
        for scene in NASTY:
            with self.subTest(scene=scene[:40]):
                info = harness.Listener('run_info')
                node = self.start(dict(SHORT, scene=scene, wait_for_subscribers=['run_info']))
                self.assertEqual(node.wait(), 0, node.text())
                self.assertTrue(info.wait_for(lambda message: True))
                info.close()
                self.assertEqual(info.messages[0].scene, scene)
                self.check_lines(node, 3)
                self.check_calls()
                if '%' in scene:
                    self.assertIn('scene %s: ' % scene, node.text())

    def test_every_parameter(self):
        for k, name in enumerate(PARAMETERS):
            for value in (FORGED, NASTY[k % len(NASTY)]):
                with self.subTest(name=name, value=value[:40]):
                    node = self.start(dict(SHORT, **{name: value}))
                    self.assertEqual(node.wait(), 2, node.text())
                    self.check_lines(node, 1)
                    self.check_calls()

    def test_names(self):
        for name in (FORGED, '%s%n', '../x', '$(touch nasty)'):
            with self.subTest(name=name):
                node = self.start(dict(SHORT, **{name: 1}))
                self.assertEqual(node.wait(), 2, node.text())
                self.check_lines(node, 1)
                self.check_calls()

    def test_invalid_utf8(self):
        """Only rosrun can say it: XML cannot."""
        node = self.start(SHORT, args=[b'_scene:=\xff\xfe\xc3(\x80'])
        self.assertIn(node.wait(), (0, 2), node.text())
        self.check_calls()

    def test_services(self):
        node = self.start(dict(SHORT, duration=0.0, pace=20.0))
        rospy.wait_for_service('/hdlyap/reset_average', harness.PATIENCE)
        for value in (True, False):
            self.assertTrue(rospy.ServiceProxy('/hdlyap/pause', SetBool)(value).success)
        rospy.ServiceProxy('/hdlyap/reset_average', Trigger)()
        level = rospy.ServiceProxy('/hdlyap/set_logger_level', SetLoggerLevel)
        for text in NASTY[:10]:
            try:
                level(text, text)
            except rospy.ServiceException:
                pass    # refused
        port = int(rosgraph.Master('/test').lookupService('/hdlyap/pause').rsplit(':', 1)[1])
        for length, data in ((0, b''), (1, b'\xff'), (5, b'abcde'), (0xffffffff, b'abc')):
            with socket.create_connection(('localhost', port)) as caller:
                caller.sendall(links.pack(dict(callerid='/x', service='/hdlyap/pause', md5sum='*')))
                caller.sendall(links.LENGTH.pack(length) + data)
        self.assertTrue(rospy.ServiceProxy('/hdlyap/pause', SetBool)(False).success)
        rosgraph.Master('/test')
        os.kill(node_pid(node), 2)
        self.assertEqual(node.wait(), 0, node.text())
        self.check_calls()


def node_pid(node):
    """strace keeps signals to itself."""
    with open('/proc/%d/task/%d/children' % (node.process.pid, node.process.pid)) as file:
        return int(file.read().split()[0])


if __name__ == '__main__':
    rospy.init_node('test_security')
    rostest.rosrun('hdlyap', 'security', Security)
