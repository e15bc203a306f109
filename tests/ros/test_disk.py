"""Checkpoints on a disk that is full, or was never to be written to, or in a process that is
killed: what has been written stays whole, what cannot be is named, and the run goes on."""

import fcntl
import os
import random
import resource
import shutil
import signal
import subprocess
import tempfile
import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
import rospy

import harness

pytestmark = [harness.UNDER_A_MASTER, harness.SECOND_TIER]


FILE_FAULT = 4  # exit status
AT_ONCE = 4  # nodes that run at the same time
KILLS = 60
# all that a file can hold, 200 kB of it
KEPT = dict(
    number=60,
    density=0.8,
    aspect=0.06,
    equilibration=1.0,
    warmup=2.0,
    duration=0.0,
    threads=1,
    pace=100.0,
    checkpoint_interval=1.0e-3,
)


def small_disk(folder, bytes_):
    """Before the node: a file system of its own, which nobody else sees; None where that is not
    allowed."""
    for unshare in (['unshare', '-m'], ['unshare', '-rm']):
        if (
            subprocess.run(
                unshare + ['mount', '-t', 'tmpfs', 'tmpfs', folder], stderr=subprocess.DEVNULL
            ).returncode
            == 0
        ):
            mount = 'mount -t tmpfs -o size=%d tmpfs %s && exec "$@"' % (bytes_, folder)
            return unshare + ['sh', '-c', mount, 'sh']
    return None


def written(path):
    """Something that tells two writings of a file apart; None if there is none."""
    try:
        found = os.stat(path)
    except FileNotFoundError:
        return None
    return found.st_ino, found.st_mtime_ns


def goes_on(node):
    return bool(node.lines('goes on from simulated time'))


