"""Phases of LP pairs against time, and how far they are from turning evenly."""

import numpy as np

from hdlyap.data import steps
from hdlyap.data.phases import apart, regression, turning
from hdlyap.numbers import with_error

from . import page
from .style import GREEN, INK, ORANGE, PURPLE, SKY, thinned

COLOURS = GREEN, PURPLE, SKY, INK, ORANGE  # of steps; T and LP have others

STEPS = 4  # are shown
PER_STEP = 2  # phases of each: more would hide one another


@page.figure
def draw(page, recording, speeds=None, **look):
    """speeds: {name of a step: (v, its error)}, if they are known better than from its phases."""
    shown = chosen(recording)
    if not shown:
        return
    grid = page.panels(2, 1, 5.6, 5.6, squeeze=False, sharex=True)
    top, bottom = grid.flat
    for (step, numbers), colour in zip(shown, COLOURS):
        for number in numbers:
            for time, phase in recording.phases.curves(number):
                _curve(top, bottom, time, phase, {'color': colour, **look, 'label': None})
        named = {'label': _label(recording, step, speeds or {})}
        top.plot([], [], **{'color': colour, **look, **named})
    top.set_ylabel(r'phase $\varphi / 2\pi$')
    top.legend(loc='lower right', bbox_to_anchor=(1, 1), ncol=2)
    bottom.set_ylabel(r'deviation from even turning  [% of $2\pi$]')
    for axes in grid.flat:
        axes.set_xlabel('simulated time  [time units]')
    page.outer(grid)
    page.title(recording.info, top, bottom)


def chosen(recording):
    """[(number of a step, numbers of its phases)]: lowest resolved steps first, and of each the
    phases of different vectors and pairs that were tracked longest."""
    if recording.phases.last is None:
        return []
    shown = []
    for number, _ in steps.resolved_lp(recording.steps):
        tracked = {phase: _tracked(recording, phase) for phase in recording.phases.of_step(number)}
        ranked = [(-time, phase) for phase, time in tracked.items() if time > 0]
        ranked = [phase for _, phase in sorted(ranked)]
        if ranked:
            shown.append((number, apart(recording.phases.last.phases, ranked)[:PER_STEP]))
    return shown[:STEPS]


def _tracked(recording, number):
    """Time in all."""
    return sum(time[-1] - time[0] for time, _ in recording.phases.curves(number))


def _curve(top, bottom, time, phase, look):
    kept = thinned(len(time))
    top.plot(time[kept], phase[kept] / (2 * np.pi), **look)
    off = 100 * (phase - regression(time, phase)) / (2 * np.pi)
    bottom.plot(time[kept], off[kept], **{'linewidth': 0.8, 'alpha': 0.8, **look})


def _label(recording, number, speeds):
    name = steps.name(recording.steps.steps[number], recording.info)
    speed = speeds.get(name) or _speed(recording, number)
    return name + (f': $v = {with_error(*speed, decimals=3)}$' if speed else '')


def _speed(recording, number):
    phases = [recording.phases.last.phases[i] for i in recording.phases.of_step(number)]
    step = recording.steps.steps[number]
    omega, error, _ = turning(step, phases)
    k = step.wave_number
    return (omega / k, error / k) if np.isfinite(omega) else None
