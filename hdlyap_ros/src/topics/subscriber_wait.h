/** Waits for subscribers that shall get all messages of a run from the first one on. */
#ifndef HDLYAP_SUBSCRIBER_WAIT_H
#define HDLYAP_SUBSCRIBER_WAIT_H

#include "topics/publishers.h"

/** Zero before the first look. */
typedef struct subscriber_wait {
    double until;  /**< wall time at which waiting ends; 0 while a topic has no subscriber */
    double next;   /**< wall time before which the master is not asked again */
    double say;    /**< wall time of the next line that says who is missing; 0: none so far */
    bool complete; /**< nobody was missing when the master was last asked */
} subscriber_wait;

/** Checks who is there; to be called again and again. Returns true once each topic of the set has a
 * subscriber and all subscribers that the master knows are connected. For the latter it waits only
 * a few seconds, and not at all if the master does not answer; a warning says so. Logs at once and
 * then now and then who is missing. A call takes as long as the master's answer, within these
 * seconds. */
bool subscriber_wait_over(subscriber_wait *a, const publishers *out, unsigned awaited);

#endif
