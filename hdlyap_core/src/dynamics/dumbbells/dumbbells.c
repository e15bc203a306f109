/** Scene -> record: event-driven motion of hard dumbbells between periodic or reflecting edges, by
 * the scheme of dynamics/hard/hard.c: every molecule keeps the state of its last event, and what is
 * predicted depends on these states alone. A molecule and its mirror images meet as a billiard does
 * [T23]. One thread. Only + - * / sqrt and comparisons: the same bits everywhere. */
#include "dynamics/dumbbells/dumbbells_state.h"

#include <float.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/dumbbells/bump.h"
#include "dynamics/dumbbells/meeting.h"
#include "dynamics/dumbbells/next.h"
#include "dynamics/dumbbells/shape.h"
#include "dynamics/dumbbells/start.h"
#include "dynamics/hard/nearby.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "scene/scene_check.h"

/** Faster molecules would lose the digits of their places within one epoch: momentum, and angle in
 * a time unit. */
static const double FASTEST = 1e6;

/* ---- contacts ------------------------------------------------------------------------------ */

/** From a disk of a to a disk of b, whose image is `shift` away, now. */
static void between(double r[2], const hd_molecules *m, const int32_t pair[2],
                    const double shift[2], double t, const double arms[2][2])
{
    hd_contact_separation(r, &m->disk[pair[0]], &m->disk[pair[1]], shift, t);
    for (int d = 0; d < 2; d++) r[d] += arms[1][d] - arms[0][d];
}

/** Fills what the gradient needs of disk k. */
static void turn_fill(hd_bump *bump, const hd_molecules *m, int k, int32_t i, const double arm[2])
{
    bump->per_root = 1.0 / m->shape.root;
    bump->spin[k] = m->spin[i].p;
    bump->across[k] = (bump->n[1] * arm[0] - bump->n[0] * arm[1]) / m->shape.root;
    bump->along[k] = (bump->n[0] * arm[0] + bump->n[1] * arm[1]) / m->shape.root;
}

/** What meets exchanges, along the gradient: of a gap that closes at `rate`, and the square of its
 * gradient. An approach that is lost in the rounding of the momenta is turned into a parting that
 * rounding cannot take back, or they would meet again for ever; that is no event. */
static double exchanged(bool *meets, double rate, double square, double momenta)
{
    const double lost = 8.0 * DBL_EPSILON * momenta;
    *meets = rate < -lost;
    return *meets ? -2.0 * rate / square : rate < 0 ? (lost - rate) / square : 0.0;
}

static double momenta_of(const hd_molecules *m, int32_t i)
{
    return fabs(m->disk[i].p[0]) + fabs(m->disk[i].p[1]) + fabs(m->spin[i].p);
}

static void push(hd_molecules *m, int32_t i, double by, const double n[2], double across)
{
    for (int d = 0; d < 2; d++) m->disk[i].p[d] += by * n[d];
    m->spin[i].p += by * across;
    m->disk[i].collisions++;
    hd_molecule_fold(m, &m->disk[i], &m->spin[i]);
}

static hd_status write(hd_record *record, const hd_bump *bump)
{
    return record ? hd_record_put(record, bump) : HD_OK;
}

