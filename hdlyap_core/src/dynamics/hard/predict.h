/** States of hard particles -> the earliest event of each. This is the code that all hard particles
 * share; see hard.c for the scheme. A file that includes this one defines before it
 *   HD_WALL_CONTACTS: 0 if the centre of a particle meets flat walls, as it meets edges of cells; 1
 *   if a wall is predicted as a contact, with the partner -1 - direction;
 * and after it
 *   predict_nearby(motion, i, near): replaces the prediction of i by its contacts with the
 *   particles nearby if they are earlier, by a predict_contact for each. */
#ifndef HD_PREDICT_H
#define HD_PREDICT_H

#include <math.h>
#include <stdbool.h>

#include "dynamics/hard/nearby.h"
#include "dynamics/hard/prediction.h"

static void predict_nearby(hd_motion *m, int32_t i, hd_nearby *near);

/** Whether a contact of disk i comes before another at the same time: the lower partner does, then
 * the lower image as seen from the disk with the lower index. */
static bool comes_first(int32_t i, int32_t j, const int32_t image[HD_DIM], const prediction *other)
{
    if (j != other->partner) return (uint32_t)j < (uint32_t)other->partner; /* walls last */
    const int32_t sign = i < j ? 1 : -1;
    int d = HD_DIM - 1;
    while (d > 0 && image[d] == other->image[d]) d--;
    return sign * image[d] < sign * other->image[d];
}

/** Replaces the prediction of disk i by its contact with the k-th disk nearby if that is earlier.
 * Returns whether it was. */
static inline bool predict_contact(hd_motion *m, int32_t i, const hd_nearby *near, int k,
                                   double contact)
{
    prediction *best = &m->predicted[i];
    const int32_t j = near->disk[k];
    const hd_disk *b = &m->disk[j];
    int32_t image[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) image[d] = near->image[d][k] - b->wrap[d];
    if (!(contact < INFINITY && contact <= best->contact)) return false;
    if (contact == best->contact && !comes_first(i, j, image, best)) return false;
    best->contact = contact;
    best->partner = j;
    best->partner_collisions = b->collisions;
    for (int d = 0; d < HD_DIM; d++) best->image[d] = image[d];
    return true;
}

/** Replaces the prediction of disk i by earlier contacts with the disks that are in the list of the
 * k-th of the cells around it. */
static void predict_listed(hd_motion *m, int32_t i, int k)
{
    const hd_disk *disk = &m->disk[i];
    const hd_cell *cell = hd_cells_near(&m->cells, disk, k);
    if (!cell->crowded) return;
    hd_nearby near;
    for (int32_t j = cell->disk[HD_CELL_DISKS - 1]; j >= 0;) {
        j = hd_nearby_listed(&near, &m->cells, disk, k, j);
        predict_nearby(m, i, &near);
    }
}

static void predict_around(hd_motion *m, int32_t i)
{
    hd_nearby near;
    hd_nearby_around(&near, &m->cells, &m->disk[i]);
    predict_nearby(m, i, &near);
    if (near.crowded)
        for (int k = 0; k < HD_CELLS_AROUND; k++) predict_listed(m, i, k);
}

static void predict_beside(hd_motion *m, int32_t i, int d, int side)
{
    hd_nearby near;
    hd_nearby_beside(&near, &m->cells, &m->disk[i], d, side);
    predict_nearby(m, i, &near);
    if (near.crowded)
        for (int k = 0; k < HD_CELLS_BESIDE; k++) predict_listed(m, i, hd_cells_beside(k, d, side));
}

/** The time at which the disk reaches the edge of its cell (or the wall) in direction d. */
static double edge_time(const hd_motion *m, const hd_disk *disk, int d)
{
    const hd_cell_line *line = &m->cells.line[d][disk->cell[d]];
    const double end = hd_cell_line_end(line, disk->p[d] > 0, hd_sizes_radius(&m->sizes, disk));
    const double edge = end + disk->wrap[d] * m->cells.box[d];
    const double wait = (edge - disk->q[d]) / disk->p[d];
    const double t = disk->t + (wait > 0 ? wait : 0.0); /* 0: it is there within rounding */
    return disk->p[d] == 0 ? INFINITY : t;
}

static bool is_wall(const hd_motion *m, const hd_disk *disk, int d, int32_t side)
{
    return m->cells.line[d][disk->cell[d]].near[side] == m->cells.size[d];
}

/** Predicts the next edge and puts the disk's earliest event into the queue, without branches that
 * depend on which event that is. */
static void schedule(hd_motion *m, int32_t i)
{
    const hd_disk *disk = &m->disk[i];
    prediction *next = &m->predicted[i];
    double edge[HD_DIM];
    int32_t side[HD_DIM];
    int wall[HD_DIM], d = 0;
    for (int e = 0; e < HD_DIM; e++) {
        edge[e] = edge_time(m, disk, e);
        side[e] = HIGH * (disk->p[e] > 0);
        wall[e] = is_wall(m, disk, e, side[e]);
        if (HD_WALL_CONTACTS && wall[e]) edge[e] = INFINITY;
    }
    for (int e = 1; e < HD_DIM; e++) {
        const int first = (edge[e] < edge[d]) | ((edge[e] == edge[d]) & (wall[e] > wall[d]));
        d += first * (e - d);
    }
    const int32_t j = next->partner;
    next->direction = d;
    next->side = side[d];
    const hd_queue_key key[2] = {
        {edge[d], hd_queue_order(wall[d] ? WALL : EDGE, i, -1 - d)},
        {next->contact, HD_WALL_CONTACTS && j < 0
                            ? hd_queue_order(WALL, i, j)
                            : hd_queue_order(PAIR, i < j ? i : j, i < j ? j : i)}};
    hd_queue_put(&m->queue, i, key[(next->contact < INFINITY) & (next->contact <= edge[d])]);
}

#endif
