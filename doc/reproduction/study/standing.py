"""TPhases messages of a run -> how fast the waves of its T steps move, if they do, and how they
diffuse."""

import numpy as np

from hdlyap.msg import LpPhase

from hdlyap.data import steps, waves
from hdlyap.data.phases import goes_on

T_PHASES = 'hdlyap/TPhases'


class Standing:
    """One T step that has its vectors for itself. Its vectors and pairs share one space of few
    dimensions and move together: the errors of means over them are those of one. Known: those
    numbers of its phases that have an error."""

    def __init__(self, info, phases):
        self.nx, self.ny = phases[0].nx, phases[0].ny
        self.name = steps.wave_name('T', phases[0])
        self.wave_number = float(np.hypot(*waves.wave_vector(info, self.nx, self.ny)))
        self._phases = [phase for phase in phases if phase.state == LpPhase.TRACKED]

    def velocity(self):
        """Mean omega / k with its sign, and its standard error; (None, 0) while not known."""
        omega, error = self._mean('omega')
        return (
            (None, 0.0) if omega is None else (omega / self.wave_number, error / self.wave_number)
        )

    def diffusion(self):
        """(D, its standard error) [rad^2/time unit]"""
        return self._mean('diffusion')

    def _mean(self, name):
        known = [
            (getattr(phase, name), getattr(phase, name + '_error'))
            for phase in self._phases
            if getattr(phase, name + '_error') > 0
        ]
        return tuple(map(float, np.mean(known, axis=0))) if known else (None, 0.0)


def read(bag):
    """{(nx, ny): Standing} as the last message has them: of the resolved T steps alone."""
    message, alone = bag.last(T_PHASES), _alone(bag.recording.steps)
    found = {}
    for phase in message.phases if message is not None else ():
        if (phase.nx, phase.ny) in alone:
            found.setdefault((phase.nx, phase.ny), []).append(phase)
    return {wave: Standing(bag.info, phases) for wave, phases in found.items()}


def _alone(message):
    """Nodes of the T steps whose vectors are no others'."""
    return {
        (block.steps[0].nx, block.steps[0].ny)
        for block in steps.blocks(message)
        if len(block.steps) == 1 and block.name.startswith('T')
    }


def course(bag, wave):
    """(times, phases) of the first vector and pair of this step, in stretches tracked without a
    break."""
    rows = []
    for message in bag.messages(T_PHASES):
        first = next((one for one in message.phases if (one.nx, one.ny) == wave), None)
        if first is not None and first.state == LpPhase.TRACKED:
            rows.append((message.sim_time, first.phase, first.tracked_time))
    time, phase, tracked = np.array(rows).reshape(-1, 3).T
    broken = 1 + np.flatnonzero(~goes_on(time, tracked))
    return list(zip(np.split(time, broken), np.split(phase, broken)))
