"""Which nodes there are and whether they live: questions to the master and to the nodes."""

import sys
import time
import xmlrpc.client

import rosgraph
import rospy

from hdlyap.msg import RunStatus

ANSWER = 5.0  # seconds that a master or a node may take to answer
# a question that could not be asked, or whose answer is none
UNANSWERED = (rosgraph.MasterException, OSError, xmlrpc.client.Error, ValueError, TypeError)


def wait_for_master(deadline):
    while not rosgraph.is_master_online():
        if time.monotonic() > deadline:
            sys.exit(f'follow: no master at {rosgraph.get_master_uri()}')
        time.sleep(0.2)


def wait_for_node(name, deadline):
    """Name of the node that publishes hdlyap/RunStatus; None after the deadline."""
    while time.monotonic() < deadline and not rospy.is_shutdown():
        nodes = {
            topic.rpartition('/')[0]
            for topic, kind in _published_topics()
            if kind == RunStatus._type
        }
        if name in nodes or (name is None and len(nodes) == 1):
            return name or nodes.pop()
        if name is None and nodes:
            sys.exit(f'follow: several nodes, choose one with --node: {", ".join(sorted(nodes))}')
        time.sleep(0.2)
    return None


def _published_topics():
    try:
        return rospy.get_published_topics()
    except OSError:
        return []


def ask_master(question, *about):
    """Its answer; raises one of UNANSWERED."""
    with _server(rosgraph.get_master_uri()) as master:
        code, text, answer = getattr(master, question)(rospy.get_name(), *about)
    if code != 1:
        raise rosgraph.MasterException(text)
    return answer


def address(node):
    """Where a node answers, as the master has it; raises one of UNANSWERED."""
    return ask_master('lookupNode', node)


def answers(uri):
    """Whether a node is there."""
    try:
        with _server(uri) as node:
            node.getPid(rospy.get_name())
        return True
    except UNANSWERED:
        return False


def is_alive(node):
    """Whether the node still answers; a node whose master has gone counts as gone."""
    try:
        return answers(address(node))
    except UNANSWERED:
        return False


class _ImpatientTransport(xmlrpc.client.Transport):
    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = ANSWER
        return connection


def _server(uri):
    return xmlrpc.client.ServerProxy(uri, transport=_ImpatientTransport())
