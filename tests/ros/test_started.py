"""However a program was started, Ctrl-C or TERM ends it and all that it has started."""

import fcntl
import glob
import os
import signal
import subprocess

import harness
from harness import POLL, SOON

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]

COMMON = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../launch/common.sh')
INT, TERM = signal.SIGINT, signal.SIGTERM
KEPT = ('HOME', 'ROS_MASTER_URI', 'ROS_HOSTNAME', 'ROS_HOME', 'ROS_LOG_DIR', 'TMPDIR')
KEPT += ('HDLYAP_SUITE', 'HDLYAP_MARK', 'HDLYAP_NUMBER')

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


class Started(harness.Traced, harness.Case):
    def setUp(self):
        self.trace()
        self.folder = self.new_folder()
        self.number = 0

    def path(self, name):
        return os.path.join(self.folder, name)

    def alive(self, process):
        """It, and what it has started."""
        return self.ours(variable=process.number)

    def start(self, way, command):
        """All that is started has the mark and a number in its environment."""
        self.number += 1
        number = str(self.number)
        os.environ.update(HDLYAP_MARK=self.mark, HDLYAP_NUMBER=number)  # cron keeps these, too
        prefix = cron() if way == 'cron' else WAYS[way]
        process = self.process([*prefix, *command(self.number)])
        process.number = 'HDLYAP_NUMBER=' + number
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
        some = [self.start(way, command) for way, _ in cases]
        for process in some:
            self.sees(lambda: is_ready(process), process, every=POLL)
        for (way, number), process in zip(cases, some):
            everybody = self.alive(process) if way == 'systemd' else []
            for pid in everybody or [self.main_of(way, process)]:
                os.kill(pid, number)
        for (way, number), process in zip(cases, some):
            with self.subTest(way=way, signal=number.name):
                self.assertNotEqual(process.wait(SOON), -signal.SIGKILL)
                self.sees(lambda: not self.alive(process), process, every=POLL)

    # ---- programs --------------------------------------------------------------------------------

    def test_node(self):
        quiet = ['_number:=20', '_density:=0.5', '_exponents:=none', '_pace:=1.0']
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
            lambda k: ['env', 'DISPLAY=:0', *harness.command('view'), '--node', '/nowhere'],
            lambda view: view.lines('waiting for pictures'),
        )

    def test_tools_that_read(self):
        """A bag whose first reader has to wait: the kernel asks for its lease back, in vain."""
        leases = {}
        self.addCleanup(signal.signal, signal.SIGIO, signal.signal(signal.SIGIO, signal.SIG_IGN))

        def is_read(process):
            file = leases[process.number]
            return fcntl.fcntl(file, fcntl.F_GETLEASE) != fcntl.F_WRLCK

        def command(k):
            file = leases['HDLYAP_NUMBER=%d' % k] = open(self.path('%d.bag' % k), 'w')
            self.addCleanup(file.close)
            fcntl.fcntl(file, fcntl.F_SETLEASE, fcntl.F_WRLCK)
            return [*harness.command('plot'), file.name]

        self.check(SOME[:2], command, is_read)

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
            return glob.glob(self.path(launch.number.split('=')[1] + '.bag.active'))

        self.check(TREES, command, records)
