"""claims.yaml, the one table of what is held against what -> parts with their statements."""

import importlib
import os

import yaml

from .row import Claim

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../claims.yaml')
STATEMENT, FINDING, BESIDE = KINDS = 'the paper', 'ours', 'beside'


class Part:
    """Of the table: number, title, runs, entries; module: what measures and draws."""

    def __init__(self, number, entry):
        self.number, self.title, self.name = number, entry['title'], entry['module']
        self.runs, self.entries = flat(entry['runs']), entry['claims']
        self.module = importlib.import_module(f'study.parts.{self.name}')
        self.tables = self.module.tables
        for one in self.entries:
            usual = entry.get('kind', STATEMENT) if 'criterion' in one else BESIDE
            one.setdefault('kind', usual)
            if 'criterion' in one:
                one.setdefault('of', 'ours')

    def figures(self, bags):
        """(name, figure) of what there is to draw."""
        return (one for one in self.module.figures(bags) if one[1] is not None)

    def claims(self, bags):
        """One for each entry."""
        return [Claim(self.number, one, self._measured(one, bags)) for one in self.entries]

    def _measured(self, entry, bags):
        name, *given = flat([entry['measure']])
        return getattr(self.module, name)(bags, *given)


def flat(names):
    """Lists of names in a list are one."""
    found = ([one] if isinstance(one, str) else one for one in names)
    return [name for some in found for name in some]


def read(path=PATH):
    """(parts in their order, sentences of the front page)"""
    with open(path) as file:
        table = yaml.safe_load(file)
    parts = [Part(number, entry) for number, entry in enumerate(table['parts'], start=1)]
    return parts, table['front']


def runs_of(parts):
    """Names of the runs that these need, each once."""
    return list(dict.fromkeys(name for part in parts for name in part.runs))
