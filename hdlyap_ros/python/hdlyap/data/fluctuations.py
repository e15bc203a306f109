"""Fluctuations message -> frames of the growth of vectors over finite times."""

import numpy as np
import pandas
from hdlyap import msg

from hdlyap.numbers import known

from . import fields, frames, steps


class Orders:
    """`times`: frame of the finite times, shortest first, and how often each has passed.
    `violations`, `domination_violations`: a row for each time, a column for each Lyapunov index l
    for the pair (l, l + 1). From a Fluctuations or a Covariant message."""

    def __init__(self, message):
        told, unit = message.orders, fields.of(msg.GrowthOrder)['time'].unit
        columns = {name: [getattr(one, name) for one in told] for name in ('time', 'count')}
        self._first = message.first_index
        self.times = frames.frame(columns, {'time': unit})
        for name in ('violations', 'domination_violations'):
            setattr(self, name, self._rows([getattr(one, name) for one in told]))

    def _rows(self, rows):
        count = len(self.times)
        rows = np.array(rows, dtype=float).reshape(count, -1 if count else 0)
        times = pandas.Index(self.times['time'], name='time')
        last = self._first + rows.shape[1]
        return pandas.DataFrame(rows, times, pandas.RangeIndex(self._first, last, name='index'))


class Growth(Orders):
    """Of the Gram-Schmidt vectors. `variances` of the growth over each time, divided by the time.
    `indices`: {name: Lyapunov indices} of the steps. Frames of pairs of these: `covariances`, their
    `std_errors`, `correlations` over long times, and in `reversals` one for each time."""

    def __init__(self, message, info=None):
        super().__init__(message)
        self.variances = self._rows(message.variances)
        self.indices = {steps.name(one, info): list(one.indices) for one in message.steps}
        self.covariances = self._pairs(message.covariances)
        self.std_errors = self._pairs(known(message.covariance_errors))
        diffusions = np.array(message.diffusions)
        own = [
            diffusions[np.array(one, dtype=int) - message.first_index].mean()
            for one in self.indices.values()
        ]
        own = [one if one > 0 else np.nan for one in own]  # an estimate can be negative
        self.correlations = self.covariances / np.sqrt(np.outer(own, own))
        every = np.reshape(message.reversals, (len(self.times), -1))
        self.reversals = [self._pairs(one) for one in every]

    def _pairs(self, values):
        count = len(self.indices)
        index = pandas.Index(list(self.indices), name='step', dtype=object)
        values = np.array(values, dtype=float).reshape(count, count)
        return pandas.DataFrame(values, index, index)
