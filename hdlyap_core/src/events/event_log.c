/** Storage of an interval's events; it only grows. */
#include "events/event_log.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/memory.h"
#include "events/archived.h"
#include "events/contact.h"
#include "events/round_wall.h"

double hd_event_log_bytes(double events)
{
    static const double OF_AN_EVENT = HD_DIM == 2 ? 130.0 : 170.0;
    return OF_AN_EVENT * events;
}

hd_status hd_event_log_create(hd_event_log **out)
{
    *out = hd_memory_alloc(1, sizeof **out);
    return *out ? HD_OK : HD_NO_MEMORY;
}

void hd_event_log_free(hd_event_log *log)
{
    if (!log) return;
    hd_memory_free(log->event);
    hd_memory_free(log);
}

void hd_event_log_clear(hd_event_log *log)
{
    log->count = 0;
    log->duration = 0.0;
}

hd_status hd_event_log_reserve(hd_event_log *log, size_t count)
{
    size_t capacity = log->capacity ? log->capacity : HD_EVENTS_FIRST;
    while (capacity < count) capacity *= 2;
    if (capacity == log->capacity) return HD_OK;
    hd_event *grown = hd_memory_alloc(capacity, sizeof *grown);
    if (!grown) return HD_NO_MEMORY;
    if (log->count) memcpy(grown, log->event, log->count * sizeof *grown);
    hd_memory_free(log->event);
    log->event = grown;
    log->capacity = capacity;
    return HD_OK;
}

/* ---- checks -------------------------------------------------------------------------------- */

static bool disks_exist(const hd_event *event, int disks)
{
    if (event->i < 0 || event->i >= disks) return false;
    return (event->j < 0 && event->j >= HD_WALL_ROUND) || (event->j > event->i && event->j < disks);
}

/** Flat walls lie in a box, round ones in a circle. */
static bool wall_exists(const hd_event *event, double reach)
{
    return event->j == HD_WALL_ROUND ? reach > 0
                                     : event->j >= 0 || (event->j > HD_WALL_ROUND && reach == 0);
}

/** Its length is 1, or the radius of a round wall: a quotient of a vector and its length is right
 * to an ulp or two. */
static bool is_normal(const hd_event *event, double reach)
{
    const bool is_round = event->j == HD_WALL_ROUND; /* one more product */
    const double square = is_round ? reach * reach : 1.0, roundings = is_round ? 12.0 : 8.0;
    return fabs(hd_contact_dot(event->n, event->n) - square) <= roundings * DBL_EPSILON * square;
}

/** Within the rounding of the normal; a round wall is reached outwards. */
static bool approach(const hd_event *event)
{
    const double speed = sqrt(hd_contact_dot(event->p, event->p));
    if (event->j == HD_WALL_ROUND) return hd_contact_dot(event->n, event->p) > 0;
    return hd_contact_dot(event->n, event->p) <= 4.0 * DBL_EPSILON * speed;
}

const char *hd_event_log_fault(const hd_event_log *log, const hd_scene_def *scene)
{
    const double reach = hd_round_wall_of(scene).reach;
    double before = 0.0;
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *event = &log->event[k];
        if (!(event->t >= before)) return "an event comes before the one before it";
        if (!(event->t <= log->duration)) return "an event comes after the end";
        if (!disks_exist(event, scene->disks)) return "there is no such disk";
        if (!wall_exists(event, reach)) return "there is no such wall";
        if (!is_normal(event, reach)) return "a normal has not the length that it should";
        if ((event->j >= 0 || event->j == HD_WALL_ROUND) && !approach(event))
            return "what meets there parts";
        before = event->t;
    }
    return NULL;
}

/* ---- file ---------------------------------------------------------------------------------- */

static void event_archive(hd_event *event, hd_archive *archive)
{
    hd_archive_next_doubles(archive, &event->t, 1);
    hd_archive_next_doubles(archive, event->n, HD_DIM);
    hd_archive_next_doubles(archive, event->p, HD_DIM);
}

void hd_event_log_archive(hd_event_log *log, hd_archive *archive, const hd_scene_def *scene)
{
    size_t count = log->count;
    hd_archive_double(archive, "log duration", &log->duration);
    hd_archive_count(archive, "log count", &count, sizeof *log->event);
    if (!archive->writing) {
        const hd_status status = hd_event_log_reserve(log, count);
        if (status != HD_OK)
            hd_archive_fail(archive, status, "log count", "there is no room for so many");
        if (!hd_archive_good(archive)) return;
        log->count = count;
    }
    hd_archive_of_doubles(archive, "log t n p", (1 + 2 * HD_DIM) * count);
    for (size_t k = 0; k < count; k++) event_archive(&log->event[k], archive);
    hd_archive_of_ints(archive, "log i j", 2 * count);
    for (size_t k = 0; k < count; k++) {
        hd_archive_next_int(archive, &log->event[k].i, 0, scene->disks - 1);
        hd_archive_next_int(archive, &log->event[k].j, HD_WALL_ROUND, scene->disks - 1);
    }
    const char *fault = hd_event_log_fault(log, scene);
    if (fault) hd_archive_refuse(archive, "log", fault);
}
