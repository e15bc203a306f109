"""Structure messages -> frames of the structure factors, and of amplitudes over time."""

import numpy as np
import pandas

from . import factors, fields, frames

NODES = ['nx', 'ny', 'nz']


class Structure:
    """`waves`: frame of nodes and wave numbers. `along`, `across`: mean structure factors, with a
    row for each Lyapunov index and a column for each wave. `peaks`: for each index the wave at
    which their sum is largest."""

    def __init__(self, message):
        means = factors.means_of(message)
        index = pandas.RangeIndex(1, means.along.shape[1] + 1, name='index')
        unit = {'wave_number': fields.of(message)['wave_number'].unit}
        self.samples = means.samples
        self.waves = frames.frame(
            {**dict(zip(NODES, means.nodes)), 'wave_number': means.wave_number}, unit
        )
        names = pandas.MultiIndex.from_arrays(list(means.nodes), names=NODES[: len(means.nodes)])
        self.along = pandas.DataFrame(means.along.T, index, names)
        self.across = pandas.DataFrame(means.across.T, index, names)
        largest = np.argmax(means.along + means.across, axis=0)
        vectors = np.arange(len(index))
        at_peak = dict(zip(NODES, means.nodes[:, largest]), wave_number=means.wave_number[largest])
        for name in factors.DIRECTIONS:
            at_peak[name] = getattr(means, name)[largest, vectors]
        self.peaks = frames.frame(at_peak, unit, index)


def amplitudes(messages, indices, direction):
    """A frame over simulated time with a column for each index and modulation (0: COS_COS ..; in
    space, across has all first fields, then all second ones). NaN while a vector had another wave
    than in the end."""
    times, rows, peaks = [], [], []
    columns = np.array(indices) - 1
    for message in messages:
        most = len(message.peak)
        if len(columns) and not 0 <= columns.min() <= columns.max() < most:
            raise IndexError(f'indices {list(indices)}: must be from 1 to {most}')
        times.append(message.sim_time)
        rows.append(factors.amplitudes(message, direction)[:, columns])
        peaks.append(np.array(message.peak)[columns])
    shown = (np.array(peaks) == peaks[-1]) & (np.array(peaks) > 0)  # 0: no wave yet
    rows = np.where(shown[:, np.newaxis], rows, np.nan)
    names = pandas.MultiIndex.from_product(
        [range(rows[0].shape[0]), indices], names=['modulation', 'index']
    )
    frame = pandas.DataFrame(
        rows.reshape(len(rows), -1), pandas.Index(times, name='sim_time'), names
    )
    return frame.swaplevel(axis=1).sort_index(axis=1)
