/** Particles of the core that start at given positions and momenta. */
#ifndef TEST_CREATE_FROM_H
#define TEST_CREATE_FROM_H

#include "base/check.h"
#include "dynamics/create_from.h"
#include "dynamics/trajectory.h"
#include "scene/dynamics.h"

/** As hd_trajectory_create, but with positions q inside the box (x0 y0 .. x1 y1 ..) and momenta p;
 * nothing is rescaled. */
static inline hd_status hd_trajectory_create_from(hd_trajectory **out, const hd_scene_def *def,
                                                  const double *q, const double *p)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    void *state;
    *out = NULL;
    HD_TRY((of == &hd_disks_row            ? hd_hard_create_from_2d
            : of == hd_disks_row.mixture   ? hd_hard_create_from_2d_mixed
            : of == &hd_spheres_row        ? hd_hard_create_from_3d
            : of == hd_spheres_row.mixture ? hd_hard_create_from_3d_mixed
            : of == &hd_dumbbells_row      ? hd_dumbbells_create_from
                                           : hd_soft_create_from)(&state, def, q, p));
    return hd_trajectory_create_with(out, def, state);
}

#endif
