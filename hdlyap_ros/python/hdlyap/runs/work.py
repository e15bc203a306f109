"""Runs that are not done -> their bags. Each run is a roslaunch under a master of its own. Several
go on side by side; those that use all cores, one after the other."""

import contextlib
import fcntl
import os
import re
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed, wait

from hdlyap import signals
from hdlyap.numbers import clock

from . import bags, ranks, tree
from .run import recorded

PATIENCE = 60.0  # seconds in which all processes have to end, with the last checkpoint
SILENCE = 180.0  # seconds in which the recorder has to hear the node, which waits for it
ESTIMATED = 60.0  # weight of the estimated speed against the measured one, in seconds of work
UNDER_WAY = 'under_way'  # folder of bags that are being recorded
SAID = re.compile('FATAL|ERROR')
DIED = re.compile(r'process has died \[[^\]]*?(?=, cmd|\])')
COLOUR = re.compile('\033' + r'\[[0-9;]*m')


class WorkError(Exception):
    """A line for the user."""


def launched(words, came, output=None, is_lost=lambda: False):
    """Does a run by run.launch with these arguments, under a master of its own. The first of the
    signals that came ends it, as is_lost() does; the next one kills it. output: file of what it
    prints."""
    os.environ['ROS_HOSTNAME'] = 'localhost'  # no other machine needs the node
    command = ['roslaunch', '-p', str(ranks.free_port()), 'hdlyap', 'run.launch', *words]
    started = tree.Tree(command, output)
    while not (started.has_ended() or came or is_lost()):
        time.sleep(tree.POLL)
    started.end(PATIENCE, came)


def do(runs, folder, at_once, min_space):
    """Does the runs that are not done. Returns a line for each that has failed. Raises WorkError if
    somebody else does runs in this folder."""
    logs, under_way = (os.path.join(folder, name) for name in ('log', UNDER_WAY))
    os.makedirs(logs, exist_ok=True)
    with open(os.path.join(logs, '.lock'), 'w') as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise WorkError(f'another sweep does the runs of {folder}')
        except OSError:
            pass  # the file system has no locks
        jobs = [Job(run, folder) for run in _missing(runs, folder)]
        show = Tally(jobs, len(runs) - len(jobs), at_once)
        os.makedirs(under_way, exist_ok=True)
        try:
            if jobs:
                _work(jobs, show, at_once, min_space)
        finally:
            with contextlib.suppress(OSError):  # it has bags that cannot be read or moved
                os.rmdir(under_way)
    return show.failed


def _missing(runs, folder):
    """The runs that are not done. Files that have the names of their bags are renamed."""
    lacks = {run: run.lacks(folder) for run in runs}
    todo = [run for run in runs if lacks[run]]
    for run in todo:
        _keep(run.bag(folder), f', as {lacks[run]}')
    return todo


def _keep(path, why=''):
    """Renames bags that have this name, and says why."""
    for line in bags.keep(path):
        print(f'hdlyap sweep: {line}{why}', flush=True)


def _work(jobs, show, at_once, min_space):
    """Does them. One that fails does not stop the others."""
    with signals.held() as came:
        try:
            with contextlib.closing(_side_by_side(jobs, at_once, min_space, came)) as ended:
                for job in ended:
                    why = job.placed()
                    if came and why:
                        _say_left(job)
                    else:
                        show.ended(job, why)
        finally:
            with contextlib.suppress(OSError):  # the terminal may be gone
                show.end()


def _side_by_side(jobs, at_once, min_space, came):
    """Yields each job when it has ended. Closed before the last, it ends those under way."""
    for is_wide, workers in ((False, at_once), (True, 1)):
        some = [job for job in jobs if job.run.is_wide == is_wide]
        with ThreadPoolExecutor(workers) as pool:
            begun = {pool.submit(job.do, min_space, came): job for job in some}
            try:
                for future in as_completed(begun):
                    future.result()
                    yield begun.pop(future)
            finally:
                _end(begun)


def _end(begun):
    """Ends jobs, {future: job}, and takes their bags to their places."""
    for job in begun.values():
        job.is_over = True
    futures = [future for future in begun if not future.cancel()]
    wait(futures)
    for future in futures:
        begun[future].placed()
        _say_left(begun[future])


