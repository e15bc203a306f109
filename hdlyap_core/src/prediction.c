/** States of the disks -> the earliest event of each. See trajectory.c for the scheme. One thread.
 *  Who may be met is first gathered from the cells without a look at the disks; then the contacts are
 *  computed side by side, those that do not happen too: a branch that the processor cannot foresee costs
 *  more than a root and a quotient. */
#include "prediction.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "multiversion.h"

/** From so many disks on the state outgrows the second-level cache. */
enum { LOOK_AHEAD_DISKS = 4000 };

/** Who may be met; what a cell copies beyond its count and the last lanes are spare places. */
enum { NEARBY_MAX = 9 * HD_CELL_DISKS, NEARBY_SPARE = 4 };
typedef struct nearby {
    int32_t count, crowded;
    int32_t disk[NEARBY_MAX + NEARBY_SPARE];
    int32_t image[2][NEARBY_MAX + NEARBY_SPARE]; /**< box edges to add, less that disk's own wraps */
} nearby;

/** The order of two contacts of disk i at the same time: by partner, then by image as seen from the disk
 *  with the lower number. */
static bool comes_first(int32_t i, int32_t j, const int32_t image[2], const prediction *other)
{
    if (j != other->partner) return j < other->partner;
    const int32_t sign = i < j ? 1 : -1;
    if (image[1] != other->image[1]) return sign * image[1] < sign * other->image[1];
    return sign * image[0] < sign * other->image[0];
}

/** Lowers the prediction of disk i to its contact with number k of those nearby, if that comes first. */
static void predict_one(hd_trajectory *tr, int32_t i, const nearby *near, int64_t k, double contact)
{
    const int32_t j = near->disk[k];
    const hd_disk *b = &tr->disk[j];
    const int32_t image[2] = {near->image[0][k] - b->wrap[0], near->image[1][k] - b->wrap[1]};
    prediction *best = &tr->predicted[i];
    if (!(contact < INFINITY && contact <= best->contact)) return;
    if (contact == best->contact && !comes_first(i, j, image, best)) return;
    *best = (prediction){contact, j, b->collisions, {image[0], image[1]}, 0, 0};
}

/** x of each of the disks b0 .. b3 as a vector. */
#define EACH(x) {b0->x, b1->x, b2->x, b3->x}

enum { NONE = -1, TIED = -2 };

/** Times of the contacts of disk i with those nearby, NaN if never. Returns the number of the earliest,
 *  NONE, or TIED if several may be as early. A leaf: where it ends the compiler
 *  clears the upper halves of the vector registers. */
HD_MULTIVERSION
static int contacts_nearby(double *contact, const hd_disk *disk, const double *box, int32_t i, const nearby *near)
{
    const hd_disk *a = &disk[i];
    const hd_lanes ax = HD_LANES_ALL(a->q[0]), ay = HD_LANES_ALL(a->q[1]), at = HD_LANES_ALL(a->t);
    const hd_lanes apx = HD_LANES_ALL(a->p[0]), apy = HD_LANES_ALL(a->p[1]);
    const hd_lanes box_x = HD_LANES_ALL(box[0]), box_y = HD_LANES_ALL(box[1]);
    hd_lanes least = HD_LANES_ALL(INFINITY);
    hd_lanes_mask number = {0, 1, 2, 3}, least_number = {0}, ties = {0};
    for (int k = 0; k < near->count; k += HD_LANES, number += HD_LANES) {
        const int32_t *j = &near->disk[k];
        const hd_disk *b0 = &disk[j[0]], *b1 = &disk[j[1]], *b2 = &disk[j[2]], *b3 = &disk[j[3]];
        const hd_lanes bx = EACH(q[0]), by = EACH(q[1]), bpx = EACH(p[0]), bpy = EACH(p[1]), bt = EACH(t);
        const hd_lanes_int columns = EACH(wrap[0]), rows = EACH(wrap[1]);
        hd_lanes_int edges_x, edges_y;
        memcpy(&edges_x, &near->image[0][k], sizeof edges_x);
        memcpy(&edges_y, &near->image[1][k], sizeof edges_y);
        const hd_lanes t = HD_LANES_WHERE(at > bt, at, bt), a_wait = t - at, b_wait = t - bt;
        const hd_lanes px = bpx - apx, py = bpy - apy;
        const hd_lanes x = bx + bpx * b_wait - (ax + apx * a_wait) +
                           __builtin_convertvector(edges_x - columns, hd_lanes) * box_x;
        const hd_lanes y = by + bpy * b_wait - (ay + apy * a_wait) +
                           __builtin_convertvector(edges_y - rows, hd_lanes) * box_y;
        hd_lanes times;
        hd_contact_times(&times, &x, &y, &px, &py, &t);
        memcpy(&contact[k], &times, sizeof times);
        ties |= times == least;
        const hd_lanes_mask less = times < least;
        least = HD_LANES_WHERE(less, times, least);
        least_number = (less & number) | (~less & least_number);
    }
    const double left = least[1] < least[0] ? least[1] : least[0], right = least[3] < least[2] ? least[3] : least[2];
    const double t = right < left ? right : left;
    if (t == INFINITY) return NONE;
    const hd_lanes_mask there = least == HD_LANES_ALL(t), hit = there & (least_number + 1);
    const int64_t sum = there[0] + there[1] + there[2] + there[3];
    if (sum != -1 || (ties[0] | ties[1] | ties[2] | ties[3])) return TIED;
    return (int)(hit[0] + hit[1] + hit[2] + hit[3]) - 1;
}

