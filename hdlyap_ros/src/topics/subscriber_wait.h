/** Whether those are there who are to hear a run from its first message on. */
#ifndef HDLYAP_SUBSCRIBER_WAIT_H
#define HDLYAP_SUBSCRIBER_WAIT_H

#include "topics/publishers.h"

/** Zero before the first look. */
typedef struct subscriber_wait {
    double until;  /**< wall time at which waiting ends; 0 while a topic has no subscriber */
    double next;   /**< wall time before which the master is not asked again */
    double say;    /**< wall time before which it is not said again who is missing; 0: not yet */
    bool complete; /**< when the master was last asked */
} subscriber_wait;

/** A look, to be repeated: true once each topic of the set has a subscriber and, besides, all that
 * the master knows of are connected. Those are not waited for longer than a few seconds, nor if the
 * master does not answer; a warning says so. Who is missing is said at once and then now and then.
 * A look takes as long as the answer of the master, within these seconds. */
bool subscriber_wait_over(subscriber_wait *a, const publishers *out, unsigned awaited);

#endif
