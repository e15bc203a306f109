"""What others rely on without running anything: names of dependencies, files that Ubuntu 20.04 and
ROS Noetic (CMake 3.16, Python 3.8) read as well, and what the messages say about their fields.
Needs no ROS master."""

import ast
import functools
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree
from types import SimpleNamespace

import yaml
from hdlyap.data import fields

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
ROSDEP = '/usr/share/python3-rosdep2/debian.yaml'

# commands, options and variables that CMake has only since 3.17 or later
NEWER_CMAKE = re.compile(
    r'cmake_path\(|cmake_language\(|\bendblock\(|ZIP_LISTS|COMMAND_ERROR_IS_FATAL|FILE_SET|'
    r'RUNTIME_DEPENDENCY_SET|TOP_LEVEL\b|CMAKE_CURRENT_FUNCTION|string\(JSON|'
    r'file\((REAL_PATH|ARCHIVE_|CHMOD|CONFIGURE|COPY_FILE)|ENVIRONMENT_MODIFICATION|'
    r'find_(library|program|file|path)\([^)]*REQUIRED|\$<CONFIG:[^>]*,|'
    r'\$<(PATH|LINK_GROUP|LINK_LIBRARY|DEVICE_LINK|IN_LIST_):|'
    r'CMP0(09[89]|1[0-9][0-9])|C_STANDARD (17|23)|CXX_STANDARD (2[0-9])|--test-dir|--preset|--fresh'
)
# of Python's library, since 3.9 or later; its syntax is known to ast
NEWER_PYTHON = re.compile(
    r'\.remove(prefix|suffix)\(|\bmath\.(lcm|nextafter)\(|\bstrict=(True|False)|'
    r'(->|:) (list|dict|tuple)\[|'
    r'functools import [^\\\n]*\bcache\b|itertools import [^\\\n]*\b(pairwise|batched)\b'
)


def files(*endings):
    """Those of the repository, without what is built."""
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in ('build', '.git', '__pycache__')]
        yield from (os.path.join(folder, name) for name in names if name.endswith(endings))


def text_of(path):
    with open(os.path.join(ROOT, path), errors='replace') as file:
        return file.read()


def dependencies(tags='.*depend'):
    package = ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
    return {element.text for element in package if re.fullmatch(tags, element.tag)}


def run_dependencies():
    return dependencies('depend|exec_depend')


