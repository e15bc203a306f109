/** What kinetic theory says of hard disks, or of hard spheres, of kinetic energy 1 each. */
#ifndef HD_FLUID_H
#define HD_FLUID_H

#include "hdlyap/scene.h"

typedef struct hd_fluid {
    double temperature; /**< kT of many: twice the kinetic energy over the directions */
    double density_max; /**< closest packing */
    double (*contact)(double density);    /**< pair correlation at contact */
    double (*rate)(double density);       /**< collisions of one disk per time unit, Enskog */
    double (*free_path)(double density);  /**< mean path between two of them [sigma] */
    double (*sound)(double density);      /**< velocity of sound */
    double (*transverse)(double density); /**< lambda / k of the transverse modes of long waves, as
                                             measured, to some percent */
} hd_fluid;

extern const hd_fluid hd_fluid_disks, hd_fluid_spheres;

const hd_fluid *hd_fluid_of(const hd_scene_def *def);

#endif
