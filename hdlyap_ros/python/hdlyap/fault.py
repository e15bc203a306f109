"""An exception that no check has foreseen -> whose fault it is, by its class and by the packages in
its traceback."""

import os
import traceback

# exceptions that no bag and no node can cause in a correct program
OURS = AttributeError, TypeError, NameError, ImportError, AssertionError, NotImplementedError
OTHERS = {
    'matplotlib': 'cannot be drawn',
    'rospy rosgraph roslaunch xmlrpc http': 'a node or the ROS master has not answered',
}


def whose(error):
    """Says to the user who has to do something about an error: words for the line about it; None if
    what was read is wrong, or if nobody knows."""
    if isinstance(error, OURS):
        return 'a fault of hdlyap, not of what it reads'
    if isinstance(error, MemoryError):
        return 'needs more memory than there is'
    return is_of_others(error)


def is_of_others(error):
    """What has failed in another package, as text; None if it was not in another package."""
    frames = (frame for frame, _ in traceback.walk_tb(error.__traceback__))
    passed = {frame.f_globals.get('__name__', '').partition('.')[0] for frame in frames}
    return next((said for names, said in OTHERS.items() if passed & set(names.split())), None)


def is_in(error, folder):
    """Whether a file below that folder has raised it."""
    return traceback.extract_tb(error.__traceback__)[-1].filename.startswith(folder + os.sep)


def described(error):
    """The class and text of an exception, and where it was raised."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f'{os.path.basename(place.filename)}, line {place.lineno}'
    return f'{type(error).__name__}: {error} ({where})'
