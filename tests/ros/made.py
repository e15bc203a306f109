"""Messages of hdlyap_node made up for tests: a run whose modes are known exactly."""

import collections
import itertools
import math
import os
import re

import genpy.dynamic
import numpy as np
import rosbag
import rospy

from made_fields import mode_field
from measured import OF_FLOW, as_sent
from hdlyap.msg import (
    Average,
    Averages,
    Cost,
    Covariant,
    CovariantWeight,
    Fluctuations,
    FluctuationStep,
    Gas,
    GrowthOrder,
    Localization,
    LpPhase,
    LpPhases,
    Parameter,
    RunInfo,
    RunStatus,
    Spectrum,
    Step,
    Steps,
    TPhase,
    TPhases,
)
from hdlyap import parameters, topics  # noqa: F401  which reads parameters as fields
from hdlyap.data import fields, space, waves

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../hdlyap_ros/scripts')
T, LP, ZERO = Step.T, Step.LP, Step.ZERO
CURVES = {T: (1.4, 0.1), LP: (1.5, 0.5)}  # c, c2
ERROR = 0.002  # of the exponents of steps
VELOCITY = 1.6
OF_PAIRS = [what + pair for what in ('collision_rate_', 'expected_rate_') for pair in space.PAIRS]
TOPICS = {message._type: name for name, message in topics.TYPES.items()}


def write(path, messages, node='/hdlyap', mode='w', start=1):
    """A bag with one message a second."""
    with rosbag.Bag(path, mode) as bag:
        for second, message in enumerate(messages, start):
            bag.write(f'{node}/{TOPICS[message._type]}', as_sent(message), rospy.Time(second))


def defined(message, change):
    """The same message under another definition: change makes it of the text of this one. What it
    lacks is left out, what it has on top keeps its default."""
    kinds = genpy.dynamic.generate_dynamic(message._type, change(message._full_text))
    return _copied(message, kinds)


def _copied(message, kinds):
    copy = kinds[message._type]()
    for name in set(copy.__slots__) & set(message.__slots__):
        value = getattr(message, name)
        if isinstance(value, list) and value and getattr(value[0], '_type', None) in kinds:
            value = [_copied(one, kinds) for one in value]
        setattr(copy, name, value)
    return copy


def message_of(kind, fields, /, **usual):
    """What is not among the fields is as usual."""
    return kind(**{**usual, **fields})


# parameters of the node that runs made here have, unless they are given
PARAMETERS = dict(
    scene='made', particles='disks', container='rectangle', number=20, density=0.5, aspect=1.0
)
PARAMETERS.update(aspect_z=1.0, boundary_x='periodic', boundary_y='periodic', boundary_z='')
PARAMETERS.update(shear_b=10.0)
PARAMETERS.update(seed='1', exponents='positive', equilibration=0.0, warmup=0.0, duration=0.0)
PARAMETERS.update(target='', interval='auto', accuracy=0.0, report_interval=0.0)
PARAMETERS.update(phase_interval='auto', fluctuation_time='auto', observables=[], threads=0)
PARAMETERS.update(max_wave_number=0.0, max_mode_number=0, covariant_window=0.0)
PARAMETERS.update(covariant_transient=0.0, covariant_sampling=0.0, covariant_memory=0.0)
PARAMETERS.update(field_indices='steps', field_interval=0.0, wait_for_subscribers=[])
PARAMETERS.update(slow_subscribers='wait', pace=0.0, slow_vectors_rate=0.0, slow_vectors_count=0)
PARAMETERS.update(checkpoint='', checkpoint_interval=0.0, resume='')
MAY_DIFFER = 'scene duration target report_interval threads covariant_memory field_indices '
MAY_DIFFER += 'field_interval wait_for_subscribers slow_subscribers pace slow_vectors_rate '
MAY_DIFFER += 'slow_vectors_count checkpoint checkpoint_interval resume'
KINDS = {int: Parameter.INTEGER, float: Parameter.NUMBER}
KINDS.update({list: Parameter.LIST, str: Parameter.WORD})
NUMBERS = 'interval', 'phase_interval', 'fluctuation_time', 'warmup'


