/** Scene -> sizes and masses of its particles. + - * / sqrt only: the start of the trajectory
 * follows. */
#include "scene/kinds.h"

#include <math.h>

#include "hdlyap/dynamics.h"

int hd_scene_kinds(const hd_scene_def *def, hd_kind *kind)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    kind[0] = (hd_kind){def->number, 1.0, 1.0};
    return of->kinds ? of->kinds(def, kind) : 1;
}

hd_kinds hd_kinds_of(const hd_scene_def *def)
{
    hd_kinds kinds = {.root = {1.0, 1.0}};
    kinds.count = hd_scene_kinds(def, kinds.kind);
    for (int k = 0; k < kinds.count; k++) kinds.root[k] = sqrt(kinds.kind[k].mass);
    return kinds;
}

double hd_scene_root_mass(const hd_scene_def *def, int particle)
{
    const hd_kinds kinds = hd_kinds_of(def);
    return hd_kinds_root(&kinds, particle);
}

double hd_kinds_largest(const hd_scene_def *def)
{
    const hd_kinds kinds = hd_kinds_of(def);
    return fmax(kinds.kind[0].diameter, kinds.kind[kinds.count - 1].diameter);
}
