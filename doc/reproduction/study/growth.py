"""Spectrum messages of a run -> how its local exponents fluctuate: variance of the mean growth over
a time t, times t. It does not depend on t once t is long against what the growth remembers."""

import numpy as np

from hdlyap.data.reader import SPECTRUM

from . import blocks, points

SHORT = 0.2  # of the median length: shorter samples may not have forgotten what was before them
LARGEST, MIDDLE, LAST_T, LAST_LP = 'lambda_1', 'bulk', 'smallest T', 'smallest LP'
STEPS = (LAST_T, LAST_LP)
GROUPS = (LARGEST, MIDDLE, *STEPS)
BULK = (0.4, 0.6)  # of the positive exponents: their middle


class Growth:
    """local: rows are samples that follow each other, columns are indices from first_index on;
    time: the length of each sample [time units], which a run doubles as it goes on. Short ones are
    left out, that of the end for one."""

    def __init__(self, time, local, first_index):
        time, local = np.asarray(time, dtype=float), np.asarray(local, dtype=float)
        if len(time):
            usual = time >= SHORT * np.median(time)
            time, local = time[usual], local[usual]
        self.time, self.local, self.first_index = time, local, first_index

    @property
    def samples(self):
        return len(self.time)

    @property
    def length(self):
        """Of a sample, on average."""
        return float(self.time.mean())

    def joined(self, count):
        """So many neighbours to one sample; a rest is left out."""
        whole = self.samples // count * count
        time = self.time[:whole].reshape(-1, count)
        weighted = (self.time[:whole, None] * self.local[:whole]).reshape(len(time), count, -1)
        total = time.sum(axis=1)
        return Growth(total, weighted.sum(axis=1) / total[:, None], self.first_index)

    def squares(self):
        """t (growth - its mean)^2 of each sample and index: their mean is the variance times t."""
        mean = np.average(self.local, axis=0, weights=self.time)
        return self.time[:, None] * (self.local - mean) ** 2 * self.samples / (self.samples - 1)

    def of(self, indices):
        """(mean of the variance times t over these Lyapunov indices, its standard error from blocks
        of time); (None, 0) of fewer samples than blocks."""
        squares = self.squares()[:, np.asarray(indices) - self.first_index]
        return blocks.mean(squares.mean(axis=1))

    def memory(self, indices):
        """(Mean correlation of neighbouring samples, its standard error): 0 of independent ones."""
        off = self.local - np.average(self.local, axis=0, weights=self.time)
        off = off[:, np.asarray(indices) - self.first_index]
        shared = (off[1:] * off[:-1]).mean(axis=1)
        return blocks.quotient(shared, (off[1:] ** 2).mean(axis=1))


def read(bag):
    """Growth of a run; None if its messages do not say how long samples are, or if there are too
    few of them."""
    messages = [message for message in bag.messages(SPECTRUM) if message.local_time > 0]
    if not messages:
        return None
    last = messages[-1]
    messages = [one for one in messages if len(one.local_exponents) == len(last.local_exponents)]
    found = Growth(
        [one.local_time for one in messages],
        [one.local_exponents for one in messages],
        last.first_index,
    )
    return found if found.samples >= blocks.BLOCKS else None


def indices(recording):
    """{group: Lyapunov indices}, of those that the run has."""
    spectrum = recording.spectrum
    half = recording.positive_end
    carried = range(spectrum.first_index, recording.last_index + 1)
    wanted = {LARGEST: range(1, 2), MIDDLE: range(int(BULK[0] * half) + 1, int(BULK[1] * half) + 1)}
    for name, kind in zip(STEPS, points.KINDS):
        point = points.smallest(recording, kind)
        wanted[name] = point.indices if point and not point.shares else ()
    found = {name: [one for one in some if one in carried] for name, some in wanted.items()}
    return {name: some for name, some in found.items() if some}
