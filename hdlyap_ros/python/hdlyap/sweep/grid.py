"""Values of the swept parameters -> runs of all combinations, named after their values."""

from collections import namedtuple
import itertools
import re

import yaml

from hdlyap.runs import run, scene
from hdlyap.runs.run import Planned
from hdlyap.runs.scene import Refused

OF_SPHERES = (
    'periodic or reflecting, or three of them for x, y and z as reflecting,periodic,periodic'
)
PERIODIC, REFLECTING = WALLS = 'periodic', 'reflecting'


class Swept(namedtuple('Swept', 'argument name parameters wanted')):
    """A swept argument: its name, the name of one value, the parameters that it sets, and what is
    allowed."""

    def of(self, parameters):
        """This argument for such parameters: with spheres, `boundaries` sets three of them."""
        if self.argument != 'boundaries' or not run.is_solid(parameters):
            return self
        return self._replace(parameters=(*self.parameters, 'boundary_z'), wanted=OF_SPHERES)

    def values(self, text):
        """[(name, {parameter: value})] of all values in a text; [] if it is empty."""
        found = [self._value(text, word) for word in text.split()]
        names = [name for name, _ in found]
        for name in names:
            if names.count(name) > 1:
                raise Refused(f'{self.argument} = {text}: must have each value once')
        return found

    def _value(self, text, word):
        words = word.split(',') if self.argument == 'boundaries' else [word]
        values = [self._parsed(one) for one in words]
        if None in values or len(values) not in (1, len(self.parameters)):
            raise Refused(f'{self.argument} = {text}: must be {self.wanted}, with spaces between')
        name = '_'.join([self.name, *map(str, values)])
        # a single word counts for all parameters
        values *= len(self.parameters) // len(values)
        return re.sub(r'\W', '_', name), dict(zip(self.parameters, values))

    def _parsed(self, word):
        """The value of a word; None if it is not allowed. The node checks more."""
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
        return int(word) if self.argument == 'numbers' else str(int(word))


SWEPT = (
    Swept('numbers', 'number', ('number',), 'whole numbers'),
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


def runs(given, launch, cwd):
    """All runs. given: {argument: text} of the swept arguments and of scene, duration, observables,
    threads and params; launch: folder of the launch files; cwd: folder of relative paths."""
    given = {name: text.strip() for name, text in given.items()}
    texts = {swept: given.pop(swept.argument, '') for swept in SWEPT}
    if not any(texts.values()):
        names = ', '.join(swept.argument for swept in SWEPT)
        raise Refused(f'nothing to sweep over: must be values of at least one of {names}')
    base = scene.parameters(given, launch, cwd)
    chosen = {swept.of(base): text for swept, text in texts.items() if text}
    chosen = {swept: swept.values(text) for swept, text in chosen.items()}
    if isinstance(base.get('observables'), str):
        base['observables'] = yaml.safe_load(base['observables'])
    own = scene.mapping('params', given['params'])
    for swept in chosen:
        twice = set(swept.parameters) & set(own)
        if twice:
            raise Refused(f'params = {given["params"]}: must be without {min(twice)}: it is swept')
    asked = {*own, *(name for name, text in given.items() if text)}
    base = run.without_unneeded(run.completed(base), asked)
    return [_run(base, chosen) for chosen in itertools.product(*chosen.values())]


def _run(parameters, chosen):
    """The run with these values. Runs that differ in their seeds alone have one scene."""
    names = [name for name, _ in chosen]
    same = [name for name, values in chosen if 'seed' not in values]
    for _, values in chosen:
        parameters = {**parameters, **{key: scene.fitting(v) for key, v in values.items()}}
    parameters['scene'] = '_'.join(same) if same else parameters['scene']
    return Planned('_'.join(names), parameters)
