/** When two dumbbells meet, or one meets a wall. These are pure functions of the states and the
 * image: their bits do not depend on when and in which order contacts are computed. */
#ifndef HD_MEETING_H
#define HD_MEETING_H

#include <float.h>

#include "dynamics/dumbbells/molecules.h"

/** The time at which dumbbell a meets this image of dumbbell b, a < b; INFINITY if they never meet,
 * or later than `until`. which: the disk of a plus twice the disk of b. */
double hd_meeting_of_pair(const hd_molecules *m, int32_t a, int32_t b, const int32_t image[2],
                          double until, int32_t *which);

/** The time at which dumbbell i meets a wall in direction d, likewise. which: the disk, plus 2 if
 * it meets the far wall. */
double hd_meeting_of_wall(const hd_molecules *m, int32_t i, int d, double until, int32_t *which);

/** The deepest overlap [sigma] that rounding can cause when two dumbbells, or one and a wall, meet.
 * turning: sum of the absolute angular velocities. */
static inline double hd_meeting_depth(const hd_molecules *m, double turning)
{
    return m->rounding + 4.0 * DBL_EPSILON * m->shape.arm * turning * m->hard.epoch_length;
}

#endif
