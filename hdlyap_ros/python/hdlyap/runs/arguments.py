"""Checks arguments NAME:=VALUE of run.launch before roslaunch gets them. It would ignore a name
that it does not know, and end with many lines about a value that it does not understand."""

import difflib
import os
from xml.etree import ElementTree
import xmlrpc.client

import rospkg

from . import ranks, run, scene
from .scene import Refused


def launch_folder():
    """The folder of the launch files. Raises Refused if this build of hdlyap runs nothing."""
    ranks.node()
    return os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')


def check(words, launch, cwd):
    """Returns {name: value} of the words. Raises Refused if roslaunch cannot take them, or they
    contradict each other. launch: folder of the launch files; cwd: folder of relative paths. Words
    that begin with _ are for ROS."""
    known = _names(os.path.join(launch, 'run.launch'))
    given = _once(word.split(':=', 1) for word in words if not word.startswith('_'))
    for name, value in given.items():
        if name not in known:
            raise Refused(f'{name} = {value}: must be {_wanted(name, known)}')
        if _is_long(value) and run.is_number(run.usual().get(name)):
            _check_carried({name: int(value)})
    if given.get('scene') or given.get('resume', '') in ('', 'auto'):
        _check_carried(scene.scene_file(given.get('scene') or 'first', launch, cwd))
    _check_carried(scene.others(given.get('params', ''), given))
    if not given.get('machine'):
        ranks.program(given)
    return given


def _once(pairs):
    """{name: value}. Raises Refused if a name has two values."""
    given = {}
    for name, value in pairs:
        if given.setdefault(name, value) != value:
            raise Refused(f'{name} = {value}: must be {given[name]}, which is given too')
    return given


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
