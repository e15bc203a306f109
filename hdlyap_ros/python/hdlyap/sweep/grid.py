"""Values of the swept parameters -> runs of all combinations, named after their values."""

from collections import namedtuple
import itertools
import re

import yaml

from hdlyap.runs import scene
from hdlyap.runs.program import HDLYAP
from hdlyap.runs.run import Planned
from hdlyap.runs.scene import Refused

OF_SPHERES = (
    'periodic or reflecting, or three of them for x, y and z as reflecting,periodic,periodic'
)
OTHER = 'over'  # argument of any other parameter and its values
OBSERVED = '[spectrum, steps, lp_phases]', '[spectrum]'  # of a sweep; where there is no box
WALLS = 'periodic', 'reflecting', 'shearing'


class Swept(namedtuple('Swept', 'argument name parameters wanted')):
    """A swept argument: its name, the name of one value, the parameters that it sets, and what is
    allowed."""

    def of(self, is_solid):
        """This argument for such particles: with spheres, `boundaries` sets three of them."""
        if self.argument != 'boundaries' or not is_solid:
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
        if self.argument == OTHER:
            return scene.typed(word)
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
        'periodic or reflecting, or two of them for x and y as reflecting,periodic or '
        'periodic,shearing',
    ),
    Swept('seeds', 'seed', ('seed',), 'decimal numbers'),
)


def runs(given, launch, cwd, program=HDLYAP):
    """All runs. given: {argument: text} of the swept arguments and of scene, duration, observables,
    threads and params, and {OTHER: texts}; launch: folder of the launch files; cwd: folder of
    relative paths; program: of the nodes."""
    others = given.pop(OTHER, ())
    given = {name: text.strip() for name, text in given.items()}
    texts = [*map(_other, others), *((one, given.pop(one.argument, '')) for one in SWEPT)]
    texts = [(swept, text) for swept, text in texts if text]
    if not texts:
        names = ', '.join(swept.argument for swept in SWEPT)
        raise Refused(f'nothing to sweep over: must be values of at least one of {names}, {OTHER}')
    base = scene.parameters(given, launch, cwd)
    _, dimension = program.coordinates(base)
    texts = [(swept.of(dimension == 3), text) for swept, text in texts]
    chosen = [swept.values(text) for swept, text in texts]
    _refuse_twice([name for swept, _ in texts for name in swept.parameters], given['params'])
    if not given['observables']:
        base['observables'] = OBSERVED[dimension == 0]
    if isinstance(base.get('observables'), str):
        base['observables'] = yaml.safe_load(base['observables'])
    asked = {
        *scene.mapping('params', given['params']),
        *(name for name, text in given.items() if text),
    }
    swept = [value for those in chosen for _, values in those for value in values.values()]
    base = program.without_unneeded(program.completed(base, swept), asked)
    return [_run(base, chosen, program) for chosen in itertools.product(*chosen)]


def _other(text):
    """(Swept, values) of a parameter and its values, as 'beta 0.5 1 2'."""
    name, _, values = text.strip().partition(' ')
    if not (re.fullmatch(r'[a-z]\w*', name) and values.strip()):
        raise Refused(f'{OTHER} = {text}: must be a parameter and its values, as "beta 0.5 1 2"')
    return Swept(OTHER, name, (name,), 'values'), values


def _refuse_twice(swept, params):
    """Refuses a parameter that is swept and has a value, or is swept twice."""
    for name in swept:
        if name in scene.mapping('params', params):
            raise Refused(f'params = {params}: must be without {name}: it is swept')
        if swept.count(name) > 1:
            raise Refused(f'{OTHER} = {name}: must be swept once')


def _run(parameters, chosen, program):
    """The run with these values. Runs that differ in their seeds alone have one scene."""
    names = [name for name, _ in chosen]
    same = [name for name, values in chosen if 'seed' not in values]
    for _, values in chosen:
        parameters = {**parameters, **{key: scene.fitting(v) for key, v in values.items()}}
    parameters['scene'] = '_'.join(same) if same else parameters['scene']
    return Planned('_'.join(names), parameters, program=program)
