"""What is under way, in a line: which runs, how much of all is done, about how long the rest takes."""

import time

from hdlyap_follow.line import Display as Line
from hdlyap_plots.numbers import clock

TRUSTED = 0.02      # of the whole: before that nothing is said about the rest


class Display:
    """For work.work: shows progress through `count` runs."""

    def __init__(self, count):
        self._count, self._line = count, Line()
        self._began = time.monotonic()
        self._ended = set()
        self._seen = set()

    def __call__(self, under_way, done, total):
        self._seen.update(job.run.name for job in under_way)
        self._ended = self._seen - {job.run.name for job in under_way}
        parts = [f'{len(self._ended)} of {self._count} runs done']
        parts += [f'{job.run.name} {100 * job.share:.0f} %' for job in under_way]
        share = done / total if total else 1.0
        if share > TRUSTED:
            spent = time.monotonic() - self._began
            parts.append(f'all {100 * share:.0f} %, about {clock(spent * (1 / share - 1))} left')
        self._line.show('  '.join(parts), last=not under_way)
        if not under_way and len(self._ended) == self._count:
            self._line.close()
