/** How far particles move at a time: not too far for the record, or for callers who wait. */
#ifndef HD_ADVANCE_H
#define HD_ADVANCE_H

#include <stdbool.h>

#include "dynamics/trajectory.h"
#include "observe/observables.h"

/** Most entries of one advance. This bounds memory, and the wait for an answer. Particles that move
 * in time steps may have more: as many as take the time of an orthonormalisation. */
double hd_advance_most(const hd_scene_def *scene);

/** The present advance. Its collisions or entries are counted when it ends, however often a viewer
 * stops it before. */
typedef struct hd_advance_plan {
    double begin, end; /**< simulated times */
    uint64_t events;   /**< number of events of the run before it */
} hd_advance_plan;

typedef struct hd_advance {
    hd_trajectory *trajectory;
    double most;    /**< most entries of one advance */
    double longest; /**< longest advance [time units], with at most `most` entries as far as their
                       rate is known */
    double bound;   /**< bound of `longest`: several times what `most` entries take at the expected
                       rate */
    double entries; /**< expected entries of a record per time unit */
    hd_advance_plan plan;
} hd_advance;

/** Creates the particles of a scene at time 0, when the rate of events is hardly known; resumed:
 * without a start. Fails as hd_trajectory_create. */
HD_MUST_CHECK hd_status hd_advance_create(hd_advance *advance, const hd_scene_def *scene,
                                          bool resumed);
void hd_advance_clear(hd_advance *advance);

/** Events of the run so far, of pairs and walls. */
uint64_t hd_advance_events(const hd_advance *advance);

/** Shortest plan [time units], because simulated time would not move by less; longest one, as far
 * as the rate of events is known. */
void hd_advance_bounds(const hd_advance *advance, double *shortest, double *longest);

/** Ends the plan at `end`, unless it ends before. */
void hd_advance_stop(hd_advance *advance, double end);
/** Moves the particles on towards the end of the plan, by at most `most`; if it is reached, the
 * next one goes to at most `stop`. On the way observables glance at the particles. The record may
 * be NULL. Fails as hd_trajectory_extend and hd_observables_glance. */
HD_MUST_CHECK hd_status hd_advance_on(hd_advance *advance, hd_observables *observables,
                                      hd_record *record, double stop, double most);

#endif
