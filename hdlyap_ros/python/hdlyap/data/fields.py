"""Message -> what its definition says about its fields: what they are, their units, whether -1
means unknown, whether they may be NaN, the names of the constants that they hold, and the shapes of
arrays. If a field has no comment, the comment above it describes it, too."""

import re
from collections import namedtuple
from functools import lru_cache

LINE = re.compile(r'(?m)^[\w/]+(?:\[\])? +(\w+)(?: +# *(.*))?$')
CONSTANT = re.compile(r'(?m)^\w+ +(\w+) *= *(\d+) *# *([^:\n]*)')
CHOICE = re.compile(r'one of (\w+) \.\. (\w+)')
SHAPE = re.compile(r'\s*\{([^}]*)\}((?: @\w+)*)$')
UNIT = re.compile(r'\s*\[([^\]]*)\]\s*$')
UNKNOWN = re.compile(r'(?:^|[;,] )-1 (?!\.\.)')
STANDARD_ERROR = re.compile(r'errors?$')

# shape: names of an array's dimensions, () if it has any length; only: it is empty otherwise
Field = namedtuple('Field', 'unit unknown what may_be_nan is_choice shape only')


def of(message):
    """{name: Field} of a message or of its type. The unit of a field without one is empty."""
    return _parsed(message._full_text)


def words(message, field):
    """{value: name} of a field that is 'one of FIRST .. LAST'. The name of a constant is the text
    before the first colon of its comment."""
    own = _own(message._full_text)
    first, last = CHOICE.search(dict(LINE.findall(own))[field]).groups()
    constants = CONSTANT.findall(own)
    names = [name for name, _, _ in constants]
    chosen = constants[names.index(first) : names.index(last) + 1]
    return {int(value): word.strip() for _, value, word in chosen}


def _own(text):
    """The definition of the message, without the definitions of its fields' types, which follow."""
    return text.partition('=' * 80)[0]


@lru_cache(maxsize=None)
def _parsed(text):
    found, above = {}, ''
    for name, own in LINE.findall(_own(text)):
        shape = SHAPE.search(own)
        dimensions, only = shape.groups() if shape else ('', '')
        own = SHAPE.sub('', own)
        words = above if own.startswith('[') else own or above
        unknown = UNKNOWN.search(words) or STANDARD_ERROR.search(name)
        said = bool(unknown), UNIT.sub('', words), 'NaN' in words, bool(CHOICE.search(words))
        shape = tuple(dimensions.split(', ')) if dimensions else ()
        found[name] = Field(_unit(own or above), *said, shape, frozenset(only.split()))
        above = words
    return found


def _unit(what):
    found = UNIT.search(what)
    return found.group(1).strip('-') if found else ''
