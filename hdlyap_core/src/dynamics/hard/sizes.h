/** How large and how heavy disks are. If all are alike these are constants, which cost nothing. */
#ifndef HD_SIZES_H
#define HD_SIZES_H

#include "dynamics/hard/disk.h"
#include "scene/container.h"

/** Filled only for disks of two kinds. While a start grows each disk has a radius of its own. */
typedef struct hd_sizes {
    int32_t first;            /**< disks of the first kind; those behind are of the second one */
    double *radius;           /**< by hd_disk.size; two disks touch at the sum of theirs */
    hd_wall *wall;            /**< by hd_disk.size: the round wall for their centres */
    double mass[2], share[2]; /**< by kind; see hd_hard_share */
    double fastest;           /**< root of the lightest mass' inverse */
    double mean;              /**< mean radius of all disks */
} hd_sizes;

/** Fills the sizes of a scene's kinds, or `radii` others if that is above 0. Fails with
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_sizes_create(hd_sizes *sizes, const hd_scene_def *def, int radii);
void hd_sizes_clear(hd_sizes *sizes);

static inline double hd_sizes_radius(const hd_sizes *sizes, const hd_disk *disk)
{
    return HD_MIXED ? sizes->radius[disk->size] : 0.5;
}

/** 0 or 1. */
static inline int hd_sizes_kind(const hd_sizes *sizes, int32_t i)
{
    return HD_MIXED && i >= sizes->first;
}

static inline double hd_sizes_mass(const hd_sizes *sizes, int32_t i)
{
    return HD_MIXED ? sizes->mass[hd_sizes_kind(sizes, i)] : 1.0;
}

/** Twice the mass of j over the sum of both masses. */
static inline double hd_sizes_share(const hd_sizes *sizes, int32_t i, int32_t j)
{
    const int kind = hd_sizes_kind(sizes, i);
    return HD_MIXED && kind != hd_sizes_kind(sizes, j) ? sizes->share[kind] : 1.0;
}

#endif
