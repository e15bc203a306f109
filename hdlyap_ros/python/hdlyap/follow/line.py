"""Progress in one line, until the run has ended: for pipes, logs and scripts."""

import os
import sys
import threading
import time

import rospy

from hdlyap.msg import Cost, RunStatus, Spectrum
from hdlyap.plots.numbers import clock
from hdlyap.plots.stages import LIMITS, STAGES

from .nodes import is_alive

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

    def line(self):
        status = self.status
        parts = [STAGES.get(status.stage, '?'), f't = {status.sim_time:.1f}']
        if status.progress > 0:
            parts.insert(1, f'{100 * status.progress:.1f} %')
        if status.remaining_seconds >= 0 and not self.finished:
            parts.append(f'{clock(status.remaining_seconds)} left')
        if self.spectrum is not None and self.spectrum.averaged_time > 0:
            parts.append(f'lambda_max {self.spectrum.lambda_max:.4f}' + self._error())
        return '  '.join(parts + (self._spent(self.cost) if self.cost is not None else []))

    @staticmethod
    def _spent(cost):
        parts = []
        if cost.orthonormalisations:
            parts.append(
                f'interval {cost.interval:.3g} ({LIMITS.get(cost.interval_limit, "?")}), '
                f'repairs {cost.repairs}'
            )
        if cost.modes_seconds > 0:
            share = 100 * cost.modes_seconds / cost.wall_seconds
            parts.append(f'classification {share:.0f} % of the time')
        return parts

    def _error(self):
        errors = self.spectrum.std_errors
        return f' +- {errors[0]:.4f}' if errors and errors[0] >= 0 else ''


class Display:
    """A line that is overwritten on a terminal; elsewhere one now and then."""

    def __init__(self):
        self._terminal = sys.stdout.isatty()
        self._next = 0.0

    def show(self, line, last=False):
        if self._terminal:
            width = os.get_terminal_size(sys.stdout.fileno()).columns
            print('\r' + line[: max(0, width - 1)] + '\033[K', end='', flush=True)
        elif last or time.monotonic() >= self._next:
            print(line, flush=True)
            self._next = time.monotonic() + LINE_PERIOD

    def close(self):
        if self._terminal:
            print(flush=True)


def follow(node):
    """Shows the progress until the node has finished, has gone, or the user has had enough;
    returns the exit status."""
    progress, display = Progress(node), Display()
    try:
        while not rospy.is_shutdown():
            if progress.news.wait(timeout=0.5):
                progress.news.clear()
                display.show(progress.line())
            if progress.finished:
                time.sleep(LAST_WORDS)
                display.show(progress.line(), last=True)
                return 0
            if time.monotonic() - progress.last_heard > SILENCE and not is_alive(node):
                return 3
        return 130
    finally:
        display.close()
