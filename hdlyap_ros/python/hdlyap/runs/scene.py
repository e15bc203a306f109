"""A scene and further parameters -> all parameters of hdlyap_node, or a line that refuses them."""

import os
import re

import yaml

WHOLE = re.compile(r'[+-]?[0-9]{1,9}$')  # longer ones do not fit into an integer parameter
LARGEST = 2**31


class Refused(Exception):
    """A line for the user says what is wrong, its value and what is allowed."""


def parameters(given, folder, cwd):
    """All parameters. given: {name: text} of scene, params (other parameters, as YAML) and
    parameters; an empty text means that it is not given. folder: of the launch files; cwd: folder
    of relative paths."""
    given = {name: text for name, text in given.items() if text}
    values = scene_file(given.pop('scene'), folder, cwd)
    own = others(given.pop('params', ''), given)
    values.update((name, typed(text)) for name, text in given.items())
    values.update(own)
    return {str(name): fitting(value) for name, value in values.items()}


def others(text, given):
    """The parameters in the argument params, of which none may be an argument that is given."""
    own = mapping('params', text)
    twice = sorted(set(own) & set(given))
    if twice:
        raise Refused(f'params = {own}: must be without {twice[0]}, which is an argument too')
    return own


def mapping(name, text):
    try:
        found = yaml.safe_load(text) if text else {}
    except yaml.YAMLError as error:
        raise Refused(f'{name} = {text}: must be {{parameter: value, ..}}: {in_line(error)}')
    if not isinstance(found, dict) or None in found.values():  # {warmup=5} is a name without value
        raise Refused(f'{name} = {text}: must be {{parameter: value, ..}}')
    return found


def scene_file(scene, folder, cwd):
    """The parameters in a scene file. A scene without a name gets that of the file."""
    file = path(scene, folder, cwd)
    values = load(file, f'scene = {scene}', 'parameters')
    return dict({'scene': os.path.basename(file)[: -len('.yaml')]}, **values)


def path(scene, folder, cwd):
    """The path of a scene file, which is one of hdlyap's or has its ending."""
    scenes = os.path.join(folder, 'scenes')
    if scene.endswith('.yaml'):
        return os.path.join(cwd, scene)
    names = sorted(name[:-5] for name in os.listdir(scenes) if name.endswith('.yaml'))
    if scene not in names:
        raise Refused(
            f'scene = {scene}: must be one of {", ".join(names)}; or a file with its .yaml'
        )
    return f'{scenes}/{scene}.yaml'


def read(path, name, holds, as_what=str):
    """A YAML file. name: what the user calls it; holds: what it has to hold; as_what: its text
    becomes this."""
    try:
        with open(path) as file:
            text = file.read()
        yaml.reader.Reader(text)  # no letters that no XML carries to the node
        return as_what(text)
    except (OSError, yaml.YAMLError, UnicodeDecodeError) as error:
        raise Refused(f'{name}: must be a YAML file of {holds}: {in_line(error)}')


def load(path, name, holds):
    """The mapping in a YAML file."""
    values = read(path, name, holds, yaml.safe_load) or {}
    if not isinstance(values, dict):
        raise Refused(f'{name}: must be a YAML file of {holds}')
    return values


def in_line(error):
    if isinstance(error, yaml.MarkedYAMLError) and error.problem_mark:
        return f'line {error.problem_mark.line + 1}: {error.problem}'
    return ' '.join(str(error).split())


def typed(text):
    """The number in a text, or the text, which the node will read."""
    if WHOLE.match(text):
        return int(text)
    try:
        return float(text) if '.' in text and abs(float(text)) < float('inf') else text
    except ValueError:
        return text


def fitting(value):
    """A value as the parameter server can carry it: an integer of more than 32 bits becomes a
    string, which the node reads, too."""
    return str(value) if type(value) is int and abs(value) >= LARGEST else value
