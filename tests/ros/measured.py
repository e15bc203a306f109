"""Messages -> the numbers in them that are NaN, and those that the .msg files say are: what was not
measured. The two are the same in every message of every run."""

import copy
import io
import math

import numpy as np

from hdlyap import msg
from hdlyap.data import fields, space
from hdlyap.msg import Cost, LpPhase, Mode, RunStatus


def of(message, *names):
    """[names, N]: arrays of a message, or numbers."""
    return np.array([getattr(message, name) for name in names])


def nans(message, path=''):
    """Names of the fields that are not a number: modes[3].weight."""
    found = set()
    for name in message.__slots__:
        found |= _of_value(getattr(message, name), path + name)
    return found


def _of_value(value, path):
    if isinstance(value, float):
        return {path} if math.isnan(value) else set()
    if isinstance(value, (list, tuple)):
        items = (_of_value(item, f'{path}[{k}]') for k, item in enumerate(value))
        return set().union(*items)
    return nans(value, path + '.') if hasattr(value, '__slots__') else set()


def unmeasured(message, path=''):
    """The same as the documents of the messages say it, from what else is in the message."""
    found = set()
    others = OTHERS.get(type(message).__name__, lambda message: ())
    for name in {*by_rule(message), *others(message)}:
        value = getattr(message, name.partition('[')[0])
        many = isinstance(value, (list, tuple)) and '[' not in name
        found |= {f'{path}{name}[{k}]' for k in range(len(value))} if many else {path + name}
    for name, parts in parts_of(message):
        for k, part in enumerate(parts):
            found |= unmeasured(part, f'{path}{name}[{k}].')
    return found


def parts_of(message):
    """(name, messages) of the lists of messages in a message."""
    kinds = zip(message.__slots__, message._slot_types)
    return [(name, getattr(message, name)) for name, kind in kinds if kind.startswith('hdlyap/')]


def by_rule(message, sent='NaN'):
    """Names of the fields for which this is sent, by rules in the .msg."""
    for name, field in fields.of(message).items():
        if field.rule and field.rule.sent == sent:
            value = getattr(message, field.rule.field)
            if (value == _constant(message, field.rule.value)) == field.rule.if_equal:
                yield name


def _constant(message, word):
    try:
        return int(word)
    except ValueError:
        kinds = [type(message), *vars(msg).values()]
        return next(getattr(kind, word) for kind in kinds if hasattr(kind, word))


def as_sent(message):
    """A made-up message as the node sends one with such numbers."""
    sent = copy.copy(message)
    for value, word in ((math.nan, 'NaN'), (-1.0, '-1')):
        for name in by_rule(message, word):
            many = len(getattr(sent, name)) if hasattr(getattr(sent, name), '__len__') else None
            setattr(sent, name, value if many is None else [value] * many)
    for name, parts in parts_of(message):
        setattr(sent, name, [as_sent(part) for part in parts])
    return sent


# ---- what no rule in a .msg says ---------------------------------------------------------------


def _spectrum(message):
    if math.isnan(message.divergence):  # the dynamics does not tell it
        yield from ['divergence', *['exponent_sum'] * (message.pairing_error < 0)]
    if math.isnan(message.kaplan_yorke):
        yield 'kaplan_yorke'
    for k, (cosine, ratio) in enumerate(zip(message.cos_theta, message.dp_dq_ratio)):
        if math.isnan(cosine) and (math.isnan(ratio) or ratio < 1e-140):  # a half vanishes
            yield f'cos_theta[{k}]'
            yield from [f'dp_dq_ratio[{k}]'] if math.isnan(ratio) else []


def _cost(message):
    assert (message.interval_limit == Cost.LIMIT_NONE) == (message.orthonormalisations == 0)
    if message.events_seconds == 0:
        yield 'events_per_second'
    if message.orthonormalisations == 0 or math.isnan(message.error_bound):
        yield 'error_bound'


def _status(message):
    names = ('energy_error', 'energy_error_most', 'energy_error_wanted')
    yield from names if math.isnan(message.energy_error_wanted) else ()  # of hard particles


def _steps(message):
    if math.isnan(message.l_box_error):  # in a circle
        assert message.l_points == 0
        yield from ('l_long_c2', 'l_long_c2_error', 'l_long_c3', 'l_long_c3_error', 'l_box_error')
    for k, step in enumerate(message.steps):
        unrelated = step.kind == Mode.LP and math.isnan(message.l_long_c2)
        if not step.resolved or step.kind == Mode.ZERO or unrelated:
            yield f'steps[{k}].scatter'


def _step(step):
    has_begun = step.omega_error >= 0 or not math.isnan(step.omega)
    if not (step.resolved and step.kind == Mode.LP and has_begun):
        yield 'omega'
    yield from [] if step.resolved else ['gap']


def _phase(phase):
    if phase.tracked_time == 0 and phase.state != LpPhase.TRACKED:
        yield 'phase'


OF_FLOW = ('shear_stress', 'velocity_low', 'velocity_high', 'divergence')  # of walls that shear


def _gas(message):
    yield from [] if message.pressure_z_error >= 0 else ['pressure_z']  # of disks
    yield from ['collision_rate'] if message.temperature > 0 else [
        'temperature',
        'potential_energy',
    ]
    yield from [name for name in OF_FLOW if math.isnan(getattr(message, name))]

    rates = (what + pair for what in ('collision_rate_', 'expected_rate_') for pair in space.PAIRS)
    yield from rates if math.isnan(message.expected_rate_12) else ()  # of one kind
    yield from ['expected_compressibility'] if math.isnan(message.expected_compressibility) else []


def _mode(mode):
    yield from ['second_kind'] if math.isnan(mode.second_kind) else []  # of one kind


def _fluctuations(message):
    for name, errors in (('diffusions', 'std_errors'), ('covariances', 'covariance_errors')):
        for k, error in enumerate(getattr(message, errors)):
            yield from [f'{name}[{k}]'] if error == -1 else []
    steps, times = len(message.steps), len(message.orders)
    for k, step in enumerate(message.steps):
        if len(step.indices) == 1:
            yield from (f'reversals[{(time * steps + k) * steps + k}]' for time in range(times))


OTHERS = dict(
    Spectrum=_spectrum,
    Cost=_cost,
    RunStatus=_status,
    Steps=_steps,
    Step=_step,
    LpPhase=_phase,
    TPhase=_phase,
    Gas=_gas,
    Mode=_mode,
    Fluctuations=_fluctuations,
)


def bits(messages):
    """Of each, without what the clock and the run's name are: NaN is the same as NaN."""
    return [_bits(message) for message in messages]


def _bits(message):
    message, buffer = copy.copy(message), io.BytesIO()
    message.header, message.run_id = type(message.header)(), ''
    message.serialize(buffer)
    return buffer.getvalue()


def check(case, messages):
    """Of a unittest case: each is NaN exactly where it says so; predictions and errors that are not
    known are -1."""
    for message in messages:
        case.assertEqual(nans(message), unmeasured(message), f'in a {type(message).__name__}')
        if isinstance(message, RunStatus):
            case.assertTrue(message.progress == -1 or 0 <= message.progress <= 1)
