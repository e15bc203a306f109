"""Bars and dials made of characters."""

from math import isfinite


class Glyphs:
    """Bars and dials; plain: in ASCII."""

    def __init__(self, plain=False):
        self._parts = ' #' if plain else ' ▏▎▍▌▋▊▉█'  # filled parts of a column
        self._rest = '.' if plain else '░'
        self._hands = '>/^\\</v\\' if plain else '→↗↑↖←↙↓↘'

    def bar(self, share, columns, rest=False):
        """A bar of this many columns, filled to a share of 0 .. 1; rest: shows the empty part."""
        fine = len(self._parts) - 1
        share = min(max(share, 0.0), 1.0) if isfinite(share) else 0.0
        whole, part = divmod(round(share * columns * fine), fine)
        drawn = self._parts[-1] * whole + (self._parts[part] if part else '')
        return drawn.ljust(columns, self._rest if rest else ' ')

    def dial(self, turn):
        """A hand that points 0 .. 1 of a turn away from the right, counterclockwise."""
        return self._hands[round(turn * 8) % 8]


def chosen(stream, plain=False):
    """The Glyphs that the encoding of a stream allows."""
    try:
        '█→'.encode(stream.encoding or 'ascii')
    except UnicodeEncodeError:
        plain = True
    return Glyphs(plain)
