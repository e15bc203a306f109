/** Scene -> record: event-driven motion of hard disks between periodic or reflecting edges.
 *
 * Every disk keeps the state of its last collision; contacts are predicted from two such states
 * alone (contact.h), so the events do not depend on cells, queue or the cutting into intervals.
 * Each disk has one entry in the queue: its earliest predicted contact, wall or cell edge. A
 * contact whose partner has collided since is stale; it is noticed when its time comes, and
 * predicted again. No event is missed by that: a disk that collides predicts anew with all its
 * neighbours. Time is counted in epochs, a power of two long (tens of collisions per disk), at
 * whose end all disks are brought up to date and predicted anew: so t = 1e6 is resolved as finely
 * as t = 0. One thread. Only + - * / sqrt and comparisons: the same bits everywhere. */
#include "dynamics/hard/hard_state.h"

#include <float.h>
#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/hard/event.h"
#include "dynamics/hard/prefetch.h"
#include "dynamics/record_state.h"
#include "scene/container.h"
#include "scene/fluid.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "scene/scene_check.h"

/** Faster disks would lose the positions' digits within one epoch. */
static const double MOMENTUM_MAX = 1e6;

/* ---- events -------------------------------------------------------------------------------- */

static hd_status write(hd_record *record, const hd_event *event)
{
    if (!record) return HD_OK;
    if (record->count == record->capacity) HD_TRY(hd_record_reserve(record, record->count + 1));
    ((hd_event *)record->entry)[record->count++] = *event;
    return HD_OK;
}

/** r.r - 1 to twice the working precision (Dekker's product, Knuth's sum). */
static double square_minus_one(const double r[HD_DIM])
{
    const double splitter = 134217729.0; /* 2^27 + 1 */
    double product[HD_DIM], error[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) {
        const double big = splitter * r[d], high = big - (big - r[d]), low = r[d] - high;
        product[d] = r[d] * r[d];
        error[d] = ((high * high - product[d]) + 2.0 * high * low) + low * low;
    }
    double all = product[0], lost = 0.0;
    for (int d = 1; d < HD_DIM; d++) {
        const double sum = all + product[d], part = sum - all;
        lost += (all - (sum - part)) + (product[d] - part);
        all = sum;
    }
    for (int d = 0; d < HD_DIM; d++) lost += error[d];
    return (all - 1.0) + lost;
}

/** What two disks that are r apart exchange: false if nothing, because they graze within rounding.
 * An approach that is lost in the rounding of their momenta might leave these as they are, and the
 * pair would meet again at once, for ever: it is turned into a parting that rounding cannot take
 * back, along the longest component of r. */
static bool exchange(hd_disk *a, hd_disk *b, const double r[HD_DIM], double approach, double excess)
{
    double size = 0.0;
    for (int d = 0; d < HD_DIM; d++) size += fabs(a->p[d]);
    for (int d = 0; d < HD_DIM; d++) size += fabs(b->p[d]);
    const double lost = 8.0 * DBL_EPSILON * size;
    if (approach < -lost) {
        /* approach / r.r; with r.r rounded near 1 the energy would drift, 3e-16 a collision */
        const double per_r = approach - approach * excess;
        for (int d = 0; d < HD_DIM; d++) {
            a->p[d] += per_r * r[d];
            b->p[d] -= per_r * r[d];
        }
        return true;
    }
    if (approach < 0) {
        int d = 0;
        for (int e = 1; e < HD_DIM; e++) d = fabs(r[e]) > fabs(r[d]) ? e : d;
        a->p[d] -= copysign(lost, r[d]);
        b->p[d] += copysign(lost, r[d]);
    }
    return false;
}

/** Pair contact [T3]: moves both disks to the contact and exchanges their normal momenta. */
static hd_status collide(hard *tr, hd_record *record, const hd_event *contact, int32_t found_by,
                         double t)
{
    hd_event event = *contact;
    hd_disk *a = &tr->motion.disk[event.i], *b = &tr->motion.disk[event.j];
    const prediction *how = &tr->motion.predicted[found_by];
    const double sign = 1.0 - 2.0 * (found_by != event.i); /* the image is seen from the finder */
    double shift[HD_DIM], r[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) shift[d] = sign * how->image[d] * tr->motion.cells.box[d];
    hd_disk_move_to(a, t);
    hd_disk_move_to(b, t);
    hd_contact_separation(r, a, b, shift, t);
    const double distance = sqrt(hd_contact_dot(r, r));
    double approach = 0;
    for (int d = 0; d < HD_DIM; d++) {
        event.n[d] = r[d] / distance;
        event.p[d] = b->p[d] - a->p[d];
        approach += event.p[d] * r[d];
    }
    const double excess = square_minus_one(r);
    if (excess < -2.0 * tr->overlap_max) return HD_OVERLAP;
    hd_status status = HD_OK;
    if (exchange(a, b, r, approach, excess)) {
        tr->collisions++;
        for (int d = 0; d < HD_DIM; d++) tr->virial[d] -= approach * event.n[d] * event.n[d];
        status = write(record, &event);
    }
    a->collisions++;
    b->collisions++;
    hd_cells_fold(&tr->motion.cells, a);
    hd_cells_fold(&tr->motion.cells, b);
    hd_prediction_renew(&tr->motion, found_by); /* the head of the queue first: foreseeable */
    hd_prediction_renew(&tr->motion, event.i + event.j - found_by);
    return status;
}

