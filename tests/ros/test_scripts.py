#!/usr/bin/env python3
"""What the scripts of launch/ do before they build: packages that are missing, folders that cannot
be written, a home that is not there. Needs no ROS master."""

import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
MISSING = ('liblapacke-dev', 'zlib1g-dev')
LINE = 'apt-get update && apt-get install -y --no-install-recommends ' + ' '.join(MISSING)


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.env = dict(os.environ)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_it(self, *command):
        """Exit status, and the lines of standard output and error."""
        done = subprocess.run(
            command,
            env=self.env,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=60,
        )
        return done.returncode, done.stdout.splitlines()


class Install(Scripts):
    """Each program that install.sh calls is a fake here, or the one link in a folder of its own."""

    def setUp(self):
        super().setUp()
        self.env['PATH'] = self.folder
        for name in ('bash', 'dirname', 'basename', 'env', 'grep'):
            os.symlink(shutil.which(name), self.path(name))
        missing = '|'.join(MISSING)
        self.fake('dpkg-query', f'case $4 in {missing}) ;; *) printf installed ;; esac')
        self.fake('id', 'echo 1000')

    def fake(self, name, text):
        with open(self.path(name), 'w') as file:
            file.write('#!/bin/sh\n%s\n' % text)
        os.chmod(self.path(name), 0o755)

    def install(self):
        return self.run_it('bash', os.path.join(ROOT, 'launch/install.sh'), 'run')

    def test_who_cannot_install(self):
        """Is told what is missing, and the line for an administrator; sudo's own words come
        first."""
        for sudo, said in (
            (None, 'neither root nor sudo'),
            ('echo u is not in the sudoers file; exit 1', 'u is not in the sudoers file'),
            ('[ "$2" != update ] || echo Temporary failure; exit 100', 'Temporary failure'),
        ):
            if sudo:
                self.fake('sudo', sudo)
            status, lines = self.install()
            self.assertEqual((status, lines[-1]), (1, LINE))
            self.assertIn(said, lines)
            self.assertIn('2 packages are missing', lines[-2])

    def test_umask_is_not_handed_on(self):
        """sudo joins the user's with its own."""
        self.fake('sudo', 'echo "$(umask) $*"')
        before = os.umask(0o077)
        self.addCleanup(os.umask, before)
        status, lines = self.install()
        self.assertEqual(status, 0)
        self.assertEqual(
            lines[1:],
            [
                '0022 apt-get update -q',
                '0022 env DEBIAN_FRONTEND=noninteractive '
                + LINE.split(' && ')[1].replace('-y', '-y -q'),
            ],
        )

    def test_nothing_is_missing(self):
        """Then nobody is asked."""
        self.fake('dpkg-query', 'printf installed')
        self.assertEqual(self.install(), (0, []))


class Folders(Scripts):
    """As root may write everywhere, a file stands where a folder is to be."""

    def setUp(self):
        super().setUp()
        self.clone = self.path('a clone')
        shutil.copytree(os.path.join(ROOT, 'launch'), os.path.join(self.clone, 'launch'))

    def demo(self, *options):
        script = os.path.join(self.clone, 'launch/demo.sh')
        return self.run_it(script, '--no-install', '--scene', 'quick', *options)

    def write(self, path):
        with open(path, 'w'):
            pass

    def test_clone_that_is_read_only(self):
        self.write(os.path.join(self.clone, 'build'))
        status, lines = self.demo()
        self.assertEqual((status, len(lines)), (1, 2))
        self.assertIn(os.path.join(self.clone, 'build'), lines[0])
        self.assertIn('--build DIR takes another', lines[1])

    def test_other_folder_of_the_build(self):
        """All goes there: what a clone without sources cannot give is looked for in its log."""
        self.write(os.path.join(self.clone, 'build'))
        other = self.path('an other')
        status, lines = self.demo('--build', other)
        said = f'== building in {other}: minutes, the first time'
        self.assertEqual((status, lines[0]), (1, said))
        self.assertNotIn('could not load cache', '\n'.join(lines))  # as cmake has failed before
        self.assertGreater(os.path.getsize(os.path.join(other, 'log/build.log')), 0)
        self.assertTrue(os.path.isdir(os.path.join(other, 'demo/quick')))

    def test_results_that_cannot_be_written(self):
        self.write(self.path('file'))
        status, lines = self.demo('--out', self.path('file/out'))
        self.assertEqual((status, len(lines)), (1, 2))
        self.assertIn('--out DIR takes another', lines[1])

    def in_environment(self, command):
        text = 'set -euo pipefail; source "$1"; own_environment "$2"; ' + command
        script = os.path.join(self.clone, 'launch/common.sh')
        return self.run_it('bash', '-c', text, 'test', script, self.path('own'))

    def test_home(self):
        """Stays if it can be used."""
        self.env['HOME'] = self.folder
        self.assertEqual(self.in_environment('echo "$HOME"'), (0, [self.folder]))
        self.env['HOME'] = '/proc/nowhere'
        self.assertEqual(self.in_environment('echo "$HOME"'), (0, [self.path('own')]))
        del self.env['HOME']
        self.assertEqual(self.in_environment('echo "$HOME"'), (0, [self.path('own')]))

    def test_encoding_of_names(self):
        """catkin's programs write the name of the clone into files."""
        self.env.update(LC_ALL='C', PYTHONUTF8='0')  # as in a locale that is not UTF-8
        os.mkdir(self.path('\u03c3'))
        there = 'cd "${2%/*}/"$\'\\xcf\\x83\' && '
        writes = 'import os; open(\'f\', \'w\').write(os.getcwd())'
        status, lines = self.in_environment(f'{there} python3 -c "{writes}"')
        self.assertEqual((status, lines), (0, []))


if __name__ == '__main__':
    unittest.main()
