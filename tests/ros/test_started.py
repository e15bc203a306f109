#!/usr/bin/env python3
"""However a program was started, Ctrl-C or TERM ends it and all that it has started."""

import fcntl
import glob
import os
import signal
import subprocess
import tempfile
import uuid


import harness

COMMON = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../launch/common.sh')
SOON = 12.0  # seconds; roslaunch gives its nodes some
LOOK = 0.05  # seconds between two looks at processes
INT, TERM = signal.SIGINT, signal.SIGTERM
KEPT = ('HOME', 'ROS_MASTER_URI', 'ROS_HOSTNAME', 'ROS_HOME', 'ROS_LOG_DIR', 'TMPDIR')
KEPT += ('HDLYAP_SUITE', 'HDLYAP_MARK')

# as they are started by others: what is put before the command
WAYS = dict(
    background=['perl', '-e', '$SIG{$_} = "IGNORE" for qw(INT QUIT); exec @ARGV', '--'],
    nohup=['nohup'],
    ssh=['setsid', '--wait'],
    docker=['unshare', '--pid', '--fork', '--mount-proc', '--kill-child'],
    systemd=[],  # asks each process of the unit
    cron=[],  # has nearly no environment
)
BOTH = [(way, number) for way in WAYS for number in (INT, TERM)]
SOME = [('background', INT), ('docker', TERM), ('cron', INT)]
TREES = [('background', INT), ('docker', TERM), ('systemd', TERM)]

SCRIPT = '''#!/usr/bin/env bash
set -euo pipefail
source "{common}"
stop_at_exit
echo ready
run sleep 1000
'''


def cron():
    """With what a line of a crontab does first."""
    setup = os.path.join(os.environ['CMAKE_PREFIX_PATH'].split(':')[0], 'setup.bash')
    kept = ['%s=%s' % (name, os.environ[name]) for name in KEPT if name in os.environ]
    kept += ['PATH=/usr/bin:/bin', 'SHELL=/bin/sh', 'LOGNAME=somebody']
    return ['env', '-i', *kept, 'bash', '-c', '. "$0"; exec "$@"', setup]


def can_be_docker():
    return subprocess.run([*WAYS['docker'], 'true'], stderr=subprocess.DEVNULL).returncode == 0


