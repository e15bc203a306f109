"""Bags -> the runs in them. Files of a split recording, and runs that were resumed from a
checkpoint, are parts of one run; bags with different seeds are several runs of one system."""

import math
import os
from collections import namedtuple

from . import reader, space
from .reader import NoInfo, RecordingError, is_known

# parameters that bags of one system have to share: all that decide what is measured
OF_SPHERES = ('particles', 'aspect_z', 'boundary_z')  # the same for all disks
SYSTEM = ('container', 'number', 'density', 'aspect', 'boundary_x', 'boundary_y')
SYSTEM += OF_SPHERES
KINDS = ('kind_diameters', 'kind_masses')  # as parameters of their own may say
MEASURED = ('vectors', 'wave_nx', 'wave_ny', 'wave_nz')
UNSEEN = ('spectrum', 'state')  # observables that change nothing in the core, and may differ
SAME = 1e-9  # relative difference below which parameters are the same

# a part: one run in one file, up to a simulated time
Part = namedtuple('Part', 'path node run_id info until')


def packed(parts, kinds):
    """Yields messages of these types except run_info, each once. A resumed run repeats what the run
    before it sent after the checkpoint."""
    last = {}  # (run_id, type): last sequence number in the files before
    averages = _Averages()
    for part in parts:
        newest = {}
        for one in reader.messages(part.path, part.node, kinds):
            key = one.run_id, one.kind
            if one.run_id != part.run_id or one.kind == reader.RUN_INFO:
                continue
            if one.sim_time <= part.until and one.seq > last.get(key, -1):
                newest[key] = one.seq
                one.info = part.info if is_known(part.info) else None
                if one.kind == reader.SPECTRUM:
                    averages.add(part, one)
                yield one
        last.update(newest)


class _Averages:
    """Checks the averages of the parts of a run: each part goes on averaging where the one before
    ended, or begins anew later. Otherwise these are two runs with one seed, one of which was
    reset."""

    def __init__(self):
        self._part, self._time, self._averaged, self._longest = None, 0.0, 0.0, 0.0

    def add(self, part, packed):
        time, averaged = packed.sim_time, packed.averaged_time
        if self._averaged > 0 and part.run_id != self._part.run_id:
            # averages end at most one interval before a report, and some reports may be lost
            late = self._longest + time - self._time
            begun, before = time - averaged, self._time - self._averaged
            if abs(begun - before) > late and begun < self._time - late:
                raise RecordingError(
                    f'{self._part.path} and {part.path} are no parts of one run: averaged over '
                    f'{self._averaged:g} at time {self._time:g} and over {averaged:g} at {time:g}'
                )
        self._longest = max(self._longest, averaged - self._averaged)
        self._part, self._time, self._averaged = part, time, averaged


def runs(paths, node=None, number=None):
    """[(parts in their order, number of runs in the bag)] of the bags, with one element for each
    seed. number: which run of each bag, from 1; None: the last one. run_info may be in another part
    of the run."""
    if not paths:
        raise RecordingError('no bag: name one or several')
    paths = {os.path.realpath(path): path for path in _names(paths)}.values()
    infos = {path: _infos(path, node) for path in paths}
    told = {key: info for of in infos.values() for key, info in of.items() if is_known(info)}
    chosen = [_chosen(path, node, number, {**of, **_of(of, told)}) for path, of in infos.items()]
    if len(chosen) == 1:
        return [([chosen[0][0]], chosen[0][1])]
    parts = [part for part, _ in chosen]
    without = [part for part in parts if not is_known(part.info)]
    if without:
        return [(_of_one_run(parts, without[0]), 1)]
    _refuse_others(parts, compared(parts[0].info), 'do not belong together')
    seeds = {}
    for part in parts:
        seeds.setdefault(part.info.seed, []).append(part)
    return [(_in_order(of_seed), 1) for of_seed in seeds.values()]


