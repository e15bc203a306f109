"""A command and all that it begins: roslaunch gives each node a session of its own, so a signal to
a group is not enough."""

import os
import signal
import subprocess
import time
import uuid

# of the environment, which its processes inherit, whatever becomes of their parents
MARK = 'HDLYAP_TREE'
POLL = 0.1


class Tree:
    """Runs the command. It is asked to end, as by Ctrl-C, also where who began it is killed."""

    def __init__(self, command, output=subprocess.DEVNULL):
        mark = uuid.uuid4().hex
        self._entry = f'{MARK}={mark}'.encode()
        streams = {'stdin': subprocess.DEVNULL, 'stdout': output, 'stderr': subprocess.STDOUT}
        how = {'start_new_session': True, 'env': {**os.environ, MARK: mark}, **streams}
        self._process = subprocess.Popen(['setpriv', '--pdeathsig', 'INT', *command], **how)

    def has_ended(self):
        """Whether the command has."""
        return self._process.poll() is not None

    def ask(self):
        """To end: the command, which asks its processes; them, if it is no more."""
        for pid in self._members() if self.has_ended() else [self._process.pid]:
            _send(pid, signal.SIGINT)

    def is_gone(self):
        """Whether nothing of it is left."""
        return self.has_ended() and not self._members()

    def insist(self):
        """The end of all of it at once."""
        while not self.is_gone():
            for pid in self._members():
                _send(pid, signal.SIGKILL)
            time.sleep(POLL)

    def _members(self):
        """Processes; not those that are dead but for their parents' wait, which have no
        environment."""
        processes = filter(str.isdecimal, os.listdir('/proc'))
        return [int(number) for number in processes if self._entry in _environment(number)]


def end(trees, patience, is_pressed=lambda: False):
    """Of all of them: asked first, made to after so many seconds or when it is pressed for."""
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
    except OSError:  # it has ended, or is somebody else's
        return b''
