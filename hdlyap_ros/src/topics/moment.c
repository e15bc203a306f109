/** Memory for the arrays of messages. */
#include "topics/moment.h"

#include <math.h>
#include <stdlib.h>

/** Makes a block as large as wanted; its contents are lost. Returns false if there is no memory. */
static bool grow(void **block, size_t *size, size_t wanted)
{
    if (*block && wanted <= *size) return true;
    void *larger = realloc(*block, wanted + 1);
    if (!larger) return false;
    *block = larger;
    *size = wanted;
    return true;
}

static void log_lost(const moment *now)
{
    hdr_log(HDR_ERROR, "%s not sent: out of memory", topic_name(now->topic));
}

void *moment_take(const moment *now, size_t count, size_t size)
{
    buffers *room = now->room;
    const int k = room->taken++;
    if (k < BUFFERS && grow(&room->block[k], &room->size[k], count * size)) return room->block[k];
    log_lost(now);
    return NULL;
}

/** Fills angles and angular velocities, which lie behind the momenta. */
static void turn(const moment *now, buffers *room, size_t count)
{
    static const double whole = 6.28318530717958647693;
    const size_t step = (size_t)moment_coordinates(now), last = step - 1;
    const double root = sqrt(hd_scene_inertia(&now->set->def));
    room->angle = room->momenta + step * count;
    for (size_t j = 0; j < count; j++) {
        const double angle = room->q[step * j + last] / root;
        room->angle[j] = angle - whole * floor(angle / whole);
        room->angle[count + j] = room->p[step * j + last] / root;
    }
}

/** Fills momenta of particles of several masses. */
static void weigh(const moment *now, buffers *room)
{
    const hd_scene_def *def = &now->set->def;
    const size_t each = (size_t)moment_coordinates(now);
    hd_kind kind[HD_KINDS_MAX];
    const int kinds = hd_scene_kinds(def, kind);
    size_t k = 0;
    for (int a = 0; a < kinds; a++)
        for (size_t n = each * (size_t)kind[a].number; n > 0; n--, k++)
            room->momenta[k] = room->p[k] * sqrt(kind[a].mass);
}

bool moment_state(const moment *now, const double **q, const double **p)
{
    buffers *room = now->room;
    const size_t count = (size_t)(moment_coordinates(now) * now->set->def.number),
                 angles = moment_turns(now) ? (size_t)now->set->def.number : 0;
    if (!room->q) room->q = malloc((3 * count + 2 * angles) * sizeof *room->q);
    if (!room->q) {
        log_lost(now);
        return false;
    }
    room->p = room->q + count;
    room->momenta = room->p + count;
    if (!room->known) hd_trajectory_state(hd_run_parts(now->run).trajectory, room->q, room->p);
    if (!room->known) weigh(now, room);
    if (!room->known && angles > 0) turn(now, room, angles);
    room->known = true;
    *q = room->q;
    *p = room->p;
    return true;
}

void buffers_clear(buffers *room)
{
    for (int k = 0; k < BUFFERS; k++) free(room->block[k]);
    free(room->q);
}
