"""Signals that ask for the end: kept until what is under way has been ended in order."""

import contextlib
import signal
import sys

ASK = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)


@contextlib.contextmanager
def held():
    """A list that each of them which comes meanwhile is added to; the first one's exit follows at
    the end."""
    came, before = [], {}
    for number in ASK:
        if signal.getsignal(number) is not signal.SIG_IGN:  # as nohup asks
            before[number] = signal.signal(number, lambda number, _: came.append(number))
    try:
        yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if came:
            leave(came[0])


def leave(number, _=None):
    """As shells say that a signal has ended a program."""
    sys.exit(128 + number)


def exit_on_all():
    for number in ASK:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, leave)
