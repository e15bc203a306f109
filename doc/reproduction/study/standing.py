"""TPhases messages of a run -> how fast the waves of its T steps move, if they do, and how they
diffuse."""

from collections import namedtuple

import numpy as np

from hdlyap.data import steps, waves
from hdlyap.data.phases import goes_on
from hdlyap.msg import LpPhase

from .averages import UNKNOWN

T_PHASES = 'hdlyap/TPhases'
# one T step that has its vectors for itself; velocity: mean omega / k with its sign, diffusion: D
# [rad^2/time unit], each with its standard error
Standing = namedtuple('Standing', 'name velocity diffusion')


def read(bag):
    """{(nx, ny): Standing} as the last message has them: of the resolved T steps alone."""
    message, found = bag.last(T_PHASES), {}
    alone = [one for one in steps.blocks(bag.recording.steps) if len(one.steps) == 1]
    nodes = {(one.steps[0].nx, one.steps[0].ny) for one in alone if one.kind == steps.T}
    for phase in message.phases if message is not None else ():
        if (phase.nx, phase.ny) in nodes:
            found.setdefault((phase.nx, phase.ny), []).append(phase)
    return {wave: _standing(bag.info, wave, phases) for wave, phases in found.items()}


def _standing(info, wave, phases):
    k, (omega, error) = float(np.hypot(*waves.wave_vector(info, *wave))), _mean(phases, 'omega')
    velocity = UNKNOWN if omega is None else (omega / k, error / k)
    return Standing(steps.wave_name('T', phases[0]), velocity, _mean(phases, 'diffusion'))


def _mean(phases, name):
    """Of those that have an error. Vectors and pairs of a step share one space of few dimensions
    and move together: the errors of means over them are those of one."""
    tracked = [phase for phase in phases if phase.state == LpPhase.TRACKED]
    both = [(getattr(one, name), getattr(one, f'{name}_error')) for one in tracked]
    known = [pair for pair in both if pair[1] > 0]
    return tuple(map(float, np.mean(known, axis=0))) if known else UNKNOWN


def course(bag, wave):
    """(times, phases) of the first vector and pair of this step, in stretches tracked without a
    break."""
    rows = []
    for message in bag.messages(T_PHASES):
        first = next((one for one in message.phases if (one.nx, one.ny) == wave), None)
        if first is not None and first.state == LpPhase.TRACKED:
            rows.append((message.sample_time, first.phase, first.tracked_time))
    time, phase, tracked = np.array(rows).reshape(-1, 3).T
    broken = 1 + np.flatnonzero(~goes_on(time, tracked))
    return list(zip(np.split(time, broken), np.split(phase, broken)))
