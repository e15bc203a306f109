#!/usr/bin/env python3
"""Short lives of a node that is checked while it runs: subscribed to, paused, reset, stopped by Ctrl-C or at its end.

sanitized.py NAME NODE          a build with sanitizers
sanitized.py NAME COMMAND... NODE   run by a command (valgrind), which is too slow to be stopped within a second
Prints what the node says, and 'ok NAME' if it ended as it should: the checks end it otherwise.
"""

import os
import signal
import sys

import rospy
from std_srvs.srv import SetBool, Trigger

import harness
from harness import Cost

# all that there is to compute; and what takes valgrind a short time
WHOLE = dict(harness.MODES, threads=2, report_interval=0.5, observables=harness.OBSERVABLES,
             wait_for_subscribers='all')
LITTLE = dict(harness.SHORT, disks=6, threads=1, observables=['spectrum', 'modes', 'state'],
              wait_for_subscribers='all')
PATIENCE = 100.0  # seconds: some checks slow the node down fifty times


def call(service, kind, *request):
    name = '/%s/%s' % (harness.NODE, service)
    rospy.wait_for_service(name, PATIENCE)
    answer = rospy.ServiceProxy(name, kind)(*request)
    assert answer.success, '%s: %s' % (service, answer.message)


def lead(listeners):
    """Through all that it can be asked for."""
    cost = listeners['cost']
    assert cost.wait_for(lambda message: message.phase == Cost.AVERAGING, PATIENCE)
    call('pause', SetBool, True)
    call('pause', SetBool, False)
    call('reset_average', Trigger)
    assert all(listener.wait_for(lambda message: True, PATIENCE) for listener in listeners.values())
    listeners['state'].close()
    count = len(cost.messages)
    assert harness.wait_until(lambda: len(cost.messages) > count + 5, PATIENCE)


def live(command, params, stopped=False):
    """Exit status of a node that is stopped, or that comes to its end by itself."""
    listeners = {topic: harness.Listener(topic) for topic in params['observables'] + ['run_info', 'cost']}
    node = harness.start(params, command=command)
    try:
        lead(listeners)
        if stopped:
            node.send(signal.SIGINT)
        assert listeners['cost'].wait_for(lambda cost: cost.phase == Cost.FINISHED, PATIENCE)
        return node.wait(PATIENCE)
    finally:
        node.stop()
        print(node.text())
        for listener in listeners.values():
            listener.close()


def main(name, *command):
    master = harness.Master()
    os.environ['ROS_MASTER_URI'] = master.uri
    rospy.init_node('sanitized', disable_rosout=True)
    if len(command) > 1:
        statuses = [live(command, dict(LITTLE, duration=8.0, pace=1.0))]
    else:
        statuses = [live(command, dict(WHOLE, duration=20.0, pace=10.0)),
                    live(command, dict(WHOLE, duration=0.0), stopped=True)]
    rospy.signal_shutdown('done')
    master.stop()
    print(('FAILED ' if any(statuses) else 'ok ') + name)
    return any(statuses)


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
