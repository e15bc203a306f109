/** Checks the record of hard particles, and keeps it in a checkpoint. */
#include "dynamics/hard/events.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "dynamics/hard/contact.h"
#include "dynamics/record.h"
#include "dynamics/hard/round_wall.h"

double hd_events_bytes(double events)
{
    static const double OF_AN_EVENT = HD_DIM == 2 ? 130.0 : 170.0;
    return OF_AN_EVENT * events;
}

const hd_event *hd_events(const hd_record *record) { return record->entry; }

/* ---- checks -------------------------------------------------------------------------------- */

static bool disks_exist(const hd_event *event, int disks)
{
    if (event->i < 0 || event->i >= disks) return false;
    return (event->j < 0 && event->j >= HD_WALL_ROUND) || (event->j > event->i && event->j < disks);
}

/** Whether the event's wall can exist: a scene has flat walls or a curved one, not both. */
static bool wall_exists(const hd_event *event, const hd_wall *wall)
{
    const bool is_curved = wall->meet;
    return event->j == HD_WALL_ROUND ? is_curved
                                     : event->j >= 0 || (event->j > HD_WALL_ROUND && !is_curved);
}

/** Whether the normal has length 1, or that of a radius of the curved wall. A vector divided by its
 * length has length 1 to an ulp or two. */
static bool is_normal(const hd_event *event, const hd_wall *wall)
{
    const bool is_round = event->j == HD_WALL_ROUND; /* its normal has one more rounding */
    const double least = is_round ? wall->radius_least : 1.0;
    const double most = is_round ? wall->radius_most : 1.0;
    const double square = hd_contact_dot(event->n, event->n);
    const double rounding = (is_round ? 12.0 : 8.0) * DBL_EPSILON;
    return square - least * least >= -rounding * least * least &&
           square - most * most <= rounding * most * most;
}

/** Whether the disks approach, within the rounding of the normal; a disk approaches the round wall
 * if it moves outwards. */
static bool approach(const hd_event *event)
{
    const double speed = sqrt(hd_contact_dot(event->p, event->p));
    if (event->j == HD_WALL_ROUND) return hd_contact_dot(event->n, event->p) > 0;
    return hd_contact_dot(event->n, event->p) <= 4.0 * DBL_EPSILON * speed;
}

const char *hd_events_fault(const hd_record *record, const hd_scene_def *scene)
{
    const hd_wall wall = hd_wall_of(scene);
    double before = 0.0;
    for (size_t k = 0; k < record->count; k++) {
        const hd_event *event = hd_events(record) + k;
        if (!(event->t >= before)) return "an event comes before the one before it";
        if (!(event->t <= record->duration)) return "an event comes after the end of the record";
        if (!disks_exist(event, scene->number))
            return "an event names a particle that does not exist";
        if (!wall_exists(event, &wall)) return "an event names a wall that does not exist";
        if (!is_normal(event, &wall)) return "a normal vector has a wrong length";
        if ((event->j >= 0 || event->j == HD_WALL_ROUND) && !approach(event))
            return "partners of a collision move apart";
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

void hd_events_archive(hd_record *record, hd_archive *archive, const hd_scene_def *scene)
{
    size_t count = record->count;
    hd_archive_double(archive, "log duration", &record->duration);
    hd_archive_count(archive, "log count", &count, record->size);
    if (!archive->writing) {
        const hd_status status = hd_record_reserve(record, count);
        if (status != HD_OK)
            hd_archive_fail(archive, status, "log count", "there is no memory for so many events");
        if (!hd_archive_good(archive)) return;
        record->count = count;
    }
    hd_archive_of_doubles(archive, "log t n p", (1 + 2 * HD_DIM) * count);
    hd_event *event = record->entry;
    for (size_t k = 0; k < count; k++) event_archive(&event[k], archive);
    hd_archive_of_ints(archive, "log i j", 2 * count);
    for (size_t k = 0; k < count; k++) {
        hd_archive_next_int(archive, &event[k].i, 0, scene->number - 1);
        hd_archive_next_int(archive, &event[k].j, HD_WALL_ROUND, scene->number - 1);
    }
    const char *fault = hd_events_fault(record, scene);
    if (fault) hd_archive_refuse(archive, "log", fault);
}