/** Moves both to their contact, where they exchange momentum. */
static hd_status collide(dumbbells *all, hd_record *record, hd_bump *bump, int32_t finder, double t)
{
    hd_molecules *m = &all->m;
    const hd_next how = m->next[finder];
    const int32_t pair[2] = {(int32_t)bump->i, (int32_t)bump->j};
    const double sign = finder == pair[0] ? 1.0 : -1.0; /* the image is seen from the finder */
    double arms[2][2], shift[2], r[2], turning = 0.0;
    for (int d = 0; d < 2; d++) shift[d] = sign * how.image[d] * m->cells.box[d];
    for (int k = 0; k < 2; k++) {
        hd_molecule_move_to(&m->disk[pair[k]], &m->spin[pair[k]], t);
        hd_arm_at(arms[k], m, pair[k], how.which >> k & 1, t);
        turning += fabs(m->spin[pair[k]].p / m->shape.root);
    }
    between(r, m, pair, shift, t, (const double(*)[2])arms);
    const double distance = sqrt(hd_contact_dot(r, r));
    for (int d = 0; d < 2; d++) {
        bump->n[d] = r[d] / distance;
        bump->p[d] = m->disk[pair[1]].p[d] - m->disk[pair[0]].p[d];
    }
    for (int k = 0; k < 2; k++) turn_fill(bump, m, k, pair[k], arms[k]);
    if (distance - 1.0 < -HD_OVERLAP_MAX - hd_meeting_depth(m, turning)) return HD_OVERLAP;
    const double rate = hd_contact_dot(bump->n, bump->p) + bump->across[1] * bump->spin[1] -
                        bump->across[0] * bump->spin[0];
    const double square = 2.0 * hd_contact_dot(bump->n, bump->n) +
                          bump->across[0] * bump->across[0] + bump->across[1] * bump->across[1];
    bool meets;
    const double by = exchanged(&meets, rate, square,
                                momenta_of(m, pair[0]) + momenta_of(m, pair[1]));
    for (int k = 0; k < 2; k++) push(m, pair[k], (2 * k - 1) * by, bump->n, bump->across[k]);
    all->collisions += meets;
    for (int d = 0; d < 2 && meets; d++)
        all->virial[d] += by * bump->n[d] * (r[d] - arms[1][d] + arms[0][d]);
    hd_next_renew(m, finder);
    hd_next_renew(m, pair[0] + pair[1] - finder);
    return meets ? write(record, bump) : HD_OK;
}

/** A disk of a molecule meets a wall. */
static hd_status reflect(dumbbells *all, hd_record *record, hd_bump *bump, int32_t i, double t)
{
    hd_molecules *m = &all->m;
    const int d = -1 - m->next[i].partner, which = m->next[i].which;
    double arm[2];
    hd_molecule_move_to(&m->disk[i], &m->spin[i], t);
    hd_arm_at(arm, m, i, which & 1, t);
    bump->j = -1.0;
    bump->n[d] = which >> 1 ? -1.0 : 1.0;
    for (int e = 0; e < 2; e++) bump->p[e] = m->disk[i].p[e];
    turn_fill(bump, m, 0, i, arm);
    const double rate = hd_contact_dot(bump->n, bump->p) + bump->across[0] * bump->spin[0];
    bool meets;
    const double by = exchanged(&meets, rate, 1.0 + bump->across[0] * bump->across[0],
                                momenta_of(m, i));
    push(m, i, by, bump->n, bump->across[0]);
    all->wall_events += meets;
    if (meets) all->virial[d] -= by * bump->n[d] * arm[d];
    hd_next_renew(m, i);
    return meets ? write(record, bump) : HD_OK;
}

static void cross(hd_molecules *m, int32_t i)
{
    const int d = m->next[i].direction, side = m->next[i].side;
    hd_cells_cross(&m->cells, m->disk, i, d, side);
    hd_next_extend(m, i, d, side);
}

/* ---- time ---------------------------------------------------------------------------------- */

/** The event at the head of the queue; begin is the record's start in this epoch's time. */
static hd_status take_event(dumbbells *all, hd_record *record, int32_t i, double begin)
{
    hd_molecules *m = &all->m;
    const hd_queue_key key = m->queue.entry[i].key;
    hd_bump bump = {.t = key.t > begin ? key.t - begin : 0.0,
                    .i = hd_queue_i(key.order),
                    .j = hd_queue_j(key.order)};
    switch (hd_queue_kind(key.order)) {
    case HD_MEETING_WALL: return reflect(all, record, &bump, i, key.t);
    case HD_EDGE: cross(m, i); return HD_OK;
    default: break;
    }
    if (m->next[i].partner_collisions == m->disk[m->next[i].partner].collisions)
        return collide(all, record, &bump, i, key.t);
    hd_next_renew(m, i); /* stale */
    return HD_OK;
}

/** Brings all to the epoch's end, which becomes time 0, and predicts everything anew. */
static hd_status turn_epoch(dumbbells *all)
{
    hd_molecules *m = &all->m;
    for (int32_t i = 0; i < m->count; i++) {
        hd_disk *disk = &m->disk[i];
        hd_molecule_move_to(disk, &m->spin[i], m->epoch_length);
        hd_molecule_fold(m, disk, &m->spin[i]);
        disk->t = 0.0;
        disk->collisions++;
        if (!isfinite(disk->q[0] + disk->q[1] + m->spin[i].q + momenta_of(m, i)))
            return HD_NOT_FINITE;
    }
    all->epoch_start += m->epoch_length;
    hd_next_restart(m);
    return HD_OK;
}

