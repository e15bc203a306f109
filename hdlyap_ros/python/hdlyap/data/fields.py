"""Message -> what its definition says of its fields: their units, and which are -1 while unknown. A
bag has the definitions that it was recorded with."""

import re
from collections import namedtuple
from functools import lru_cache

LINE = re.compile(r'(?m)^[\w/]+(?:\[\])? +(\w+) +# *(.*)$')
UNIT = re.compile(r'\[([^\]]*)\]\s*$')
UNKNOWN = re.compile(r'(?:^|[;,] )-1 (?!\.\.)')

Field = namedtuple('Field', 'unit unknown')


def of(message):
    """{name: Field} of a message or of its type; a unit is empty where there is none."""
    return _parsed(message._full_text)


@lru_cache(maxsize=None)
def _parsed(text):
    own = text.partition('=' * 80)[0]  # what follows are the types that it is made of
    return {
        name: Field(_unit(what), bool(UNKNOWN.search(what))) for name, what in LINE.findall(own)
    }


def _unit(what):
    found = UNIT.search(what)
    return found.group(1) if found else ''
