/** Sizes and masses of the particles of a scene. Coordinates in which free flight and all that is
 * done to tangent vectors do not know masses are weighted by their roots [T26]. */
#ifndef HD_KINDS_H
#define HD_KINDS_H

#include "hdlyap/parameters.h"

typedef struct hd_kinds {
    int count;
    hd_kind kind[HD_KINDS_MAX];
    double root[HD_KINDS_MAX]; /**< of the mass */
} hd_kinds;

/** Of kinds that are left out, root is 1. */
hd_kinds hd_kinds_of(const hd_scene_def *def);

/** Root of the mass of particle i. */
static inline double hd_kinds_root(const hd_kinds *kinds, int i)
{
    return kinds->root[i >= kinds->kind[0].number];
}

/** The own parameters of disks and spheres, and where a scene has them: in the last places, so that
 * one whose particles are changed by hand keeps its other numbers. */
enum { HD_KINDS_OWN = 3 };
enum { HD_KINDS_FRACTION = HD_OWN_MAX - HD_KINDS_OWN, HD_KINDS_DIAMETER, HD_KINDS_MASS };
extern const hd_parameter hd_kinds_own[HD_KINDS_OWN];

/** How many particles are of the second kind by these parameters. */
int hd_kinds_second(const hd_scene_def *scene);

/** Largest diameter of a particle; mean over all of them. */
double hd_kinds_largest(const hd_scene_def *def);
double hd_kinds_mean(const hd_scene_def *def);

#endif
