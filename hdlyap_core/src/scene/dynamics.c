/** The table of dynamics: particles that can move. */
#include "scene/dynamics.h"

#include <string.h>

#define ROW(NAME, name, what) &hd_##name##_row,
static const hd_dynamics *const rows[HD_PARTICLES_END] = {HD_PARTICLES_ALL(ROW)};
#undef ROW

/** Whether not all particles have diameter 1 and mass 1, as they have in most scenes. */
static bool has_kinds(const hd_dynamics *row, const hd_scene_def *scene)
{
    hd_kind kind[HD_KINDS_MAX];
    return row->kinds(scene, kind) > 1 || kind[0].diameter != 1 || kind[0].mass != 1;
}

const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene)
{
    const unsigned k = (unsigned)scene->particles; /* it may not be checked yet */
    const hd_dynamics *row = scene->dynamics ? scene->dynamics : rows[k < HD_PARTICLES_END ? k : 0];
    return row->mixture && row->kinds && has_kinds(row, scene) ? row->mixture : row;
}

bool hd_dynamics_named(const hd_dynamics **out, const char *particles, hd_known known)
{
    *out = NULL;
    for (size_t k = 0; k < HD_PARTICLES_END; k++)
        if (strcmp(rows[k]->particles, particles) == 0) return true;
    for (int k = 0; k < known.count && !*out; k++)
        if (hd_dynamics_check(known.row[k], NULL, 0) == HD_OK &&
            strcmp(known.row[k]->particles, particles) == 0)
            *out = known.row[k];
    return *out;
}
