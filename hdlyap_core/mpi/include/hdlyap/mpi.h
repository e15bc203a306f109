/** The ranks of an MPI program as a communicator. This is a library of its own, which is built if
 * MPI is found. */
#ifndef HDLYAP_MPI_H
#define HDLYAP_MPI_H

#include "hdlyap/communicator.h"

HD_API_BEGIN

/** Starts MPI, with argc and argv of main, and writes a communicator of its ranks to *out, or NULL
 * if there is a single rank. Returns HD_OK; HD_REFUSED, with one line in message[size], if this MPI
 * cannot be called by several threads, one at a time, or if it finds a single rank although another
 * MPI has started several (hd_ranks_started), each of which would do the whole run; or
 * HD_NO_MEMORY. If MPI finds an error, it ends all ranks. After HD_OK, and only then, hd_mpi_end
 * has to be called, for a single rank too. */
HD_MUST_CHECK hd_status hd_mpi_begin(hd_communicator **out, int *argc, char ***argv, char *message,
                                     size_t size);
/** Ends MPI and frees the communicator. All ranks have to call it, with c from hd_mpi_begin, after
 * the runs that use it have been freed. */
void hd_mpi_end(hd_communicator *c);

HD_API_END
#endif
