"""Messages -> the numbers in them that are NaN, and those that the .msg files say are: what was not
measured. The two are the same in every message of every run."""

import copy
import io
import math

import numpy as np

from hdlyap.msg import Cost, LpPhase, Mode, RunStatus

OF_STEPS = ('multiplicity', 'exponent', 'scatter', 'set_time', 'own_part', 'gap')
OF_RESPONSES = ('density', 'along', 'across', 'across_second', 'energy')
OF_LP = ('weight_l', 'weight_p')


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


def unmeasured(message):
    """The same as the documents of the messages say it, from what else is in the message."""
    return set(RULES.get(type(message).__name__, lambda message: ())(message))


def _spectrum(message):
    if message.local_time == 0:
        for k in range(len(message.local_exponents)):
            yield f'local_exponents[{k}]'
    for k, (cosine, ratio) in enumerate(zip(message.cos_theta, message.dp_dq_ratio)):
        if math.isnan(cosine) and (math.isnan(ratio) or ratio < 1e-140):  # a half vanishes
            yield f'cos_theta[{k}]'
            yield from [f'dp_dq_ratio[{k}]'] if math.isnan(ratio) else []


def _cost(message):
    if message.orthonormalisations == 0:
        yield from ('interval', 'condition', 'orthogonality_defect')
    assert (message.interval_limit == Cost.LIMIT_NONE) == (message.orthonormalisations == 0)
    if message.events_seconds == 0:
        yield 'events_per_second'
    if message.orthonormalisations == 0 or math.isnan(message.error_bound):
        yield 'error_bound'


def _status(message):
    names = ('energy_error', 'energy_error_most', 'energy_error_wanted')
    yield from names if math.isnan(message.energy_error_wanted) else ()  # of hard particles


def _modes(message):
    for k, mode in enumerate(message.modes):
        names = ('wave_number', 'weight', 'weight_now') if mode.kind == Mode.NONE else ()
        for name in names + (() if mode.kind == Mode.LP else OF_LP):
            yield f'modes[{k}].{name}'


def _steps(message):
    for k, step in enumerate(message.steps):
        alone = ('gap',) if step.sharing == step.SHARING_ALONE else ()
        unrelated = step.kind == Mode.LP and math.isnan(message.l_long_c2)  # in a circle
        alone += ('scatter',) if step.kind == Mode.ZERO or unrelated else ()
        for name in alone if step.resolved else OF_STEPS:
            yield f'steps[{k}].{name}'
        has_begun = step.omega_error >= 0 or not math.isnan(step.omega)
        if not (step.resolved and step.kind == Mode.LP and has_begun):
            yield f'steps[{k}].omega'
    for letter, points in (('t', message.t_points), ('l', message.l_points)):
        names = [
            f'c_{letter}',
            f'c_{letter}2',
            f'c_{letter}3',
            f'{letter}_k_min',
            f'{letter}_k_max',
        ]
        yield from names if points < 1 else []
    if math.isnan(message.l_box_error):
        assert message.l_points == 0
        yield from ('l_long_c2', 'l_long_c2_error', 'l_long_c3', 'l_long_c3_error', 'l_box_error')
    if message.v_phases == 0:
        yield from ('v', 'v_k_min', 'v_k_max')


def _phases(message):
    for k, phase in enumerate(message.phases):
        unknown = ['a', 'b'] if phase.state == LpPhase.UNRESOLVED else []
        if phase.tracked_time == 0:
            unknown += ['omega', 'velocity']
            unknown += [] if phase.state == LpPhase.TRACKED else ['phase']
        for name in unknown:
            yield f'phases[{k}].{name}'


def _t_phases(message):
    for k, phase in enumerate(message.phases):
        unknown = ['a', 'b'] if phase.state == LpPhase.UNRESOLVED else []
        if phase.tracked_time == 0:
            unknown += ['omega']
            unknown += [] if phase.state == LpPhase.TRACKED else ['phase']
        unknown += ['diffusion'] if phase.diffusion_error == -1 else []
        for name in unknown:
            yield f'phases[{k}].{name}'


def _hydro(message):
    for k, response in enumerate(message.responses):
        if response.index == 0:
            for name in OF_RESPONSES:
                yield f'responses[{k}].{name}'


def _gas(message):
    yield from [] if message.pressure_z_error >= 0 else ['pressure_z']  # of disks
    yield from ['collision_rate'] if message.temperature > 0 else [
        'temperature',
        'potential_energy',
    ]


def _fluctuations(message):
    for name, errors in (('diffusions', 'std_errors'), ('covariances', 'covariance_errors')):
        for k, error in enumerate(getattr(message, errors)):
            yield from [f'{name}[{k}]'] if error == -1 else []
    steps, times = len(message.steps), len(message.orders)
    for k, step in enumerate(message.steps):
        if len(step.indices) == 1:
            yield from (f'reversals[{(time * steps + k) * steps + k}]' for time in range(times))


def _field(message):
    if message.kind == Mode.NONE:
        yield 'wave_number'
    if message.pairs == 0:
        yield 'rotation_distance'


RULES = dict(
    Spectrum=_spectrum,
    Cost=_cost,
    RunStatus=_status,
    Modes=_modes,
    Steps=_steps,
    LpPhases=_phases,
    TPhases=_t_phases,
    Hydro=_hydro,
    Gas=_gas,
    Fluctuations=_fluctuations,
    ModeField=_field,
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
