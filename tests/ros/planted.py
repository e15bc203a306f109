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


def straight(info, one):
    if one.kind == LP:
        one.exponent -= paper.CURVES['LP'].c2 * one.wave_number**2


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


def far(field, _):
    field.rotation_distance = 0.9


def mistaken(field, _):
    field.kind = {T: LP, LP: T}[field.kind]


def other_modulation(field, _):
    if (field.nx, field.ny) == (1, 0):
        field.modulation = bytes(field.modulation)[::-1]


def entry(kind, name, index, value):
    """Of an array in every message: what it becomes, or what is made of it."""

    def fault(message, _):
        values = np.array(getattr(message, name))
        values[index] = value(values[index]) if callable(value) else value
        setattr(message, name, values)

    return each(kind, fault)


def exponents(index, value):
    return entry('Spectrum', 'exponents', index, value)


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


def answers(kind, name, factor, of):
    def fault(message, _):
        for one in message.responses:
            if one.kind == kind:
                setattr(one, name, factor * getattr(one, of))

    return each('Hydro', fault)


def beside(value):
    """C with this beside its diagonal."""

    def fault(messages):
        with mock.patch.object(reproduced, 'SYMMETRIC', value):
            return messages_of('hydro')

    return fault


def widths(change):
    def fault(message, _):
        message.widths = change(np.array(message.widths))

    return each('Localization', fault)


def alike(values):
    return np.full(len(values), 0.6)


def reversed_(values):
    return np.append(values[:30][::-1], values[30:])


def of_t(value):
    def fault(messages):
        first = step(messages, T, 1, 0).first_index - 1
        return entry('Localization', 'widths', slice(first, None), value)(messages)

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


# ---- all of them ---------------------------------------------------------------------------------

