/** Tangent map of one event of disks for a block of columns [T3], [T4], [T21], [T27]. Vectors are
 * written in components along n and along t, which is n turned by +90 degrees. */
#ifndef HD_KERNEL_2D_H
#define HD_KERNEL_2D_H

#include <math.h>

#include "dynamics/hard/kernel.h"
#include "scene/ends.h"

/** The free flights of the event's disks since their last events, then the collision. */
typedef struct hd_tangent_map {
    int32_t i, j; /**< as in hd_event */
    union {
        struct {
            double flight[2]; /**< times that i and j have flown */
            double n[HD_DIM];
            double normal;     /**< b = p.n: < 0; at a round wall > 0 */
            double tangential; /**< p_t = p.t */
            double ratio;      /**< p_t / b */
        };
        struct {
            double alone; /**< time that i has flown to the wall */
            double bend;  /**< twice the curvature of a round wall */
        };
        struct {
            double alone_to_rule; /**< the same */
            hd_wall_map ruled;    /**< of a wall with a rule of its own */
        };
    };
#if HD_MIXED
    double weight[2]; /**< see HD_MAP_WEIGHT */
#endif
} hd_tangent_map;

/** Finds the curvature of a round wall: the normal in the event is as long as the radius. */
static inline void hd_curved_fill(hd_tangent_map *map)
{
    const double radius = sqrt(map->n[0] * map->n[0] + map->n[1] * map->n[1]);
    map->bend = 2.0 / radius;
    map->n[0] /= radius;
    map->n[1] /= radius;
}

/** Fills all but i, j and the flights, which the map has already. A flat wall needs n alone. */
static inline void hd_map_fill(hd_tangent_map *map, const hd_event *event)
{
    if (event->j < HD_WALL_ROUND) {
        map->ruled =
            hd_ends_of(HD_WALL_ENDS(map->j))->map(event->p, event->n, HD_WALL_ACROSS(map->j));
        return;
    }
    map->n[0] = event->n[0];
    map->n[1] = event->n[1];
    if (event->j < 0 && event->j != HD_WALL_ROUND) return;
    if (event->j == HD_WALL_ROUND) hd_curved_fill(map);
    map->normal = event->p[0] * map->n[0] + event->p[1] * map->n[1];
    map->tangential = event->p[1] * map->n[0] - event->p[0] * map->n[1];
    map->ratio = map->tangential / map->normal;
}

/** The normal turns `by` times as far as it does if disks touch at the distance 1. */
static inline void hd_map_turn(hd_tangent_map *map, double by)
{
    map->normal *= by;
    map->tangential *= by;
}

/** Free flights, then the collision [T3]. s is the part of the displacement that turns n. */
HD_KERNEL void hd_collide(double *restrict vi, double *restrict vj, const hd_tangent_map *map,
                          int width)
{
    const double nx = map->n[0], ny = map->n[1], ti = map->flight[0], tj = map->flight[1];
    const double b = map->normal, pt = map->tangential, ratio = map->ratio;
    const double wi = HD_MAP_WEIGHT(map, 0), wj = HD_MAP_WEIGHT(map, 1);
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *qi = vi + k, *pi = vi + 2 * width + k, *qj = vj + k, *pj = vj + 2 * width + k;
        const double qix = qi[0] + ti * pi[0], qiy = qi[width] + ti * pi[width];
        const double qjx = qj[0] + tj * pj[0], qjy = qj[width] + tj * pj[width];
        const double qx = wj * qjx - wi * qix, qy = wj * qjy - wi * qiy;
        const double px = wj * pj[0] - wi * pi[0], py = wj * pj[width] - wi * pi[width];
        const double a = qx * nx + qy * ny;                     /* dq.n */
        const double s = qy * nx - qx * ny - ratio * a;         /* dq.t - (p_t / b) a */
        const double u = px * nx + py * ny + pt * s, w = b * s; /* d + p_t s, b s */
        const double ux = u * nx - w * ny, uy = u * ny + w * nx;
        qi[0] = qix + wi * a * nx, qi[width] = qiy + wi * a * ny;
        qj[0] = qjx - wj * a * nx, qj[width] = qjy - wj * a * ny;
        pi[0] += wi * ux, pi[width] += wi * uy;
        pj[0] -= wj * ux, pj[width] -= wj * uy;
    }
}

/** Free flight, then reflection at a round wall [T21]. s = dq.t - (p_t / b) dq.n is how far along
 * the wall the displaced trajectory meets it. */
HD_KERNEL void hd_curve(double *restrict v, const hd_tangent_map *map, int width)
{
    const double nx = map->n[0], ny = map->n[1], ratio = map->ratio;
    const double b = map->bend * map->normal, pt = map->bend * map->tangential;
    hd_fly(v, map->flight[0], HD_DIM * width);
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *q = v + k, *p = v + 2 * width + k;
        const double a = q[0] * nx + q[width] * ny;
        const double s = q[width] * nx - q[0] * ny - ratio * a;
        const double u = 2.0 * (p[0] * nx + p[width] * ny) + pt * s, w = b * s;
        q[0] -= 2.0 * a * nx, q[width] -= 2.0 * a * ny;
        p[0] -= u * nx - w * ny, p[width] -= u * ny + w * nx;
    }
}

/** Free flight, then a flat wall with a rule of its own [T27]. */
HD_KERNEL void hd_turn(double *restrict v, const hd_tangent_map *map, int width)
{
    const hd_wall_map m = map->ruled;
    const int d = HD_WALL_ACROSS(map->j) * width, a = width - d;
    hd_fly(v, map->flight[0], HD_DIM * width);
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *q = v + k, *p = v + 2 * width + k;
        const double across = q[d], pa = p[a], pd = p[d];
        q[a] += m.slip * across, q[d] = m.rebound * across;
        p[a] = m.turn[0][0] * pa + m.turn[0][1] * pd;
        p[d] = m.turn[1][0] * pa + m.turn[1][1] * pd;
    }
}

/** Free flight, then a round wall, a flat one with a rule of its own, or reflection. */
HD_KERNEL void hd_meet_wall(double *restrict v, const hd_tangent_map *map, int width)
{
    if (map->j == HD_WALL_ROUND)
        hd_curve(v, map, width);
    else if (map->j < HD_WALL_ROUND)
        hd_turn(v, map, width);
    else
        hd_reflect(v, map->j == HD_WALL_Y, map->flight[0], width);
}

#endif
