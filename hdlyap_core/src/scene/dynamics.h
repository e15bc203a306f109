/** The rows of dynamics that the core brings. */
#ifndef HD_DYNAMICS_ROWS_H
#define HD_DYNAMICS_ROWS_H

#include "hdlyap/dynamics.h"

extern const hd_dynamics hd_hard_disks, hd_hard_spheres, hd_dumbbells_row, hd_soft_disks,
    hd_soft_spheres;

/** Rows that a program adds to those of the core: row[count]. */
typedef struct hd_known {
    const hd_dynamics *const *row;
    int count;
} hd_known;

/** Finds the value of hd_scene_def.dynamics for the particles of this name; false if there are
 * none. */
bool hd_dynamics_named(const hd_dynamics **out, const char *particles, hd_known known);

#endif
