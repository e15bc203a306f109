/** States of the molecules -> the earliest event of each, by the scheme of dynamics/hard/hard.c.
 * One thread. */
#include "dynamics/dumbbells/next.h"

#include <math.h>
#include <stdbool.h>

#include "dynamics/dumbbells/meeting.h"
#include "dynamics/hard/nearby.h"

enum { LOW = 0, HIGH = 2 }; /* sides of a cell, as in hd_cell_line */

/** The order of two contacts of molecule i at the same time: by partner, then by image as seen from
 * the lower number. */
static bool comes_first(int32_t i, const hd_next *a, const hd_next *b)
{
    if (a->partner != b->partner) return a->partner < b->partner;
    const int32_t sign = i < a->partner ? 1 : -1;
    const int d = a->image[1] != b->image[1];
    return sign * a->image[d] < sign * b->image[d];
}

static void predict_pair(hd_molecules *m, int32_t i, const hd_nearby *near, int k)
{
    hd_next *best = &m->next[i];
    const int32_t j = near->disk[k];
    if (j == i) return;
    hd_next found = {.partner = j, .partner_collisions = m->disk[j].collisions};
    int32_t image[2]; /* seen from the lower number */
    for (int d = 0; d < 2; d++) {
        found.image[d] = near->image[d][k] - m->disk[j].wrap[d];
        image[d] = i < j ? found.image[d] : -found.image[d];
    }
    const double until = fmin(best->contact, m->next[j].contact);
    found.contact = hd_meeting_of_pair(m, i < j ? i : j, i < j ? j : i, image,
                                       fmin(until, m->epoch_length), &found.which);
    if (!(found.contact < INFINITY && found.contact <= best->contact)) return;
    if (found.contact == best->contact && best->partner >= 0 && !comes_first(i, &found, best))
        return;
    *best = found;
}

static void predict_nearby(hd_molecules *m, int32_t i, const hd_nearby *near)
{
    for (int k = 0; k < near->count; k++) predict_pair(m, i, near, k);
}

/** Those that have no place in cell number k of those around. */
static void predict_listed(hd_molecules *m, int32_t i, int k)
{
    const hd_cell *cell = hd_cells_near(&m->cells, &m->disk[i], k);
    if (!cell->crowded) return;
    hd_nearby near;
    for (int32_t j = cell->disk[HD_CELL_DISKS - 1]; j >= 0;) {
        j = hd_nearby_listed(&near, &m->cells, &m->disk[i], k, j);
        predict_nearby(m, i, &near);
    }
}

static void predict_wall(hd_molecules *m, int32_t i, int d)
{
    hd_next *best = &m->next[i];
    if (m->cells.boundary[d] != HD_REFLECTING) return;
    hd_next found = {.partner = -1 - d};
    found.contact = hd_meeting_of_wall(m, i, d, fmin(best->contact, m->epoch_length), &found.which);
    if (found.contact < best->contact) *best = found;
}

/** Time at which the centre reaches the edge of its cell in direction d; it meets no wall. */
static double edge_time(const hd_molecules *m, const hd_disk *disk, int d, int32_t side)
{
    const hd_cell_line *line = &m->cells.line[d][disk->cell[d]];
    const double edge = line->bound[side == HIGH] + disk->wrap[d] * m->cells.box[d];
    const double wait = (edge - disk->q[d]) / disk->p[d];
    if (disk->p[d] == 0 || line->near[side] == m->cells.size[d]) return INFINITY;
    return disk->t + (wait > 0 ? wait : 0.0); /* 0: already there within rounding */
}

/** Predicts the next edge and hands the earliest event to the queue. */
static void schedule(hd_molecules *m, int32_t i)
{
    const hd_disk *disk = &m->disk[i];
    hd_next *next = &m->next[i];
    double edge = INFINITY;
    next->direction = 0;
    for (int d = 0; d < 2; d++) {
        const int32_t side = disk->p[d] > 0 ? HIGH : LOW;
        const double t = edge_time(m, disk, d, side);
        if (d > 0 && !(t < edge)) continue;
        edge = t;
        next->direction = d;
        next->side = side;
    }
    const int32_t j = next->partner;
    const int kind = j < 0 ? HD_MEETING_WALL : HD_MEETING;
    hd_queue_key key = {edge, hd_queue_order(HD_EDGE, i, -1 - next->direction)};
    if (next->contact < INFINITY && next->contact <= edge)
        key = (hd_queue_key){next->contact, j < 0 || i < j ? hd_queue_order(kind, i, j)
                                                           : hd_queue_order(kind, j, i)};
    hd_queue_put(&m->queue, i, key);
}

void hd_next_renew(hd_molecules *m, int32_t i)
{
    hd_nearby near;
    m->next[i] = (hd_next){.contact = INFINITY, .partner = -1};
    hd_nearby_around(&near, &m->cells, &m->disk[i]);
    predict_nearby(m, i, &near);
    if (near.crowded)
        for (int k = 0; k < HD_CELLS_AROUND; k++) predict_listed(m, i, k);
    for (int d = 0; d < 2; d++) predict_wall(m, i, d);
    schedule(m, i);
}

void hd_next_extend(hd_molecules *m, int32_t i, int d, int side)
{
    hd_nearby near;
    hd_nearby_beside(&near, &m->cells, &m->disk[i], d, side);
    predict_nearby(m, i, &near);
    if (near.crowded)
        for (int k = 0; k < HD_CELLS_BESIDE; k++) predict_listed(m, i, hd_cells_beside(k, d, side));
    schedule(m, i);
}

void hd_next_restart(hd_molecules *m)
{
    hd_queue_restart(&m->queue);
    for (int32_t i = 0; i < m->count; i++) m->next[i].contact = INFINITY;
    for (int32_t i = 0; i < m->count; i++) hd_next_renew(m, i);
}
