"""Arguments of a launch file -> the parameters of hdlyap_node, or the line that refuses them."""

import os
import re
from xml.etree import ElementTree

import yaml

USUAL_SCENE = 'first'
FILES = 'checkpoint', 'resume'  # in the folder of the one who launches
WHOLE = re.compile(r'[+-]?[0-9]{1,9}$')  # longer ones do not fit into an integer parameter
LARGEST = 2**31
TRUE = 'true', 'True', '1'


class Refused(Exception):
    """With its line."""


def parameters(given, folder, cwd):
    """given: {argument: text}, empty ones are not given; folder: of the launch files; cwd: of
    relative paths."""
    given = {name: text for name, text in given.items() if text}
    scene, own = given.pop('scene', ''), mapping('params', given.pop('params', ''))
    if not scene and not given.get('resume'):
        scene = USUAL_SCENE
    ranks = given.pop('ranks', '1')
    if not (ranks.isdigit() and int(ranks) > 0):
        raise Refused(f'ranks = {ranks}: must be a number of processes, 1 at least')
    awaited = awaited_by(given)
    for name in FILES:
        if name in given:
            given[name] = os.path.join(cwd, given[name])
    twice = sorted(set(own) & set(given))
    if twice:
        raise Refused(f'params = {own}: must be without {twice[0]}, which is an argument too')
    values = scene_file(scene, folder, cwd) if scene else {}
    values.update((name, typed(text)) for name, text in given.items())
    if awaited:
        values.setdefault('wait_for_subscribers', awaited)
    values.update(own)
    return {str(name): fitting(value) for name, value in values.items()}


def awaited_by(given):
    """Who must be there before the run starts, if neither the scene nor the user says so: who
    prints its steps. A recorder is waited for in any case."""
    record, wait = given.pop('record', '') in TRUE, given.pop('wait', '')
    table = given.pop('table', '') in TRUE
    if record or wait:
        given['wait_for_subscribers'] = 'all' if record else wait
    return ['status'] if table else []


def mapping(name, text):
    try:
        found = yaml.safe_load(text) if text else {}
    except yaml.YAMLError as error:
        raise Refused(f'{name} = {text}: must be {{parameter: value, ..}}: {in_line(error)}')
    if not isinstance(found, dict):
        raise Refused(f'{name} = {text}: must be {{parameter: value, ..}}')
    return found


def scene_file(scene, folder, cwd):
    """Its parameters. Who does not say a name is named after the file."""
    scenes = os.path.join(folder, 'scenes')
    path = os.path.join(cwd, scene) if scene.endswith('.yaml') else f'{scenes}/{scene}.yaml'
    names = sorted(name[:-5] for name in os.listdir(scenes) if name.endswith('.yaml'))
    if not scene.endswith('.yaml') and scene not in names:
        raise Refused(
            f'scene = {scene}: must be one of {", ".join(names)}; or a file with its .yaml'
        )
    try:
        with open(path) as file:
            values = yaml.safe_load(file) or {}
    except (OSError, yaml.YAMLError, UnicodeDecodeError) as error:
        raise Refused(f'scene = {scene}: must be a YAML file of parameters: {in_line(error)}')
    if not isinstance(values, dict):
        raise Refused(f'scene = {scene}: must be a YAML file of parameters')
    return dict({'scene': os.path.basename(path)[: -len('.yaml')]}, **values)


def in_line(error):
    if isinstance(error, yaml.MarkedYAMLError) and error.problem_mark:
        return f'line {error.problem_mark.line + 1}: {error.problem}'
    return ' '.join(str(error).split())


def typed(text):
    """A number if it is one; the node itself reads all others."""
    if WHOLE.match(text):
        return int(text)
    try:
        return float(text) if '.' in text and abs(float(text)) < float('inf') else text
    except ValueError:
        return text


def fitting(value):
    """Integers of the parameter server have 32 bits; the node reads a longer one as a string."""
    return str(value) if type(value) is int and abs(value) >= LARGEST else value


def declared(path):
    """Arguments of a launch file that can be given."""
    found = ElementTree.parse(path).getroot().findall('arg')
    return [arg.get('name') for arg in found if arg.get('value') is None]


def check_names(command, folder, cwd, of=None):
    """Of a roslaunch, which ignores those that its file does not have. The command: its words. That
    of a file of others is theirs, or of one that has not this name."""
    files = [word for word in command if word.endswith('.launch') and ':=' not in word]
    if 'roslaunch' not in map(os.path.basename, command[:2]) or len(files) != 1:
        return
    if of and os.path.basename(files[0]) != of:
        return
    path = os.path.realpath(os.path.join(cwd, files[0]))
    if not os.path.exists(path):
        path = os.path.join(os.path.realpath(folder), files[0])
    if os.path.dirname(path) != os.path.realpath(folder) or not os.path.exists(path):
        return
    names = declared(path)
    for word in command:
        name, is_argument, value = word.partition(':=')
        if is_argument and not name.startswith('_') and name not in names:
            raise Refused(refusal(name, value, names, files[0]))


def refusal(name, value, names, file):
    others = f'; or a parameter in params:="{{{name}: {value}}}"' if 'params' in names else ''
    others = f'; a namespace is __ns:={value}' if name == 'ns' else others
    return (
        f'argument {name} = {value}: must be one that {os.path.basename(file)} has: '
        f'{", ".join(names)}{others}'
    )


def parents_command():
    """Words of what has started this process."""
    try:
        with open(f'/proc/{os.getppid()}/cmdline', 'rb') as file:
            return [os.fsdecode(word) for word in file.read().split(b'\0')[:-1]]
    except OSError:
        return []
