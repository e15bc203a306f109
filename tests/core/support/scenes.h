/** Scenes that the trajectory's tests share. */
#ifndef HD_SCENES_H
#define HD_SCENES_H

#include "hdlyap/trajectory.h"

#if defined(__SANITIZE_ADDRESS__)
#define HD_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HD_SANITIZED 1
#endif
#endif
#ifndef HD_SANITIZED
#define HD_SANITIZED 0
#endif

static inline hd_scene_def scene_of(int disks, double density, double aspect, hd_boundary x,
                                    hd_boundary y, uint64_t seed)
{
    hd_scene_def def = hd_scene_def_default();
    def.disks = disks;
    def.density = density;
    def.aspect = aspect;
    def.boundary[0] = x;
    def.boundary[1] = y;
    def.seed = seed;
    return def;
}

/** The same by the edges of the box. */
static inline hd_scene_def scene_in_box(int disks, double lx, double ly, hd_boundary x,
                                        hd_boundary y, uint64_t seed)
{
    return scene_of(disks, disks / (lx * ly), ly / lx, x, y, seed);
}

#endif
