/** Scene -> event log: event-driven motion of hard disks between periodic or reflecting edges.
 *
 *  Every disk keeps the state of its last collision; contacts are predicted from two such states alone
 *  (contact.h), so the events do not depend on cells, queue or the cutting into intervals. Each disk has
 *  one entry in the queue: its earliest predicted contact, wall or cell edge. A contact whose partner
 *  has collided since is stale; it is noticed when its time comes, and predicted again. No event is
 *  missed by that: a disk that collides predicts anew with all its neighbours.
 *  Time is counted in epochs, a power of two long (tens of collisions per disk), at whose end all disks
 *  are brought up to date and predicted anew: so t = 1e6 is resolved as finely as t = 0.
 *  One thread. Only + - * / sqrt and comparisons: the same bits everywhere. */
#include "hdlyap/trajectory.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "cells.h"
#include "check.h"
#include "contact.h"
#include "lattice.h"
#include "memory.h"
#include "queue.h"
#include "random.h"
#include "scene_box.h"

/** Deeper than this [sigma], an overlap is a fault and not rounding. */
static const double OVERLAP_MAX = 1e-9;

/** Faster disks would lose the positions' digits within one epoch. */
static const double MOMENTUM_MAX = 1e6;

/** From so many disks on the state outgrows the second-level cache. */
enum { LOOK_AHEAD_DISKS = 4000 };

enum { PAIR, WALL, EDGE };  /* kinds, in the order in which equal times are taken */
enum { LOW = 0, HIGH = 2 }; /* sides of a cell, as in hd_cell_line */

typedef struct prediction {
    double contact; /**< time of the earliest known contact, or INFINITY */
    int32_t partner;
    uint32_t partner_collisions; /**< when it was predicted */
    int32_t image[2];            /**< box edges to add to the partner's position */
    double edge;                 /**< time at the next cell edge or wall */
    int32_t direction, side;     /**< of that edge */
} prediction;

struct hd_trajectory {
    int32_t count;
    hd_disk *disk;
    prediction *predicted;
    hd_cells cells;
    hd_queue queue;
    double rate; /**< expected pair events per time unit */
    double epoch_length;
    double epoch_start; /**< simulated time, a multiple of epoch_length */
    double now;         /**< simulated time */
    uint64_t collisions, wall_events;
};

/* ---- prediction ------------------------------------------------------------------------------- */

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

/** All that disk i can meet, from its present state. */
static void predict(hd_trajectory *tr, int32_t i)
{
    static const int all[2] = {0, 2};
    tr->predicted[i].contact = INFINITY;
    tr->predicted[i].partner = -1;
    predict_cells(tr, i, all, all);
    schedule(tr, i);
}

/* ---- events ----------------------------------------------------------------------------------- */

/** Back into the box; the cell that it is booked in stays. */
static void fold(const hd_trajectory *tr, hd_disk *disk)
{
    for (int d = 0; d < 2; d++) {
        if (tr->cells.boundary[d] != HD_PERIODIC) continue;
        const double turns = floor(disk->q[d] / tr->cells.box[d]);
        disk->q[d] -= turns * tr->cells.box[d];
        disk->wrap[d] -= (int32_t)turns;
    }
}

static void move_to(hd_disk *disk, double t)
{
    for (int d = 0; d < 2; d++) disk->q[d] += disk->p[d] * (t - disk->t);
    disk->t = t;
}

static hd_status log_append(hd_event_log *log, const hd_event *event)
{
    if (!log) return HD_OK;
    if (log->count == log->capacity) {
        const size_t capacity = log->capacity ? 2 * log->capacity : 4096;
        hd_event *grown = hd_memory_alloc(capacity, sizeof *grown);
        if (!grown) return HD_NO_MEMORY;
        if (log->count) memcpy(grown, log->event, log->count * sizeof *grown);
        hd_memory_free(log->event);
        log->event = grown;
        log->capacity = capacity;
    }
    log->event[log->count++] = *event;
    return HD_OK;
}

/** r.r - 1 to twice the working precision (Dekker's product, Knuth's sum). */
static double square_minus_one(hd_pair r)
{
    const double splitter = 134217729.0; /* 2^27 + 1 */
    double product[2], error[2];
    for (int d = 0; d < 2; d++) {
        const double big = splitter * r[d], high = big - (big - r[d]), low = r[d] - high;
        product[d] = r[d] * r[d];
        error[d] = ((high * high - product[d]) + 2.0 * high * low) + low * low;
    }
    const double sum = product[0] + product[1], part = sum - product[0];
    const double lost = (product[0] - (sum - part)) + (product[1] - part);
    return (sum - 1.0) + (lost + error[0] + error[1]);
}

