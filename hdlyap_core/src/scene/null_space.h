/** The exact null space [T9]: its directions in dq; those in dp are the same. */
#ifndef HD_NULL_SPACE_H
#define HD_NULL_SPACE_H

#include "hdlyap/scene.h"

/** Those that a scene has, in the order of HD_NULL_*. */
typedef struct hd_null_space {
    int count; /**< half of hd_scene_zero_exponents */
    int axis[HD_NULLS];
} hd_null_space;

static inline hd_null_space hd_null_space_of(const hd_boundary boundary[2])
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

#endif
