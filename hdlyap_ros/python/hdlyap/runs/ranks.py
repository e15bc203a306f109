"""The ranks that mpirun or srun has started this program as, and what they run."""

import contextlib
import itertools
import os
import random
import socket

# below those that Linux hands out
PORTS = itertools.cycle(random.sample(range(20000, 32768), 4096))
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


def become(path):
    """Replaces this process by a program. Does not return."""
    os.execv(path, [path])


def free_port():
    """A port of a master: another one each time, and none that nodes get meanwhile."""
    for port in PORTS:
        with contextlib.suppress(OSError), socket.socket() as listening:
            listening.bind(('', port))
            return port
