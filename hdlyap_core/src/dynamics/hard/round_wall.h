/** A round wall: when a disk reaches it, and how it goes on [T21]. Only + - * / sqrt. */
#ifndef HD_ROUND_WALL_H
#define HD_ROUND_WALL_H

#include <stdbool.h>

#include "dynamics/hard/disk.h"
#include "dynamics/hard/event.h"

/** Centres of disks stay within `reach` of (centre, centre); reach 0: there is no such wall. */
typedef struct hd_round_wall {
    double centre, reach;
} hd_round_wall;

hd_round_wall hd_round_wall_of(const hd_scene_def *def);

/** How far beyond the wall a disk is; negative inside. */
double hd_round_wall_excess(const hd_round_wall *wall, const double q[HD_DIM]);

/** When the disk reaches the wall; INFINITY if it rests. */
double hd_round_wall_time(const hd_round_wall *wall, const hd_disk *disk);

/** Reflects a disk that has come to the wall, and fills n, p and j of its event. False, and there
 * is no event, if within rounding it does not go outwards. */
bool hd_round_wall_reflect(const hd_round_wall *wall, hd_disk *disk, hd_event *event);

#endif
