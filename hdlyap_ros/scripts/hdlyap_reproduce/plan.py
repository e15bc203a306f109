"""launch/reproduce.yaml -> the runs that the parts of the paper need, as scene files."""

import json
import os

import yaml

# of an entry, what is no parameter of the node
OWN = ('base', 'quick', 'full', 'seconds')


class PlanError(Exception):
    """One line for the user."""


class Run:
    """One run: its name, the parameters of its node, and about how many seconds it takes:
    on all of two cores if it is wide, else on one."""

    def __init__(self, name, entry, scenes, quick):
        which = 'quick' if quick else 'full'
        self.name = name
        self.seconds = entry['seconds'][0 if quick else 1]
        base = _load(os.path.join(scenes, entry['base'] + '.yaml'))
        asked = {key: value for key, value in entry.items() if key not in OWN}
        self.parameters = {**base, 'threads': 1, **asked, **entry.get(which, {}), 'scene': name}

    @property
    def is_wide(self):
        """Has all cores for itself."""
        return self.parameters['threads'] == 0

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

    def record(self, folder):
        return os.path.join(folder, self.name + '.json')

    def write(self, folder):
        """The scene file, if it is not there with these very parameters."""
        text = (f'# A run of the reproduction of the paper: launch/reproduce.yaml.\n'
                + yaml.safe_dump(self.parameters, sort_keys=False, default_flow_style=None))
        path = self.scene_file(folder)
        if _text(path) != text:
            with open(path + '.new', 'w') as file:
                file.write(text)
            os.replace(path + '.new', path)

    def done(self, folder):
        """What was noted of it when it ended; None if it has not been done with these parameters."""
        try:
            with open(self.record(folder)) as file:
                noted = json.load(file)
        except (OSError, ValueError):
            return None
        same = noted.get('parameters') == self.parameters and os.path.exists(self.bag(folder))
        return noted if same else None

    def note(self, folder, **facts):
        path = self.record(folder)
        with open(path + '.new', 'w') as file:
            json.dump({**facts, 'parameters': self.parameters}, file, indent=1)
        os.replace(path + '.new', path)


def runs(package, quick):
    """{name: Run} of all, in their order; package: the folder of the package hdlyap."""
    launch = os.path.join(package, 'launch')
    entries = _load(os.path.join(launch, 'reproduce.yaml'))
    return {name: Run(name, entry, os.path.join(launch, 'scenes'), quick) for name, entry in entries.items()}


def _load(path):
    try:
        with open(path) as file:
            return yaml.safe_load(file)
    except (OSError, yaml.YAMLError) as error:
        raise PlanError(f'{path}: {error}')


def _text(path):
    try:
        with open(path) as file:
            return file.read()
    except OSError:
        return None
