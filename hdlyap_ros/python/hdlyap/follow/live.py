"""The window of a running node's figures, drawn anew with its reports until it is closed."""

import time

import rospy

from .gathered import Gathered

PERIOD = 0.2  # seconds between two looks
REST = 4  # pause after a drawing over the time that it took, because the run needs the processors
INTERRUPTED, WENT_AWAY = 130, 3


def follow(node, window, **fits):
    """Draws into the window. Returns the exit status: 0 the window was closed, 3 the node had gone
    before the end of its run by then, 130 interrupted. fits: see data.run.Run."""
    heard, drawn, ready = Gathered(node), 0, 0.0
    window.say(f'{node}: nothing heard yet')
    window.open()
    while window.is_open and not rospy.is_shutdown():
        view, count, began = heard.view(), heard.count, time.monotonic()
        over = view.is_finished or view.is_gone
        if view.info and count > drawn and (over or began >= ready):
            window.draw(heard.run(view.info, **fits).summary)
            drawn, ready = count, time.monotonic() + REST * (time.monotonic() - began)
        if view.status:
            window.say(_words(view))
        window.pause(PERIOD)
    if window.is_open:
        return INTERRUPTED
    return WENT_AWAY if view.is_gone and not view.is_finished else 0


def _words(view):
    at = f'{view.node}: t = {view.status.sim_time:.1f}'
    if view.is_finished:
        return f'{at}, the run has finished: its last figures'
    if view.is_gone:
        return f'{at}, the node has gone before the end of its run: its last figures'
    return f'{at}, {100 * view.status.progress:.0f} %' if view.status.progress > 0 else at
