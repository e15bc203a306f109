/** How several processes (ranks) that carry one run exchange data. All ranks make the same calls in
 * the same order. Each carries its own columns of the frame; everything else is computed by all
 * alike. hdlyap/mpi.h makes a communicator; without one (NULL) a run has one rank. On each rank one
 * thread at a time calls. */
#ifndef HDLYAP_COMMUNICATOR_H
#define HDLYAP_COMMUNICATOR_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_communicator hd_communicator;

typedef enum hd_call { HD_CALL_SUM, HD_CALL_GATHER, HD_CALL_EXCHANGE, HD_CALL_BROADCAST } hd_call;
enum { HD_CALLS = 4 };

/** What this rank has exchanged by one kind of call. */
typedef struct hd_traffic {
    double calls;
    double bytes;   /**< bytes summed or broadcast, or sent from this rank to the others */
    double seconds; /**< wall seconds, with waiting */
} hd_traffic;

/** The functions that exchange data. All ranks call them together; the results are the same on all
 * ranks, bit for bit, except those of `exchange`. */
typedef struct hd_transport {
    /** Replaces x[count] by its sum over all ranks. */
    void (*sum)(void *context, double *x, size_t count);
    /** x[ranks * count]: each rank has filled its own count entries, and receives all others. */
    void (*gather)(void *context, double *x, size_t count);
    /** x[ranks * count]: the count entries at r * count go to rank r, and are replaced by those
     * that it sends. */
    void (*exchange)(void *context, double *x, size_t count);
    /** Replaces x[bytes] by the x of rank 0. */
    void (*broadcast)(void *context, void *x, size_t bytes);
} hd_transport;

struct hd_communicator {
    int rank, ranks;
    int beside; /**< number of ranks on this machine, with this one */
    int leads;  /**< not 0: the other ranks repeat the calls of this one (follow.h) */
    const hd_transport *transport;
    void *context;
    hd_traffic traffic[HD_CALLS];
};

/** Number of ranks that were started, from the environment variable of the program that started
 * them, whose name goes to *variable; 1 and NULL if there is no such variable. */
int hd_ranks_started(const char **variable);

HD_API_END
#endif
