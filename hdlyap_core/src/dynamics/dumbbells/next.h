/** The earliest event of each dumbbell, from the states of its neighbours. */
#ifndef HD_NEXT_H
#define HD_NEXT_H

#include "dynamics/dumbbells/molecules.h"

/** Predicts all events of dumbbell i from its present state, and puts the earliest into the queue.
 * A contact later than the one that the partner has predicted is left out, because the partner will
 * predict anew then. */
void hd_next_renew(hd_molecules *m, int32_t i);

/** Does what hd_prediction_extend does, for a dumbbell. */
void hd_next_extend(hd_molecules *m, int32_t i, int d, int side);

/** Predicts the events of all dumbbells, and forgets all earlier predictions. */
void hd_next_restart(hd_molecules *m);

#endif
