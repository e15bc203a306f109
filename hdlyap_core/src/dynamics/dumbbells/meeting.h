/** When two molecules meet, or one meets a wall: pure functions of states and image, the same bits
 * whoever asks, and whenever. */
#ifndef HD_MEETING_H
#define HD_MEETING_H

#include <float.h>

#include "dynamics/dumbbells/molecules.h"

/** Time at which molecule a meets the image of molecule b, a < b, or INFINITY if that is never, or
 * later than `until`. which: disk of a, and twice the disk of b. */
double hd_meeting_of_pair(const hd_molecules *m, int32_t a, int32_t b, const int32_t image[2],
                          double until, int32_t *which);

/** The same of a wall across direction d. which: disk, and 2 for the far wall. */
double hd_meeting_of_wall(const hd_molecules *m, int32_t i, int d, double until, int32_t *which);

/** Deeper than this [sigma] no rounding lets two molecules, or one and a wall, meet. */
static inline double hd_meeting_depth(const hd_molecules *m, double turning)
{
    return m->rounding + 4.0 * DBL_EPSILON * m->shape.arm * turning * m->hard.epoch_length;
}

#endif
