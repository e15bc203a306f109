"""The ranks that mpirun or srun has started this program as."""

import os
import socket

import roslib.packages

# variables in which Open MPI, PMIx, Slurm and MPICH give the rank
NUMBERS = 'OMPI_COMM_WORLD_RANK', 'PMIX_RANK', 'SLURM_PROCID', 'PMI_RANK'


def number():
    """The number of this rank, from 0; 0 if there are no others."""
    for name in NUMBERS:
        if name in os.environ:
            return int(os.environ[name])
    return 0


def node():
    """The path of hdlyap_node."""
    return roslib.packages.find_node('hdlyap', 'hdlyap_node')[0]


def become_node():
    """Replaces this process by hdlyap_node. Does not return."""
    program = node()
    os.execv(program, [program])


def free_port():
    with socket.socket() as listening:
        listening.bind(('', 0))
        return listening.getsockname()[1]
