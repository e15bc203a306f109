"""Keeps bags of earlier runs: they are never overwritten but renamed to FILE.old, FILE.old2 and so
on, as checkpoints are."""

import glob
import itertools
import os
import re
import time

PATIENCE = 5.0  # seconds that another recorder may take to end
POLL = 0.1
WRITTEN = '.active'  # is added to the name of a bag while it is written


class InUse(Exception):
    """A line for the user says which process writes the bag."""


def in_the_way(path):
    """The files that recording to this path would overwrite or be mixed up with: a bag and its
    parts, also those of runs that were killed."""
    stem = path[: -len('.bag')]
    parts = re.compile(re.escape(stem) + r'(_[0-9]+)?\.bag(\.active)?$')
    found = glob.glob(glob.escape(stem) + '*')
    return sorted(name for name in found if parts.match(name))


def writer(paths):
    """(pid, path) of a process that has one of the files open; None if there is none."""
    real = {os.path.realpath(path): path for path in paths if path.endswith(WRITTEN)}
    for link in glob.iglob('/proc/[0-9]*/fd/*') if real else ():
        try:
            path = os.readlink(link)
        except OSError:  # the process has ended, or belongs to another user
            continue
        if path in real:
            return int(link.split('/')[2]), real[path]
    return None


def keep(path):
    """Renames old bags at this path. Yields a line for each. Raises InUse if somebody is writing
    one."""
    until = time.monotonic() + PATIENCE
    while True:
        old = in_the_way(path)
        busy = writer(old)
        if not busy:
            break
        if time.monotonic() > until:
            raise InUse(f'bag = {path}: must be another file: process {busy[0]} writes {busy[1]}')
        time.sleep(POLL)
    endings = itertools.chain(['.old'], map('.old{}'.format, itertools.count(2)))
    ending = next(e for e in endings if not any(os.path.exists(name + e) for name in old))
    for name in old:
        os.rename(name, name + ending)
        yield f'{name} was there already: it is now {name}{ending}'
