"""Faults of a program, as they change the messages of a made run of the reproduction."""

from unittest import mock

import numpy as np

import reproduced
from damaged import of, step
from hdlyap.plots import paper
from made import LP, T
from reproduced import messages_of


def steps(change):
    """Of every step that was found."""

    def fault(messages):
        for one in of(messages, 'Steps')[-1].steps:
            if one.resolved and one.kind in (T, LP):
                change(messages[0], one)
        return messages

    return fault


def each(kind, change):
    """Of every message of a kind, by its number."""

    def fault(messages):
        for number, message in enumerate(of(messages, kind)):
            change(message, number)
        return messages

    return fault


def phases(change):
    """Of every phase of an LP step: change(phase, time)."""
    return each(
        'LpPhases', lambda message, _: [change(one, message.sim_time) for one in message.phases]
    )


def scaled(name, factor, kind=None):
    def change(info, one):
        if kind in (None, one.kind):
            setattr(one, name, factor * getattr(one, name))

    return steps(change)


def exchanged(info, one):
    one.kind = {T: LP, LP: T}[one.kind]


def to_the_walls(info, one):
    """k without the diameter that the centres do not reach."""
    if 'reflecting' in (info.boundary_x, info.boundary_y):
        one.wave_number = float(np.pi * np.hypot(one.nx / info.box_x, one.ny / info.box_y))


def shifted(info, one):
    one.first_index, one.last_index = one.first_index + 1, one.last_index + 1


def higher(info, one):
    """T as the density inside would have it."""
    if one.kind == T and 'reflecting' in (info.boundary_x, info.boundary_y):
        inside = reproduced.pressure.inside(info)
        one.exponent *= paper.slope_t(inside) / paper.slope_t(info.density)


def turned(factor, *waves):
    """Rates of these waves, or of all."""

    def change(one, time):
        if not waves or (one.nx, one.ny) in waves:
            turn(one, one.phase + (factor - 1) * one.omega * time)

    return phases(change)


def turn(one, phase):
    z = np.hypot(one.a, one.b) * np.exp(1j * phase)
    one.a, one.b, one.phase = z.real, z.imag, phase


def trembling(one, time):
    turn(one, one.phase + np.sin(0.5 * time))


def backwards(one, time):
    turn(one, -one.phase)


def smaller(one, time):
    one.a, one.b = 0.9 * one.a, 0.9 * one.b


def standing(one, time):
    """Cosine and sine turn together."""
    turn(one, one.omega * time)


def pairs_exchanged(one, time):
    one.a, one.b = one.b, one.a


def behind(one, time):
    z = complex(one.a, one.b) * np.exp(0.07j)
    one.a, one.b = z.real, z.imag


def right_angle(field, _):
    field.dqx, field.dqy = field.dqy, -field.dqx
    if field.pairs:
        field.l_x, field.l_y = field.l_y, -field.l_x


def mistaken(field, _):
    field.kind = {T: LP, LP: T}[field.kind]


def other_modulation(field, _):
    if (field.nx, field.ny) == (1, 0):
        field.modulation = bytes(field.modulation)[::-1]


def spectra(change):
    """Of the exponents, in every message."""

    def fault(message, _):
        message.exponents = np.array(message.exponents)
        change(message.exponents)

    return each('Spectrum', fault)


def entry(name, index, value):
    def fault(message, _):
        values = np.array(getattr(message, name))
        values[index] = value(values[index]) if callable(value) else value
        setattr(message, name, values)

    return fault


def two_below(messages):
    """Exponents smaller than those of LP(1,0), where walls allow none."""
    for message in of(messages, 'Spectrum'):
        values = np.array(message.exponents)
        message.exponents = np.concatenate([values[2:], [0.5 * values[-1]] * 2])

    def change(info, one):
        one.first_index, one.last_index = one.first_index - 2, one.last_index - 2

    return steps(change)(messages)


def gas(**factors):
    def change(message, _):
        for name, factor in factors.items():
            setattr(message, name, factor * getattr(message, name))

    return each('Gas', change)


def answers(kind, name, change):
    def fault(message, _):
        for one in message.responses:
            if one.kind == kind:
                setattr(one, name, change(one))

    return each('Hydro', fault)


def beside(value):
    """C with this beside its diagonal."""

    def fault(messages):
        with mock.patch.object(reproduced, 'SYMMETRIC', value):
            return messages_of('hydro')

    return fault


def widths(change):
    def fault(message, _):
        message.widths = change(np.array(message.widths), message)

    return each('Localization', fault)


def of_t(value):
    def fault(messages):
        one = step(messages, T, 1, 0)
        return widths(lambda w, _: np.where(np.arange(1, len(w) + 1) >= one.first_index, value, w))(
            messages
        )

    return fault


def lines(of_lp=1.0, of_t=0.0):
    """Rates of the vectors' waves over v k."""

    def fault(messages):
        name = 'structure_' + messages[0].boundary_x
        v = of(messages, 'Steps')[-1].v
        return reproduced.structure(reproduced.Run(name), omega=(of_lp * v, of_t * v))

    return fault


def directions(message, _):
    message.along, message.across = message.across, message.along


def drifting(message, _):
    for phase in message.phases:
        phase.omega += 0.02


def faster_runs(messages):
    for message in of(messages, 'Spectrum'):
        message.exponents, message.ks_entropy = 1.02 * message.exponents, 1.02 * message.ks_entropy
    return scaled('exponent', 1.02)(messages)


def more(messages):
    """Exponents of steps, in steps and spectrum."""
    for message in of(messages, 'Spectrum'):
        message.exponents = 1.04 * np.array(message.exponents)
    return scaled('exponent', 1.04)(messages)
