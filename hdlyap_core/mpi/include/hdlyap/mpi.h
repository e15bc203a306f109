/** The ranks of an MPI program as a communicator: a library of its own, there where MPI was found.
 */
#ifndef HDLYAP_MPI_H
#define HDLYAP_MPI_H

#include "hdlyap/communicator.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Starts MPI; *out is NULL for a single rank. Calls may come from several threads, one at a time:
 * HD_REFUSED if this MPI cannot do that; HD_NO_MEMORY. What MPI itself finds wrong ends all ranks,
 * as is its way. */
HD_MUST_CHECK hd_status hd_mpi_begin(hd_communicator **out, int *argc, char ***argv);
/** Ends MPI; called by all ranks. */
void hd_mpi_end(hd_communicator *c);

#ifdef __cplusplus
}
#endif
#endif
