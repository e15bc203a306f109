/** Scene -> record: event-driven motion of hard disks between periodic or reflecting edges.
 *
 * Every disk keeps the state of its last collision. Contacts are predicted from the two states
 * alone (contact.h), so events do not depend on cells, on the queue or on how time is cut into
 * intervals. Each disk has one entry in the queue: its earliest predicted contact, wall or cell
 * edge. A contact is stale if its partner has collided since; that is noticed when its time comes,
 * and the disk predicts anew. No event is missed so, because a disk that collides predicts its
 * contacts with all neighbours. Time is counted in epochs, whose length is a power of two (tens of
 * collisions per disk). At the end of an epoch all disks are brought up to date and predict anew,
 * so t = 1e6 is resolved as finely as t = 0. One thread computes this, with + - * / sqrt and
 * comparisons only, so that all machines give the same bits. */
#include "dynamics/hard/hard.h"

#include <float.h>
#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/hard/event.h"
#include "dynamics/hard/grow.h"
#include "scene/container.h"
#include "scene/ends.h"
#include "scene/fluid.h"
#include "scene/kinds.h"
#include "scene/scene.h"

/** A faster disk would move so far in one epoch that its position would lose digits. */
static const double MOMENTUM_MAX = 1e6;

/* ---- bodies -------------------------------------------------------------------------------- */

typedef hd_event hd_entry;
typedef hard hd_bodies;
enum { HD_HALF = HD_DIM };

hd_status hd_hard_prepare(hard *tr, const hd_scene_def *def, double reach)
{
    tr->motion.count = def->number;
    tr->epoch_length = hd_epoch_length(2.0 * hd_hard_rate(def) / def->number);
    tr->motion.wall = hd_wall_of(def, 0.5);
    tr->motion.disk = hd_memory_alloc((size_t)tr->motion.count + 1, sizeof *tr->motion.disk);
    tr->motion.predicted = hd_memory_alloc((size_t)tr->motion.count, sizeof *tr->motion.predicted);
    if (!tr->motion.disk || !tr->motion.predicted) return HD_NO_MEMORY;
    HD_TRY(hd_cells_create(&tr->motion.cells, def, reach));
    tr->overlap_max = fmax(HD_OVERLAP_MAX, hd_hard_overlap_rounding(tr));
    return hd_queue_create(&tr->motion.queue, tr->motion.count, tr->epoch_length);
}

static hd_status prepare(hard *tr, const hd_scene_def *def)
{
    if (HD_MIXED) HD_TRY(hd_sizes_create(&tr->motion.sizes, def, 0));
    HD_TRY(hd_hard_prepare(tr, def, HD_MIXED ? hd_kinds_largest(def) : 1.0));
    for (int d = 0; d < HD_DIM; d++)
        hd_flow_begin(&tr->flow, def, d, 0.5, tr->motion.cells.box[d] - 0.5);
    return HD_OK;
}

static hd_status start(hard *tr, const double *q, const double *p)
{
    for (int32_t i = 0; i < tr->motion.count; i++) {
        hd_disk *disk = &tr->motion.disk[i];
        const double root = sqrt(hd_sizes_mass(&tr->motion.sizes, i));
        disk->size = (uint32_t)hd_sizes_kind(&tr->motion.sizes, i);
        for (int d = 0; d < HD_DIM; d++) {
            const bool walls = hd_is_wall(tr->motion.cells.boundary[d]);
            const double reach = walls ? hd_sizes_radius(&tr->motion.sizes, disk) : 0.0;
            disk->q[d] = q[HD_DIM * i + d];
            disk->p[d] = p[HD_DIM * i + d] / root;
            if (!(fabs(disk->p[d]) <= MOMENTUM_MAX)) return HD_REFUSED;
            if (!(disk->q[d] >= reach && disk->q[d] <= tr->motion.cells.box[d] - reach))
                return HD_REFUSED;
        }
        const hd_wall *wall = hd_motion_wall(&tr->motion, disk);
        if (wall->excess && wall->excess(wall, disk->q) > tr->overlap_max) return HD_REFUSED;
        hd_cells_add(&tr->motion.cells, tr->motion.disk, i);
    }
    if (hd_hard_overlap(tr) > tr->overlap_max) return HD_OVERLAP;
    for (int32_t i = 0; i < tr->motion.count; i++) hd_prediction_renew(&tr->motion, i);
    return HD_OK;
}

void hd_hard_clear(hard *tr)
{
    hd_cells_clear(&tr->motion.cells);
    hd_sizes_clear(&tr->motion.sizes);
    hd_queue_clear(&tr->motion.queue);
    hd_memory_free(tr->motion.disk);
    hd_memory_free(tr->motion.predicted);
}

static void release(hard *tr)
{
    hd_hard_clear(tr);
    hd_memory_free(tr);
}

static hd_status lattice(const hd_scene_def *def, double *q)
{
    if (HD_MIXED) return hd_hard_grow(def, q);
    hd_container_of(def)->start(def, q);
    return HD_OK;
}

static void move(hard *tr, hd_disk *disk, double t)
{
    if (tr->flow.wall) hd_flow_fly(&tr->flow, tr->flow.sum, disk, t);
    hd_disk_move_to(disk, t);
}

