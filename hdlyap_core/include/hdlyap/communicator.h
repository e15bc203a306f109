/** How several processes (ranks), numbered from 0, that carry one run together exchange data. All
 * ranks make the same calls in the same order. Each carries some of the vectors of the frame; each
 * computes everything else, alike. hd_mpi_begin (hdlyap/mpi.h) makes a communicator from MPI, or a
 * program fills an hd_communicator with functions of its own. Where a function takes a
 * communicator, NULL means a single rank. On each rank, one thread at a time may use it. */
#ifndef HDLYAP_COMMUNICATOR_H
#define HDLYAP_COMMUNICATOR_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

/** What connects this rank to the others. Whoever makes it fills its members; all of `traffic` is 0
 * at first. */
typedef struct hd_communicator hd_communicator;

/** The kinds of exchange, one for each function of hd_transport. */
typedef enum hd_call { HD_CALL_SUM, HD_CALL_GATHER, HD_CALL_EXCHANGE, HD_CALL_BROADCAST } hd_call;
enum { HD_CALLS = 4 };

/** What this rank has exchanged so far by one kind of call. */
typedef struct hd_traffic {
    double calls; /**< number of calls */
    double bytes; /**< bytes of the arrays that were summed or broadcast, or that this rank sent to
                     the others */
    double seconds; /**< wall seconds in these calls, including the time spent waiting for other
                       ranks */
} hd_traffic;

/** The functions that exchange data. All ranks call them together, with `context` from
 * hd_communicator. Their results are the same on all ranks, bit for bit, except for `exchange`. */
typedef struct hd_transport {
    /** Replaces x[count] on each rank by the sum of the x[count] of all ranks. */
    void (*sum)(void *context, double *x, size_t count);
    /** Fills x[ranks * count] on each rank. Rank r has put its own count numbers at x[r * count];
     * afterwards each rank has the numbers of all. */
    void (*gather)(void *context, double *x, size_t count);
    /** Swaps parts of x[ranks * count]: rank s sends the count numbers at x[r * count] to rank r,
     * and receives in their place the count numbers that rank r had at its x[s * count]. */
    void (*exchange)(void *context, double *x, size_t count);
    /** Replaces x[bytes] on each rank by the x[bytes] of rank 0. */
    void (*broadcast)(void *context, void *x, size_t bytes);
} hd_transport;

struct hd_communicator {
    /** Number of this rank, 0 .. ranks - 1; and number of all ranks. */
    int rank, ranks;
    int beside; /**< number of ranks on this machine, including this one */
    int leads;  /**< not 0 on rank 0 after hd_run_lead (hdlyap/follow.h): other ranks repeat its
                   calls */
    const hd_transport *transport;
    void *context;
    /** What this rank has exchanged by each kind of call, in the order of hd_call. */
    hd_traffic traffic[HD_CALLS];
};

/** Number of ranks that a program such as mpirun has started together, from an environment variable
 * that it sets. *variable becomes the name of this variable. Returns 1, and NULL in *variable, if
 * there is none. */
int hd_ranks_started(const char **variable);

HD_API_END
#endif
