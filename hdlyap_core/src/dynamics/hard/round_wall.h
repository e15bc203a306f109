/** A curved wall: when a disk reaches it, and how it goes on [T21]. Only + - * / sqrt. */
#ifndef HD_ROUND_WALL_H
#define HD_ROUND_WALL_H

#include "dynamics/hard/disk.h"
#include "dynamics/hard/event.h"
#include "scene/container.h"

/** When the disk reaches the wall; INFINITY if it rests. */
static inline double hd_round_wall_time(const hd_wall *wall, const hd_disk *disk)
{
    return disk->t + wall->wait(wall, disk->q, disk->p);
}

/** Reflects a disk that has come to the wall, and fills n, p and j of its event. False, and there
 * is no event, if within rounding it does not go outwards. */
bool hd_round_wall_reflect(const hd_wall *wall, hd_disk *disk, hd_event *event);

#endif
