/** Scene -> the kinds of its disks or spheres, by their own parameters. */
#ifndef HD_HARD_KINDS_H
#define HD_HARD_KINDS_H

#include "dynamics/hard/compiled.h"
#include "hdlyap/dynamics.h"
#include "scene/kinds.h"

/** See hd_dynamics.kinds and hd_dynamics.size. */
int hd_hard_kinds(const hd_scene_def *scene, hd_kind *kind);
double hd_hard_size(const hd_scene_def *scene);

/** Twice the mass of the other one over the sum of both, for a particle of the first kind that
 * meets one of the second; that of the latter is 2 minus it, exactly. */
double hd_hard_share(const hd_scene_def *scene);

#endif
