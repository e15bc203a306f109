/** The run between two orthonormalisations -> ~slow_vectors, so many times a second of wall time
 * while somebody listens. Owns that topic. */
#ifndef HDLYAP_SLOW_VECTORS_REPORT_H
#define HDLYAP_SLOW_VECTORS_REPORT_H

#include "publishers.h"
#include "settings.h"
#include "snapshot.h"

typedef struct slow_vectors_report slow_vectors_report;

/** Advertises ~slow_vectors. All live longer. HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status slow_vectors_report_create(slow_vectors_report **out, hdr_node *ros,
                                                     const publishers *to, const settings *set,
                                                     const hd_run *run);
void slow_vectors_report_free(slow_vectors_report *r);

/** True while somebody listens. */
bool slow_vectors_report_watched(const slow_vectors_report *r);

/** Tells the run which vectors the next step is to end with. */
void slow_vectors_report_demand(slow_vectors_report *r, hd_run *run);

/** Publishes the run as it is after a step, if it is time to. HD_NOT_FINITE, and nothing is
 * published, if a number is not; what is not sent for want of memory is only logged. */
HD_MUST_CHECK hd_status slow_vectors_report_publish(slow_vectors_report *r, const hd_run *run);

/** Publishes a run that will stand still, unless that has just been done: who comes while it does
 * gets this message. */
HD_MUST_CHECK hd_status slow_vectors_report_rest(slow_vectors_report *r, const hd_run *run);

#endif
