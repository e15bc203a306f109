"""The progress of many runs in a line: how many are done, how much of all work, and about how long
the rest takes."""

import os
import sys
import time

from hdlyap.follow.line import Display as Line
from hdlyap.numbers import clock

ESTIMATED = 60.0  # weight of the estimated speed against the measured one, in seconds of work


class Display:
    """Shows the progress of work.work through `count` runs. before: runs that were done already."""

    def __init__(self, count, before=0):
        self._count, self._before, self._line = count + before, before, Line()
        self._began = time.monotonic()
        self._seen, self._failed, self._ended = set(), 0, 0

    def __call__(self, under_way, done, total):
        names = {job.run.name for job in under_way}
        self._seen |= names
        self._ended = len(self._seen - names)
        shares = [f'{job.run.name} {100 * job.share:.0f} %' for job in under_way]
        rest = f'all {100 * done / total:.0f} %, about {clock(self._left(done, total))} left'
        self._line.show([_fitting(self._count_of_runs(), shares, rest)])

    def _left(self, done, total):
        """Seconds left, from the estimated work and the time that was needed so far."""
        return (total - done) * (time.monotonic() - self._began + ESTIMATED) / (done + ESTIMATED)

    def _count_of_runs(self):
        failed = f', {self._failed} failed' if self._failed else ''
        done = self._before + max(0, self._ended - self._failed)
        return f'{done} of {self._count} runs done{failed}'

    def say(self, line):
        """Prints a line about a run that has failed."""
        self._failed += 1
        self._line.close()
        print(f'hdlyap sweep: {line}', file=sys.stderr, flush=True)

    def end(self):
        """Shows how many runs were done, and in which time."""
        seconds = time.monotonic() - self._began
        self._line.show([f'{self._count_of_runs()} in {clock(seconds)}'], last=True)
        self._line.close()


def _fitting(count, shares, rest):
    """The line with as many shares of runs as the terminal has room for. The rest is always in
    it."""
    width = 10**6
    if sys.stdout.isatty():
        width = os.get_terminal_size(sys.stdout.fileno()).columns - 1
    for shown in range(len(shares), -1, -1):
        others = [f'{len(shares) - shown} more'] if shown < len(shares) else []
        line = '  '.join([count, *shares[:shown], *others, rest])
        if len(line) <= width:
            break
    return line
