/** Hard disks: Henderson, Mol. Phys. 30, 971 (1975). + - * / sqrt only, as the length of an epoch
 * follows. */
#include "scene/fluid.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static double contact_of(double density)
{
    const double eta = 0.25 * PI * density, free = 1.0 - eta;
    return (1.0 - 7.0 / 16.0 * eta) / (free * free);
}

/** Packing fractions above 0.9, where the formula diverges, count as 0.9. */
static double rate_of(const hd_scene_def *def)
{
    const double density = def->density;
    return 2.0 * sqrt(PI) * density * contact_of(fmin(density, 3.6 / PI));
}

static double free_path_of(const hd_scene_def *def)
{
    const double density = def->density;
    return 1.0 / (2.0 * sqrt(2.0) * density * contact_of(density));
}

/** From p = rho Z, c^2 = d(rho Z)/d rho + Z^2: a disk has two degrees of freedom and kT = 1. */
static double sound_of(const hd_scene_def *def)
{
    const double density = def->density;
    const double eta = 0.25 * PI * density, free = 1.0 - eta;
    const double z = (1.0 + eta * eta / 8.0) / (free * free);
    const double slope = (0.25 * eta + 2.0 * z * free) / (free * free); /* dZ / d eta */
    return sqrt(z + eta * slope + z * z);
}

/** The values of Eckmann et al. (2005), right to 3 % for densities up to 0.8. */
static double transverse_of(const hd_scene_def *def)
{
    const double density = def->density;
    const double square = density * density;
    return 0.902 + 1.050 * density - 0.053 * square + 3.85 * square * square;
}

const hd_fluid hd_fluid_disks = {.density_max = 1.1547005383792517,
                                 .rate = rate_of,
                                 .free_path = free_path_of,
                                 .sound = sound_of,
                                 .transverse = transverse_of,
                                 /* densities from 0.2 to 0.8, wide boxes too */
                                 .lp = {0.11, 0.16, 0.02, 0.02, 0.55, 2.0, 0.0, 0.1},
                                 .t = {0.02, 0.0, 0.007, 0.0, 0.05, 1.3, 0.01, 0.1}};
