"""The documents against the sources: tables, links, tags of equations, names and files that they
mention. Needs no ROS master."""

import os
import re
import unittest

import reference
from hdlyap import topics
from reference import REFERENCE, ROOT, listed, read

NODE, TOPICS = 'hdlyap_ros/src/node', 'hdlyap_ros/src/topics'
TABLES = {
    'topic': 'README.md',
    'header': 'doc/wrapper.md',
    'folder': 'doc/core.md',
}  # the others are in REFERENCE
# messages of others that hdlyap publishes
FOREIGN = {'Diagnostic': 'diagnostic_msgs/DiagnosticArray'}

# where a path that a document names may begin; what is made, or is of others
PLACES = '', 'doc', 'hdlyap_core', 'hdlyap_core/include', 'hdlyap_core/src', 'hdlyap_ros/include'
MADE = 'build/', 'share/', 'results/', 'log/', 'under_way/', 'std_msgs/'


def files(*patterns):
    """Those under version control, or of a copy without it, that are no build."""
    found = []
    for folder, below, names in os.walk(ROOT):
        below[:] = [name for name in below if name not in ('.git', 'build', '__pycache__')]
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in names]
    return sorted(path for path in found if re.search('|'.join(patterns), path))


def documents():
    return files(r'\.md$')


def table(title):
    """Rows of the table whose first column has that title: name -> the other cells."""
    lines = read(TABLES.get(title, REFERENCE)).splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith('| %s |' % title)) + 2
    rows = {}
    for line in lines[first:]:
        if not line.startswith('|'):
            break
        name, *cells = (cell.strip() for cell in re.split(r'(?<!\\)\|', line.strip('| ')))
        rows.update((one, cells) for one in re.findall(r'`([^`]+)`', name) or [name])
    return rows


# ---- what the sources say ---------------------------------------------------------------------


def sources(folder=NODE):
    return ''.join(read(folder, name) for name in listed(folder, '.c'))


def type_of(struct):
    """Of the wrapper's name for a message, hdr_mode_field: hdlyap/ModeField."""
    name = ''.join(part.capitalize() for part in struct[len('hdr_') :].split('_'))
    return FOREIGN.get(name, 'hdlyap/' + name)


def rows():
    """Topic -> type, stages, what it is: the table of topics."""
    text = re.sub(r'(?s)/\*.*?\*/', '', read(TOPICS, 'rows.inc'))
    found = re.findall(r'TOPIC\((\w+), (\w+), (\w+),\s+([\w |]+)\)', text)
    assert len(found) == text.count('TOPIC(')
    return {name: (type, stages, set(what.split(' | '))) for name, type, stages, what in found}


def advertised():
    """Topic -> type, of the table of topics and of those advertised by name."""
    text = sources()
    found = {'~' + name: 'hdr_' + type for name, (type, *_) in rows().items()}
    found.update(
        (name, struct)
        for struct, name in re.findall(
            r'(hdr_\w+?)_advertise(?:_latched)?\([^;"]*"([~/]\w+)"', text
        )
    )
    return {name: type_of(struct) for name, struct in found.items()}


def services():
    kinds = dict(set_bool='std_srvs/SetBool', trigger='std_srvs/Trigger', set='hdlyap/Set')
    return {
        name: kinds[kind]
        for kind, name in re.findall(r'hdr_service_(\w+)\([^;"]*"(~\w+)"', sources())
    }


def body(text, name):
    return re.search(name + r'\([^)]*\)\s*\{(.*?)\n\}', text, re.DOTALL).group(1)


def names_of_messages():
    """That the wrapper's names for messages and their constants have."""
    found = set()
    for name in listed('msg', '.msg'):
        struct = re.sub(r'(?<!^)(?=[A-Z])', '_', name[:-4]).lower()
        constants = re.findall(r'(?m)^\w+ ([A-Z]\w*) *=', read('msg', name))
        found |= {'hdr_' + struct, *('HDR_%s_%s' % (struct.upper(), c) for c in constants)}
    return found


def anchors(text):
    """Of its headings, as they are made of them."""
    headings = re.findall(r'(?m)^#+ (.*)$', re.sub(r'(?s)```.*?```', '', text))
    return {re.sub(r'[^\w\- ]', '', heading).lower().replace(' ', '-') for heading in headings}


