"""Checks arguments NAME:=VALUE of run.launch before roslaunch gets them. It would ignore a name
that it does not know, and end with many lines about a file that is not there. Values are for the
node to read."""

import difflib
import os
from xml.etree import ElementTree

import rospkg

from . import scene
from .program import HDLYAP, Program
from .scene import Refused, in_line


def launch_folder():
    """The folder of the launch files. Raises Refused if this build of hdlyap runs nothing."""
    HDLYAP.path()
    return os.path.join(rospkg.RosPack().get_path('hdlyap'), 'launch')


def check(words, launch, cwd):
    """Returns {name: value} of the words. Raises Refused if roslaunch cannot take them, or one is
    there twice. launch: folder of the launch files; cwd: folder of relative paths. Words that begin
    with _ are for ROS."""
    known = _names(os.path.join(launch, 'run.launch'))
    given = _once(word.split(':=', 1) for word in words if not word.startswith('_'))
    for name, value in given.items():
        if name not in known:
            raise Refused(f'{name} = {value}: {_wanted(name, known, given)}')
        if '\n' in value or ':=' in value:  # roslaunch would drop it
            raise Refused(f'{name} = {in_line(value)}: must be one line without :=')
    if given.get('scene'):
        path = scene.path(given['scene'], launch, cwd)
        scene.read(path, f'scene = {given["scene"]}', 'parameters')
    if not given.get('machine'):
        Program.of(given)
    return given


def refuse(words):
    """Raises Refused if there are words, which have no :=, with what the first should be."""
    for word in words:
        name, equals, value = word.partition('=')
        raise Refused(f'{word}: must be {name}:={value if equals else ".."}')


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


def _wanted(name, known, given):
    node = Program.of(given)
    all_of_node = {*node.usual(), *(own for one in node.own().values() for own in one)}
    if name in all_of_node:
        return f'must be in params:="{{{name}: ..}}", as run.launch has no argument of this name'
    meant = nearest(name, [*known, *sorted(all_of_node)])
    return 'no such argument' + (f'; is {meant} meant?' if meant else '')


def nearest(name, names):
    """The most alike of these names, of several the first; '' if none is like it."""
    alike = difflib.get_close_matches(name, names, len(names))
    close = {one: difflib.SequenceMatcher(None, name, one).ratio() for one in names if one in alike}
    return max(close, key=close.get, default='')
