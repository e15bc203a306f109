#!/usr/bin/env python3
"""README's tables of topics, services, parameters and launch arguments against the sources. Needs
no ROS master."""

import os
import re
import unittest
import xml.etree.ElementTree as ElementTree

import yaml

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
NODE = 'hdlyap_ros/src/node'
REFERENCE = 'launch/scenes/paper_periodic.yaml'
# defaults whose values in C are names
NAMED = {
    'HD_EXPONENTS_POSITIVE': 'positive',
    '{HD_PERIODIC, HD_PERIODIC}': 'periodic',
    'HD_STORAGE_MEMORY': 'memory',
}
BYTES = {'covariant_memory': 1e9}  # of the core, in the unit of the parameter

UNIT = r'\[([\w/ ^]+)\]'


def text_of(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


def listed(*path):
    return sorted(os.listdir(os.path.join(ROOT, *path)))


def table(title):
    """Rows of README's table whose first column has that title: name without backquotes -> the
    other cells."""
    lines = text_of('README.md').splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith('| %s |' % title)) + 2
    rows = {}
    for line in lines[first:]:
        if not line.startswith('|'):
            break
        name, *cells = (cell.strip() for cell in re.split(r'(?<!\\)\|', line)[1:-1])
        rows[re.search(r'`([^`]+)`', name).group(1)] = cells
    return rows


# ---- what the sources say ---------------------------------------------------------------------


def sources(folder=NODE):
    return ''.join(text_of(folder, name) for name in listed(folder) if name.endswith('.c'))


def types_of_views():
    """hdr_x -> package/Message, as the wrapper's headers say."""
    folder = 'hdlyap_ros/include/hdlyap_ros'
    text = ''.join(text_of(folder, name) for name in listed(folder))
    return {
        view: kind
        for kind, view in re.findall(
            r'/\*\* (\w+/\w+)\b(?:[^*]|\*(?!/))*\*/\s*typedef struct (hdr_\w+)', text
        )
    }


def advertised():
    """Topic -> type, of the table of topics and of those advertised by name."""
    names = dict(re.findall(r'\[(TOPIC_\w+)\] = \{"(\w+)"', text_of(NODE, 'topic.c')))
    outlets = text_of(NODE, 'outlets.c')
    views = {
        topic: view or 'hdr_run_info'
        for topic, view in re.findall(
            r'\[(TOPIC_\w+)\] = (?:(hdr_\w+)|run_info)_advertise', outlets
        )
    }
    assert names.keys() == views.keys()
    found = {'~' + name: views[topic] for topic, name in names.items()}
    found.update(
        (name, view)
        for view, name in re.findall(r'(hdr_\w+)_advertise\([^;"]*"([~/]\w+)"', sources())
    )
    return {name: types_of_views()[view] for name, view in found.items()}


def services():
    kinds = dict(set_bool='std_srvs/SetBool', trigger='std_srvs/Trigger')
    return {
        name: kinds[kind]
        for kind, name in re.findall(r'hdr_service_(\w+)\([^;"]*"(~\w+)"', sources())
    }


def parameters():
    """Name -> where in settings, in the order of the node's table."""
    return dict(
        re.findall(
            r'\{"(\w+)", read_\w+,\s*offsetof\(settings, ([\w.\[\]]+)\)\}',
            text_of(NODE, 'settings.c'),
        )
    )


def body(text, name):
    return re.search(name + r'\([^)]*\)\s*\{(.*?)\n\}', text, re.DOTALL).group(1)


def default_in_code(field):
    """As it is initialised; None if it is left zero."""
    in_scene = field.startswith('def.')
    text = (
        body(text_of('hdlyap_core/src/scene.c'), 'hd_scene_def_default')
        if in_scene
        else body(text_of(NODE, 'settings.c'), r'static settings defaults')
    )
    inner, last = re.fullmatch(r'(?:def\.)?(?:(\w+)\.)?(\w+)(?:\[\d\])?', field).groups()
    if inner:
        text = re.search(r'\.%s = \{(.*?)\}' % inner, text).group(1) + ','
    value = re.search(r'\.%s = (\{.*?\}|[^,{}]+)(?=,)' % last, text)
    if not value:
        return None
    text_of_choice = re.match(r'\{\.text = "(\w+)"', value.group(1))
    return text_of_choice.group(1) if text_of_choice else value.group(1).strip()