class Tables(unittest.TestCase):
    def test_topics(self):
        rows = table('topic')
        self.assertGreater(len(rows), 8)
        self.assertEqual({name: cells[0] for name, cells in rows.items()}, advertised())

    def test_services(self):
        self.assertEqual({name: cells[0] for name, cells in table('service').items()}, services())
        self.assertGreater(len(services()), 2)

    def test_headers_of_the_core(self):
        said = [
            name
            for cells in table('folder').values()
            for name in re.findall(r'`(\w+\.h)`', cells[1])
        ]
        headers = listed('hdlyap_core/include/hdlyap', '.h')
        self.assertEqual(sorted(said + ['hdlyap.h']), headers)
        folders = {path.split('/')[2] for path in files(r'^hdlyap_core/src/')}
        self.assertEqual({name.strip('/') for name in table('folder')}, folders)

    def test_headers_of_the_wrapper(self):
        """With all of their functions, and no name that is not in them; messages.h is made at
        build time."""
        folder = 'hdlyap_ros/include/hdlyap_ros'
        rows = table('header')
        self.assertEqual(set(rows) - {'messages.h'}, set(listed(folder, '.h')) - {'hdlyap_ros.h'})
        for name in set(rows) - {'messages.h'}:
            code = re.sub(r'(?s)/\*.*?\*/', '', read(folder, name))
            said = set(re.findall(r'`(hdr_(?!x_)\w+)`', rows[name][0]))
            self.assertEqual(said - set(re.findall(r'\w+', code)), set(), name)
            self.assertEqual(set(re.findall(r'\b(hdr_\w+)\(', code)) - said, set(), name)

    def test_diagnostics(self):
        keys = re.findall(r'add_(?:text|number)\(list, "([^"]+)"', sources())
        self.assertGreater(len(keys), 10)
        self.assertEqual(sorted(table('key')), sorted(keys))
        conditions = read(NODE, 'conditions.c')
        levels = re.findall(r'(?m)^\| (ERROR|WARN) \|', read(REFERENCE))
        for level, function in (('ERROR', 'add_errors'), ('WARN', 'add_warnings')):
            self.assertEqual(
                levels.count(level), len(re.findall(r'\badd\(all', body(conditions, function)))
            )

    def test_exit_statuses(self):
        named = dict(re.findall(r'(EXIT_\w+) = (\d)', read(NODE, 'node.c')))
        self.assertEqual(len(named), 4)
        self.assertEqual(set(table('status')), {'0', *named.values()})

    def test_topics_of_parameters(self):
        """Those that are allowed and those that there are."""
        observable = {'TOPIC_OBSERVABLE'}
        awaited = observable | {'TOPIC_ALWAYS'}
        for parameter, kinds in (('observables', observable), ('wait_for_subscribers', awaited)):
            allowed = table('parameter')[parameter][0].split('out of ')[1]
            self.assertEqual(
                allowed.split(', '), [name for name, (*_, what) in rows().items() if what & kinds]
            )

    def test_topics_of_the_tools(self):
        """What record takes, and what bags are read as."""
        kept = {
            name: type_of('hdr_' + type)
            for name, (type, _, what) in rows().items()
            if 'TOPIC_FOR_VIEWERS' not in what
        }
        self.assertEqual({name: kind._type for name, kind in topics.RECORDED.items()}, kept)

    def test_checkpoint_format(self):
        header = read('hdlyap_core/include/hdlyap/checkpoint.h')
        number = re.search(r'HD_CHECKPOINT_FORMAT = (\d+)', header).group(1)
        stated = re.search(r'\| format \((\d+)\)', read('doc/survival.md')).group(1)
        self.assertEqual(stated, number)

    def test_what_is_generated(self):
        """reference.py --write is due otherwise."""
        for path, follows in (
            (REFERENCE, reference.written),
            (reference.SCENE, reference.scene_written),
        ):
            self.assertEqual(read(path), follows(read(path)), path)


class Text(unittest.TestCase):
    def test_links(self):
        """What is linked exists, its heading too."""
        count = 0
        for path in documents():
            text = re.sub(r'(?s)```.*?```', '', read(path))
            for target in re.findall(r'\]\(([^)\s]+)\)', text):
                if '://' in target:
                    continue
                count += 1
                name, _, anchor = target.partition('#')
                there = os.path.normpath(os.path.join(os.path.dirname(path), name))
                there = there if name else path
                self.assertTrue(os.path.exists(os.path.join(ROOT, there)), (path, target))
                if anchor:
                    self.assertIn(anchor, anchors(read(there)), (path, target))
        self.assertGreater(count, 50)

    def test_tags(self):
        """Equations that are cited are in THEORY, and each is cited."""
        known = re.findall(r'(?m)^\*\*\[(T\d+)\]', read('hdlyap_core/THEORY.md'))
        self.assertEqual(known, ['T%d' % k for k in range(1, len(known) + 1)])
        cited = {}
        for path in files(r'\.[ch]$', r'\.[ch]pp$', r'\.py$', r'\.md$'):
            for tag in re.findall(r'\[(T\d+)\]', read(path)):
                cited.setdefault(tag, path)
        self.assertEqual(set(cited) - set(known), set(), cited)
        self.assertEqual(set(known) - set(cited), set())

    def test_names(self):
        """Of functions, types and constants of C."""
        known = set(re.findall(r'\w+', ' '.join(read(path) for path in files(r'\.[ch]$'))))
        known |= names_of_messages()
        for path in documents():
            for name in re.findall(r'\b(?:hdr?_|HDR?_)\w+', read(path)):
                stem = re.sub('_(advertise(_latched)?|publish|subscribe|callback)$', '', name)
                self.assertTrue(known & {name, stem} or stem == 'hdr_x', (path, name))

    def test_files(self):
        """Those that documents name by their path."""
        for path in documents():
            for name in re.findall(r'`((?:[\w.]+/)+[\w.]*)`', read(path)):
                if not name.startswith(MADE):
                    self.assertTrue(
                        any(os.path.exists(os.path.join(ROOT, place, name)) for place in PLACES),
                        (path, name),
                    )

    def test_lengths(self):
        self.assertLessEqual(len(read('README.md').splitlines()), 200)
        forthcoming = read('CHANGELOG.rst').split('-----------')[1].split('\n\n')[0]
        self.assertLessEqual(len(forthcoming.strip().splitlines()), 12)
