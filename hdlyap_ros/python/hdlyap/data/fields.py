"""Text of a .msg -> what it says about its fields. The generator reads it with this file, too.

The comment of a field without one of its own, or with only a unit ('# [sigma]') or a shape, is the
one above it. What is sent while a number is not known: 'NaN if FIELD is VALUE', 'NaN unless FIELD',
or the same with -1. VALUE is a number or a constant (0 if there is none), and 'while' means 'if'.
Otherwise a number must be finite; with NaN in its comment but no such rule, it may be NaN at any
time. A field 'one of FIRST .. LAST' holds one of these constants, whose names are the texts before
the first colons of their comments. An array's comment ends with its shape: the names of its
dimensions, as in {vector, particle}, and a word if it is empty: @space in the plane, @turning
unless particles turn, @box without positions in a box, @others unless they have coordinates beside
positions and angle, @fields unless fields are due, @known while it is not known."""

import re
from collections import namedtuple
from functools import lru_cache

LINE = re.compile(r'(?m)^[\w/]+(?:\[\])? +(\w+)(?: +# *(.*))?$')
CONSTANT = re.compile(r'(?m)^\w+ +(\w+) *= *(\d+) *# *([^:\n]*)')
CHOICE = re.compile(r'one of (\w+) \.\. (\w+)')
SHAPE = re.compile(r'\s*\{(\w[^}]*)\}((?: @\w+)*)$')
UNIT = re.compile(r'\s*\[([^\]]*)\]\s*$')
MINUS_ONE = re.compile(r'(?:^|[;,] )-1 (?!\.\.)')
STANDARD_ERROR = re.compile(r'errors?$')
RULE = re.compile(r'(NaN|-1) (if|while|unless) (\w+)(?: is (-?\w+))?')

# unknown: whether -1 means that; choice: names of the first and of the last constant, or None;
# shape: names of an array's dimensions, () if it has any length; only: it is empty otherwise
Field = namedtuple('Field', 'unit unknown what may_be_nan rule choice shape only')
# sent: 'NaN' or '-1', if the other field has this value, or (not if_equal) unless it has
Rule = namedtuple('Rule', 'sent field if_equal value')


def of(message):
    """{name: Field} of a message or of its type. The unit of a field without one is empty."""
    return parsed(message._full_text)


def words(message, field):
    """{value: name} of a field that is 'one of FIRST .. LAST'."""
    return {value: word for _, value, word in choices(message._full_text, field)}


def choices(text, field):
    """[(constant, value, name)] of a field that is 'one of FIRST .. LAST'."""
    constants = [
        (name, int(value), word.strip()) for name, value, word in CONSTANT.findall(_own(text))
    ]
    names = [name for name, _, _ in constants]
    first, last = parsed(text)[field].choice
    return constants[names.index(first) : names.index(last) + 1]


def _own(text):
    """The definition of the message, without the definitions of its fields' types, which follow."""
    return text.partition('=' * 80)[0]


@lru_cache(maxsize=None)
def parsed(text):
    found, above = {}, ''
    lines = LINE.findall(_own(text))
    names = {name for name, _ in lines}
    for name, own in lines:
        shape = SHAPE.search(own)
        dimensions, only = shape.groups() if shape else ('', '')
        own = SHAPE.sub('', own)
        text = above if own.startswith('[') else own or above
        choice = CHOICE.search(text)
        found[name] = Field(
            unit=_unit(own or above),
            unknown=bool(MINUS_ONE.search(text) or STANDARD_ERROR.search(name)),
            what=UNIT.sub('', text),
            may_be_nan='NaN' in text,
            rule=_rule(text, names),
            choice=choice and choice.groups(),
            shape=tuple(dimensions.split(', ')) if dimensions else (),
            only=frozenset(only.split()),
        )
        above = text
    return found


def _rule(text, names):
    found = RULE.search(text)
    if not found or found.group(3) not in names:
        return None
    sent, how, field, value = found.groups()
    # a field alone means: it is not 0
    return Rule(sent, field, (how == 'unless') == (value is None), value or '0')


def _unit(what):
    found = UNIT.search(what)
    return found.group(1).strip('-') if found else ''
