"""Lines of text -> the whole terminal, which is restored however the program ends."""

import contextlib
import itertools
import os
import select
import signal
import sys
import tempfile
import termios
import tty

ENTER = '\033[?1049h\033[?25l\033[?7l'  # alternate screen, no cursor, no wrapping at the edge
LEAVE = '\033[0m\033[?7h\033[?25h\033[?1049l'
HOME, TO_LINE_END, TO_END = '\033[H', '\033[K', '\033[J'
UNKNOWN_SIZE = (80, 24)
# blue and vermilion as in figures; all colours are legible on black and on white
COLOURS = {
    'T': '38;5;32',
    'LP': '38;5;166',
    'ok': '38;5;35',
    'warn': '1;38;5;172',
    'error': '1;38;5;160',
}
WEIGHTS = {'strong': '1', 'faint': '2'}


def is_usable():
    """Whether stdout is a terminal and this process is in its foreground."""
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
        many = '256' in os.environ.get('TERM', '') or 'COLORTERM' in os.environ
        colours = COLOURS if many and 'NO_COLOR' not in os.environ else {}
        self._styles = {} if plain else {**WEIGHTS, **colours}
        self._keyboard = None  # settings of the keyboard; None if stdin is no terminal
        self._shown = None  # (size, text) that the screen shows
        self._left = contextlib.ExitStack()  # undoes all at the end

    def __enter__(self):
        with self._left as left:
            left.enter_context(complaints_held_back())
            left.callback(signal.signal, signal.SIGTSTP, signal.getsignal(signal.SIGTSTP))
            signal.signal(signal.SIGTSTP, self._suspend)
            left.callback(self._give_back)
            self._take()
            self._left = left.pop_all()
        return self

    def __exit__(self, kind, error, trace):
        self._left.close()

    @property
    def size(self):
        """(columns, lines)"""
        columns, lines = os.get_terminal_size(sys.stdout.fileno())
        return (columns, lines) if columns and lines else UNKNOWN_SIZE

    def show(self, lines, size):
        """Shows lines, which have to fit into this size. Writes nothing if the screen shows them
        already."""
        text = '\r\n'.join(TO_LINE_END + self._painted(line) for line in lines)
        below = '\r\n' + TO_END if len(lines) < size[1] else ''
        if self._shown != (size, text):
            is_new = not self._shown or self._shown[0] != size
            _write(HOME + (TO_END if is_new else '') + text + below)
            self._shown = (size, text)

    def leave_behind(self, lines):
        """Prints lines after the end, so that the last numbers stay readable."""
        _write('\n'.join(map(self._painted, lines)) + '\n')

    def key(self, seconds):
        """The key that is pressed within this time; '' if none is."""
        keyboard = [sys.stdin] if self._keyboard else []
        if not select.select(keyboard, [], [], seconds)[0]:
            return ''
        pressed = os.read(sys.stdin.fileno(), 1)
        if not pressed:
            raise EOFError  # the terminal has gone
        return pressed.decode('ascii', 'replace')

    def _painted(self, line):
        painted = ''
        for style, spans in itertools.groupby(line, key=lambda span: self._styles.get(span[1])):
            text = ''.join(text for text, _ in spans)
            painted += f'\033[{style}m{text}\033[0m' if style else text
        return painted

    def _take(self):
        if sys.stdin.isatty():
            self._keyboard = termios.tcgetattr(sys.stdin)
            tty.setcbreak(sys.stdin)
        self._shown = None
        _write(ENTER)

    def _give_back(self):
        with contextlib.suppress(OSError, termios.error):  # the terminal may be gone
            _write(LEAVE)
            if self._keyboard:
                termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._keyboard)

    def _suspend(self, number, frame):
        """Does what Ctrl-Z asks for: gives the terminal to the shell until the program goes on."""
        self._give_back()
        os.kill(os.getpid(), signal.SIGSTOP)
        self._take()


@contextlib.contextmanager
def complaints_held_back():
    """Keeps what libraries write to stderr until the end, because it would spoil the screen."""
    if not sys.stderr.isatty():
        yield
        return
    with tempfile.TemporaryFile() as kept, os.fdopen(os.dup(2), 'wb') as stderr:
        os.dup2(kept.fileno(), 2)
        try:
            yield
        finally:
            sys.stderr.flush()
            os.dup2(stderr.fileno(), 2)
            kept.seek(0)
            stderr.write(kept.read())


def _write(text):
    data = text.encode(sys.stdout.encoding or 'ascii', 'replace')
    while data:
        data = data[os.write(sys.stdout.fileno(), data) :]
