"""Panels, which are lists of lines -> the lines on a screen, each a list of (text, style).
Important panels get room first; the two tables share what is left. A line that is too long goes on
below."""

import textwrap

from hdlyap.data.reader import plain

GAP = '   '
INDENT = 4 * ' '  # before a line that continues the one above
MORE = '  {} more'  # in the heading of a table that is cut
# panels from the top down; panels other than tables, by importance if there is no room for all;
# panels by who first gets an empty line before it
ORDER = ('head', 'progress', 'numbers', 'table', 'phases', 'cost', 'diagnosis', 'keys')
FIRST = ('progress', 'diagnosis', 'head', 'numbers', 'keys', 'cost')
SPACED = ('table', 'phases', 'cost', 'diagnosis', 'numbers', 'keys', 'progress')


def arranged(panels, size):
    """The lines on the screen, at most as many as it has. panels: {panel: lines}."""
    width, left = size
    shown = {}
    for name, lines in panels.items():
        shown[name] = [piece for line in lines for piece in wrapped(line, width)]
    for name in FIRST:
        shown[name] = shown[name][:left]
        left -= len(shown[name])
    room = min(len(shown['phases']), max(left // 3, left - len(shown['table'])))
    shown['phases'] = shortened(shown['phases'], room, width)
    shown['table'] = shortened(shown['table'], left - room, width)
    spare = size[1] - sum(map(len, shown.values()))
    spaced = [name for name in SPACED if shown[name]][:spare]
    return [line for name in ORDER for line in [[]] * (name in spaced) + shown[name]]


def shortened(table, room, width):
    """The part of a table that there is room for. Its heading says how many rows are missing; there
    is no heading without a row."""
    if len(table) <= room:
        return table
    if room < 2:
        return table[:room] if len(table) == 1 else []
    more = MORE.format(len(table) - room)
    heading = table[0] + [(more, 'faint')] if length(table[0]) + len(more) <= width else table[0]
    return [heading] + table[1:room]


def flow(cells, width, gap=GAP):
    """Puts as many cells into each line as fit side by side; a cell is a text or (text, style)."""
    lines = []
    for cell in cells:
        span = (cell, '') if isinstance(cell, str) else cell
        if lines and length(lines[-1]) + len(gap) + len(span[0]) <= width:
            lines[-1] += [(gap, ''), span]
        else:
            lines.append([span])
    return lines


def wrapped(line, width):
    """Breaks a line into lines, at spaces if there are any. Control characters are replaced, as
    a node must not control the terminal."""
    line = [(plain(text, len(text)), style) for text, style in line]
    if length(line) <= width:
        return [line]
    text = ''.join(text for text, _ in line)
    styles = [style for text, style in line for _ in text]
    indent = INDENT if width > 4 * len(INDENT) else ''
    lines, end = [], 0
    for piece in textwrap.wrap(text, width, subsequent_indent=indent, break_on_hyphens=False):
        pad = indent if lines else ''
        begin = text.index(piece[len(pad) :], end)
        end = begin + len(piece) - len(pad)
        lines.append([(pad, ''), *zip(text[begin:end], styles[begin:end])])
    return lines


def length(line):
    return sum(len(text) for text, _ in line)