/** Lowers the prediction of disk i by its contacts with those nearby. */
static void predict_nearby(hd_trajectory *tr, int32_t i, nearby *near)
{
    double contact[NEARBY_MAX + NEARBY_SPARE];
    const hd_lanes_int self = {i, i, i, i};
    memcpy(&near->disk[near->count], &self, sizeof self); /* never ahead of itself: p = 0 */
    const int k = contacts_nearby(contact, tr->disk, tr->cells.box, i, near);
    if (k >= 0) predict_one(tr, i, near, k, contact[k]);
    if (k == TIED)
        for (int n = 0; n < near->count; n++) predict_one(tr, i, near, n, contact[n]);
}

/** Adds the disks of one cell, all but those of a crowd. */
static inline void nearby_add(nearby *near, const hd_cell *cell, int32_t x, int32_t y)
{
    const hd_lanes_int image[2] = {{x, x, x, x}, {y, y, y, y}};
    const int32_t count = near->count;
    memcpy(&near->disk[count], cell, sizeof *cell);
    memcpy(&near->image[0][count], &image[0], sizeof image[0]);
    memcpy(&near->image[1][count], &image[1], sizeof image[1]);
    near->count = count + cell->count;
    near->crowded |= cell->crowded;
}

/** Those whom the cell itself does not hold. */
__attribute__((noinline))
static void predict_crowd(hd_trajectory *tr, int32_t i, int u, int v)
{
    nearby near = {0};
    const hd_disk *disk = &tr->disk[i];
    const hd_cell_line *column = &tr->cells.line[0][disk->cell[0]];
    const hd_cell_line *row = &tr->cells.line[1][disk->cell[1]];
    const hd_cell *cell = hd_cells_at(&tr->cells, column->near[u], row->near[v]);
    if (!cell->crowded) return;
    int32_t j = cell->disk[HD_CELL_DISKS - 1];
    while ((j = hd_cells_next(&tr->cells, j)) >= 0) {
        near.disk[near.count] = j;
        near.image[0][near.count] = column->shift[u] + disk->wrap[0];
        near.image[1][near.count] = row->shift[v] + disk->wrap[1];
        if (++near.count == NEARBY_MAX) predict_nearby(tr, i, &near), near.count = 0;
    }
    predict_nearby(tr, i, &near);
}

/** What is beside a disk's cell in one direction. */
typedef struct beside {
    int32_t near[3], image[3];
} beside;

static inline beside beside_of(const hd_trajectory *tr, const hd_disk *disk, int d)
{
    const hd_cell_line *line = &tr->cells.line[d][disk->cell[d]];
    beside b;
    for (int k = 0; k < 3; k++) b.near[k] = line->near[k], b.image[k] = line->shift[k] + disk->wrap[d];
    return b;
}

