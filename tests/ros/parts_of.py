"""`reproduce` with a part for each run of a plan instead of the paper's: parts_of.py RUN,RUN..
OPTION.. HDLYAP_TEST_SILENCE: seconds that a node may be silent. HDLYAP_TEST_BROKEN: a part that
fails."""

import os
import runpy
import sys

import made
from hdlyap.plots.figures import plt
from hdlyap.reproduce import parts
from hdlyap.reproduce.row import Claim, Row
from hdlyap.runs import work


class Part:
    """Of one run: its averaged time, in each way in which a part can show it."""

    def __init__(self, name):
        self.name, self.TITLE = name, f'all about {name}'

    def runs(self, plan):
        return [self.name]

    def claims(self, bags):
        if self.name == os.environ.get('HDLYAP_TEST_BROKEN'):
            raise ValueError('no such column')
        time = Row('averaged time', 2.0, bags[self.name].recording.spectrum.averaged_time)
        yield Claim('so long', [time], 'the same')

    def figures(self, bags):
        yield self.name, plt.figure(figsize=(1, 1))

    def tables(self, bags):
        yield self.name, ('disks',), [(bags[self.name].info.disks,)]


if __name__ == '__main__':
    parts.PARTS = tuple(map(Part, sys.argv.pop(1).split(',')))
    work.SILENCE = float(os.environ.get('HDLYAP_TEST_SILENCE', work.SILENCE))
    sys.argv[0] = os.path.join(made.SCRIPTS, 'reproduce')
    runpy.run_path(sys.argv[0], run_name='__main__')
