"""What a run was asked for, as run_info has it -> in what it differs from what is asked now. What
the node has chosen, or written in another way, makes no difference."""

import contextlib

import yaml

from hdlyap.data.reader import PATH, plain

# parameters that make no difference to results, or that a sweep replaces
NOT_COMPARED = 'threads', 'wait_for_subscribers', 'table', 'checkpoint', 'resume'
ENDS = '[]', "''", '""'  # of texts that the node reads as YAML


def difference(info, parameters, usual):
    """The parameter in which a recorded run was asked for something else, as text; '' if there is
    none. usual: {name: default}, which the run had if it was not asked for more."""
    given = dict(one.split('=', 1) for one in info.given)
    there = {**{name: text(value) for name, value in usual.items()}, **given}
    for name, value in parameters.items():
        if name not in NOT_COMPARED and not _same(there.get(name), text(value)):
            return f'it was run with {name} = {there.get(name)}, not {text(value)}'
    for change in info.changes:
        if not any(_is(change, one) for one in _listed(parameters['changes'])):
            return f'{change.name} was set to {change.value} while it went on'
    return ''


def text(value):
    """A value as in run_info.given: equal values have one text, however they were written."""
    value = _listed(value)
    if isinstance(value, list):
        return plain(f'[{", ".join(map(text, value))}]', PATH)
    if isinstance(value, float):
        texts = (f'{value:.{digits}g}' for digits in range(6, 18))
        return next((one for one in texts if float(one) == value), str(value))
    return plain(str(value), PATH)


def _listed(value):
    if isinstance(value, str) and value[:1] + value[1:][-1:] in ENDS:
        with contextlib.suppress(yaml.YAMLError):
            return yaml.safe_load(value)
    return value


def _is(change, asked):
    """Whether a change is the one that was asked for as 'TIME NAME=VALUE'. It is made at the next
    time at which that is possible."""
    name, _, value = asked.partition(' ')[2].partition('=')
    return name.strip() == change.name and _same(change.value, value.strip())


def _same(one, other):
    """Whether two texts are the same, or the same number."""
    try:
        return one == other or float(one) == float(other)
    except (TypeError, ValueError):
        return False
