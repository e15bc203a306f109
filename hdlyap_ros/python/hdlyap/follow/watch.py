"""A node's topics -> View: the last messages about its present run. Whatever waits for an answer
runs in a thread. Watching must not change a run: topics that the node computes only for listeners
are subscribed to while somebody else listens, or if the user asks for them."""

import contextlib
import re
import threading
import time
from collections import deque

import rospy

from diagnostic_msgs.msg import DiagnosticArray
from hdlyap.data.summary import Summary
from hdlyap.msg import Cost, LpPhases, RunInfo, RunStatus, Spectrum, Steps

from .nodes import UNANSWERED, address, answers, ask_master

ALWAYS = {'run_info': RunInfo, 'status': RunStatus, 'cost': Cost, 'spectrum': Spectrum}
COMPUTED = {'steps': Steps, 'lp_phases': LpPhases}
FIELDS = {'run_info': 'info', 'lp_phases': 'phases'}  # members of View that differ from the topic
PERIOD = 1.0  # seconds between two looks at the master
SILENCE = 2.0  # seconds without a message after which the node is asked
SPEED_OVER = 10.0  # wall seconds over which the speed is measured
FOLLOWER = re.compile(r'/follow_\d+_\d+$')  # names that rospy gives to this command


class View(Summary):
    """What is shown; None if it is not known. `silence`: seconds since the node's last message;
    `diagnosis`: its DiagnosticStatus; `others`: topics of COMPUTED that somebody else listens to;
    `wanted`: whether this listens to all of them."""

    info = spectrum = steps = status = cost = phases = diagnosis = speed = None
    node, silence, others, wanted = '', 0.0, frozenset(), False
    is_gone = is_master_gone = False

    def __init__(self):
        """A view of no run; Summary.__init__ would need one."""

    @property
    def is_finished(self):
        return self.status is not None and self.status.stage == RunStatus.FINISHED

    @property
    def is_averaged(self):
        """Whether the spectrum has any exponents yet."""
        return self.spectrum is not None and self.spectrum.averaged_time > 0


class Watch:
    """Listens to a node; view() is what is known now. computed: the part of COMPUTED to listen to
    while somebody else does; wanted: also if nobody does, which makes the node compute it."""

    def __init__(self, node, computed=COMPUTED, wanted=False):
        self._node, self._computed, self._wanted = node, computed, wanted
        kinds = {**ALWAYS, **computed}
        self._topics = {f'{node}/{name}': (lazy(kinds[name]), self._hear) for name in kinds}
        self._topics['/diagnostics'] = DiagnosticArray, self._hear_diagnostics
        self._last, self._diagnosis = {}, None
        self._heard, self._speed = time.monotonic(), Speed()
        self._ears, self._address = {}, None
        self._is_gone = self._is_master_gone = False
        self._others = frozenset()
        threading.Thread(target=self._go_round, daemon=True).start()

    def view(self):
        view = View()
        heard = [one for one in dict(self._last).items() if one[0] in self._ears]
        fill(view, {_name(topic): message.unpacked() for topic, message in heard})
        view.node, view.silence = self._node, self._silence()
        view.diagnosis, view.speed = self._diagnosis, self._speed.add(view.cost)
        view.wanted, view.others = self._wanted, self._others
        view.is_gone, view.is_master_gone = self._is_gone, self._is_master_gone
        return view

    def _silence(self):
        return time.monotonic() - self._heard

    def _hear(self, message, topic):
        self._heard = time.monotonic()
        self._last[topic] = message

    def _hear_diagnostics(self, message, _):
        for status in message.status:
            if status.name == self._node:
                self._heard = time.monotonic()
                self._diagnosis = status

    def _go_round(self):
        while not rospy.is_shutdown():
            self._look()
            self._is_gone = self._silence() > SILENCE and not (
                self._address and answers(self._address)
            )
            time.sleep(PERIOD)

    def _look(self):
        try:
            speakers, listeners = map(dict, ask_master('getSystemState')[:2])
            self._is_master_gone = False
        except UNANSWERED:
            self._is_master_gone = True
            return
        self._listen(speakers, listeners)
        try:
            self._address = address(self._node)
        except UNANSWERED:
            pass  # a node that the master does not know may still have its old address

    def _listen(self, speakers, listeners):
        """Subscribes and unsubscribes. speakers, listeners: {topic: names of nodes}."""
        self._others = frozenset(
            name
            for name in self._computed
            if not all(map(FOLLOWER.search, listeners.get(f'{self._node}/{name}', ())))
        )
        for topic, (kind, callback) in self._topics.items():
            name = _name(topic)
            wanted = name not in self._computed or self._wanted or name in self._others
            # a restarted master may know the node, but not this subscriber
            forgotten = topic in speakers and rospy.get_name() not in listeners.get(topic, ())
            if topic in self._ears and (forgotten or not wanted):
                self._ears.pop(topic).unregister()
            if wanted and topic not in self._ears:
                self._ears[topic] = rospy.Subscriber(topic, kind, callback, topic, queue_size=1)


def _name(topic):
    return topic.rpartition('/')[2]


def fill(view, last):
    """Fills a view with the last messages of topics, without those of earlier runs than the status
    is of."""
    newest = last.get('status') or last.get('run_info')
    for name, message in last.items():
        if message is not None and newest and message.run_id == newest.run_id:
            setattr(view, FIELDS.get(name, name), message)


class Speed:
    """The simulated time per wall second, over the last seconds."""

    def __init__(self):
        self._marks = deque()

    def add(self, cost):
        """Adds a message. Returns the speed; None while it is not known."""
        if cost is None:
            return None
        marks = self._marks
        if marks and cost.wall_seconds < marks[-1][0]:
            marks.clear()  # this is another run
        if not marks or cost.wall_seconds > marks[-1][0]:
            marks.append((cost.wall_seconds, cost.sim_time))
        while len(marks) > 2 and marks[-1][0] - marks[1][0] >= SPEED_OVER:
            marks.popleft()
        (began, start), (ended, end) = marks[0], marks[-1]
        return (end - start) / (ended - began) if ended > began else None


def lazy(kind):
    """A class of messages that are unpacked only when somebody needs them. Most are replaced before
    that, and unpacking takes time from a node on the same cores."""

    class Lazy(kind):
        def deserialize(self, data):
            self.data, self.message, self.is_unpacked = data, None, False
            return self

        def unpacked(self):
            """The message; None if it is damaged."""
            if not self.is_unpacked:
                with contextlib.suppress(Exception):  # damaged bytes make genpy raise anything
                    self.message = kind().deserialize(self.data)
                self.is_unpacked = True
            return self.message

    return Lazy
