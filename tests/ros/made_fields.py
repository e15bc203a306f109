"""Disks, spheres and tangent vectors made up for tests, whose waves are known exactly."""

import numpy as np

from hdlyap.msg import ModeField, Step
from hdlyap.data import waves


def disks(info, seed=1):
    """Positions on a shaken lattice and thermal momenta: x, y, px, py."""
    rng = np.random.default_rng(seed)
    columns = max(1, round(np.sqrt(info.number * info.box_x / info.box_y)))
    place = np.arange(info.number)
    rows = -(-info.number // columns)
    x = (place % columns + 0.5 + rng.uniform(-0.3, 0.3, info.number)) * info.box_x / columns
    y = (place // columns + 0.5 + rng.uniform(-0.3, 0.3, info.number)) * info.box_y / rows
    return [x, y, *rng.normal(size=(2, info.number))]


def balls(info, seed=1):
    """Positions anywhere and thermal momenta, rows along x, y and z of each."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(size=(3, info.number)) * np.array([[info.box_x], [info.box_y], [info.box_z]])
    return q, np.sqrt(2 / 3) * rng.normal(size=q.shape)


def ball_field(info, one, dq, **fields):
    """A vector of spheres at balls(info): dq, rows along x, y and z."""
    q, p = balls(info)
    named = zip(('', 'p', 'dq', 'dp'), (q, p, dq, dq))
    rows = {name + axis: row for name, rows in named for axis, row in zip('xyz', rows)}
    about = {name: getattr(one, name) for name in ('kind', 'nx', 'ny', 'nz', 'wave_number')}
    made = dict(run_id='one', sim_time=150.0, index=one.last_index, exponent=one.exponent)
    return ModeField(**{**made, **about, **rows, **fields})


def mode_field(info, one, sim_time=150.0, modulations=(0, 1), noise=0.3, index=None, **fields):
    """A vector of the step: its last modulation with noise, and of an LP step its P modes."""
    rng = np.random.default_rng(2)
    x, y, px, py = disks(info)
    a, shape = _fields(info, one, modulations, x, y)
    dq = np.array(shape) / np.sqrt(np.mean(np.square(shape)))
    dq = (dq + noise * rng.normal(size=dq.shape)) / np.sqrt(2 * info.number)
    p_mode = [[modulation * p for p in (px, py)] for modulation in a]
    over = [
        [modulation * p * p / (p * p + 0.01) + 0.2 * rng.normal(size=p.size) for p in (px, py)]
        for modulation in a
    ]
    made = ModeField(
        run_id='one',
        sim_time=sim_time,
        index=index or one.last_index,
        kind=one.kind,
        nx=one.nx,
        ny=one.ny,
        wave_number=one.wave_number,
        exponent=one.exponent,
        x=x,
        y=y,
        px=px,
        py=py,
        dqx=dq[0],
        dqy=dq[1],
        dpx=dq[0],
        dpy=dq[1],
    )
    if one.kind == Step.LP:
        made.pairs, made.modulation = len(modulations), bytes(modulations)
        made.residual_l = made.residual_p = [0.1] * len(modulations)
        made.l_x, made.l_y = np.tile(dq[0], len(a)), np.tile(dq[1], len(a))
        made.p_x, made.p_y = (np.concatenate(part) / np.sqrt(info.number) for part in zip(*p_mode))
        made.p_over_px, made.p_over_py = (np.concatenate(part) for part in zip(*over))
    for name, value in fields.items():
        setattr(made, name, value)
    return made


def _fields(info, one, modulations, x, y):
    """The modulations at the disks, and the T or L field of the last by small differences."""

    def a(bits, dx=0.0, dy=0.0):
        return waves.modulation(info, one.nx, one.ny, bits, x + dx, y + dy) * np.ones_like(x)

    h = 1e-4
    last = modulations[-1]
    along_x, along_y = ((a(last, **{d: h}) - a(last, **{d: -h})) / (2 * h) for d in ('dx', 'dy'))
    shape = (along_y, -along_x) if one.kind == Step.T else (along_x, along_y)
    return [a(bits) for bits in modulations], shape
