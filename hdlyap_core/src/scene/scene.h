/** Quantities that the core derives from a scene. */
#ifndef HD_SCENE_H
#define HD_SCENE_H

#include "base/archive.h"
#include "hdlyap/scene.h"

/** Whether direction d is periodic, has walls, or is curved. */
hd_boundary hd_scene_boundary(const hd_scene_def *def, int d);

/** Whether the dynamics tells by how much phase space contracts; 0 if maps are symplectic. */
bool hd_scene_diverges(const hd_scene_def *def);

/* See hd_counts. */

int hd_scene_zero_exponents(const hd_scene_def *def);
int hd_scene_positive_exponents(const hd_scene_def *def);
int hd_scene_vectors(const hd_scene_def *def);
int hd_scene_carried(const hd_scene_def *def);

/** The time in which steps separate: hd_scene_warmup without what observables add. */
double hd_scene_parting(const hd_scene_def *def);
/** Writes what automatic values stand for (hd_parameter.resolve), so that they stay what they are
 * when the rest of the scene changes. */
void hd_scene_settle(hd_scene_def *def);
/** Automatic values go on to be what they stood for in a run that is resumed. */
void hd_scene_keep_chosen(hd_scene_def *asked, const hd_scene_def *kept);

/** Time between two collisions of a particle, as the row expects it [time units]. */
double hd_scene_collision_time(const hd_scene_def *def);

/** Time that a disturbance takes through all particles [time units]. In a fluid that is sound along
 * the longest edge of the box, by the equation of state of Henderson (Mol. Phys. 30, 971 (1975))
 * for disks, of Carnahan and Starling (J. Chem. Phys. 51, 635 (1969)) for spheres. */
double hd_scene_sound_crossing(const hd_scene_def *def);

/** Mean free path by Enskog's theory [sigma], with the pair correlation g at contact of the same
 * authors: 1 / (2 sqrt(2) density g) for disks, 1 / (sqrt(2) pi density g) for spheres. Without a
 * theory: the path at speed 1 in the time between two collisions. */
double hd_scene_mean_free_path(const hd_scene_def *def);

void hd_scene_archive(hd_scene_def *def, hd_archive *archive);

#endif