/** Pair contact [T3]: moves both disks to the contact and exchanges their normal momenta. */
static hd_status collide(hd_trajectory *tr, hd_event_log *log, const hd_event *contact,
                         int32_t found_by, double t)
{
    hd_event event = *contact;
    hd_disk *a = &tr->disk[event.i], *b = &tr->disk[event.j];
    const prediction *how = &tr->predicted[found_by];
    const double sign = found_by == event.i ? 1.0 : -1.0; /* the image is seen from the finder */
    const hd_pair shift = {sign * how->image[0] * tr->cells.box[0],
                           sign * how->image[1] * tr->cells.box[1]};
    move_to(a, t);
    move_to(b, t);
    const hd_pair r = hd_contact_separation(a, b, shift, t);
    const double distance = sqrt(hd_contact_dot(r, r));
    double approach = 0;
    for (int d = 0; d < 2; d++) {
        event.n[d] = r[d] / distance;
        event.p[d] = b->p[d] - a->p[d];
        approach += event.p[d] * r[d];
    }
    const double excess = square_minus_one(r);
    if (excess < -2.0 * OVERLAP_MAX) return HD_OVERLAP;
    hd_status status = HD_OK;
    if (approach < 0) { /* else it grazes within rounding: nothing is exchanged */
        /* approach / r.r; with r.r rounded near 1 the energy would drift, 3e-16 a collision */
        const double per_r = approach - approach * excess;
        for (int d = 0; d < 2; d++) {
            a->p[d] += per_r * r[d];
            b->p[d] -= per_r * r[d];
        }
        tr->collisions++;
        status = log_append(log, &event);
    }
    a->collisions++;
    b->collisions++;
    fold(tr, a);
    fold(tr, b);
    predict(tr, event.i);
    predict(tr, event.j);
    return status;
}

/** Reflection at a flat wall [T4]. */
static hd_status reflect(hd_trajectory *tr, hd_event_log *log, hd_event *event, double t)
{
    hd_disk *disk = &tr->disk[event->i];
    const prediction *how = &tr->predicted[event->i];
    const int d = how->direction;
    const hd_cell_line *line = &tr->cells.line[d][disk->cell[d]];
    move_to(disk, t);
    disk->q[d] = how->side == HIGH ? line->high : line->low; /* there within rounding: no drift */
    event->n[d] = 1.0;
    event->p[0] = disk->p[0];
    event->p[1] = disk->p[1];
    disk->p[d] = -disk->p[d];
    disk->collisions++;
    fold(tr, disk);
    tr->wall_events++;
    predict(tr, event->i);
    return log_append(log, event);
}

/** Over a cell edge: only the three cells that come into reach are new. */
static void cross(hd_trajectory *tr, int32_t i)
{
    const int d = tr->predicted[i].direction;
    const int side = tr->predicted[i].side;
    const int across[2] = {side, side}, along[2] = {0, 2};
    hd_cells_cross(&tr->cells, tr->disk, i, d, side);
    predict_cells(tr, i, d == 0 ? across : along, d == 0 ? along : across);
    schedule(tr, i);
}

/** The event at the head of the queue; log_start is the interval's start in this epoch's time. */
static hd_status take_event(hd_trajectory *tr, hd_event_log *log, int32_t i, double log_start)
{
    const hd_queue_key key = tr->queue.entry[i].key;
    hd_event event = {.t = key.t > log_start ? key.t - log_start : 0.0, .i = key.i, .j = key.j};
    switch (key.kind) {
    case WALL: return reflect(tr, log, &event, key.t);
    case EDGE: cross(tr, i); return HD_OK;
    default: break;
    }
    const prediction *next = &tr->predicted[i];
    if (next->partner_collisions == tr->disk[next->partner].collisions)
        return collide(tr, log, &event, i, key.t);
    predict(tr, i); /* stale */
    return HD_OK;
}

/** Brings all disks to the epoch's end, which becomes time 0, and predicts everything anew. */
static hd_status turn_epoch(hd_trajectory *tr)
{
    for (int32_t i = 0; i < tr->count; i++) {
        hd_disk *disk = &tr->disk[i];
        move_to(disk, tr->epoch_length);
        disk->t = 0;
        fold(tr, disk);
        disk->collisions++;
        if (!isfinite(disk->q[0] + disk->q[1] + disk->p[0] + disk->p[1])) return HD_NOT_FINITE;
    }
    tr->epoch_start += tr->epoch_length;
    hd_queue_restart(&tr->queue);
    for (int32_t i = 0; i < tr->count; i++) predict(tr, i);
    return HD_OK;
}

