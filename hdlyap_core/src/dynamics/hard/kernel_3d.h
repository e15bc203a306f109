/** Tangent map of one event of spheres for a block of columns [T4], [T22]. It is that of disks [T3]
 * with vectors perpendicular to n in place of t. */
#ifndef HD_KERNEL_3D_H
#define HD_KERNEL_3D_H

#include "dynamics/hard/kernel.h"

/** The free flights of the event's spheres since their last events, then the collision. */
typedef struct hd_tangent_map {
    int32_t i, j;     /**< as in hd_event */
    double flight[2]; /**< times that i and j have flown */
    double n[HD_DIM];
    double normal;         /**< b = p.n < 0 */
    double across[HD_DIM]; /**< p_t = p - b n */
    double ratio[HD_DIM];  /**< p_t / b */
#if HD_MIXED
    double weight[2]; /**< see HD_MAP_WEIGHT */
#endif
} hd_tangent_map;

/** Fills all but i, j and the flights, which the map has already. A wall needs n alone. */
static inline void hd_map_fill(hd_tangent_map *map, const hd_event *event)
{
    for (int d = 0; d < HD_DIM; d++) map->n[d] = event->n[d];
    if (event->j < 0) return;
    for (int d = 0; d < HD_DIM; d++) map->normal += event->p[d] * map->n[d];
    for (int d = 0; d < HD_DIM; d++) {
        map->across[d] = event->p[d] - map->normal * map->n[d];
        map->ratio[d] = map->across[d] / map->normal;
    }
}

/** The normal turns `by` times as far as it does if spheres touch at the distance 1. */
static inline void hd_map_turn(hd_tangent_map *map, double by)
{
    map->normal *= by;
    for (int d = 0; d < HD_DIM; d++) map->across[d] *= by;
}

/** Free flights, then the collision [T22]. s is the part of the displacement that turns n. */
HD_KERNEL void hd_collide(double *restrict vi, double *restrict vj, const hd_tangent_map *map,
                          int width)
{
    const double nx = map->n[0], ny = map->n[1], nz = map->n[2], b = map->normal;
    const double tx = map->across[0], ty = map->across[1], tz = map->across[2];
    const double rx = map->ratio[0], ry = map->ratio[1], rz = map->ratio[2];
    const double ti = map->flight[0], tj = map->flight[1];
    const double wi = HD_MAP_WEIGHT(map, 0), wj = HD_MAP_WEIGHT(map, 1);
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *xi = vi + k, *yi = xi + width, *zi = yi + width;
        double *xj = vj + k, *yj = xj + width, *zj = yj + width;
        double *pxi = zi + width, *pyi = pxi + width, *pzi = pyi + width;
        double *pxj = zj + width, *pyj = pxj + width, *pzj = pyj + width;
        const double xa = *xi + ti * *pxi, ya = *yi + ti * *pyi, za = *zi + ti * *pzi;
        const double xb = *xj + tj * *pxj, yb = *yj + tj * *pyj, zb = *zj + tj * *pzj;
        const double x = wj * xb - wi * xa, y = wj * yb - wi * ya, z = wj * zb - wi * za;
        const double a = x * nx + y * ny + z * nz; /* dq.n */
        const double sx = x - a * nx - a * rx, sy = y - a * ny - a * ry, sz = z - a * nz - a * rz;
        const double u = (wj * *pxj - wi * *pxi) * nx + (wj * *pyj - wi * *pyi) * ny +
                         (wj * *pzj - wi * *pzi) * nz + tx * sx + ty * sy +
                         tz * sz; /* dp.n + p_t.s */
        const double ux = u * nx + b * sx, uy = u * ny + b * sy, uz = u * nz + b * sz;
        *xi = xa + wi * a * nx, *yi = ya + wi * a * ny, *zi = za + wi * a * nz;
        *xj = xb - wj * a * nx, *yj = yb - wj * a * ny, *zj = zb - wj * a * nz;
        *pxi += wi * ux, *pyi += wi * uy, *pzi += wi * uz;
        *pxj -= wj * ux, *pyj -= wj * uy, *pzj -= wj * uz;
    }
}

HD_KERNEL void hd_meet_wall(double *restrict v, const hd_tangent_map *map, int width)
{
    hd_reflect(v, -1 - map->j, map->flight[0], width);
}

#endif
