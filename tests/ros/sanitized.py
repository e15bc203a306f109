#!/usr/bin/env python3
"""Short lives of a node that is checked while it runs: subscribed to, paused, reset, stopped by
Ctrl-C or at its end.

sanitized.py first NAME NODE    a build with sanitizers: one life
sanitized.py second NAME NODE   and one that is stopped, and one that goes on with that
sanitized.py second NAME COMMAND... NODE   run by a command (valgrind), which is too slow to be
stopped within a second

Prints what the node says, and 'ok NAME' if it ended as it should: the checks end it
otherwise.
"""

import os
import signal
import sys
import tempfile

import rospy
from std_srvs.srv import SetBool, Trigger

from hdlyap.srv import Set
import harness
from harness import RunStatus

# all that there is to compute; and what takes valgrind a short time
WHOLE = dict(
    harness.MODES,
    threads=2,
    report_interval=0.5,
    observables=harness.OBSERVABLES,
    wait_for_subscribers='all',
)
LITTLE = dict(
    harness.SHORT,
    number=6,
    threads=1,
    observables=['spectrum', 'modes', 'state'],
    wait_for_subscribers='all',
    duration=16.0,
    pace=4.0,
)
PACE = 20.0
PATIENCE = 100.0  # seconds: some checks slow the node down fifty times


def call(service, kind, *request):
    name = '/%s/%s' % (harness.NODE, service)
    rospy.wait_for_service(name, PATIENCE)
    answer = rospy.ServiceProxy(name, kind)(*request)
    assert answer.success, '%s: %s' % (service, answer.message)


def expect(node, condition):
    """Waits, but not for a node that has ended."""
    harness.wait_until(lambda: condition() or not node.running(), PATIENCE)
    assert condition(), node.text()


def lead(node, listeners):
    """Through all that it can be asked for."""
    said = listeners['status'].messages
    expect(node, lambda: said and said[-1].stage == RunStatus.AVERAGING)
    call('pause', SetBool, True)
    call('pause', SetBool, False)
    call('reset_average', Trigger)
    call('set', Set, 'report_interval=0.25')
    call('set', Set, 'pace=%g' % PACE)
    call('checkpoint', Trigger)
    expect(node, lambda: all(listener.messages for listener in listeners.values()))
    listeners['state'].close()
    count = len(said)
    expect(node, lambda: len(said) > count + 2)


def live(command, params, stopped=False):
    """Exit status of a node that is stopped, or that comes to its end by itself."""
    listeners = {
        topic: harness.Listener(topic)
        for topic in params['observables'] + ['run_info', 'status', 'cost']
    }
    # its own libraries, not those of the build whose messages are used here
    libraries = os.path.dirname(os.path.dirname(command[-1]))
    node = harness.start(params, command=command, LD_LIBRARY_PATH=libraries)
    try:
        lead(node, listeners)
        if stopped:
            node.send(signal.SIGINT)
        expect(node, lambda: harness.is_last(listeners['status'].messages[-1]))
        return node.wait(PATIENCE)
    finally:
        node.stop()
        print(node.text())
        for listener in listeners.values():
            listener.close()


def lives(tier, command, checkpoint):
    """Of a command each is slow; of a build one that ends by itself, one that is stopped, one that
    resumes the other's."""
    if len(command) > 1:
        return [live(command, dict(LITTLE, checkpoint=checkpoint))]
    whole = dict(WHOLE, checkpoint=checkpoint)
    statuses = [live(command, dict(whole, duration=40.0, pace=20.0))]
    if tier == 'second':
        statuses.append(live(command, dict(whole, duration=0.0), stopped=True))
        statuses.append(live(command, dict(whole, duration=0.0, resume=checkpoint), stopped=True))
    return statuses


def main(tier, name, *command):
    master = harness.Master()
    os.environ['ROS_MASTER_URI'] = master.uri
    rospy.init_node('sanitized', disable_rosout=True)
    with tempfile.TemporaryDirectory() as folder:
        statuses = lives(tier, command, os.path.join(folder, 'kept'))
    rospy.signal_shutdown('done')
    master.stop()
    print(('FAILED ' if any(statuses) else 'ok ') + name)
    return any(statuses)


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
