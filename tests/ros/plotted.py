"""plot_bag in this process: python is not started anew, and figures are drawn into no file."""

import contextlib
import io
import os
import re
import runpy
import subprocess
import sys
from unittest import mock

from hdlyap.plots import figures
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
