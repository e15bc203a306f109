"""The ranks that mpirun or srun has started this program as, and what they run."""

import contextlib
import itertools
import os
import random
import socket

import roslib.packages
import rospkg

from .scene import Refused

# below those that Linux hands out
PORTS = itertools.cycle(random.sample(range(20000, 32768), 4096))
PACKAGE, PROGRAM = 'hdlyap', 'hdlyap_node'
# variables in which Open MPI, PMIx, Slurm and MPICH give the rank
NUMBERS = 'OMPI_COMM_WORLD_RANK', 'PMIX_RANK', 'SLURM_PROCID', 'PMI_RANK'
# and how many there are
COUNTS = 'OMPI_COMM_WORLD_SIZE', 'SLURM_STEP_NUM_TASKS', 'PMI_SIZE'


def number():
    """The number of this rank, from 0; 0 if there are no others."""
    for name in NUMBERS:
        if name in os.environ:
            return int(os.environ[name])
    return 0


def count():
    """The number of ranks, as far as it is known; otherwise 1."""
    return next((int(os.environ[name]) for name in COUNTS if name in os.environ), 1)


def node():
    """The path of hdlyap_node. Raises Refused if there is none."""
    return program({})


def program(given):
    """The path of the node's program in the arguments of run.launch. Raises Refused if there is
    none."""
    package, name = given.get('package') or PACKAGE, given.get('program') or PROGRAM
    try:
        found = roslib.packages.find_node(package, name)
    except rospkg.ResourceNotFound:
        raise Refused(f'package = {package}: must be a package that ROS finds')
    if found:
        return found[0]
    if package == PACKAGE and name == PROGRAM:
        raise Refused(
            f'{PACKAGE} was built without {PROGRAM}, as messages and tools alone: build it without '
            '-DHDLYAP_MESSAGES_ONLY=ON'
        )
    raise Refused(f'program = {name}: must be a program of the package {package}')


def become(path):
    """Replaces this process by a program. Does not return."""
    os.execv(path, [path])


def free_port():
    """A port of a master: another one each time, and none that nodes get meanwhile."""
    for port in PORTS:
        with contextlib.suppress(OSError), socket.socket() as listening:
            listening.bind(('', port))
            return port
