/** Trajectories that start from states written by hand. */
#ifndef HD_PREPARED_H
#define HD_PREPARED_H

#include "bodies.h"
#include "create_from.h"
#include "testing.h"
#include "interval.h"

static inline hd_trajectory *started(const hd_scene_def *def, const double *q, const double *p)
{
    hd_trajectory *tr = NULL;
    CHECK_OK(hd_trajectory_create_from(&tr, def, q, p));
    return tr;
}

/** From the scene's own start. */
static inline hd_trajectory *trajectory_of(hd_scene_def def)
{
    hd_trajectory *tr = NULL;
    CHECK_OK(hd_trajectory_create(&tr, &def));
    return tr;
}

/** All events before t_end. */
static inline hd_record *log_of(const hd_scene_def *def, const double *q, const double *p,
                                double t_end)
{
    hd_record *log = new_log();
    OWNED(hd_trajectory) *tr = started(def, q, p);
    CHECK_OK(trajectory_to(tr, log, t_end));
    return log;
}

/** Contacts so far that were predicted, and found to graze within rounding: they are not logged.
 * Within the first epoch: at its end every disk counts once more. */
static inline long void_contacts(const hd_trajectory *tr)
{
    uint64_t sum = 0;
    for (int32_t i = 0; i < hard_in(tr)->motion.count; i++)
        sum += hard_in(tr)->motion.disk[i].collisions;
    return (long)((sum - hd_trajectory_totals(tr).wall_events) / 2 -
                  hd_trajectory_totals(tr).collisions);
}

/** When the next event is due, pair or not; disks that meet then touch. */
static inline double next_event_time(hd_trajectory *tr)
{
    const int32_t i = hd_queue_next(&hard_in(tr)->motion.queue);
    return i < 0 ? hd_trajectory_time(tr)
                 : hard_in(tr)->epoch_start + hard_in(tr)->motion.queue.entry[i].key.t;
}

#endif
