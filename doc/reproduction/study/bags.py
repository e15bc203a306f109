"""A folder of bags, NAME.bag each -> the runs in it, each read as often as needed and no more."""

import os
from functools import cached_property, wraps

import hdlyap
from hdlyap import topics
from hdlyap.msg import RunStatus

TOPICS = {message._type: name for name, message in topics.RECORDED.items()}


class Bag:
    """Of one run."""

    def __init__(self, path):
        self.path, self.name = path, os.path.basename(path).rpartition('.')[0]

    @cached_property
    def run(self):
        return hdlyap.load(self.path)

    @cached_property
    def recording(self):
        """Its last messages and courses, as figures take them."""
        return self.run.summary

    @property
    def info(self):
        return self.run.info

    def messages(self, kind):
        """Every message of a type, 'hdlyap/LpPhases' say, in its order, with numpy arrays."""
        return self.run.messages(TOPICS[kind])

    def last(self, kind):
        """None if there is none."""
        last = None
        for last in self.messages(kind):
            pass
        return last

    @property
    def is_complete(self):
        """Whether the run went to its end."""
        last = self.last(RunStatus._type)
        return last is not None and last.stage == RunStatus.FINISHED and last.progress >= 1


def found(folder, names):
    """{name: Bag} of those that are there and went to their end."""
    bags = {name: Bag(os.path.join(folder, name + '.bag')) for name in names}
    return {name: bag for name, bag in bags.items() if os.path.isfile(bag.path) and bag.is_complete}


def once(read):
    """What is read of a bag is kept with it."""

    @wraps(read)
    def kept(bag):
        found = bag.__dict__.setdefault('_once', {})
        if read not in found:
            found[read] = read(bag)
        return found[read]

    return kept
