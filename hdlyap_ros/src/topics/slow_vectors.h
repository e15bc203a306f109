/** The topic ~slow_vectors, which shows the run several times per second of wall time while
 * somebody listens. topic_publish_slow_vectors publishes it after a step; here is what it does
 * besides. */
#ifndef HDLYAP_SLOW_VECTORS_H
#define HDLYAP_SLOW_VECTORS_H

#include "topics/moment.h"

/** Tells the run which vectors have to be known at the end of the next step. */
void slow_vectors_demand(slow_vectors_pace *pace, const publishers *out, const settings *set,
                         hd_run *run);

/** Publishes a run that will stand still, unless that has just been done. Subscribers that come
 * meanwhile get this message. Fails with HD_NOT_FINITE. */
HD_MUST_CHECK hd_status slow_vectors_rest(const moment *now);

#endif
