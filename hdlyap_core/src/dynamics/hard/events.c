/** Checks the record of hard particles. */
#include "dynamics/hard/event.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "dynamics/hard/contact.h"
#include "dynamics/hard/round_wall.h"
#include "scene/ends.h"
#include "scene/kinds.h"

double hd_events_bytes(double events)
{
    static const double OF_AN_EVENT = HD_DIM == 2 ? 142.0 : 182.0;
    return OF_AN_EVENT * events;
}

static bool disks_exist(const hd_event *event, int disks)
{
    if (!(event->i >= 0 && event->i < disks)) return false;
    if (event->i != floor(event->i) || event->j != floor(event->j)) return false;
    return event->j < 0 || (event->j > event->i && event->j < disks);
}

/** Whether the event's wall exists: a scene has flat walls or a curved one, not both, and flat ones
 * with the rule that it says, or those that reflect. */
static bool wall_exists(const hd_event *event, const hd_wall *wall, const hd_scene_def *scene)
{
    const bool is_curved = wall->meet;
    if (event->j < HD_WALL_RULED(HD_CURVED, 0) + 1) return false;
    const int j = (int)event->j;
    if (j < HD_WALL_ROUND) return scene->boundary[HD_WALL_ACROSS(j)] == HD_WALL_ENDS(j);
    if (j >= 0 || j == HD_WALL_ROUND) return j >= 0 || is_curved;
    const hd_ends *ends = hd_ends_of(scene->boundary[HD_WALL_X - j]);
    return !is_curved && ends->is_wall && !ends->meet;
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
    const hd_kinds kinds = hd_kinds_of(scene);
    hd_wall walls[HD_KINDS_MAX];
    for (int k = 0; k < kinds.count; k++)
        walls[k] = hd_wall_of(scene, 0.5 * kinds.kind[k].diameter);
    for (size_t k = 0; k < record->count; k++) {
        const hd_event *event = hd_record_entry(record, k);
        if (!disks_exist(event, scene->number))
            return "an event names a particle that does not exist";
        const hd_wall *wall = &walls[event->i >= kinds.kind[0].number];
        if (!wall_exists(event, wall, scene)) return "an event names a wall that does not exist";
        if (event->j < HD_WALL_ROUND) {
            const char *fault = hd_ends_of(HD_WALL_ENDS((int)event->j))->fault(event->n);
            if (fault) return fault;
            continue;
        }
        if (!is_normal(event, wall)) return "a normal vector has a wrong length";
        if ((event->j >= 0 || event->j == HD_WALL_ROUND) && !approach(event))
            return "partners of a collision move apart";
    }
    return NULL;
}
