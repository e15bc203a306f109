"""Bags made for a test, and tools that read them in this process: python is not started anew, and
figures are drawn into no file."""

import contextlib
import io
import os
import re
import subprocess
import sys
import tempfile
import unittest
from collections import namedtuple
from unittest import mock

import hdlyap
import made
from hdlyap import commands
from hdlyap.data import seeds

Done = namedtuple('Done', 'status out error')


def tool(name, *arguments):
    """As if it had been a process."""
    out, error, status = io.StringIO(), io.StringIO(), 0
    with contextlib.ExitStack() as changed:
        if name == 'plot':
            changed.enter_context(mock.patch('hdlyap.plots.figures.save', save_nothing))
        changed.enter_context(contextlib.redirect_stdout(out))
        changed.enter_context(contextlib.redirect_stderr(error))
        try:
            status = commands.main([name, *arguments])
        except SystemExit as end:
            status = end.code or 0
    return Done(status, out.getvalue(), error.getvalue())


def process(*arguments, script='hdlyap', **how):
    """As a user starts it."""
    command = [sys.executable, os.path.join(made.SCRIPTS, script), *arguments]
    done = subprocess.run(command, text=True, capture_output=True, **how)
    return Done(done.returncode, done.stdout, done.stderr)


def save_nothing(figure, folder, name, paper=None):
    """Instead of figures.save: its files are empty."""
    if not paper:
        check_title(figure, name)
    suffixes = ['pdf'] if paper else ['png', 'svg']
    files = [os.path.join(folder, f'{name}.{suffix}') for suffix in suffixes]
    for path in files:
        open(path, 'w').close()
    return files


def check_title(figure, name):
    """A figure names its system: scene, disks, density, walls."""
    title = figure._suptitle.get_text() if figure._suptitle is not None else ''
    system = r'.+: \$N=\d+\$( (dumbbells|disks)[,\n][^$]+\n|, )\$\\rho=[0-9.]+\$, .+, '
    system += '(x )?(periodic|reflecting)'
    system += r'|run \w+: no run_info'
    if not re.match(system, title):
        raise AssertionError(f'{name}: its title is {title!r}')


def files(*names):
    return [f'{name}.{suffix}' for name in names for suffix in ('png', 'svg')]


class Bags(unittest.TestCase):
    """A folder for the bags of a test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.out = folder.name, os.path.join(folder.name, 'out')

    def path(self, name='run'):
        return os.path.join(self.folder, name + '.bag')

    def write(self, messages, name='run', **where):
        made.write(self.path(name), messages, **where)
        return self.path(name)

    def recorded(self, messages, **which):
        """Is read when it is asked: each has a bag of its own."""
        name = f'recorded_{len(os.listdir(self.folder))}'
        return seeds.load(self.write(messages, name), **which).summary

    def succeeds(self, name, *arguments, status=0, how=tool):
        """What it prints."""
        done = how(name, *arguments)
        self.assertEqual((done.status, done.error), (status, ''), done.out)
        return done.out

    def refuses(self, reason, name, *arguments, status=1, how=tool):
        """In one line."""
        done = how(name, *arguments)
        self.assertEqual((done.status, done.error.count('\n')), (status, 1), done)
        self.assertRegex(done.error, reason)


class Figures(Bags):
    """Of bags that begin with `info` unless another one is given."""

    info = None

    def load(self, *messages, info=None):
        return hdlyap.load(self.write([info or self.info, *messages]))

    def draw(self, kind, *messages, info=None):
        """Axes of the figure, which can be drawn to the end."""
        figure = kind.draw(self.recorded([info or self.info, *messages])).figure
        figure.set_dpi(30)
        figure.canvas.draw()
        return figure.axes