static void predict_all(hd_trajectory *tr, int32_t i)
{
    nearby near;
    near.count = near.crowded = 0;
    const beside column = beside_of(tr, &tr->disk[i], 0), row = beside_of(tr, &tr->disk[i], 1);
    for (int v = 0; v < 3; v++) {
        const hd_cell *cells = hd_cells_at(&tr->cells, 0, row.near[v]);
        for (int u = 0; u < 3; u++)
            nearby_add(&near, &cells[column.near[u]], column.image[u], row.image[v]);
    }
    predict_nearby(tr, i, &near);
    if (near.crowded)
        for (int k = 0; k < 9; k++) predict_crowd(tr, i, k % 3, k / 3);
}

static void predict_side(hd_trajectory *tr, int32_t i, int d, int side)
{
    nearby near;
    near.count = near.crowded = 0;
    const beside column = beside_of(tr, &tr->disk[i], 0), row = beside_of(tr, &tr->disk[i], 1);
    for (int k = 0; k < 3; k++) {
        const int u = d == 0 ? side : k, v = d == 0 ? k : side;
        nearby_add(&near, hd_cells_at(&tr->cells, column.near[u], row.near[v]), column.image[u], row.image[v]);
    }
    predict_nearby(tr, i, &near);
    if (near.crowded)
        for (int k = 0; k < 3; k++) predict_crowd(tr, i, d == 0 ? side : k, d == 0 ? k : side);
}

/** Time at which the disk reaches the edge of its cell (or the wall) in direction d. */
static double edge_time(const hd_trajectory *tr, const hd_disk *disk, int d)
{
    const hd_cell_line *line = &tr->cells.line[d][disk->cell[d]];
    const double edge = line->bound[disk->p[d] > 0] + disk->wrap[d] * tr->cells.box[d];
    const double wait = (edge - disk->q[d]) / disk->p[d];
    const double t = disk->t + (wait > 0 ? wait : 0.0); /* 0: already there within rounding */
    return disk->p[d] == 0 ? INFINITY : t;
}

static bool is_wall(const hd_trajectory *tr, const hd_disk *disk, int d, int32_t side)
{
    return tr->cells.line[d][disk->cell[d]].near[side] == tr->cells.size[d];
}

/** Predicts the next edge and hands the disk's earliest event to the queue. */
static void schedule(hd_trajectory *tr, int32_t i)
{
    const hd_disk *disk = &tr->disk[i];
    prediction *next = &tr->predicted[i];
    const double edge[2] = {edge_time(tr, disk, 0), edge_time(tr, disk, 1)};
    const int32_t side[2] = {2 * (disk->p[0] > 0), 2 * (disk->p[1] > 0)};
    const bool wall[2] = {is_wall(tr, disk, 0, side[0]), is_wall(tr, disk, 1, side[1])};
    next->direction = (edge[1] < edge[0]) | ((edge[1] == edge[0]) & wall[1] & !wall[0]);
    next->side = side[next->direction];
    const double e = edge[next->direction];
    const int32_t j = next->partner;
    const hd_queue_key key[2] = {
        {e, hd_queue_order(wall[next->direction] ? WALL : EDGE, i, -1 - next->direction)},
        {next->contact, hd_queue_order(PAIR, i < j ? i : j, i < j ? j : i)}};
    hd_queue_put(&tr->queue, i, key[(next->contact < INFINITY) & (next->contact <= e)]);
}

void hd_prediction_renew(hd_trajectory *tr, int32_t i)
{
    tr->predicted[i].contact = INFINITY;
    tr->predicted[i].partner = -1;
    predict_all(tr, i);
    schedule(tr, i);
}

void hd_prediction_extend(hd_trajectory *tr, int32_t i, int d, int side)
{
    predict_side(tr, i, d, side);
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
            const hd_cell *cell = hd_cells_at(cells, tr->disk[i].cell[0], row);
            __builtin_prefetch(cell - (tr->disk[i].cell[0] > 0));
            __builtin_prefetch(cell + 1);
        }
    for (int32_t i = hd_queue_coming(queue, 1); i >= 0; i = queue->entry[i].next)
        for (int k = 0; k < 9; k++) {
            const int32_t row = cells->line[1][tr->disk[i].cell[1]].near[k / 3];
            const int32_t column = cells->line[0][tr->disk[i].cell[0]].near[k % 3];
            const hd_cell *cell = hd_cells_at(cells, column, row);
            if (cell->count > 0) __builtin_prefetch(&tr->disk[cell->disk[0]]), __builtin_prefetch(&queue->entry[cell->disk[0]]);
        }
}
