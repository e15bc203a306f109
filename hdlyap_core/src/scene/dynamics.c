/** The table of what can move. */
#include "scene/dynamics.h"

#if HD_DIM == 2
static const hd_dynamics *const rows[] = {&hd_hard_disks};
#else
static const hd_dynamics *const rows[] = {&hd_hard_spheres};
#endif

const hd_dynamics *hd_dynamics_of(const hd_scene_def *scene)
{
    return scene->dynamics ? scene->dynamics : rows[0];
}
