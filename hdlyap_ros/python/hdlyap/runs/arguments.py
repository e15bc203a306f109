"""Checks arguments NAME:=VALUE of run.launch before roslaunch gets them. It would ignore a name
that it does not know, and end with many lines about a value that it does not understand."""

import difflib
import os
from xml.etree import ElementTree
import xmlrpc.client

from . import run, scene
from .scene import Refused


def check(words, launch, cwd):
    """Raises Refused if roslaunch cannot take the words. launch: folder of the launch files; cwd:
    folder of relative paths. Words that begin with _ are for ROS."""
    known = _names(os.path.join(launch, 'run.launch'))
    given = dict(word.split(':=', 1) for word in words if not word.startswith('_'))
    for name, value in given.items():
        if name not in known:
            raise Refused(f'{name} = {value}: must be {_wanted(name, known)}')
        if _is_long(value) and run.is_number(run.usual().get(name)):
            _check_carried({name: int(value)})
    if given.get('scene') or given.get('resume', '') in ('', 'auto'):
        _check_carried(scene.scene_file(given.get('scene') or 'first', launch, cwd))
    _check_carried(scene.mapping('params', given.get('params', '')))


def _names(path):
    """The names of the arguments that a launch file takes."""
    found = ElementTree.parse(path).getroot().findall('arg')
    return [arg.get('name') for arg in found if arg.get('value') is None]


def _wanted(name, known):
    all_of_node = {*run.usual(), *(own for one in run.own().values() for own in one)}
    if name in all_of_node:
        return f'in params:="{{{name}: ..}}", as run.launch has no argument of this name'
    meant = difflib.get_close_matches(name, [*known, *all_of_node], 1)
    return 'an argument of run.launch' + ''.join(f'; is {close} meant?' for close in meant)


def _is_long(text):
    return len(text) > 9 and text.lstrip('+-').isdecimal()


def _check_carried(values):
    for name, value in values.items():
        try:
            xmlrpc.client.dumps((value,))
        except (OverflowError, TypeError) as error:
            raise Refused(
                f'{name} = {value}: must be a text in quotes, a number with a point or one of 32 '
                f'bits: {error}'
            )
