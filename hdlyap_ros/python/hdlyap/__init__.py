"""Beside the messages (hdlyap.msg): recorded runs as arrays and frames (load, data), figures and
tables of bags (plots), a terminal screen (follow), many runs (runs, sweep)."""

import sys
import threading

if sys.version_info[:2] == (3, 9):  # rospy 1.15.9 of Debian 11 still calls it by its former name
    threading.Thread.isAlive = threading.Thread.is_alive


def load(*bags, node=None, run=None, form=None, k=None):
    """What was recorded in a bag, or in several that belong together: see hdlyap.data.run.Run and
    hdlyap.data.seeds.Seeds, and hdlyap.data.seeds.load of the rest. Runs of spheres have z beside
    x and y."""
    try:
        from hdlyap.data import seeds  # only here: pandas takes a while
    except ImportError as error:
        raise ImportError(
            f'{error} in {sys.executable}: start it with /usr/bin/python3, which has all of hdlyap'
        ) from error
    return seeds.load(*bags, node=node, run=run, form=form, k=k)