def parameter(name, value, own=False):
    """A Parameter with this value in effect."""
    text = ', '.join(value) if isinstance(value, list) else str(value)
    kind = KINDS[float if name in NUMBERS else type(PARAMETERS.get(name, value))]
    as_before = name not in MAY_DIFFER.split()
    return Parameter(name, kind, text, text, '', as_before, own)


def _own(texts):
    """Parameters of NAME=VALUE."""
    for name, _, text in (one.partition('=') for one in texts):
        numbers = (kind(text) for kind in (int, float) if re.fullmatch(PATTERNS[kind], text))
        yield parameter(name, next(numbers, text), own=True)


PATTERNS = {int: r'-?\d+', float: r'-?[\d.]+(e[+-]?\d+)?'}


def run_info(own=(), **fields):
    """own: NAME=VALUE of the parameters that only these particles have."""
    solid = fields.get('particles') == 'spheres'
    asked = {name: fields.pop(name, usual) for name, usual in PARAMETERS.items()}
    return message_of(
        RunInfo,
        fields,
        run_id='one',
        version='0.1.0',
        parameters=[*(parameter(*one) for one in asked.items()), *_own(own)],
        threads=asked['threads'],
        sites=[0.0],
        kind_numbers=[asked['number']],
        kind_diameters=[1.0],
        kind_masses=[1.0],
        dimension=3 if solid else 2,
        coordinates=3 if solid else 2,
        packing_fraction=asked['density'] * math.pi / (6 if solid else 4),
        box_x=40**0.5,
        box_y=40**0.5,
        zero_exponents=6,
    )


def _set(info, name, value):
    """Parameters are set as fields are."""
    if name == 'own':
        others = [one for one in info.parameters if not one.own]
        info.parameters = [*others, *_own(value)]
    elif name in PARAMETERS and name not in RunInfo.__slots__:
        if name == 'number' and len(info.kind_numbers) < 2:
            info.kind_numbers = [value]
        names = [one.name for one in info.parameters]
        info.parameters[names.index(name)] = parameter(name, value)
    else:
        object.__setattr__(info, name, value)


RunInfo.__setattr__ = _set


def spheres(**fields):
    """Twenty in a box of 8 x 2.5 x 2."""
    solid = dict(particles='spheres', number=20, aspect=0.3125, aspect_z=0.25, box_x=8.0)
    solid.update(box_y=2.5, box_z=2.0, boundary_z='periodic', zero_exponents=8)
    return run_info(**{**solid, **fields})


def spectrum(
    exponents, averaged_time, run_id='one', error=0.01, pairing_error=-1.0, divergence=math.nan
):
    n = len(exponents)
    return Spectrum(
        run_id=run_id,
        sim_time=100 + averaged_time,
        averaged_time=averaged_time,
        collisions=1000,
        lambda_max=exponents[0],
        pairing_error=pairing_error,
        exponent_sum=math.nan if math.isnan(divergence) else sum(exponents),
        exponent_sum_error=error,
        divergence=divergence,
        divergence_error=error if divergence == divergence else -1.0,
        kaplan_yorke=math.nan,
        kaplan_yorke_error=-1.0,
        lambda_max_error=error,
        ks_entropy=sum(e for e in exponents if e > 0),
        ks_entropy_error=error * n if error >= 0 else -1.0,
        first_index=1,
        exponents=exponents,
        std_errors=[error] * n,
        local_exponents=exponents,
        cos_theta=[1.0] * n,
        dp_dq_ratio=[1.0] * n,
        local_time=1.0,  # a sample of its own in each message
    )


def cost(sim_time, run_id='one'):
    return Cost(
        run_id=run_id,
        sim_time=sim_time,
        wall_seconds=sim_time,
        events_seconds=0.1 * sim_time,
        replay_seconds=0.2 * sim_time,
        ortho_seconds=0.55 * sim_time,
        modes_seconds=0.05 * sim_time,
    )


def status(sim_time, run_id='one', **fields):
    return message_of(
        RunStatus, fields, run_id=run_id, sim_time=sim_time, stage=RunStatus.AVERAGING
    )


def wave_number(info, nx, ny, nz=0):
    return float(np.linalg.norm(waves.wave_vector(info, nx, ny, nz)))


def exponent(info, kind, nx, ny, nz=0):
    c, c2 = CURVES[kind]
    k = wave_number(info, nx, ny, nz)
    return c * k + c2 * k * k


