/** An event of hard bodies: an entry of their record. */
#ifndef HD_EVENT_H
#define HD_EVENT_H

#include <stdint.h>

#include "dynamics/hard/compiled.h"
#include "hdlyap/scene.h"
#include "dynamics/trajectory.h"

/** hd_event.j of a wall event: HD_WALL_X, HD_WALL_Y or of spheres HD_WALL_Z (the direction of the
 * wall's normal), or HD_WALL_ROUND. */
enum { HD_WALL_X = -1, HD_WALL_Y = -2, HD_WALL_Z = -3, HD_WALL_ROUND = -1 - HD_DIM };

/** Self-contained: with the order of the events in the record it fixes the tangent map [T3]. That
 * order is: time, pairs before flat walls, i, j; of one disk pairs before the round wall; in a
 * corner the x wall before the y wall before the z wall; one pair through two images at once: the
 * lower image in z, then in y, then in x. */
typedef struct hd_event {
    double t;  /**< since the start of the record [time units] */
    int32_t i; /**< disk, 0-based; i < j for a pair */
    int32_t j; /**< other disk, or HD_WALL_* */
    /** Unit vector from i to j at contact; for a wall its axis, for a round one the outward normal
     * as long as the radius of its curvature. */
    double n[HD_DIM];
    double p[HD_DIM]; /**< p_j - p_i before the collision; for a wall the momentum before it */
} hd_event;

#endif
