/** The exact null space [T9]: its directions in dq; those in dp are the same. */
#ifndef HD_NULL_SPACE_H
#define HD_NULL_SPACE_H

#include <string.h>

#include "hdlyap/scene.h"

/** Those that a scene has, in the order of HD_NULL_*. */
typedef struct hd_null_space {
    int count; /**< half of hd_scene_zero_exponents */
    int axis[HD_NULLS];
} hd_null_space;

static inline hd_null_space hd_null_space_of(const hd_boundary boundary[HD_DIM])
{
    hd_null_space null = {0};
    for (int axis = 0; axis < HD_NULLS; axis++)
        if (axis == HD_NULL_P || boundary[axis] == HD_PERIODIC) null.axis[null.count++] = axis;
    return null;
}

/** Entry of a direction at a disk's component d (0: x, 1: y) of momentum p; not normalised. */
static inline double hd_null_entry(int axis, int d, double p)
{
    return axis == HD_NULL_P ? p : (double)(axis == d);
}

/** column[2 count][4 disks]: each direction in dq and in dp; p[2 disks]: momenta. */
static inline void hd_null_space_fill(const hd_boundary boundary[HD_DIM], const double *p,
                                      int disks, double *column)
{
    const hd_null_space null = hd_null_space_of(boundary);
    const size_t rows = HD_ROWS * (size_t)disks;
    for (int k = 0; k < 2 * null.count; k++, column += rows) {
        memset(column, 0, rows * sizeof *column);
        for (int j = 0; j < 2 * disks; j++)
            column[4 * (j / 2) + 2 * (k % 2) + j % 2] = hd_null_entry(null.axis[k / 2], j % 2,
                                                                      p[j]);
    }
}

#endif
