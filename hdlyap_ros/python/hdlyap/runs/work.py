"""Runs that are not done -> their bags. Each run is a roslaunch. Runs that use all cores are alone,
the others side by side."""

import contextlib
import fcntl
import glob
import os
import re
import shutil
import time

import rospy

from hdlyap import signals
from hdlyap.msg import RunStatus

from . import bags
from .display import Display
from .master import Master, MasterError, leave
from .run import complete
from .tree import Tree, end

POLL = 0.2  # seconds between two looks
PATIENCE = 20.0  # seconds in which roslaunch has to end; it gives its nodes 17
SILENCE = 180.0  # seconds in which a node, which waits for its recorder, has to say something
UNDER_WAY = 'under_way'  # folder of bags that are being recorded
SAID = re.compile('FATAL|ERROR')
DIED = re.compile(r'process has died \[[^\]]*?(?=, cmd|\])')
COLOUR = re.compile('\033' + r'\[[0-9;]*m')


class WorkError(Exception):
    """The text has a line for each run that failed."""


class Job:
    """A run under way. It records into a separate folder, so that an incomplete bag replaces
    nothing."""

    def __init__(self, run, folder, log, min_space):
        self.run, self.log = run, log
        self._folder = folder
        self._new = os.path.join(folder, UNDER_WAY, f'{run.name}.{os.getpid()}')
        self.status = None  # the last message
        self._began = time.monotonic()
        os.makedirs(self._new, exist_ok=True)
        run.write(folder)
        run.write(self._new)
        topic = run.node + '/status'
        self._subscriber = rospy.Subscriber(topic, RunStatus, self._hear, queue_size=10)
        words = [f'__ns:={run.name}', f'scene:={run.scene_file(self._new)}', 'record:=true']
        words += [f'bag:={run.bag(self._new)}', f'min_space:={min_space}', 'table:=0']
        with open(log, 'w') as file:
            self.tree = Tree(['roslaunch', 'hdlyap', 'run.launch', *words], file)

    def _hear(self, message):
        self.status = message

    @property
    def seconds(self):
        return time.monotonic() - self._began

    @property
    def share(self):
        """The part of the run that is done, 0 .. 1."""
        return self.run.share_done(self.status)

    def has_ended(self):
        return self.tree.has_ended()

    def is_silent(self):
        return self.status is None and self.seconds > SILENCE

    def close(self):
        """Takes the bag, if it is complete, after the processes have ended. Raises WorkError if it
        is not, or if its run is not the one that was asked for."""
        there = complete(self.run.bag(self._new))
        why = self.run.lacking(there)
        try:
            if there:
                keep(self.run.bag(self._folder))
                os.rename(self.run.bag(self._new), self.run.bag(self._folder))
        except (bags.InUse, OSError) as error:
            why = f'its bag is still in {self._new}: {error}'
        if why and not there and self.is_silent():
            why = f'no message of its node within {SILENCE:.0f} s'
        if why:
            said = f'{last_words(self.log)}all its output is in {self.log}'
            raise WorkError(f'{self.run.name}: {why}; {said}')

    def leave(self):
        """Removes all but the log, and bags that are complete."""
        if not any(map(complete, glob.glob(os.path.join(glob.escape(self._new), '*.bag*')))):
            shutil.rmtree(self._new, ignore_errors=True)
        with contextlib.suppress(OSError):
            os.rmdir(os.path.dirname(self._new))  # succeeds after the last run
        self._subscriber.unregister()


def keep(path, why=''):
    """Renames bags that have this name, and says why."""
    for line in bags.keep(path):
        print(f'hdlyap sweep: {line}{why}', flush=True)


def last_words(log):
    """Why a run failed: the last line of level ERROR or FATAL, otherwise the death of a process."""
    with open(log, errors='replace') as file:
        lines = [COLOUR.sub('', line).strip() for line in file]
    errors = [line for line in lines if SAID.search(line)]
    deaths = [match.group() + ']' for match in map(DIED.search, lines) if match]
    last = (errors or deaths)[-1:]
    return ''.join(line + '; ' for line in last)


