"""Runs that are missing -> their bags: one roslaunch each, wide ones alone, the others side by side."""

import os
import signal
import subprocess
import time

import rosgraph
import rospy

from hdlyap.msg import Cost

from .bag import Bag

POLL = 0.2          # seconds between two looks
PATIENCE = 20.0     # of roslaunch, which gives its nodes 17 s
MASTER = 10.0       # seconds for a master to come up


class WorkError(Exception):
    """One line for the user."""


class Job:
    """One run under way."""

    def __init__(self, run, folder, log):
        self.run, self.folder, self.log = run, folder, log
        self.cost = None        # its last message
        self.began = time.monotonic()
        run.write(folder)
        with open(log, 'w') as file:
            self.process = subprocess.Popen(
                ['roslaunch', 'hdlyap', 'reproduce.launch', f'runs:={run.name}', f'folder:={folder}'],
                stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT, start_new_session=True)
        self._subscriber = rospy.Subscriber(run.node + '/cost', Cost, self._hear, queue_size=10)

    def _hear(self, message):
        self.cost = message

    @property
    def seconds(self):
        return time.monotonic() - self.began

    @property
    def share(self):
        """Of the whole run, in simulated time: 0 .. 1."""
        wanted = self.run.parameters
        whole = wanted['equilibration'] + wanted['warmup'] + wanted['duration']
        return min(1.0, self.cost.sim_time / whole) if self.cost else 0.0

    def has_ended(self):
        return self.process.poll() is not None

    def close(self, commit):
        """After its end: notes it. WorkError if the run did not go to its end."""
        self._subscriber.unregister()
        if not Bag(self.run.bag(self.folder)).is_complete():
            raise WorkError(f'{self.run.name}: the run has not come to its end; {_last_words(self.log)}')
        self.run.note(self.folder, seconds=round(self.seconds, 1), commit=commit)

    def stop(self):
        for number in (signal.SIGINT, signal.SIGKILL):
            if self.has_ended():
                return
            os.killpg(self.process.pid, number)
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                pass


def _last_words(log):
    """Of the node that failed, or where they are."""
    with open(log, errors='replace') as file:
        said = [line.strip() for line in file if 'FATAL' in line or 'ERROR' in line or 'died' in line]
    return (said[0] + '; ' if said else '') + f'all it said is in {log}'


class Master:
    """The ROS master in use; one of our own if there is none."""

    def __init__(self):
        self._own = None
        if not rosgraph.is_master_online():
            port = rosgraph.get_master_uri().rstrip('/').rpartition(':')[2]
            self._own = subprocess.Popen(['roscore', '-p', port], stdin=subprocess.DEVNULL,
                                         stdout=subprocess.DEVNULL, start_new_session=True)
            self._wait()

    def _wait(self):
        end = time.monotonic() + MASTER
        while not rosgraph.is_master_online():
            if time.monotonic() > end or self._own.poll() is not None:
                self.stop()
                raise WorkError(f'no ROS master comes up at {rosgraph.get_master_uri()}')
            time.sleep(POLL)

    def stop(self):
        if self._own and self._own.poll() is None:
            os.killpg(self._own.pid, signal.SIGINT)
            self._own.wait()


def work(runs, folder, logs, jobs, commit, show):
    """Does the runs; show(jobs under way, seconds of work done, of all): called some times a second.
    A run that fails stops none of the others; WorkError at the end names all that did."""
    master = Master()
    waiting, under_way, failed, done = list(runs), [], [], 0.0
    total = sum(run.share_of(jobs) for run in runs)
    try:
        rospy.init_node('reproduce', anonymous=True, disable_signals=True)
        while waiting or under_way:
            while waiting and _has_room(under_way, waiting[0], jobs):
                run = waiting.pop(0)
                under_way.append(Job(run, folder, os.path.join(logs, run.name + '.log')))
            time.sleep(POLL)
            for job in [job for job in under_way if job.has_ended()]:
                under_way.remove(job)
                done += job.run.share_of(jobs)
                failed += _closed(job, commit)
            show(under_way, done + sum(job.share * job.run.share_of(jobs) for job in under_way), total)
    finally:
        for job in under_way:
            job.stop()
        master.stop()
    if failed:
        raise WorkError('\n'.join(failed))


def _has_room(under_way, run, jobs):
    if not under_way:
        return True
    return not run.is_wide and not under_way[0].run.is_wide and len(under_way) < jobs


def _closed(job, commit):
    try:
        job.close(commit)
    except WorkError as error:
        return [str(error)]
    return []
