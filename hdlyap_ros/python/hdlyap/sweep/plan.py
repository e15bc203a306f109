"""A plan, which is a YAML file {name: {base: scene, parameter: value, ..}, ..} -> its runs.

What an entry says replaces parameters of its scene, and what stands in its `quick` or `full`, for
quick runs or for others, replaces both. A run has one thread unless its entry says otherwise.
seconds: [of a quick run, of another], about, tell how far all is."""

import os
import re

import yaml

from hdlyap.runs import run, scene
from hdlyap.runs.run import Planned
from hdlyap.runs.scene import Refused

OWN = 'base', 'quick', 'full', 'seconds'  # of an entry, what is no parameter of the node
ENTRY = '{base: scene, parameter: value, ..}'


def runs(path, quick, launch):
    """[Planned] in their order; scenes that are files lie where the plan says, from its own folder;
    launch: folder of the launch files."""
    entries = scene.load(path, f'plan = {path}', f'runs, {{name: {ENTRY}, ..}}')
    if not entries:
        raise Refused(f'plan = {path}: must have runs')
    _check_names(path)
    return [_run(path, name, entry, quick, launch) for name, entry in entries.items()]


def _check_names(path):
    """Of two runs, or parameters of one, that are called the same YAML would take the last."""
    with open(path) as file:
        whole = yaml.compose(file, yaml.SafeLoader)
    for mapping in (whole, *(entry for _, entry in whole.value)):
        names = [key.value for key, _ in mapping.value] if mapping.id == 'mapping' else ()
        for name in names:
            if names.count(name) > 1:
                raise Refused(f'plan = {path}: must have {name} once')


def _run(path, name, entry, quick, launch):
    try:
        if not re.fullmatch('[A-Za-z][A-Za-z0-9_]*', str(name)):  # is a namespace of ROS
            raise Refused('must be named with letters, digits and _, the first one a letter')
        if not _is_entry(entry):
            raise Refused(f'must be {ENTRY}')
        base = scene.scene_file(str(entry['base']), launch, os.path.dirname(os.path.abspath(path)))
        asked = {key: value for key, value in entry.items() if key not in OWN}
        asked.update(entry.get('quick' if quick else 'full', {}))
        parameters = run.completed({**base, 'threads': 1, 'scene': name, **asked})
        parameters = {str(key): scene.fitting(value) for key, value in parameters.items()}
        return Planned(name, parameters, _seconds(entry, quick))
    except Refused as refused:
        raise Refused(f'plan = {path}: {name}: {refused}')


def _is_entry(value):
    return (
        isinstance(value, dict)
        and 'base' in value
        and all(isinstance(value.get(which, {}), dict) for which in ('quick', 'full'))
    )


def _seconds(entry, quick):
    """None if it does not say."""
    both = entry.get('seconds')
    if both is None:
        return None
    if not isinstance(both, list) or len(both) != 2 or not all(map(_is_time, both)):
        raise Refused(f'seconds = {both}: must be two positive numbers, [quick, full]')
    return both[0 if quick else 1]


def _is_time(value):
    return run.is_number(value) and value > 0