def step(info, kind, nx, ny, first, last, nz=0, **fields):
    """A resolved step of its own, whose fields are all found; of LP it turns as its phases do."""
    omega = VELOCITY * wave_number(info, nx, ny, nz) if kind == LP else np.nan
    return message_of(
        Step,
        fields,
        kind=kind,
        nx=nx,
        ny=ny,
        nz=nz,
        wave_number=wave_number(info, nx, ny, nz),
        resolved=True,
        expected=last - first + 1,
        first_index=first,
        last_index=last,
        multiplicity=0.99 * (last - first + 1),
        set=first,
        members=1,
        exponent=exponent(info, kind, nx, ny, nz),
        std_error=ERROR,
        omega=omega,
        omega_error=0.01 * omega if kind == LP else -1.0,
    )


def turn(found, omega, error):
    """The LP steps of these that are resolved."""
    for one in found:
        if one.kind == LP and one.resolved:
            one.omega, one.omega_error = omega, error


def unresolved(info, kind, nx, ny, expected):
    return Step(
        kind=kind,
        nx=nx,
        ny=ny,
        wave_number=wave_number(info, nx, ny),
        expected=expected,
        set=-1,
        std_error=-1.0,
        omega=np.nan,
        omega_error=-1.0,
    )


def zero_modes(first=None):
    """Not carried, or six from an index on."""
    if first is None:
        return Step(kind=ZERO, expected=6, set=-1, std_error=-1.0)
    return Step(
        kind=ZERO,
        expected=6,
        resolved=True,
        first_index=first,
        last_index=first + 5,
        multiplicity=6.0,
        set=first,
        members=1,
        exponent=1e-4,
        std_error=3e-5,
    )


K = 2 * math.pi / math.sqrt(40)  # of T(1,0) in the box of run_info


def long_boxes(letter, c2, error):
    names = 'long_c2', 'long_c2_error', 'long_c3', 'long_c3_error', 'box_error'
    return dict(zip((f'{letter}_{name}' for name in names), (c2, error, 2 * c2, error, 0.002)))


def steps(made, averaged_time=50.0, run_id='one'):
    return Steps(
        run_id=run_id,
        sim_time=100 + averaged_time,
        averaged_time=averaged_time,
        threshold=0.5,
        steps=made,
        t_points=3,
        t_k_min=K,
        t_k_max=2 * K,
        t_prior_share=0.25,
        c_t=1.4,
        c_t_error=0.012,
        c_t_sampling_error=0.004,
        c_t2=0.1,
        c_t2_error=0.034,
        c_t3=0.2,
        c_t3_error=0.05,
        t_misfit=1.25,
        l_points=2,
        l_k_min=K,
        l_k_max=math.sqrt(2) * K,
        l_prior_share=0.5,
        c_l=1.5,
        c_l_error=0.02,
        c_l_sampling_error=0.01,
        c_l2=0.5,
        c_l2_error=0.1,
        c_l3=0.7,
        c_l3_error=0.1,
        l_misfit=-1.0,
        **long_boxes('t', 0.02, 0.01),
        **long_boxes('l', 0.15, 0.03),
        v_phases=8,
        v_k_min=0.99346,
        v_k_max=1.40496,
        v=1.612,
        v_error=0.023,
        v_sampling_error=0.0092,
        v_misfit=2.5,
    )


def covariant_weight(made, count, dq=0.8, dp=0.3, elsewhere=0.02, gram_schmidt=0.9):
    """Of the fields of one step, in its vectors and elsewhere."""
    weight = CovariantWeight(
        kind=made.kind,
        nx=made.nx,
        ny=made.ny,
        wave_number=made.wave_number,
        dimension=made.expected,
        dq=[elsewhere] * count,
        dp=[elsewhere] * count,
        gram_schmidt=[elsewhere] * count,
    )
    for index in range(made.first_index - 1, made.last_index):
        weight.dq[index], weight.dp[index], weight.gram_schmidt[index] = dq, dp, gram_schmidt
    return weight