class Work:
    """Does runs, as many at a time as there is room for."""

    def __init__(self, runs, folder, logs, jobs, min_space):
        self.waiting, self.under_way, self.failed = list(runs), [], []
        self._folder, self._logs, self._jobs, self._min_space = folder, logs, jobs, min_space
        self._total, self._done = sum(run.share_of(jobs) for run in runs), 0.0

    def progress(self):
        """(seconds of work that is done, seconds of all work)"""
        of_jobs = sum(job.share * job.run.share_of(self._jobs) for job in self.under_way)
        return self._done + of_jobs, self._total

    def begin(self):
        """Starts as many runs as there is room for."""
        while self.waiting and self._has_room():
            run = self.waiting.pop(0)
            log = os.path.join(self._logs, run.name + '.log')
            self.under_way.append(Job(run, self._folder, log, self._min_space))

    def _has_room(self):
        if not self.under_way:
            return True
        is_wide = self.waiting[0].is_wide or self.under_way[0].run.is_wide
        return not is_wide and len(self.under_way) < self._jobs

    def close(self):
        """Closes runs that have ended. Returns a line for each that has failed."""
        said = []
        for job in [job for job in self.under_way if job.has_ended() or job.is_silent()]:
            self._end([job])
            try:
                job.close()
            except WorkError as error:
                said.append(str(error))
            self._done += job.run.share_of(self._jobs)
            self.under_way.remove(job)
            job.leave()
        self.failed += said
        return said

    def stop(self, came):
        """Ends all runs that are under way. came: signals that have come; another one kills
        them."""
        before = len(came)
        self._end(self.under_way, lambda: len(came) > before)
        for job in self.under_way:
            with contextlib.suppress(WorkError):
                job.close()  # it may just have reached its end
            job.leave()

    @staticmethod
    def _end(jobs, is_pressed=lambda: False):
        end([job.tree for job in jobs], PATIENCE, is_pressed)


def do(runs, folder, jobs, min_space):
    """Does the runs that are not done. Returns a line for each that has failed. Raises WorkError if
    somebody else does runs in this folder."""
    logs = os.path.join(folder, 'log')
    os.makedirs(logs, exist_ok=True)
    with open(os.path.join(logs, '.lock'), 'w') as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise WorkError(f'another sweep does the runs of {folder}')
        except OSError:
            pass  # the file system has no locks
        todo = _missing(runs, folder)
        show = Display(len(todo), len(runs) - len(todo))
        try:
            work(Work(todo, folder, logs, jobs, min_space), show)
        except WorkError as error:
            return str(error).splitlines()
    return []


def _missing(runs, folder):
    """The runs that are not done. Files that have the names of their bags are renamed."""
    lacks = {run: run.lacks(folder) for run in runs}
    todo = [run for run in runs if lacks[run]]
    for run in todo:
        keep(run.bag(folder), f', as {lacks[run]}')
    return todo


def work(all_of_it, show):
    """Does the runs. Calls show(jobs under way, seconds of work done, seconds of all work) several
    times a second, and show.say(line) if a run has failed, which does not stop the others. At the
    end it raises WorkError with all that failed."""
    if not all_of_it.waiting:
        return
    with signals.held() as came:
        try:
            master = Master()
            try:
                rospy.init_node('sweep', anonymous=True, disable_signals=True)
                _go_on(all_of_it, master, came, show)
            finally:
                all_of_it.stop(came)
                with contextlib.suppress(OSError):  # the terminal may be gone
                    show.end()
                leave('the work is done')
                master.stop()
        except (MasterError, rospy.ROSException) as error:
            raise WorkError(str(error))
    if all_of_it.failed:
        raise WorkError('\n'.join(all_of_it.failed))


def _go_on(all_of_it, master, came, show):
    while (all_of_it.waiting or all_of_it.under_way) and not came:
        master.check()
        all_of_it.begin()
        time.sleep(POLL)
        for line in all_of_it.close():
            show.say(line)
        show(all_of_it.under_way, *all_of_it.progress())