def _names(paths):
    """The names of bags, which may be in a list."""
    for path in paths:
        if isinstance(path, (list, tuple)):
            yield from _names(path)
        elif isinstance(path, (str, os.PathLike)):
            yield os.fspath(path)
        else:
            raise RecordingError(f'bag {path!r}: must be the name of a file')


def _infos(path, node):
    try:
        return reader.run_infos(path, node)
    except NoInfo:
        found = reader.without_info(path, node)
        if not found:
            raise
        return found


def _of(runs, told):
    """Of run_infos that some bag has, those of these runs that have none in their own."""
    return {key: told[key] for key, info in runs.items() if key in told and not is_known(info)}


def _of_one_run(parts, part):
    """Parts of a run without run_info, in their order. `part` is one of them."""
    for other in parts:
        if other.run_id != part.run_id:
            why = f'so nothing says whether it belongs to {other.path}'
            raise NoInfo(f'{part.path}: no run_info in it, {why}')
    return sorted(parts, key=lambda part: reader.start(*part[:3]))


def _chosen(path, node, number, infos):
    """The chosen Part of a bag, and the number of runs in the bag."""
    infos = list(infos.items())
    wanted = len(infos) if number is None else number
    if not 1 <= wanted <= len(infos):
        raise RecordingError(f'{path}: no run {number} in it, only 1 .. {len(infos)}')
    return Part(path, node, *infos[wanted - 1], math.inf), len(infos)


def system(info):
    """Names of what runs of one system share: what moves, and where. What a node chooses may differ
    from one seed to the next."""
    absent = space.OF_A_BOX if space.without_box(info) else ()
    own = [one.name for one in info.parameters if one.own and one.value == one.effect]
    sheared = not absent and 'shearing' in space.along(info, 'boundary_')
    of_walls = ['shear_b'] if sheared else []
    return [*(name for name in SYSTEM if name not in absent), *of_walls, *(own or KINDS)]


def compared(info):
    """Names of what bags share whose numbers are compared, or averaged."""
    return [*system(info), *MEASURED]


def _kept(info):
    """Names of what parts of one run share, because a resumed run keeps it."""
    return [one.name for one in info.parameters if one.as_before]


def different(a, b, names):
    """Yields (name, value of a, value of b) for each of these names in which two run_infos
    differ."""
    for name in names:
        values = [_value(info, name) for info in (a, b)]
        both = all(isinstance(value, float) for value in values)
        same = math.isclose(*values, rel_tol=SAME) if both else values[0] == values[1]
        if not same:
            yield name, *values


def _value(info, name):
    value = getattr(info, name, None)
    if name != 'observables':
        return value
    return [topic for topic in value if topic not in UNSEEN]


def _refuse_others(parts, names, why):
    for part in parts[1:]:
        for name, one, other in different(parts[0].info, part.info, names):
            raise RecordingError(
                f'{parts[0].path} and {part.path} {why}: {name} is {one} and {other}'
            )


def _in_order(parts):
    """The parts of one seed in their order. Each one ends at the checkpoint from which the next one
    was resumed."""
    begun = {part.run_id: part.info.resumed_time for part in parts}
    anew = [part for part in parts if begun[part.run_id] < 0]
    if len({part.run_id for part in anew}) > 1:
        raise RecordingError(
            f'{anew[0].path} and {anew[1].path} both begin with seed {anew[0].info.seed}: '
            'the same trajectory twice is no second sample'
        )
    _refuse_others(parts, _kept(parts[0].info), 'are no parts of one run')
    # sorted by simulated time, because clocks may be set back
    parts = sorted(parts, key=lambda part: (begun[part.run_id], reader.start(*part[:3])))
    for a, b in zip(parts, parts[1:]):
        if a.run_id != b.run_id and begun[a.run_id] == begun[b.run_id]:
            raise RecordingError(
                f'{a.path} and {b.path} were both resumed at time {begun[a.run_id]:g}: '
                'leave one out'
            )
    later = sorted(set(begun.values())) + [math.inf]
    return [part._replace(until=next(t for t in later if t > begun[part.run_id])) for part in parts]
