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

/** From which the time left is estimated. */
typedef struct hd_clocks {
    double created, frame_started; /**< wall clock when the run was made, and when the frame began
                                      [s]; 0 before */
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
    double watch;    /**< see hd_run_watch; INFINITY: nobody watches */
    bool known;      /**< true if the weights of modes are those of the present time */
    double followed; /**< see hd_run_phase_time */
    hd_clocks clocks;
    hd_cost cost;
    hd_error_trend errors; /**< trend of the error of the smallest positive exponents */
};

/** As hd_run_create_shared and hd_run_free, but for calls that all ranks make by themselves.
 * resumed: a checkpoint will be read into it; its windows may have become too large for
 * covariant_memory by other report intervals, and are then left out. */
HD_MUST_CHECK hd_status hd_run_make(hd_run **out, const hd_scene_def *def, bool resumed,
                                    hd_communicator *communicator, char *message, size_t size);
void hd_run_drop(hd_run *run);

/** Goes back through a window that waits for it, so that the run can be saved. */
HD_MUST_CHECK hd_status hd_run_settle(hd_run *run);

/** How far the run is from a target that hd_target_check has passed. */
hd_target_progress hd_target_standing(const hd_run *run, const hd_text *target);
/** True if the target in force is reached; false without one. */
bool hd_target_reached(const hd_run *run);
/** The set `stages` and the observables from which the quantities of the scene's target follow. */
unsigned hd_target_stages(const hd_scene_def *def, unsigned stages);

#endif
