"""An exception that nobody has foreseen -> whose fault it is, by its kind and by the packages on the
way to it."""

import os
import traceback

# what no bag and no node make of a program that is right
OURS = AttributeError, TypeError, NameError, ImportError, AssertionError, NotImplementedError
OTHERS = {
    'matplotlib': 'cannot be drawn',
    'rospy rosgraph roslaunch xmlrpc http': 'a node or the ROS master has not answered',
}


def whose(error):
    """In words; None of what was read, or of nobody else that is known."""
    if isinstance(error, OURS):
        return 'a fault of hdlyap, not of what it reads'
    if isinstance(error, MemoryError):
        return 'needs more memory than there is'
    return is_of_others(error)


def is_of_others(error):
    """In words, or None: what was asked of them has failed."""
    frames = traceback.extract_tb(error.__traceback__)
    passed = {part for frame in frames for part in frame.filename.split(os.sep)[:-1]}
    return next((said for names, said in OTHERS.items() if passed & set(names.split())), None)


def is_in(error, folder):
    """Whether it was raised by a file below that folder."""
    return traceback.extract_tb(error.__traceback__)[-1].filename.startswith(folder + os.sep)


def described(error):
    """What it is, and where."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f'{os.path.basename(place.filename)}, line {place.lineno}'
    return f'{type(error).__name__}: {error} ({where})'
