"""The dispersion relation of a running node, fitted beside what the node says.

Fits lambda = c k + c2 k^2 to its T and to its LP steps, by least squares alone; the node also uses
the curvature of long boxes. If the misfit, the root of chi^2 over its degrees of freedom, is far
above 1, the steps do not follow the relation. This is an example of an analysis in Python."""

import sys
import threading
import time

import rospy

from hdlyap.data import fits
from hdlyap.msg import Steps

PERIOD = 1.0  # seconds between two lines
PATIENCE = 10.0  # seconds of silence before it says again what it waits for


def line(message):
    """A line about a report."""
    own = fits.chosen(message, fits.RELATIONS[2])
    words = [describe(*both) for both in zip(fits.of(own), fits.of(message))]
    return f't = {message.averaged_time:.6g}: {words[0]}; {words[1]}'


def describe(own, node):
    """Text about two fits to the steps of one kind: this program's and the node's."""
    if min(fit.values[0][2] if fit.count else -1.0 for fit in (own, node)) <= 0:
        return f'{own.symbol}: not known yet'
    values = [f'{c:.4f} +- {error:.4f}' for _, c, error in (own.values[0], node.values[0])]
    by = f'{own.form} over {own.count} k{own.beside}'
    return f'{own.symbol} = {values[0]} by {by}, node: {values[1]}'


class Newest:
    """The last report. Its callback runs in a separate thread and only keeps the message."""

    def __init__(self, topic):
        self._message = None
        self._arrived = threading.Event()
        self._subscriber = rospy.Subscriber(topic, Steps, self._keep, queue_size=1)

    def _keep(self, message):
        self._message = message
        self._arrived.set()

    @property
    def missing(self):
        """Why there is no report."""
        topic = self._subscriber.resolved_name
        if self._subscriber.get_num_connections() == 0:
            return (
                f'nobody publishes {topic}; roslaunch hdlyap run.launch starts a node, '
                '--node chooses another'
            )
        return f'no message on {topic}: its node sends them while it averages'

    def wait(self, seconds):
        """The report that has come since the last call, within this time; None if none has."""
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
    until = time.monotonic() + PERIOD  # a node connects in this time
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
