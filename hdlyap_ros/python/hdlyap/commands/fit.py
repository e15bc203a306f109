"""The dispersion relation of a running node, fitted beside what the node says.

lambda = c k + c2 k^2 of its T and of its LP steps, by least squares alone: the node knows the
curvature of long boxes, too. An example of an analysis in Python."""

import sys
import threading
import time

import numpy as np
import rospy

from hdlyap.data.dispersion import Curve, number_of
from hdlyap.data.fits import RELATIONS
from hdlyap.msg import Step, Steps

PERIOD = 1.0  # seconds between two lines
PATIENCE = 10.0  # seconds of silence before it says again what it waits for


def fit(steps, kind):
    """c, its standard error and the number of wave numbers, by weighted least squares; None without
    a step whose error is known."""
    chosen = [
        s for s in steps if s.kind == kind and s.resolved and not s.conjugate and s.std_error > 0
    ]
    if not chosen:
        return None
    k, exponents, errors = np.array([(s.wave_number, s.exponent, s.std_error) for s in chosen]).T
    curve = Curve(k, exponents, errors)
    return curve.c, curve.c_error, number_of(k)


def describe(name, fitted, c, error):
    if fitted is None or error <= 0:
        return '%s: not yet' % name
    own, own_error, waves = fitted
    return '%s = %.4f +- %.4f by %s over %d k, node: %.4f +- %.4f' % (
        name,
        own,
        own_error,
        RELATIONS[min(waves, 2)],
        waves,
        c,
        error,
    )


def line(message):
    """A report in words."""
    return 't = %.6g: %s; %s' % (
        message.averaged_time,
        describe('c_T', fit(message.steps, Step.T), message.c_t, message.c_t_error),
        describe('c_L', fit(message.steps, Step.LP), message.c_l, message.c_l_error),
    )


class Newest:
    """The last report; the callback, in a thread of its own, only keeps it."""

    def __init__(self, topic):
        self._message = None
        self._arrived = threading.Event()
        self._subscriber = rospy.Subscriber(topic, Steps, self._keep, queue_size=1)

    def _keep(self, message):
        self._message = message
        self._arrived.set()

    @property
    def missing(self):
        """Why there is none."""
        topic = self._subscriber.resolved_name
        if self._subscriber.get_num_connections() == 0:
            return (
                f'nobody publishes {topic}; roslaunch hdlyap run.launch starts a node, '
                '--node chooses another'
            )
        return f'nothing on {topic}: its node sends reports while it averages'

    def wait(self, seconds):
        """None if there has been none since the last call."""
        if not self._arrived.wait(seconds):
            return None
        self._arrived.clear()
        return self._message


def options(parser):
    parser.add_argument('--node', default='hdlyap', metavar='NAME', help='default: %(default)s')


def main(args):
    try:
        rospy.init_node('fit', anonymous=True)
    except rospy.ROSInitException:  # interrupted while there was no master
        return 130
    newest = Newest(args.node + '/steps')
    stop = threading.Event()
    rospy.on_shutdown(stop.set)
    until = time.monotonic() + PERIOD  # in which a node connects
    while not stop.is_set():
        message = newest.wait(0.1)
        if message is not None:
            print(line(message), flush=True)
            stop.wait(PERIOD)
        elif time.monotonic() < until:
            continue
        else:
            print('hdlyap fit waits: ' + newest.missing, file=sys.stderr, flush=True)
        until = time.monotonic() + PATIENCE
    return 0
