"""Bars and dials out of characters."""

from math import isfinite


class Glyphs:
    """Finely drawn, or in ASCII."""

    def __init__(self, plain=False):
        self._parts = ' #' if plain else ' ▏▎▍▌▋▊▉█'  # of a column that is filled
        self._rest = '.' if plain else '░'
        self._hands = '>/^\\</v\\' if plain else '→↗↑↖←↙↓↘'

    def bar(self, share, columns, rest=False):
        """So many columns, filled to a share of 0 .. 1; rest: what is not filled shows."""
        fine = len(self._parts) - 1
        share = min(max(share, 0.0), 1.0) if isfinite(share) else 0.0
        whole, part = divmod(round(share * columns * fine), fine)
        drawn = self._parts[-1] * whole + (self._parts[part] if part else '')
        return drawn.ljust(columns, self._rest if rest else ' ')

    def dial(self, turn):
        """A hand, 0 .. 1 of a turn from the right, counterclockwise."""
        return self._hands[round(turn * 8) % 8]


def chosen(stream, plain=False):
    """As the encoding of a terminal allows."""
    try:
        '█→'.encode(stream.encoding or 'ascii')
    except UnicodeEncodeError:
        plain = True
    return Glyphs(plain)
