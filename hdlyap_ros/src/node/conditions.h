/** Everything that is wrong with a run now -> one level and one message. */
#ifndef HDLYAP_CONDITIONS_H
#define HDLYAP_CONDITIONS_H

#include "worker.h"

typedef struct conditions {
    uint8_t level;      /**< HDR_DIAGNOSTIC_* of the worst condition */
    char message[1024]; /**< names all conditions, the worst first; "" if there is none */
} conditions;

/** Size of the line on steps in time that are too long, which names a step that would do. */
enum { CONDITION_SPLIT = 160 };
void split_write(char *text, size_t size, const split_zeros *split);

/** Finds all conditions; doc/reference.md lists them with their levels. */
conditions conditions_of(const worker_state *state, const hdr_lag *slowest);

#endif
