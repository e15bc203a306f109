/** Hard spheres: Carnahan and Starling, J. Chem. Phys. 51, 635 (1969). + - * / sqrt only, as the
 * length of an epoch follows. */
#include "scene/fluid.h"

#include <math.h>

static const double PI = 3.14159265358979323846, TEMPERATURE = 2.0 / 3.0;

static double contact_of(double density)
{
    const double eta = PI / 6.0 * density, free = 1.0 - eta;
    return (1.0 - 0.5 * eta) / (free * free * free);
}

static double rate_of(const hd_scene_def *def)
{
    const double density = def->density;
    return 4.0 * sqrt(PI * TEMPERATURE) * density * contact_of(density);
}

static double free_path_of(const hd_scene_def *def)
{
    const double density = def->density;
    return 1.0 / (sqrt(2.0) * PI * density * contact_of(density));
}

/** From p = rho kT Z, c^2 = kT (d(rho Z)/d rho + 2/3 Z^2): a sphere has three degrees of freedom.
 */
static double sound_of(const hd_scene_def *def)
{
    const double density = def->density;
    const double eta = PI / 6.0 * density, free = 1.0 - eta, cube = free * free * free;
    const double z = (1.0 + eta + eta * eta - eta * eta * eta) / cube;
    const double slope = (1.0 + 2.0 * eta - 3.0 * eta * eta) / cube + 3.0 * z / free;
    return sqrt(TEMPERATURE * (z + eta * slope + 2.0 / 3.0 * z * z));
}

/** Measured at densities from 0.1 to 0.9, see doc/findings.md. */
static double transverse_of(const hd_scene_def *def)
{
    const double density = def->density;
    const double square = density * density;
    return 0.735 + 0.907 * density + 1.166 * square + 1.488 * square * square;
}

const hd_fluid hd_fluid_spheres = {.density_max = 1.4142135623730951,
                                   .rate = rate_of,
                                   .free_path = free_path_of,
                                   .sound = sound_of,
                                   .transverse = transverse_of,
                                   /* boxes of 8 : 1 : 1, densities from 0.3 to 0.9 */
                                   .lp = {0.05, 0.17, 0.03, 0.04, 0.18, 0.8, 0.05, 0.15},
                                   .t = {0.02, 0.0, 0.015, 0.0, 0.01, 0.87, 0.02, 0.15}};
