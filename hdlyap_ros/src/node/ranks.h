/** Started by mpirun or srun, this process is one of several ranks that carry one run: rank 0 is
 * the node, the others have no ROS. */
#ifndef HDLYAP_RANKS_H
#define HDLYAP_RANKS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/communicator.h"

/** Joins the ranks; *out is NULL for a single rank, for which MPI is not loaded. Returns false if
 * this build has no MPI, or another MPI than the one that started the ranks; `message` then has the
 * line, or is empty if another rank of this machine reports it. */
bool ranks_join(hd_communicator **out, int *argc, char ***argv, char *message, size_t size);

/** Does all that a rank other than rank 0 has to do, and returns at the end of the run. */
void ranks_follow(hd_communicator *ranks);

/** Called at the end, on every rank. */
void ranks_leave(hd_communicator *ranks);

#endif
