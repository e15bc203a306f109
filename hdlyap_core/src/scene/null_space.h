/** The null space of a scene [T9]: its directions in dq; those in dp are the same. */
#ifndef HD_NULL_SPACE_H
#define HD_NULL_SPACE_H

#include <string.h>

#include "scene/scene.h"

/** Those that a scene has: directions, then the momenta. */
typedef struct hd_null_space {
    int dimension; /**< of the space, and the number of the momenta among the axes */
    int count;     /**< half of hd_scene_zero_exponents */
    int axis[HD_DIMENSION_MAX + 1];
    bool curved;   /**< HD_NULL_X is a rotation */
    double centre; /**< about (centre, centre) */
} hd_null_space;

static inline hd_null_space hd_null_space_of(const hd_scene_def *def)
{
    hd_null_space null = {.dimension = hd_scene_dimension(def),
                          .curved = hd_scene_boundary(def, 0) == HD_CURVED};
    double box[HD_DIMENSION_MAX];
    hd_scene_box(def, box);
    null.centre = 0.5 * box[0];
    for (int axis = 0; axis <= null.dimension; axis++)
        if (axis == null.dimension ||
            (null.curved ? axis == HD_NULL_X : hd_scene_boundary(def, axis) == HD_PERIODIC))
            null.axis[null.count++] = axis;
    return null;
}

/** Entry of a direction at component d (0: x, 1: y, 2: z) of a disk at q with momentum p; not
 * normalised.
 */
static inline double hd_null_entry(const hd_null_space *null, int axis, int d, const double *q,
                                   const double *p)
{
    if (axis == null->dimension) return p[d];
    if (!null->curved) return (double)(axis == d);
    return d == 0 ? null->centre - q[1] : q[0] - null->centre;
}

/** column[..][2 dimension disks] of the vectors that stay as they are, exactly: each direction in
 * dq and in dp; a rotation turns q and p alike, once. Returns their number. */
static inline int hd_null_space_fill(const hd_scene_def *def, const double *q, const double *p,
                                     double *column)
{
    const hd_null_space null = hd_null_space_of(def);
    const int dimension = null.dimension;
    const size_t rows = 2 * (size_t)(dimension * def->disks);
    int count = 0;
    for (int k = 0; k < 2 * null.count; k++) {
        const bool rotation = null.curved && null.axis[k / 2] == HD_NULL_X;
        if (rotation && k % 2 == 1) continue;
        memset(column, 0, rows * sizeof *column);
        for (int j = 0; j < dimension * def->disks; j++) {
            const int d = j % dimension;
            const double *at = q + (j - d), *moving = p + (j - d);
            double *entry = column + 2 * dimension * (j / dimension) + d;
            entry[dimension * (k % 2)] = hd_null_entry(&null, null.axis[k / 2], d, at, moving);
            if (rotation) entry[dimension] = d == 0 ? -moving[1] : moving[0];
        }
        column += rows;
        count++;
    }
    return count;
}

#endif
