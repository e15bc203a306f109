/** The ranks of an MPI program as a communicator: a library of its own, there where MPI was found.
 */
#ifndef HDLYAP_MPI_H
#define HDLYAP_MPI_H

#include "hdlyap/communicator.h"

HD_API_BEGIN

/** Starts MPI; *out is NULL for a single rank. HD_REFUSED, with a line in message[size]: calls may
 * come from several threads, one at a time, and this MPI cannot do that; or it finds one rank where
 * another MPI has started several (hd_ranks_started), each of which would do all by itself.
 * HD_NO_MEMORY. What MPI itself finds wrong ends all ranks, as is its way.
 * MPI is on after HD_OK alone: then it is ended by hd_mpi_end, of a single rank too. */
HD_MUST_CHECK hd_status hd_mpi_begin(hd_communicator **out, int *argc, char ***argv, char *message,
                                     size_t size);
/** Ends MPI; called by all ranks. `c` is what hd_mpi_begin gave. */
void hd_mpi_end(hd_communicator *c);

HD_API_END
#endif
