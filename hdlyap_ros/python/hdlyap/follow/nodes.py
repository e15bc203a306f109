"""Asks the master and nodes which nodes there are and whether they still run."""

import http.client
import sys
import time
import xmlrpc.client
from xml.parsers import expat

import rosgraph
import rospy

from hdlyap.data.reader import plain
from hdlyap.msg import RunStatus

ANSWER = 5.0  # seconds that a master or a node may take to answer
SOON = 1.0  # seconds that a master may take to answer for the first time
LIST = 2000  # most letters of a list of nodes
HOW = 'To start one: roslaunch hdlyap run.launch'
# exceptions if a question could not be asked, or its answer cannot be read
UNANSWERED = (
    rosgraph.MasterException,
    OSError,
    xmlrpc.client.Error,
    http.client.HTTPException,
    expat.ExpatError,
    ValueError,
    TypeError,
)


def chosen(command, name, patience):
    """The name of the node that publishes hdlyap/RunStatus: the one of this name, or the only one.
    Also starts the ROS node of this command of hdlyap. Waits at most `patience` seconds, and exits
    if there is no such node, or if it does not answer."""
    deadline = time.monotonic() + patience
    _wait_for_master(command, deadline)
    rospy.init_node(command, anonymous=True)
    node = _wait_for_node(command, name and rospy.resolve_name(name.rstrip('/')), deadline)
    return node


def _wait_for_master(command, deadline):
    """Waits for the master; exits after the deadline. Says at once if there is none."""
    uri = rosgraph.get_master_uri()
    missing = f'hdlyap {command}: no master at {uri}'
    if not _wait(lambda: answers(uri, SOON), deadline, lambda: (missing, HOW)):
        sys.exit(missing)


def _wait_for_node(command, name, deadline):
    """The name of the node; exits after the deadline. Says at once if there is none."""
    found, wrong = set(), ''

    def look():
        nonlocal wrong
        found.clear()
        found.update(_nodes())
        candidates = found & {name} if name else found
        wrong = unheard(*candidates) if len(candidates) == 1 else ''
        return bool(candidates) and not wrong

    def listed():
        return plain(', '.join(sorted(found)), LIST)  # names may contain anything

    def missing():
        if wrong:
            return f'hdlyap {command}: {wrong}', ''
        others = f'; there is {listed()}' if found else ''
        none = f'no {name or "hdlyap_node"} that publishes a run_info'
        return f'hdlyap {command}: {none}{others}', HOW

    if not _wait(look, deadline, missing):
        why = wrong or 'no hdlyap_node is running'
        sys.exit(130 if rospy.is_shutdown() else f'hdlyap {command}: {why}')
    if name is None and len(found) > 1:
        sys.exit(f'hdlyap {command}: several nodes, choose one: {listed()}')
    return name or found.pop()


def _wait(is_there, deadline, missing):
    """Waits until is_there() or the deadline. Returns whether it was there in time. missing(): what
    is missing and how to mend that, which is said once, and again when it is something else."""
    said = None
    while not rospy.is_shutdown():
        if is_there():
            return True
        left = deadline - time.monotonic()
        if left <= 0:
            return False
        what, how = missing()
        if what != said:
            print(f'{what}; waits {left:.3g} s. {how}'.rstrip(), file=sys.stderr, flush=True)
            said = what
        time.sleep(0.2)
    return False


def _nodes():
    """The nodes that publish hdlyap/RunStatus."""
    try:
        topics = ask_master('getPublishedTopics', '')
    except UNANSWERED:
        return set()
    return {topic.rpartition('/')[0] for topic, kind in topics if kind == RunStatus._type}


def ask_master(question, *about):
    """The answer of the master; raises one of UNANSWERED."""
    with _server(rosgraph.get_master_uri()) as master:
        code, text, answer = getattr(master, question)(rospy.get_name(), *about)
    if code != 1:
        raise rosgraph.MasterException(text)
    return answer


def address(node):
    """The address of a node, which the master knows; raises one of UNANSWERED."""
    return ask_master('lookupNode', node)


def answers(uri, patience=ANSWER):
    """Whether the node or master at an address answers."""
    try:
        with _server(uri, patience) as node:
            node.getPid(rospy.get_name())
        return True
    except UNANSWERED:
        return False


def unheard(node):
    """What is wrong with a node that the master knows but that does not answer, for the user; '' if
    it answers, or if the master does not know it."""
    try:
        uri = address(node)
    except UNANSWERED:
        return ''
    if answers(uri, SOON):
        return ''
    return (
        f'{plain(node)} has the address {plain(uri)}, which does not answer: it has gone, or its '
        'ROS_IP or ROS_HOSTNAME must be an address that this machine reaches'
    )


def unheard_speaker(topic):
    """What is wrong with the nodes that publish a topic, as unheard() says; '' if one of them
    answers, or if there are none."""
    try:
        speakers = dict(ask_master('getSystemState')[0]).get(topic, [])
    except UNANSWERED:
        return ''
    wrong = [unheard(node) for node in speakers]
    return wrong[0] if wrong and all(wrong) else ''


def is_alive(node):
    """Whether the node still answers; a node whose master has gone counts as gone."""
    try:
        return answers(address(node))
    except UNANSWERED:
        return False


def stop(node, why):
    """Asks a node to end, as rosnode kill does."""
    try:
        with _server(address(node)) as there:
            there.shutdown(rospy.get_name(), why)
    except UNANSWERED:
        pass  # it is about to end, or nobody reaches it


class _ImpatientTransport(xmlrpc.client.Transport):
    def __init__(self, patience):
        super().__init__()
        self._patience = patience

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self._patience
        return connection


def _server(uri, patience=ANSWER):
    return xmlrpc.client.ServerProxy(uri, transport=_ImpatientTransport(patience))
