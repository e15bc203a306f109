/** The rows of dynamics that the core brings. */
#ifndef HD_DYNAMICS_ROWS_H
#define HD_DYNAMICS_ROWS_H

#include "hdlyap/dynamics.h"
#include "hdlyap/scene.h"

#define ROW(NAME, name, what) extern const hd_dynamics hd_##name##_row;
HD_PARTICLES_ALL(ROW)
#undef ROW

/** Rows that a program adds to those of the core: row[count]. */
typedef struct hd_known {
    const hd_dynamics *const *row;
    int count;
} hd_known;

/** Finds the value of hd_scene_def.dynamics for the particles of this name; false if there are
 * none. */
bool hd_dynamics_named(const hd_dynamics **out, const char *particles, hd_known known);

#endif
