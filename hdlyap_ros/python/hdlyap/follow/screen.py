"""Lines of text -> a terminal used as a whole, and left as it was however the program ends."""

import os
import select
import signal
import sys
import tempfile
import termios
import tty

from .wrap import length, spans

ENTER = '\033[?1049h\033[?25l\033[?7l'  # another screen, no cursor, no wrapping at the edge
LEAVE = '\033[0m\033[?7h\033[?25h\033[?1049l'
HOME, TO_LINE_END, TO_END, CLEAR = '\033[H', '\033[K', '\033[J', '\033[2J'
HANGUP = 128 + signal.SIGHUP
UNKNOWN_SIZE = (80, 24)
# blue and vermilion as in the figures, of a lightness that shows on black and on white
COLOURS = {
    'T': '38;5;32',
    'LP': '38;5;166',
    'ok': '38;5;35',
    'warn': '1;38;5;172',
    'error': '1;38;5;160',
}
WEIGHTS = {'strong': '1', 'faint': '2'}


def is_usable():
    """Whether stdout is a terminal that this process may have for itself."""
    try:
        return (
            sys.stdout.isatty()
            and os.environ.get('TERM', 'dumb') != 'dumb'
            and os.tcgetpgrp(sys.stdout.fileno()) == os.getpgrp()
        )
    except OSError:
        return False


class Screen:
    """A context: inside, show() puts lines on the screen. A line is a list of (text, style)."""

    def __init__(self, plain=False):
        self._styles = {} if plain else _styles()
        self._saved = None  # settings of the keyboard; None where it is none of ours
        self._shown = None  # (size, text) of what stands there
        self._handlers = {}
        self._complaints = Complaints()

    def __enter__(self):
        self._complaints.hold_back()
        for number, handler in ((signal.SIGTSTP, self._suspend), (signal.SIGHUP, _hang_up)):
            self._handlers[number] = signal.signal(number, handler)
        self._take()
        return self

    def __exit__(self, kind, error, trace):
        self._give_back()
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        self._complaints.let_out()

    @property
    def size(self):
        """(columns, lines)"""
        columns, lines = os.get_terminal_size(sys.stdout.fileno())
        return (columns, lines) if columns and lines else UNKNOWN_SIZE

    def show(self, lines, size):
        """As many lines as the screen has, each cut to its width; nothing is sent if they stand
        there already."""
        text = '\r\n'.join(self._cleared(cut(line, size[0]), size[0]) for line in lines[: size[1]])
        if len(lines) < size[1]:
            text += '\r\n' + TO_END
        if self._shown != (size, text):
            _write((HOME if self._shown and self._shown[0] == size else CLEAR + HOME) + text)
            self._shown = (size, text)

    def leave_behind(self, lines):
        """After the end, so that the last numbers stay readable."""
        _write('\n'.join(self._painted(line) for line in lines) + '\n')

    def key(self, seconds):
        """A key that is pressed within so many seconds; else ''."""
        keyboard = [sys.stdin] if self._saved else []
        ready, _, _ = select.select(keyboard, [], [], seconds)
        if not ready:
            return ''
        pressed = os.read(sys.stdin.fileno(), 1)
        if not pressed:
            raise EOFError  # the terminal has gone
        return pressed.decode('ascii', 'replace')

    def _cleared(self, line, width):
        """With nothing left behind it. Behind a line as wide as the screen the cursor still stands
        on its last character."""
        return self._painted(line) + (TO_LINE_END if length(line) < width else '')

    def _painted(self, line):
        return ''.join(
            f'\033[{self._styles[style]}m{clean(text)}\033[0m'
            if style in self._styles
            else clean(text)
            for text, style in line
        )

    def _take(self):
        if sys.stdin.isatty():
            self._saved = termios.tcgetattr(sys.stdin)
            tty.setcbreak(sys.stdin)
        self._shown = None
        _write(ENTER + CLEAR)

    def _give_back(self):
        try:
            _write(LEAVE)
            if self._saved:
                termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._saved)
        except (OSError, termios.error):
            pass  # no terminal is left to be given back

    def _suspend(self, number, frame):
        """Ctrl-Z: the shell gets its terminal, until the program is in the foreground again."""
        self._give_back()
        os.kill(os.getpid(), signal.SIGSTOP)
        self._take()


class Complaints:
    """What libraries write to stderr: they would write it across the screen."""

    def __init__(self):
        self._kept = self._stderr = None

    def hold_back(self):
        if sys.stderr.isatty():
            self._kept, self._stderr = tempfile.TemporaryFile(), os.dup(sys.stderr.fileno())
            os.dup2(self._kept.fileno(), sys.stderr.fileno())

    def let_out(self):
        if self._stderr is None:
            return
        sys.stderr.flush()
        os.dup2(self._stderr, sys.stderr.fileno())
        os.close(self._stderr)
        self._kept.seek(0)
        sys.stderr.write(self._kept.read().decode('utf-8', 'replace'))


def cut(line, width):
    """The line's first columns."""
    return spans(line, 0, width)


def clean(text):
    """What a node says must not reach the terminal as a command."""
    return ''.join(c if c.isprintable() else '?' for c in text)


def _styles():
    many = '256' in os.environ.get('TERM', '') or 'COLORTERM' in os.environ
    return {**WEIGHTS, **(COLOURS if many and 'NO_COLOR' not in os.environ else {})}


def _write(text):
    data = text.encode(sys.stdout.encoding or 'ascii', 'replace')
    while data:
        data = data[os.write(sys.stdout.fileno(), data) :]


def _hang_up(number, frame):
    sys.exit(HANGUP)