/** Reflection at a flat wall [T4]. */
static hd_status reflect(hard *tr, hd_record *record, hd_event *event, double t)
{
    hd_disk *disk = &tr->motion.disk[event->i];
    const prediction *how = &tr->motion.predicted[event->i];
    const int d = how->direction;
    const hd_cell_line *line = &tr->motion.cells.line[d][disk->cell[d]];
    hd_disk_move_to(disk, t);
    disk->q[d] = line->bound[how->side == HIGH]; /* there within rounding: no drift */
    event->n[d] = 1.0;
    for (int e = 0; e < HD_DIM; e++) event->p[e] = disk->p[e];
    disk->p[d] = -disk->p[d];
    disk->collisions++;
    hd_cells_fold(&tr->motion.cells, disk);
    tr->wall_events++;
    hd_prediction_renew(&tr->motion, event->i);
    return write(record, event);
}

/** Reflection at a curved wall [T21]. */
static hd_status reflect_round(hard *tr, hd_record *record, hd_event *event, double t)
{
    hd_disk *disk = &tr->motion.disk[event->i];
    hd_disk_move_to(disk, t);
    const bool reflected = hd_round_wall_reflect(&tr->motion.wall, disk, event);
    disk->collisions++;
    tr->wall_events += reflected;
    hd_prediction_renew(&tr->motion, event->i);
    return reflected ? write(record, event) : HD_OK;
}

/** Over a cell edge: only the cells at that side come into reach. */
static void cross(hard *tr, int32_t i)
{
    const int d = tr->motion.predicted[i].direction, side = tr->motion.predicted[i].side;
    hd_cells_cross(&tr->motion.cells, tr->motion.disk, i, d, side);
    hd_prediction_extend(&tr->motion, i, d, side);
}

/** The event at the head of the queue; begin is the record's start in this epoch's time. */
static hd_status take_event(hard *tr, hd_record *record, int32_t i, double begin)
{
    const hd_queue_key key = tr->motion.queue.entry[i].key;
    hd_event event = {.t = key.t > begin ? key.t - begin : 0.0,
                      .i = hd_queue_i(key.order),
                      .j = hd_queue_j(key.order)};
    switch (hd_queue_kind(key.order)) {
    case WALL: return reflect(tr, record, &event, key.t);
    case EDGE: cross(tr, i); return HD_OK;
    default: break;
    }
    const prediction *next = &tr->motion.predicted[i];
    if (next->partner == tr->motion.count) return reflect_round(tr, record, &event, key.t);
    if (next->partner_collisions == tr->motion.disk[next->partner].collisions)
        return collide(tr, record, &event, i, key.t);
    hd_prediction_renew(&tr->motion, i); /* stale */
    return HD_OK;
}

/** Brings all disks to the epoch's end, which becomes time 0, and predicts everything anew. */
static hd_status turn_epoch(hard *tr)
{
    for (int32_t i = 0; i < tr->motion.count; i++) {
        hd_disk *disk = &tr->motion.disk[i];
        hd_disk_move_to(disk, tr->epoch_length);
        disk->t = 0;
        hd_cells_fold(&tr->motion.cells, disk);
        disk->collisions++;
        for (int d = 0; d < HD_DIM; d++)
            if (!isfinite(disk->q[d] + disk->p[d])) return HD_NOT_FINITE;
    }
    tr->epoch_start += tr->epoch_length;
    hd_queue_restart(&tr->motion.queue);
    for (int32_t i = 0; i < tr->motion.count; i++) hd_prediction_renew(&tr->motion, i);
    return HD_OK;
}

static bool at_rest(const hard *tr)
{
    for (int32_t i = 0; i < tr->motion.count; i++)
        for (int d = 0; d < HD_DIM; d++)
            if (tr->motion.disk[i].p[d] != 0) return false;
    return true;
}

/** Nothing happens to disks at rest, however long that lasts: whole epochs are passed at once. */
static hd_status turn_epochs(hard *tr, double t_end)
{
    HD_TRY(turn_epoch(tr));
    const double left = t_end - tr->epoch_start;
    if (left > tr->epoch_length && at_rest(tr))
        tr->epoch_start += floor(left / tr->epoch_length) * tr->epoch_length;
    return HD_OK;
}

