/** What a run holds, for the files that make it up: run.c goes on, query.c tells, change.c takes
 * what is asked for, target.c says whether it is reached, checkpoint.c keeps.
 */
#ifndef HD_RUN_STATE_H
#define HD_RUN_STATE_H

#include "averages/error_trend.h"
#include "hdlyap/run.h"
#include "observe/observables.h"
#include "run/advance.h"
#include "run/agenda.h"
#include "run/cages.h"
#include "run/carrier.h"
#include "run/gathered.h"

/** What somebody watches, see hd_run_watch. */
typedef struct hd_watch {
    double interval; /**< INFINITY: nobody does */
    int first;       /**< column from which vectors are wanted */
} hd_watch;

/** For estimates of the time left. */
typedef struct hd_clocks {
    double created, frame_started; /**< wall clock [s]; 0 before the frame starts */
    double frame_start_time;       /**< simulated time */
} hd_clocks;

struct hd_run {
    hd_communicator *communicator; /**< NULL: a single rank */
    hd_status status;              /**< of the call that failed: then the rest is of no use */
    hd_scene_def scene;            /**< as it is asked for now */
    hd_agenda agenda;
    hd_advance advance;
    hd_carrier carrier;
    hd_cages cages;
    hd_observables observables;
    hd_gathered gathered;
    hd_watch watch;
    int fields_first; /**< vectors from there on are read, too, where fields are due */
    bool known;       /**< the modes are those of this very time */
    double followed;  /**< simulated time at which phases were known last; negative: never */
    hd_clocks clocks;
    hd_cost cost;
    hd_error_trend errors; /**< of those nearest to zero; begins anew with a run that is resumed */
};

/** hd_run_create_shared and hd_run_free within a call that the other ranks make, too. */
HD_MUST_CHECK hd_status hd_run_make(hd_run **out, const hd_scene_def *def,
                                    hd_communicator *communicator, char *message, size_t size);
void hd_run_drop(hd_run *run);

/** Ends what a step has begun, so that the run can be kept: half of what an observable has to do
 * first is none. */
HD_MUST_CHECK hd_status hd_run_settle(hd_run *run);

/** Of a target that hd_target_check has passed. */
hd_standing hd_target_standing(const hd_run *run, const hd_text *target);
/** That the target which is in force is: false without one. */
bool hd_target_reached(const hd_run *run);
/** These stages, and those without which the scene's target would never be known. */
unsigned hd_target_stages(const hd_scene_def *def, unsigned stages);

#endif