def covariant(exponents, run_id='one', error=0.01, **fields):
    """Four windows; without angles and weights unless they are given."""
    n = len(exponents)
    return message_of(
        Covariant,
        fields,
        run_id=run_id,
        sim_time=350.0,
        averaged_time=200.0,
        windows=4,
        samples=40,
        seconds=12.5,
        first_index=1,
        exponents=exponents,
        std_errors=[error] * n,
        local_exponents=np.add(exponents, 0.1),
        start_mismatch=[1e-9] * n,
        neighbour_angles=[0.7] * (n - 1),
        least_neighbour_angles=[0.2] * (n - 1),
        violations=[0.25] * (n - 1),
        domination_violations=[0.5] * (n - 1),
        widths=[0.4] * n,
        cos_theta=[0.6] * n,
        centre_start_mismatch=-1.0,
        stable_start_mismatch=-1.0,
        null_angle=-1.0,
        largest_null_angle=-1.0,
    )


def localization(widths, run_id='one', error=0.01, **fields):
    return message_of(
        Localization,
        fields,
        run_id=run_id,
        sim_time=150.0,
        samples=20,
        first_index=1,
        widths=widths,
        std_errors=[error] * len(widths),
        widths_now=np.multiply(widths, 0.9),
    )


def fluctuations(diffusions, steps=(), times=(2.0, 4.0), error=0.01, **fields):
    """steps: (kind, nx, ny, indices). Variances grow with the time, fractions fall."""
    n, count = len(diffusions), len(steps)
    pairs = np.arange(1.0, count**2 + 1).reshape(count, count)
    pairs = list((pairs + pairs.T).ravel() / 100)
    orders = [
        GrowthOrder(
            time=time,
            count=int(1000 / time),
            violations=[0.4 / time] * (n - 1),
            domination_violations=[0.8 / time] * (n - 1),
        )
        for time in times
    ]
    return message_of(
        Fluctuations,
        fields,
        run_id='one',
        sim_time=150.0,
        averaged_time=50.0,
        first_index=1,
        diffusions=diffusions,
        std_errors=[error] * n,
        steps=[
            FluctuationStep(kind=kind, nx=nx, ny=ny, indices=indices)
            for kind, nx, ny, indices in steps
        ],
        covariances=pairs,
        covariance_errors=[error] * len(pairs),
        orders=orders,
        variances=[time * one for time in times for one in diffusions],
        reversals=[one / time for time in times for one in pairs],
    )


def gas(averaged_time=50.0, run_id='one', error=0.01, **fields):
    """Of density 0.5: Z = p / 0.5."""
    return message_of(
        Gas,
        fields,
        run_id=run_id,
        sim_time=100 + averaged_time,
        averaged_time=averaged_time,
        collision_rate=3.25,
        collision_rate_error=2 * error if error >= 0 else -1.0,
        pressure=1.25,
        pressure_error=error,
        pressure_x=1.5,
        pressure_x_error=error,
        pressure_y=1.0,
        pressure_y_error=error,
        compressibility=2.5,
        compressibility_error=2 * error if error >= 0 else -1.0,
        temperature=np.nan,
        temperature_error=-1.0,
        potential_energy=np.nan,
        potential_energy_error=-1.0,
        expected_compressibility=2.5,
        **dict.fromkeys(OF_PAIRS, np.nan),
        **{name + '_error': -1.0 for name in OF_PAIRS if name.startswith('c')},
        **{name: np.nan for name in OF_FLOW},
        **{name + '_error': -1.0 for name in OF_FLOW},
    )


def shear_gas(averaged_time=50.0, error=0.01, **fields):
    """Of disks between walls that shear."""
    numbers = dict(zip(OF_FLOW, (0.0625, -0.25, 0.375, -0.125)))
    errors = {name + '_error': error for name in OF_FLOW}
    return gas(averaged_time, error=error, **{**numbers, **errors, **fields})


def soft_gas(averaged_time=50.0, error=0.01, **fields):
    """Of density 0.5 and two coordinates, half of the energy 1 kinetic."""
    unknown = dict(collision_rate=np.nan, collision_rate_error=-1.0, compressibility=5.0)
    errors = dict.fromkeys(('temperature_error', 'potential_energy_error'), error)
    made = dict(unknown, temperature=0.625, potential_energy=0.5, **errors)
    return gas(averaged_time, error=error, **{**made, **fields})


def averages(averaged_time=50.0, run_id='one', error=0.01, **means):
    """Of a program's own particles; means by their names."""
    means = means or dict(kinetic=1.25, stretch=0.5)
    return Averages(
        run_id=run_id,
        sim_time=100 + averaged_time,
        averaged_time=averaged_time,
        averages=[Average(name, 'energy', mean, error) for name, mean in means.items()],
    )


