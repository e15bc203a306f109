"""Bags of earlier runs: none is overwritten, each is kept as FILE.old, FILE.old2 and so on, as
checkpoints are."""

import glob
import itertools
import os
import re
import time

PATIENCE = 5.0  # seconds that another recorder may take to end
POLL = 0.1
WRITTEN = '.active'  # is added to the name of a bag while it is written


class InUse(Exception):
    """With its line."""


def in_the_way(path):
    """What recording to this file would overwrite, or be mixed up with: bag and parts of it, of
    runs that were killed too."""
    stem = path[: -len('.bag')]
    parts = re.compile(re.escape(stem) + r'(_[0-9]+)?\.bag(\.active)?$')
    found = glob.glob(glob.escape(stem) + '*')
    return sorted(name for name in found if parts.match(name))


def writer(paths):
    """The process that has one of them open, None if there is none: (its number, the path)."""
    real = {os.path.realpath(path): path for path in paths if path.endswith(WRITTEN)}
    for link in glob.iglob('/proc/[0-9]*/fd/*') if real else ():
        try:
            path = os.readlink(link)
        except OSError:  # it has gone, or is somebody else's
            continue
        if path in real:
            return int(link.split('/')[2]), real[path]
    return None


def keep(path):
    """Makes room for a new bag; yields what became of the old ones. InUse if one of them is
    written just now."""
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
