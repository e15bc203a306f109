"""What a run of load.c executes, counted by callgrind: by source file and line, and by function
called.

Lines are known of the core alone; it is built with line tables (-g1), which do not change its
code."""

import collections
import os
import re
import subprocess
import tempfile

# in the order of load.c's command line
DEFAULTS = dict(
    disks=20, density=0.7, aspect=1.0, x=0, y=0, exponents=-1, observe=0, look=0, time=5.0
)
PARTS = ('create', 'equilibrate', 'warm', 'average')
ENTRY = re.compile(r'(ob|fl|fi|fe|fn|cfn|calls)=(.*)')
SECONDS = 60.0  # takes one or two


class Profile:
    """Of one part of a run, or of several together."""

    def __init__(self):
        self.lines = collections.Counter()  # instructions by (source file of the core, line)
        self.functions = collections.Counter()  # instructions by function that is not inlined
        self.objects = collections.Counter()  # instructions by library
        self.calls = collections.Counter()  # calls by function called

    def add(self, other):
        for name, counts in vars(self).items():
            counts.update(getattr(other, name))

    def read(self, path):
        here = dict.fromkeys(('ob', 'fl', 'fn', 'cfn'), '')
        with open(path) as file:
            for line in file:
                entry = ENTRY.match(line)
                if entry and entry[1] == 'calls':
                    self.calls[here['cfn']] += int(entry[2].split()[0])
                    next(file)  # what the call cost: counted where it was spent
                elif entry:
                    here['fl' if entry[1] in ('fi', 'fe') else entry[1]] = entry[2]
                elif line[0].isdigit():
                    self.count(here, *map(int, line.split()))

    def count(self, here, line, count):
        library = os.path.basename(here['ob'])
        self.objects[library] += count
        self.functions[here['fn']] += count
        if library == 'hdlyap_load':
            self.lines[os.path.basename(here['fl']), line] += count

    def files(self):
        """Source files of the core of which anything was executed."""
        return {file for file, _ in self.lines}

    def of_lines(self, file, first, last):
        return sum(self.lines[file, line] for line in range(first, last + 1))

    def of_file(self, file):
        return sum(count for (name, _), count in self.lines.items() if name == file)


def profiles(valgrind, load, scene):
    """Of each part of one run."""
    if set(scene) - set(DEFAULTS):
        raise ValueError(scene)
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        command = [
            valgrind,
            '-q',
            '--tool=callgrind',
            '--callgrind-out-file=' + out,
            '--toggle-collect=load_*',
            '--compress-strings=no',
            '--compress-pos=no',
        ]
        command += ['--dump-after=load_' + part for part in PARTS]
        command += [load] + ['%.17g' % value for value in dict(DEFAULTS, **scene).values()]
        subprocess.run(
            command,
            check=True,
            timeout=SECONDS,
            stdout=subprocess.DEVNULL,
            env=dict(os.environ, OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1'),
        )
        result = {}
        for number, part in enumerate(PARTS, 1):
            result[part] = Profile()
            result[part].read('%s.%d' % (out, number))
    return result


def body(path, function):
    """First and last line of a function's definition."""
    start = re.compile(r'^[a-z].*\b%s\((?!.*;)' % function)
    first = None
    with open(path) as file:
        for number, line in enumerate(file, 1):
            if first is None and start.match(line):
                first = number
            if first is not None and (line.rstrip() == '}' or (number == first and '}' in line)):
                return first, number
    raise LookupError('%s: no function %s' % (path, function))
