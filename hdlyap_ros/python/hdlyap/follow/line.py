"""Progress in one line, on a narrow terminal in several, until the run has ended: for pipes, logs
and scripts."""

import os
import sys
import time
from math import inf

import rospy

from hdlyap.data.reader import plain
from hdlyap.data.stages import LIMITS, STAGES
from hdlyap.numbers import clock

from .layout import flow, wrapped
from .panels import nonsense
from .watch import Watch

LINE_PERIOD = 10.0  # seconds between lines if there is no terminal
LOOK_PERIOD = 0.25  # seconds between two looks
LAST_WORDS = 0.3  # seconds by which other messages may come after the last status


def parts(view):
    """The parts of the line."""
    try:
        return list(_parts(view))
    except Exception as error:  # a node may send anything that no check has foreseen
        return [plain(nonsense(error))]


def _parts(view):
    status, cost = view.status, view.cost
    yield STAGES.get(status.stage, '?')
    if status.progress > 0:
        yield f'{100 * status.progress:.1f} %'
    yield f't = {status.sim_time:.1f}'
    if 0 <= status.remaining_seconds < inf and not view.is_finished:
        yield f'{clock(status.remaining_seconds)} left'
    if view.is_averaged:
        errors = view.spectrum.std_errors
        error = f' +- {errors[0]:.4f}' if errors and errors[0] >= 0 else ''
        yield f'lambda_max {view.spectrum.lambda_max:.4f}{error}'
    if cost is not None and cost.orthonormalisations:
        limit = LIMITS.get(cost.interval_limit, '?')
        yield f'interval {cost.interval:.3g} ({limit}), repairs {cost.repairs}'
    if cost is not None and cost.modes_seconds > 0 and cost.wall_seconds > 0:
        share = 100 * cost.modes_seconds / cost.wall_seconds
        yield f'classification {share:.0f} % of the time'


class Display:
    """Shows the line: overwrites it on a terminal, prints it now and then elsewhere."""

    def __init__(self):
        self._terminal = sys.stdout.isatty()
        self._next = 0.0
        self._below = 0  # how many lines on the terminal the last text took below its first

    def show(self, parts, last=False):
        if self._terminal:
            self._overwrite(parts)
        elif last or time.monotonic() >= self._next:
            print('  '.join(parts), flush=True)
            self._next = time.monotonic() + LINE_PERIOD

    def _overwrite(self, parts):
        """Writes the text over the last one, on as many lines as it needs. The last column stays
        free, because clearing the rest of a line would clear it."""
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
    """Shows the progress until the node has finished or gone, or the user interrupts. Returns the
    exit status."""
    watch, display, shown = Watch(node, computed={}), Display(), None
    try:
        while not rospy.is_shutdown():
            view = watch.view()
            if view.is_finished:
                time.sleep(LAST_WORDS)
                display.show(parts(watch.view()), last=True)
                return 0
            if view.is_gone:
                return 3
            if view.status is not shown:
                display.show(parts(view))
                shown = view.status
            time.sleep(LOOK_PERIOD)
        return 130
    finally:
        display.close()
