"""plot_bag in this process: python is not started anew, and figures are drawn into no file."""

import contextlib
import io
import os
import re
import runpy
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import made
from hdlyap.plots import figures, recording
from made import SCRIPTS

PLOT_BAG = os.path.join(SCRIPTS, 'plot_bag')


def check_title(figure, name):
    """Scene, disks, density."""
    title = figure._suptitle.get_text() if figure._suptitle is not None else ''
    if not re.match(r'.+: \$N=\d+\$, \$\\rho=[0-9.]+\$', title):
        raise AssertionError(f'{name}: its title is {title!r}')


def draw(figure, folder, name):
    """Instead of figures.save: its files are empty. Every figure names its system."""
    check_title(figure, name)
    files = [os.path.join(folder, f'{name}.{suffix}') for suffix in ('png', 'svg')]
    figure.canvas.draw()
    for path in files:
        with open(path, 'w'):
            pass
    figures.plt.close(figure)
    return files


def plot_bag(*arguments):
    """As if it had been a process."""
    out, error, status = io.StringIO(), io.StringIO(), 0
    with contextlib.ExitStack() as changed:
        changed.enter_context(mock.patch.object(sys, 'argv', [PLOT_BAG, *arguments]))
        changed.enter_context(mock.patch.object(figures, 'save', draw))
        changed.enter_context(contextlib.redirect_stdout(out))
        changed.enter_context(contextlib.redirect_stderr(error))
        try:
            runpy.run_path(PLOT_BAG, run_name='__main__')
        except SystemExit as end:
            status = end.code or 0
    return subprocess.CompletedProcess(arguments, status, out.getvalue(), error.getvalue())


def plot_bag_process(*arguments):
    """As a user starts it."""
    return subprocess.run(
        [sys.executable, PLOT_BAG, *arguments],
        universal_newlines=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def files(*names):
    return [f'{name}.{suffix}' for name in names for suffix in ('png', 'svg')]


class Bags(unittest.TestCase):
    how = staticmethod(plot_bag)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, 'run.bag')
        self.out = os.path.join(folder.name, 'out')

    def write(self, messages, **where):
        made.write(self.path, messages, **where)

    def recorded(self, *messages):
        self.write(messages)
        return recording.read(self.path)

    def plot(self, *arguments):
        return self.how(self.path, '--out', self.out, *arguments)

    def succeeds(self, names, *arguments):
        done = self.plot(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertEqual(sorted(os.listdir(self.out)), sorted(names))
        return done.stdout

    def refuses(self, reason, *arguments):
        done = self.plot(*arguments)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(reason, done.stderr)
        self.assertFalse(os.path.exists(self.out))
