"""A command and all that it begins: roslaunch gives each node a session of its own, a signal to a group is not enough."""

import os
import signal
import subprocess
import time

LOOK = 2.0          # seconds between two looks at what there is
POLL = 0.05


class Tree:
    """Runs the command. It is asked to end, as by Ctrl-C, also where who began it is killed."""

    def __init__(self, command, output=subprocess.DEVNULL):
        self._process = subprocess.Popen(['setpriv', '--pdeathsig', 'INT', *command], stdin=subprocess.DEVNULL,
                                         stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
        self._members, self._due = {}, 0.0

    def has_ended(self):
        """Whether the command has; to be called often, so that none of its processes is unknown when it ends."""
        ended = self._process.poll() is not None
        if not ended and time.monotonic() >= self._due:
            self._look()
        return ended

    def _look(self):
        self._due = time.monotonic() + LOOK
        self._members.update(_descendants(self._process.pid))

    def ask(self):
        """To end: the command, which asks its processes; them, if it is no more."""
        self._look()
        ended = self._process.poll() is not None
        for pid in self._left() if ended else [self._process.pid]:
            _send(pid, signal.SIGINT)

    def is_gone(self):
        """Whether nothing of it is left."""
        return self._process.poll() is not None and not self._left()

    def insist(self):
        """The end of all of it at once."""
        self._look()
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        for pid in self._left():
            _send(pid, signal.SIGKILL)

    def _left(self):
        return [pid for pid, began in self._members.items() if pid != self._process.pid and _began(pid) == began]


def end(trees, patience, is_pressed=lambda: False):
    """Of all of them: asked first, made to after so many seconds or when it is pressed for."""
    for tree in trees:
        tree.ask()
    deadline = time.monotonic() + patience
    while not all(tree.is_gone() for tree in trees) and time.monotonic() < deadline and not is_pressed():
        time.sleep(POLL)
    for tree in trees:
        tree.insist()


def _send(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def _stat(pid):
    """Fields of /proc/PID/stat behind the name, state first; None if there is no such process, or a dead one that its
    parent has not seen yet."""
    try:
        with open(f'/proc/{pid}/stat', errors='replace') as file:
            fields = file.read().rpartition(')')[2].split()
    except OSError:
        return None
    return fields if fields and fields[0] not in 'ZX' else None


def _began(pid):
    """When, in the clock ticks of the machine: ids are used again."""
    fields = _stat(pid)
    return fields and fields[19]


def _descendants(pid):
    """{process: when it began}, of it and all below it."""
    below, found = {}, {}
    for entry in os.listdir('/proc'):
        fields = _stat(entry) if entry.isdecimal() else None
        if fields:
            below.setdefault(int(fields[1]), []).append((int(entry), fields[19]))
    todo = [(pid, _began(pid))]
    while todo:
        member, began = todo.pop()
        if began:
            found[member] = began
            todo += below.get(member, [])
    return found
