"""View and size of the screen -> the lines on it: what matters most has room first, the two tables
share what is left."""

from . import panels
from .wrap import length, wrapped

ORDER = ('head', 'progress', 'numbers', 'table', 'phases', 'cost', 'diagnosis', 'keys')
TABLES = ('table', 'phases')
# of the others, by importance where there is not room for all
FIRST = ('progress', 'diagnosis', 'head', 'numbers', 'keys', 'cost')
SPACED = ('table', 'phases', 'cost', 'diagnosis', 'numbers', 'keys', 'progress')  # likewise


def lines(view, size, glyphs):
    """At most as many as the screen has; one that says so where a node makes no sense."""
    try:
        return _lines(view, size, glyphs)
    except Exception as error:  # what no check has foreseen: a node may say anything
        return [[(panels.nonsense(error), 'error')], [('q quit', 'faint')]][: size[1]]


def _lines(view, size, glyphs):
    width, height = size
    wanted = {
        'head': panels.head(view, width),
        'progress': panels.progress(view, width, glyphs),
        'numbers': panels.numbers(view, width, height),
        'table': panels.table(view, width),
        'phases': panels.phases(view, glyphs),
        'cost': panels.cost(view, width, glyphs),
        'diagnosis': panels.diagnosis(view),
        'keys': panels.keys(view),
    }
    wanted = {
        name: [piece for line in panel for piece in wrapped(line, width)]
        for name, panel in wanted.items()
    }
    room = allotted({name: len(panel) for name, panel in wanted.items()}, height)
    shown = {name: wanted[name][: room[name]] for name in FIRST}
    shown.update((name, shortened(wanted[name], room[name], width)) for name in TABLES)
    spare = height - sum(map(len, shown.values()))
    spaced = [name for name in SPACED if shown[name]][: max(0, spare)]
    return [line for name in ORDER for line in ([[]] if name in spaced else []) + shown[name]]


def allotted(wanted, height):
    """{panel: lines}"""
    room, left = {}, height
    for name in FIRST:
        room[name] = min(wanted[name], left)
        left -= room[name]
    least = min(wanted['phases'], left // 3)
    room['phases'] = min(wanted['phases'], max(least, left - wanted['table']))
    room['table'] = min(wanted['table'], left - room['phases'])
    return room


def shortened(panel, room, width):
    """A table that is cut says so in its heading, and is nothing without a row."""
    if len(panel) <= room:
        return panel
    if room < 2:
        return panel[:room] if len(panel) == 1 else []
    more = panels.MORE.format(len(panel) - room)
    heading = panel[0] + [(more, 'faint')] if length(panel[0]) + len(more) <= width else panel[0]
    return [heading] + panel[1:room]
