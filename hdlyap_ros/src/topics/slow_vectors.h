/** The run between two orthonormalisations -> ~slow_vectors, so many times a second of wall time
 * while somebody listens: what that topic does beside being published after a step. */
#ifndef HDLYAP_SLOW_VECTORS_H
#define HDLYAP_SLOW_VECTORS_H

#include "topics/moment.h"

/** Tells the run which vectors the next step is to end with. */
void slow_vectors_demand(slow_vectors_pace *pace, const publishers *out, const settings *set,
                         hd_run *run);

/** Publishes a run that will stand still, unless that has just been done: who comes while it does
 * gets this message. HD_NOT_FINITE. */
HD_MUST_CHECK hd_status slow_vectors_rest(const moment *now);

#endif
