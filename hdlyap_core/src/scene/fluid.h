/** What kinetic theory says of particles in a box. */
#ifndef HD_FLUID_H
#define HD_FLUID_H

#include "hdlyap/dynamics.h"

struct hd_fluid {
    double density_max;                            /**< closest packing */
    double (*rate)(const hd_scene_def *def);       /**< collisions of one particle per time unit */
    double (*free_path)(const hd_scene_def *def);  /**< mean path between two of them [sigma] */
    double (*sound)(const hd_scene_def *def);      /**< velocity of sound */
    double (*transverse)(const hd_scene_def *def); /**< lambda / k of the transverse modes of long
                                                      waves, as measured, to some percent */
};

/** Of kinetic energy 1 each, by Enskog. */
extern const hd_fluid hd_fluid_disks, hd_fluid_spheres;

#endif
