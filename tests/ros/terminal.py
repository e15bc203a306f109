"""A program on a terminal of its own: what it draws, and what is typed."""

import codecs
import fcntl
import os
import pty
import re
import struct
import subprocess
import termios
import threading

import harness

TOKEN = re.compile(r'\033\[([0-9;]*)([A-Za-z])|(\r\n|\r|\n)|([^\033\r\n]+)')


class Terminal:
    """command runs in the foreground of it; stopped at the latest by stop()."""

    def __init__(self, command, columns=80, lines=24, **env):
        self.master, slave = pty.openpty()
        self.columns = columns
        fcntl.ioctl(self.master, termios.TIOCSWINSZ, struct.pack('HHHH', lines, columns, 0, 0))
        self.output = ''
        self.process = subprocess.Popen(
            command,
            stdin=slave,
            stdout=slave,
            stderr=slave,
            start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
            env={**os.environ, 'TERM': 'xterm-256color', 'PYTHONIOENCODING': 'utf-8', **env},
        )
        self.slave = slave  # kept open, so that what was drawn last is not lost
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        decoder = codecs.getincrementaldecoder('utf-8')()
        while True:
            try:
                data = os.read(self.master, 65536)
            except OSError:
                return
            self.output += decoder.decode(data)

    def press(self, keys):
        os.write(self.master, keys.encode())

    def screen(self):
        """Its lines now."""
        return Picture(self.output, self.columns).lines

    def wait_for(self, text, seconds=harness.PATIENCE):
        """Whether it has come to stand on the screen."""
        return harness.wait_until(lambda: text in '\n'.join(self.screen()), seconds)

    def wait(self, seconds=harness.PATIENCE):
        """Exit status; raises subprocess.TimeoutExpired."""
        return self.process.wait(seconds)

    def stop(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        for descriptor in (self.slave, self.master):
            os.close(descriptor)


class Picture:
    """What the bytes that went to a terminal amount to."""

    def __init__(self, output, columns):
        self.columns = columns
        self.lines, self._row, self._column = [''], 0, 0
        for token in TOKEN.finditer(output):
            numbers, command, newline, text = token.groups()
            if command:
                self._obey(numbers, command)
            elif newline:
                self._column = 0
                self._row += '\n' in newline
            else:
                self._write(text)

    def _write(self, text):
        """What is too long goes on below."""
        while True:
            room = self.columns - self._column
            self._put(text[:room])
            text = text[room:]
            if not text:
                return
            self._row, self._column = self._row + 1, 0

    def _put(self, text):
        self.lines += [''] * (self._row + 1 - len(self.lines))
        line = self.lines[self._row].ljust(self._column)
        self.lines[self._row] = line[: self._column] + text + line[self._column + len(text) :]
        self._column += len(text)

    def _obey(self, numbers, command):
        if command == 'A':
            self._row = max(0, self._row - int(numbers or 1))
        elif command in 'JK':
            # behind a full line the cursor stands on its last character
            begin = min(self._column, self.columns - 1)
            if self._row < len(self.lines):
                self.lines[self._row] = self.lines[self._row][:begin]
        if command == 'J':
            del self.lines[self._row + 1 :]
