"""Bags of the reproduction in memory, in place of files."""

import numpy as np

from hdlyap.data.reader import FIELD
from hdlyap.data.said import Said
from study import bags


class Data:
    """In place of data.run.Run."""

    is_mean, left_out = False, ()

    def __init__(self, messages):
        self.info, self._of = messages[0], {}
        for message in messages:
            for name, value in zip(
                message.__slots__, map(message.__getattribute__, message.__slots__)
            ):
                if isinstance(value, (list, tuple)) and value and not hasattr(value[0], '_type'):
                    setattr(message, name, np.array(value))
            self._of.setdefault(bags.TOPICS.get(message._type), []).append(message)

    def messages(self, topic):
        return iter(self._of.get(topic, ()))

    def last(self, topic, numpy=None):
        return self._of[topic][-1]

    def has(self, topic):
        return topic in self._of

    @property
    def fields(self):
        found = {one.index: one for one in self.messages(bags.TOPICS[FIELD])}
        return dict(sorted(found.items()))


class Bag(bags.Bag):
    def __init__(self, messages, name=''):
        super().__init__(f'{name}.bag')
        self.run = Data(list(messages))
        self.recording = Said(self.run)
