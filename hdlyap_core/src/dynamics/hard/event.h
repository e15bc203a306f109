/** An event of hard particles, which is an entry of their record. */
#ifndef HD_EVENT_H
#define HD_EVENT_H

#include "dynamics/hard/compiled.h"
#include "dynamics/record.h"
#include "hdlyap/scene.h"

/** hd_event.j of a wall event: HD_WALL_X, HD_WALL_Y or, for spheres, HD_WALL_Z by the direction of
 * the wall's normal, or HD_WALL_ROUND for a curved wall. */
enum { HD_WALL_X = -1, HD_WALL_Y = -2, HD_WALL_Z = -3, HD_WALL_ROUND = -1 - HD_DIM };
/** hd_event.j of a flat wall with a rule of its own (hd_ends.meet), by its hd_boundary and the
 * direction of its normal; and these from j. */
#define HD_WALL_RULED(boundary, d)                                                                 \
    (HD_WALL_ROUND - 1 - HD_DIM * ((int)(boundary)-HD_SHEARING) - (d))
#define HD_WALL_ENDS(j) ((hd_boundary)(HD_SHEARING + (HD_WALL_ROUND - 1 - (j)) / HD_DIM))
#define HD_WALL_ACROSS(j) ((HD_WALL_ROUND - 1 - (j)) % HD_DIM)

/** Events and their order in the record fix the tangent map [T3]; nothing else is needed. They are
 * ordered by time. At the same time pairs come before flat walls, then i and j decide; a disk meets
 * other disks before the round wall; in a corner it meets the x wall, then the y wall, then the z
 * wall; and if a pair meets through two images, the lower image in z comes first, then in y, then
 * in x. */
typedef struct hd_event {
    double t;    /**< since the start of the record [time units] */
    double i, j; /**< disk, 0-based, i < j for a pair; other disk, or HD_WALL_*: whole numbers, kept
                    as doubles as all else is */
    /** Unit vector from i to j at contact. For a flat wall it is the unit vector of its direction;
     * for a round wall the outward normal times the radius of curvature; for a wall with a rule of
     * its own what the rule has told (hd_ends). */
    double n[HD_DIM];
    double p[HD_DIM]; /**< p_j - p_i before the collision; for a wall, p_i before the collision;
                         momenta over mass, as all p of disks of two kinds in this folder */
} hd_event;

/** Returns NULL, or what is wrong with the events, which are finite numbers in the order of time: a
 * disk or a wall that does not exist, a normal of the wrong length, or disks that do not approach.
 */
const char *hd_events_fault(const hd_record *record, const hd_scene_def *scene);
/** Bytes of this many events: in the record, which doubles when it is full, and as tangent maps. */
double hd_events_bytes(double events);

#endif