/** Fetches what the events of the next buckets will touch: where the state does not fit into the cache,
 *  memory is waited for once and not at every step. Changes no result. */
static void look_ahead(hd_trajectory *tr)
{
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

hd_status hd_trajectory_advance(hd_trajectory *tr, hd_event_log *log, double t_end)
{
    HD_ASSERT(t_end >= tr->now);
    const double t_begin = tr->now;
    if (log) log->count = 0, log->duration = t_end - t_begin;
    for (;;) {
        const double end = t_end - tr->epoch_start;
        const int32_t bucket = tr->queue.now, i = hd_queue_next(&tr->queue);
        if (tr->queue.now != bucket && tr->count >= LOOK_AHEAD_DISKS) look_ahead(tr);
        if (i >= 0 && tr->queue.entry[i].key.t < end &&
            tr->queue.entry[i].key.t < tr->epoch_length) {
            HD_TRY(take_event(tr, log, i, t_begin - tr->epoch_start));
        } else if (end > tr->epoch_length) {
            HD_TRY(turn_epoch(tr));
        } else {
            break;
        }
    }
    tr->now = t_end;
    return HD_OK;
}

/* ---- creation --------------------------------------------------------------------------------- */

/** Mean pair events per time unit [T2]. */
static double enskog_rate(const hd_scene_def *def)
{
    const double pi = 3.14159265358979323846;
    const double eta = fmin(pi * def->density / 4.0, 0.9);
    const double contact = (1.0 - 7.0 * eta / 16.0) / ((1.0 - eta) * (1.0 - eta));
    return sqrt(pi) * def->density * contact * def->disks;
}

/** A power of two that holds about 32 to 64 collisions of a disk; in a thin gas less, so that no flight
 *  is so long that its rounding comes near OVERLAP_MAX. */
static double epoch_for(double rate_per_disk)
{
    const double wanted = fmin(32.0 / rate_per_disk, 16384.0);
    double length = 1.0;
    while (length < wanted) length *= 2.0;
    while (length * 0.5 >= wanted) length *= 0.5;
    return length;
}

static hd_status trajectory_prepare(hd_trajectory *tr, const hd_scene_def *def)
{
    tr->count = def->disks;
    tr->rate = enskog_rate(def);
    tr->epoch_length = epoch_for(2.0 * tr->rate / def->disks);
    tr->disk = hd_memory_alloc((size_t)tr->count, sizeof *tr->disk);
    tr->predicted = hd_memory_alloc((size_t)tr->count, sizeof *tr->predicted);
    if (!tr->disk || !tr->predicted) return HD_NO_MEMORY;
    HD_TRY(hd_cells_create(&tr->cells, def));
    return hd_queue_create(&tr->queue, tr->count, tr->epoch_length);
}

static hd_status trajectory_start(hd_trajectory *tr, const double *q, const double *p)
{
    for (int32_t i = 0; i < tr->count; i++) {
        hd_disk *disk = &tr->disk[i];
        for (int d = 0; d < 2; d++) {
            const double reach = tr->cells.boundary[d] == HD_REFLECTING ? 0.5 : 0.0;
            disk->q[d] = q[2 * i + d];
            disk->p[d] = p[2 * i + d];
            if (!(fabs(disk->p[d]) <= MOMENTUM_MAX)) return HD_REFUSED;
            if (!(disk->q[d] >= reach && disk->q[d] <= tr->cells.box[d] - reach)) return HD_REFUSED;
        }
        hd_cells_add(&tr->cells, tr->disk, i);
    }
    if (hd_trajectory_overlap(tr) > OVERLAP_MAX) return HD_OVERLAP;
    for (int32_t i = 0; i < tr->count; i++) predict(tr, i);
    return HD_OK;
}

/** Momenta: uniform, without a mean along periodic directions, scaled to K = N. */
static void momenta_fill(double *p, const hd_scene_def *def)
{
    hd_random random = hd_random_seeded(def->seed, 0);
    const int n = def->disks;
    double mean[2] = {0, 0}, square = 0;
    for (int k = 0; k < 2 * n; k++) mean[k % 2] += p[k] = hd_random_symmetric(&random);
    for (int k = 0; k < 2 * n; k++) {
        if (def->boundary[k % 2] == HD_PERIODIC) p[k] -= mean[k % 2] / n;
        square += p[k] * p[k];
    }
    const double scale = sqrt(2.0 * n / square);
    for (int k = 0; k < 2 * n; k++) p[k] *= scale;
}

hd_status hd_trajectory_create_from(hd_trajectory **out, const hd_scene_def *def, const double *q,
                                    const double *p)
{
    *out = NULL;
    HD_TRY(hd_scene_check_box(def, NULL, 0));
    hd_trajectory *tr = hd_memory_alloc(1, sizeof *tr);
    if (!tr) return HD_NO_MEMORY;
    hd_status status = trajectory_prepare(tr, def);
    if (status == HD_OK) status = trajectory_start(tr, q, p);
    if (status == HD_OK)
        *out = tr;
    else
        hd_trajectory_free(tr);
    return status;
}

hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def)
{
    *out = NULL;
    if (hd_scene_check(def, NULL, 0) != HD_OK) return HD_REFUSED;
    double box[2];
    hd_scene_box(def, box);
    const hd_lattice lattice = hd_lattice_best(def->disks, box, def->boundary);
    double *q = hd_memory_alloc(2 * (size_t)def->disks, sizeof *q);
    double *p = hd_memory_alloc(2 * (size_t)def->disks, sizeof *p);
    hd_status status = HD_NO_MEMORY;
    if (q && p) {
        hd_lattice_fill(&lattice, q, def->disks, box, def->boundary);
        momenta_fill(p, def);
        status = hd_trajectory_create_from(out, def, q, p);
    }
    hd_memory_free(q);
    hd_memory_free(p);
    return status;
}

