/** The tangent map of one event for a block of columns: the part that disks and spheres share. */
#ifndef HD_KERNEL_H
#define HD_KERNEL_H

#include "dynamics/hard/event.h"

#define HD_KERNEL static inline __attribute__((always_inline))

/** With masses, coordinates are weighted by their roots, and a collision has to do with those of i
 * and j times sqrt(2 m_j / (m_i + m_j)) and sqrt(2 m_i / (m_i + m_j)) [T26]. */
#if HD_MIXED
#define HD_MAP_WEIGHT(map, k) ((map)->weight[k])
#else
#define HD_MAP_WEIGHT(map, k) 1.0
#endif

/** Free flight [T1]: dq += tau dp. v points to the rows of a disk: `half` numbers dq, then as many
 * dp. */
HD_KERNEL void hd_fly(double *restrict v, double tau, int half)
{
    for (int k = 0; k < half; k++) v[k] += tau * v[half + k];
}

/** Free flight, then reflection [T4]: component d of dq and of dp changes sign. */
HD_KERNEL void hd_reflect(double *restrict v, int d, double tau, int width)
{
    hd_fly(v, tau, HD_DIM * width);
    for (int k = 0; k < width; k++) {
        v[d * width + k] = -v[d * width + k];
        v[(HD_DIM + d) * width + k] = -v[(HD_DIM + d) * width + k];
    }
}

#endif
