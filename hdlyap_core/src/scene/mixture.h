/** Kinetic theory of hard disks or spheres of several kinds [T26]. */
#ifndef HD_MIXTURE_H
#define HD_MIXTURE_H

#include "scene/fluid.h"

/** Disks, and spheres, of which not all have diameter 1 and mass 1. */
extern const hd_fluid hd_fluid_disk_mixture, hd_fluid_sphere_mixture;

/** Collisions of a particle of kind a with particles of kind b per time unit, of disks or spheres.
 */
double hd_mixture_rate(const hd_scene_def *def, int a, int b);

/** Compressibility factor of disks or spheres, p / (rho kT). */
double hd_mixture_compressibility(const hd_scene_def *def);

#endif
