"""The dispersion relation of a running node, fitted beside what the node says.

lambda = c k + c2 k^2 of its T and of its LP steps, by least squares alone: the node knows the
curvature of long boxes, too. A misfit, the root of chi^2 over its freedom, far above 1 says that
the steps do not follow the relation. An example of an analysis in Python."""

import sys
import threading
import time

import rospy

from hdlyap.data import fits
from hdlyap.msg import Steps

PERIOD = 1.0  # seconds between two lines
PATIENCE = 10.0  # seconds of silence before it says again what it waits for


def line(message):
    """A report in words."""
    own = fits.chosen(message, fits.RELATIONS[2])
    words = [describe(*both) for both in zip(fits.of(own), fits.of(message))]
    return f't = {message.averaged_time:.6g}: {words[0]}; {words[1]}'


def describe(own, node):
    """Fits to the steps of one kind."""
    if min(fit.values[0][2] if fit.count else -1.0 for fit in (own, node)) <= 0:
        return f'{own.symbol}: not yet'
    values = [f'{c:.4f} +- {error:.4f}' for _, c, error in (own.values[0], node.values[0])]
    return f'{own.symbol} = {values[0]} by {own.form} over {own.count} k{own.beside}, node: {values[1]}'


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
