/** What walls that drag do to disks, and how these flow between them: integrals over time, exact
 * but for rounding, as disks fly straight [T27]. Nothing is kept without such walls. Only + - * /
 * sqrt and comparisons, so that all machines give the same bits. */
#ifndef HD_FLOW_H
#define HD_FLOW_H

#include <math.h>
#include <stdbool.h>

#include "dynamics/hard/disk.h"
#include "dynamics/hard/event.h"
#include "scene/ends.h"

/** The sums, of which those of walls are in pairs: low end, high end. */
enum {
    HD_FLOW_KINETIC, /**< of p_d^2, for each direction d */
    HD_FLOW_IMPULSE = HD_FLOW_KINETIC + HD_DIM,
    HD_FLOW_NEAR = HD_FLOW_IMPULSE + 2,
    HD_FLOW_MOMENTUM = HD_FLOW_NEAR + 2,
    HD_FLOW_VOLUME = HD_FLOW_MOMENTUM + 2, /**< what phase space has become, times 2^-512 to the */
    HD_FLOW_FOLDS,                         /**< power of this whole number */
    HD_FLOW_SUMS
};

typedef struct hd_flow {
    const hd_ends *wall; /**< NULL: no wall drags */
    hd_scene_def scene;
    int across, along;
    double near[2]; /**< centres below the first and above the second are near a wall */
    double sum[HD_FLOW_SUMS];
    double last; /**< time of a wall event, and how many more were at nearly the same time */
    int64_t at_once;
} hd_flow;

/** Within this distance from the places that centres reach they are near a wall [sigma]. */
#define HD_FLOW_NEARNESS 1.0

/** Finds the wall that drags. low, high: of centres between the walls across direction d. */
static inline void hd_flow_begin(hd_flow *flow, const hd_scene_def *scene, int d, double low,
                                 double high)
{
    const hd_ends *ends = hd_ends_of(scene->boundary[d]);
    if (!ends->meet) return;
    *flow = (hd_flow){.wall = ends,
                      .scene = *scene,
                      .across = d,
                      .along = d == 0 ? 1 : 0,
                      .near = {low + HD_FLOW_NEARNESS, high - HD_FLOW_NEARNESS},
                      .sum = {[HD_FLOW_VOLUME] = 1.0}};
}

/** The part of a flight of this length in which a coordinate that is q at its start, and moves at
 * the speed p, is below `bound`. */
static inline double hd_flow_below(double q, double p, double bound, double length)
{
    if (p == 0) return q < bound ? length : 0.0;
    const double reached = (bound - q) / p;
    const double before = reached < 0 ? 0.0 : reached > length ? length : reached;
    return p > 0 ? before : length - before;
}

/** Adds the flight of a disk until t to sum[HD_FLOW_SUMS]. */
static inline void hd_flow_fly(const hd_flow *flow, double *sum, const hd_disk *disk, double t)
{
    const double length = t - disk->t, q = disk->q[flow->across], p = disk->p[flow->across];
    const double below[2] = {hd_flow_below(q, p, flow->near[0], length),
                             hd_flow_below(q, p, flow->near[1], length)};
    const double near[2] = {below[0], length - below[1]};
    for (int d = 0; d < HD_DIM; d++) sum[HD_FLOW_KINETIC + d] += disk->p[d] * disk->p[d] * length;
    for (int side = 0; side < 2; side++) {
        sum[HD_FLOW_NEAR + side] += near[side];
        sum[HD_FLOW_MOMENTUM + side] += near[side] * disk->p[flow->along];
    }
}

/** Whether walls are met so often in 1e-12 time units that this will not end: they take away motion
 * across them, so that disks between which there is no room come to rest with ever more collisions.
 */
static inline bool hd_flow_is_jammed(hd_flow *flow, double t)
{
    const bool at_once = t >= flow->last && t <= flow->last + 0x1p-40;
    flow->at_once = at_once ? flow->at_once + 1 : 0;
    if (!at_once) flow->last = t;
    return flow->at_once > 1000 + 100 * (int64_t)flow->scene.number;
}

/** The disk meets the wall: its momentum becomes that after it, and the event tells how. */
static inline void hd_flow_strike(hd_flow *flow, hd_disk *disk, hd_event *event)
{
    const double huge = 0x1p512, before = disk->p[flow->along];
    const int d = flow->across, side = disk->p[d] > 0;
    double *volume = &flow->sum[HD_FLOW_VOLUME];
    event->j = HD_WALL_RULED(flow->scene.boundary[d], d);
    *volume *= flow->wall->meet(&flow->scene, disk->p, event->n, d);
    flow->sum[HD_FLOW_IMPULSE + side] += disk->p[flow->along] - before;
    if (*volume < 1.0 / huge) *volume *= huge, flow->sum[HD_FLOW_FOLDS] += 1.0;
    if (*volume > huge) *volume /= huge, flow->sum[HD_FLOW_FOLDS] -= 1.0;
}

/** Logarithm of what phase space has become. */
static inline double hd_flow_divergence(const hd_flow *flow)
{
    const double of_fold = 512.0 * 0.693147180559945309417;
    return log(flow->sum[HD_FLOW_VOLUME]) - of_fold * flow->sum[HD_FLOW_FOLDS];
}

#endif
