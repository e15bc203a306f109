"""Phases of LP pairs against time, and their deviations from even rotation."""

import numpy as np

from hdlyap.data import steps
from hdlyap.data.phases import independent, regression, turning
from hdlyap.numbers import with_error

from . import page
from .style import GREEN, INK, ORANGE, PURPLE, SKY, thinned

ORDER = 7

COLOURS = GREEN, PURPLE, SKY, INK, ORANGE  # colours of steps, other than those of T and LP

STEPS = 4  # most steps that are shown
FEW = 24  # samples of a phase that are drawn as points, too
PER_STEP = 2  # most phases of each step; more would hide each other


@page.figure
def draw(page, recording, speeds=None, **look):
    """Draws phases. speeds: {name of a step: (v, its error)}, if known better than from its
    phases."""
    shown = chosen(recording)
    if not shown:
        return
    grid = page.panels(2, 1, 5.6, 5.6, squeeze=False, sharex=True)
    top, bottom = grid.flat
    for (step, numbers), colour in zip(shown, COLOURS):
        for number in numbers:
            curves = list(joined(list(recording.phases.curves(number))))
            are_few = sum(len(time) for time, _ in curves) <= FEW
            style = {'marker': '.' if are_few else '', 'color': colour, **look, 'label': None}
            for time, phase in curves:
                _curve(top, bottom, time, phase, style)
        named = {'label': _label(recording, step, speeds or {})}
        top.plot([], [], **{'color': colour, **look, **named})
    top.set_ylabel(r'phase $\varphi / 2\pi$')
    top.legend(loc='lower right', bbox_to_anchor=(1, 1), ncol=2)
    bottom.set_ylabel(r'deviation  [% of $2\pi$]')
    bottom.set_title('deviation from even turning', loc='left')
    for axes in grid.flat:
        axes.set_xlabel('simulated time  [time units]')
    page.outer(grid)
    page.title(recording.info, top, bottom)


def chosen(recording):
    """[(number of a step, numbers of its phases)]: the lowest resolved steps first, with those
    phases of different vectors and pairs that were tracked longest."""
    if recording.phases.last is None:
        return []
    shown = []
    for number, _ in steps.resolved_lp(recording.steps):
        tracked = {phase: _tracked(recording, phase) for phase in recording.phases.of_step(number)}
        ranked = [(-time, phase) for phase, time in tracked.items() if time > 0]
        ranked = [phase for _, phase in sorted(ranked)]
        if ranked:
            shown.append((number, independent(recording.phases.last.phases, ranked)[:PER_STEP]))
    return shown[:STEPS]


def _tracked(recording, number):
    """How long a phase was tracked in all."""
    return sum(time[-1] - time[0] for time, _ in recording.phases.curves(number))


def joined(curves):
    """Curves (time, phase) that go on from each other: a phase that was lost and found again counts
    from less than a turn, so that the turns of the longest curve, which turns evenly, are added.
    The first one begins less than a turn from 0."""
    if not curves:
        return
    times, phases = max(curves, key=lambda curve: curve[0][-1] - curve[0][0])
    slope, start = np.polyfit(times, phases, 1)
    start -= 2 * np.pi * np.fix((start + slope * curves[0][0][0]) / (2 * np.pi))
    for time, phase in curves:
        off = np.mean(start + slope * time - phase) / (2 * np.pi)
        yield time, phase + 2 * np.pi * np.round(off)


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
