/** States of the disks -> the earliest event of each. See trajectory.c for the scheme. One thread. */
#include "prediction.h"

#include <math.h>
#include <stdbool.h>

/** From so many disks on the state outgrows the second-level cache. */
enum { LOOK_AHEAD_DISKS = 4000 };

/** The order of two contacts of disk i at the same time: by partner, then by image as seen from the disk
 *  with the lower number. */
static bool comes_first(int32_t i, int32_t j, const int32_t image[2], const prediction *other)
{
    if (j != other->partner) return j < other->partner;
    const int32_t sign = i < j ? 1 : -1;
    if (image[1] != other->image[1]) return sign * image[1] < sign * other->image[1];
    return sign * image[0] < sign * other->image[0];
}

/** Lowers `best`, the prediction of disk i (a copy of it: a), by its contacts with the list that starts at j; `image` is what
 *  to add, less the other disk's own wraps, to see it where a sees its cell. All in registers: the
 *  compiler cannot know that nothing here changes a disk. */
static inline prediction predict_list(const hd_trajectory *tr, prediction best, int32_t i,
                                      hd_disk a, int32_t j, int32_t image_x, int32_t image_y)
{
    const hd_disk *const disks = tr->disk;
    const hd_pair box = hd_pair_load(tr->cells.box);
    for (const hd_disk *b; j >= 0; j = b->next) {
        b = &disks[j];
        const int32_t edges[2] = {image_x - b->wrap[0], image_y - b->wrap[1]};
        const double t = a.t > b->t ? a.t : b->t;
        const hd_pair p = hd_pair_load(b->p) - hd_pair_load(a.p);
        const hd_pair r = hd_contact_separation(&a, b, (hd_pair){edges[0], edges[1]} * box, t);
        if (!hd_contact_ahead(r, p)) continue; /* the disk itself never is: p = 0 */
        const double contact = t + hd_contact_wait(r, p);
        if (contact > best.contact) continue;
        if (contact == best.contact && !comes_first(i, j, edges, &best)) continue;
        best.contact = contact;
        best.partner = j;
        best.partner_collisions = b->collisions;
        best.image[0] = edges[0];
        best.image[1] = edges[1];
    }
    return best;
}

/** The same for the cells at the given sides of its own, a rectangle of them (0 low, 1 here, 2 high). */
static void predict_cells(hd_trajectory *tr, int32_t i, const int x[2], const int y[2])
{
    const hd_disk disk = tr->disk[i];
    const hd_cell_line column = tr->cells.line[0][disk.cell[0]],
                       row = tr->cells.line[1][disk.cell[1]];
    prediction best = tr->predicted[i];
    for (int v = y[0]; v <= y[1]; v++) {
        if (row.near[v] < 0) continue;
        const int32_t *cells = tr->cells.first + row.near[v] * tr->cells.size[0];
        for (int u = x[0]; u <= x[1]; u++)
            if (column.near[u] >= 0)
                best = predict_list(tr, best, i, disk, cells[column.near[u]],
                                    column.shift[u] + disk.wrap[0], row.shift[v] + disk.wrap[1]);
    }
    tr->predicted[i] = best;
}

/** Time at which the disk reaches the edge of its cell (or the wall) in direction d. */
static double edge_time(const hd_trajectory *tr, const hd_disk *disk, int d)
{
    const hd_cell_line *line = &tr->cells.line[d][disk->cell[d]];
    if (disk->p[d] == 0) return INFINITY;
    const double edge = (disk->p[d] > 0 ? line->high : line->low) +
                        disk->wrap[d] * tr->cells.box[d];
    const double wait = (edge - disk->q[d]) / disk->p[d];
    return wait > 0 ? disk->t + wait : disk->t; /* already there within rounding */
}

static bool is_wall(const hd_trajectory *tr, const hd_disk *disk, int d, int32_t side)
{
    return tr->cells.line[d][disk->cell[d]].near[side] < 0;
}

/** Predicts the next edge and hands the disk's earliest event to the queue. */
static void schedule(hd_trajectory *tr, int32_t i)
{
    const hd_disk *disk = &tr->disk[i];
    prediction *next = &tr->predicted[i];
    const double edge[2] = {edge_time(tr, disk, 0), edge_time(tr, disk, 1)};
    const int32_t side[2] = {disk->p[0] > 0 ? HIGH : LOW, disk->p[1] > 0 ? HIGH : LOW};
    const bool wall[2] = {is_wall(tr, disk, 0, side[0]), is_wall(tr, disk, 1, side[1])};
    next->direction = edge[1] < edge[0] || (edge[1] == edge[0] && wall[1] && !wall[0]);
    next->side = side[next->direction];
    next->edge = edge[next->direction];
    hd_queue_key key = {next->edge, wall[next->direction] ? WALL : EDGE, i, -1 - next->direction};
    if (next->contact < INFINITY && next->contact <= next->edge) {
        const int32_t j = next->partner;
        key = (hd_queue_key){next->contact, PAIR, i < j ? i : j, i < j ? j : i};
    }
    hd_queue_put(&tr->queue, i, key);
}

void hd_prediction_renew(hd_trajectory *tr, int32_t i)
{
    static const int all[2] = {0, 2};
    tr->predicted[i].contact = INFINITY;
    tr->predicted[i].partner = -1;
    predict_cells(tr, i, all, all);
    schedule(tr, i);
}

void hd_prediction_extend(hd_trajectory *tr, int32_t i, int d, int side)
{
    const int across[2] = {side, side}, along[2] = {0, 2};
    predict_cells(tr, i, d == 0 ? across : along, d == 0 ? along : across);
    schedule(tr, i);
}

void hd_prediction_look_ahead(hd_trajectory *tr)
{
    if (tr->count < LOOK_AHEAD_DISKS) return;
    const hd_queue *queue = &tr->queue;
    const hd_cells *cells = &tr->cells;
    for (int32_t i = hd_queue_coming(queue, 3); i >= 0; i = queue->entry[i].next) {
        __builtin_prefetch(&tr->disk[i]);
        __builtin_prefetch(&tr->predicted[i]);
    }
    for (int32_t i = hd_queue_coming(queue, 2); i >= 0; i = queue->entry[i].next)
        for (int k = 0; k < 3; k++) {
            const int32_t row = cells->line[1][tr->disk[i].cell[1]].near[k];
            if (row >= 0)
                __builtin_prefetch(&cells->first[row * cells->size[0] + tr->disk[i].cell[0]]);
        }
    for (int32_t i = hd_queue_coming(queue, 1); i >= 0; i = queue->entry[i].next)
        for (int k = 0; k < 9; k++) {
            const int32_t row = cells->line[1][tr->disk[i].cell[1]].near[k / 3];
            const int32_t column = cells->line[0][tr->disk[i].cell[0]].near[k % 3];
            if (row < 0 || column < 0) continue;
            const int32_t j = hd_cells_first(cells, column, row);
            if (j >= 0) __builtin_prefetch(&tr->disk[j]), __builtin_prefetch(&queue->entry[j]);
        }
}