hd_status hd_dumbbells_advance(void *state, hd_record *record, double t_end)
{
    dumbbells *all = state;
    hd_molecules *m = &all->m;
    HD_ASSERT(t_end >= all->now);
    const double t_begin = record ? all->now - hd_record_duration(record) : all->now;
    if (record) hd_record_end(record, t_end - t_begin);
    for (;;) {
        const double end = t_end - all->epoch_start;
        const int32_t i = hd_queue_next(&m->queue);
        const double t = i >= 0 ? m->queue.entry[i].key.t : INFINITY;
        if (t < end && t < m->epoch_length)
            HD_TRY(take_event(all, record, i, t_begin - all->epoch_start));
        else if (end > m->epoch_length)
            HD_TRY(turn_epoch(all));
        else
            break;
    }
    all->now = t_end;
    return HD_OK;
}

/* ---- gaps ---------------------------------------------------------------------------------- */

static double least_between(const hd_molecules *m, const int32_t pair[2], const double shift[2],
                            double t)
{
    double least = INFINITY;
    for (int which = 0; which < HD_MEETS; which++) {
        double arms[2][2], r[2];
        for (int k = 0; k < 2; k++) hd_arm_at(arms[k], m, pair[k], which >> k & 1, t);
        between(r, m, pair, shift, t, (const double(*)[2])arms);
        least = fmin(least, sqrt(hd_contact_dot(r, r)) - 1.0);
    }
    return least;
}

static double least_nearby(const hd_molecules *m, int32_t i, const hd_nearby *near, double t)
{
    double least = INFINITY;
    for (int k = 0; k < near->count; k++) {
        const int32_t pair[2] = {i, near->disk[k]};
        double shift[2];
        for (int d = 0; d < 2; d++)
            shift[d] = (near->image[d][k] - m->disk[pair[1]].wrap[d]) * m->cells.box[d];
        if (pair[1] > i) least = fmin(least, least_between(m, pair, shift, t));
    }
    return least;
}

static double least_listed(const hd_molecules *m, int32_t i, int k, double t)
{
    const hd_cell *cell = hd_cells_near(&m->cells, &m->disk[i], k);
    double least = INFINITY;
    hd_nearby near;
    for (int32_t j = cell->crowded ? cell->disk[HD_CELL_DISKS - 1] : -1; j >= 0;) {
        j = hd_nearby_listed(&near, &m->cells, &m->disk[i], k, j);
        least = fmin(least, least_nearby(m, i, &near, t));
    }
    return least;
}

static double least_at_walls(const hd_molecules *m, int32_t i, double t)
{
    double arm[2], least = INFINITY;
    hd_arm_at(arm, m, i, 0, t);
    for (int d = 0; d < 2; d++) {
        const double at = m->disk[i].q[d] + m->disk[i].p[d] * (t - m->disk[i].t),
                     reach = 0.5 + fabs(arm[d]);
        if (m->cells.boundary[d] != HD_REFLECTING) continue;
        least = fmin(least, fmin(at - reach, m->cells.box[d] - reach - at));
    }
    return least;
}

double hd_dumbbells_rounding(const dumbbells *all)
{
    double fastest = 0.0;
    for (int32_t i = 0; i < all->m.count; i++) fastest = fmax(fastest, fabs(all->m.spin[i].p));
    return hd_meeting_depth(&all->m, 2.0 * fastest / all->m.shape.root);
}

