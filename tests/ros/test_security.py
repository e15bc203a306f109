"""Whatever its parameters and its callers say, the node runs no program, writes no file, opens none
that is not the system's, calls nobody but its master, and prints what it was given as a part of one
line. Watched by strace."""

import os
import re
import socket

import rosgraph
import rospy
from roscpp.srv import SetLoggerLevel
from std_srvs.srv import SetBool, Trigger

import harness
import links
from harness import SHORT

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

CALLS = (
    'open,openat,openat2,creat,execve,execveat,fork,vfork,clone,clone3,unlink,unlinkat,rename,'
    'renameat,renameat2,mkdir,mkdirat,rmdir,symlink,symlinkat,link,linkat,chmod,fchmodat,chown,'
    'truncate,connect,'
    'ptrace,kill,mknod,mknodat'
)
WRITING = re.compile(r'O_WRONLY|O_RDWR|O_CREAT|O_TRUNC|O_APPEND')
# libraries, processors, names of hosts and time zones
SYSTEM = (
    '/etc/ld.so',
    '/etc/host',
    '/etc/nsswitch.conf',
    '/etc/resolv.conf',
    '/etc/gai.conf',
    '/etc/localtime',
    '/etc/ssl/openssl.cnf',
    '/usr/share/locale',
    '/usr/share/zoneinfo',
    '/lib',
    '/usr/lib',
    '/opt/ros',
    '/sys/devices/system',
    '/sys/fs/cgroup',
    '/proc/self',
    '/proc/cpuinfo',
    '/proc/meminfo',
)
FORGED = 'a\n[FATAL] [1.000]: forged'
NASTY = [
    '$(touch nasty)',
    '`touch nasty`',
    '; touch nasty',
    '| touch nasty',
    '../../../etc/passwd',
    '/etc/passwd',
    '%s%s%n%n%x',
    FORGED,
    '\x7f\x9b2Jtitle',
    '{{}}[]<&>"\'\\',
    'x' * 100000,
    'Lyapunov \u03bb \U0001f600',
    'file:///etc/passwd',
    '[a, b',
    ' ',
]
AT_ONCE = 4  # nodes that run at the same time


