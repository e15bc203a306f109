/** The earliest event of each molecule, from the states of its neighbours. */
#ifndef HD_NEXT_H
#define HD_NEXT_H

#include "dynamics/dumbbells/molecules.h"

/** Predicts all that molecule i can meet, from its present state, and hands the earliest to the
 * queue. A contact later than the one that its partner knows of is left out: the partner looks
 * again then. */
void hd_next_renew(hd_molecules *m, int32_t i);

/** Predicts what has newly come into reach of molecule i, which has crossed the edge of its cell in
 * direction d to that side. */
void hd_next_extend(hd_molecules *m, int32_t i, int d, int side);

/** Of all; nothing that was predicted before holds. */
void hd_next_restart(hd_molecules *m);

#endif
