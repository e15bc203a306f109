"""Progress of a node in one line, on a narrow terminal in several, and above it what is new."""

import shutil
import sys
import textwrap
import time
from math import inf, isfinite

import rospy

from hdlyap.data.reader import plain
from hdlyap.data.stages import LIMITS, STAGES
from hdlyap.fault import whose
from hdlyap.msg import Steps
from hdlyap.numbers import clock, with_error

from .news import News
from .watch import Watch

LINE_PERIOD = 10.0  # seconds between lines if there is no terminal
LOOK_PERIOD = 0.25  # seconds between two looks
LAST_WORDS = 0.3  # seconds by which other messages may come after the last status
SILENCE = 5.0  # seconds without a message that are worth a word
GAP = '  '  # between the parts of the line
LEVELS = {1: 'WARN', 2: 'ERROR', 3: 'STALE'}  # of diagnostics


def understood(lines, *about):
    """The lines of a function; one about the error if a node has sent what nobody expects."""
    try:
        return list(lines(*about))
    except Exception as error:
        said = whose(error) or 'unexpected contents in a message of the node'
        return [f'{said}: {type(error).__name__}: {error}']


def parts(view):
    """Yields the parts of the line."""
    if view.status is not None:
        yield from _progress(view)
        yield from _cost(view.cost)
    yield from _condition(view)


def _progress(view):
    status = view.status
    yield _stage(view)
    if status.progress > 0:
        yield f'{100 * status.progress:.1f} %'
    yield f't = {status.sim_time:.1f}'
    if view.speed is not None:
        yield f'{view.speed:.3g} time units/s'
    if 0 <= status.remaining_seconds < inf and not view.is_finished:
        yield f'{clock(status.remaining_seconds)} left'
    if status.target:
        error, wanted = _number(status.target_error), _number(status.target_wanted)
        yield f'error of {status.target} {error}, wanted {wanted}'
    if view.is_averaged:
        errors = view.spectrum.std_errors
        error = errors[0] if errors else -1.0
        yield f'lambda_max {with_error(view.spectrum.lambda_max, error, decimals=4)}'


def _stage(view):
    """What the run is doing. Diagnostics say more than the stage: paused, waiting for
    subscribers."""
    if not view.is_finished and view.diagnosis is not None:
        return {pair.key: pair.value for pair in view.diagnosis.values}.get('stage', '?')
    return STAGES.get(view.status.stage, '?')


def _cost(cost):
    if cost is not None and cost.orthonormalisations:
        limit = LIMITS.get(cost.interval_limit, '?')
        yield f'interval {cost.interval:.3g} ({limit}), repairs {cost.repairs}'
    if cost is not None and cost.modes_seconds > 0 and cost.wall_seconds > 0:
        share = 100 * cost.modes_seconds / cost.wall_seconds
        yield f'classification {share:.0f} % of the time'


def _condition(view):
    """The node's warning, and whether it is still there."""
    if view.is_finished:
        return
    if view.is_gone:
        yield f'GONE: {view.node} does not answer; waiting for it to come back'
    elif view.diagnosis is not None and view.diagnosis.level:
        yield f'{LEVELS.get(view.diagnosis.level, "?")}: {view.diagnosis.message}'
    if view.silence > SILENCE and not view.is_gone:
        yield f'no message for {clock(view.silence)}'
    if view.is_master_gone:
        yield 'no master: connections from before stay'


def _number(value):
    return f'{value:.2g}' if isfinite(value) and value >= 0 else '?'


class Display:
    """Shows the line: overwrites it on a terminal, prints it now and then elsewhere."""

    def __init__(self):
        self._terminal = sys.stdout.isatty()
        self._next = 0.0
        self._below = 0  # how many lines on the terminal the last text took below its first

    def show(self, parts, last=False):
        parts = [plain(part, len(part)) for part in parts]  # a node must not steer the terminal
        if self._terminal:
            self._overwrite(parts)
        elif last or time.monotonic() >= self._next:
            print(GAP.join(parts), flush=True)
            self._next = time.monotonic() + LINE_PERIOD

    def say(self, lines):
        """Prints lines that stay, in place of the line, which has to be shown anew below them."""
        if lines and self._terminal:
            self._overwrite([])
        for line in lines:
            print(plain(line, len(line)), flush=True)

    def _overwrite(self, parts):
        """Writes the text over the last one, on as many lines as it needs. The last column stays
        free, because clearing the rest of a line would clear it."""
        width = max(1, shutil.get_terminal_size().columns - 1)
        lines = flowed(parts, width)
        up = f'\033[{self._below}A' if self._below else ''
        print(f'\r{up}' + '\033[K\n'.join(lines) + '\033[J', end='', flush=True)
        self._below = max(0, len(lines) - 1)

    def close(self):
        if self._terminal:
            print(flush=True)
            self._below = 0


def flowed(parts, width):
    """Lines of this width, with as many parts side by side as there is room for."""
    lines = []
    for part in parts:
        if lines and len(lines[-1] + GAP + part) <= width:
            lines[-1] += GAP + part
        else:
            lines += textwrap.wrap(part, width, break_on_hyphens=False)
    return lines


def follow(node, alone, steps, stays):
    """Shows the progress until the node has finished, or the user interrupts. alone: only the line;
    steps: has the node compute steps; stays: waits for a node that has gone. Returns the exit
    status."""
    watch = Watch(node, {} if alone else {'steps': Steps}, steps)
    news, display, shown = News(), Display(), []
    try:
        while not rospy.is_shutdown():
            view = watch.view()
            if view.is_finished:
                time.sleep(LAST_WORDS)
                view = watch.view()
            elif view.is_gone and not stays:
                return 3
            new = [] if alone else understood(news.of, view, view.is_finished)
            display.say(new)
            now = understood(parts, view)
            if new or now != shown or view.is_finished:
                display.show(now, last=view.is_finished)
                shown = now
            if view.is_finished:
                return 0
            time.sleep(LOOK_PERIOD)
        return 130
    finally:
        display.close()
