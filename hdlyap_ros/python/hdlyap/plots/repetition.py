"""Bag -> run_info -> the scene file (YAML, as launch/scenes/*.yaml) that repeats the run."""

import re

import yaml

from hdlyap.data import containers, reader, space
from hdlyap.parameters import value as parameter_value

OF_SPHERES = ('aspect_z', 'boundary_z')  # parameters that disks do not have
# parameters that are a word or a list of numbers, and a text in run_info
LISTS = ('field_indices',)


def chosen(path, node=None, number=None):
    """run_info of one of the runs in a bag; number counts from 1."""
    infos = list(reader.run_infos(path, node).values())
    if number is None and len(infos) == 1:
        return infos[0]
    if number is not None and 1 <= number <= len(infos):
        return infos[number - 1]
    names = ', '.join(f'{k} ({info.run_id})' for k, info in enumerate(infos, start=1))
    what = 'several runs' if number is None else f'no run {number} in it'
    raise reader.RecordingError(f'{path}: {what}, choose with --run: {names}')


def scene_file(info):
    return ''.join(f'# {_one_line(line)}\n' for line in _remarks(info)) + yaml.safe_dump(
        parameters(info), sort_keys=False, default_flow_style=None, allow_unicode=True
    )


def parameters(info):
    """{name: value} of the parameters that repeat a run. The repeated run begins anew, and does not
    touch the checkpoint of the first one; results do not depend on whether that was resumed."""
    without = containers.not_asked(info)
    without += () if space.is_solid(info) else OF_SPHERES
    kept = {one.name: one for one in info.parameters if one.name not in without}
    asked = {name: parameter_value(one) for name, one in kept.items()}
    asked.update({name: _list_of(asked[name]) for name in LISTS}, checkpoint='', resume='')
    before = {change.name: change.before for change in reversed(info.changes)}  # at the beginning
    for name, value in before.items():
        if name not in asked:
            raise reader.RecordingError(f'changes: {name}: must be a parameter of the run')
        asked[name] = _typed(kept[name], value)
    return {**asked, 'changes': [_change(change) for change in info.changes]}


def _typed(parameter, text):
    """A text with the type of the parameter's present value."""
    found, now = parameter_value(parameter, text), parameter_value(parameter)
    if isinstance(now, (int, float)) and not isinstance(found, (int, float)):
        raise reader.RecordingError(f'changes: {text} before: must be a {type(now).__name__}')
    return found


def _change(change):
    """A change as the parameter `changes` takes it, exact to the last bit."""
    return f'{change.sim_time!r} {change.name}={change.value}'


def _list_of(text):
    if not text.startswith('['):
        return text
    return [
        int(item) if item.isdigit() else item for item in re.findall(r'\w+(?:\([^)]*\))?', text)
    ]


def _remarks(info):
    yield f'Repeats the run {info.run_id}.'
    yield (
        f'The same numbers bit for bit with the same version ({info.version}), linear algebra '
        f'({info.blas_library}), kernels (OPENBLAS_CORETYPE={info.blas_kernel}) and threads, '
        'and the same topics listened to.'
    )
    if info.wait_for_subscribers:
        yield (
            'Waits for subscribers, as that run did: roslaunch hdlyap run.launch scene:=FILE.yaml '
            'record:=true'
        )
    if info.resume:
        yield (
            f'That run went on from {info.resume} at simulated time {info.resumed_time:g}; '
            'this one begins anew. Changes before that time are in the bag of the run before.'
        )


def _one_line(text):
    """A text in one line: texts in a bag may come from anybody."""
    return ' '.join(text.split())