static bool finish(hard *tr, int32_t i, double t)
{
    hd_disk *disk = &tr->motion.disk[i];
    double all = 0.0;
    move(tr, disk, t);
    hd_cells_fold(&tr->motion.cells, disk);
    for (int d = 0; d < HD_DIM; d++) all += disk->q[d] + disk->p[d];
    return isfinite(all);
}

static bool rests(const hard *tr, int32_t i)
{
    for (int d = 0; d < HD_DIM; d++)
        if (tr->motion.disk[i].p[d] != 0) return false;
    return true;
}

static void renew(hard *tr, int32_t i) { hd_prediction_renew(&tr->motion, i); }

static void extend(hard *tr, int32_t i, int d, int side)
{
    hd_prediction_extend(&tr->motion, i, d, side);
}

#include "dynamics/hard/scheme.h"

/* ---- events -------------------------------------------------------------------------------- */

/** r.r - s2 to twice the working precision (Dekker's product, Knuth's sum). */
static double square_minus(const double r[HD_DIM], double s2)
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
    return (all - s2) + lost;
}

/** Exchanges the normal momenta of two disks that are r apart, which changes momenta over masses by
 * shares. s: the distance at which they touch; approach: r.p over s^2; excess: (r.r - s^2) / s^2.
 * Returns false if they only graze: if they do not approach by more than momenta round. Such an
 * exchange might not change the momenta, and the pair would meet again at once, forever; so the
 * disks are pushed apart, by more than rounding, along the longest component of r. */
static bool exchange(hd_disk *a, hd_disk *b, const double share[2], const double r[HD_DIM],
                     double s, double approach, double excess)
{
    double size = 0.0;
    for (int d = 0; d < HD_DIM; d++) size += fabs(a->p[d]);
    for (int d = 0; d < HD_DIM; d++) size += fabs(b->p[d]);
    const double lost = 8.0 * DBL_EPSILON * size;
    if (approach * s < -lost) {
        /* approach / r.r to first order; dividing by the rounded r.r would let the energy drift by
         * 3e-16 in each collision */
        const double per_r = approach - approach * excess;
        for (int d = 0; d < HD_DIM; d++) {
            a->p[d] += share[0] * (per_r * r[d]);
            b->p[d] -= share[1] * (per_r * r[d]);
        }
        return true;
    }
    if (approach < 0) {
        int d = 0;
        for (int e = 1; e < HD_DIM; e++) d = fabs(r[e]) > fabs(r[d]) ? e : d;
        a->p[d] -= share[0] * copysign(lost, r[d]);
        b->p[d] += share[1] * copysign(lost, r[d]);
    }
    return false;
}

/** Adds to the virial what a wall gives to a disk that is larger or smaller than the mean of all:
 * for gas the wall's force acts at the distance of the mean radius from it. The event is filled. */
static void press(hard *tr, const hd_event *event, int32_t i)
{
    const hd_sizes *sizes = &tr->motion.sizes;
    const double n2 = hd_contact_dot(event->n, event->n),
                 along = hd_contact_dot(event->n, event->p);
    const double impulse = 2.0 * hd_sizes_mass(sizes, i) * fabs(along) / (n2 * sqrt(n2)),
                 beyond = hd_sizes_radius(sizes, &tr->motion.disk[i]) - sizes->mean;
    for (int d = 0; d < HD_DIM; d++) tr->virial[d] += impulse * beyond * event->n[d] * event->n[d];
}

/** Reflects a disk at a curved wall [T21]. */
static hd_status reflect_round(hard *tr, hd_record *record, hd_event *event, double t)
{
    const int32_t i = (int32_t)event->i;
    hd_disk *disk = &tr->motion.disk[i];
    hd_disk_move_to(disk, t);
    const bool reflected = hd_round_wall_reflect(hd_motion_wall(&tr->motion, disk), disk, event);
    if (HD_MIXED && reflected) press(tr, event, i);
    disk->collisions++;
    tr->wall_events += reflected;
    hd_prediction_renew(&tr->motion, i);
    return reflected ? put(record, event) : HD_OK;
}

