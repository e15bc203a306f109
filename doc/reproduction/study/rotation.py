"""LpPhases messages of a run -> how the vectors of each LP step turn between L and P."""

import numpy as np

from hdlyap.msg import LpPhase

from hdlyap.data import waves
from hdlyap.data.phases import goes_on
from hdlyap.data.reader import PHASES
from hdlyap.data.steps import wave_name

from . import blocks
from .averages import UNKNOWN
from .bags import once

QUARTER = np.pi / 2
TABLE = 'a b phase tracked_time index state'


class Rotation:
    """One LP step. Columns are its phases, vectors outside and pairs inside. z = a + i b where a
    phase is tracked, else NaN, with a vector's sign as it was when its tracking began, so that it
    is continuous. Where tracking begins anew the first report is left out: what is known on both
    sides of a step in time is one phase that has gone on.
    """

    def __init__(self, info, first, time, table):
        """table: as TABLE, of each time and phase."""
        self.nx, self.ny, self.time = first[0].nx, first[0].ny, time
        self.name = wave_name('LP', first[0])
        self.wave_number = float(np.hypot(*waves.wave_vector(info, self.nx, self.ny)))
        self.modulation = np.array([phase.modulation for phase in first])
        self.pairs = len(set(self.modulation))
        self.a, self.b, phase, tracked_time, self.index, self.state = np.moveaxis(table, 2, 0)
        on = self.state == LpPhase.TRACKED
        anew = np.zeros_like(on)
        anew[1:] = on[1:] & on[:-1] & ~goes_on(time, tracked_time)
        self.phase = np.where(on & ~anew, phase, np.nan)
        self.z = np.hypot(self.a, self.b) * np.exp(1j * self.phase)

    @property
    def is_tracked(self):
        return np.isfinite(self.phase).any()

    def turns(self):
        """Turn from each report to the next, NaN if unknown: the mean over the phases that are
        known at both, each of them alike. The turn of sum conj(z) z' would weigh with |z|^2, which
        is biased where |z| goes with the rate.
        """
        steps = np.diff(self.phase, axis=0)
        known = np.isfinite(steps).sum(axis=1)
        return np.where(known > 0, np.nansum(steps, axis=1) / np.maximum(known, 1), np.nan)

    def omega(self):
        """Mean rate and its standard error; (None, 0) if it has not been tracked for long."""
        turns = self.turns()
        known = np.isfinite(turns)
        return blocks.quotient(turns[known], np.diff(self.time)[known])

    def velocity(self):
        """|omega| / k and its standard error."""
        omega, error = self.omega()
        k = self.wave_number
        return (abs(omega) / k, error / k) if omega is not None else UNKNOWN

    def strength(self):
        """Mean over the vectors of a^2 + b^2, added up over the pairs, and its standard error;
        times at which it is too small for a phase count as well."""
        measured = (self.state == LpPhase.TRACKED) | (self.state == LpPhase.WEAK)
        whole = np.where(measured, self.a**2 + self.b**2, np.nan)
        per_vector = whole.reshape(len(whole), -1, self.pairs).sum(axis=2)
        known = np.isfinite(per_vector).any(axis=1)
        return blocks.mean(np.nanmean(per_vector[known], axis=1)) if known.any() else UNKNOWN


@once
def read(bag):
    """{(nx, ny): Rotation} of the LP steps of a run's bag; of those alone that have been
    tracked."""
    messages = list({one.sample_time: one for one in bag.messages(PHASES)}.values())
    if not messages:
        return {}
    columns = {}
    for column, phase in enumerate(messages[0].phases):
        columns.setdefault((phase.nx, phase.ny), []).append(column)
    time, names = np.array([message.sample_time for message in messages]), TABLE.split()
    table = [[[getattr(one, name) for name in names] for one in some.phases] for some in messages]
    table, found = np.array(table, dtype=float).reshape(len(messages), -1, len(names)), {}
    for wave, which in columns.items():
        first = [messages[0].phases[column] for column in which]
        found[wave] = Rotation(bag.info, first, time, table[:, which])
    return {wave: one for wave, one in found.items() if one.is_tracked}


def quarters(time, phase):
    """(from L, time) of a tracked phase from each multiple of a quarter turn to the next, whichever
    way it turns; from L: whether the quarter begins at L or -L, and ends at P or -P."""
    reached = np.maximum.accumulate(phase if phase[-1] >= phase[0] else -phase)
    levels = QUARTER * np.arange(
        np.floor(reached[0] / QUARTER) + 1, np.floor(reached[-1] / QUARTER) + 1
    )
    at = np.searchsorted(reached, levels)
    share = (levels - reached[at - 1]) / (reached[at] - reached[at - 1])
    times = np.diff(time[at - 1] + share * (time[at] - time[at - 1]))
    return np.round(levels[:-1] / QUARTER).astype(int) % 2 == 0, times


def stretches(known, shortest=3):
    """Slices of rows where all columns are known without a break."""
    on = np.r_[False, known.all(axis=1), False].astype(int)
    begins, ends = np.flatnonzero(np.diff(on) == 1), np.flatnonzero(np.diff(on) == -1)
    return [slice(begin, end) for begin, end in zip(begins, ends) if end - begin >= shortest]
