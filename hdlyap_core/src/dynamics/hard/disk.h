/** The state of one disk between its events: one cache line, of a sphere somewhat more. */
#ifndef HD_DISK_H
#define HD_DISK_H

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

#endif