def install_sh(*words):
    """What launch/install.sh says of package.xml; it knows each key."""
    script = os.path.join(ROOT, 'launch/install.sh')
    done = subprocess.run([script, *words], check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.split()


def listed(flavour):
    return set(install_sh('list', flavour))


@functools.lru_cache(None)
def of_ros():
    """Keys of package.xml that are packages of ROS."""
    return {
        key for key in dependencies() if install_sh('keys', 'noetic', key)[0].startswith('ros-')
    }


class Dependencies(unittest.TestCase):
    def test_packages_are_rosdeps(self):
        """Where rosdep's own data are installed."""
        if os.path.exists(ROSDEP):
            with open(ROSDEP) as file:
                data = yaml.safe_load(file)
            for key in of_ros():
                packages = set(install_sh('keys', 'debian', key))
                self.assertLessEqual(packages, set(data[key]['debian']), key)

    def test_ros_packages_that_are_imported_are_dependencies(self):
        """At run time, not of the tests alone."""
        found = set()
        for path in files(''):
            text = text_of(path)
            if '/hdlyap_ros/python/' in path and path.endswith('.py') or '/scripts/' in path:
                found |= {module.partition('.')[0] for module in imported(text, ['hdlyap'])}
        found &= of_ros()
        self.assertGreater(len(found), 5)
        self.assertLessEqual(found, run_dependencies())

    def test_ros_programs_of_the_documents_are_dependencies(self):
        """What a user is told to type is there without the packages of the tests."""
        brought = {'rosrun': 'rosbash', 'roscore': 'roslaunch', 'rosparam': 'roslaunch'}
        found = set()
        for name in ('README.md', 'doc/user_guide.md', 'doc/first_hour.md', 'doc/reference.md'):
            found |= set(re.findall(r'(?:^|`|\$\()(ros[a-z]+) (?=[a-z/-])', text_of(name), re.M))
        found = {brought.get(name, name) for name in found}
        self.assertGreater(len(found), 5)
        self.assertLessEqual(found, run_dependencies())

    def test_ros_packages_found_by_cmake_are_dependencies(self):
        found = set()
        for path in ('CMakeLists.txt', 'tests/ros/CMakeLists.txt'):
            text = re.sub(r'#.*', '', text_of(path))
            for names in re.findall(r'COMPONENTS([^)$]*)|NODE_DEPENDS ([^)}]*)\)', text):
                found |= set(' '.join(names).split())
            found |= set(re.findall(r'find_package\((ros\w+)', text))
        self.assertGreater(len(found), 5)
        self.assertLessEqual(found, dependencies())


class Noetic(unittest.TestCase):
    def test_cmake_3_16(self):
        count = 0
        for path in files('CMakeLists.txt', '.cmake', '.sh'):
            with self.subTest(path=path):
                text = re.sub(r'(?m)^\s*#.*', '', text_of(path))
                self.assertIsNone(NEWER_CMAKE.search(text), NEWER_CMAKE.search(text))
                for version in re.findall(r'cmake_minimum_required\(VERSION ([0-9.]+)', text):
                    self.assertLessEqual(tuple(map(int, version.split('.'))), (3, 16))
                    count += 1
        self.assertGreater(count, 3)

    def test_python_3_8(self):
        count = 0
        for path in files(''):
            text = (
                text_of(path) if path.endswith('.py') or '.' not in os.path.basename(path) else ''
            )
            if path.endswith('.py') or re.match(r'#!/usr/bin/(env )?python3\n', text):
                with self.subTest(path=path):
                    ast.parse(text, path, feature_version=(3, 8))
                    self.assertIsNone(NEWER_PYTHON.search(text), NEWER_PYTHON.search(text))
                    count += 1
        self.assertGreater(count, 20)

    def test_scripts_are_installed_as_python(self):
        """And so made executable there; rosrun would find an executable source a second time."""
        cmake = text_of('CMakeLists.txt')
        installed = re.findall(r'catkin_install_python\(PROGRAMS([^)]*?)DESTINATION', cmake)
        programs = set(' '.join(installed).split())
        here = os.path.join(ROOT, 'hdlyap_ros/scripts')
        scripts = [name for name in os.listdir(here) if os.path.isfile(os.path.join(here, name))]
        self.assertEqual(sorted(programs), sorted('hdlyap_ros/scripts/' + name for name in scripts))
        for program in programs:
            self.assertRegex(text_of(program), r'\A#!/usr/bin/(env )?python3\n', program)
            self.assertFalse(os.stat(os.path.join(ROOT, program)).st_mode & 0o111, program)


class Layers(unittest.TestCase):
    """Of the Python package: a folder imports from those before it alone."""

    ORDER = 'data', 'plots', 'follow', 'runs', 'sweep', 'commands'
    DRAWING = 'plots', 'sweep', 'commands'

    def test_imports(self):
        root, count = os.path.join(ROOT, 'hdlyap_ros/python/hdlyap'), 0
        for path in files('.py'):
            name = os.path.relpath(path, root)
            if name.startswith('..') or name == '__init__.py':  # whose load() imports data
                continue
            folder = name.split('/')[0]
            place = self.ORDER.index(folder) if folder in self.ORDER else -1
            text = text_of(path)
            for module in imported(text, ['hdlyap', *name.split('/')[:-1]]):
                first, below = (module.split('.') + [''])[:2]
                if first == 'hdlyap':
                    self.assertNotIn(below, self.ORDER[place + 1 :], (name, module))
                if first == 'matplotlib':
                    self.assertIn(folder, self.DRAWING, name)
                count += first == 'hdlyap'
            self.assertNotRegex(text, r'matplotlib\.use\(|import.* pyplot|matplotlib\.pyplot', name)
        self.assertGreater(count, 100)


def imported(text, package):
    """Names of modules, and of what is taken from them."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else []
            module = [*above, *([node.module] if node.module else [])]
            yield from ('.'.join([*module, alias.name]) for alias in node.names)


class Messages(unittest.TestCase):
    def test_every_field_is_explained(self):
        """By its own comment, or by that of the fields above, which are of the same type."""
        count = 0
        for path in files('.msg', '.srv'):
            above = None
            for number, line in enumerate(text_of(path).splitlines(), 1):
                if line.strip() and not line.startswith('#') and line != '---':
                    said = re.match(r'([\w/]+(?:\[\d*\])?) \w+(?:=\S+)?(?: +# (\S.*))?$', line)
                    self.assertTrue(said, '%s:%d' % (path, number))
                    kind, comment = said.groups()
                    if not comment:
                        self.assertEqual(kind, above, '%s:%d' % (path, number))
                    above = kind
                    count += 1
        self.assertGreater(count, 150)

    def test_units_of_numbers(self):
        """A length, time or rate of change has its unit, wherever it occurs."""
        units = {
            r'sim_time|averaged_time|tracked_time|duration|warmup|equilibration': 'time units',
            r'exponents?|std_errors?|local_exponents|lambda_max|ks_entropy': '1/time unit',
            r'wave_number|max_wave_number': '1/sigma',
            r'\w+_seconds': 's',
            r'p[xyz]': 'sigma/time unit',
            r'box_[xyz]|[xyz]': 'sigma',
            r'phase': 'rad',
            r'omega\w*': 'rad/time unit',
        }
        others = {'Localization': '', 'Average': '', 'CovariantAngle': 'rad'}  # of other units
        count = 0
        for path in files('.msg'):
            text = text_of(path)
            floats = re.findall(r'(?m)^float64(?:\[\])? (\w+)', text)
            for name, field in fields.of(SimpleNamespace(_full_text=text)).items():
                for names, unit in units.items():
                    if name in floats and re.fullmatch(names, name):
                        if name.startswith('std_error'):
                            unit = others.get(os.path.basename(path)[:-4], unit)
                        self.assertEqual(field.unit, unit, '%s: %s' % (path, name))
                        count += 1
        self.assertGreater(count, 80)


class Launch(unittest.TestCase):
    def test_arguments_are_documented(self):
        count = 0
        for path in files('.launch'):
            for argument in ElementTree.parse(path).getroot().findall('arg'):
                self.assertTrue(argument.get('doc'), '%s: %s' % (path, argument.get('name')))
                count += 1
        self.assertGreater(count, 8)
