"""Which topics are listened to, and whether node and master are there: all that may have to wait
for an answer, in a thread. To watch a run must not change it: what the node computes only for
listeners is listened to while others do, or if the user wants it."""

import re
import threading

import rospy

from .nodes import UNANSWERED, address, answers, ask_master

PERIOD = 1.0  # seconds between two looks at the master
SILENCE = 2.0  # seconds without a message after which the node is asked
FOLLOWER = re.compile(r'/follow_\d+_\d+$')  # names that rospy gives to our like


class Scout:
    """always, computed: {topic: (class, callback of message and topic)}; silence(): seconds since
    the node's last word."""

    def __init__(self, node, always, computed, silence):
        self._node, self._silence = node, silence
        self._always, self._computed = always, computed
        self._ears, self._address = {}, None
        self._soon = threading.Event()
        self.wanted = self.is_node_gone = self.is_master_gone = False
        self.listened = self.others = frozenset()
        threading.Thread(target=self._go_round, daemon=True).start()

    def toggle_wanted(self):
        self.wanted = not self.wanted
        self._soon.set()

    def _go_round(self):
        while not rospy.is_shutdown():
            self._soon.clear()
            self._look()
            self.is_node_gone = self._silence() > SILENCE and not (
                self._address and answers(self._address)
            )
            self._soon.wait(PERIOD)

    def _look(self):
        try:
            speakers, listeners = map(dict, ask_master('getSystemState')[:2])
            self.is_master_gone = False
        except UNANSWERED:
            self.is_master_gone = True
            return
        self._listen(speakers, listeners)
        try:
            self._address = address(self._node)
        except UNANSWERED:
            pass  # a node that no master knows may still be where it was

    def _listen(self, speakers, listeners):
        """Both: {topic: names of nodes}"""
        self.others = frozenset(
            topic
            for topic in self._computed
            if not all(FOLLOWER.search(name) for name in listeners.get(topic, ()))
        )
        topics = {
            **self._always,
            **{
                topic: ear
                for topic, ear in self._computed.items()
                if self.wanted or topic in self.others
            },
        }
        for topic in list(self._ears):
            # by a master that was restarted; a node that it does not know either is still connected
            forgotten = topic in speakers and rospy.get_name() not in listeners.get(topic, ())
            if topic not in topics or forgotten:
                self._ears.pop(topic).unregister()
        for topic, (kind, callback) in topics.items():
            if topic not in self._ears:
                self._ears[topic] = rospy.Subscriber(topic, kind, callback, topic, queue_size=1)
        self.listened = frozenset(self._ears)
