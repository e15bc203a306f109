"""Panels, lists of lines -> the lines on a screen, each a list of (text, style): what matters most
has room first, the two tables share what is left. What is too long goes on below."""

import textwrap

from hdlyap.data.reader import plain

GAP = '   '
INDENT = 4 * ' '  # before what goes on in a line of its own
MORE = '  {} more'  # in the heading of a table that is cut
# panels from the top down; the others than tables by importance, where there is not room for all;
# and before which there is an empty line first
ORDER = ('head', 'progress', 'numbers', 'table', 'phases', 'cost', 'diagnosis', 'keys')
FIRST = ('progress', 'diagnosis', 'head', 'numbers', 'keys', 'cost')
SPACED = ('table', 'phases', 'cost', 'diagnosis', 'numbers', 'keys', 'progress')


def arranged(panels, size):
    """At most as many lines as the screen has, of {panel: lines}."""
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
    """A table that is cut says so in its heading, and is nothing without a row."""
    if len(table) <= room:
        return table
    if room < 2:
        return table[:room] if len(table) == 1 else []
    more = MORE.format(len(table) - room)
    heading = table[0] + [(more, 'faint')] if length(table[0]) + len(more) <= width else table[0]
    return [heading] + table[1:room]


def flow(cells, width, gap=GAP):
    """Lines of as many cells as fit side by side; a cell is a text or (text, style)."""
    lines = []
    for cell in cells:
        span = (cell, '') if isinstance(cell, str) else cell
        if lines and length(lines[-1]) + len(gap) + len(span[0]) <= width:
            lines[-1] += [(gap, ''), span]
        else:
            lines.append([span])
    return lines


def wrapped(line, width):
    """The lines that it becomes, broken at spaces as far as there are any. What a node says must
    not reach the terminal as a command."""
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