/** Moves two disks to their contact and exchanges their normal momenta [T3]. */
static hd_status collide(hard *tr, hd_record *record, hd_event *contact, int32_t found_by, double t)
{
    if (contact->j == tr->motion.count) return reflect_round(tr, record, contact, t);
    hd_event event = *contact;
    const int32_t i = (int32_t)event.i, j = (int32_t)event.j;
    hd_disk *a = &tr->motion.disk[i], *b = &tr->motion.disk[j];
    const prediction *how = &tr->motion.predicted[found_by];
    const double sign = 1.0 - 2.0 * (found_by != i); /* the image is relative to found_by */
    double shift[HD_DIM], r[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) shift[d] = sign * how->image[d] * tr->motion.cells.box[d];
    move(tr, a, t);
    move(tr, b, t);
    hd_contact_separation(r, a, b, shift, t);
    const double distance = sqrt(hd_contact_dot(r, r));
    double approach = 0;
    for (int d = 0; d < HD_DIM; d++) {
        event.n[d] = r[d] / distance;
        event.p[d] = b->p[d] - a->p[d];
        approach += event.p[d] * r[d];
    }
    const hd_sizes *sizes = &tr->motion.sizes;
    const double s = hd_sizes_radius(sizes, a) + hd_sizes_radius(sizes, b), s2 = s * s;
    const double share[2] = {hd_sizes_share(sizes, i, j), hd_sizes_share(sizes, j, i)};
    const double excess = square_minus(r, s2) / s2;
    if (excess * s < -2.0 * tr->overlap_max) return HD_OVERLAP;
    hd_status status = HD_OK;
    if (exchange(a, b, share, r, s, approach / s2, excess)) {
        tr->collisions++;
        if (HD_MIXED) tr->collisions_of[hd_sizes_kind(sizes, i) + hd_sizes_kind(sizes, j)]++;
        approach *= hd_sizes_mass(sizes, i) * share[0];
        for (int d = 0; d < HD_DIM; d++) tr->virial[d] -= approach * event.n[d] * event.n[d];
        status = put(record, &event);
    }
    a->collisions++;
    b->collisions++;
    hd_cells_fold(&tr->motion.cells, a);
    hd_cells_fold(&tr->motion.cells, b);
    hd_prediction_renew(&tr->motion, found_by); /* first: always the queue's head, predictable */
    hd_prediction_renew(&tr->motion, i + j - found_by);
    return status;
}

/** Disk i meets a flat wall, and is reflected [T4] unless the wall has a rule of its own. */
static hd_status reflect(hard *tr, hd_record *record, hd_event *event, int32_t i, double t)
{
    hd_disk *disk = &tr->motion.disk[i];
    const prediction *how = &tr->motion.predicted[i];
    const int d = how->direction;
    const hd_cell_line *line = &tr->motion.cells.line[d][disk->cell[d]];
    move(tr, disk, t);
    disk->q[d] = hd_cell_line_end(line, how->side == HIGH, /* so that rounding never adds up */
                                  hd_sizes_radius(&tr->motion.sizes, disk));
    event->n[d] = 1.0;
    for (int e = 0; e < HD_DIM; e++) event->p[e] = disk->p[e];
    if (HD_MIXED) press(tr, event, i);
    if (tr->flow.wall)
        hd_flow_strike(&tr->flow, disk, event);
    else
        disk->p[d] = -disk->p[d];
    disk->collisions++;
    hd_cells_fold(&tr->motion.cells, disk);
    tr->wall_events++;
    hd_prediction_renew(&tr->motion, i);
    if (tr->flow.wall && hd_flow_is_jammed(&tr->flow, t)) return HD_JAMMED;
    return put(record, event);
}

hd_status hd_hard_advance(void *state, hd_record *record, double t_end)
{
    return advance(state, record, t_end);
}

/* ---- creation ------------------------------------------------------------------------------ */

double hd_hard_rate(const hd_scene_def *def)
{
    return 0.5 * hd_dynamics_of(def)->fluid->rate(def) * def->number;
}

double hd_hard_with_walls(const hd_scene_def *def, double rate)
{
    const double largest = HD_MIXED ? hd_kinds_largest(def) : 1.0;
    double box[HD_DIM];
    hd_scene_box(def, box);
    for (int d = 0; d < HD_DIM; d++)
        if (hd_scene_boundary(def, d) != HD_PERIODIC) rate += 1.0 / (box[d] - largest);
    return rate;
}

double hd_hard_entries(const hd_scene_def *def)
{
    return def->number * hd_hard_with_walls(def, 0.5 * hd_dynamics_of(def)->fluid->rate(def));
}

double hd_hard_bytes(const hd_scene_def *scene)
{
    /* bytes of a disk, its cells, its entry in the queue and its prediction */
    static const double OF_A_DISK = HD_DIM == 2 ? 255.0 : 310.0;
    /* its own radius, while a start grows it */
    static const double OF_ITS_SIZE = HD_MIXED ? sizeof(double) + sizeof(hd_wall) : 0.0;
    return (OF_A_DISK + OF_ITS_SIZE) * scene->number;
}

void hd_hard_free(void *state)
{
    if (state) release(state);
}

hd_status hd_hard_create(void **state, const hd_scene_def *def)
{
    return create_on_lattice(state, def);
}

hd_status hd_hard_create_empty(void **state, const hd_scene_def *def)
{
    hard *tr = *state = hd_memory_alloc(1, sizeof *tr);
    if (!tr) return HD_NO_MEMORY;
    const hd_status status = prepare(tr, def);
    for (int32_t i = 0; i < tr->motion.count && status == HD_OK; i++)
        tr->motion.disk[i].size = (uint32_t)hd_sizes_kind(&tr->motion.sizes, i);
    if (status == HD_OK) return HD_OK;
    release(tr);
    *state = NULL;
    return status;
}

hd_status hd_hard_create_from(void **state, const hd_scene_def *def, const double *q,
                              const double *p)
{
    *state = NULL;
    HD_TRY(hd_scene_check_box(def, NULL, 0));
    return create_at(state, def, q, p);
}
