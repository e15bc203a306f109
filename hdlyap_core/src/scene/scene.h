/** What the core derives from a scene. */
#ifndef HD_SCENE_H
#define HD_SCENE_H

#include "hdlyap/scene.h"

/** What the ends of direction d are. */
hd_boundary hd_scene_boundary(const hd_scene_def *def, int d);

/* See hd_counts. */

int hd_scene_zero_exponents(const hd_scene_def *def);
int hd_scene_positive_exponents(const hd_scene_def *def);
int hd_scene_vectors(const hd_scene_def *def);
int hd_scene_carried(const hd_scene_def *def);

/** hd_scene_warmup without what observables ask for: as long as steps take to part. */
double hd_scene_parting(const hd_scene_def *def);

/** Time between two collisions of a particle, as the row expects it [time units]. */
double hd_scene_collision_time(const hd_scene_def *def);

/** Time that a disturbance takes through all of them; sound, of a fluid, through the longest edge
 * of the box, by the equation of state of Henderson (Mol. Phys. 30, 971 (1975)), of spheres that of
 * Carnahan and Starling (J. Chem. Phys. 51, 635 (1969)) [time units]. */
double hd_scene_sound_crossing(const hd_scene_def *def);

/** Mean path of a disk between two collisions, by Enskog's theory, with the pair correlation at
 * contact of the same authors: 1 / (2 sqrt(2) density g), of spheres 1 / (sqrt(2) pi density g)
 * [sigma]. Of what is no fluid the path at speed 1 in the collision time. */
double hd_scene_mean_free_path(const hd_scene_def *def);

#endif
