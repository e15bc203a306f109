/** Several processes (ranks) that carry one run together: what they tell each other. All of them
 * make the same calls in the same order; each carries its columns of the frame, and all else is
 * computed by each alike. What a communicator does is in hdlyap/mpi.h; without one (NULL) a run has
 * one rank. Of each rank one thread at a time calls. */
#ifndef HDLYAP_COMMUNICATOR_H
#define HDLYAP_COMMUNICATOR_H

#include <stddef.h>

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_communicator hd_communicator;

typedef enum hd_call { HD_CALL_SUM, HD_CALL_GATHER, HD_CALL_EXCHANGE, HD_CALL_BROADCAST } hd_call;
enum { HD_CALLS = 4 };

/** Of one kind of call, on this rank. */
typedef struct hd_traffic {
    double calls;
    double bytes;   /**< of what is summed or broadcast; of what goes from here to the others */
    double seconds; /**< waiting included */
} hd_traffic;

/** How it is done; every function is called by all ranks together and gives all of them the same
 * bits, but for `exchange`. */
typedef struct hd_transport {
    /** x[count] <- its sum over all ranks */
    void (*sum)(void *context, double *x, size_t count);
    /** x[ranks * count]: each rank has filled its own count entries; then all have all of them */
    void (*gather)(void *context, double *x, size_t count);
    /** x[ranks * count]: entries r * count ... go to rank r, and those from there take their place
     */
    void (*exchange)(void *context, double *x, size_t count);
    /** x[bytes] <- that of rank 0 */
    void (*broadcast)(void *context, void *x, size_t bytes);
} hd_transport;

struct hd_communicator {
    int rank, ranks;
    int beside; /**< ranks on this machine, this one included */
    int leads;  /**< its calls of a run are told to the others (follow.h) */
    const hd_transport *transport;
    void *context;
    hd_traffic traffic[HD_CALLS];
};

/** How many ranks have been started, as what starts them says in the environment, and in which
 * variable; 1 and NULL: in none. */
int hd_ranks_started(const char **variable);

HD_API_END
#endif
