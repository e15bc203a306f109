/** MPI -> transport of a communicator. The only file that uses MPI. */
#include "hdlyap/mpi.h"

#include <limits.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** Most numbers in one message of an exchange, for which MPI allocates a buffer. */
enum { PIECE = 1 << 17 };

/** The largest part of `left` that MPI can count, which counts in int. */
static int as_count(size_t left) { return left < INT_MAX ? (int)left : INT_MAX; }

/** Adds x over all ranks. MPI gives the same bits to all of them. */
static void sum(void *context, double *x, size_t count)
{
    (void)context;
    for (size_t at = 0; at < count;) {
        const int piece = as_count(count - at);
        MPI_Allreduce(MPI_IN_PLACE, x + at, piece, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        at += (size_t)piece;
    }
}

/** Gathers x. It is called for some rows of a table at a time, so MPI can count them. */
static void gather(void *context, double *x, size_t count)
{
    (void)context;
    if (count > INT_MAX) MPI_Abort(MPI_COMM_WORLD, 1);
    MPI_Allgather(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, x, (int)count, MPI_DOUBLE, MPI_COMM_WORLD);
}

/** Exchanges blocks with one rank after the other, in pieces: this takes little memory besides x.
 */
static void exchange(void *context, double *x, size_t count)
{
    const hd_communicator *c = context;
    for (int step = 0; step < c->ranks; step++) {
        const int other = (step - c->rank + c->ranks) % c->ranks;
        double *block = x + (size_t)other * count;
        if (other == c->rank) continue;
        for (size_t at = 0; at < count; at += PIECE) {
            const int piece = (int)(count - at < PIECE ? count - at : PIECE);
            MPI_Sendrecv_replace(block + at, piece, MPI_DOUBLE, other, 0, other, 0, MPI_COMM_WORLD,
                                 MPI_STATUS_IGNORE);
        }
    }
}

static void broadcast(void *context, void *x, size_t bytes)
{
    (void)context;
    for (size_t at = 0; at < bytes;) {
        const int piece = as_count(bytes - at);
        MPI_Bcast((char *)x + at, piece, MPI_BYTE, 0, MPI_COMM_WORLD);
        at += (size_t)piece;
    }
}

static const hd_transport transport = {sum, gather, exchange, broadcast};

static int ranks_beside(void)
{
    MPI_Comm machine;
    int ranks;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &ranks);
    MPI_Comm_free(&machine);
    return ranks;
}

static hd_status refuse(char *message, size_t size, const char *line)
{
    if (message && size > 0) snprintf(message, size, "%s", line);
    return HD_REFUSED;
}

/** Refuses a single rank if the environment says that several were started. */
static hd_status alone(char *message, size_t size)
{
    char library[MPI_MAX_LIBRARY_VERSION_STRING] = "", line[MPI_MAX_LIBRARY_VERSION_STRING + 256];
    const char *variable;
    int length;
    const int started = hd_ranks_started(&variable);
    if (started == 1) return HD_OK;
    MPI_Get_library_version(library, &length);
    library[strcspn(library, ",\n")] = '\0';
    snprintf(
        line, sizeof line,
        "%s = %d, but %s, which is loaded, finds a single rank: start it by the mpirun of that "
        "MPI, or unset %s for one process alone",
        variable, started, library, variable);
    return refuse(message, size, line);
}

hd_status hd_mpi_begin(hd_communicator **out, int *argc, char ***argv, char *message, size_t size)
{
    int provided;
    hd_status status = HD_OK;
    hd_communicator *c = calloc(1, sizeof *c);
    *out = NULL;
    if (!c) return HD_NO_MEMORY;
    MPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &c->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &c->ranks);
    if (provided < MPI_THREAD_SERIALIZED)
        status = refuse(message, size, "this MPI cannot be called by several threads");
    else if (c->ranks == 1)
        status = alone(message, size);
    if (status != HD_OK) MPI_Finalize();
    if (status != HD_OK || c->ranks == 1) {
        free(c);
        return status;
    }
    c->beside = ranks_beside();
    c->transport = &transport;
    c->context = c;
    *out = c;
    return HD_OK;
}

void hd_mpi_end(hd_communicator *c)
{
    MPI_Finalize();
    free(c);
}
