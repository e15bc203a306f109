"""A program of a node -> its path, and what it says of its parameters: hdlyap_node, or that of a
user, made by hdlyap_node_main."""

from collections import namedtuple
import contextlib
import functools
import re
import subprocess
import tempfile

import roslib.packages
import rospkg
import yaml

from hdlyap.data import space

from .scene import Refused

OWN_PARAMETER = re.compile(
    r'^# For (\w+(?: and \w+)*) only\.\n(?:# .*\n)*?(?:# )?(\w+): (\S+)$', re.MULTILINE
)
KIND = re.compile(r'^# (\w+): (\d+) coordinates, (\d+) of them its position$', re.MULTILINE)
# how the node refuses a parameter that nothing needs
UNNEEDED = re.compile(r'\b(\w+) = .*?: must (?:be \S+ without|not be given with) ')
PATIENCE = 10.0  # seconds for an answer: another program may wait for a master


class Program(namedtuple('Program', 'package name')):
    """A program of a package."""

    @classmethod
    def of(cls, given):
        """The one in the arguments of run.launch. Raises Refused if there is none."""
        chosen = (given.get(key) or usual for key, usual in zip(('package', 'program'), HDLYAP))
        found = cls(*chosen)
        found.path()
        return found

    def path(self):
        """Raises Refused if there is none."""
        try:
            found = roslib.packages.find_node(self.package, self.name)
        except rospkg.ResourceNotFound:
            raise Refused(f'package = {self.package}: must be a package that ROS finds')
        if found:
            return found[0]
        if self == HDLYAP:
            raise Refused(
                f'{self.package} was built without {self.name}, as messages and tools alone: build '
                'it without -DHDLYAP_MESSAGES_ONLY=ON'
            )
        raise Refused(f'program = {self.name}: must be a program of the package {self.package}')

    def arguments(self):
        """Those of run.launch that choose it."""
        return [] if self == HDLYAP else [f'package:={self.package}', f'program:={self.name}']

    def errors_after(self, path):
        """The averaged time after which a run of this scene file states errors, and what the node
        warns of; None and the reason if the node refuses it."""
        said = self._answer('--errors', path)
        return (float(said.stdout) if said.returncode == 0 else None), said.stderr.strip()

    def usual(self):
        """{name: default} of all parameters."""
        return yaml.safe_load(self._said())

    def own(self):
        """{particles: {name: default}} of the parameters that only some particles have."""
        found = {}
        for those, name, value in OWN_PARAMETER.findall(self._said()):
            for particles in those.split(' and '):
                found.setdefault(particles, {})[name] = yaml.safe_load(value)
        return found

    def completed(self, given, later=()):
        """The given parameters and the defaults of all others that such particles have. later:
        values that others will have. Between walls that shear exponents have another default: they
        are left to the node."""
        usual, own = self.usual(), self.own()
        particles = given.get('particles', usual['particles'])
        absent = {name for one in own.values() for name in one}
        if self.coordinates({'particles': particles})[1] == 0:
            absent.update(space.OF_A_BOX)
        common = {name: value for name, value in usual.items() if name not in absent}
        found = {**common, **own.get(particles, {}), **given}
        if 'shearing' in (*given.values(), *later) and 'exponents' not in given:
            del found['exponents']
        return found

    def without_unneeded(self, parameters, given):
        """The parameters of a run. One that comes from the base scene, not from the user (`given`),
        and that the node refuses because nothing of the run needs it, has its default."""
        parameters = dict(parameters)
        default = self.completed({'particles': parameters.get('particles')})
        for _ in default:
            found = UNNEEDED.search(self._refusal(parameters))
            name = found.group(1) if found else None
            if name is None or name in given or parameters.get(name) == default.get(name):
                break
            parameters[name] = default[name]
        return parameters

    def _refusal(self, parameters):
        """What the node says against parameters; '' if it takes them."""
        with tempfile.NamedTemporaryFile('w', suffix='.yaml') as file:
            yaml.safe_dump(parameters, file)
            file.flush()
            said = self._answer('--errors', file.name)
        return '' if said.returncode == 0 else said.stdout + said.stderr

    def coordinates(self, parameters):
        """Coordinates of a particle, and how many of them are its position."""
        found = {name: (int(every), int(of)) for name, every, of in KIND.findall(self._said())}
        particles = parameters.get('particles', self.usual()['particles'])
        return found.get(particles, (2, 2))  # the node refuses others

    def is_solid(self, parameters):
        """Whether the particles are in space."""
        return self.coordinates(parameters)[1] == 3

    @functools.lru_cache(maxsize=None)
    def _said(self):
        with contextlib.suppress(subprocess.TimeoutExpired):
            said = self._answer('--parameters', timeout=PATIENCE)
            if said.returncode == 0 and KIND.search(said.stdout):
                return said.stdout
        raise Refused(f'program = {self.name}: must be a node, which hdlyap_node_main makes')

    def _answer(self, *arguments, timeout=None):
        command = [self.path(), *arguments]
        return subprocess.run(command, capture_output=True, text=True, timeout=timeout)


HDLYAP = Program('hdlyap', 'hdlyap_node')


def add_arguments(parser):
    """The options that choose a program."""
    parser.add_argument(
        '--package', default='', help='package of your node, for particles of your own'
    )
    parser.add_argument('--program', default='', help='its program; default: hdlyap_node')


def chosen(args):
    """The program that these options choose. Raises Refused if there is none."""
    return Program.of({'package': args.package, 'program': args.program})
