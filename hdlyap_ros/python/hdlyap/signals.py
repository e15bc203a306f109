"""Signals that ask for the end, kept until what is under way has been ended in order, or obeyed at
once: also where they are ignored, as in a background job, or have no effect by themselves, as on
the first process of a container. Only nohup's SIGHUP stays ignored."""

import contextlib
import signal
import sys

ASK = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)


def heeded():
    asks_nohup = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    return [number for number in ASK if number != signal.SIGHUP or not asks_nohup]


@contextlib.contextmanager
def caught():
    """A list that each of them which comes meanwhile is added to."""
    came, before = [], {}
    for number in heeded():
        before[number] = signal.signal(number, lambda number, _: came.append(number))
    try:
        yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def held():
    """The same; the first one's exit follows at the end."""
    came = []
    try:
        with caught() as came:
            yield came
    finally:
        if came:
            leave(came[0])


def leave(number):
    """As shells say that a signal has ended a program."""
    sys.exit(128 + number)


def exit_on_all(but=lambda: False):
    """But: not while this is true, for rospy, which hands on what it has answered itself."""
    for number in heeded():
        signal.signal(number, lambda number, _: but() or leave(number))
