"""LpPhases messages -> every phase over time, as curves without gaps."""

import numpy as np

from hdlyap.numbers import known

from .course import Course

SHORTEST = 3  # fewest points of a curve


def goes_on(time, tracked_time):
    """Whether tracking went on from each report to the next one. If it began anew, its tracked time
    is shorter than the time that has gone by. tracked_time: of one phase, or columns of several."""
    return (np.diff(tracked_time, axis=0).T > 0.5 * np.diff(time)).T


class PhaseCourse:
    """The last message, and phase and tracked time of every phase at every sample."""

    def __init__(self):
        self.last = None
        self._course = Course()

    def add(self, msg):
        """Adds a message. Two reports can have the same sample; the second one is ignored."""
        known = self.last is not None and self.last.sample_time == msg.sample_time
        self.last = msg
        if known:
            return
        tracked = [phase.state == phase.TRACKED for phase in msg.phases]
        phases = (phase.phase if on else np.nan for phase, on in zip(msg.phases, tracked))
        times = (phase.tracked_time for phase in msg.phases)
        self._course.add((msg.sample_time, *phases, *times))

    def of_step(self, step):
        """The numbers of the phases that belong to an element of Steps.steps."""
        return [number for number, phase in enumerate(self.last.phases) if phase.step == step]

    def curves(self, number):
        """(times, phases) of each stretch that was tracked without a gap."""
        table = self._course.table()
        time, phase = table[:, 0], table[:, 1 + number]
        tracked = table[:, 1 + len(self.last.phases) + number]
        on = np.isfinite(phase)
        unbroken = on[1:] & on[:-1] & goes_on(time, tracked)
        for piece in np.split(np.arange(len(time)), 1 + np.flatnonzero(~unbroken)):
            if len(piece) >= SHORTEST and on[piece[0]]:
                yield time[piece], phase[piece]


def regression(time, phase):
    """The values of the straight line that fits the phases."""
    slope, start = np.polyfit(time - time[0], phase, 1)
    return start + slope * (time - time[0])


def turning(step, phases):
    """|omega| of a step, its error, and the number of its phases that are tracked."""
    tracked = sum(phase.state == phase.TRACKED for phase in phases)
    return abs(step.omega), float(known(step.omega_error)), tracked


def independent(phases, ranked):
    """The numbers of phases in `ranked`, in this order, without those that share a vector or a pair
    with one before."""
    found = []
    for number in ranked:
        if all(
            phases[number].index != phases[other].index
            and phases[number].modulation != phases[other].modulation
            for other in found
        ):
            found.append(number)
    return found
