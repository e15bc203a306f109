#!/usr/bin/env python3
"""What doc/reference.md and launch/scenes/paper_periodic.yaml repeat of the sources: parameters,
launch arguments and message fields.

reference.py --write puts them there; test_documents.py says when that is due. The parameters are
those of the node that ROS finds."""

import itertools
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import roslib.packages
from hdlyap.data import fields

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
REFERENCE = 'doc/reference.md'
SCENE = 'launch/scenes/paper_periodic.yaml'
# parameters of that scene that are not as usual
OWN = 'warmup', 'duration', 'table'
# lines of many messages, which the chapter tells once
COMMON = (
    ('std_msgs/Header', 'header', 'stamp: wall time of the report, the same in all its messages'),
    ('string', 'run_id', 'name of the run, the same in all messages of a run'),
    ('float64', 'sim_time', 'simulated time since the start of the run [time units]'),
    ('float64', 'averaged_time', 'length of the averaging up to the last sample [time units]'),
    ('uint32', 'first_index', 'Lyapunov index of element 0'),
    *(('uint32', n, 'mode numbers of the wave along x, y and z') for n in ('nx', 'ny', 'nz')),
    ('float64', 'wave_number', '|k| of the wave [1/sigma]'),
)
# messages with lines of others, which are told there
ALIKE = dict(
    HydroMode=('LpPhase',), ModeField=('Mode', 'State'), SlowVectors=('State',), TPhase=('LpPhase',)
)

# when a number is not known; the chapter says what it is then
OBVIOUS = r'; (?:NaN|-1) [^;\[]*(?=( \[|$|;))'
# what the field above or the head of the message says
PLAIN_ERROR = r'standard errors? of \w+(?: \[.*)?$'
PARAMETER = r'parameter of this name(?: \[.*)?$'


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


def listed(folder, suffix):
    return sorted(name for name in os.listdir(os.path.join(ROOT, folder)) if name.endswith(suffix))


def escaped(text):
    return text.replace('|', r'\|').replace('*', r'\*').replace('<', '&lt;')


def code(text):
    return '`' + text + '`'


def entries(rows):
    """A list: what is named, and what is said of it."""
    return ''.join(f'- {named}: {said}\n' for named, said in rows)


def launch_arguments():
    """Those that can be given; those that are told alike together."""
    rows = {}
    for arg in ElementTree.fromstring(read('launch', 'run.launch')).findall('arg'):
        if arg.get('value') is None:
            default = arg.get('default')
            named = code(arg.get('name')) + (f' ({code(default)})' if default else '')
            rows.setdefault(escaped(arg.get('doc')), []).append(named)
    return '### run.launch\n\n' + entries((', '.join(names), told) for told, names in rows.items())


def message_lines(name):
    """The text above the first line, and (type, name, comment) of all lines, where a line without
    a comment has that of the line above."""
    lines = read('msg', name + '.msg').splitlines()
    head = list(itertools.takewhile(lambda line: line.startswith('#'), lines))
    found, above = [], ''
    for line in lines[len(head) :]:
        kind, field, own = re.match(r'(\S+)\s+(\S+)\s*(?:#\s*(.*))?$', line).groups()
        above = fields.SHAPE.sub('', own or '') or above
        found.append((kind, field, above))
    return '\n'.join(line[1:].strip() for line in head), found


def field_code(kind, name):
    return code((kind[:-2] + ' ' if kind[0].isupper() else '') + name + kind[-2:] * ('[' in kind))


def said(name, what):
    """The comment of a line without what the chapter or the name says."""
    word, colon, rest = what.partition(': ')
    if colon and word.lower() == name.partition('=')[0].replace('_', ' ').lower():
        what = rest
    what = re.sub(OBVIOUS, '', what).replace('parameter of this name', 'the parameter')
    return what.replace(': one of ', ': ')


def of_both(what):
    return re.sub(r'\b(?:T|LP) (fit|steps)', r'T or LP \1', what)


def message_rows(message):
    """For each comment all its fields; a plain error is with the field above, what is said of the
    T and the LP fit is said once."""
    bases = {line: base for base in ALIKE.get(message, ()) for line in message_lines(base)[1]}
    rows, key = {}, None
    for line in message_lines(message)[1]:
        kind, name, comment = line
        if line in COMMON or re.match(PARAMETER, comment):
            continue
        what = f'as in {bases[line]}' if line in bases else said(name, comment)
        if not re.match(PLAIN_ERROR, what):
            key = of_both(what)
            rows.setdefault(key, ([], set()))[1].add(what)
        rows[key][0].append(field_code(kind, name))
    return [
        (', '.join(names), escaped(key if len(told) > 1 else told.pop()))
        for key, (names, told) in rows.items()
    ]


def message_fields():
    """A section for each message; before them the rules for all, which stand in RunInfo."""
    sections, rules = [], ''
    for name in (file[:-4] for file in listed('msg', '.msg')):
        head, _, more = message_lines(name)[0].partition('\n\n')
        rules += more
        sections.append(f'### {name}\n\n{escaped(head)}\n\n' + entries(message_rows(name)))
    return '\n'.join([escaped(rules) + '\n', *sections])


def node_says(option):
    node = roslib.packages.find_node('hdlyap', 'hdlyap_node')[0]
    return subprocess.run([node, option], check=True, text=True, stdout=subprocess.PIPE).stdout


def parameter_table():
    return node_says('--parameters=table')


def scene_written(scene):
    """The scene file as it follows from the parameters: but for its head and its own values."""
    rows = node_says('--parameters').split('\n\n', 1)[1]
    for name in OWN:
        own = re.search(r'(?m)^%s: .*$' % name, scene).group()
        rows = re.sub(r'(?m)^%s: .*$' % name, own, rows)
    return scene.split('\n\n', 1)[0] + '\n\n' + rows


SECTIONS = {
    'hdlyap_node --parameters=table': parameter_table,
    'launch/run.launch': launch_arguments,
    'msg/*.msg': message_fields,
}


def written(document):
    """The document with these sections as they follow from the sources."""
    for source, section in SECTIONS.items():
        begin, end = f'<!-- of {source} -->\n', f'<!-- end of {source} -->\n'
        before, rest = document.split(begin)
        after = rest.split(end)[1]
        document = before + begin + '\n' + section() + '\n' + end + after
    return document


if __name__ == '__main__':
    if sys.argv[1:] != ['--write']:
        sys.exit(__doc__)
    for path, follows in ((REFERENCE, written), (SCENE, scene_written)):
        text = follows(read(path))
        with open(os.path.join(ROOT, path), 'w') as file:
            file.write(text)
