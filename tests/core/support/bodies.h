/** The state of hard bodies, looked into. */
#ifndef TEST_BODIES_H
#define TEST_BODIES_H

#include "dynamics/hard/hard.h"
#include "dynamics/trajectory.h"

static inline hard *hard_in(const hd_trajectory *trajectory) { return trajectory->state; }

static inline void box_around(const hd_trajectory *trajectory, double *box)
{
    for (int d = 0; d < HD_DIM; d++) box[d] = hard_in(trajectory)->motion.cells.box[d];
}

#endif
