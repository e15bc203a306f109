"""A node's topics -> a run like a recorded one, with what a bag would hold by now."""

import math
import threading

from hdlyap.data.reader import RUN_INFO, Packed
from hdlyap.data.joined import Part
from hdlyap.data.run import Run

from .watch import ALWAYS, COMPUTED, Watch

MOST = 512  # messages of a topic that are kept: more points cannot be seen
LAST = 'status', 'cost', 'steps'  # topics of which figures need the last message only


class Live(Run):
    """A run that is still going on. messages: {type: messages} so far, also of runs before it."""

    def __init__(self, node, info, messages, *fits):
        super().__init__([Part(node, node, info.run_id, info, math.inf)], 1, *fits)
        self._messages = messages

    def packed(self, kinds):
        found = [packed for kind in kinds for packed in self._messages.get(kind, ())]
        return (packed for packed in found if packed.run_id == self.info.run_id)


class Gathered(Watch):
    """Listens to all topics that figures need, also to those that the node computes for listeners
    only."""

    def __init__(self, node):
        self._kept, self._lock = {}, threading.Lock()
        self.count = 0  # number of messages that can change a figure
        super().__init__(node, wanted=True)

    def _hear(self, message, topic):
        name = topic.rpartition('/')[2]
        kind = {**ALWAYS, **COMPUTED}[name]
        packed = Packed(self._node, kind._type, message.data, None)
        with self._lock:
            self._keep(packed, 1 if name in LAST else MOST)
        self.count += name in ('spectrum', 'steps')
        super()._hear(message, topic)

    def _keep(self, packed, most):
        """Keeps a message. If there are too many, every second one is dropped, but not the first
        and the last one."""
        kept = self._kept.setdefault(packed.kind, [])
        if most == 1 or kept and kept[-1].run_id != packed.run_id:
            kept.clear()
        if len(kept) >= most > 1:
            del kept[1:-1:2]
        kept.append(packed)

    def run(self, info, form=None, k=None):
        with self._lock:
            messages = {kind: list(kept) for kind, kept in self._kept.items() if kind != RUN_INFO}
        return Live(self._node, info, messages, form, k)