class Security(harness.Case):
    def watch(self, params):
        """A node, and the file with its calls of the system."""
        folder = self.new_folder()
        trace = os.path.join(folder, 'trace')
        options = ['-s', '200', '-e', 'signal=none', '-e', 'trace=' + CALLS, '-o', trace]
        command = ['strace', '-f', '--seccomp-bpf', '-qq', *options, harness.executable()]
        # roscpp makes its folder of logs below the home where it is told of none
        return self.start(params, command=command, ROS_LOG_DIR=folder), trace

    def check_watched(self, params, status, lines, ours=()):
        """How it ends, with how many lines, and that it writes only these files."""
        node, trace = self.watch(params)
        self.ends(node, status)
        self.check_lines(node, lines)
        self.check_calls(trace, ours)

    def check_all(self, all_params, status, lines):
        for first in range(0, len(all_params), AT_ONCE):
            some = all_params[first : first + AT_ONCE]
            nodes = [self.start(params, name='short_%d' % k) for k, params in enumerate(some)]
            for node, params in zip(nodes, some):
                with self.subTest(params={key: str(value)[:40] for key, value in params.items()}):
                    self.ends(node, status)
                    self.check_lines(node, lines)

    def calls(self, trace):
        """(name, arguments, what it returned) of the program, from its first instruction on."""
        with open(trace, errors='replace') as file:
            text = re.sub(r' <unfinished \.\.\.>', ') = ?', file.read())
        lines = re.findall(r'^\d+ +(\w+)\((.*)\) += (\S+)', text, re.MULTILINE)
        self.assertGreater(len(lines), 50)
        self.assertEqual(lines[0][0], 'execve')
        return lines[1:]

    def check_calls(self, trace, ours=()):
        """ours: files that it may write."""
        master = rosgraph.get_master_uri().rstrip('/').rsplit(':', 1)[1]
        own, restarts, ports = os.path.realpath(harness.executable()), 0, {master}
        for name, arguments, returned in self.calls(trace):
            with self.subTest(name=name, arguments=arguments):
                if name in ('clone', 'clone3'):
                    self.assertIn('CLONE_THREAD', arguments)
                elif name == 'connect' and 'AF_UNIX' not in arguments:
                    ports.add(
                        re.search(r'htons\((\d+)\).*inet_addr\("127\.0\.0\.1"\)', arguments)[1]
                    )
                elif name == 'connect':
                    self.assertIn('nscd', arguments)
                elif name in ('open', 'openat', 'openat2'):
                    self.check_open(arguments, returned, ours)
                elif name in ('rename', 'unlink'):
                    self.assertLessEqual(set(paths_of(arguments)), set(ours))
                else:
                    self.assertEqual((name, paths_of(arguments)[0]), ('execve', own))
                    restarts += 1
        self.assertLessEqual(restarts, 1)  # examples/restart.c
        self.assertLessEqual(len(ports), 2)  # the master's and its own, where it asks itself

    def check_open(self, arguments, returned, ours):
        (path,) = paths_of(arguments)
        built = os.path.dirname(os.path.dirname(os.path.dirname(harness.executable())))
        if WRITING.search(arguments):
            self.assertIn(path, ours)
        elif returned != '-1':
            self.assertTrue(path.startswith(SYSTEM + (built,)) or path in ours)

    def check_lines(self, node, count):
        lines = [line for line in node.text().split('\n') if line]
        self.assertEqual(len(lines), count, node.text())
        for line in lines:
            self.assertRegex(
                line,
                r'^(\x1b\[\d*m)?\[(FATAL|ERROR| WARN| INFO)\] \[[0-9.]{12,}\]: '
                r'[^\x00-\x1f\x7f]*(\x1b\[0m)?$',
            )

    def test_scene(self):
        """The one text that may be any line."""
        lines = [text for text in NASTY if text.isprintable()]
        self.check_all([dict(SHORT, scene=scene) for scene in lines], 0, 4)
        self.check_all([dict(SHORT, scene=text) for text in NASTY if text not in lines], 2, 1)
        self.check_watched(dict(SHORT, scene=' '.join(lines)), 0, 4)

    def test_arguments(self):
        """rosrun can say what XML cannot."""
        for argument in (
            b'_scene:=\xff\xfe\xc3(\x80',
            b'_scene:=\x1b[2J\x1b]0;title\x07',
            b'\x1b[2J\n',
            b'__name:=a\nb',
            b'_a\n:=1',
        ):
            with self.subTest(argument=argument):
                node = self.start(SHORT, args=[argument])
                self.assertIn(node.wait(), (0, 2), node.text())
                self.check_lines(node, 4 if node.wait() == 0 else 1)

    def test_checkpoint(self):
        """The file, its part and its folder; whatever it is called."""
        folder = self.new_folder()
        path = os.path.join(folder, '$(touch nasty); `touch nasty` %s%n ')
        self.check_all([dict(SHORT, checkpoint=path + FORGED)], 2, 1)
        ours = [folder + '/', path, path + '.part']
        self.check_watched(dict(SHORT, checkpoint=path), 0, 5, ours)
        self.check_watched(dict(resume=path, duration=3.0), 0, 5, ours[1:2])
        self.assertEqual(os.listdir(folder), [os.path.basename(path)])

    def test_services(self):
        node, trace = self.watch(dict(SHORT, duration=0.0, pace=20.0))
        for value in (True, False):
            self.assertTrue(harness.service('pause', SetBool)(value).success)
        harness.service('reset_average', Trigger)()
        level = rospy.ServiceProxy('/hdlyap/set_logger_level', SetLoggerLevel)
        for text in NASTY[:10]:
            try:
                level(text, text)
            except rospy.ServiceException:
                pass  # refused
        port = int(rosgraph.Master('/test').lookupService('/hdlyap/pause').rsplit(':', 1)[1])
        for length, data in ((0, b''), (1, b'\xff'), (5, b'abcde'), (0xFFFFFFFF, b'abc')):
            with socket.create_connection(('localhost', port)) as caller:
                caller.sendall(links.pack(dict(callerid='/x', service='/hdlyap/pause', md5sum='*')))
                caller.sendall(links.LENGTH.pack(length) + data)
        self.assertTrue(rospy.ServiceProxy('/hdlyap/pause', SetBool)(False).success)
        os.kill(node_pid(node), 2)
        self.ends(node)
        self.check_calls(trace)


def paths_of(arguments):
    return [
        text.encode().decode('unicode_escape').encode('latin-1').decode()
        for text in re.findall(r'"((?:[^"\\]|\\.)*)"', arguments)
    ]


def node_pid(node):
    """strace keeps signals to itself."""
    with open('/proc/%d/task/%d/children' % (node.process.pid, node.process.pid)) as file:
        return int(file.read().split()[0])
