/** A curved wall: when a disk reaches it, and how it is reflected [T21]. Computed with + - * / sqrt
 * only, so that all machines give the same bits. */
#ifndef HD_ROUND_WALL_H
#define HD_ROUND_WALL_H

#include "dynamics/hard/disk.h"
#include "dynamics/hard/event.h"
#include "scene/container.h"

/** The time at which the disk reaches the wall; INFINITY if it is at rest. */
static inline double hd_round_wall_time(const hd_wall *wall, const hd_disk *disk)
{
    return disk->t + wall->wait(wall, disk->q, disk->p);
}

/** Reflects a disk that is at the wall, and fills n, p and j of the event. Returns false, for no
 * event, if the disk, within rounding, does not move outwards. */
bool hd_round_wall_reflect(const hd_wall *wall, hd_disk *disk, hd_event *event);

#endif
