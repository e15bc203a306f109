/** The table of dynamics: particles that can move. */
#include "scene/dynamics.h"

#include <string.h>

static const hd_dynamics *const rows[] = {[HD_DISKS] = &hd_hard_disks,
                                          [HD_SPHERES] = &hd_hard_spheres,
                                          [HD_DUMBBELLS] = &hd_dumbbells_row,
                                          [HD_SOFT_DISKS] = &hd_soft_disks,
                                          [HD_SOFT_SPHERES] = &hd_soft_spheres};

const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene)
{
    const unsigned k = (unsigned)scene->particles; /* it may not be checked yet */
    return scene->dynamics ? scene->dynamics : rows[k < sizeof rows / sizeof *rows ? k : 0];
}

bool hd_dynamics_named(const hd_dynamics **out, const char *particles, hd_known known)
{
    *out = NULL;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        if (strcmp(rows[k]->particles, particles) == 0) return true;
    for (int k = 0; k < known.count && !*out; k++)
        if (hd_dynamics_check(known.row[k], NULL, 0) == HD_OK &&
            strcmp(known.row[k]->particles, particles) == 0)
            *out = known.row[k];
    return *out;
}