void hd_trajectory_free(hd_trajectory *tr)
{
    if (!tr) return;
    hd_cells_clear(&tr->cells);
    hd_queue_clear(&tr->queue);
    hd_memory_free(tr->disk);
    hd_memory_free(tr->predicted);
    hd_memory_free(tr);
}

/* ---- what can be read ------------------------------------------------------------------------- */

double hd_trajectory_time(const hd_trajectory *tr) { return tr->now; }
int hd_trajectory_disks(const hd_trajectory *tr) { return tr->count; }
uint64_t hd_trajectory_collisions(const hd_trajectory *tr) { return tr->collisions; }
uint64_t hd_trajectory_wall_events(const hd_trajectory *tr) { return tr->wall_events; }
double hd_trajectory_collision_rate(const hd_trajectory *tr) { return tr->rate; }

void hd_trajectory_box(const hd_trajectory *tr, double box[2])
{
    box[0] = tr->cells.box[0];
    box[1] = tr->cells.box[1];
}

void hd_trajectory_state(const hd_trajectory *tr, double *q, double *p)
{
    for (int32_t i = 0; i < tr->count; i++) {
        hd_disk disk = tr->disk[i];
        move_to(&disk, tr->now - tr->epoch_start);
        fold(tr, &disk);
        for (int d = 0; d < 2; d++) {
            if (q) q[2 * i + d] = disk.q[d];
            if (p) p[2 * i + d] = disk.p[d];
        }
    }
}

double hd_trajectory_kinetic_energy(const hd_trajectory *tr)
{
    double twice = 0;
    for (int32_t i = 0; i < tr->count; i++)
        twice += tr->disk[i].p[0] * tr->disk[i].p[0] + tr->disk[i].p[1] * tr->disk[i].p[1];
    return 0.5 * twice;
}

/** Least distance squared from disk i to the disks of one neighbouring cell, now. */
static double nearest_in_cell(const hd_trajectory *tr, int32_t i, int32_t x, int32_t y)
{
    const hd_disk *disk = &tr->disk[i];
    const hd_cell_line *lx = &tr->cells.line[0][disk->cell[0]];
    const hd_cell_line *ly = &tr->cells.line[1][disk->cell[1]];
    double least = INFINITY;
    if (lx->near[x] < 0 || ly->near[y] < 0) return least;
    int32_t j = hd_cells_first(&tr->cells, lx->near[x], ly->near[y]);
    for (; j >= 0; j = tr->disk[j].next) {
        const hd_disk *other = &tr->disk[j];
        const hd_pair shift = {(lx->shift[x] + disk->wrap[0] - other->wrap[0]) * tr->cells.box[0],
                               (ly->shift[y] + disk->wrap[1] - other->wrap[1]) * tr->cells.box[1]};
        if (j == i) continue;
        const hd_pair r = hd_contact_separation(disk, other, shift, tr->now - tr->epoch_start);
        least = fmin(least, hd_contact_dot(r, r));
    }
    return least;
}

double hd_trajectory_overlap(const hd_trajectory *tr)
{
    double least = INFINITY;
    for (int32_t i = 0; i < tr->count; i++)
        for (int32_t k = 0; k < 9; k++) least = fmin(least, nearest_in_cell(tr, i, k % 3, k / 3));
    return least < 1.0 ? 1.0 - sqrt(least) : 0.0;
}
