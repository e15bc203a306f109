#!/usr/bin/env python3
"""Compiles the sources of builds by Ninja once more, without code: C++ as C++14, which is what the
oldest compilers take it for, with the oldest gcc and the oldest clang at hand. A warning is an
error.

standards.py BUILD.."""

import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

WITH_VALUE = '-o', '-MT', '-MF'
DROPPED = '-c', '-MD', '-fopenmp'  # clang has OpenMP only with a library of its own
CHECKS = ['-fsyntax-only', '-Werror', '-Wno-unknown-pragmas']
NO_OMP = "'omp.h' file not found"
SUFFIXES = '.c', '.cpp'


def oldest(kind):
    """The C compiler of a kind with the least version on the path; else that without a version."""
    found = set()
    for folder in os.environ['PATH'].split(':'):
        names = os.listdir(folder) if os.path.isdir(folder) else ()
        found |= {
            int(name.rpartition('-')[2]) for name in names if re.fullmatch(kind + r'-\d+', name)
        }
    return f'{kind}-{min(found)}' if found else kind


def compilers():
    """[(C compiler, C++ compiler)]"""
    pairs = [
        (oldest(one), oldest(one).replace(one, other))
        for one, other in (('gcc', 'g++'), ('clang', 'clang++'))
    ]
    for pair in pairs:
        for name in pair:
            print(
                subprocess.run(
                    [name, '--version'], capture_output=True, text=True, check=True
                ).stdout.splitlines()[0]
            )
    return pairs


def commands(build, pairs):
    """Yields (folder, command), each once."""
    said = subprocess.run(
        ['ninja', '-C', build, '-t', 'compdb'], capture_output=True, text=True, check=True
    ).stdout
    seen = set()
    for one in json.loads(said):
        if not one['file'].endswith(SUFFIXES):
            continue
        is_cpp = one['file'].endswith('.cpp')
        for pair in pairs:
            last = [*CHECKS, *['-std=c++14'] * is_cpp]
            command = [pair[is_cpp], *kept(one['command']), *last]
            if tuple(command) not in seen:
                seen.add(tuple(command))
                yield one['directory'], command


def kept(command):
    """Arguments that say how a source is read; without the compiler, and a cache before it."""
    words = shlex.split(command)
    words = iter(words[next(k for k, word in enumerate(words) if word.startswith('-')) :])
    for word in words:
        if word in WITH_VALUE:
            next(words)
        elif word not in DROPPED:
            yield word


def compiled(job):
    folder, command = job
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return done.returncode and NO_OMP not in done.stderr, f'{shlex.join(command)}\n{done.stderr}'


def main():
    pairs = compilers()
    jobs = [job for build in sys.argv[1:] for job in commands(build, pairs)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        wrong = [text for status, text in pool.map(compiled, jobs) if status]
    print(*wrong, f'{len(jobs)} compiled, {len(wrong)} with a fault', sep='\n')
    return 1 if wrong or not jobs else 0


sys.exit(main())