def lp_phases(info, made, sim_time, modulations=(0, 1), began=0.0, rng=None, run_id='one'):
    """Vectors and pairs of every resolved LP step turn by v k, half of them backwards."""
    phases = []
    for number, one in enumerate(made):
        if one.kind != LP:
            continue
        omega = VELOCITY * one.wave_number
        vectors = range(one.first_index, one.last_index + 1) if one.resolved else (0,)
        for index, bits in itertools.product(vectors, modulations):
            sign = 1 if index % 2 else -1
            noise = 0.1 * rng.normal() if rng else 0.0
            turned = sign * omega * (sim_time - began) + noise
            phases.append(
                LpPhase(
                    step=number,
                    nx=one.nx,
                    ny=one.ny,
                    nz=one.nz,
                    wave_number=one.wave_number,
                    modulation=bits,
                    index=index,
                    state=LpPhase.TRACKED if one.resolved else LpPhase.UNRESOLVED,
                    a=np.cos(turned),
                    b=np.sin(turned),
                    phase=turned,
                    omega=sign * omega,
                    omega_error=0.01 * omega,
                    velocity=VELOCITY,
                    tracked_time=sim_time - began,
                )
            )
    return LpPhases(run_id=run_id, sim_time=sim_time, sample_time=sim_time, phases=phases)


def t_phases(made, sim_time, began=0.0, run_id='one'):
    """Vectors of every T step stand still, one here and one a quarter of the wave further."""
    phases = [
        TPhase(
            step=number,
            nx=one.nx,
            ny=one.ny,
            modulation=0,
            index=index,
            state=LpPhase.TRACKED,
            a=index % 2,
            b=1 - index % 2,
            phase=0.5 * np.pi * (1 - index % 2),
            omega=0.0,
            omega_error=1e-3,
            diffusion=2e-4 * number,
            diffusion_error=1e-4 if number else -1.0,
            tracked_time=sim_time - began,
        )
        for number, one in enumerate(made)
        if one.kind == T
        for index in range(one.first_index, one.last_index + 1)
    ]
    return TPhases(run_id=run_id, sim_time=sim_time, sample_time=sim_time, phases=phases)


def others(messages, info):
    """One message of each topic that has none among these, by the shapes of its .msg: numbers that
    are all distinct."""
    found = []
    there, sizes = {type(one) for one in messages}, collections.defaultdict(lambda: 2)
    sizes.update(particle=info.number, vector=info.vectors)
    fractions, counts = itertools.count(1 / 1024, 1 / 1024), itertools.count(1)
    for kind in set(topics.RECORDED.values()) - there:
        made, described = kind(run_id='one', sim_time=150.0, first_index=1), fields.of(kind)
        for slot, of in zip(kind.__slots__[3:], kind._slot_types[3:]):
            numbers = fractions if of.startswith('float64') else counts
            size = math.prod(sizes[one] for one in described[slot].shape)
            some = [next(numbers) for _ in range(size)]
            setattr(made, slot, some if of.endswith('[]') else some[0])
        found.append(made)
    return found


def paper_info():
    return run_info(
        scene='paper_periodic', number=780, density=0.8, aspect=0.867, box_x=33.535, box_y=29.074
    )


def small_run():
    """Every kind of message, of 20 disks: 37 positive exponents, the last twelve in steps."""
    info = run_info()
    found = [
        step(info, T, 1, 0, 36, 37),
        step(info, LP, 1, 0, 32, 35),
        step(info, T, 0, 1, 30, 31),
        step(info, LP, 0, 1, 26, 29),
    ]
    exponents = np.linspace(9, 3, 37)
    for one in found:
        exponents[one.first_index - 1 : one.last_index] = one.exponent
    rng = np.random.default_rng(3)
    course = [
        message
        for t in range(1, 20)
        for message in (
            spectrum(exponents, t),
            steps([*found, zero_modes()], t),
            status(100 + t),
            cost(100 + t),
            lp_phases(info, found, 100 + t, began=100, rng=rng),
            t_phases(found, 100 + t, began=100),
        )
    ]
    fields = [mode_field(info, one, modulations=(0, 1) if one.nx else (0, 2)) for one in found]
    return [info, *course, *fields]
