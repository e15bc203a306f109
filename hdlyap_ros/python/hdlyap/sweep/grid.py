"""Values of the swept parameters -> the runs of their product, each with a name of its values."""

from collections import namedtuple
import itertools
import re

import yaml

from hdlyap.runs import run, scene
from hdlyap.runs.bag import Bag
from hdlyap.runs.scene import Refused

PERIODIC, REFLECTING = WALLS = 'periodic', 'reflecting'
# seconds of a run, about: to come up; of a time unit with 200 disks on one core, as their square
BEGIN, STEP, DISKS = 5.0, 0.03, 200
OF_ONE = 'checkpoint', 'resume'  # parameters that runs cannot share


class Swept(namedtuple('Swept', 'argument name parameters wanted')):
    """Argument, name of one value, the parameters that it says, what is allowed."""

    def values(self, text):
        """[(name, {parameter: value})] of each; [] if not one is given."""
        found = [self._value(text, word) for word in text.split()]
        names = [name for name, _ in found]
        for name in names:
            if names.count(name) > 1:
                raise Refused(f'{self.argument} = {text}: must be each once')
        return found

    def _value(self, text, word):
        words = word.split(',') if self.argument == 'boundaries' else [word]
        values = [self._parsed(one) for one in words]
        if None in values or len(values) > len(self.parameters):
            raise Refused(f'{self.argument} = {text}: must be {self.wanted}, with spaces between')
        name = '_'.join([self.name, *map(str, values)])
        # one word is that of all of them
        values *= len(self.parameters) // len(values)
        return re.sub(r'\W', '_', name), dict(zip(self.parameters, values))

    def _parsed(self, word):
        """None if it is not allowed; the node knows more."""
        if self.argument == 'boundaries':
            return word if word in WALLS else None
        if self.argument in ('densities', 'aspects'):
            try:
                number = float(word)
            except ValueError:
                return None
            return number if 0 < number < float('inf') else None
        if not re.fullmatch('[0-9]+', word):
            return None
        return int(word) if self.argument == 'disks' else str(int(word))


SWEPT = (
    Swept('disks', 'disks', ('disks',), 'whole numbers'),
    Swept('densities', 'density', ('density',), 'positive numbers'),
    Swept('aspects', 'aspect', ('aspect',), 'positive numbers'),
    Swept(
        'boundaries',
        'boundary',
        ('boundary_x', 'boundary_y'),
        'periodic or reflecting, or two of them for x and y as reflecting,periodic',
    ),
    Swept('seeds', 'seed', ('seed',), 'decimal numbers'),
)


class Run(run.Run):
    ABOUT = 'A run of a sweep: hdlyap sweep.'

    def is_done(self, folder):
        """Whether its bag is whole. Refused if that is of a run with other parameters."""
        bag = Bag(self.bag(folder))
        if not bag.is_complete():
            return False
        difference = bag.differs_from(self.parameters)
        if difference:
            raise Refused(
                f'{bag.path}: {difference}; must be swept with that, or in another folder'
            )
        return True


def runs(given, launch, cwd):
    """given: {argument: text} of those swept and of scene, duration, observables, threads and
    params; launch: folder of the launch files; cwd: of relative paths."""
    given = {name: text.strip() for name, text in given.items()}
    chosen = {swept: swept.values(given.pop(swept.argument, '')) for swept in SWEPT}
    chosen = {swept: values for swept, values in chosen.items() if values}
    if not chosen:
        names = ', '.join(swept.argument for swept in SWEPT)
        raise Refused(f'nothing to sweep over: must be values of at least one of {names}')
    usual = run.usual()
    base = _base(given, launch, cwd, usual)
    for swept in chosen:
        twice = set(swept.parameters) & set(scene.mapping('params', given['params']))
        if twice:
            raise Refused(f'params = {given["params"]}: must be without {min(twice)}: it is swept')
    return [_run({**usual, **base}, chosen) for chosen in itertools.product(*chosen.values())]


def _base(given, launch, cwd, usual):
    """Parameters of the scene, and of what is the same in all runs."""
    base = scene.parameters(given, launch, cwd)
    if isinstance(base.get('observables'), str):
        base['observables'] = yaml.safe_load(base['observables'])
    for name, value in base.items():
        if name not in usual:
            raise Refused(f'{name} = {value}: must be a parameter of hdlyap_node')
        if name in OF_ONE and value:
            raise Refused(f'{name} = {value}: must be empty in a sweep, which goes on by itself')
    return base


def _run(parameters, chosen):
    """Runs that differ in their seeds alone have one scene."""
    names = [name for name, _ in chosen]
    same = [name for name, values in chosen if 'seed' not in values]
    for _, values in chosen:
        parameters = {**parameters, **{key: scene.fitting(v) for key, v in values.items()}}
    parameters['scene'] = '_'.join(same) or parameters['scene']
    try:
        found = Run('_'.join(names), parameters, BEGIN)
    except ValueError as error:
        raise Refused(str(error))
    times = [parameters[name] for name in ('equilibration', 'warmup', 'duration')]
    time = sum(one for one in times if run.is_number(one))
    disks = parameters['disks'] if run.is_number(parameters['disks']) else DISKS  # it is refused
    found.seconds += STEP * time * (disks / DISKS) ** 2
    return found