double hd_dumbbells_gap(const dumbbells *all)
{
    const hd_molecules *m = &all->m;
    const double t = all->now - all->epoch_start;
    double least = INFINITY;
    for (int32_t i = 0; i < m->count; i++) {
        hd_nearby near;
        hd_nearby_around(&near, &m->cells, &m->disk[i]);
        least = fmin(least, fmin(least_nearby(m, i, &near, t), least_at_walls(m, i, t)));
        for (int k = 0; k < HD_CELLS_AROUND; k++) least = fmin(least, least_listed(m, i, k, t));
    }
    return least;
}

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status prepare(dumbbells *all, const hd_scene_def *def)
{
    hd_molecules *m = &all->m;
    double longest = 0.0;
    m->count = def->number;
    m->shape.arm = 0.5 * hd_dumbbell_bond(def);
    m->shape.root = sqrt(hd_dumbbell_inertia(def));
    m->shape.turn = 6.28318530717958647693 * m->shape.root;
    m->epoch_length = hd_epoch_length(hd_fluid_dumbbells.rate(def));
    m->disk = hd_memory_alloc((size_t)m->count, sizeof *m->disk);
    m->spin = hd_memory_alloc((size_t)m->count, sizeof *m->spin);
    m->next = hd_memory_alloc((size_t)m->count, sizeof *m->next);
    if (!m->disk || !m->spin || !m->next) return HD_NO_MEMORY;
    HD_TRY(hd_cells_create(&m->cells, def, 1.0 + 2.0 * m->shape.arm));
    for (int d = 0; d < 2; d++) longest = fmax(longest, m->cells.box[d]);
    m->rounding = fmax(1e-13, hd_overlap_rounding(longest, m->epoch_length));
    return hd_queue_create(&m->queue, m->count, m->epoch_length);
}

static hd_status start(dumbbells *all, const double *q, const double *p)
{
    hd_molecules *m = &all->m;
    for (int32_t i = 0; i < m->count; i++, q += 3, p += 3) {
        for (int d = 0; d < 2; d++) {
            m->disk[i].q[d] = q[d];
            m->disk[i].p[d] = p[d];
            if (!(q[d] >= 0 && q[d] <= m->cells.box[d])) return HD_REFUSED;
        }
        m->spin[i] = (hd_spin){q[2], p[2]};
        if (!(momenta_of(m, i) <= FASTEST * fmax(1.0, m->shape.root)) || !isfinite(q[2]))
            return HD_REFUSED;
        if (!(fabs(p[2]) <= FASTEST * m->shape.root)) return HD_REFUSED;
        m->spin[i].q -= floor(m->spin[i].q / m->shape.turn + 0.5) * m->shape.turn;
        hd_cells_add(&m->cells, m->disk, i);
    }
    if (hd_dumbbells_gap(all) < -hd_dumbbells_overlap_max(all)) return HD_OVERLAP;
    hd_next_restart(m);
    return HD_OK;
}

void hd_dumbbells_free(void *state)
{
    dumbbells *all = state;
    if (!all) return;
    hd_cells_clear(&all->m.cells);
    hd_queue_clear(&all->m.queue);
    hd_memory_free(all->m.disk);
    hd_memory_free(all->m.spin);
    hd_memory_free(all->m.next);
    hd_memory_free(all);
}

static hd_status create_at(void **state, const hd_scene_def *def, const double *q, const double *p)
{
    dumbbells *all = hd_memory_alloc(1, sizeof *all);
    if (!all) return HD_NO_MEMORY;
    hd_status status = prepare(all, def);
    if (status == HD_OK) status = start(all, q, p);
    if (status == HD_OK)
        *state = all;
    else
        hd_dumbbells_free(all);
    return status;
}

static hd_status create_on_lattice(void **state, const hd_scene_def *def)
{
    double *q = hd_memory_alloc(3 * (size_t)def->number, sizeof *q);
    double *p = hd_memory_alloc(3 * (size_t)def->number, sizeof *p);
    hd_status status = HD_NO_MEMORY;
    if (q && p) {
        hd_dumbbell_start(def, q);
        hd_null_space_momenta(def, q, p);
        status = create_at(state, def, q, p);
    }
    hd_memory_free(q);
    hd_memory_free(p);
    return status;
}

hd_status hd_dumbbells_create(void **state, const hd_scene_def *def)
{
    *state = NULL;
    HD_TRY(hd_scene_check_start(def, NULL, 0));
    return create_on_lattice(state, def);
}

hd_status hd_dumbbells_create_from(void **state, const hd_scene_def *def, const double *q,
                                   const double *p)
{
    *state = NULL;
    HD_TRY(hd_scene_check_box(def, NULL, 0));
    HD_TRY(hd_dumbbells_check_box(def, NULL, 0));
    return create_at(state, def, q, p);
}
