"""run_info -> the parameters of a run as Python values: info.density is the one in effect, where
run_info itself has no such field."""

import copy

from hdlyap.msg import Parameter, RunInfo


def value(parameter, text=None):
    """The value in effect of a Parameter, or such a text, with the type that the node says. A
    number that is a word, as auto, is this word."""
    text = parameter.effect if text is None else text
    if parameter.kind == Parameter.LIST:
        return text.split(', ') if text else []
    if parameter.kind == Parameter.WORD:
        return text
    for kind in (int, float) if parameter.kind == Parameter.INTEGER else (float,):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def named(info, name):
    """The Parameter of this name; None if there is none."""
    return next((one for one in info.parameters if one.name == name), None)


def all_of(info):
    """{name: value} of all parameters."""
    return {one.name: value(one) for one in info.parameters}


def own(info):
    """{name: value} of the parameters that only these particles have."""
    return {one.name: value(one) for one in info.parameters if one.own}


def asked_of_own(info):
    """The same with values as they were asked for: what a node chooses may differ from one seed to
    the next."""
    return {one.name: value(one, one.value) for one in info.parameters if one.own}


def with_effect(info, name, text):
    """A copy with this value in effect."""
    copied = copy.copy(info)
    copied.parameters = [copy.copy(one) for one in info.parameters]
    named(copied, name).effect = text
    return copied


def _of_name(info, name):
    found = None if name in RunInfo.__slots__ or name.startswith('__') else named(info, name)
    if found is None:
        raise AttributeError(f'run_info has no {name}')
    return value(found)


RunInfo.__getattr__ = _of_name
