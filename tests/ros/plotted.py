"""plot_bag in this process: without starting python anew, and with a few dots per inch."""

import contextlib
import functools
import io
import os
import runpy
import subprocess
import sys
from unittest import mock

from hdlyap.plots import figures
from made import SCRIPTS

PLOT_BAG = os.path.join(SCRIPTS, 'plot_bag')
DOTS = 40  # per inch


def plot_bag(*arguments):
    """As if it had been a process."""
    out, error, status = io.StringIO(), io.StringIO(), 0
    few_dots = functools.partial(figures.save, dpi=DOTS)
    with contextlib.ExitStack() as changed:
        changed.enter_context(mock.patch.object(sys, 'argv', [PLOT_BAG, *arguments]))
        changed.enter_context(mock.patch.object(figures, 'save', few_dots))
        changed.enter_context(contextlib.redirect_stdout(out))
        changed.enter_context(contextlib.redirect_stderr(error))
        try:
            runpy.run_path(PLOT_BAG, run_name='__main__')
        except SystemExit as end:
            status = 1
            error.write(f'{end}\n')
    return subprocess.CompletedProcess(arguments, status, out.getvalue(), error.getvalue())


def plot_bag_process(*arguments):
    """As a user starts it."""
    return subprocess.run(
        [sys.executable, PLOT_BAG, *arguments],
        universal_newlines=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
