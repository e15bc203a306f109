/** The members of a run: run.c goes on, query.c reads, change.c takes changes, target.c says
 * whether the target is reached, checkpoint.c keeps. */
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

/** What a viewer watches, see hd_run_watch. */
typedef struct hd_watch {
    double interval; /**< INFINITY: nobody watches */
    int first;       /**< column from which on vectors are watched */
} hd_watch;

/** For estimates of the time left. */
typedef struct hd_clocks {
    double created, frame_started; /**< wall clock [s]; 0 before the frame starts */
    double frame_start_time;       /**< simulated time */
} hd_clocks;

struct hd_run {
    hd_communicator *communicator; /**< NULL: a single rank */
    hd_status status;              /**< status of the call that failed; the run is then unusable */
    hd_scene_def scene;            /**< the scene as it is asked for now */
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

/** hd_run_create_shared and hd_run_free, called within a call that the other ranks make, too. */
HD_MUST_CHECK hd_status hd_run_make(hd_run **out, const hd_scene_def *def,
                                    hd_communicator *communicator, char *message, size_t size);
void hd_run_drop(hd_run *run);

/** Finishes the work that an observable has begun, so that the run can be kept. */
HD_MUST_CHECK hd_status hd_run_settle(hd_run *run);

/** How far the run is from a target that hd_target_check has passed. */
hd_standing hd_target_standing(const hd_run *run, const hd_text *target);
/** True if the target in force is reached; false without one. */
bool hd_target_reached(const hd_run *run);
/** These stages, and those that are needed to know the quantities of the scene's target. */
unsigned hd_target_stages(const hd_scene_def *def, unsigned stages);

#endif
