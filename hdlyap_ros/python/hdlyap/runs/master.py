"""The ROS master in use."""

import time

import rosgraph
import rospy

from hdlyap.follow import nodes

ASK = 5.0  # seconds between two questions whether it is there
SILENCE = 15.0  # seconds without an answer, after which the master has gone


class MasterError(Exception):
    """A line for the user: there is no master."""


def leave(reason):
    """Ends rospy in a process that goes on. rospy closes the socket of its XML-RPC server but lets
    the server's thread run, which then asks for the closed socket without a pause."""
    hooks = rospy.core._shutdown_hooks
    nodes = [getattr(hook, '__self__', None) for hook in hooks]
    servers = [one.server for one in nodes if isinstance(one, rosgraph.xmlrpc.XmlRpcNode)]
    rospy.signal_shutdown(reason)
    for server in filter(None, servers):
        server.shutdown()


class Watch:
    """Checks that a master is still there, by asking it now and then."""

    def __init__(self, *question):
        self.uri = rosgraph.get_master_uri()
        self._question = question
        self._due, self._heard = 0.0, time.monotonic()

    def check(self):
        """Raises MasterError if the master has gone. Has to be called often."""
        now = time.monotonic()
        if now >= self._due:
            self._due = now + ASK
            if self._answers():
                self._heard = time.monotonic()
        if now - self._heard > SILENCE:
            raise MasterError(f'the ROS master at {self.uri} has gone')

    def _answers(self):
        try:
            nodes.ask_master(*self._question)
            return True
        except nodes.UNANSWERED:
            return False
