"""launch/reproduce.yaml -> the runs that the parts of the paper need, as scene files."""

import json
import os
import re

import yaml

from hdlyap.runs import files, run
from hdlyap.runs.run import usual

# of an entry, what is no parameter of the node
OWN = ('base', 'quick', 'full', 'seconds')


class PlanError(Exception):
    """One line for the user."""


class Run(run.Run):
    ABOUT = 'A run of the reproduction of the paper: launch/reproduce.yaml.'

    def __init__(self, name, entry, scenes, quick):
        which = 'quick' if quick else 'full'
        seconds = entry['seconds'][0 if quick else 1]
        base = _load(os.path.join(scenes, entry['base'] + '.yaml'))
        asked = {key: value for key, value in entry.items() if key not in OWN}
        parameters = {**usual(), **base, 'threads': 1, **asked}
        parameters.update(entry.get(which, {}), scene=name)
        super().__init__(name, parameters, seconds)
        if (
            not all(run.is_number(seconds) and seconds > 0 for seconds in entry['seconds'])
            or len(entry['seconds']) != 2
        ):
            raise ValueError(f'seconds is {entry["seconds"]}, must be two positive numbers')

    def record(self, folder):
        return os.path.join(folder, self.name + '.json')

    def noted(self, folder):
        """What was noted when it was last done with these parameters, of this bag or another; {} if
        it was not."""
        try:
            noted = json.loads(files.read(self.record(folder)) or '{}')
        except ValueError:
            return {}
        return (
            noted if isinstance(noted, dict) and noted.get('parameters') == self.parameters else {}
        )

    def done(self, folder):
        """What was noted of it when it ended; None if it has not been done with these parameters,
        or if something has been written to its bag since."""
        noted = self.noted(folder)
        try:
            is_older = os.path.getmtime(self.bag(folder)) <= os.path.getmtime(self.record(folder))
        except OSError:
            return None
        return noted if noted and is_older else None

    def note(self, folder, **facts):
        """To be called when the bag is whole; facts: seconds, run_id, commit, and whether it was
        made elsewhere."""
        files.write(
            self.record(folder),
            json.dumps({**facts, 'parameters': self.parameters}, indent=1) + '\n',
        )


def runs(package, quick, path=None):
    """{name: Run} of all, in their order; package: folder of the package hdlyap; path: another plan
    than its own."""
    launch = os.path.join(package, 'launch')
    path = path or os.path.join(launch, 'reproduce.yaml')
    entries = _load(path)
    if not isinstance(entries, dict):
        raise PlanError(f'{path}: no runs in it')
    return {
        name: _run(path, name, entry, os.path.join(launch, 'scenes'), quick)
        for name, entry in entries.items()
    }


def _run(path, name, entry, scenes, quick):
    try:
        if not re.fullmatch('[A-Za-z][A-Za-z0-9_]*', name):  # of a namespace of ROS
            raise ValueError('a name consists of letters, digits and underscores')
        return Run(name, entry, scenes, quick)
    except KeyError as error:
        raise PlanError(f'{path}: {name}: {error} is missing')
    except (TypeError, ValueError, AttributeError, IndexError) as error:
        raise PlanError(f'{path}: {name}: {error}')


def _read(path):
    try:
        with open(path) as file:
            return file.read()
    except OSError as error:
        raise PlanError(f'{path}: {error.strerror}')


def _load(path):
    try:
        return yaml.safe_load(_read(path))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise PlanError(f'{path}: {" ".join(str(error).split())}')
