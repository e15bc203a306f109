"""The made world with what real runs have: steps that share vectors or were not found, errors that
are not known, phases that begin anew, reports that are missing."""

import numpy as np

from made import LP, T
from hdlyap.msg import LpPhase

from reproduced import Run, interval, messages_of, structure, travelling


def of(messages, kind):
    return [one for one in messages if one._type == f'hdlyap/{kind}']


def without(messages, *kinds):
    return [one for one in messages if one._type.partition('/')[2] not in kinds]


def step(messages, kind, nx, ny):
    (last,) = of(messages, 'Steps')
    return next(one for one in last.steps if (one.kind, one.nx, one.ny) == (kind, nx, ny))


def unfound(*which):
    """This step is not resolved."""

    def damage(messages):
        one = step(messages, *which)
        one.resolved, one.set, one.std_error = False, -1, -1.0
        return messages

    return damage


def shared(*which):
    """Of two steps."""

    def damage(messages):
        one, other = (step(messages, *each) for each in which)
        one.set = other.set = min(one.set, other.set)
        one.members = other.members = 2
        one.first_index = other.first_index = min(one.first_index, other.first_index)
        one.last_index = other.last_index = max(one.last_index, other.last_index)
        return messages

    return damage


def unknown(kind, *names):
    """Errors of these messages."""

    def damage(messages):
        for message in of(messages, kind):
            for name in names:
                value = getattr(message, name)
                setattr(message, name, -1.0 if np.isscalar(value) else np.full(len(value), -1.0))
        return messages

    return damage


def lacking(*kinds):
    return lambda messages: without(messages, *kinds)


def untracked(messages):
    """One vector of each step for a while, and for a while none; then phases begin anew."""
    told = of(messages, 'LpPhases')
    for place, message in enumerate(told):
        part = place / len(told)
        for number, phase in enumerate(message.phases):
            if 0.3 < part < 0.4 and (phase.index % 2 or part > 0.38):
                phase.state, phase.a, phase.b = LpPhase.WEAK, 0.1, -0.1
            elif part >= 0.6:
                phase.tracked_time = message.sim_time - told[int(0.6 * len(told))].sim_time
                phase.phase -= 2 * np.pi
    return messages


def broken(messages):
    """Stairs: a vector in between, one too many, and a gap in a step."""
    (spectrum,) = of(messages, 'Spectrum')[-1:]
    exponents = spectrum.exponents = spectrum.local_exponents = np.array(spectrum.exponents)
    first, second = step(messages, LP, 1, 0), step(messages, T, 1, 1)
    exponents[first.first_index - 1] *= 1.06
    exponents[second.first_index - 2] = exponents[second.first_index - 1]
    return messages


def uncertain(messages):
    """Exponents of LP(1,0), which was not found, differ by more than a hundredth, less than their
    errors."""
    one = step(messages, LP, 1, 0)
    inside = slice(one.first_index - 1, one.last_index)
    for message in of(messages, 'Spectrum'):
        message.exponents, message.std_errors = map(
            np.array, (message.exponents, message.std_errors)
        )
        message.exponents[inside] *= 1.01, 1.0, 0.98, 1.0
        message.std_errors[inside] = 0.01 * message.exponents[inside]
    return unfound(LP, 1, 0)(messages)


def short_samples(messages):
    for message in of(messages, 'Spectrum')[::3]:
        message.local_time = 0.0
    return messages


def too_few(messages):
    told = of(messages, 'Spectrum')[:10]
    return messages[:1] + told + without(messages[1:], 'Spectrum')


def moving(messages):
    """T modes, and fields without pairs."""
    for phase in of(messages, 'TPhases')[-1].phases:
        phase.omega = 0.02 if phase.nx else -0.02
        phase.omega_error = 1e-3 if phase.ny else -1.0
    return shared((T, 1, 1), (LP, 0, 1))([one for one in messages if getattr(one, 'pairs', 1)])


def one_off(messages):
    """A vector in one report, all in the errors, and an exponent."""
    message = of(messages, 'Spectrum')[7]
    message.cos_theta[1200], message.dp_dq_ratio[1200] = 0.1, 3 * message.dp_dq_ratio[1200]
    last = of(messages, 'Spectrum')[-1]
    last.exponents = np.array(last.exponents)
    last.exponents[1555] += 0.1
    return messages


def disagreeing(messages):
    """Responses of P at one wave; widths whose errors are not known."""
    for message in of(messages, 'Hydro'):
        for one in message.responses:
            if one.ny and one.kind == LP:
                one.density += 0.4
            one.across += 0.7 * np.cos(one.index + message.sim_time) * (one.kind == LP)
    return unknown('Localization', 'std_errors')(messages)


def late(messages):
    """No report at the time of the others; a step of other indices."""
    step(messages, T, 1, 0).first_index -= 1
    return messages


def alone(messages):
    """One step is in no other run."""
    (last,) = of(messages, 'Steps')
    last.steps = last.steps[1:]
    return messages


DAMAGES = {
    'periodic': lambda messages: moving(unknown('Spectrum', 'std_errors')(untracked(messages))),
    'halves': one_off,
    'reflecting': untracked,
    'hydro': disagreeing,
    'mixed': unknown('Spectrum', 'std_errors'),
    'square': broken,
    'narrow_periodic': lacking('LpPhases'),
    'narrow_reflecting': lacking('Steps', 'Spectrum'),
    'zeros_periodic': lacking('Steps'),
    'zeros_mixed': lambda messages: [setattr(messages[0], 'warmup', 0.0), messages][1],
    'zeros_reflecting': lacking('Spectrum'),
    'density_01': uncertain,
    'density_02': unfound(T, 1, 0),
    'density_03': shared((T, 1, 0), (LP, 1, 0)),
    'density_04': lambda messages: shared((T, 0, 1), (LP, 1, 0))(
        unknown('Gas', 'pressure_error')(messages)
    ),
    'density_05': lacking('Gas', 'LpPhases'),
    'density_06': lacking('Steps'),
    'density_07': unknown('Gas', 'pressure_error', 'collision_rate_error'),
    'smallest_periodic_400_05': unfound(T, 1, 0),
    'smallest_periodic_600_075': shared((LP, 0, 1), (LP, 1, 0)),
    'smallest_reflecting_400_1': unfound(LP, 1, 0),
    'smallest_reflecting_780_05': lacking('Steps', 'LpPhases'),
    'walls_02': unfound(LP, 1, 0),
    'aspect_025_periodic': short_samples,
    'aspect_050_periodic': too_few,
    'aspect_075_periodic': shared((T, 1, 0), (LP, 1, 0)),
    'aspect_100_walls_t': lacking('Steps'),
    'aspect_050_walls_lp': unknown('Spectrum', 'std_errors'),
    'interval_0_5': late,
    'interval_1': alone,
    'independent_8_2': unknown('Spectrum', 'std_errors', 'ks_entropy_error'),
    'independent_0_5_3': lacking('Steps'),
}
# made in another way
OTHERS = {
    'structure_periodic': lambda: structure(Run('structure_periodic'), reports=70),
    'structure_reflecting': lambda: shared((LP, 1, 0), (LP, 1, 1))(
        messages_of('structure_reflecting')
    ),
    'interval_8': lambda: interval(Run('interval_8'), off=5e-8),
    'travelling': lambda: untracked(travelling(Run('travelling'))),
}


def messages(name):
    if name in OTHERS:
        return OTHERS[name]()
    return DAMAGES.get(name, lambda told: told)(messages_of(name))
