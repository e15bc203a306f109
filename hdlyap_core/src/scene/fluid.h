/** What kinetic theory says of hard disks, or of hard spheres, of kinetic energy 1 each. */
#ifndef HD_FLUID_H
#define HD_FLUID_H

#include "hdlyap/scene.h"

/** kT of many: twice the kinetic energy over the directions. */
#define HD_FLUID_TEMPERATURE (2.0 / HD_DIM)

/** Pair correlation at contact. */
double hd_fluid_contact(double density);
/** Collisions of one disk per time unit, Enskog. */
double hd_fluid_rate(double density);
/** Mean path between two of them [sigma]. */
double hd_fluid_free_path(double density);
/** Velocity of sound. */
double hd_fluid_sound(double density);
/** lambda / k of the transverse modes of long waves, as measured, to some percent. */
double hd_fluid_transverse(double density);

#endif
