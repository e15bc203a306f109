"""What is said of a release, and what packages are made of: versions, lists of dependencies and of
files that have to agree. Needs no ROS master; tests/packages.sh builds the packages."""

import os
import re
import unittest
import xml.etree.ElementTree as ElementTree

from catkin_pkg.changelog import Changelog, populate_changelog_from_rst
from catkin_pkg.package_version import get_forthcoming_label, rename_section
from test_packaging import ROOT, install_sh, listed, text_of

# of a build by debhelper, and what lets it build the library for several ranks
HELPERS = {'debhelper-compat', 'dh-python', 'libopenmpi-dev', 'cmake'}
# that the C programs and libraries name themselves, or that only a build needs
LINKED = {'liblapacke-dev', 'libopenblas-openmp-dev', 'libyaml-cpp-dev', 'zlib1g-dev'}
BLAS = 'libopenblas0-openmp'  # of libopenblas-openmp-dev: rather than the one with its own threads


def stanzas():
    """Of debian/control, each a table of fields: package -> fields; the source's is ''."""
    found = {}
    for text in text_of('debian/control').strip().split('\n\n'):
        fields = dict(re.findall(r'(?m)^([\w-]+):((?:.|\n )*)', text))
        found[fields.get('Package', '').strip()] = fields
    return found


def packages_in(field):
    """Names in a list of dependencies, without versions and what debhelper fills in."""
    words = (word.strip() for word in field.split(','))
    return {word.split()[0] for word in words if word and not word.startswith('$')}


def packages_for(*tags):
    """Of Debian, for those dependencies of package.xml."""
    root = ElementTree.parse(os.path.join(ROOT, 'package.xml')).getroot()
    keys = {element.text for element in root if element.tag in tags}
    return set(install_sh('keys', 'debian', *keys))


def installed_by(package):
    return text_of('debian/%s.install' % package).split()


class Version(unittest.TestCase):
    def test_one_version(self):
        """What a release raises, and CHANGELOG.rst gets a section of."""
        found = {
            'package.xml': r'<version>(.*)</version>',
            'hdlyap_core/include/hdlyap/hdlyap.h': r'#define HDLYAP_VERSION "(.*)"',
            'debian/changelog': r'\Ahdlyap \((.*)\)',
            'CITATION.cff': r'(?m)^version: (.*)$',
        }
        said = {path: re.search(how, text_of(path)).group(1) for path, how in found.items()}
        self.assertEqual(len(set(said.values())), 1, said)

    def test_changelog_is_catkins(self):
        """A release made of it as catkin_prepare_release does, and read as bloom does, has all of
        its points."""
        text, version = text_of('CHANGELOG.rst'), '9.8.7'
        label = get_forthcoming_label(text)
        self.assertEqual(label, 'Forthcoming')
        changelog = Changelog('hdlyap')
        populate_changelog_from_rst(
            changelog, rename_section(text, label, version + ' (2026-12-01)')
        )
        self.assertEqual(list(changelog.foreach_version())[-1][0], version)
        points = text.split('-----------\n')[1].split('\n\n')[0]
        [read] = changelog.get_content_of_version(version)
        self.assertEqual(len(read.bullets), len(re.findall(r'(?m)^\* ', points)))


class Debian(unittest.TestCase):
    def test_builds_with_what_install_sh_installs(self):
        """No message in Python: only programs need those."""
        needs = packages_in(stanzas()['']['Build-Depends'])
        wanted = packages_for('buildtool_depend', 'depend', 'build_depend')
        wanted = {name for name in wanted if not re.match(r'python3-.*(msgs|srvs)$', name)}
        self.assertEqual(needs - HELPERS, wanted)
        self.assertLessEqual(needs - {'debhelper-compat', 'dh-python'}, listed('debian'))

    def test_runs_with_what_install_sh_installs(self):
        """Libraries of C and C++ are found by dpkg-shlibdeps, messages by the headers of them."""
        packages = stanzas()
        ours = set(packages) - {''}
        needs = set()
        for name in ours:
            for field in ('Depends', 'Recommends', 'Suggests'):
                needs |= packages_in(packages[name].get(field, ''))
        wanted = packages_for('depend', 'exec_depend', 'build_export_depend') - LINKED
        wanted = {name for name in wanted if not re.match(r'ros-.*-(msgs|srvs)$', name)}
        self.assertLessEqual(wanted, needs)
        self.assertLessEqual(needs - ours - {BLAS}, listed('debian'))

    def test_each_program_is_in_one_package(self):
        """Those that messages and tools alone install are in theirs."""
        alone, whole = installed_by('python3-hdlyap'), installed_by('hdlyap')
        cmake = text_of('CMakeLists.txt')
        scripts = [
            ['usr/lib/hdlyap/' + os.path.basename(name) for name in names.split()]
            for names in re.findall(r'catkin_install_python\(PROGRAMS([^)]*?)DESTINATION', cmake)
        ]
        self.assertEqual(len(scripts), 2)
        self.assertLessEqual(set(scripts[0]), set(whole))
        self.assertEqual(set(alone), {'usr/lib/python3', 'usr/bin/hdlyap', *scripts[1]})
        self.assertEqual(set(alone) & set(whole), set())

    def test_license_is_ours(self):
        """The text of LICENSE, indented as DEP-5 wants it."""
        said = re.search(r'\nLicense: BSD-3-Clause\n((?: .*\n)+)', text_of('debian/copyright'))
        own = text_of('LICENSE').split('All rights reserved.')[1]
        self.assertEqual(re.sub(r'(?m)^ \.$', '', said.group(1)).split(), own.split())
