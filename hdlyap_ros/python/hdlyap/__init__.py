"""Besides the messages (hdlyap.msg) this package has recorded runs as arrays and frames (load,
data), figures and tables of bags (plots), lines in a terminal (follow) and many runs (runs,
sweep)."""

import sys
import threading

if sys.version_info[:2] == (3, 9):  # rospy 1.15.9 of Debian 11 still calls it by its former name
    threading.Thread.isAlive = threading.Thread.is_alive


def load(*bags, node=None, run=None, form=None, k=None):
    """Reads a bag, or several bags that belong together. Returns hdlyap.data.run.Run or
    hdlyap.data.seeds.Seeds; hdlyap.data.seeds.load describes the arguments. Runs in space have z
    besides x and y."""
    try:
        from hdlyap.data import seeds  # not at the top, because importing pandas takes a while
    except ImportError as error:
        raise ImportError(
            f'{error} in {sys.executable}: use /usr/bin/python3, which has all that hdlyap needs'
        ) from error
    return seeds.load(*bags, node=node, run=run, form=form, k=k)