class Disk(harness.Case):
    def setUp(self):
        self.folder = self.new_folder()

    def path(self, name='run.checkpoint'):
        return os.path.join(self.folder, name)

    def written_again(self, node, path):
        now = written(path)
        self.sees(lambda: written(path) not in (None, now), node)

    def resumes(self, path):
        node = self.start(dict(resume=path))
        self.sees(lambda: node.lines('goes on from simulated time') or not node.running(), node)
        self.interrupt(node)
        self.assertEqual(len(node.lines('goes on from simulated time')), 1, node.text())

    def diagnostic(self, message):
        status = rospy.wait_for_message('/diagnostics', DiagnosticArray, harness.PATIENCE).status[0]
        return (status.level, message in status.message) == (DiagnosticStatus.ERROR, True)

    def fill(self, path, condition):
        """A part that is given up makes room again."""

        def more():
            try:
                while True:
                    filler.write(bytes(4096))
            except OSError:
                return condition()

        with open(path, 'wb', buffering=0) as filler:
            self.sees(more)

    def check_full(self, node, message):
        """It says so, twice over, and goes on; at its end, too."""
        self.sees(lambda: node.lines('checkpoint not written'), node)
        self.assertIn(message, node.lines('checkpoint not written')[0])
        self.sees(lambda: self.diagnostic(message), node)

    # ---- full disks ----

    def test_full_disk(self):
        disk = small_disk(self.folder, 2 << 20)
        if disk is None:
            print('no file system of its own here: only the limit of a file is tested')
            return
        node = self.start(dict(KEPT, checkpoint=self.path()), command=[*disk, harness.executable()])

        def seen(name):
            return '/proc/%d/root%s' % (node.process.pid, self.path(name))

        self.sees(lambda: written(seen('run.checkpoint')), node)
        self.fill(seen('filler'), lambda: node.lines('checkpoint not written'))
        self.check_full(node, 'No space left on device')
        copy = tempfile.NamedTemporaryFile()
        self.addCleanup(copy.close)
        shutil.copyfile(seen('run.checkpoint'), copy.name)
        self.sees(
            lambda: 'run.checkpoint.part' not in os.listdir(seen('')), node
        )  # between two attempts
        os.unlink(seen('filler'))
        self.sees(lambda: node.lines('checkpoint written again'), node)
        self.interrupt(node)
        self.resumes(copy.name)

    def test_no_room_at_the_start(self):
        """The first file is written before the run."""
        info = self.listen('run_info')
        node = self.start(
            dict(KEPT, checkpoint=self.path()),
            command=['prlimit', '--fsize=100000', harness.executable()],
        )
        self.ends(node, FILE_FAULT)
        self.assertEqual(len(node.lines('File too large')), 1, node.text())
        self.assertEqual((os.listdir(self.folder), info.messages), ([], []))

    def test_limit_of_a_file(self):
        node = self.start(dict(KEPT, checkpoint=self.path()))
        self.sees(lambda: written(self.path()), node)
        resource.prlimit(node.process.pid, resource.RLIMIT_FSIZE, (50000, resource.RLIM_INFINITY))
        self.check_full(node, 'File too large')
        before = written(self.path())
        self.interrupt(node, FILE_FAULT)
        self.assertEqual(written(self.path()), before)
        self.assertEqual(os.listdir(self.folder), ['run.checkpoint'])
        self.resumes(self.path())

    # ---- others ----

    def goes_on_beyond(self, sim_time):
        status = self.listen('status')
        self.assertTrue(status.wait_for(lambda message: message.sim_time > sim_time))

    def test_touched_and_rewritten(self):
        """The name is still that of the run's own file."""
        path = self.path()
        node = self.start(dict(KEPT, checkpoint=path))
        self.sees(lambda: written(path), node)
        os.utime(path)
        self.written_again(node, path)
        with open(path, 'r+b') as file:
            whole = file.read()
            file.seek(0)
            file.write(whole)
        self.written_again(node, path)
        self.interrupt(node)
        self.assertFalse(node.lines('checkpoint not written'), node.text())
        self.resumes(path)

    def test_somebody_locks_the_folder(self):
        folder = os.open(self.folder, os.O_RDONLY)
        self.addCleanup(os.close, folder)
        fcntl.flock(folder, fcntl.LOCK_EX)
        node = self.start(dict(KEPT, checkpoint=self.path(), checkpoint_interval=0.0))
        self.sees(lambda: written(self.path()), node)
        first = written(self.path())
        self.goes_on_beyond(2.0)
        with harness.within(self, 9.0):
            self.interrupt(node)
        self.assertNotEqual(written(self.path()), first)
        self.assertFalse(node.lines('the checkpoint is not of the end'), node.text())

    def test_the_disk_does_not_answer(self):
        """Named, with the status of a file that could not be written; the one of before stays."""
        node = self.start(
            dict(KEPT, checkpoint=self.path(), checkpoint_interval=0.0),
            probe={'PROBE_FSYNC_AFTER': '2'},
        )
        self.sees(lambda: written(self.path()), node)
        self.goes_on_beyond(2.0)
        self.interrupt(node, FILE_FAULT)
        self.assertEqual(len(node.lines('the disk does not answer')), 1, node.text())
        os.remove(self.path('run.checkpoint.part'))
        self.resumes(self.path())

    # ---- killed ----

    def test_killed_at_any_moment(self):
        """Again and again; each time it goes on from what the one before has left."""
        randomly = random.Random(5)
        rounds = KILLS // AT_ONCE
        paths = [self.path('run_%d' % k) for k in range(AT_ONCE)]
        for number in range(rounds):
            there = [os.path.exists(path) for path in paths]
            self.assertTrue(number == 0 or all(there))
            nodes = [
                self.start(
                    dict(KEPT, checkpoint=path, **(dict(resume=path) if before else {})),
                    name='killed_%d' % k,
                )
                for k, (path, before) in enumerate(zip(paths, there))
            ]
            left = [written(path) for path in paths]
            for node, path, before in zip(nodes, paths, left):
                self.sees(lambda: written(path) != before or not node.running(), node)
            said = (
                number % 2
            )  # every other time it may be killed between its first writing and the line about it
            for node, before in zip(nodes, there):
                self.sees(
                    lambda: not (said and before) or goes_on(node) or not node.running(), node
                )
            time.sleep(randomly.uniform(0.0, 0.03))
            for node, before in zip(nodes, there):
                self.assertTrue(node.running(), node.text())
                node.send(signal.SIGKILL)
                self.assertEqual(node.wait(), -signal.SIGKILL)
                if said or not before:
                    self.assertEqual(goes_on(node), before)
        for path in paths:
            self.resumes(path)
