"""One of many runs: its name, the parameters of its node, whether it is done, and about how many
seconds it takes: on two cores if it uses all of them (is_wide), otherwise on one."""

import contextlib
import functools
from math import isfinite
import os
import re
import subprocess
import tempfile

import yaml

import hdlyap
from hdlyap import whole
from hdlyap.data.reader import RecordingError

from . import asked, ranks
from .scene import Refused

ABOUT = 'A run of hdlyap sweep.'  # first line of a scene file
AUTO = 'auto'  # value of a parameter that the node chooses
TIMES = 'equilibration', 'warmup', 'duration'
OF_ONE = 'checkpoint', 'resume'  # parameters that runs cannot share
UNFINISHED = 'the run has not reached its end'
# about the seconds to start, and those of a time unit with 200 disks on one core; they grow as N^2
BEGIN, STEP, DISKS = 5.0, 0.03, 200
# how the node refuses a parameter that nothing needs
UNNEEDED = re.compile(r'\b(\w+) = .*?: must (?:be \S+ without|not be given with) ')
OWN_PARAMETER = re.compile(
    r'^# For (\w+(?: and \w+)*) only\.\n(?:# .*\n)*?# (\w+): (\S+)$', re.MULTILINE
)
KIND = re.compile(r'^# (\w+): (\d+) coordinates, (\d+) of them its position$', re.MULTILINE)


class Planned:
    def __init__(self, name, parameters, seconds=None):
        """parameters: all of them; seconds: about how many it takes, if known. Raises Refused if
        the node does not know a parameter, or the run would never end."""
        _check(parameters)
        self.name, self.parameters = name, parameters
        self.seconds = seconds or _estimate(parameters)

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
        in this folder; None if the node refuses the file, of which it will complain when it
        runs."""
        command = [ranks.node(), '--errors', self.scene_file(folder)]
        said = subprocess.run(command, capture_output=True, text=True)
        return float(said.stdout) if said.returncode == 0 else None

    def lacks(self, folder):
        """What the bag in this folder lacks to be this run, as text; '' if the run is done."""
        return self.lacking(complete(self.bag(folder)))

    def lacking(self, there):
        """What a data.run.Run, or None, lacks to be this run, as text; '' if it is this run."""
        if not there:
            return UNFINISHED
        return asked.difference(
            there.info, self.parameters, completed({'particles': there.info.particles})
        )


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


def _check(parameters):
    known = completed({'particles': parameters['particles']})
    for name, value in parameters.items():
        if name not in known:
            raise Refused(f'{name} = {value}: must be a parameter of hdlyap_node')
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


def _estimate(parameters):
    time = sum(parameters[name] for name in TIMES if is_number(parameters[name]))
    disks = parameters['number'] if is_number(parameters['number']) else DISKS  # node refuses it
    coordinates, _ = _coordinates(parameters)
    return BEGIN + STEP * time * (coordinates / 2 * disks / DISKS) ** 2


@functools.lru_cache(maxsize=None)
def _said():
    command = [ranks.node(), '--parameters']
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


@functools.lru_cache(maxsize=None)
def usual():
    """{name: default} of all parameters, as the node says."""
    return yaml.safe_load(_said())


@functools.lru_cache(maxsize=None)
def own():
    """{particles: {name: default}} of the parameters that only some particles have."""
    found = {}
    for those, name, value in OWN_PARAMETER.findall(_said()):
        for particles in those.split(' and '):
            found.setdefault(particles, {})[name] = yaml.safe_load(value)
    return found


def completed(given):
    """The given parameters and the defaults of all others."""
    particles = given.get('particles', usual()['particles'])
    return {**usual(), **own().get(particles, {}), **given}


def without_unneeded(parameters, given):
    """The parameters of a run. One that comes from the base scene, not from the user (`given`), and
    that the node refuses because nothing of the run needs it, has its default."""
    parameters, default = dict(parameters), completed({'particles': parameters.get('particles')})
    for _ in default:
        found = UNNEEDED.search(_refusal(parameters))
        name = found.group(1) if found else None
        if name is None or name in given or parameters.get(name) == default.get(name):
            break
        parameters[name] = default[name]
    return parameters


def _refusal(parameters):
    """What the node says against parameters; '' if it takes them."""
    with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
        yaml.safe_dump(parameters, file)
        file.flush()
        said = subprocess.run([ranks.node(), '--errors', file.name], capture_output=True, text=True)
    return '' if said.returncode == 0 else said.stdout + said.stderr


def is_solid(parameters):
    """Whether the particles are in space."""
    _, dimension = _coordinates(parameters)
    return dimension == 3


def _coordinates(parameters):
    """Coordinates of a particle, and how many of them are its position, as the node says."""
    found = {name: (int(every), int(of)) for name, every, of in KIND.findall(_said())}
    return found.get(parameters.get('particles'), (2, 2))  # the node refuses others


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
