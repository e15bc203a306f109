/** Memory that messages are made in. */
#include "topics/moment.h"

#include <stdlib.h>

/** What was in it is lost. False without memory. */
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

bool moment_state(const moment *now, const double **q, const double **p)
{
    buffers *room = now->room;
    const size_t count = (size_t)(moment_dimension(now) * now->set->def.number);
    if (!room->q) room->q = malloc(2 * count * sizeof *room->q);
    if (!room->q) {
        log_lost(now);
        return false;
    }
    room->p = room->q + count;
    if (!room->known) hd_trajectory_state(hd_run_parts(now->run).trajectory, room->q, room->p);
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
