"""Run -> frames of a movie: particles and the vectors of some modes, one time after the other."""

from math import isfinite

import numpy as np

from hdlyap.data import space, steps
from hdlyap.data.reader import FIELD, PHASES, RecordingError, STATE

MOST = 1e6  # most frames of a film; at ten frames per second they take a day


class Frame:
    """The last messages at a time. Fields come seldom, so each may have a different time."""

    def __init__(self, info=None):
        self._info = info
        self.time, self.places = None, None  # places: rows along each direction
        self.angles = self.spins = ()  # empty unless particles rotate
        self.fields = {}  # name of the mode -> ModeField
        self.phases = None  # LpPhases
        self.turned = {}  # name of the mode -> pairs (a, b) at the time of its field

    def add(self, kind, message, names):
        if kind == PHASES:
            self.phases = message
        else:
            self.time, self.places = message.sim_time, space.vectors(message)
            self.angles, self.spins = message.angle, message.spin
        if kind == FIELD:
            self._add_field(message, names)
        self._note_pairs()

    def _add_field(self, field, names):
        name = wave_name(field.kind, space.nodes(field, self._info))
        before = self.fields.get(name)
        # the first one of several vectors of a step
        if name in names and not (
            before and before.sim_time == field.sim_time and before.index < field.index
        ):
            self.fields[name] = field
            self.turned.pop(name, None)

    def _note_pairs(self):
        for name, field in self.fields.items():
            known = getattr(self.phases, 'sample_time', None)
            if field.kind == steps.LP and field.sim_time == known:
                self.turned[name] = self.pairs(field)

    def pairs(self, field):
        """(a, b) of each pair of a vector, from the last phases."""
        return [
            (phase.a, phase.b)
            for phase in (self.phases.phases if self.phases else ())
            if phase.index == field.index
            and space.nodes(phase, self._info) == space.nodes(field, self._info)
            and isfinite(phase.a + phase.b)
        ]


class Film:
    """The frames of a data.run.Run. within: first and last simulated time; None: the time from
    which all modes are found, and the last time."""

    def __init__(self, run, names=None, within=(None, None)):
        self._run, self.info = run, run.info
        self.steps = steps.resolved(run.summary.steps, self.info)
        self.names = names or lowest(self.steps)
        if not self.names:
            raise RecordingError(f'{run.name}: no step is resolved in it')
        missing = [name for name in self.names if name not in self.steps]
        if missing:
            forbidden = missing[0] in steps.impossible(run.summary.steps, self.info)
            why = 'does not exist between its walls' if forbidden else 'is not resolved in it'
            raise RecordingError(f'{run.name}: {missing[0]} {why}, only {", ".join(self.steps)}')
        places, fields, begin = self._times()
        if len(places) == 0:
            raise RecordingError(
                f'{run.name}: neither state nor fields in it: there are no '
                f'{space.particle(self.info)}s'
            )
        self.begin, self.end = self._cut(places, begin, *within)
        self.report = _apart(places[places >= self.begin])
        self.field_interval = _apart(fields)

    def _times(self):
        """The times of positions; the times of fields of the film's modes; and the first time at
        which each mode that ever has a vector has had one, None if none ever has."""
        places, fields, first = set(), set(), {}
        for packed in self._run.in_time((STATE, FIELD)):
            places.add(packed.sim_time)
            name = self._wave_name(packed) if packed.kind == FIELD else None
            if name in self.names:
                fields.add(packed.sim_time)
                first.setdefault(name, packed.sim_time)
        begin = max(first.values(), default=None)
        return np.array(sorted(places)), np.array(sorted(fields)), begin

    def _wave_name(self, packed):
        kind, *nodes = packed.field_wave(len(space.axes(self.info)))
        return wave_name(kind, nodes)

    def _cut(self, places, found, begin, end):
        if begin is None:
            begin = found if found is not None else places[0]
        first, last = max(begin, places[0]), min(places[-1] if end is None else end, places[-1])
        if first > last:
            raise RecordingError(
                f'{self._run.name}: from t = {begin:g} to {last:g}: must be forwards, and within '
                f'{places[0]:g} .. {places[-1]:g}'
            )
        return first, last

    def count(self, every):
        """The number of frames, if each is `every` simulated time units after the last."""
        count = (self.end - self.begin) / every
        if not count < MOST:
            raise RecordingError(
                f'{self._run.name}: from t = {self.begin:g} to {self.end:g} in {count:.3g} frames: '
                f'must be less than {MOST:g}; choose another pace'
            )
        return 1 + int(count + 1e-9)

    def frames(self, every):
        """Yields the state at each of those times, in one Frame, which is changed."""
        frame, number, count = Frame(self.info), 0, self.count(every)
        for packed in self._run.in_time((STATE, FIELD, PHASES)):
            while number < count and packed.sim_time > self.begin + number * every + 1e-9:
                yield frame
                number += 1
            frame.add(packed.kind, packed.message(), self.names)
        for _ in range(number, count):
            yield frame


def wave_name(kind, nodes):
    """The name of a mode as T(1,0); None if the vector belongs to no T or LP step."""
    named = kind in (steps.T, steps.LP)
    return f'{steps.NAMES[kind]}({",".join(map(str, nodes))})' if named else None


def _apart(times):
    """The median distance of times; 0 if there is only one."""
    return float(np.median(np.diff(times))) if len(times) > 1 else 0.0


def lowest(resolved):
    """The names of the T and of the LP step with the smallest exponents."""
    names = []
    for kind in (steps.T, steps.LP):
        of_kind = {name: step for name, step in resolved.items() if step.kind == kind}
        if of_kind:
            names.append(min(of_kind, key=lambda name: of_kind[name].exponent))
    return names
