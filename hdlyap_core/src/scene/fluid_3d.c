/** Hard spheres: Carnahan and Starling, J. Chem. Phys. 51, 635 (1969). + - * / sqrt only, as the
 * length of an epoch follows. */
#include "scene/fluid.h"

#include <math.h>

#include "hdlyap/scene.h"

static const double PI = 3.14159265358979323846;

double hd_fluid_contact(double density)
{
    const double eta = PI / 6.0 * density, free = 1.0 - eta;
    return (1.0 - 0.5 * eta) / (free * free * free);
}

double hd_fluid_rate(double density)
{
    return 4.0 * sqrt(PI * HD_FLUID_TEMPERATURE) * density * hd_fluid_contact(density);
}

double hd_fluid_free_path(double density)
{
    return 1.0 / (sqrt(2.0) * PI * density * hd_fluid_contact(density));
}

/** p = rho kT Z: c^2 = kT (d(rho Z)/d rho + 2/3 Z^2), as a sphere has three degrees of freedom. */
double hd_fluid_sound(double density)
{
    const double eta = PI / 6.0 * density, free = 1.0 - eta, cube = free * free * free;
    const double z = (1.0 + eta + eta * eta - eta * eta * eta) / cube;
    const double slope = (1.0 + 2.0 * eta - 3.0 * eta * eta) / cube + 3.0 * z / free;
    return sqrt(HD_FLUID_TEMPERATURE * (z + eta * slope + 2.0 / 3.0 * z * z));
}

/** At densities from 0.1 to 0.9, doc/findings.md. */
double hd_fluid_transverse(double density)
{
    const double square = density * density;
    return 0.735 + 0.907 * density + 1.166 * square + 1.488 * square * square;
}
