/** Everything that is wrong with a run now -> one level and one message. */
#ifndef HDLYAP_CONDITIONS_H
#define HDLYAP_CONDITIONS_H

#include "worker.h"

typedef struct conditions {
    uint8_t level;      /**< HDR_DIAGNOSTIC_* of the worst condition */
    char message[1024]; /**< names all conditions, the worst first; "" if there is none */
} conditions;

/** Size of a line on time steps that are too long. */
enum { CONDITION_STEP = 160 };
void split_write(char text[CONDITION_STEP], const split_zeros *split);
/** True if the energy has been off by more than the scene asks for; writes the line about it. */
bool energy_write(char text[CONDITION_STEP], const hd_energy *energy);

/** Finds all conditions; doc/reference.md lists them with their levels. */
conditions conditions_of(const worker_state *state, const hdr_lag *slowest);

#endif
