"""Texts and lines, a line a list of (text, style) -> lines that are no wider than the screen, with
nothing of them lost."""

GAP = '   '
INDENT = 4  # columns before what goes on in a line of its own


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
    """The lines that it becomes, broken at spaces as far as there are any."""
    lines, pad = [], []
    while length(pad) + length(line) > width:
        end, begin = _break(''.join(text for text, _ in line), width - length(pad))
        lines.append(pad + spans(line, 0, end))
        line = spans(line, begin, length(line))
        pad = [(' ' * INDENT, '')] if width > 4 * INDENT else []
    return lines + [pad + line] if line else lines


def _break(text, width):
    """(end of what fits, begin of what is left)"""
    first = len(text) - len(text.lstrip())
    space = text.rfind(' ', first, width + 1)
    end = space if space > 0 else width
    return len(text[:end].rstrip()), len(text) - len(text[end:].lstrip())


def spans(line, begin, end):
    """The line's columns from begin to end."""
    kept, at = [], 0
    for text, style in line:
        part = text[max(0, begin - at) : max(0, end - at)]
        if part:
            kept.append((part, style))
        at += len(text)
    return kept


def joined(names, room):
    """T(1,0)+T(0,1), or as many of them as there is room for, and how many are left."""
    for count in range(len(names), 0, -1):
        left = len(names) - count
        text = '+'.join([*names[:count], *([f'{left} more'] if left else [])])
        if len(text) <= room:
            return text
    return names[0]


def length(line):
    return sum(len(text) for text, _ in line)
