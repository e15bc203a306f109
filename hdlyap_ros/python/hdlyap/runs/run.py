"""One of many runs: its name, the parameters of its node, whether it is done, and about how many
seconds it takes: on two cores if it uses all of them (is_wide), otherwise on one."""

import contextlib
from math import isfinite
import os

import yaml

import hdlyap
from hdlyap import whole
from hdlyap.data.reader import RecordingError

from . import asked
from .arguments import nearest
from .program import HDLYAP
from .scene import Refused

ABOUT = 'A run of hdlyap sweep.'  # first line of a scene file
AUTO = 'auto'  # value of a parameter that the node chooses
TIMES = 'equilibration', 'warmup', 'duration'
OF_ONE = 'checkpoint', 'resume'  # parameters that runs cannot share
UNFINISHED = 'the run has not reached its end'
# about the seconds to start, and those of a time unit with 200 disks on one core; they grow as N^2
BEGIN, STEP, DISKS = 5.0, 0.03, 200


class Planned:
    def __init__(self, name, parameters, seconds=None, program=HDLYAP):
        """parameters: all of them; seconds: about how many it takes, if known; program: of its
        node. Raises Refused if that does not know a parameter, or the run would never end."""
        _check(parameters, program)
        self.name, self.parameters, self.program = name, parameters, program
        self.seconds = seconds or _estimate(parameters, program)

    @property
    def is_wide(self):
        """Whether the run uses all cores."""
        return self.parameters['threads'] == 0

    def share_of(self, jobs):
        """The seconds of wall time that the run adds if this many jobs run at a time."""
        return self.seconds / (1 if self.is_wide else jobs)

    def scene_file(self, folder):
        return os.path.join(folder, self.name + '.yaml')

    def bag(self, folder):
        return os.path.join(folder, self.name + '.bag')

    def write(self, folder):
        """Writes the scene file, unless it is there with exactly these parameters."""
        text = yaml.safe_dump(self.parameters, sort_keys=False, default_flow_style=None)
        text = f'# {ABOUT}\n{text}'
        path = self.scene_file(folder)
        with contextlib.suppress(OSError, UnicodeDecodeError), open(path) as file:
            if file.read() == text:
                return
        whole.write(path, text)

    def errors_after(self, folder):
        """The averaged time after which the run states errors, as the node says for the scene file
        in this folder, and its warning; None and the reason if the node refuses the file."""
        return self.program.errors_after(self.scene_file(folder))

    def lacks(self, folder):
        """What the bag in this folder lacks to be this run, as text; '' if the run is done."""
        return self.lacking(complete(self.bag(folder)))

    def lacking(self, there):
        """What a data.run.Run, or None, lacks to be this run, as text; '' if it is this run."""
        if not there:
            return UNFINISHED
        usual = self.program.completed({'particles': there.info.particles})
        return asked.difference(there.info, self.parameters, usual)


def complete(bag):
    """The data.run.Run in a bag, if it is there and went to its end; otherwise None."""
    there = recorded(bag)
    return there if there and there.is_complete else None


def recorded(bag):
    """The data.run.Run in a bag; None if it cannot be read."""
    try:
        return hdlyap.load(bag)
    except RecordingError:
        return None


def _check(parameters, program):
    known = program.completed({'particles': parameters['particles']})
    for name, value in parameters.items():
        if name not in known:
            raise Refused(f'{name} = {value}: {_unknown(name, known, program)}')
        if name in OF_ONE and value:
            raise Refused(f'{name} = {value}: must be empty in a sweep, which goes on by itself')
    for name in TIMES:
        is_chosen = name == 'warmup' and parameters[name] == AUTO  # the node chooses it
        if not (is_chosen or is_number(parameters[name])):
            raise Refused(f'{name} = {parameters[name]}: must be a number')
    if not (parameters['duration'] > 0 or parameters['target']):
        raise Refused(
            f'duration = {parameters["duration"]}: must be above 0, or it never ends without a '
            'target'
        )


def _unknown(name, known, program):
    """What the node says of a parameter that is not among those known."""
    if any(name in own for own in program.own().values()):
        return f'must not be given with particles = {known["particles"]}'
    meant = nearest(name, known)
    return 'no such parameter' + (f'; is {meant} meant?' if meant else '')


def _estimate(parameters, program):
    time = sum(parameters[name] for name in TIMES if is_number(parameters[name]))
    disks = parameters['number'] if is_number(parameters['number']) else DISKS  # node refuses it
    coordinates, _ = program.coordinates(parameters)
    return BEGIN + STEP * time * (coordinates / 2 * disks / DISKS) ** 2


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
