/** The null space of a scene [T9], by the directions of its vectors in dq; each direction in dp
 * belongs to it, too, unless walls damp it [T27]. */
#ifndef HD_NULL_SPACE_H
#define HD_NULL_SPACE_H

#include <stdbool.h>

#include "scene/kinds.h"
#include "scene/scene.h"

/** The axes of a scene's null space: directions, then the momenta if they are one of the axes. */
typedef struct hd_null_space {
    int dimension; /**< of space; the axis of this number is the momenta */
    int count;     /**< number of axes */
    int axis[HD_DIMENSION_MAX + 1];
    bool rotates;  /**< HD_NULL_X is a rotation */
    double centre; /**< the rotation is about (centre, centre) */
    hd_kinds kinds;
} hd_null_space;

/** Writes axis[dimension + 1] and returns the number. */
int hd_null_axes(const hd_scene_def *def, int *axis);
/** Whether the direction of an axis in dp is no null vector, because walls damp that momentum. */
bool hd_null_is_damped(const hd_scene_def *def, int axis);
/** Number of exponents that vanish with the null space: two for each axis, one if it is damped. */
int hd_null_count(const hd_scene_def *def);

hd_null_space hd_null_space_of(const hd_scene_def *def);

/** Entry of an axis for coordinate d (0: x, 1: y, ..) of a particle at q with momentum p, the root
 * of whose mass is `root` [T26]; the axis is not normalised. */
static inline double hd_null_entry(const hd_null_space *null, int axis, int d, const double *q,
                                   const double *p, double root)
{
    if (axis == null->dimension) return p[d];
    if (d >= null->dimension) return 0.0;
    if (!null->rotates) return axis == d ? root : 0.0;
    return root * (d == 0 ? null->centre - q[1] : q[0] - null->centre);
}

/** Fills column[..][particle][2 coordinates] with the vectors that the dynamics leaves exactly as
 * they are: each direction in dq and in dp; a rotation, which turns q and p alike, once. Returns
 * their number. */
int hd_null_space_fill(const hd_scene_def *def, const double *q, const double *p, double *column);

/** Draws the momenta by the seed: uniform, conserved momenta at q removed, scaled to K = N. */
void hd_null_space_momenta(const hd_scene_def *def, const double *q, double *p);

/** Removes every conserved momentum (also an angular one) from the momenta p of particles at q. */
void hd_null_space_still(const hd_scene_def *def, const double *q, double *p);

/** Number of conserved momenta along direction d: 1 for their sum, 1/2 for half of an angular
 * momentum. */
double hd_null_conserved(const hd_scene_def *def, int d);

#endif
