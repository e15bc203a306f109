/** What the two ends of a direction are. Each has a row; callers know rows alone. A wall with a
 * rule of its own is a file with its row. */
#ifndef HD_ENDS_H
#define HD_ENDS_H

#include <stdbool.h>

#include "hdlyap/scene.h"

/** The tangent map of a flat wall across direction d, for particles in the plane [T27], with `a`
 * the other direction: dq_a += slip dq_d, dq_d *= rebound, and (dp_a, dp_d) = turn (dp_a, dp_d). */
typedef struct hd_wall_map {
    double slip, rebound, turn[2][2];
} hd_wall_map;

/** Its functions decide events: only + - * / sqrt. Vectors have a component for each direction. */
typedef struct hd_ends {
    const char *word;
    bool is_wall;    /**< a flat wall, which rims touch */
    bool symplectic; /**< its tangent maps are */
    bool drags;      /**< it changes the momentum along it, too */
    /** A particle meets the wall across direction d with momentum p, which becomes that after it;
     * `told` is what the tangent map needs beside p. Returns by which factor phase space shrinks or
     * grows, whose logarithm is summed. NULL: component d of p changes sign [T4]. */
    double (*meet)(const hd_scene_def *scene, double *p, double *told, int d);
    /** The tangent map of that event, from the momentum p before it. */
    hd_wall_map (*map)(const double *p, const double *told, int d);
    /** What is wrong with `told`, or NULL. */
    const char *(*fault)(const double *told);
} hd_ends;

#define HD_ENDS_ROW(NAME, name, what) extern const hd_ends hd_##name##_ends;
HD_BOUNDARIES(HD_ENDS_ROW)
#undef HD_ENDS_ROW

const hd_ends *hd_ends_of(hd_boundary boundary);

/** Whether it is a flat wall. */
static inline bool hd_is_wall(hd_boundary boundary) { return hd_ends_of(boundary)->is_wall; }

/** Whether walls drag along direction d, so that momentum along it is not conserved. */
bool hd_ends_drag(const hd_scene_def *def, int d);

#endif
