/** The node's diagnostics: worker state -> /diagnostics, once per second. */
#ifndef HDLYAP_DIAGNOSTICS_H
#define HDLYAP_DIAGNOSTICS_H

#include "hdlyap_ros/publisher.h"
#include "worker.h"

typedef struct diagnostics {
    hdr_publisher *publisher;
    const report *rep;
    const char *node_name, *blas_kernel;
    double next;         /**< when to publish again [s of clock_seconds] */
    double measured;     /**< when `collisions` was read [s of clock_seconds] */
    uint64_t collisions; /**< number of collisions at the last message */
} diagnostics;

/** Advertises /diagnostics. The report and the string must live as long as d. */
HDR_MUST_CHECK hdr_status diagnostics_advertise(diagnostics *d, hdr_node *ros, const report *rep,
                                                uint64_t collisions, const char *blas_kernel);

/** Publishes if anybody listens and a second has passed since the last time; true if so. */
bool diagnostics_update(diagnostics *d, const worker_state *state);
/** Publishes now, if anybody listens; true if so. */
bool diagnostics_publish(diagnostics *d, const worker_state *state);

#endif
