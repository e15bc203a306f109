"""The roslaunch that has started this process."""

import os
import signal

from . import arguments

END = 10.0  # seconds that roslaunch may take to hear that it is to end


def end_launch(told):
    """Asks it to end, as Ctrl-C does, and waits until it has told this process: the event. A
    program of another name is not asked, it sees the end of a required process."""
    if 'roslaunch' in map(os.path.basename, arguments.parents_command()[:2]):
        os.kill(os.getppid(), signal.SIGINT)
        told.wait(END)