def as_written(name, value):
    """A default of C as README writes it."""
    if value is None:
        return ('0', '[]', '""', 'false')
    if name == 'observables':
        missing = re.findall(r'TOPIC_([A-Z_]+)\)', value)
        return ('all but ' + ', '.join(topic.lower() for topic in missing),)
    if name in BYTES:
        return (str(float(value) / BYTES[name]),)
    if name == 'interval' and float(value) == 0.0:
        return ('auto',)
    return (NAMED.get(value, value), value.strip('"'), '"%s"' % value)


def same(a, b):
    try:
        return float(a) == float(b)
    except ValueError:
        return a == b


def references():
    """Name -> the comment above it in the reference scene, in one line."""
    found, comment, fresh = {}, '', True
    for line in text_of(REFERENCE).splitlines():
        if line.startswith('#'):
            comment = line[1:] if fresh else comment + ' ' + line[1:]
            fresh = False
        elif re.match(r'\w+:', line):
            found[line.split(':')[0]] = re.sub(r'\s+', ' ', comment)
            fresh = True
        else:
            fresh = True
    return found


def numbers(text):
    return {
        float(number)
        for number in re.findall(r'(?<![\w.^/])\d+(?:\.\d+)?(?:e-?\d+)?(?![\w^])', text)
    }


class Tables(unittest.TestCase):
    def test_topics(self):
        rows = table('topic')
        self.assertGreater(len(rows), 8)
        self.assertEqual({name: cells[0] for name, cells in rows.items()}, advertised())

    def test_services(self):
        self.assertEqual({name: cells[0] for name, cells in table('service').items()}, services())
        self.assertGreater(len(services()), 2)

    def test_messages(self):
        """Each is the type of a topic, or an element of another one."""
        kinds = {cells[0] for cells in table('topic').values()}
        messages = {name[:-4]: text_of('msg', name) for name in listed('msg')}
        for name in messages:
            if 'hdlyap/' + name not in kinds:
                self.assertTrue(
                    any(
                        re.search(r'(?m)^%s(\[\d*\])? ' % name, text) for text in messages.values()
                    ),
                    name,
                )

    def test_parameters_are_all_there(self):
        self.assertGreater(len(parameters()), 20)
        self.assertEqual(set(table('parameter')), set(parameters()))
        self.assertEqual(set(references()), set(parameters()))
        self.assertEqual(set(yaml.safe_load(text_of(REFERENCE))), set(parameters()))

    def test_defaults(self):
        for name, field in parameters().items():
            readme = table('parameter')[name][1]
            in_code = as_written(name, default_in_code(field))
            with self.subTest(name=name, readme=readme, in_code=in_code):
                self.assertTrue(any(same(readme, value) for value in in_code))
                self.check_reference(name, readme)

    def check_reference(self, name, default):
        said = re.search(r'Default: (.*?)\.?$', references()[name].strip()).group(1)
        if name == 'observables':
            observable = set(re.findall(r'\w+', said)) | set(default[len('all but ') :].split(', '))
            self.assertEqual(
                observable,
                {topic[1:] for topic in advertised() if topic.startswith('~')}
                - {'run_info', 'cost', 'markers'},
            )
        else:  # one comment may be that of two parameters
            self.assertTrue(
                same(default, said) or all(same(default, part) for part in said.split(', ')), said
            )

    def test_ranges_and_units(self):
        """No other numbers than those of the reference, and its unit; one comment may be that of
        two parameters."""
        units = {}
        for name, (allowed, _, _) in table('parameter').items():
            comment = references()[name].split('Default:')[0]
            with self.subTest(name=name, allowed=allowed, comment=comment):
                self.assertLessEqual(numbers(allowed), numbers(comment))
            units.setdefault(comment, set()).update(re.findall(UNIT, allowed))
        for comment, found in units.items():
            self.assertEqual(found, set(re.findall(UNIT, comment)), comment)

    def test_launch_arguments(self):
        rows = table('launch file')
        found = {}
        for name in listed('launch'):
            if name.endswith('.launch'):
                arguments = ElementTree.fromstring(text_of('launch', name)).findall('arg')
                found[name] = [a.get('name') for a in arguments if a.get('value') is None]
        self.assertEqual(
            {name: re.findall(r'`(\w+)`', cells[0]) for name, cells in rows.items()}, found
        )

    def test_scenes(self):
        """Those that README names exist."""
        for name in re.findall(r'scene:=(\w+)(?![\w.])', text_of('README.md')):
            self.assertIn(name + '.yaml', listed('launch/scenes'))


if __name__ == '__main__':
    unittest.main()
