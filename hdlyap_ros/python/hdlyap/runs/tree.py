"""A command and all processes that it starts. roslaunch starts each node in a separate session, so
a signal to the process group would not reach all."""

import os
import signal
import subprocess
import time
import uuid

# a variable of the environment, which all processes inherit, whatever becomes of their parents
MARK = 'HDLYAP_TREE'
POLL = 0.1


class Tree:
    """Runs the command. If this program is killed, the command gets a SIGINT, as by Ctrl-C."""

    def __init__(self, command, output=subprocess.DEVNULL):
        mark = uuid.uuid4().hex
        self._entry = f'{MARK}={mark}'.encode()
        streams = {'stdin': subprocess.DEVNULL, 'stdout': output, 'stderr': subprocess.STDOUT}
        how = {'start_new_session': True, 'env': {**os.environ, MARK: mark}, **streams}
        self._process = subprocess.Popen(['setpriv', '--pdeathsig', 'INT', *command], **how)

    def has_ended(self):
        """Whether the command has ended."""
        return self._process.poll() is not None

    def ask(self):
        """Asks the command to end, which asks its processes. Asks these if the command has
        ended."""
        for pid in self._members() if self.has_ended() else [self._process.pid]:
            _send(pid, signal.SIGINT)

    def is_gone(self):
        """Whether the command and all its processes have ended."""
        return self.has_ended() and not self._members()

    def insist(self):
        """Kills all processes."""
        while not self.is_gone():
            for pid in self._members():
                _send(pid, signal.SIGKILL)
            time.sleep(POLL)

    def _members(self):
        """The ids of the processes. Zombies do not count, as they have no environment."""
        processes = filter(str.isdecimal, os.listdir('/proc'))
        return [int(number) for number in processes if self._entry in _environment(number)]


def end(trees, patience, is_pressed=lambda: False):
    """Ends all trees: asks them first, and kills them after `patience` seconds or if
    is_pressed()."""
    for tree in trees:
        tree.ask()
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline and not is_pressed():
        if all(tree.is_gone() for tree in trees):
            break
        time.sleep(POLL)
    for tree in trees:
        tree.insist()


def _send(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


def _environment(pid):
    try:
        with open(f'/proc/{pid}/environ', 'rb') as file:
            return file.read()
    except OSError:  # the process has ended, or belongs to another user
        return b''
