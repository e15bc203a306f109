/** Creates hard particles and moves them from event to event. This is the code that all hard
 * particles share; see hard.c for the scheme. A file that includes this one defines before it, for
 * its particles:
 *   hd_entry: an entry of the record, which begins with t, i, j;
 *   hd_bodies: the state, whose first member is a `hard`;
 *   HD_HALF: the number of coordinates of a particle;
 *   prepare(state, scene): allocates; release(state): frees;
 *   lattice(scene, q): fills start positions, or fails; start(state, q, p): takes them over, or
 *   refuses;
 *   finish(state, i, t): moves particle i to time t, without a new prediction; returns false if one
 *   of its numbers is not finite;
 *   rests(state, i): whether particle i never moves;
 *   renew(state, i), extend(state, i, d, side): do as hd_prediction_renew, hd_prediction_extend;
 * and after it
 *   collide(state, record, entry, i, t): the contact that i has predicted happens, and is recorded;
 *   t, i, j of the entry are filled;
 *   reflect(state, record, entry, i, t): i meets a wall, likewise. */
#ifndef HD_SCHEME_H
#define HD_SCHEME_H

#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/hard/prefetch.h"
#include "dynamics/record.h"
#include "scene/null_space.h"
#include "scene/scene_check.h"

static hd_status collide(hd_bodies *all, hd_record *record, hd_entry *entry, int32_t i, double t);
static hd_status reflect(hd_bodies *all, hd_record *record, hd_entry *entry, int32_t i, double t);

static hd_status put(hd_record *record, const hd_entry *event)
{
    if (!record) return HD_OK;
    if (record->count == record->capacity) HD_TRY(hd_record_reserve(record, record->count + 1));
    ((hd_entry *)record->entry)[record->count++] = *event;
    return HD_OK;
}

/** Moves a particle over the edge of its cell. Only the cells at that side come into reach. */
static void cross(hd_bodies *all, int32_t i)
{
    hd_motion *m = &((hard *)all)->motion;
    const int d = m->predicted[i].direction, side = m->predicted[i].side;
    hd_cells_cross(&m->cells, m->disk, i, d, side);
    extend(all, i, d, side);
}

/** Does the event of i, the head of the queue. begin: the record's start in this epoch's time. */
static hd_status take_event(hd_bodies *all, hd_record *record, int32_t i, double begin)
{
    const hd_motion *m = &((hard *)all)->motion;
    const hd_queue_key key = m->queue.entry[i].key;
    const prediction *next = &m->predicted[i];
    const int kind = hd_queue_kind(key.order);
    if (kind == EDGE) {
        cross(all, i);
        return HD_OK;
    }
    if (kind != WALL && next->partner_collisions != m->disk[next->partner].collisions) {
        renew(all, i); /* stale */
        return HD_OK;
    }
    hd_entry entry = {.t = key.t > begin ? key.t - begin : 0.0,
                      .i = hd_queue_i(key.order),
                      .j = hd_queue_j(key.order)};
    return kind == WALL ? reflect(all, record, &entry, i, key.t)
                        : collide(all, record, &entry, i, key.t);
}

/** Moves all particles to the end of the epoch, which becomes time 0, and predicts all anew. */
static hd_status turn_epoch(hd_bodies *all)
{
    hard *tr = (hard *)all;
    for (int32_t i = 0; i < tr->motion.count; i++) {
        hd_disk *disk = &tr->motion.disk[i];
        if (!finish(all, i, tr->epoch_length)) return HD_NOT_FINITE;
        disk->t = 0;
        disk->collisions++;
        tr->motion.predicted[i].contact = INFINITY;
    }
    tr->epoch_start += tr->epoch_length;
    hd_queue_restart(&tr->motion.queue);
    for (int32_t i = 0; i < tr->motion.count; i++) renew(all, i);
    return HD_OK;
}

/** Ends the epoch. If all particles are at rest, many epochs are passed at once. */
static hd_status turn_epochs(hd_bodies *all, double t_end)
{
    hard *tr = (hard *)all;
    HD_TRY(turn_epoch(all));
    const double left = t_end - tr->epoch_start;
    if (!(left > tr->epoch_length)) return HD_OK;
    for (int32_t i = 0; i < tr->motion.count; i++)
        if (!rests(all, i)) return HD_OK;
    tr->epoch_start += floor(left / tr->epoch_length) * tr->epoch_length;
    return HD_OK;
}

static hd_status advance(hd_bodies *all, hd_record *record, double t_end)
{
    hard *tr = (hard *)all;
    HD_ASSERT(t_end >= tr->now);
    const double t_begin = record ? tr->now - record->duration : tr->now;
    if (record) record->duration = t_end - t_begin;
    for (;;) {
        const double end = t_end - tr->epoch_start;
        const int32_t bucket = tr->motion.queue.now, i = hd_queue_next(&tr->motion.queue);
        if (tr->motion.queue.now != bucket) hd_prefetch_ahead(&tr->motion, bucket);
        if (i >= 0 && tr->motion.queue.entry[i].key.t < end &&
            tr->motion.queue.entry[i].key.t < tr->epoch_length) {
            HD_TRY(take_event(all, record, i, t_begin - tr->epoch_start));
        } else if (end > tr->epoch_length) {
            HD_TRY(turn_epochs(all, t_end));
        } else {
            break;
        }
    }
    tr->now = t_end;
    return HD_OK;
}

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status create_at(void **state, const hd_scene_def *def, const double *q, const double *p)
{
    *state = NULL;
    hd_bodies *all = hd_memory_alloc(1, sizeof *all);
    if (!all) return HD_NO_MEMORY;
    hd_status status = prepare(all, def);
    if (status == HD_OK) status = start(all, q, p);
    if (status == HD_OK)
        *state = all;
    else
        release(all);
    return status;
}

/** Creates particles on the start lattice, with the momenta of the scene's seed. */
static hd_status create_on_lattice(void **state, const hd_scene_def *def)
{
    *state = NULL;
    HD_TRY(hd_scene_check_start(def, NULL, 0));
    double *q = hd_memory_alloc(HD_HALF * (size_t)def->number, sizeof *q);
    double *p = hd_memory_alloc(HD_HALF * (size_t)def->number, sizeof *p);
    hd_status status = HD_NO_MEMORY;
    if (q && p) {
        status = lattice(def, q);
        if (status == HD_OK) hd_null_space_momenta(def, q, p);
        if (status == HD_OK) status = create_at(state, def, q, p);
    }
    hd_memory_free(q);
    hd_memory_free(p);
    return status;
}

#endif
