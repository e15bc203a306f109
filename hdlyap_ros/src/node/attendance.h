/** Whether those are there who are to hear a run from its first message on. */
#ifndef HDLYAP_ATTENDANCE_H
#define HDLYAP_ATTENDANCE_H

#include "outlets.h"

/** Zero before the first look. */
typedef struct attendance {
    double until;  /**< wall time at which waiting ends; 0 while a topic has no subscriber */
    double next;   /**< wall time before which the master is not asked again */
    bool complete; /**< when it was last asked */
} attendance;

/** A look, to be repeated: true once each topic of the set has a subscriber and, besides, all that
 * the master knows of are connected. Those are not waited for longer than a few seconds, nor if the
 * master does not answer; a warning says so. A look takes as long as the answer of the master,
 * within these seconds. */
bool attendance_complete(attendance *a, const outlets *out, unsigned awaited);

#endif
