/** The state of one disk between its events: one cache line, of a sphere somewhat more. */
#ifndef HD_DISK_H
#define HD_DISK_H

#include <float.h>
#include <math.h>
#include <stdint.h>

#include "dynamics/hard/compiled.h"
#include "hdlyap/scene.h"

/** Deeper than this [sigma], an overlap is a fault and not rounding; in boxes whose coordinates
 * round by more it is hd_trajectory_overlap_rounding. */
#define HD_OVERLAP_MAX 1e-9

/** q and p are those of time t (of the present epoch) and stay untouched until the disk's next
 * collision: what is predicted from them does not depend on when it is predicted. */
typedef struct hd_disk {
    double q[HD_DIM]; /**< where it was at t; may have drifted out of the box since */
    double p[HD_DIM];
    double t;
    int32_t wrap[HD_DIM]; /**< box edges to subtract from its present position to be in its cell */
    int32_t cell[HD_DIM]; /**< column, row, of spheres layer */
    uint32_t collisions;  /**< changes whenever q, p, t do; tells stale predictions */
} hd_disk;

static inline void hd_disk_move_to(hd_disk *disk, double t)
{
    for (int d = 0; d < HD_DIM; d++) disk->q[d] += disk->p[d] * (t - disk->t);
    disk->t = t;
}

/** Time is counted in epochs: a power of two that holds about 32 to 64 collisions of a disk; in a
 * thin gas less, so that no flight is so long that its rounding comes near HD_OVERLAP_MAX. */
static inline double hd_epoch_length(double rate_per_disk)
{
    const double wanted = fmin(32.0 / rate_per_disk, 16384.0);
    double length = 1.0;
    while (length < wanted) length *= 2.0;
    while (length * 0.5 >= wanted) length *= 0.5;
    return length;
}

/** See hd_examined; of the longest edge of the box. */
static inline double hd_overlap_rounding(double longest, double epoch_length)
{
    const double speed_max = 16.0; /* of two disks; the mean square of a momentum is 2 */
    /* of eps, on the way to a contact: each coordinate of either disk is folded, flown, shifted and
     * subtracted, some ten times eps/2 in all, and rounding of the time moves them as much */
    const double roundings = 16.0;
    return roundings * DBL_EPSILON * (longest + speed_max * epoch_length);
}

#endif
