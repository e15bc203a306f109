/** Trajectory -> record, one advance at a time. */
#include "run/advance.h"

#include <float.h>
#include <math.h>

#include "base/check.h"
#include "scene/scene.h"
#include "tangent/interval.h"

/** No advance is planned shorter: simulated time must move. */
static const double SHORTEST = 1e-12;

/** Rough number of events of one particle per time unit, where an event of two counts for both. The
 * first plans follow from it, later ones from what is counted. */
static double events_per_particle(const hd_scene_def *scene)
{
    return 2.0 * hd_dynamics_of(scene)->record_rate(scene) / scene->number;
}

double hd_advance_most(const hd_scene_def *scene)
{
    const double each = hd_dynamics_of(scene)->step ? hd_scene_carried(scene) : 0.0;
    return fmax(2e5, scene->number * each);
}

hd_status hd_advance_create(hd_advance *advance, const hd_scene_def *scene, bool resumed)
{
    HD_TRY(
        (resumed ? hd_trajectory_create_empty : hd_trajectory_create)(&advance->trajectory, scene));
    const double rate = events_per_particle(scene);
    advance->entries = hd_dynamics_of(scene)->record_rate(scene);
    advance->most = hd_advance_most(scene);
    advance->longest = 1e-3 / rate;
    advance->bound = 8.0 * advance->most / (scene->number * rate);
    return HD_OK;
}

void hd_advance_clear(hd_advance *advance) { hd_trajectory_free(advance->trajectory); }

static double time_of(const hd_advance *advance) { return hd_trajectory_time(advance->trajectory); }

uint64_t hd_advance_events(const hd_advance *advance)
{
    const hd_totals totals = hd_trajectory_totals(advance->trajectory);
    return totals.collisions + totals.wall_events;
}

void hd_advance_bounds(const hd_advance *advance, double *shortest, double *longest)
{
    *shortest = SHORTEST + 4.0 * DBL_EPSILON * time_of(advance);
    *longest = fmax(advance->longest, *shortest);
}

/** The end of the next equal part of what is left until `stop`, none longer than `most`. */
static double end_of_part(double now, double stop, double most)
{
    return stop - now <= most ? stop : now + hd_equal_part(stop - now, most);
}

void hd_advance_stop(hd_advance *advance, double end)
{
    advance->plan.end = fmin(advance->plan.end, end);
}

/** True at the end of what was planned. */
static bool is_done(const hd_advance *advance) { return time_of(advance) >= advance->plan.end; }

/** Number of events in an advance that has ended, of this length. For particles that do not
 * collide: the entries of the record, or as many as are expected if there is no record. */
static double events_in(const hd_advance *advance, double length, const hd_record *record)
{
    const uint64_t told = hd_advance_events(advance);
    if (told > 0) return (double)(told - advance->plan.events);
    return length * (record ? (double)hd_record_count(record) / hd_record_duration(record)
                            : advance->entries);
}

/** Learns the longest advance from the last one. It grows step by step, because rates can be far
 * from what is expected: a channel of hardly more than a particle's width can have 1e9 wall events
 * in a time unit. */
static void learn(hd_advance *advance, const hd_record *record)
{
    const double length = advance->plan.end - advance->plan.begin;
    const double events = fmax(1.0, events_in(advance, length, record));
    const double grown = fmin(4.0 * fmax(length, advance->longest),
                              length * advance->most / events);
    if (length > 0) advance->longest = fmin(grown, advance->bound);
}

/** Moves the particles to the time `end`; those who glance at them do so when it is time. */
static hd_status move(hd_trajectory *trajectory, hd_observables *observables, hd_record *record,
                      double end)
{
    double next;
    while ((next = hd_observables_next(observables)) <= end) {
        HD_TRY(hd_trajectory_extend(trajectory, record, next));
        HD_TRY(hd_observables_glance(observables, trajectory, next));
    }
    return hd_trajectory_time(trajectory) < end ? hd_trajectory_extend(trajectory, record, end)
                                                : HD_OK;
}

hd_status hd_advance_on(hd_advance *advance, hd_observables *observables, hd_record *record,
                        double stop, double most)
{
    const double now = time_of(advance);
    double shortest, longest;
    hd_advance_bounds(advance, &shortest, &longest);
    if (is_done(advance))
        advance->plan = (hd_advance_plan){.begin = now,
                                          .end = end_of_part(now, stop, longest),
                                          .events = hd_advance_events(advance)};
    const double end = end_of_part(now, advance->plan.end, fmax(most, shortest));
    HD_TRY(move(advance->trajectory, observables, record, end));
    if (is_done(advance)) learn(advance, record);
    return HD_OK;
}
