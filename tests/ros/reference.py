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

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
REFERENCE = 'doc/reference.md'
SCENE = 'launch/scenes/paper_periodic.yaml'
# parameters of that scene that are not as usual
OWN = 'warmup', 'duration'
# lines of most messages, which the chapter describes once
COMMON = (
    'std_msgs/Header header          # stamp: wall time at which the message was made',
    'string run_id                   # name of the run, the same in all messages of a run',
    'float64 sim_time                # simulated time since the start of the run [time units]',
)


# when a number is not known; the chapter says what it is then
OBVIOUS = r'; (?:NaN|-1) [^;\[]*(?=( \[|$|;))'


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


def listed(folder, suffix):
    return sorted(name for name in os.listdir(os.path.join(ROOT, folder)) if name.endswith(suffix))


def table(titles, rows):
    lines = [' | '.join(line) for line in (titles, *rows)]
    lines.insert(1, '|'.join(['---'] * len(titles)))
    return '\n'.join(lines) + '\n'


def escaped(text):
    return text.replace('|', r'\|').replace('*', r'\*').replace('<', '&lt;')


def code(text):
    return '`' + text.replace('|', r'\|') + '`' if text else 'empty'


def launch_arguments():
    """Each file, and its arguments that can be given; neighbours that are told alike in one row."""
    sections = []
    for name in listed('launch', '.launch'):
        rows = []
        for arg in ElementTree.fromstring(read('launch', name)).findall('arg'):
            told = [code(arg.get('default')), escaped(arg.get('doc', ''))]
            if arg.get('value') is None and rows and rows[-1][1:] == told:
                rows[-1][0] += ', ' + code(arg.get('name'))
            elif arg.get('value') is None:
                rows.append([code(arg.get('name')), *told])
        sections.append(f'### {name}\n\n' + table(['argument', 'default', 'what'], rows))
    return '\n'.join(sections)


def message_rows(lines):
    """A row for each comment with all its fields; a plain error is with its field."""
    rows = []
    for line in lines:
        found = re.match(r'(\S+)\s+(\w+)(?:\s*=\s*(\S+))?\s*(?:#\s*(.*))?$', line)
        if not found or line in COMMON:
            continue
        kind, field, value, what = found.groups()
        if value is not None:
            field += '=' + value
        elif kind.endswith('[]'):
            field += '[]'
        if not kind[0].isupper():  # numbers and texts
            kind = ''
        what = re.sub(OBVIOUS, '', what or '')
        if not what or what.startswith('[') or re.match(r'standard error(?: \[|$)', what):
            unit = what if what.startswith('[') and what != '[-]' else ''
            rows[-1][0] += ', ' + f'{code(field)} {unit}'.strip()
        else:
            rows.append([code(f'{kind.replace("[]", "")} {field}'.strip()), escaped(what)])
    return rows


def is_comment(line):
    return line.startswith('#')


def message_head(lines):
    """What stands above the first field: its paragraphs."""
    head = [line[1:].strip() for line in itertools.takewhile(is_comment, lines)]
    return escaped('\n'.join(head))


def message_fields():
    sections = []
    for name in listed('msg', '.msg'):
        lines = read('msg', name).splitlines()
        rows = table(['field', 'what'], message_rows(lines))
        sections.append(f'### {name[:-4]}\n\n{message_head(lines)}\n\n{rows}')
    return '\n'.join(sections)


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
    'launch/*.launch': launch_arguments,
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
