"""Message -> what its definition says of its fields: what they are, their units, whether -1 means
unknown, and the names of the constants that they hold. A field without words of its own belongs to
the comment above it."""

import re
from collections import namedtuple
from functools import lru_cache

LINE = re.compile(r'(?m)^[\w/]+(?:\[\])? +(\w+)(?: +# *(.*))?$')
CONSTANT = re.compile(r'(?m)^\w+ +(\w+) *= *(\d+) *# *([^:\n]*)')
CHOICE = re.compile(r'one of (\w+) \.\. (\w+)')
UNIT = re.compile(r'\s*\[([^\]]*)\]\s*$')
UNKNOWN = re.compile(r'(?:^|[;,] )-1 (?!\.\.)')
STANDARD_ERROR = re.compile(r'errors?$')

Field = namedtuple('Field', 'unit unknown what')


def of(message):
    """{name: Field} of a message or of its type; a unit is empty where there is none."""
    return _parsed(message._full_text)


def words(message, field):
    """{value: name} of a field that is 'one of FIRST .. LAST': a constant's name is what its
    comment says before its first colon."""
    own = _own(message._full_text)
    first, last = CHOICE.search(dict(LINE.findall(own))[field]).groups()
    constants = CONSTANT.findall(own)
    names = [name for name, _, _ in constants]
    chosen = constants[names.index(first) : names.index(last) + 1]
    return {int(value): word.strip() for _, value, word in chosen}


def _own(text):
    """What follows are the types that it is made of."""
    return text.partition('=' * 80)[0]


@lru_cache(maxsize=None)
def _parsed(text):
    found, above = {}, ''
    for name, own in LINE.findall(_own(text)):
        words = above if own.startswith('[') else own or above
        unknown = UNKNOWN.search(words) or STANDARD_ERROR.search(name)
        found[name] = Field(_unit(own or above), bool(unknown), UNIT.sub('', words))
        above = words
    return found


def _unit(what):
    found = UNIT.search(what)
    return found.group(1).strip('-') if found else ''
