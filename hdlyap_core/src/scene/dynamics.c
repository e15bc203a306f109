/** The table of what can move. */
#include "scene/dynamics.h"

static const hd_dynamics *const rows[] = {
    [HD_DISKS] = &hd_hard_disks, [HD_SPHERES] = &hd_hard_spheres};

const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene)
{
    return scene->dynamics ? scene->dynamics : rows[scene->particles];
}
