"""claims.yaml, the one table of what is held against what -> parts with their statements."""

import importlib
import os

import yaml

from .row import Claim

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../claims.yaml')
STATEMENT, FINDING, BESIDE = KINDS = 'the paper', 'ours', 'beside'


class Part:
    """Of the table: number, title, entries; runs: names of all that it needs."""

    def __init__(self, number, entry):
        self.number, self.title, self.entries = number, entry['title'], entry['claims']
        self._runs, self._pictures = entry['runs'], entry.get('pictures', {})
        for one in self.entries:
            usual = entry.get('kind', STATEMENT) if 'criterion' in one else BESIDE
            one.setdefault('kind', usual)
            one.setdefault('runs', self._runs)
            if 'criterion' in one:
                one.setdefault('of', 'ours')
        every = [name for one in self.entries for name in flat(one['runs'])]
        self.runs = list(dict.fromkeys([*flat(self._runs), *every]))

    def figures(self, bags):
        """(name, figure) of what there is to draw."""
        for name, what in self._pictures.items():
            figure = measured(what, self._runs, bags)
            if figure is not None:
                yield name, figure

    def claims(self, bags):
        """One for each entry."""
        return [
            Claim(self.number, one, measured(one['measure'], one['runs'], bags))
            for one in self.entries
        ]


def measured(what, runs, bags):
    """What a measure gives of these runs: its name, or a list of that and what it is given."""
    name, *given = [what] if isinstance(what, str) else what
    return function(name)(of_runs(runs, bags), *given)


def function(name):
    """Of study/measures: `module.function`."""
    module, _, name = name.partition('.')
    return getattr(importlib.import_module(f'study.measures.{module}'), name)


def of_runs(names, bags):
    """The bag of a name; lists as they are."""
    return bags[names] if isinstance(names, str) else [of_runs(one, bags) for one in names]


def flat(names):
    """Names in lists of lists."""
    return [names] if isinstance(names, str) else [name for some in names for name in flat(some)]


def read(path=PATH):
    """(parts in their order, sentences of the front page)"""
    with open(path) as file:
        table = yaml.safe_load(file)
    parts = [Part(number, entry) for number, entry in enumerate(table['parts'], start=1)]
    return parts, table['front']


def runs_of(parts):
    """Names of the runs that these need, each once."""
    return list(dict.fromkeys(name for part in parts for name in part.runs))
