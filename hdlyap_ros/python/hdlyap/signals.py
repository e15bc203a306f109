"""Signals that ask a program to end. It keeps them until all that is under way has ended in order,
or obeys at once. It does so even if they are ignored, as in a background job, or have no effect by
default, as in the first process of a container. Only SIGHUP under nohup stays ignored."""

import contextlib
import os
import signal
import sys

ASK = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)


def heeded():
    asks_nohup = signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    return [number for number in ASK if number != signal.SIGHUP or not asks_nohup]


@contextlib.contextmanager
def caught():
    """Adds each signal that comes meanwhile to a list, which it gives."""
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
    """Does what caught() does; at the end, the program exits by the first signal."""
    came = []
    try:
        with caught() as came:
            yield came
    finally:
        if came:
            leave(came[0])


@contextlib.contextmanager
def noticed():
    """Whoever answers signals meanwhile, the program exits by the first one at the end."""
    reading, writing = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
    before = signal.set_wakeup_fd(writing)
    try:
        yield
    finally:
        signal.set_wakeup_fd(before)
        os.close(writing)
        with os.fdopen(reading, 'rb') as came:
            asked = [number for number in came.read() if number in ASK]
        if asked:
            leave(asked[0])


def leave(number):
    """Exits with the status by which shells say that a signal has ended a program."""
    sys.exit(128 + number)


def of_shell(status):
    """The exit status of a process as shells say it: 128 + n if signal n has killed it; 1 if nobody
    knows how it ended."""
    if status is None:
        return 1
    return status if status >= 0 else 128 - status


def exit_on_all(but=lambda: False):
    """Makes the program exit at each signal, except while but() is true: rospy calls this handler
    for signals that it has answered already."""
    for number in heeded():
        signal.signal(number, lambda number, _: but() or leave(number))
