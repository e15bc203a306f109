/** The state of a disk, a sphere or the centre of a dumbbell between its events. All three are
 * called disks in this folder. For a disk it fills one cache line. */
#ifndef HD_DISK_H
#define HD_DISK_H

#include <float.h>
#include <math.h>
#include <stdint.h>

#include "dynamics/hard/compiled.h"
#include "hdlyap/scene.h"

/** An overlap deeper than this [sigma] is a fault and no rounding. In a box so long that its
 * coordinates round by more, the limit is hd_invariants.overlap_rounding instead. */
#define HD_OVERLAP_MAX 1e-9

/** q and p are the state at time t of the present epoch, and do not change until the disk's next
 * collision: so a prediction does not depend on when it is made. */
typedef struct hd_disk {
    double q[HD_DIM]; /**< position at t; the disk may have left the box since */
    double p[HD_DIM];
    double t;
    int32_t wrap[HD_DIM]; /**< box edges to subtract from its present position to be in its cell */
    int32_t cell[HD_DIM]; /**< column, row and, for spheres, layer */
    uint32_t size;        /**< its place in hd_sizes */
    uint32_t collisions;  /**< changes with q, p and t, so that stale predictions are recognised */
} hd_disk;

static inline void hd_disk_move_to(hd_disk *disk, double t)
{
    for (int d = 0; d < HD_DIM; d++) disk->q[d] += disk->p[d] * (t - disk->t);
    disk->t = t;
}

/** Time is counted in epochs. Their length is a power of two: about 32 to 64 collisions of a disk;
 * in a thin gas fewer, so that no flight is so long that it rounds by nearly HD_OVERLAP_MAX. */
static inline double hd_epoch_length(double rate_per_disk)
{
    const double wanted = fmin(32.0 / rate_per_disk, 16384.0);
    double length = 1.0;
    while (length < wanted) length *= 2.0;
    while (length * 0.5 >= wanted) length *= 0.5;
    return length;
}

/** hd_invariants.overlap_rounding of a box with this longest edge. */
static inline double hd_overlap_rounding(double longest, double epoch_length)
{
    const double speed_max = 16.0; /* relative speed of two disks; <p^2> is 2 */
    /* Roundings by eps until a contact: each coordinate of both disks is folded, flown, shifted and
     * subtracted, which is about ten times eps/2, and the time's rounding moves them as much. */
    const double roundings = 16.0;
    return roundings * DBL_EPSILON * (longest + speed_max * epoch_length);
}

#endif
