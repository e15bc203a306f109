/** Started by mpirun or srun, this process is one of several ranks that carry one run: rank 0 is
 * the node, the others have no ROS. */
#ifndef HDLYAP_RANKS_H
#define HDLYAP_RANKS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/communicator.h"

/** *out is NULL for a single rank; then nothing of MPI is loaded. False with a line in `message`:
 * this build has no MPI, or another one than has started them. It is empty where another rank of
 * this machine tells it. */
bool ranks_join(hd_communicator **out, int *argc, char ***argv, char *message, size_t size);

/** Of the others: all that they do. */
void ranks_follow(hd_communicator *ranks);

/** At the end, on each of them. */
void ranks_leave(hd_communicator *ranks);

#endif
