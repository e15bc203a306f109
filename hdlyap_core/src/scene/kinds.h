/** Sizes and masses of the particles of a scene. Coordinates in which free flight and all that is
 * done to tangent vectors do not know masses are weighted by their roots [T1]. */
#ifndef HD_KINDS_H
#define HD_KINDS_H

#include "hdlyap/scene.h"

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

/** Largest diameter of a particle. */
double hd_kinds_largest(const hd_scene_def *def);

#endif
