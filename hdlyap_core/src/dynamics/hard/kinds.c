/** Scene -> the kinds of its disks or spheres, by their own parameters. */
#include "dynamics/hard/kinds.h"

#include <math.h>

/* The last places: a scene whose particles are changed by hand keeps its other numbers. */
enum { FRACTION = HD_OWN_MAX - HD_KINDS_OWN, DIAMETER, MASS };

const hd_parameter hd_kinds_own[HD_KINDS_OWN] = {
    {.name = "second_fraction",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(FRACTION),
     .default_value = 0.0,
     .min = 0.0,
     .max = 1.0,
     .range = "from 0 to 1",
     .unit = "",
     .text = "Fraction of the particles that are of a second kind, rounded to whole particles: the "
             "last ones. Where each starts is drawn by the seed. 0: all are alike.",
     .record = "second fraction"},
    {.name = "second_diameter",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(DIAMETER),
     .default_value = 1.0,
     .min = 0.2,
     .max = 5.0,
     .range = "from 0.2 to 5",
     .unit = "sigma",
     .text = "Diameter of particles of the second kind; that of the first kind is 1.",
     .record = "second diameter"},
    {.name = "second_mass",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(MASS),
     .default_value = 1.0,
     .min = 0.001,
     .max = 1000.0,
     .range = "from 0.001 to 1000",
     .unit = "mass",
     .text =
         "Mass of particles of the second kind; that of the first kind is 1. The kinetic energy "
         "of all is N.",
     .record = "second mass"}};

static int second(const hd_scene_def *scene)
{
    const double number = floor(scene->own[FRACTION].real * scene->number + 0.5);
    return number > 0 ? (int)fmin(number, scene->number) : 0; /* the scene may be unchecked */
}

double hd_hard_share(const hd_scene_def *scene)
{
    const double mass = scene->own[MASS].real, share = 2.0 * mass / (1.0 + mass);
    return mass < 1 ? 2.0 - 2.0 / (1.0 + mass) : share;
}

/** The mass is second_mass to 1e-13: that for which shares that were rounded keep the energy. */
int hd_hard_kinds(const hd_scene_def *scene, hd_kind *kind)
{
    const int of_second = second(scene);
    const double share = hd_hard_share(scene);
    const hd_kind all[] = {{scene->number - of_second, 1.0, 1.0},
                           {of_second, scene->own[DIAMETER].real, share / (2.0 - share)}};
    int count = 0;
    for (int k = 0; k < HD_KINDS_MAX; k++)
        if (all[k].number > 0 || (k == 0 && of_second == 0)) kind[count++] = all[k];
    return count;
}

/** Mean volume of a particle: pi / 4 d^2 of disks, pi / 6 d^3 of spheres. */
double hd_hard_size(const hd_scene_def *scene)
{
    hd_kind kind[HD_KINDS_MAX];
    const int count = hd_hard_kinds(scene, kind);
    double size = 0.0;
    for (int k = 0; k < count; k++) {
        const double d = kind[k].diameter, part = (double)kind[k].number / scene->number;
        size += part * 3.14159265358979323846 / (2 * HD_DIM) * d * d * (HD_DIM == 2 ? 1.0 : d);
    }
    return size;
}