ALL, WALLS, BOXES = '*', '*reflecting*|*walls*', 'smallest_*|aspect_*|density_04'
PERIODIC = 'smallest_periodic_*|aspect_*_periodic|density_04|periodic'
SIZE = 'exponents of the; c_T follows; c_L follows; v is close; lambda_T =; lambda_L ='
KINDS = (
    'indices of the; indices of T(2,0); exponents of the; c_T follows; c_L follows; c_T is; '
    'c_T and v; lambda_T =; lambda_L =; c2 of L is; every step; vectors of; the line of LP; '
    'a T mode is'
)
OF_P = 'v goes to 0.988; v goes to the; LP modes turn alike in; LP modes turn alike between'
SLOPES = 'slopes do not depend on the aspect ratio, '
FIELD, SPECTRUM = 'ModeField', 'Spectrum'
# what, runs, what it does to their messages, beginnings of the statements that turn red; after a >
# of those that turn green
FAULTS = (
    ('exponents 4 % too large', ALL, more, SIZE),
    ('exponents 4 % too small', ALL, scaled('exponent', 0.96), SIZE),
    ('T and L exchanged', ALL, steps(exchanged), KINDS),
    (
        'k up to the walls',
        *(ALL, steps(to_the_walls)),
        f'one curve; lambda_T is; lambda_L is; {SLOPES}reflecting; the line of LP',
    ),
    (
        'indices one too large',
        *('periodic', steps(shifted), 'indices of the; indices of T(2,0); exponents of a'),
    ),
    (
        'an exponent of a step is off',
        *('periodic', exponents(-2, lambda one: 1.03 * one), 'exponents of a; every step'),
    ),
    ('cosine below the zeros', 'halves', entry(SPECTRUM, 'cos_theta', 1556, 0.9), 'cos Theta'),
    ('one zero mode less', 'halves', exponents(1557, 0.5), 'the zero exponents'),
    ('ratio', 'halves', entry(SPECTRUM, 'dp_dq_ratio', -9, lambda one: 2 * one), "C' of the"),
    (
        'a pair whose sum is not 0',
        'halves',
        exponents(900, lambda one: one + 1e-6),
        'exponents are',
    ),
    (
        'arrows turned by a right angle',
        *('periodic', each(FIELD, right_angle), 'T and LP modes; T modes are free; L modes are'),
    ),
    (
        'fields of T and L exchanged',
        *('periodic', each(FIELD, mistaken), 'T and LP modes; T modes are free'),
    ),
    (
        'modulations exchanged',
        *('periodic', each(FIELD, other_modulation), 'phi_P,x /; phi_P is not'),
    ),
    (
        'P along y is larger',
        *('periodic', entry(FIELD, 'p_over_py', slice(None), lambda one: 1.2 * one), 'phi_P,x /'),
    ),
    ('vectors that are no rotation', 'periodic', each(FIELD, far), 'the vectors'),
    ('a quarter that is 3.20', 'reflecting', turned(2.984 / 3.2, (1, 0)), '> 3.20 is a'),
    ('modes that turn from P to L', 'reflecting', phases(backwards), 'an L mode'),
    ('coefficients inside of the circle', 'reflecting', phases(smaller), 'a^2 + b^2'),
    ('omega not in proportion to k', 'periodic', turned(1.02, (0, 1)), 'omega is in'),
    ('uneven phases', 'periodic', phases(trembling), 'phases turn'),
    ('T modes that move', 'periodic', each('TPhases', drifting), 'T modes are stationary'),
    ('small c_L', 'density_0[78]', scaled('exponent', 0.85, LP), 'c_L follows; c_T and v'),
    ('rates of LP modes 12 % too large', 'density_*', scaled('omega', 1.12), 'v is close'),
    ('rates 16 % too small', 'density_*', scaled('omega', 0.84), 'v is close; v is above'),
    ('curvature of L gone', BOXES, steps(straight), 'c_T and v; lambda_L =; c2 of L is'),
    ('one box off', 'smallest_reflecting_600_075', scaled('exponent', 1.05), 'one curve'),
    (
        'walls 2 % off',
        *('smallest_reflecting_*', scaled('exponent', 1.02), 'lambda_T is; lambda_L is'),
    ),
    ('walls off at 0.2', 'walls_02', scaled('exponent', 1.05), 'the same is true at density 0.2'),
    ('walls off at 0.8', 'reflecting', scaled('exponent', 1.05), 'the same is true at density 0.8'),
    (
        'one aspect ratio off',
        *('aspect_050_*', scaled('exponent', 1.03), f'{SLOPES}periodic; {SLOPES}reflecting'),
    ),
    (
        'T is higher between walls',
        *('smallest_reflecting_*|reflecting', steps(higher), 'lambda_T is > a guess: T'),
    ),
    ('two exponents below LP(1,0)', 'reflecting', two_below, 'T(1,0) and'),
    ('a zero exponent that does not vanish', 'zeros_mixed', exponents(198, 0.6), '6, 4 or 2'),
    (
        'a and b exchanged',
        *('hydro', phases(pairs_exchanged), 'T excites; dp = C dq; dp of LP modes is'),
    ),
    ('T excites density', 'hydro', answers(T, 'density', 0.3, 'across'), 'T excites'),
    ('C larger on L', 'hydro', answers(LP, 'along', 1.3, 'along'), 'dp = C dq; dp of LP modes is'),
    ('dp behind dq', 'hydro', phases(behind), 'T excites; dp of LP modes is'),
    ('L and P lag the other way', 'hydro', beside(0.04), 'dp of LP modes lags'),
    ('standing waves', 'travelling', phases(standing), 'the L part'),
    ('long intervals 2 % off', 'independent_8_*', faster_runs, 'exponents do'),
    (
        'an interval that loses digits',
        *('interval_2', exponents(300, lambda one: one + 3e-8), 'one trajectory'),
    ),
    ('an interval with other indices', 'interval_1', steps(shifted), 'one trajectory'),
    ('structure along for across', 'structure_*', each('Structure', directions), 'vectors of'),
    ('lines of LP 4 % too fast', 'structure_*', lines(of_lp=1.04), 'the line of LP'),
    ('lines of T that move', 'structure_*', lines(of_t=0.3), 'the line of T'),
    ('widths all alike', 'hydro', widths(alike), 'the vector of; a T mode is'),
    ('widths the other way round', 'hydro', widths(reversed_), 'the vector of; the larger'),
    ('T spread evenly', 'hydro', of_t(1.0), 'a T mode is'),
    (
        'pressures 2 % too large',
        *('density_*', gas(compressibility=1.02, pressure=1.02)),
        f'pressures are; disks collide; v is P / (sqrt(2); {OF_P}',
    ),
    ('collisions counted twice', 'density_*', gas(collision_rate=2.0), 'disks collide'),
    ('v 5 % off at one density', 'density_03', turned(0.95), 'v is P / (sqrt(2)'),
    (
        'v 4 % off in one box',
        *('aspect_075_periodic', turned(1.04), 'v of all boxes is one curve in k, periodic'),
    ),
    (
        'v 4 % off in one box between walls',
        *('aspect_075_walls_t', turned(1.04), 'v of all boxes is one curve in k, between'),
    ),
    ('v 3 % off between walls', WALLS, turned(1.03), 'v goes to the; v is alike'),
    ('v 3 % off in periodic boxes', PERIODIC, turned(1.03), 'v goes to 0.988; v is alike'),
    ('v 5 % off in narrow boxes', 'narrow_*', turned(0.95), 'LP modes turn alike in'),
    ('v off between walls at 0.2', 'walls_02', turned(1.04), 'LP modes turn alike between'),
)