hd_status hd_hard_advance(void *state, hd_record *record, double t_end)
{
    hard *tr = state;
    HD_ASSERT(t_end >= tr->now);
    const double t_begin = record ? tr->now - record->duration : tr->now;
    if (record) record->duration = t_end - t_begin;
    for (;;) {
        const double end = t_end - tr->epoch_start;
        const int32_t bucket = tr->motion.queue.now, i = hd_queue_next(&tr->motion.queue);
        if (tr->motion.queue.now != bucket) hd_prefetch_ahead(&tr->motion, bucket);
        if (i >= 0 && tr->motion.queue.entry[i].key.t < end &&
            tr->motion.queue.entry[i].key.t < tr->epoch_length) {
            HD_TRY(take_event(tr, record, i, t_begin - tr->epoch_start));
        } else if (end > tr->epoch_length) {
            HD_TRY(turn_epochs(tr, t_end));
        } else {
            break;
        }
    }
    tr->now = t_end;
    return HD_OK;
}

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status prepare(hard *tr, const hd_scene_def *def)
{
    tr->motion.count = def->number;
    tr->epoch_length = hd_epoch_length(2.0 * hd_hard_rate(def) / def->number);
    tr->motion.wall = hd_wall_of(def);
    tr->motion.disk = hd_memory_alloc((size_t)tr->motion.count + 1, sizeof *tr->motion.disk);
    tr->motion.predicted = hd_memory_alloc((size_t)tr->motion.count, sizeof *tr->motion.predicted);
    if (!tr->motion.disk || !tr->motion.predicted) return HD_NO_MEMORY;
    HD_TRY(hd_cells_create(&tr->motion.cells, def, 1.0));
    tr->overlap_max = fmax(HD_OVERLAP_MAX, hd_hard_overlap_rounding(tr));
    return hd_queue_create(&tr->motion.queue, tr->motion.count, tr->epoch_length);
}

static hd_status start(hard *tr, const double *q, const double *p)
{
    for (int32_t i = 0; i < tr->motion.count; i++) {
        hd_disk *disk = &tr->motion.disk[i];
        for (int d = 0; d < HD_DIM; d++) {
            const double reach = tr->motion.cells.boundary[d] == HD_REFLECTING ? 0.5 : 0.0;
            disk->q[d] = q[HD_DIM * i + d];
            disk->p[d] = p[HD_DIM * i + d];
            if (!(fabs(disk->p[d]) <= MOMENTUM_MAX)) return HD_REFUSED;
            if (!(disk->q[d] >= reach && disk->q[d] <= tr->motion.cells.box[d] - reach))
                return HD_REFUSED;
        }
        const hd_wall *wall = &tr->motion.wall;
        if (wall->excess && wall->excess(wall, disk->q) > tr->overlap_max) return HD_REFUSED;
        hd_cells_add(&tr->motion.cells, tr->motion.disk, i);
    }
    if (hd_hard_overlap(tr) > tr->overlap_max) return HD_OVERLAP;
    for (int32_t i = 0; i < tr->motion.count; i++) hd_prediction_renew(&tr->motion, i);
    return HD_OK;
}

double hd_hard_rate(const hd_scene_def *def)
{
    return 0.5 * hd_dynamics_of(def)->fluid->rate(def) * def->number;
}

double hd_hard_entries(const hd_scene_def *def)
{
    double box[HD_DIM], rate = 0.5 * hd_dynamics_of(def)->fluid->rate(def);
    hd_scene_box(def, box);
    for (int d = 0; d < HD_DIM; d++)
        if (hd_scene_boundary(def, d) != HD_PERIODIC) rate += 1.0 / (box[d] - 1.0);
    return def->number * rate;
}

double hd_hard_bytes(double disks)
{
    /* its cells, its place in the queue and its prediction */
    static const double OF_A_DISK = HD_DIM == 2 ? 255.0 : 310.0;
    return OF_A_DISK * disks;
}

void hd_hard_free(void *state)
{
    hard *tr = state;
    if (!tr) return;
    hd_cells_clear(&tr->motion.cells);
    hd_queue_clear(&tr->motion.queue);
    hd_memory_free(tr->motion.disk);
    hd_memory_free(tr->motion.predicted);
    hd_memory_free(tr);
}

static hd_status create_at(void **state, const hd_scene_def *def, const double *q, const double *p)
{
    hard *tr = hd_memory_alloc(1, sizeof *tr);
    if (!tr) return HD_NO_MEMORY;
    hd_status status = prepare(tr, def);
    if (status == HD_OK) status = start(tr, q, p);
    if (status == HD_OK)
        *state = tr;
    else
        hd_hard_free(tr);
    return status;
}

/** On the start lattice, with momenta of the seed. */
static hd_status create_on_lattice(void **state, const hd_scene_def *def)
{
    double *q = hd_memory_alloc(HD_DIM * (size_t)def->number, sizeof *q);
    double *p = hd_memory_alloc(HD_DIM * (size_t)def->number, sizeof *p);
    hd_status status = HD_NO_MEMORY;
    if (q && p) {
        hd_container_of(def)->start(def, q);
        hd_null_space_momenta(def, q, p);
        status = create_at(state, def, q, p);
    }
    hd_memory_free(q);
    hd_memory_free(p);
    return status;
}

hd_status hd_hard_create(void **state, const hd_scene_def *def)
{
    *state = NULL;
    HD_TRY(hd_scene_check_start(def, NULL, 0));
    return create_on_lattice(state, def);
}

hd_status hd_hard_create_from(void **state, const hd_scene_def *def, const double *q,
                              const double *p)
{
    *state = NULL;
    HD_TRY(hd_scene_check_box(def, NULL, 0));
    return create_at(state, def, q, p);
}
