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

double hd_kinds_mean(const hd_scene_def *def)
{
    const hd_kinds kinds = hd_kinds_of(def);
    double sum = 0.0;
    for (int k = 0; k < kinds.count; k++) sum += kinds.kind[k].number * kinds.kind[k].diameter;
    return sum / def->number;
}

/* ---- parameters of disks and spheres --------------------------------------------------------- */

int hd_kinds_second(const hd_scene_def *scene)
{
    const double all = fmax(scene->number, 0.0), /* the scene may be unchecked */
        number = floor(scene->own[HD_KINDS_FRACTION].real * all + 0.5);
    return number > 0 ? (int)fmin(number, all) : 0;
}

static bool idle(const hd_scene_def *scene) { return hd_kinds_second(scene) == 0; }

const hd_parameter hd_kinds_own[HD_KINDS_OWN] = {
    {.name = "second_fraction",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_KINDS_FRACTION),
     .default_value = 0.0,
     .min = 0.0,
     .max = 1.0,
     .range = "from 0 to 1",
     .unit = "",
     .text = "Fraction of the particles that are of a second kind, rounded to whole particles: the "
             "last ones. Where each starts is drawn by the seed. 0: all are alike; 1: all are of "
             "the second kind. Others must leave at least one of each kind.",
     .record = "second fraction",
     .idle = idle},
    {.name = "second_diameter",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_KINDS_DIAMETER),
     .default_value = 1.0,
     .min = 0.2,
     .max = 5.0,
     .range = "from 0.2 to 5",
     .unit = "sigma",
     .text = "Diameter of particles of the second kind; that of the first kind is 1.",
     .record = "second diameter",
     .idle = idle},
    {.name = "second_mass",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_KINDS_MASS),
     .default_value = 1.0,
     .min = 0.001,
     .max = 1000.0,
     .range = "from 0.001 to 1000",
     .unit = "mass",
     .text =
         "Mass of particles of the second kind; that of the first kind is 1. The kinetic energy "
         "of all is N.",
     .record = "second mass",
     .idle = idle}};
