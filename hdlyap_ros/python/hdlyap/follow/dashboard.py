"""The screen of a running node, redrawn until the user quits."""

import sys

import rospy

from hdlyap import glyphs

from . import panels
from .layout import arranged, wrapped
from .screen import Screen
from .watch import Watch

PERIOD = 0.25  # seconds between two looks
INTERRUPTED = 130
WENT_AWAY = 3


def follow(node, plain=False):
    """Shows the screen. Returns the exit status: 0 the user has quit, 3 the node had gone before
    the end of its run by then, 130 interrupted."""
    watch, drawn = Watch(node), glyphs.chosen(sys.stdout, plain)
    screen = Screen(plain)
    with screen:
        status = _redraw(watch, screen, drawn)
    last = lines(watch.view(), screen.size, drawn)
    screen.leave_behind([line for line in last[:-1] if line])  # without the line about keys
    return status


def _redraw(watch, screen, drawn):
    while not rospy.is_shutdown():
        view, size = watch.view(), screen.size
        screen.show(lines(view, size, drawn), size)
        key = screen.key(PERIOD)
        if key == 'q':
            return WENT_AWAY if view.is_gone and not view.is_finished else 0
        if key == 'm':
            watch.toggle_computed()
    return INTERRUPTED


def lines(view, size, drawn):
    """The lines of the screen; one line about the error if a message has unexpected contents."""
    try:
        return arranged(panels.of(view, *size, drawn), size)
    except Exception as error:  # a node may send anything that no check has foreseen
        said = wrapped([(panels.nonsense(error), 'error')], size[0])
        return [*said, [('q quit', 'faint')]][: size[1]]
