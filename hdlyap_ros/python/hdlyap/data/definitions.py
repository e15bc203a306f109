"""Definitions of messages, as they stand in a bag -> whether genpy may have them. It writes a
program from them, with their names as they are, and runs it: a bag must not be its author. A few
lines may also ask for more memory than there is."""

import re
from functools import lru_cache

from genmsg import compute_md5
from genmsg.msg_loader import MsgContext, load_depends, load_msg_from_string
from genmsg.msgs import parse_type

TYPE = re.compile(r'[A-Za-z]\w*/[A-Za-z]\w*', re.ASCII)
MD5SUM = re.compile(r'[0-9a-f]{32}')
STRING = re.compile(r'string +[A-Za-z]\w*[ \t]*=[^\x00-\x08\x0a-\x1f\x7f]*', re.ASCII)
NUMBER = re.compile(r'\w+ +[A-Za-z]\w*[ \t]*=[ \t]*[-+.\w]+[ \t]*(#.*)?', re.ASCII)
BETWEEN = '\n' + '=' * 80 + '\n'  # the parts
LARGEST = 100000  # characters
FIELDS = 10000  # of a message with all its parts, each element of an array of fixed length


class Refused(Exception):
    """What is wrong with a definition."""


def check(connections):
    """Of rosbag."""
    for one in connections:
        _check(one.datatype, one.md5sum, one.msg_def)


@lru_cache(maxsize=1000)
def _check(kind, md5sum, text):
    if not TYPE.fullmatch(kind) or not MD5SUM.fullmatch(md5sum):
        raise Refused(f'a topic of type {kind}, md5sum {md5sum}')
    if '\\' in text:  # would end the text that it is within the program
        raise Refused(f'{kind}: its definition has a backslash')
    if len(text) > LARGEST:
        raise Refused(f'{kind}: a definition of {len(text)} characters')
    own, *others = text.replace('roslib/Header', 'std_msgs/Header').split(BETWEEN)
    context = MsgContext.create_default()
    specs = {kind: _spec(context, kind, own)}
    for other in others:
        first, _, rest = other.partition('\n')
        name = first.partition('MSG: ')[2].strip()
        if not TYPE.fullmatch(name):
            raise Refused(f'{kind}: its definition has a part {first}')
        specs[name] = _spec(context, name, rest)
    number = _fields(kind, specs, {})
    if number > FIELDS:
        raise Refused(f'{kind}: its definition has {number} fields')
    load_depends(context, specs[kind], {})
    if compute_md5(context, specs[kind]) != md5sum:
        raise Refused(f'{kind}: its definition is not the one of md5sum {md5sum}')


def _spec(context, name, text):
    for line in map(str.strip, text.split('\n')):
        plain = STRING if line.startswith('string ') else NUMBER
        if '=' in line.partition('#')[0] and not plain.fullmatch(line):
            raise Refused(f'{name}: its definition has a line {line}')
    return load_msg_from_string(context, text, name)


def _fields(kind, specs, known):
    """Their number, which `known` gets of each type on the way."""
    if kind not in specs:
        return 1
    if kind not in known:
        known[kind] = None  # while its parts are counted
        parts = map(parse_type, specs[kind].types)
        known[kind] = sum((n or 1) * _fields(part, specs, known) for part, _, n in parts) or 1
    if known[kind] is None:
        raise Refused(f'{kind}: its definition is a part of itself')
    return known[kind]
