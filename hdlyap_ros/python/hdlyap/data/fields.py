"""Message -> what its definition says about its fields: what they are, their units, whether -1
means unknown, whether they may be NaN, and the names of the constants that they hold. If a field
has no comment, the comment above it describes it, too."""

import re
from collections import namedtuple
from functools import lru_cache

LINE = re.compile(r'(?m)^[\w/]+(?:\[\])? +(\w+)(?: +# *(.*))?$')
CONSTANT = re.compile(r'(?m)^\w+ +(\w+) *= *(\d+) *# *([^:\n]*)')
CHOICE = re.compile(r'one of (\w+) \.\. (\w+)')
UNIT = re.compile(r'\s*\[([^\]]*)\]\s*$')
UNKNOWN = re.compile(r'(?:^|[;,] )-1 (?!\.\.)')
STANDARD_ERROR = re.compile(r'errors?$')

Field = namedtuple('Field', 'unit unknown what may_be_nan is_choice')


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
        words = above if own.startswith('[') else own or above
        unknown = UNKNOWN.search(words) or STANDARD_ERROR.search(name)
        said = bool(unknown), UNIT.sub('', words), 'NaN' in words, bool(CHOICE.search(words))
        found[name] = Field(_unit(own or above), *said)
        above = words
    return found


def _unit(what):
    found = UNIT.search(what)
    return found.group(1).strip('-') if found else ''
