"""Structure messages -> the structure factors of every vector, the amplitudes of the slowest
vectors over time, and the line that these have in S(k, omega)."""

from collections import deque, namedtuple

import numpy as np

from . import space

KEPT = 64  # slowest vectors of positive exponent whose amplitudes are kept
LAST = 16384  # reports, 70 MB of amplitudes
FREQUENCIES = 400  # frequencies at which a spectrum is computed
PIECES = 4  # pieces of a course, whose scatter gives the error of its line
REPORTS = 4 * PIECES  # fewest reports of a course that has a line
FLOOR = 0.1  # least power in a line over the largest
# mean structure factors: along and across have a row for each wave, a column for each vector;
# nodes: nx, ny and, in space, nz
Means = namedtuple('Means', 'samples nx ny wave_number along across nodes')
Line = namedtuple('Line', 'omega error')
DIRECTIONS = 'along', 'across'


class StructureCourse:
    """Collects messages. means: the last mean structure factors, None if there are none; besides it
    keeps the amplitudes of the slowest vectors at the last reports."""

    def __init__(self):
        self.means = None
        self.first = 0  # Lyapunov index of the first vector that is kept
        self._times, self._peaks, self._amplitudes = (deque(maxlen=LAST) for _ in range(3))

    def add(self, msg, positive_end):
        """Adds a message with numpy arrays."""
        means = means_of(msg)
        self.means = self.means if means is None else means
        end = min(positive_end, len(msg.peak))
        self.first = max(0, end - KEPT) + 1
        kept = slice(self.first - 1, end)
        self._times.append(msg.sim_time)
        self._peaks.append(np.array(msg.peak[kept], dtype=int))
        self._amplitudes.append([amplitudes(msg, e)[:, kept] for e in DIRECTIONS])

    def of(self, indices, direction):
        """times and amplitudes[times, series] of these vectors, since all of them have the waves
        that they have in the end. There is a series for each vector and modulation."""
        if not self._times:
            return np.empty(0), np.empty((0, 0))
        columns = np.array([index - self.first for index in indices])
        peaks = np.array(self._peaks)[:, columns]
        other = np.flatnonzero((peaks != peaks[-1]).any(axis=1))
        begin = other[-1] + 1 if len(other) else 0
        which = DIRECTIONS.index(direction)
        found = np.array([one[which] for one in self._amplitudes])[begin:, :, columns]
        return np.array(self._times)[begin:], found.reshape(len(found), -1)

    def has(self, indices):
        end = self.first + (len(self._peaks[-1]) if self._peaks else 0)
        return bool(self._times) and min(indices) >= self.first and max(indices) < end


def means_of(msg):
    """The Means of a message with numpy arrays; None if it has none."""
    if not len(msg.along):
        return None
    shape, nodes = (len(msg.nx), len(msg.peak)), space.vectors(msg, 'n').astype(int)
    factors = (np.array(getattr(msg, name)).reshape(shape) for name in DIRECTIONS)
    return Means(msg.samples, *nodes[:2], np.array(msg.wave_number), *factors, nodes)


def amplitudes(msg, direction):
    """Amplitudes: a row for each modulation, a column for each vector. In space, across has twice
    as many rows."""
    solid = len(msg.nz) > 0
    rows = 8 * (1 + DIRECTIONS.index(direction)) if solid else 4
    return np.array(getattr(msg, 'amplitude_' + direction)).reshape(rows, len(msg.peak))


def power(times, series, omega):
    """S(k, omega) at frequencies omega, summed over the series in series[times, ..]. Times may have
    any distances. Hann's window keeps a line from leaking into others. The sum over frequencies of
    both signs, 2 pi / length apart, is the mean square."""
    times = times - times[0]
    window = (1 - np.cos(2 * np.pi * times / times[-1])) * np.gradient(times)
    turned = np.exp(-1j * np.outer(omega, times)) @ (window[:, np.newaxis] * series)
    return (np.abs(turned) ** 2).sum(axis=1) / (1.5 * times[-1] ** 2)


def largest_frequency(times):
    """The largest frequency that reports at these times can distinguish from smaller ones."""
    return np.pi / np.median(np.diff(times))


def frequencies(times):
    return np.linspace(0, largest_frequency(times), FREQUENCIES)


def line(times, series):
    """The middle of the line with the largest power, averaged from half to 1.5 times its frequency,
    and its standard error from pieces of the course; None if the course is too short. A line that
    cannot be distinguished from one at 0, as of modes that do not rotate, is at 0; its error is the
    resolution."""
    if len(times) < REPORTS or not (np.diff(times) > 0).all():
        return None
    whole = _middle(times, series, _largest(times, series))
    if whole == 0:
        return Line(0.0, _resolution(times))
    pieces = np.array_split(np.arange(len(times)), PIECES)
    parts = [_middle(times[piece], series[piece], whole) for piece in pieces]
    return Line(whole, np.std(parts, ddof=1) / np.sqrt(PIECES))


def _largest(times, series):
    omega = frequencies(times)
    largest = np.argmax(power(times, series, omega))
    return omega[largest] if omega[largest] > _resolution(times) else 0.0


def _resolution(times):
    """Half of the width of a line, for an even rotation."""
    return 4 * np.pi / (times[-1] - times[0])


def _middle(times, series, about):
    """The middle of a line near a frequency. It is computed twice, because the first result moves
    the range of frequencies, which ends where they have mirror images."""
    for _ in range(2 if about > 0 else 0):
        end = min(1.5, largest_frequency(times) / about)
        omega = about * np.linspace(0.5, end, 301)
        found = power(times, series, omega)
        about = np.average(omega, weights=np.where(found > FLOOR * found.max(), found, 0.0))
    return about
