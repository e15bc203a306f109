#!/usr/bin/env python3
"""What others rely on without running anything: names of dependencies, lists of packages, files
that Ubuntu 20.04 and ROS Noetic (CMake 3.16, Python 3.8) read as well, and what the messages say
about their fields. Needs no ROS master."""

import ast
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

# rosdep key: packages of Debian 12 that hdlyap uses of what the key stands for. Of ROS: debian.yaml
# of Debian's python3-rosdep2 0.22.1; on Noetic each is ros-noetic-KEY (noetic/distribution.yaml of
# rosdistro).
OF_ROS = dict(
    catkin='catkin',
    diagnostic_msgs='libdiagnostic-msgs-dev python3-diagnostic-msgs ros-diagnostic-msgs',
    message_filters='libmessage-filters-dev python3-message-filters',
    message_generation='ros-message-generation',
    message_runtime='ros-message-runtime',
    ros_environment='ros-environment',
    rosbag='python3-rosbag',
    rosbash='rosbash',
    roscpp='libroscpp-dev',
    rosgraph='python3-rosgraph',
    rosgraph_msgs='python3-rosgraph-msgs',
    roslaunch='python3-roslaunch',
    roslib='python3-roslib',
    rosmaster='python3-rosmaster',
    rosmsg='python3-rosmsg',
    rosnode='python3-rosnode',
    rospack='rospack-tools',
    rospy='python3-rospy',
    rosservice='python3-rosservice',
    rostest='librostest-dev python3-rostest',
    rostopic='python3-rostopic',
    rviz='rviz',
    std_msgs='libstd-msgs-dev python3-std-msgs ros-std-msgs',
    std_srvs='libstd-srvs-dev python3-std-srvs ros-std-srvs',
    tf2_msgs='libtf2-msgs-dev python3-tf2-msgs',
    visualization_msgs='libvisualization-msgs-dev python3-visualization-msgs '
    'ros-visualization-msgs',
)
# Of the system: base.yaml and python.yaml of rosdistro, the same on Debian and Ubuntu.
# libopenblas-openmp-dev is the one of libopenblas-dev's alternatives that hdlyap is tested with.
OF_SYSTEM = {
    'ccache': 'ccache',
    'ffmpeg': 'ffmpeg',
    'gtest': 'libgtest-dev',
    'imagemagick': 'imagemagick',
    'liblapacke-dev': 'liblapacke-dev',
    'libopenblas-dev': 'libopenblas-openmp-dev',
    'mpi': 'libopenmpi-dev openmpi-bin',
    'ninja-build': 'ninja-build',
    'pkg-config': 'pkg-config',
    'python3-matplotlib': 'python3-matplotlib',
    'python3-numpy': 'python3-numpy',
    'python3-paramiko': 'python3-paramiko',
    'python3-pandas': 'python3-pandas',
    'python3-rospkg': 'python3-rospkg',
    'yaml-cpp': 'libyaml-cpp-dev',
    'python3-scipy': 'python3-scipy',
    'python3-setuptools': 'python3-setuptools',
    'python3-tk': 'python3-tk',
    'python3-yaml': 'python3-yaml',
    'xvfb': 'xvfb',
    'zlib': 'zlib1g-dev',
}
# for the scripts and the tests of a clone, which no package manager runs: compilers, watchers,
# lint, a display
TOOLS = set(
    'build-essential cmake procps python3-xarray libcmocka-dev shellcheck strace valgrind clang '
    'libomp-dev libclang-rt-dev|libclang-common-11-dev catkin-lint python3-catkin-lint xvfb '
    'libxtst6 imagemagick libgl1-mesa-dri '
    'black flake8 clang-format doxygen slurmctld slurmd slurm-client openssh-server '
    'iproute2'.split()
)

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


def dependencies():
    package = ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
    return {element.text for element in package if element.tag.endswith('depend')}


def listed(flavour):
    """What launch/install.sh would install."""
    script = os.path.join(ROOT, 'launch/install.sh')
    return set(
        subprocess.run(
            [script, 'list', flavour], check=True, stdout=subprocess.PIPE, text=True
        ).stdout.split()
    )


class Dependencies(unittest.TestCase):
    def test_keys_are_known(self):
        self.assertEqual(dependencies() - set(OF_ROS) - set(OF_SYSTEM), set())

    def check_list(self, flavour, packages_of_ros):
        wanted = set()
        for key in dependencies():
            wanted |= set(packages_of_ros(key) if key in OF_ROS else OF_SYSTEM[key].split())
        self.assertEqual(listed(flavour) - TOOLS, wanted - TOOLS)

    def test_debian_installs_them(self):
        self.check_list('debian', lambda key: OF_ROS[key].split())

    def test_noetic_installs_them(self):
        self.check_list('noetic', lambda key: ['ros-noetic-' + key.replace('_', '-')])

    def test_table_is_rosdeps(self):
        """Where rosdep's own data are installed."""
        if os.path.exists(ROSDEP):
            with open(ROSDEP) as file:
                data = yaml.safe_load(file)
            for key, packages in OF_ROS.items():
                self.assertLessEqual(set(packages.split()), set(data[key]['debian']), key)

    def test_ros_packages_that_are_imported_are_dependencies(self):
        """At run time, not of the tests alone."""
        root = ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
        known = {one.text for one in root if one.tag in ('depend', 'exec_depend')}
        found = set()
        for path in files(''):
            text = text_of(path)
            if '/hdlyap_ros/python/' in path and path.endswith('.py') or '/scripts/' in path:
                found |= {module.partition('.')[0] for module in imported(text, ['hdlyap'])}
        self.assertGreater(len(found & set(OF_ROS)), 5)
        self.assertLessEqual(found & set(OF_ROS), known)

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
        others = {'Localization': '', 'CovariantAngle': 'rad'}  # errors of what has another unit
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


class Suite(unittest.TestCase):
    """What tests/ros/CMakeLists.txt does not name is not run."""

    def test_every_rostest_is_run(self):
        cmake = text_of('tests/ros/CMakeLists.txt')
        run = re.findall(r'(?:set|list)\((?:APPEND )?(?:FIRST|SECOND)_TIER ([^)]*)\)', cmake)
        run = ' '.join(run).split() + re.findall(r'add_rostest\w*\((?:\w+ )?(\w+)\.test', cmake)
        self.assertEqual(
            sorted(run), sorted(os.path.basename(path)[:-5] for path in files('.test'))
        )

    def test_every_launch_file_is_checked(self):
        checked = re.findall(
            r'roslaunch_add_file_check\(\S*?([\w.]+\.launch)', text_of('tests/ros/CMakeLists.txt')
        )
        self.assertEqual(
            sorted(checked), sorted(os.path.basename(path) for path in files('.launch'))
        )


if __name__ == '__main__':
    unittest.main()
