/** Scene -> the kinds of its disks or spheres, by their own parameters. */
#include "dynamics/hard/kinds.h"

#include <math.h>

double hd_hard_share(const hd_scene_def *scene)
{
    const double mass = scene->own[HD_KINDS_MASS].real, share = 2.0 * mass / (1.0 + mass);
    return mass < 1 ? 2.0 - 2.0 / (1.0 + mass) : share;
}

/** The mass is second_mass to 1e-13: that for which shares that were rounded keep the energy. */
int hd_hard_kinds(const hd_scene_def *scene, hd_kind *kind)
{
    const int of_second = hd_kinds_second(scene);
    const double share = hd_hard_share(scene);
    const hd_kind all[] = {{scene->number - of_second, 1.0, 1.0},
                           {of_second, scene->own[HD_KINDS_DIAMETER].real, share / (2.0 - share)}};
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
