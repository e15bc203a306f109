/** How far the disks go at a time: short enough for the record and for whoever waits. */
#ifndef HD_ADVANCE_H
#define HD_ADVANCE_H

#include <stdbool.h>

#include "dynamics/trajectory.h"

/** Entries of one advance, at most: bounds memory, and the wait for an answer. Of what moves in
 * steps as many as take what an orthonormalisation takes, where that is more. */
double hd_advance_most(const hd_scene_def *scene);

/** The advance that the disks are in: what is learnt of it waits for its end, however often a
 * watcher stops it. */
typedef struct hd_advance_plan {
    double begin, end; /**< simulated times */
    uint64_t events;   /**< before it */
} hd_advance_plan;

typedef struct hd_advance {
    hd_trajectory *trajectory;
    double most;    /**< entries of one advance */
    double longest; /**< time units; keeps to `most`, as far as the rate of events is known */
    double bound;   /**< that `longest` never exceeds: several times `most` at this scene's rate */
    double entries; /**< of a record, expected in a time unit */
    hd_advance_plan plan;
} hd_advance;

/** The disks of a scene, at time 0; hardly anything is known of the rate of events. Fails as
 * hd_trajectory_create. */
HD_MUST_CHECK hd_status hd_advance_create(hd_advance *advance, const hd_scene_def *scene);
void hd_advance_clear(hd_advance *advance);

double hd_advance_now(const hd_advance *advance); /**< simulated time */
/** Of pairs and walls, so far. */
uint64_t hd_advance_events(const hd_advance *advance);

/** Shortest plan [time units]: by less, simulated time would not move. */
double hd_advance_shortest(const hd_advance *advance);
/** Longest plan [time units], as far as the rate of events is known. */
double hd_advance_longest(const hd_advance *advance);

/** Plans from now to at most `stop`. */
void hd_advance_make_plan(hd_advance *advance, double stop);
/** Ends the plan there, unless it ends before. */
void hd_advance_stop(hd_advance *advance, double end);
/** True at the end of what was planned. */
bool hd_advance_is_done(const hd_advance *advance);

/** Moves the disks on towards the end of the plan, by at most `most`; the record may be NULL. Fails
 * as hd_trajectory_extend. */
HD_MUST_CHECK hd_status hd_advance_on(hd_advance *advance, hd_record *record, double most);

#endif
