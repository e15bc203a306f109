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

    def is_gone(self):
        """Whether the command and all its processes have ended."""
        return self.has_ended() and not self._members()

    def end(self, patience, came=()):
        """Asks the command to end, which asks its processes, or these if it has ended. Kills all
        after `patience` seconds, or when another signal has come."""
        before, latest = len(came), time.monotonic() + patience
        for pid in self._members() if self.has_ended() else [self._process.pid]:
            _send(pid, signal.SIGINT)
        while time.monotonic() < latest and len(came) == before and not self.is_gone():
            time.sleep(POLL)
        while not self.is_gone():
            for pid in self._members():
                _send(pid, signal.SIGKILL)
            time.sleep(POLL)

    def _members(self):
        """The ids of the processes. Zombies do not count, as they have no environment."""
        processes = filter(str.isdecimal, os.listdir('/proc'))
        return [int(number) for number in processes if self._entry in _environment(number)]


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
