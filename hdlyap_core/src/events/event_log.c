/** Storage of an interval's events; it only grows. */
#include "events/event_log.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/memory.h"
#include "events/archived.h"

double hd_event_log_bytes(double events)
{
    static const double OF_AN_EVENT = 130.0;
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
    enum { EVENTS_FIRST = 4096 };
    size_t capacity = log->capacity ? log->capacity : EVENTS_FIRST;
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

static double product(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

/** A quotient of a vector and its length: each is right to an ulp or two. Of a round wall: times a
 * radius. */
static bool is_normal(const hd_event *event)
{
    const double square = product(event->n, event->n);
    if (event->j == HD_WALL_ROUND) return square > 0 && square < INFINITY;
    return fabs(square - 1.0) <= 8.0 * DBL_EPSILON;
}

/** Within the rounding of the normal. */
static bool approach(const hd_event *event)
{
    const double speed = sqrt(product(event->p, event->p));
    return product(event->n, event->p) <= 4.0 * DBL_EPSILON * speed;
}

const char *hd_event_log_fault(const hd_event_log *log, int disks)
{
    double before = 0.0;
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *event = &log->event[k];
        if (!(event->t >= before)) return "an event comes before the one before it";
        if (!(event->t <= log->duration)) return "an event comes after the end";
        if (!disks_exist(event, disks)) return "there is no such disk";
        if (!is_normal(event)) return "a normal is no unit vector";
        if (event->j >= 0 && !approach(event)) return "disks collide that part";
        before = event->t;
    }
    return NULL;
}

/* ---- file ---------------------------------------------------------------------------------- */

static void event_archive(hd_event *event, hd_archive *archive)
{
    hd_archive_next_doubles(archive, &event->t, 1);
    hd_archive_next_doubles(archive, event->n, 2);
    hd_archive_next_doubles(archive, event->p, 2);
}

void hd_event_log_archive(hd_event_log *log, hd_archive *archive, int disks)
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
    hd_archive_of_doubles(archive, "log t n p", 5 * count);
    for (size_t k = 0; k < count; k++) event_archive(&log->event[k], archive);
    hd_archive_of_ints(archive, "log i j", 2 * count);
    for (size_t k = 0; k < count; k++) {
        hd_archive_next_int(archive, &log->event[k].i, 0, disks - 1);
        hd_archive_next_int(archive, &log->event[k].j, HD_WALL_ROUND, disks - 1);
    }
    const char *fault = hd_event_log_fault(log, disks);
    if (fault) hd_archive_refuse(archive, "log", fault);
}
