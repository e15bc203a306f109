"""A made world of the reproduction: a bag in memory for each run of runs.yaml, whose modes are
those of the paper and of doc/findings.md, but for noise that its errors state."""

import functools
import os
import sys
import zlib
from math import sqrt

import numpy as np
import yaml

import made
import made_fields
import test_structure
from made import LP, T
from hdlyap.msg import Hydro, HydroMode, LpPhase, LpPhases, RunStatus
from hdlyap.data import waves
from hdlyap.plots import equation, paper

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..')
STUDY = os.path.join(ROOT, 'doc/reproduction')
sys.path.append(STUDY)

from remembered import Bag  # noqa: E402
from study import pressure, table  # noqa: E402

PARTS, FRONT = table.read()
NODES = ((1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (2, 1), (1, 2), (2, 2))
KINDS = {T: 'T', LP: 'LP'}
SLOPES = {T: paper.slope_t, LP: paper.slope_l}
RELATIVE = 8e-4  # errors of exponents
START, FALL = 0.9895, 0.02  # v over that of the pressure is START - FALL k at density 0.4
TREMBLE = 0.012  # of a phase, from a report to the next [rad]
LARGEST_K = 0.45  # of a wave that is followed
SWAY = 0.03
STRENGTH = 0.95  # a^2 + b^2
# of unit T, L and P fields: density, along, across, energy
ANSWERS = {'T': (0.0, 0.0, -0.7, 0.0), 'L': (0.8, 0.51, 0.0, None), 'P': (0.0, None, 0.0, 1.45)}
SYMMETRIC = -0.04  # of C beside its diagonal


@functools.lru_cache(None)
def _read(*names):
    with open(os.path.join(ROOT, *names)) as file:
        return yaml.safe_load(file)


def plan():
    """{run: what is asked of it}, of the runs that the study needs."""
    return _read('doc/reproduction/runs.yaml')


# ---- what all runs have --------------------------------------------------------------------------


def box(disks, density, aspect, ends=('periodic', 'periodic'), **fields):
    box_x = sqrt(disks / (density * aspect))
    about = dict(number=disks, density=density, aspect=aspect, accuracy=1e-8, **fields)
    about.update(boundary_x=ends[0], boundary_y=ends[1], box_x=box_x, box_y=aspect * box_x)
    return made.run_info(zero_exponents=2 + 2 * ends.count('periodic'), **about)


def info_of(name):
    asked = plan()[name]
    bases = 'paper_periodic', asked['base']
    scene = {}
    for more in (*(_read(f'launch/scenes/{base}.yaml') for base in bases), asked, asked['full']):
        scene.update(more)
    shape = (scene[one] for one in ('number', 'density', 'aspect'))
    times = {one: scene[one] for one in ('equilibration', 'warmup')}
    interval = 0.0 if scene['interval'] == 'auto' else scene['interval']
    return box(*shape, (scene['boundary_x'], scene['boundary_y']), interval=interval, **times)


def count_of(info, kind, nodes):
    """The paper's table: how many exponents a step has."""
    count = 1 if kind == T else 2
    for n, end, box in zip(nodes, (info.boundary_x, info.boundary_y), (info.box_x, info.box_y)):
        of_walls = int(kind == LP or n > 0)
        count *= (2 if n else 1) if end == 'periodic' else of_walls
        count *= not (n and box < 2)
    return count


def truth(info, kind, k):
    """The exponent: of the curves at density 0.4, c k elsewhere."""
    if abs(info.density - 0.4) < 1e-9:
        curve = paper.CURVES[KINDS[kind]]
        return curve.c * k + curve.c2 * k * k
    # so that v is nearly linear in c_L
    steeper = 1.015 if kind == LP and info.density > 0.75 else 1.0
    return steeper * SLOPES[kind](info.density) * k


def velocity(info, nodes):
    of_pressure = pressure.velocity(info, *nodes)
    fall = FALL if info.density < 0.45 else 0.1 * FALL  # elsewhere a tenth
    return (START - fall * made.wave_number(info, *nodes)) * of_pressure


class Run:
    """Info, steps and spectrum of a run; its own random numbers."""

    def __init__(self, name, waves_kept=10):
        self.name, self.info = name, info_of(name)
        self.rng = np.random.default_rng(zlib.crc32(name.encode()))
        self.end = (4 * self.info.number - self.info.zero_exponents) // 2
        self.steps = []
        found = [
            (truth(self.info, kind, made.wave_number(self.info, *nodes)), kind, nodes)
            for kind in (T, LP)
            for nodes in NODES
            if count_of(self.info, kind, nodes)
        ]
        last = self.end
        for value in sorted({round(one[0], 9) for one in found})[:waves_kept]:
            alike = [one[1:] for one in found if round(one[0], 9) == value]
            last = self._add(value, alike, last)
        self.exponents, self.errors = self._spectrum()

    def _add(self, value, alike, last):
        """Steps of one exponent have one set; the index before it."""
        first = last + 1 - sum(count_of(self.info, *one) for one in alike)
        value, error = value * (1 + RELATIVE * self.rng.normal()), RELATIVE * value
        for place, (kind, nodes) in enumerate(alike):
            count = count_of(self.info, kind, nodes)
            numbers = dict(exponent=value, std_error=(1 + 0.1 * place) * error)
            numbers.update(members=len(alike), expected=count)
            step = made.step(self.info, kind, *nodes, first, last, **numbers)
            step.multiplicity = 0.97 * count
            if kind == LP:
                step.omega = velocity(self.info, nodes) * step.wave_number
                step.omega_error = 2e-3 * step.omega
            self.steps.append(step)
        return first - 1

    def _spectrum(self):
        top = max(one.exponent for one in self.steps)
        exponents = np.linspace(8 * top, 1.2 * top, self.end)
        for one in self.steps:
            many = slice(one.first_index - 1, one.last_index)
            noise = self.rng.normal(size=one.last_index + 1 - one.first_index)
            exponents[many] = one.exponent * (1 + RELATIVE * (noise - noise.mean()))
        return exponents, RELATIVE * exponents * self.rng.uniform(0.9, 1.1, self.end)

    def step(self, kind, *nodes):
        return next(one for one in self.steps if (one.kind, one.nx, one.ny) == (kind, *nodes))

    # ---- messages --------------------------------------------------------------------------------

    def spectrum(self, time, **fields):
        message = made.spectrum(self.exponents, time, pairing_error=1e-3)
        message.std_errors, message.ks_entropy_error = self.errors, 3e-4 * message.ks_entropy
        message.local_exponents = self.exponents
        for name, value in fields.items():
            setattr(message, name, value)
        return message

    def last(self, time=200.0):
        message = made.steps(
            [*self.steps, made.unresolved(self.info, LP, 3, 3, 8), made.zero_modes()], time
        )
        known = [one for one in self.steps if one.kind == LP]
        v = [one.omega / one.wave_number for one in known]
        message.v = float(np.mean(v)) if known else np.nan
        message.v_error = 2e-3 * message.v
        return message

    def fluctuating(self, samples=48):
        """Local exponents whose variance times t goes as 1 / N; samples of two lengths."""
        spread = (0.2 + self.exponents / self.exponents[0]) / self.info.number
        total = 0.0
        for number in range(samples):
            time = (5.0 if number < samples // 2 else 10.0) * self.rng.uniform(0.9, 1.1)
            noise = np.sqrt(spread / time) * self.rng.normal(size=self.end)
            total += time
            yield self.spectrum(total, local_time=time, local_exponents=self.exponents + noise)

    def turning(self, times, vectors=1):
        """LpPhases of the waves that are followed; all of a step tremble together."""
        followed = []
        for number, step in enumerate(self.steps):
            if step.kind == LP and step.wave_number < LARGEST_K:
                bits = waves.modulations(self.info, step.nx, step.ny)
                trembling = TREMBLE * np.cumsum(self.rng.normal(size=len(times)))
                shape = vectors + step.ny, len(bits)  # more of them along y
                phases = np.exp(2j * np.pi * self.rng.uniform(size=shape))
                turned = step.omega * times + trembling
                followed.append((number, step, turned, sqrt(STRENGTH / len(bits)) * phases))
        for row, t in enumerate(times):
            phases = [
                phase
                for number, step, turned, amplitudes in followed
                for phase in self._phases(number, step, t, turned[row], amplitudes)
            ]
            yield LpPhases(run_id='one', sim_time=t, sample_time=t, phases=phases)

    def _phases(self, number, step, t, turned, amplitudes):
        bits = waves.modulations(self.info, step.nx, step.ny)
        for vector, row in enumerate(amplitudes):
            for pair, (one, amplitude) in enumerate(zip(bits, row)):
                now = 3.0 * vector + 1.3 * pair  # sizes and phases sway
                phase = np.angle(amplitude) + turned + SWAY * np.sin(0.4 * t + now)
                z = abs(amplitude) * (1 + SWAY * np.cos(0.3 * t + now)) * np.exp(1j * phase)
                about = dict(step=number, nx=step.nx, ny=step.ny, wave_number=step.wave_number)
                yield LpPhase(
                    **about,
                    modulation=one,
                    index=step.first_index + vector,
                    state=LpPhase.TRACKED,
                    a=z.real,
                    b=z.imag,
                    phase=phase,
                    omega=step.omega,
                    omega_error=step.omega_error,
                    velocity=step.omega / step.wave_number,
                    tracked_time=t,
                )


# ---- runs ----------------------------------------------------------------------------------------


def plain(run):
    """Steps, spectra that fluctuate, phases, and the gas of the eight densities."""
    told = [run.info, *run.fluctuating(), run.last()]
    told += run.turning(np.linspace(3.0, 240.0, 80))
    return told + ([gas(run)] if run.name.startswith('density') else [])


def gas(run):
    z = float(equation.compressibility(run.info.density)) * (1 + 1e-3 * run.rng.normal())
    rate = float(equation.collision_rate(z)) * (1 + 1e-3 * run.rng.normal())
    numbers = dict(compressibility=z, pressure=z * run.info.density, collision_rate=rate)
    errors = dict(pressure_error=1e-3 * z * run.info.density, collision_rate_error=1.5e-3 * rate)
    return made.gas(**numbers, **errors)


def periodic(run):
    """Fields of the steps that the paper shows, phases of LP and of T."""
    times = np.linspace(100.0, 298.0, 100)
    told = [run.info, run.spectrum(200.0), run.last(), *run.turning(times, vectors=4)]
    standing = [made.t_phases(run.steps, 100.0 + t, began=100.0) for t in range(1, 5)]
    for phase in standing[-1].phases:
        phase.omega, phase.omega_error = 3e-4, 4e-4 * (1 + phase.nx)
    shown = [(kind, *nodes) for nodes in NODES[:3] for kind in (T, LP)]
    times = 110.0, 130.0, 150.0
    return told + standing + [_field(run, run.step(*one), t) for t in times for one in shown]


def _field(run, step, time):
    """Its noise goes with the time."""
    found = waves.modulations(run.info, step.nx, step.ny, transverse=step.kind == T)
    noise = 0.3 + 0.02 * np.sin(time)
    one = made_fields.mode_field(
        run.info, step, sim_time=time, modulations=tuple(found), noise=noise
    )
    one.rotation_distance = 0.1 + 0.01 * np.cos(time)
    one.residual_l = [0.1 + 0.02 * n for n in range(one.pairs)]
    one.residual_p = [0.2 + 0.02 * n for n in range(one.pairs)]
    for name in ('p_over_px', 'p_over_py') if one.pairs else ():
        over = getattr(one, name) * (1 + 0.01 * run.rng.normal())
        setattr(one, name, over + 0.1 * run.rng.normal(size=len(over)))
    return one


def reflecting(run):
    """A field every half of 3.20, of one vector of either wave."""
    times = np.arange(100.0, 160.0, 0.4)
    told = [run.info, run.spectrum(200.0), run.last(), *run.turning(times, vectors=2)]
    shown = [run.step(LP, *nodes) for nodes in ((1, 0), (1, 1))]
    fields = dict(modulations=(0,), noise=0.1)
    return told + [
        made_fields.mode_field(run.info, one, sim_time=t, index=one.first_index, **fields)
        for t in np.arange(101.6, 130, 1.6)
        for one in shown
    ]


def travelling(run):
    times = np.arange(100.0, 140.0, 0.2)
    return [run.info, run.spectrum(40.0), run.last(), *run.turning(times, vectors=4)]


def halves(run):
    """All 4N vectors, which the symmetry J has in pairs: C = |dp| / |dq|, and the cosines."""
    count, half = 4 * run.info.number, 2 * run.info.number
    zeros = run.info.zero_exponents // 2
    shrinking = 1e-3 / np.arange(1, zeros + 1)
    exponents = np.concatenate([run.exponents, shrinking, -shrinking[::-1], -run.exponents[::-1]])
    off = np.zeros(count)  # of pairs: none of their sum
    off[: run.end] = RELATIVE * run.exponents * run.rng.normal(size=run.end)
    off[: run.end] -= off[: run.end].mean()
    told = [run.info]
    for report in range(20):
        cos = 1 - np.linspace(0.2, 0.0035, half) * (1 + 0.01 * run.rng.normal(size=half))
        ratio = np.geomspace(8, 0.5, half) * (1 + 0.01 * run.rng.normal(size=half))
        order = np.arange(half)  # some that have not settled: of a conjugate's neighbour
        for one in run.rng.choice(half // 2 - zeros, 20, replace=False):
            order[2 * one : 2 * one + 2] = 2 * one + 1, 2 * one
        message = made.spectrum(exponents + off, 2.0 * report, pairing_error=2e-3)
        message.std_errors = RELATIVE * np.maximum(np.abs(exponents), 1e-3)
        message.cos_theta = np.concatenate([cos, -cos[order][::-1]])
        message.dp_dq_ratio = np.concatenate([ratio, 1 / ratio[order][::-1]])
        told.append(message)
    return told + [run.last()]


def hydro(run):
    """Two T and four LP vectors of each wave answer as ANSWERS says, and with noise."""
    times = 2.0 * np.arange(1, 65)
    told = [run.info, run.spectrum(128.0), run.last()]
    for t in times:
        responses, phases = [], []
        for nodes in ((1, 0), (0, 1)):
            k, bits = made.wave_number(run.info, *nodes), waves.modulations(run.info, *nodes)
            answers = {mode: np.array(values, dtype=float) for mode, values in ANSWERS.items()}
            answers['L'][3] = 0.8 * (2 * k + sqrt(8) * SYMMETRIC)
            answers['P'][1] = 0.8 * (SYMMETRIC - k / sqrt(2))
            responses += _of_t(run, nodes, bits, answers)
            more, known = _of_lp(run, nodes, bits, answers)
            responses, phases = responses + more, phases + known
        told += [
            Hydro(run_id='one', sim_time=t, responses=responses),
            LpPhases(run_id='one', sim_time=t, sample_time=t, phases=phases),
        ]
    widths = 0.62 - 0.52 * np.exp(-np.arange(run.end) / 30)
    for name, width in ((T, 2 / np.e), (LP, 0.65)):
        step = run.step(name, 1, 0)
        widths[step.first_index - 1 : step.last_index] = width + 0.002 * np.arange(step.expected)
    told.append(made.localization(widths, error=0.004))
    return told


def _answer(run, kind, nodes, bits, index, values):
    values = values + 0.004 * run.rng.normal(size=4)
    names = 'density', 'along', 'across', 'energy'
    about = dict(step=0, index=index, kind=kind, nx=nodes[0], ny=nodes[1], modulation=bits)
    return HydroMode(**about, **dict(zip(names, values)))


def _of_t(run, nodes, bits, answers):
    angle = run.rng.uniform(0, 2 * np.pi)
    rows = (np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))
    return [
        _answer(run, T, nodes, one, 40 + vector, row[pair] * answers['T'])
        for vector, row in enumerate(rows)
        for pair, one in enumerate(bits)
    ]


def _of_lp(run, nodes, bits, answers):
    responses, phases = [], []
    for vector in range(4):
        for one in bits:
            a, b = run.rng.normal(size=2) / 2
            values = a * answers['L'] + b * answers['P']
            responses.append(_answer(run, LP, nodes, one, 30 + vector, values))
            about = dict(nx=nodes[0], ny=nodes[1], modulation=one, index=30 + vector)
            phases.append(LpPhase(step=1, state=LpPhase.TRACKED, a=a, b=b, **about))
    return responses, phases


def zeros(run):
    """All 4N exponents; those that vanish fall as linear growth does."""
    half, warmup = run.info.zero_exponents // 2, run.info.warmup
    told = [run.info]
    for time in (20.0, 60.0, 200.0):
        small = 0.5 * np.log1p(time / warmup) / time * np.linspace(1, 0.1, half)
        values = np.concatenate([run.exponents, small, -small[::-1], -run.exponents[::-1]])
        told.append(made.spectrum(values, time))
    last = run.last()
    last.steps[-1] = made.zero_modes(run.end + 1)
    last.steps[-1].last_index = run.end + 2 * half
    return [*told, last]


def interval(run, off=3e-9):
    """One trajectory: exponents of one time differ by rounding."""
    if run.name != 'interval_0_25':
        other, run = run, Run('interval_0_25')
        run.name, run.info = other.name, other.info
        run.exponents = run.exponents + off * np.cos(run.info.interval + np.arange(run.end))
    told, asked = [run.info], run.info.interval
    for number, (stage, in_use) in enumerate(((0, 9.0), (1, 5.0), (2, 2.5), (2, 0.75), (3, 0.5))):
        cost = made.cost(100.0 + number)
        cost.interval, cost.orthonormalisations = min(in_use, asked), 4 * number
        told += [cost, made.status(100.0 + number, stage=stage)]
    times = (10.0, 20.0) if asked < 8 else (10.0, 20.0, 20.5)
    told += [run.spectrum(time, exponents=run.exponents + 0.1 / time) for time in times]
    return [*told, run.last()]


def independent(run):
    """With a scatter of the runs that their errors state."""
    cost = made.cost(100.0)
    cost.interval = min(run.info.interval, 2.5)
    factor = 1 + 2e-3 * run.rng.normal()
    for one in run.steps:
        one.exponent, one.std_error = factor * one.exponent, 2e-3 * one.exponent
    spectrum = run.spectrum(20.0, exponents=factor * run.exponents, std_errors=2e-3 * run.exponents)
    spectrum.ks_entropy_error = 2e-3 * spectrum.ks_entropy
    spectrum.ks_entropy *= factor
    return [run.info, made.status(100.0, stage=RunStatus.AVERAGING), cost, spectrum, run.last()]


def structure(run, reports=300, omega=None):
    run.steps = shown = [
        one for one in run.steps if (one.nx, one.ny) in map(tuple, test_structure.WAVES)
    ]
    last = run.last()
    turned = omega or (last.v, 0.0)
    return [run.info, run.spectrum(60.0), last] + [
        test_structure.message(
            run.info, 100.0 + 0.5 * t, shown, vectors=run.end, means=t > reports - 3, omega=turned
        )
        for t in range(reports)
    ]


MAKERS = periodic, reflecting, travelling, halves, hydro, zeros, interval, independent, structure
MAKERS = {make.__name__: make for make in MAKERS}


def messages_of(name):
    make = MAKERS.get(name.partition('_')[0], plain)
    return make(Run(name))


@functools.lru_cache(None)
def world():
    return {name: Bag(messages_of(name), name) for name in plan()}


def of_part(part, found):
    return {name: found[name] for name in part.runs}
