/** The null space of a scene [T9]: its directions in dq; those in dp are the same. */
#ifndef HD_NULL_SPACE_H
#define HD_NULL_SPACE_H

#include <stdbool.h>

#include "scene/scene.h"

/** Those that a scene has: directions, then the momenta where they are one. */
typedef struct hd_null_space {
    int dimension; /**< of the space, and the number of the momenta among the axes */
    int count;     /**< half of hd_scene_zero_exponents, or one less */
    int axis[HD_DIMENSION_MAX + 1];
    bool rotates;  /**< HD_NULL_X is a rotation */
    double centre; /**< about (centre, centre) */
} hd_null_space;

/** Writes axis[dimension + 1] and returns the number. */
int hd_null_axes(const hd_scene_def *def, int *axis);

hd_null_space hd_null_space_of(const hd_scene_def *def);

/** Entry of a direction at coordinate d (0: x, 1: y, ..) of a disk at q with momentum p; not
 * normalised. */
static inline double hd_null_entry(const hd_null_space *null, int axis, int d, const double *q,
                                   const double *p)
{
    if (axis == null->dimension) return p[d];
    if (d >= null->dimension) return 0.0;
    if (!null->rotates) return (double)(axis == d);
    return d == 0 ? null->centre - q[1] : q[0] - null->centre;
}

/** column[..][particle][2 coordinates] of the vectors that stay as they are, exactly: each
 * direction in dq and in dp; a rotation turns q and p alike, once. Returns their number. */
int hd_null_space_fill(const hd_scene_def *def, const double *q, const double *p, double *column);

/** Momenta of the seed: uniform, without what is conserved at q, scaled to K = N. */
void hd_null_space_momenta(const hd_scene_def *def, const double *q, double *p);

/** Takes out of the momenta p each momentum that is conserved, at q. */
void hd_null_space_still(const hd_scene_def *def, const double *q, double *p);

/** Part of the momenta along direction d that is conserved, in momenta: their sum is 1, half of an
 * angular momentum 1/2. */
double hd_null_conserved(const hd_scene_def *def, int d);

#endif