class Started(harness.Case):
    def setUp(self):
        self.mark = os.environ['HDLYAP_MARK'] = uuid.uuid4().hex
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.number = 0

    def path(self, name):
        return os.path.join(self.folder, name)

    def ours(self, mark):
        """Processes that this one has started, and theirs; no zombies."""
        found = []
        for folder in glob.glob('/proc/[0-9]*'):
            try:
                with open(folder + '/environ', 'rb') as file:
                    if b'HDLYAP_MARK=' + mark.encode() in file.read().split(b'\0'):
                        found.append(int(folder[6:]))
            except OSError:
                pass  # has ended
        return [pid for pid in found if pid != os.getpid()]

    def start(self, way, command):
        prefix = cron() if way == 'cron' else WAYS[way]
        process = harness.Process([*prefix, *command])
        self.addCleanup(process.stop)
        process.mark = os.environ['HDLYAP_MARK']
        return process

    def main_of(self, way, process):
        """The process that is asked to end, within what has started it."""
        if way not in ('docker', 'ssh'):
            return process.process.pid
        below = subprocess.run(
            ['pgrep', '-P', str(process.process.pid)], stdout=subprocess.PIPE, text=True
        ).stdout.split()
        return int(below[0]) if below else process.process.pid

    def check(self, cases, command, is_ready):
        """All at once: starts, waits until each is ready, asks each, and nothing is left."""
        cases = [case for case in cases if case[0] != 'docker' or can_be_docker()]
        some = []
        for way, number in cases:
            self.number += 1
            os.environ['HDLYAP_MARK'] = '%s_%d' % (self.mark, self.number)
            some.append(self.start(way, command(self.number)))
        for (way, number), process in zip(cases, some):
            ready = harness.wait_until(lambda: is_ready(process), every=LOOK)
            self.assertTrue(ready, (way, process.text()))
        for (way, number), process in zip(cases, some):
            everybody = self.ours(process.mark) if way == 'systemd' else []
            for pid in everybody or [self.main_of(way, process)]:
                os.kill(pid, number)
        for (way, number), process in zip(cases, some):
            with self.subTest(way=way, signal=number.name):
                ended = harness.wait_until(lambda: not process.running(), SOON, LOOK)
                self.assertTrue(ended, process.text())
                self.assertNotEqual(process.wait(), -signal.SIGKILL)
                left = harness.wait_until(lambda: not self.ours(process.mark), 3.0, LOOK)
                self.assertTrue(left, self.ours(process.mark))
            for pid in self.ours(process.mark):
                os.kill(pid, signal.SIGKILL)

    # ---- programs --------------------------------------------------------------------------------

    def test_node(self):
        quiet = ['_disks:=20', '_density:=0.5', '_exponents:=none', '_pace:=1.0']
        self.check(
            BOTH,
            lambda k: [harness.executable(), '__name:=n%d' % k, *quiet],
            lambda node: node.lines('scene unnamed'),
        )

    def test_follow(self):
        node = harness.start(dict(harness.SHORT, duration=0.0, pace=1.0), name='followed')
        self.addCleanup(node.stop)
        self.check(
            SOME,
            lambda k: [*harness.command('follow'), '--line', '--node', '/followed'],
            lambda follow: follow.lines('  t = '),
        )

    def test_follow_without_a_master(self):
        gone = 'ROS_MASTER_URI=http://localhost:%d' % harness.free_port()
        self.check(
            SOME,
            lambda k: ['env', gone, *harness.command('follow'), '--line'],
            lambda follow: follow.lines('follow: no master at'),
        )

    def test_view(self):
        self.check(
            SOME[:2],
            lambda k: [*harness.command('view'), '--node', '/nowhere'],
            lambda view: view.lines('waiting for pictures'),
        )

    def test_tools_that_read(self):
        """A bag whose first reader has to wait: the kernel asks for its lease back, in vain."""
        leases = {}
        self.addCleanup(signal.signal, signal.SIGIO, signal.signal(signal.SIGIO, signal.SIG_IGN))

        def is_read(process):
            file = leases[process.mark.split('_')[1]]
            return fcntl.fcntl(file, fcntl.F_GETLEASE) != fcntl.F_WRLCK

        for name in ('repeat', 'plot'):

            def command(k):
                file = leases[str(k)] = open(self.path('%d.bag' % k), 'w')
                self.addCleanup(file.close)
                fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_WRLCK)
                return [*harness.command(name), file.name]

            self.check([('background', INT), ('docker', TERM)], command, is_read)

    def test_script(self):
        path = self.path('script.sh')
        with open(path, 'w') as file:
            file.write(SCRIPT.format(common=COMMON))
        os.chmod(path, 0o755)
        self.check(BOTH, lambda k: [path], lambda script: script.lines('ready'))

    def test_launch(self):
        def command(k):
            bag = self.path('%d.bag' % k)
            scene = ['scene:=quick', 'duration:=0.0', 'pace:=5.0', 'record:=true', 'bag:=' + bag]
            return ['roslaunch', '-p', str(harness.free_port()), 'hdlyap', 'run.launch', *scene]

        def records(launch):
            return glob.glob(self.path(launch.mark.split('_')[1] + '.bag.active'))

        self.check(TREES, command, records)

    def test_reproduce(self):
        def command(k):
            out = ['--quick', '--part', '1', '--jobs', '1', '--out', self.path('out%d' % k)]
            own = 'ROS_MASTER_URI=http://localhost:%d' % harness.free_port()
            return ['env', own, harness.program('reproduce'), *out]

        def command_of(pid):
            try:
                with open('/proc/%d/cmdline' % pid, 'rb') as file:
                    return file.read()
            except OSError:  # it has ended meanwhile
                return b''

        def runs(process):
            return any(b'hdlyap_node' in command_of(pid) for pid in self.ours(process.mark))

        self.check([('background', INT)], command, runs)


if __name__ == '__main__':
    harness.main('started')
