"""One run of many: its name, the parameters of its node, and about how many seconds it takes: on
all of two cores if it is wide, else on one."""

import functools
from math import isfinite
import os
import subprocess

import roslib.packages
import yaml

from . import files

AUTO = 'auto'  # what the node chooses itself


class Run:
    ABOUT = 'One run of many.'  # first line of its scene file

    def __init__(self, name, parameters, seconds):
        """ValueError if it would not end."""
        self.name, self.parameters, self.seconds = name, parameters, seconds
        for needed in ('equilibration', 'warmup', 'duration'):
            is_chosen = needed == 'warmup' and parameters[needed] == AUTO  # by the node
            if not (is_chosen or is_number(parameters[needed])):
                raise ValueError(f'{needed} is {parameters[needed]}, must be a number')
        if not parameters['duration'] > 0:
            raise ValueError('duration is 0: it would never end')

    @property
    def is_wide(self):
        """Has all cores for itself."""
        return self.parameters['threads'] == 0

    def share_done(self, status):
        """Of the whole run, 0 .. 1, in simulated time with tangent vectors: without them it goes
        fast. Of the averaging alone if the warmup is not known. status: its last one, or None."""
        if status is None:
            return 0.0
        warmup = self.parameters['warmup']
        if warmup == AUTO:
            return min(1.0, max(0.0, status.progress))
        spent = status.sim_time - self.parameters['equilibration']
        return min(1.0, max(0.0, spent / (warmup + self.parameters['duration'])))

    def share_of(self, jobs):
        """Seconds of wall time that it adds to the work of so many jobs at a time."""
        return self.seconds / (1 if self.is_wide else jobs)

    @property
    def node(self):
        return f'/{self.name}/hdlyap'

    def scene_file(self, folder):
        return os.path.join(folder, self.name + '.yaml')

    def bag(self, folder):
        return os.path.join(folder, self.name + '.bag')

    def write(self, folder):
        """The scene file, if it is not there with these very parameters."""
        text = f'# {self.ABOUT}\n' + yaml.safe_dump(
            self.parameters, sort_keys=False, default_flow_style=None
        )
        if files.read(self.scene_file(folder)) != text:
            files.write(self.scene_file(folder), text)

    def note(self, folder, **facts):
        """To be called when the bag is whole; facts: seconds, run_id, commit."""


@functools.lru_cache(maxsize=None)
def usual():
    """The default of every parameter, as the node says."""
    node = roslib.packages.find_node('hdlyap', 'hdlyap_node')[0]
    said = subprocess.run([node, '--parameters'], check=True, stdout=subprocess.PIPE).stdout
    return yaml.safe_load(said)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
