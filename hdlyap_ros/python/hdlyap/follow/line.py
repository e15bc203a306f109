"""Progress in one line, on a narrow terminal in several, until the run has ended: for pipes, logs
and scripts."""

import os
import sys
import threading
import time
from math import inf

import rospy

from hdlyap.msg import Cost, RunStatus, Spectrum
from hdlyap.plots.numbers import clock
from hdlyap.plots.stages import LIMITS, STAGES

from .nodes import is_alive
from .panels import nonsense
from .screen import clean
from .wrap import flow, wrapped

LINE_PERIOD = 10.0  # seconds between lines where there is no terminal
SILENCE = 2.0  # seconds without a message after which the node is asked
LAST_WORDS = 0.3  # seconds that others may be behind the last status


class Progress:
    """What the node said last; the callbacks of three topics write it, the main loop reads."""

    def __init__(self, node):
        self.status = self.cost = self.spectrum = None
        self.news = threading.Event()
        self.last_heard = time.monotonic()
        rospy.Subscriber(node + '/status', RunStatus, self._hear_status, queue_size=1)
        rospy.Subscriber(node + '/cost', Cost, self._hear_cost, queue_size=1)
        rospy.Subscriber(node + '/spectrum', Spectrum, self._hear_spectrum, queue_size=1)

    def _hear_status(self, msg):
        self.status = msg
        self.last_heard = time.monotonic()
        self.news.set()

    def _hear_cost(self, msg):
        self.cost = msg

    def _hear_spectrum(self, msg):
        self.spectrum = msg

    @property
    def finished(self):
        return self.status is not None and self.status.stage == RunStatus.FINISHED

    def parts(self):
        """Of the line."""
        try:
            return self._parts()
        except Exception as error:  # what no check has foreseen: a node may say anything
            return [clean(nonsense(error))]

    def _parts(self):
        status = self.status
        parts = [STAGES.get(status.stage, '?'), f't = {status.sim_time:.1f}']
        if status.progress > 0:
            parts.insert(1, f'{100 * status.progress:.1f} %')
        if 0 <= status.remaining_seconds < inf and not self.finished:
            parts.append(f'{clock(status.remaining_seconds)} left')
        if self.spectrum is not None and self.spectrum.averaged_time > 0:
            parts.append(f'lambda_max {self.spectrum.lambda_max:.4f}' + self._error())
        return parts + (self._spent(self.cost) if self.cost is not None else [])

    @staticmethod
    def _spent(cost):
        parts = []
        if cost.orthonormalisations:
            parts.append(
                f'interval {cost.interval:.3g} ({LIMITS.get(cost.interval_limit, "?")}), '
                f'repairs {cost.repairs}'
            )
        if cost.modes_seconds > 0 and cost.wall_seconds > 0:
            share = 100 * cost.modes_seconds / cost.wall_seconds
            parts.append(f'classification {share:.0f} % of the time')
        return parts

    def _error(self):
        errors = self.spectrum.std_errors
        return f' +- {errors[0]:.4f}' if errors and errors[0] >= 0 else ''


class Display:
    """Overwritten on a terminal; elsewhere a line now and then."""

    def __init__(self):
        self._terminal = sys.stdout.isatty()
        self._next = 0.0
        self._below = 0  # lines of the last one below its first

    def show(self, parts, last=False):
        if self._terminal:
            self._overwrite(parts)
        elif last or time.monotonic() >= self._next:
            print('  '.join(parts), flush=True)
            self._next = time.monotonic() + LINE_PERIOD

    def _overwrite(self, parts):
        """On as many lines as it needs. The last column stays free, or what clears behind the text
        would clear its end."""
        width = max(1, os.get_terminal_size(sys.stdout.fileno()).columns - 1)
        lines = [piece for line in flow(parts, width, '  ') for piece in wrapped(line, width)]
        text = '\033[K\n'.join(''.join(text for text, _ in line) for line in lines)
        up = f'\033[{self._below}A' if self._below else ''
        print(f'\r{up}{text}\033[J', end='', flush=True)
        self._below = len(lines) - 1

    def close(self):
        if self._terminal:
            print(flush=True)
            self._below = 0


def follow(node):
    """Shows the progress until the node has finished, has gone, or the user has had enough;
    returns the exit status."""
    progress, display = Progress(node), Display()
    try:
        while not rospy.is_shutdown():
            if progress.news.wait(timeout=0.5):
                progress.news.clear()
                display.show(progress.parts())
            if progress.finished:
                time.sleep(LAST_WORDS)
                display.show(progress.parts(), last=True)
                return 0
            if time.monotonic() - progress.last_heard > SILENCE and not is_alive(node):
                return 3
        return 130
    finally:
        display.close()