def _say_left(job):
    with contextlib.suppress(OSError):  # the terminal may be gone
        if job.left():
            print(f'hdlyap sweep: {job.run.name}: {job.left()}', file=sys.stderr, flush=True)


class Job:
    """A run. It records into another folder, so that an incomplete bag replaces nothing."""

    def __init__(self, run, folder):
        self.run, self._folder, self._is_silent, self._fault = run, folder, False, ''
        self.is_over = False  # whether it has to end
        self.log = os.path.join(folder, 'log', run.name + '.log')
        self._new = os.path.join(folder, UNDER_WAY, f'{run.name}.{os.getpid()}.bag')

    def do(self, min_space, came):
        """Does the run, unless a signal came."""
        if came or self.is_over:
            return
        try:
            self._do(min_space, came)
        except OSError as error:
            self._fault = str(error)

    def _do(self, min_space, came):
        until = time.monotonic() + SILENCE

        def is_lost():
            self._is_silent = time.monotonic() > until and not bags.in_the_way(self._new)
            return self._is_silent or self.is_over

        words = [f'__ns:={self.run.name}', f'scene:={self.run.scene_file(self._folder)}']
        words += ['record:=true', f'bag:={self._new}', f'min_space:={min_space}', 'table:=0']
        words += self.run.program.arguments()
        with open(self.log, 'w') as file:
            self.run.write(self._folder)
            launched(words, came, file, is_lost)

    def placed(self):
        """Takes the bag to its place, if it is complete, and removes it, if it says that it is not.
        Returns why it is not that of the run; '' if it is."""
        there = recorded(self._new)
        whole = there if there and there.is_complete else None
        why = self._fault or self.run.lacking(whole)
        if self._is_silent:
            why = f'no message of its node within {SILENCE:.0f} s'
        try:
            if whole:
                _keep(self.run.bag(self._folder))
                os.rename(self._new, self.run.bag(self._folder))
            elif there:
                os.remove(self._new)
        except (bags.InUse, OSError) as error:
            return f'{self.left()}: {error}'
        return '; '.join(filter(None, (why, self.left())))

    def left(self):
        """Where its bag is if it has not come to its place, as text; '' if it is gone."""
        found = ' and '.join(bags.in_the_way(self._new))
        return found and f'its bag is still in {found}'


def last_words(log):
    """Why a run failed: the last line of level ERROR or FATAL, otherwise the death of a process;
    '' if the log cannot be read."""
    try:
        with open(log, errors='replace') as file:
            lines = [COLOUR.sub('', line).strip() for line in file]
    except OSError:
        return ''
    errors = [line for line in lines if SAID.search(line)]
    deaths = [match.group() + ']' for match in map(DIED.search, lines) if match]
    last = (errors or deaths)[-1:]
    return ''.join(line + '; ' for line in last)


class Tally:
    """Says how many runs are done, and about how long the rest takes. before: how many were done
    already."""

    def __init__(self, jobs, before, at_once):
        self._count, self._done, self.failed = len(jobs) + before, before, []
        self._at_once, self._began = at_once, time.monotonic()
        self._spent, self._left = 0.0, sum(job.run.share_of(at_once) for job in jobs)

    def ended(self, job, why):
        """why: the run has failed; '' if it has not."""
        if why:
            line = f'{job.run.name}: {why}; {last_words(job.log)}all its output is in {job.log}'
            print(f'hdlyap sweep: {line}', file=sys.stderr, flush=True)
            self.failed.append(line)
        self._done += not why
        self._spent += job.run.share_of(self._at_once)
        self._left -= job.run.share_of(self._at_once)
        speed = (self._spent + ESTIMATED) / (time.monotonic() - self._began + ESTIMATED)
        print(f'{self}, about {clock(self._left / speed)} left', flush=True)

    def __str__(self):
        failed = f', {len(self.failed)} failed' if self.failed else ''
        return f'{self._done} of {self._count} runs done{failed}'

    def end(self):
        print(f'{self} in {clock(time.monotonic() - self._began)}', flush=True)
