"""Progress of something that takes a while -> a bar with the time left on the terminal, which is
removed at the end."""

import sys
import time

from .numbers import clock

SILENT = 1.0  # seconds before the first bar; work that is done by then needs none
PERIOD = 0.2  # seconds between two bars
COLUMNS = 30


class Progress:
    """Shows a bar on a terminal. There is only one at a time: drawing includes reading, for
    example."""

    _busy = False

    def __init__(self, what, stream=sys.stderr):
        self._what, self._stream = what, stream
        self._shown = False

    def over(self, things, total):
        """Yields the things, and shows how many have gone by; total: their number."""
        if not self._stream.isatty() or Progress._busy:
            yield from things
            return
        Progress._busy = True
        began = time.monotonic()
        due = began + SILENT
        try:
            for count, thing in enumerate(things):
                now = time.monotonic()
                if now >= due:
                    due = now + PERIOD
                    self._show(count / total, now - began)
                yield thing
        finally:
            Progress._busy = False
            self._clear()

    def _show(self, share, seconds):
        left = f'  {clock(seconds * (1 / share - 1))} left' if share > 0 else ''
        bar = _bar(share, self._stream.encoding)
        self._write(f'\r{self._what}  {bar} {100 * share:3.0f} %{left}\033[K')
        self._shown = True

    def _clear(self):
        if self._shown:
            self._write('\r\033[K')

    def _write(self, text):
        print(text, end='', file=self._stream, flush=True)


def _bar(share, encoding):
    """A bar that is filled to a share of 0 .. 1, of characters that the encoding has."""
    full = round(share * COLUMNS)
    try:
        '█░'.encode(encoding or 'ascii')
    except UnicodeEncodeError:
        return ('#' * full).ljust(COLUMNS, '.')
    return ('█' * full).ljust(COLUMNS, '░')
