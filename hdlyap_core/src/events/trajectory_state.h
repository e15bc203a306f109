/** What a trajectory holds, for the files that make it up: trajectory.c and trajectory_archive.c.
 */
#ifndef HD_TRAJECTORY_STATE_H
#define HD_TRAJECTORY_STATE_H

#include "events/disk.h"
#include "events/prediction.h"
#include "hdlyap/trajectory.h"

struct hd_trajectory {
    hd_motion motion;
    double rate; /**< expected pair events per time unit */
    double epoch_length;
    double overlap_max; /**< see hd_trajectory_overlap_max */
    double epoch_start; /**< simulated time, a multiple of epoch_length */
    double now;         /**< simulated time */
    uint64_t collisions, wall_events;
    double virial[HD_DIM]; /**< of the collisions */
};

#endif
