/** The topic ~slow_vectors, which shows the run several times per second of wall time while
 * somebody listens. topic_publish_slow_vectors publishes it after a step; here is what it does
 * besides. */
#ifndef HDLYAP_SLOW_VECTORS_H
#define HDLYAP_SLOW_VECTORS_H

#include "topics/moment.h"

/** Tells the run how long the next step may be, and keeps whether a message is due after it. */
void slow_vectors_demand(slow_vectors_pace *pace, const publishers *out, const settings *set,
                         hd_run *run);
/** The first vector that the message after this step needs; the number of vectors if it needs none.
 */
int slow_vectors_first(const slow_vectors_pace *pace, const settings *set, const hd_run *run);

/** Publishes a run that will stand still, unless that has just been done. Subscribers that come
 * meanwhile get this message. Fails with HD_NOT_FINITE. */
HD_MUST_CHECK hd_status slow_vectors_rest(const moment *now);

#endif
