/** What ranks exchange -> calls of the transport (MPI), which are counted. */
#include "base/communicator.h"

#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"

/** Rows that one exchange shares: the buffer has room for so many, not for all. */
enum { ROWS_AT_ONCE = 32 };

/** Knows the variables of Open MPI and of PMI and PMIx (MPICH, srun). The first one that is set
 * counts: mpirun may start one process within a step of srun. */
int hd_ranks_started(const char **variable)
{
    static const char *const sizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
    *variable = NULL;
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const char *text = getenv(sizes[k]);
        const int ranks = text ? atoi(text) : 0;
        if (ranks < 1) continue;
        *variable = sizes[k];
        return ranks;
    }
    return 1;
}

int hd_communicator_rank(const hd_communicator *c) { return c ? c->rank : 0; }
int hd_communicator_ranks(const hd_communicator *c) { return c ? c->ranks : 1; }

static void count(hd_communicator *c, hd_call kind, double start, double bytes)
{
    hd_traffic *of = &c->traffic[kind];
    of->calls++;
    of->bytes += bytes;
    of->seconds += hd_clock_now() - start;
}

hd_traffic hd_communicator_traffic(const hd_communicator *c)
{
    hd_traffic all = {0.0, 0.0, 0.0};
    for (int kind = 0; c && kind < HD_CALLS; kind++) {
        all.calls += c->traffic[kind].calls;
        all.bytes += c->traffic[kind].bytes;
        all.seconds += c->traffic[kind].seconds;
    }
    return all;
}

void hd_communicator_sum(hd_communicator *c, double *x, size_t size)
{
    if (hd_communicator_ranks(c) == 1) return;
    const double start = hd_clock_now();
    c->transport->sum(c->context, x, size);
    count(c, HD_CALL_SUM, start, (double)(size * sizeof *x));
}

static void gather(hd_communicator *c, double *x, size_t size)
{
    const double start = hd_clock_now();
    c->transport->gather(c->context, x, size);
    count(c, HD_CALL_GATHER, start, (double)(size * sizeof *x) * (c->ranks - 1));
}

void hd_communicator_exchange(hd_communicator *c, double *x, size_t size)
{
    if (hd_communicator_ranks(c) == 1) return;
    const double start = hd_clock_now();
    c->transport->exchange(c->context, x, size);
    count(c, HD_CALL_EXCHANGE, start, (double)(size * sizeof *x) * (c->ranks - 1));
}

void hd_communicator_broadcast(hd_communicator *c, void *x, size_t bytes)
{
    if (hd_communicator_ranks(c) == 1) return;
    const double start = hd_clock_now();
    c->transport->broadcast(c->context, x, bytes);
    count(c, HD_CALL_BROADCAST, start, (double)bytes);
}

/** Number of entries of a row that a rank fills. */
static size_t part_of(size_t rank, size_t width, size_t size)
{
    const size_t first = rank * width;
    return first >= size ? 0 : size - first < width ? size - first : width;
}

/** Copies a rank's entries of some rows into its place in the buffer `parts`, or out of it. */
static void pack(double *parts, double *x, size_t rank, size_t rows, hd_shared s, int out)
{
    const size_t part = part_of(rank, s.width, s.count);
    const size_t first = s.from_behind ? s.count - rank * s.width - part : rank * s.width;
    for (size_t row = 0; row < rows && part > 0; row++) {
        double *packed = parts + (rank * rows + row) * s.width, *place = x + row * s.stride + first;
        memcpy(out ? place : packed, out ? packed : place, part * sizeof *x);
    }
}

hd_status hd_communicator_share(hd_communicator *c, double *x, hd_shared s)
{
    const size_t ranks = (size_t)hd_communicator_ranks(c);
    if (ranks == 1) return HD_OK;
    const size_t most = s.rows < ROWS_AT_ONCE ? s.rows : ROWS_AT_ONCE;
    double *parts = hd_memory_alloc(ranks * most * s.width, sizeof *parts);
    const hd_status status = hd_communicator_agree(c, parts ? HD_OK : HD_NO_MEMORY);
    for (size_t row = 0; row < s.rows && status == HD_OK; row += most) {
        const size_t now = s.rows - row < most ? s.rows - row : most;
        double *here = x + row * s.stride;
        pack(parts, here, (size_t)c->rank, now, s, 0);
        gather(c, parts, now * s.width);
        for (size_t rank = 0; rank < ranks; rank++) pack(parts, here, rank, now, s, 1);
    }
    hd_memory_free(parts);
    return status;
}

hd_status hd_communicator_share_halves(hd_communicator *c, double *x, hd_shared carried, size_t all)
{
    hd_shared partners = carried;
    partners.from_behind = 1;
    const hd_status status = hd_communicator_share(c, x, carried);
    if (status != HD_OK || all == carried.count) return status;
    return hd_communicator_share(c, x + carried.count, partners);
}

hd_status hd_communicator_agree(hd_communicator *c, hd_status mine)
{
    const int ranks = hd_communicator_ranks(c);
    if (ranks == 1) return mine;
    double all[2] = {mine != HD_OK, 0.0};
    hd_communicator_sum(c, all, 1);
    if (all[0] == 0.0) return HD_OK;
    /* a failure is rare: find the first rank that failed, and its status */
    for (int rank = 0; rank < ranks && all[1] == 0.0; rank++) {
        all[1] = rank == c->rank ? (double)mine : 0.0;
        hd_communicator_sum(c, all + 1, 1);
    }
    return (hd_status)all[1];
}
