"""A plan, which is a YAML file {name: {base: scene, parameter: value, ..}, ..} -> its runs.

Parameters in an entry replace those of its scene. Parameters in its `quick`, for quick runs, or in
its `full`, for all others, replace both. A run has one thread unless its entry says otherwise.
`seconds`, [of the quick run, of the full run], are about how long it takes, and are used to show
progress."""

import os
import re

import yaml

from hdlyap.runs import run, scene
from hdlyap.runs.program import HDLYAP
from hdlyap.runs.run import Planned
from hdlyap.runs.scene import Refused

OF_PLAN = 'base', 'quick', 'full', 'seconds'  # keys of an entry that are no parameters of the node
ENTRY = '{base: scene, parameter: value, ..}'


def runs(path, quick, launch, program=HDLYAP):
    """[Planned] in the order of the plan. Paths of scene files are relative to the folder of the
    plan. launch: folder of the launch files; program: of the nodes."""
    entries = scene.load(path, f'plan = {path}', f'runs, {{name: {ENTRY}, ..}}')
    if not entries:
        raise Refused(f'plan = {path}: must have runs')
    _check_names(path)
    return [_run(path, name, entry, quick, launch, program) for name, entry in entries.items()]


def _check_names(path):
    """Refuses two runs, or two parameters of one run, with the same name: YAML would take the
    last."""
    with open(path) as file:
        whole = yaml.compose(file, yaml.SafeLoader)
    for mapping in (whole, *(entry for _, entry in whole.value)):
        names = [key.value for key, _ in mapping.value] if mapping.id == 'mapping' else ()
        for name in names:
            if names.count(name) > 1:
                raise Refused(f'plan = {path}: must have {name} once')


def _run(path, name, entry, quick, launch, program):
    try:
        if not re.fullmatch('[A-Za-z][A-Za-z0-9_]*', str(name)):  # it becomes a namespace of ROS
            raise Refused('must be named with letters, digits and _, the first one a letter')
        if not _is_entry(entry):
            raise Refused(f'must be {ENTRY}')
        base = scene.scene_file(str(entry['base']), launch, os.path.dirname(os.path.abspath(path)))
        asked = {key: value for key, value in entry.items() if key not in OF_PLAN}
        asked.update(entry.get('quick' if quick else 'full', {}))
        parameters = program.completed({**base, 'threads': 1, 'scene': name, **asked})
        parameters = program.without_unneeded(parameters, asked)
        parameters = {str(key): scene.fitting(value) for key, value in parameters.items()}
        return Planned(name, parameters, _seconds(entry, quick), program)
    except Refused as refused:
        raise Refused(f'plan = {path}: {name}: {refused}')


def _is_entry(value):
    return (
        isinstance(value, dict)
        and 'base' in value
        and all(isinstance(value.get(which, {}), dict) for which in ('quick', 'full'))
    )


def _seconds(entry, quick):
    """The seconds of an entry; None if it has none."""
    both = entry.get('seconds')
    if both is None:
        return None
    if not isinstance(both, list) or len(both) != 2 or not all(map(_is_time, both)):
        raise Refused(f'seconds = {both}: must be two positive numbers, [quick, full]')
    return both[0 if quick else 1]


def _is_time(value):
    return run.is_number(value) and value > 0
