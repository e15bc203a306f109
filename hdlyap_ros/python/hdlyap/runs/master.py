"""The ROS master in use; it is started here if there is none."""

import time

import rosgraph
import rospy

from hdlyap.follow import nodes

from .tree import Tree, end

POLL = 0.2
COMING = 60.0  # seconds for a master to come up, on a busy machine
ASK = 5.0  # seconds between two questions whether it is there
SILENCE = 15.0  # seconds without an answer, after which the master has gone
PATIENCE = 5.0  # seconds in which a master that was started here has to end


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
        self._question = question or ('getUri',)
        self._due, self._heard = 0.0, time.monotonic()

    def check(self):
        """Raises MasterError if the master has gone. Has to be called often."""
        now = time.monotonic()
        if now >= self._due:
            self._due = now + ASK
            if self._answers():
                self._heard = time.monotonic()
        if now - self._heard > SILENCE:
            self.fail()

    def fail(self):
        raise MasterError(f'the ROS master at {self.uri} has gone')

    def _answers(self):
        try:
            nodes.ask_master(*self._question)
            return True
        except nodes.UNANSWERED:
            return False


class Master(Watch):
    def __init__(self):
        super().__init__()
        self._own = None
        if not rosgraph.is_master_online():
            self._start()

    def _start(self):
        port = self.uri.rstrip('/').rpartition(':')[2]
        self._own = Tree(['roscore', '-p', port])
        deadline = time.monotonic() + COMING
        while not rosgraph.is_master_online():
            if time.monotonic() > deadline or self._own.has_ended():
                self.stop()
                raise MasterError(f'no ROS master comes up at {self.uri}')
            time.sleep(POLL)

    def check(self):
        super().check()
        if self._own and self._own.has_ended():
            self.fail()

    def stop(self):
        if self._own:
            end([self._own], PATIENCE)
