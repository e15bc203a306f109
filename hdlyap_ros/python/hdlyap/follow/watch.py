"""A node's topics -> View: what it said last about its present run."""

import time
from collections import deque

from diagnostic_msgs.msg import DiagnosticArray
from hdlyap.msg import Cost, LpPhases, RunInfo, RunStatus, Spectrum, Steps
from hdlyap.plots.run import Run

from .scout import Scout

ALWAYS = {'run_info': RunInfo, 'status': RunStatus, 'cost': Cost, 'spectrum': Spectrum}
COMPUTED = {'steps': Steps, 'lp_phases': LpPhases}
SPEED_OVER = 10.0  # wall seconds


class View(Run):
    """What is shown; None for what is not known. `silence`: seconds since the node's last word;
    `diagnosis`: its DiagnosticStatus; `others`: topics of COMPUTED that somebody else listens to;
    `wanted`: whether the user has asked for all of them."""

    status = cost = phases = diagnosis = speed = None
    node, silence, others, wanted = '', 0.0, frozenset(), False
    is_gone = is_master_gone = False

    @property
    def is_finished(self):
        return self.status is not None and self.status.stage == RunStatus.FINISHED

    @property
    def is_averaged(self):
        """Whether the spectrum has any exponents yet."""
        return self.spectrum is not None and self.spectrum.averaged_time > 0


class Watch:
    """Listens; view() is what is known now."""

    def __init__(self, node):
        self._node = node
        self._last, self._diagnosis = {}, None
        self._heard, self._speed = time.monotonic(), Speed()
        always = {f'{node}/{name}': (lazy(kind), self._hear) for name, kind in ALWAYS.items()}
        always['/diagnostics'] = DiagnosticArray, self._hear_diagnostics
        self._scout = Scout(
            node,
            always,
            {f'{node}/{name}': (lazy(kind), self._hear) for name, kind in COMPUTED.items()},
            self._silence,
        )

    def toggle_computed(self):
        """Has the node compute steps and LP phases although nobody else listens, or no more."""
        self._scout.toggle_wanted()

    def view(self):
        scout, view = self._scout, View()
        listened = scout.listened
        last = {
            topic.rpartition('/')[2]: message.unpacked()
            for topic, message in dict(self._last).items()
            if topic in listened
        }
        fill(view, last)
        view.node, view.silence = self._node, self._silence()
        view.diagnosis, view.speed = self._diagnosis, self._speed.add(view.cost)
        view.wanted, view.others = scout.wanted, {
            topic.rpartition('/')[2] for topic in scout.others
        }
        view.is_gone, view.is_master_gone = scout.is_node_gone, scout.is_master_gone
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


def fill(view, last):
    """With the last messages of the topics, but None and those that are left of a run before the
    one that the status is of."""
    last = {name: message for name, message in last.items() if message is not None}
    newest = last.get('status') or last.get('run_info')
    last = (
        {name: message for name, message in last.items() if message.run_id == newest.run_id}
        if newest
        else {}
    )
    view.info = last.get('run_info')
    view.status, view.cost = last.get('status'), last.get('cost')
    view.spectrum, view.steps = last.get('spectrum'), last.get('steps')
    view.phases = last.get('lp_phases')


class Speed:
    """Simulated time per wall second, over the last seconds."""

    def __init__(self):
        self._marks = deque()

    def add(self, cost):
        """None while not known."""
        if cost is None:
            return None
        marks = self._marks
        if marks and cost.wall_seconds < marks[-1][0]:
            marks.clear()  # another run
        if not marks or cost.wall_seconds > marks[-1][0]:
            marks.append((cost.wall_seconds, cost.sim_time))
        while len(marks) > 2 and marks[-1][0] - marks[1][0] >= SPEED_OVER:
            marks.popleft()
        (began, start), (ended, end) = marks[0], marks[-1]
        return (end - start) / (ended - began) if ended > began else None


def lazy(kind):
    """The class of messages, unpacked only when asked: most are replaced before they are seen, and
    what is spent on them a node on the same cores does not get."""

    class Lazy(kind):
        def deserialize(self, data):
            self.data, self.message = data, None
            return self

        def unpacked(self):
            """None if it is damaged."""
            if self.data is not None:
                try:
                    self.message = kind().deserialize(self.data)
                except Exception:  # whatever a damaged byte makes of genpy
                    self.message = None
                self.data = None
            return self.message

    return Lazy
